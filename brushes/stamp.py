"""Stamp: a footprint with the shape of an alpha (T03), put down at each dab, turned as the brush says."""

from __future__ import annotations

import math
import struct
import zlib

import numpy as np

from ..level.grid import Grid, Rect
from .alphas import Alpha, smaller
from .footprint import Footprint, Link


class Stamp(Footprint):
    """The picture's square has the brush's size; the falloff is the picture's own. North of it is up when unturned.

    `turn` is fixed, along (its up goes the way of the stroke) or random (from `seed` and the place alone, so that a
    stroke that is played again is the same). `angle_deg` is added, clockwise.
    """

    def __init__(self, radius_cells: float, alpha: Alpha, turn: str, angle_deg: float, seed: int) -> None:
        super().__init__(radius_cells, 0.0)
        self.turn, self.angle, self.seed = turn, math.radians(angle_deg), seed
        side = len(alpha.grey)
        least = max(math.ceil(4 * self.radius), 4)  # more pixels than cells would flicker
        self.grey = np.pad(alpha.grey if side <= least else smaller(alpha.grey, least), 1)

    @property
    def reach(self) -> float:
        return self.radius * math.sqrt(2)

    def rect(self, link: Link, grid: Grid) -> Rect:
        return grid.rect_along(link.row1, link.col1, link.row1, link.col1, self.reach)

    def misses(self, link: Link, rect: Rect) -> bool:
        return super().misses(Link(link.row1, link.col1, link.row1, link.col1), rect)

    def turned(self, link: Link) -> float:
        """Clockwise from north, radians."""
        if self.turn == "along" and link.length:
            north, east = link.heading
            return self.angle + math.atan2(east, north)
        if self.turn == "random":
            number = zlib.crc32(struct.pack("<q2d", self.seed, link.row1, link.col1))
            return self.angle + math.tau * number / 2**32
        return self.angle

    def weights(self, link: Link, rect: Rect, out: np.ndarray, *spare: np.ndarray) -> np.ndarray:
        side, angle = self.grey.shape[0] - 2, self.turned(link)
        scale = side / (2 * self.radius)
        north, east = math.cos(angle) * scale, math.sin(angle) * scale
        rows = (np.arange(rect.row0, rect.row1) - link.row1)[:, None]
        cols = (np.arange(rect.col0, rect.col1) - link.col1)[None, :]
        middle = 0.5 * (side + 1)  # pixels count from the border that was added
        up = np.clip(rows * north + cols * east + middle, 0, side + 0.999).astype(np.float32)
        right = np.clip(cols * north - rows * east + middle, 0, side + 0.999).astype(np.float32)
        row, col = up.astype(np.int32), right.astype(np.int32)
        up -= row
        right -= col
        at, flat = row * (side + 2) + col, self.grey.ravel()
        south = flat[at] + (flat[at + 1] - flat[at]) * right
        at += side + 2
        north_of = flat[at] + (flat[at + 1] - flat[at]) * right
        np.add(south, (north_of - south) * up, out=out)
        if link.pressure1 != 1:
            out *= np.float32(link.pressure1)
        return out
