"""What the weather panel looks at: a square of the world, moved and zoomed, between metres and pixels (T04)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..level.weather import TILE_M

CLOSEST_M = 1500.0  # a side
PER_NOTCH = 0.85
NICE = (1, 2, 5)


@dataclass(frozen=True)
class Sight:
    """A square of `span_m` metres about (east, north), north up, on `side` pixels; pixel (0, 0) is its upper left."""

    east_m: float = 0.0
    north_m: float = 0.0
    span_m: float = TILE_M
    side: float = 256.0

    def world(self, px: float, py: float) -> tuple[float, float]:
        """Metres east and north of a pixel."""
        part = self.span_m / self.side
        return self.east_m + (px - self.side / 2) * part, self.north_m - (py - self.side / 2) * part

    def pixels(self, x, y) -> np.ndarray:
        """Pixels (…, 2) of world places."""
        part = self.side / self.span_m
        x, y = np.asarray(x, np.float64), np.asarray(y, np.float64)
        return np.stack([(x - self.east_m) * part, (self.north_m - y) * part], axis=-1) + self.side / 2

    def zoomed(self, px: float, py: float, notches: float) -> Sight:
        """Nearer (or, negative, farther), the place under a pixel staying where it is."""
        x, y = self.world(px, py)
        span_m = min(max(self.span_m * PER_NOTCH**notches, CLOSEST_M), TILE_M)
        part = span_m / self.span_m
        return Sight(x + (self.east_m - x) * part, y + (self.north_m - y) * part, span_m, self.side)

    def panned(self, dx_px: float, dy_px: float) -> Sight:
        """The map pulled along by the pointer."""
        part = self.span_m / self.side
        return Sight(self.east_m - dx_px * part, self.north_m + dy_px * part, self.span_m, self.side)

    def grid(self, texels: int) -> tuple[np.ndarray, np.ndarray]:
        """World metres of the middles of texels, `(texels, texels)` each, row 0 south."""
        axis = ((np.arange(texels) + 0.5) / texels - 0.5) * self.span_m
        return np.meshgrid(self.east_m + axis, self.north_m + axis)

    @property
    def scale_m(self) -> float:
        """A round number of metres that takes a fifth to a half of the side."""
        power = 10.0 ** math.floor(math.log10(self.span_m / 2))
        return max(digit * power for digit in NICE if digit * power <= self.span_m / 2)
