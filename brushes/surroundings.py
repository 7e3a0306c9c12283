"""What strokes know of the sea about them: its current and the way to its shore, as they were at the press."""

from __future__ import annotations

import numpy as np

from ..level import Level
from ..level.grid import Rect


class Surroundings:
    """`needs` names what is asked for: flow, shore. Taken before the stroke's first write."""

    def __init__(self, level: Level, needs: frozenset[str]) -> None:
        self.grid = level.grid
        if "flow" in needs:
            self.current = settled_current(level)
        if "shore" in needs:
            from ..level.shore_field import decode_direction, shore_field  # here, for it brings SciPy

            field = shore_field(level)
            self.field_m = field.cell_m
            # copies: the field follows the ground while the stroke goes on
            self.distance_m, self.way = field.distance_m.copy(), decode_direction(field.packed[..., 1:3])

    def speed_mps(self, rect: Rect) -> np.ndarray:
        """Speed of the current, float32 `(rows, cols)`."""
        y, x = self._metres(rect)
        return np.hypot(*self.current.at(*np.meshgrid(x, y))).astype(np.float32)

    def shore_m(self, rect: Rect) -> np.ndarray:
        """Metres to the shoreline, + sea, clamped to the field's range; float32 `(rows, cols)`."""
        return self._between(self.distance_m, rect).astype(np.float32)

    def to_shore(self, rect: Rect) -> np.ndarray:
        """Unit vectors (east, north) to the shore, 0 where none is near; float32 `(rows, cols, 2)`."""
        way = self._between(self.way, rect)
        length = np.hypot(way[..., 0], way[..., 1])[..., None]
        return np.divide(way, length, out=np.zeros_like(way), where=length > 0.1).astype(np.float32)

    def _metres(self, rect: Rect) -> tuple[np.ndarray, np.ndarray]:
        cell_m = self.grid.cell_m
        return np.arange(rect.row0, rect.row1) * cell_m, np.arange(rect.col0, rect.col1) * cell_m

    def _between(self, values: np.ndarray, rect: Rect) -> np.ndarray:
        """Bilinear in a map of the field."""
        parts = []
        for metres, side in zip(self._metres(rect), values.shape[:2], strict=True):
            at = np.clip(metres / self.field_m, 0, side - 1)
            low = np.minimum(at.astype(int), side - 2)
            parts.append((low, at - low))
        (row, fr), (col, fc) = parts
        more = (None,) * (values.ndim - 2)
        fr, fc = fr[(slice(None), None, *more)], fc[(None, slice(None), *more)]
        south, north = (values[r][:, col] * (1 - fc) + values[r][:, col + 1] * fc for r in (row, row + 1))
        return south * (1 - fr) + north * fr


def settled_current(level: Level):
    """The current that follows from the level as it is, never one that a process beside the window has yet to renew."""
    from ..level.flow import current  # here, for it brings SciPy

    if level.solver is not None or level.live:
        level.derived.pop("current", None)
    return current(level)
