"""The jet with which a river goes on out at sea (D35).

A core of CORE widths in which its middle keeps the river's speed, then 1 / √distance; the half width, where it has half
of that, grows by SPREAD a metre; a Gaussian across (plane turbulent jet, Albertson et al. 1950).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .river_line import SPREAD

CORE = 5.2  # widths
MIXES = 1.35  # a jet's water spreads so much wider than its speed (Fischer et al. 1979, Mixing, table 9.2)
LEAST_EDGE = 0.12  # half widths: what has the way that the mouth's edges take to the sea's water is no narrower


@dataclass(frozen=True)
class Mouth:
    """Place, unit heading, speed, half width and depth of a river where it comes to the sea; felt to `reach_m`."""

    x: float
    y: float
    east: float
    north: float
    speed_mps: float
    half_m: float
    depth_m: float
    reach_m: float

    def off(self, x, y) -> tuple[np.ndarray, np.ndarray]:
        """Metres ahead of it, and to its left."""
        dx, dy = np.asarray(x, np.float64) - self.x, np.asarray(y, np.float64) - self.y
        return dx * self.east + dy * self.north, dy * self.east - dx * self.north

    def box(self, cell_m: float) -> tuple[tuple[int, int], tuple[int, int]]:
        """Rows and columns, from and up to, of samples outside of which it isn't felt."""
        wide = 4.0 * (self.half_m + SPREAD * self.reach_m) + 4 * cell_m
        spans = ((at, at + way * self.reach_m) for at, way in ((self.y, self.north), (self.x, self.east)))
        return tuple((round((min(span) - wide) / cell_m), round((max(span) + wide) / cell_m)) for span in spans)

    def water(self, x, y) -> np.ndarray:
        """Share 0 … 1 of the river's water at world points beyond the mouth, without eddies: plume_at in mouth.glsl."""
        ahead, across = self.off(x, y)
        core, far = 2 * CORE * self.half_m, np.maximum(ahead, 0.0)
        flat = self.half_m * np.maximum(1 - far / core, 0)
        wide = MIXES * (self.half_m + SPREAD * far - flat) / math.sqrt(math.log(2)) + LEAST_EDGE * self.half_m
        over = np.maximum(np.abs(across) - flat, 0) / wide
        ends = 1 - smooth(0.15 * self.reach_m, 1.1 * self.reach_m, far)  # the eye sees shares by their logarithm
        return np.sqrt(core / np.maximum(far, core)) * np.exp(-over * over) * ends * ends

    def speed(self, x, y, cell_m: float, behind_m: float = 0.0) -> np.ndarray:
        """Of the jet along its heading, m/s at world points, smooth on cells of that size; exactly 0 where none is.

        Up to `behind_m` up the river it is as at the mouth.
        """
        ahead, across = self.off(x, y)
        core = 2 * CORE * self.half_m
        far = np.maximum(ahead, 0.0)
        flat = self.half_m * np.maximum(1 - far / core, 0)
        wide = np.maximum((self.half_m + SPREAD * far - flat) / math.sqrt(math.log(2)), 1.5 * cell_m)
        over = np.maximum(np.abs(across) - flat, 0) / wide
        profile = np.maximum(np.exp(-over * over) - 0.002, 0) / 0.998
        known = smooth(-2 * cell_m - behind_m, -behind_m, ahead) * (1 - smooth(0.5 * self.reach_m, self.reach_m, ahead))
        return self.speed_mps * np.sqrt(core / np.maximum(far, core)) * profile * known


def smooth(low: float, high: float, x) -> np.ndarray:
    """Smoothstep."""
    u = np.clip((x - low) / (high - low), 0, 1)
    return u * u * (3 - 2 * u)
