"""Ramp: the heights at press and release set a straight grade between them (Diablo IV talk, D31)."""

from __future__ import annotations

import math

import numpy as np

from . import Piece, one_sided
from .even_pace import Evens

LEVEL_GRADE = 1e-4  # a bed this flat has no front speed worth telling


class Ramp(Evens):
    """Brings cells to the grade; past its ends it leads over to the ground as it lies, so that a ramp along a slope
    that is already right changes nothing. Inverted it only digs (what only dug, fills).
    """

    def begin(self, canvas, row: float, col: float) -> None:
        super().begin(canvas, row, col)
        self.low = canvas.sample(row, col)

    def prepare(self, canvas, rect, link) -> None:
        self.link = link
        if self.even:
            self.even.prepare(canvas, rect, link, base=True, once=True)
        self.high = canvas.sample(link.row1, link.col1)
        self.grade = (self.high - self.low) / np.float32(link.length)
        to_row, to_col = link.heading
        self.before = -self._leads(canvas, link.row0, link.col0, -to_row, -to_col, self.low)
        self.after = self._leads(canvas, link.row1, link.col1, to_row, to_col, self.high)

    def _leads(self, canvas, row: float, col: float, to_row: float, to_col: float, height: np.ndarray) -> np.ndarray:
        """Rise per cell from an end of the ramp to the ground where its shoulder ends, or where the level does."""
        grid = canvas.data.grid
        far_row, far_col = row + to_row * self.footprint.soft, col + to_col * self.footprint.soft
        if not grid.wraps:
            far_row, far_col = min(max(far_row, 0.0), grid.rows - 1.0), min(max(far_col, 0.0), grid.cols - 1.0)
        way = (far_row - row) * to_row + (far_col - col) * to_col
        return (canvas.sample(far_row, far_col) - height) / np.float32(way) if way >= 1 else np.zeros_like(height)

    def write(self, piece: Piece) -> None:
        change = self._heights(piece)
        np.subtract(change, piece.base, out=change)
        one_sided(change, self.side)
        np.multiply(change, piece.weight, out=change)
        np.multiply(change, self.amount, out=change)
        np.add(piece.base, change, out=piece.live)
        if self.even:  # what the grade leaves
            piece.live += self.even.change(piece) * np.float32(1 - self.amount)

    def _heights(self, piece: Piece) -> np.ndarray:
        """What the grade asks for, in `piece.spare`."""
        along = piece.link.along(piece.rect, piece.spare)
        length, soft = np.float32(piece.link.length), np.float32(self.footprint.soft)
        before = np.clip(along, -soft, 0)
        after = np.clip(along, length, length + soft) - length
        heights = np.clip(along, 0, length, out=along)
        np.multiply(heights, self.grade[piece.channel], out=heights)
        np.add(heights, self.low[piece.channel], out=heights)
        heights += before * self.before[piece.channel]
        heights += after * self.after[piece.channel]
        return heights

    @property
    def side(self) -> str:
        return {"both": "cut", "cut": "fill", "fill": "cut"}[self.params.side] if self.invert else self.params.side

    def preview(self, canvas) -> dict | None:
        """Where it goes, how steep it is, and the speed it gives a front: m, rise over run, m/s (None when level)."""
        from ...level.timing import speed_on  # here, for it brings SciPy: a table of brushes does without

        grid, link = canvas.data.grid, self.link
        first, last = float(self.low[0]), float(self.high[0])
        length_m = link.length * grid.cell_m
        grade = (last - first) / length_m
        depth_m = canvas.level.sea_level_m - 0.5 * (first + last)  # half way
        speed = speed_on(canvas.level, 0.0, depth_m, abs(grade)) if abs(grade) >= LEVEL_GRADE else None
        return {
            "start": grid.to_metres(link.row0, link.col0),
            "end": grid.to_metres(link.row1, link.col1),
            "heights": (first, last),
            "length_m": length_m,
            "grade": grade,
            "slope_deg": math.degrees(math.atan(abs(grade))),
            "front_speed_mps": speed,
        }
