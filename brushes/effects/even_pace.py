"""Keep the pace even (T07): within a dab the bed comes to run evenly along the way of the front.

A front by the depth's clock goes at a speed over the slope of the bed along its way, up the mean slope of the dab. So
what evens its speed is a straight bed from where that way enters the dab to where it leaves it.
"""

from __future__ import annotations

import numpy as np

from . import Effect
from .mean import cascade, mean_minus

MOST = 0.98  # of what is uneven that one dab takes
ENDS_OVER = 0.12  # radii: heights at both ends are means over this, or each pebble there would draw a line
LEAST_SLOPE = 1e-4  # a dab that is this flat has no way up


class EvenPace:
    """Of one stroke: `prepare` before a dab writes, then `change` for each piece of it."""

    def __init__(self, share: float, radius: float) -> None:
        self.share, self.radius = min(share, MOST), radius
        self.kept: np.ndarray | None = None

    def prepare(self, canvas, rect, link, base: bool = False, once: bool = False) -> None:
        """Look at the ground under a dab, as it is or (`base`) as the stroke found it; `once` for a lone dab."""
        radii = 2 * link.length / (2 * self.radius + link.length) if link.length and not once else 1.0
        self.rate = np.float32(1 - (1 - self.share) ** radii)
        self.rect, self.pull = rect, {}
        steps = cascade(ENDS_OVER * self.radius, min(canvas.data.grid.shape))
        border = sum(steps)
        for channel in canvas.channels:
            window = canvas.window(rect, border, channel, base=base)
            ground = window[border : border + rect.shape[0], border : border + rect.shape[1]].copy()
            mean = ground + mean_minus(window, steps)
            self.pull[channel] = _straight_minus(ground, mean, rect, link, self.radius)

    def change(self, piece) -> np.ndarray:
        """What is to be added under a piece of the dab, float32."""
        rows = slice(piece.rect.row0 - self.rect.row0, piece.rect.row1 - self.rect.row0)
        cols = slice(piece.rect.col0 - self.rect.col0, piece.rect.col1 - self.rect.col0)
        return self.pull[piece.channel][rows, cols] * piece.weight * self.rate

    def total(self, piece, shape: tuple[int, int]) -> np.ndarray:
        """All that a stroke's dabs have added under a piece, with this one: for effects that start from the base."""
        if self.kept is None:
            self.kept = np.zeros(shape, np.float32)
        there = self.kept[piece.rect.slices]
        there += self.change(piece)
        return there


def _straight_minus(ground, mean, rect, link, radius: float) -> np.ndarray:
    """The straight bed along the way minus the ground, of all cells of `rect`."""
    north, east = _way_up(mean)
    if np.hypot(north, east) < LEAST_SLOPE:
        return np.zeros(rect.shape, np.float32)
    length = np.hypot(north, east)
    north, east = north / length, east / length
    row, col = np.mgrid[rect.row0 : rect.row1, rect.col0 : rect.col1].astype(np.float64)
    enters, leaves = _chord(row, col, north, east, link, radius)
    low, high = (_bilinear(mean, row + at * north - rect.row0, col + at * east - rect.col0) for at in (enters, leaves))
    part = -enters / np.maximum(leaves - enters, 1e-6)
    return np.where(leaves > enters, low + (high - low) * part - ground, 0.0).astype(np.float32)


def _way_up(mean: np.ndarray) -> tuple[float, float]:
    """Mean rise per row and per column."""
    if min(mean.shape) < 2:
        return 0.0, 0.0
    return tuple(float(np.mean(np.diff(mean, axis=axis), dtype=np.float64)) for axis in (0, 1))


def _chord(row, col, north: float, east: float, link, radius: float) -> tuple[np.ndarray, np.ndarray]:
    """Cells along the way from each cell to where it enters and leaves what is `radius` round the link."""
    enters, leaves = np.full(row.shape, np.inf), np.full(row.shape, -np.inf)

    def take(first, last):
        hit = last > first
        np.minimum(enters, np.where(hit, first, np.inf), out=enters)
        np.maximum(leaves, np.where(hit, last, -np.inf), out=leaves)

    for end_row, end_col in ((link.row0, link.col0), (link.row1, link.col1)):
        off_row, off_col = row - end_row, col - end_col
        along = off_row * north + off_col * east
        inside = np.maximum(along * along - (off_row**2 + off_col**2 - radius * radius), 0.0)
        take(-along - np.sqrt(inside), -along + np.sqrt(inside))
    if link.length:
        to_row, to_col = link.heading
        off_row, off_col = row - link.row0, col - link.col0
        one = _slab(off_row * to_row + off_col * to_col, north * to_row + east * to_col, 0.0, link.length)
        other = _slab(off_col * to_row - off_row * to_col, east * to_row - north * to_col, -radius, radius)
        take(np.maximum(one[0], other[0]), np.minimum(one[1], other[1]))
    beyond = (enters > 0) | (leaves < 0)  # the cell itself is outside
    return np.where(beyond, 0.0, enters), np.where(beyond, 0.0, leaves)


def _slab(at: np.ndarray, by: float, low: float, high: float) -> tuple[np.ndarray, np.ndarray]:
    """From where to where `at + t · by` lies between two bounds."""
    if abs(by) < 1e-9:
        inside = (at >= low) & (at <= high)
        return np.where(inside, -np.inf, np.inf), np.where(inside, np.inf, -np.inf)
    one, other = (low - at) / by, (high - at) / by
    return np.minimum(one, other), np.maximum(one, other)


def _bilinear(values: np.ndarray, row: np.ndarray, col: np.ndarray) -> np.ndarray:
    rows, cols = values.shape
    row, col = np.clip(row, 0, rows - 1), np.clip(col, 0, cols - 1)
    row0, col0 = np.minimum(row.astype(int), max(rows - 2, 0)), np.minimum(col.astype(int), max(cols - 2, 0))
    row1, col1 = np.minimum(row0 + 1, rows - 1), np.minimum(col0 + 1, cols - 1)
    fr, fc = row - row0, col - col0
    south = values[row0, col0] * (1 - fc) + values[row0, col1] * fc
    return south * (1 - fr) + (values[row1, col0] * (1 - fc) + values[row1, col1] * fc) * fr


class Evens(Effect):
    """An effect that may keep the pace even: `even` is None unless the brush asks for it."""

    def begin(self, canvas, row: float, col: float) -> None:
        self.shape = canvas.data.grid.shape
        self.even = EvenPace(self.params.even_pace, self.footprint.radius) if self.params.even_pace else None

    def prepare(self, canvas, rect, link) -> None:
        if self.even:
            self.even.prepare(canvas, rect, link)
