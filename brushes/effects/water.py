"""Water: paints lakes, ponds and streams at any height (D13)."""

from __future__ import annotations

import numpy as np

from ...level.grid import Rect
from . import Effect, Piece

CORE = 0.5  # of the weight from which there is water: it has no soft edge
LEAST_DEPTH_M = 0.02  # ground so close under the water stays dry


class Water(Effect):
    """Mask and level in one stroke. The level is that of the water under the press, else the ground there and a depth;
    in the mode `follow` it goes down with the ground under the stroke, never up.
    """

    layer = "river_mask"

    @classmethod
    def masked(cls, params, invert: bool) -> bool:
        return False

    @classmethod
    def target(cls, params):
        return "river_mask", ("mask",)

    @classmethod
    def idle(cls, params) -> frozenset[str]:
        return frozenset(["strength", "opacity"])

    def begin(self, canvas, row: float, col: float) -> None:
        self.level_m = self._pressed(canvas, row, col)
        self.close = np.zeros(canvas.data.grid.shape, np.float32)  # of cells to the dab whose level they have

    def prepare(self, canvas, rect, link) -> None:
        """The level that this dab lays, into the layer beside the mask before the first write."""
        if self.invert:
            return
        if self.params.mode == "follow":
            ground = canvas.found("height", _cell(canvas, link.row1, link.col1))
            self.level_m = min(self.level_m, float(ground[0, 0]) + self.params.depth_m)
        self.rect = canvas.data.grid.clip(rect)
        self.ground = canvas.found("height", self.rect)
        surface = canvas.level.layers["river_surface"]
        there = self._nearest(link) & self._free(canvas)
        if there.any():
            canvas.step.save(surface, self.rect)
            part = surface.array[self.rect.slices]
            part[there] = self.level_m
            canvas.level.mark("river_surface", self.rect)

    def _free(self, canvas) -> np.ndarray:
        """Cells of the dab's rectangle where the stroke found no water."""
        return canvas.found("river_mask", self.rect) < CORE

    def _nearest(self, link) -> np.ndarray:
        """Cells that no dab before this one was so near to: where a level falls, each takes that of its own place."""
        rows, cols = np.ogrid[self.rect.row0 : self.rect.row1, self.rect.col0 : self.rect.col1]
        close = (1 / (1 + np.square(rows - link.row1) + np.square(cols - link.col1))).astype(np.float32)
        before = self.close[self.rect.slices]
        nearer = close > before
        before[nearer] = close[nearer]
        return nearer

    def write(self, piece: Piece) -> None:
        inside = piece.weight >= CORE
        if self.invert:
            piece.live[inside] = 0.0
            return
        ground = self.ground[piece.rect.shifted(self.rect).slices]
        piece.live[inside & (ground < self.level_m - LEAST_DEPTH_M)] = 1.0

    def _pressed(self, canvas, row: float, col: float) -> float:
        here = _cell(canvas, row, col)
        if canvas.level.layers["river_mask"].read(here)[0, 0] >= CORE:
            return float(canvas.level.layers["river_surface"].read(here)[0, 0])
        return float(canvas.found("height", here)[0, 0]) + self.params.depth_m


def _cell(canvas, row: float, col: float) -> Rect:
    """The cell that a fractional place lies in, held to the level."""
    rows, cols = canvas.data.grid.shape
    row, col = (int(min(max(round(at), 0), n - 1)) for at, n in ((row, rows), (col, cols)))
    return Rect(row, col, row + 1, col + 1)
