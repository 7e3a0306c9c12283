"""Footprints: where a dab works and how strongly, measured from its true centre, never from the nearest cell.

Weights are made in place in float32 from one row and one column of float64 coordinates, so they are the same bytes
however the dab is cut into blocks. A sub-cell centre leaves nothing to keep between dabs, and making a weight costs
less than fetching it from a table.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..level.grid import Grid, Rect


@dataclass(frozen=True)
class Link:
    """A dab in fractional cells: from one place to another, with the pressure at both."""

    row0: float
    col0: float
    row1: float
    col1: float
    pressure0: float = 1.0
    pressure1: float = 1.0

    @property
    def length(self) -> float:
        return math.hypot(self.row1 - self.row0, self.col1 - self.col0)

    @property
    def heading(self) -> tuple[float, float]:
        """Unit step (rows, columns) along the link; east for a lone dab."""
        length = self.length
        return ((self.row1 - self.row0) / length, (self.col1 - self.col0) / length) if length else (0.0, 1.0)

    def along(self, rect: Rect, out: np.ndarray) -> np.ndarray:
        """Cells of way along the link of every cell in `rect`, from its start, into `out` `(rows, cols)`."""
        to_row, to_col = self.heading
        return self._project(rect, to_row, to_col, out)

    def across(self, rect: Rect, out: np.ndarray) -> np.ndarray:
        """Cells beside the link, positive to its right seen from above, into `out` `(rows, cols)`."""
        to_row, to_col = self.heading
        return self._project(rect, -to_col, to_row, out)

    def _project(self, rect: Rect, to_row: float, to_col: float, out: np.ndarray) -> np.ndarray:
        rows = (np.arange(rect.row0, rect.row1) - self.row0) * to_row
        cols = (np.arange(rect.col0, rect.col1) - self.col0) * to_col
        return np.add(rows.astype(np.float32)[:, None], cols.astype(np.float32)[None, :], out=out)


class Footprint:
    """`radius` and `soft` (the width that fades) are in cells; both at least 1, so that a click always finds a cell."""

    def __init__(self, radius_cells: float, falloff: float) -> None:
        self.radius = max(radius_cells, 1.0)
        self.soft = max(self.radius * falloff, 1.0)
        self.core = self.radius - self.soft

    def rect(self, link: Link, grid: Grid) -> Rect:
        """The cells a dab can touch."""
        return grid.rect_along(link.row0, link.col0, link.row1, link.col1, self.reach)

    @property
    def reach(self) -> float:
        return self.radius

    def misses(self, link: Link, rect: Rect) -> bool:
        """True when no cell of `rect` can be touched."""
        row, col = (rect.row0 + rect.row1 - 1) / 2, (rect.col0 + rect.col1 - 1) / 2
        to_row, to_col = link.heading
        way = (row - link.row0) * to_row + (col - link.col0) * to_col
        way = min(max(way, 0.0), link.length)
        distance = math.hypot(row - link.row0 - way * to_row, col - link.col0 - way * to_col)
        return distance > self.reach + math.hypot(rect.row1 - rect.row0, rect.col1 - rect.col0) / 2

    def weights(self, link: Link, rect: Rect, out: np.ndarray, spare: np.ndarray) -> np.ndarray:
        """Weight 0 to 1 of every cell in `rect`, float32 `(rows, cols)` in `out`; `spare` is overwritten."""
        self.distance(link, rect, out, spare)  # in cells from the part that has full strength
        np.multiply(out, np.float32(-1 / self.soft), out=out)
        np.add(out, np.float32(1 + self.inset / self.soft), out=out)
        np.clip(out, 0, 1, out=out)
        np.multiply(out, np.float32(-2), out=spare)
        np.add(spare, np.float32(3), out=spare)
        np.multiply(out, out, out=out)
        np.multiply(out, spare, out=out)
        self._press(link, rect, out, spare)
        return out

    def _press(self, link: Link, rect: Rect, out: np.ndarray, spare: np.ndarray) -> None:
        if link.pressure0 != link.pressure1 and link.length:
            link.along(rect, spare)
            np.clip(spare, 0, np.float32(link.length), out=spare)
            np.multiply(spare, np.float32((link.pressure1 - link.pressure0) / link.length), out=spare)
            np.add(spare, np.float32(link.pressure0), out=spare)
            np.multiply(out, spare, out=out)
        elif link.pressure1 != 1:
            np.multiply(out, np.float32(link.pressure1), out=out)

    @property
    def inset(self) -> float:
        """What `distance` counts too much: it may measure from the line instead of from the core."""
        return 0.0

    def distance(self, link: Link, rect: Rect, out: np.ndarray, spare: np.ndarray) -> None:
        raise NotImplementedError


class Round(Footprint):
    """A disc, drawn out along the way from the last dab."""

    @property
    def inset(self) -> float:
        return self.core

    def distance(self, link: Link, rect: Rect, out: np.ndarray, spare: np.ndarray) -> None:
        if not link.length:
            rows = np.arange(rect.row0, rect.row1) - link.row1
            cols = np.arange(rect.col0, rect.col1) - link.col1
            np.add((rows * rows).astype(np.float32)[:, None], (cols * cols).astype(np.float32)[None, :], out=out)
        else:
            _beyond(link, rect, out, spare)
            np.multiply(out, out, out=out)
            link.across(rect, spare)
            np.multiply(spare, spare, out=spare)
            np.add(out, spare, out=out)
        np.sqrt(out, out=out)


class Strip(Footprint):
    """A strip with straight ends: full strength between its ends, fading beside and beyond them alike."""

    @property
    def reach(self) -> float:
        return math.hypot(self.radius, self.soft)

    def distance(self, link: Link, rect: Rect, out: np.ndarray, spare: np.ndarray) -> None:
        _beyond(link, rect, out, spare)
        np.multiply(out, out, out=out)
        link.across(rect, spare)
        np.abs(spare, out=spare)
        np.subtract(spare, np.float32(self.core), out=spare)
        np.maximum(spare, 0, out=spare)
        np.multiply(spare, spare, out=spare)
        np.add(out, spare, out=out)
        np.sqrt(out, out=out)


def _beyond(link: Link, rect: Rect, out: np.ndarray, spare: np.ndarray) -> None:
    """Cells of way past either end of a link, 0 between them, into `out`."""
    link.along(rect, out)
    np.clip(out, 0, np.float32(link.length), out=spare)
    np.subtract(out, spare, out=out)
