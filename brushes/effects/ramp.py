"""Ramp: the heights at press and release set a straight grade between them (Diablo IV talk, D31)."""

from __future__ import annotations

import numpy as np

from ...level.shore_waves import front_speed_mps
from . import Effect, Piece, one_sided

LEVEL_GRADE = 1e-4  # a bed this flat has no front speed worth telling


class Ramp(Effect):
    """Brings cells to the grade, past its ends to the height there. Inverted it only digs (what only dug, fills)."""

    def begin(self, canvas, row: float, col: float) -> None:
        self.start = (row, col)
        self.heights = canvas.sample(row, col), None

    def prepare(self, canvas, rect, link) -> None:
        self.end = (link.row1, link.col1)
        self.heights = self.heights[0], canvas.sample(link.row1, link.col1)
        self.length = link.length

    def write(self, piece: Piece) -> None:
        low, high = (heights[piece.channel] for heights in self.heights)
        change = piece.link.along(piece.rect, piece.spare)
        np.clip(change, 0, np.float32(self.length), out=change)
        np.multiply(change, np.float32((float(high) - float(low)) / self.length), out=change)
        np.add(change, low, out=change)
        np.subtract(change, piece.base, out=change)
        one_sided(change, self.side)
        np.multiply(change, piece.weight, out=change)
        np.multiply(change, self.amount, out=change)
        np.add(piece.base, change, out=piece.live)

    @property
    def side(self) -> str:
        return {"both": "cut", "cut": "fill", "fill": "cut"}[self.params.side] if self.invert else self.params.side

    def preview(self, canvas) -> dict | None:
        """Where it goes, how steep it is, and the speed it gives a front: m, rise over run, m/s."""
        if self.heights[1] is None:
            return None
        grid = canvas.data.grid
        first, last = (float(heights[0]) for heights in self.heights)
        length_m = self.length * grid.cell_m
        grade = (last - first) / length_m
        slope = abs(grade)
        return {
            "start": grid.to_metres(*self.start),
            "end": grid.to_metres(*self.end),
            "heights": (first, last),
            "length_m": length_m,
            "grade": grade,
            "slope_deg": float(np.degrees(np.arctan(slope))),
            "front_speed_mps": None if slope < LEVEL_GRADE else self._speed(canvas, slope),
        }

    @staticmethod
    def _speed(canvas, slope: float) -> float:
        return float(front_speed_mps(canvas.level.settings.shore, slope))
