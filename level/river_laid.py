"""Where the samples of a grid lie along a river's line: the nearest point, metres across and along (D13)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from .river_line import Line

BESIDE = 4  # points of the line either side of the first guess among which the nearest is looked for


@dataclass(frozen=True)
class NearLine:
    """The samples of a grid that a line is near to, arrays `(n,)`.

    `nearest`: which of its points; `off_m`: metres from it; `ahead_m`: metres along, beyond that point.
    """

    row: np.ndarray
    col: np.ndarray
    nearest: np.ndarray
    off_m: np.ndarray
    ahead_m: np.ndarray


@dataclass(frozen=True)
class Laid:
    """The same on a window of a grid, arrays `(rows, cols)`; but where it is `near` they mean nothing."""

    rows: slice
    cols: slice
    nearest: np.ndarray
    off_m: np.ndarray
    ahead_m: np.ndarray
    near: np.ndarray


def along(line: Line, shape: tuple[int, int], cell_m: float, beyond_m: float) -> Laid:
    """Where the samples of a window lie along a line, up to `beyond_m` past its width."""
    window = _window(line, shape, cell_m, beyond_m)
    found = near_line(line, shape, cell_m, beyond_m)
    size = tuple(part.stop - part.start for part in window)
    at = found.row - window[0].start, found.col - window[1].start
    laid = Laid(*window, np.zeros(size, np.int64), np.full(size, np.inf), np.zeros(size), np.zeros(size, bool))
    laid.nearest[at], laid.off_m[at], laid.ahead_m[at], laid.near[at] = found.nearest, found.off_m, found.ahead_m, True
    return laid


def near_line(line: Line, shape: tuple[int, int], cell_m: float, beyond_m: float) -> NearLine:
    """The samples within a line's half width and `beyond_m`.

    A distance transform says about which point is the nearest, then it and those beside it are measured: done much
    sooner than with a search tree, for a drag asks every frame.
    """
    row, col, guess = _guessed(line, _window(line, shape, cell_m, beyond_m), cell_m, beyond_m)
    x, y, last = col * cell_m, row * cell_m, len(line.x) - 1
    nearest, squared = guess, np.full(len(guess), np.inf)
    for step in range(-BESIDE, BESIDE + 1):
        at = np.clip(guess + step, 0, last)
        away = np.square(x - line.x[at]) + np.square(y - line.y[at])
        nearest = np.where(away < squared, at, nearest)
        squared = np.minimum(away, squared)
    off_m = np.sqrt(squared)
    near = off_m <= line.half_m[nearest] + beyond_m
    row, col, nearest, off_m, x, y = (v[near] for v in (row, col, nearest, off_m, x, y))
    way = np.stack([np.gradient(line.x), np.gradient(line.y)])
    way /= np.maximum(np.hypot(*way), 1e-9)
    ahead_m = (x - line.x[nearest]) * way[0][nearest] + (y - line.y[nearest]) * way[1][nearest]
    return NearLine(row, col, nearest, off_m, ahead_m)


def _window(line: Line, shape: tuple[int, int], cell_m: float, beyond_m: float) -> tuple[slice, slice]:
    reach = float(line.half_m.max()) + beyond_m
    low = [int(np.clip((v.min() - reach) // cell_m, 0, n)) for v, n in zip((line.y, line.x), shape, strict=True)]
    high = [int(np.clip((v.max() + reach) // cell_m + 2, 0, n)) for v, n in zip((line.y, line.x), shape, strict=True)]
    rows, cols = (slice(a, max(b, a)) for a, b in zip(low, high, strict=True))
    return rows, cols


def _guessed(line: Line, window: tuple[slice, slice], cell_m: float, beyond_m: float) -> tuple[np.ndarray, ...]:
    """(row, col, point of the line in the nearest of its cells) of samples that may be within reach."""
    row0, col0 = (part.start for part in window)
    size = tuple(part.stop - part.start for part in window)
    if 0 in size:
        return tuple(np.zeros(0, np.int64) for _ in range(3))
    row = np.clip(np.rint(line.y / cell_m).astype(np.int64) - row0, 0, size[0] - 1)
    col = np.clip(np.rint(line.x / cell_m).astype(np.int64) - col0, 0, size[1] - 1)
    point = np.full(size, -1, np.int64)
    point[row, col] = np.arange(len(line.x))
    from_row, from_col = ndimage.distance_transform_edt(point < 0, return_distances=False, return_indices=True)
    guess = point[from_row, from_col]
    y, x = (np.arange(part.start, part.stop) * cell_m for part in window)
    reach = line.half_m[guess] + beyond_m + 2 * cell_m
    near = np.square(x - line.x[guess]) + np.square(y[:, None] - line.y[guess]) <= np.square(reach)
    row, col = np.nonzero(near)
    return row + row0, col + col0, guess[near]
