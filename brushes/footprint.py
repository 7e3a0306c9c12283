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
        return np.add(*self._project(rect, *self.heading), out=out)

    def across(self, rect: Rect, out: np.ndarray) -> np.ndarray:
        """Cells beside the link, positive to its right seen from above, into `out` `(rows, cols)`."""
        to_row, to_col = self.heading
        return np.add(*self._project(rect, -to_col, to_row), out=out)

    def _project(self, rect: Rect, to_row: float, to_col: float) -> tuple[np.ndarray, np.ndarray]:
        rows = (np.arange(rect.row0, rect.row1) - self.row0) * to_row
        cols = (np.arange(rect.col0, rect.col1) - self.col0) * to_col
        return rows.astype(np.float32)[:, None], cols.astype(np.float32)[None, :]


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

    def weights(self, link: Link, rect: Rect, out: np.ndarray, *spare: np.ndarray) -> np.ndarray:
        """Weight 0 to 1 of every cell in `rect`, float32 `(rows, cols)` in `out`; two `spare` ones are overwritten."""
        pressure = self.distance(link, rect, out, *spare)
        np.multiply(out, np.float32(-1 / self.soft), out=out)
        np.add(out, np.float32(1 + self.inset / self.soft), out=out)
        np.clip(out, 0, 1, out=out)
        np.multiply(out, np.float32(-2), out=spare[0])
        np.add(spare[0], np.float32(3), out=spare[0])
        np.multiply(out, out, out=out)
        np.multiply(out, spare[0], out=out)
        if pressure is not None:
            np.multiply(out, pressure, out=out)
        return out

    @property
    def inset(self) -> float:
        """What `distance` counts too much: it may measure from the line instead of from the core."""
        return 0.0

    def distance(self, link: Link, rect: Rect, out: np.ndarray, spare: np.ndarray, more: np.ndarray):
        """Cells from the core, into `out`; returns the pressure there: None for 1, `more` where it varies."""
        raise NotImplementedError


class Round(Footprint):
    """A disc, drawn out along the way from the last dab."""

    @property
    def inset(self) -> float:
        return self.core

    def distance(self, link: Link, rect: Rect, out: np.ndarray, spare: np.ndarray, more: np.ndarray):
        if not link.length:
            rows = np.arange(rect.row0, rect.row1) - link.row1
            cols = np.arange(rect.col0, rect.col1) - link.col1
            np.add((rows * rows).astype(np.float32)[:, None], (cols * cols).astype(np.float32)[None, :], out=out)
            np.sqrt(out, out=out)
            return _even(link)
        link.across(rect, spare)
        np.multiply(spare, spare, out=spare)
        pressure = _even(link)
        if link.pressure0 == link.pressure1:
            _beyond(link, rect, out, more)
        else:
            pressure = self._pressed(link, rect, out, spare, more)
        np.multiply(out, out, out=out)
        np.add(out, spare, out=out)
        np.sqrt(out, out=out)
        return pressure

    def _pressed(self, link: Link, rect: Rect, out: np.ndarray, across_2: np.ndarray, more: np.ndarray) -> np.ndarray:
        """Way past the place on the link that presses a cell hardest, into `out`; returns the pressure there.

        With rising pressure that isn't the nearest place but about the last that holds the cell in its core; taking the
        nearest one cuts a terrace a dab. A little into the fading part, pressure still gains on weight.
        """
        rises = (link.pressure1 - link.pressure0) / max(link.length, 1e-6)  # a shorter way overflows float32
        mean = (link.pressure0 + link.pressure1) / 2
        past = min(abs(rises) / max(mean, 1e-6) * self.soft**2 / 6, self.soft / 3)  # where d(p · w) = 0
        np.subtract(np.float32((self.core + past) ** 2), across_2, out=more)
        np.maximum(more, np.float32(past * past), out=more)
        np.sqrt(more, out=more)
        np.multiply(more, np.float32(math.copysign(1, rises)), out=more)
        link.along(rect, out)
        np.add(more, out, out=more)
        np.clip(more, 0, np.float32(link.length), out=more)
        np.subtract(out, more, out=out)
        np.multiply(more, np.float32(rises), out=more)
        return np.add(more, np.float32(link.pressure0), out=more)


class Strip(Footprint):
    """A strip with straight ends: full strength between its ends, fading beside and beyond them alike."""

    @property
    def reach(self) -> float:
        return math.hypot(self.radius, self.soft)

    def distance(self, link: Link, rect: Rect, out: np.ndarray, spare: np.ndarray, more: np.ndarray):
        _beyond(link, rect, out, more)
        np.multiply(out, out, out=out)
        link.across(rect, spare)
        np.abs(spare, out=spare)
        np.subtract(spare, np.float32(self.core), out=spare)
        np.maximum(spare, 0, out=spare)
        np.multiply(spare, spare, out=spare)
        np.add(out, spare, out=out)
        np.sqrt(out, out=out)
        if link.pressure0 == link.pressure1 or not link.length:
            return _even(link)
        np.multiply(more, np.float32((link.pressure1 - link.pressure0) / link.length), out=more)
        return np.add(more, np.float32(link.pressure0), out=more)


def _even(link: Link) -> np.float32 | None:
    return None if link.pressure1 == 1 else np.float32(link.pressure1)


def _beyond(link: Link, rect: Rect, out: np.ndarray, nearest: np.ndarray) -> None:
    """Cells past either end of a link, 0 between them, into `out`; the way to the nearest place into `nearest`."""
    link.along(rect, out)
    np.clip(out, 0, np.float32(link.length), out=nearest)
    np.subtract(out, nearest, out=out)
