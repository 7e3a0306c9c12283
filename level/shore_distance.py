"""Signed distance to the still shoreline, in cells (H11): positive in the sea, negative on land and ponds.

The shoreline is the zero contour of the bilinear depth. Up to NEAR cells off, the distance is to its segments; farther
off to the points where it crosses the grid's lines, at most 0.71 cells from the nearest point of a segment, by which it
is too long by 0.25 / (2 · NEAR) cells at most. Points are spread as in the exact distance transform of Felzenszwalb &
Huttenlocher (2012): first along a line, then the least parabola across lines, cut off at a reach. So a value depends
on nothing farther away than that, and a window has the very bits of the whole.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator

import numpy as np
from scipy import ndimage

from .grid import Rect
from .request import finished

NEAR = 4  # cells round a segment that measure their distance to it
TILE_CELLS = 64, 256  # what is worked on at once: fits the processor's second cache
EIGHT = np.ones((3, 3), bool)


def joined_water(wet: np.ndarray, start: np.ndarray) -> np.ndarray:
    """True `(rows, cols)` in water that cells of `start` reach, over corners too."""
    labels, count = ndimage.label(wet, EIGHT)
    reached = np.zeros(count + 1, bool)
    reached[labels[start]] = True
    reached[0] = False
    return reached[labels]


def signed_distance(depth: np.ndarray, sea: np.ndarray, reach: int, inner: Rect) -> np.ndarray:
    """Cells to the shoreline at the cells of `inner`, between −reach and reach, float32.

    `depth` is positive where `sea` is True, and not where a neighbour of such a cell is False.
    """
    return finished(distance_in_parts(depth, sea, reach, inner))


def distance_in_parts(
    depth: np.ndarray, sea: np.ndarray, reach: int, inner: Rect
) -> Generator[None, None, np.ndarray]:  # fmt: skip
    """`signed_distance` as a work that pauses; the arrays must stay as they are till it is done."""
    near = inner.pad(NEAR + 1).intersect(Rect(0, 0, *sea.shape))
    squared = _to_segments(depth[near.slices], sea[near.slices])
    squared = np.ascontiguousarray(squared[inner.shifted(near).slices])
    yield
    rows, cols = inner.slices
    along = _along_columns(depth, sea, reach)[rows]
    yield
    yield from _spread(squared, along, reach, cols.start, axis=1)
    across = _along_columns(np.ascontiguousarray(depth.T), np.ascontiguousarray(sea.T), reach)
    yield
    yield from _spread(squared, np.ascontiguousarray(across[cols].T), reach, rows.start, axis=0)
    distance = np.minimum(np.sqrt(squared, out=squared), np.float32(reach), out=squared)
    return np.where(sea[inner.slices], distance, -distance)


def _along_columns(depth: np.ndarray, sea: np.ndarray, reach: int) -> np.ndarray:
    """Square of the distance to the nearest crossing in the same column; inf beyond the reach."""
    above = np.full((depth.shape[0] - 1, depth.shape[1]), np.inf, np.float32)  # from the lower end of an edge
    below = above.copy()
    crossed = sea[:-1] != sea[1:]
    part = _crossing(depth[:-1][crossed], depth[1:][crossed])
    above[crossed], below[crossed] = part, 1 - part
    nearest = np.empty(depth.shape, np.float32)
    run = np.full(depth.shape[1], np.inf, np.float32)
    nearest[0] = run
    for row in range(1, len(nearest)):
        run += 1
        nearest[row] = np.minimum(run, below[row - 1], out=run)
    run[:] = np.inf
    for row in range(len(nearest) - 2, -1, -1):
        run += 1
        np.minimum(run, above[row], out=run)
        np.minimum(nearest[row], run, out=nearest[row])
    nearest[nearest > reach] = np.inf
    return np.multiply(nearest, nearest, out=nearest)


def _crossing(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Where between two depths of opposite sign the bed meets the level of the sea, 0 … 1."""
    return first / (first - second)


def _spread(squared: np.ndarray, along: np.ndarray, reach: int, first: int, axis: int) -> Iterator[None]:
    """Take in the least of `along` plus the square of the way along `axis`, in place, tile by tile.

    `along` is longer on that axis: cell 0 of `squared` is its cell `first`.
    """
    rows, cols = squared.shape
    high, wide = TILE_CELLS
    for row in range(0, rows, high):
        for col in range(0, cols, wide):
            tile = [slice(row, min(row + high, rows)), slice(col, min(col + wide, cols))]
            around = list(tile)
            begin, end = tile[axis].start + first - reach, tile[axis].stop + first + reach
            around[axis] = slice(max(begin, 0), end)
            source = along[tuple(around)]
            if np.isfinite(source.min()):
                pad = [(0, 0), (0, 0)]
                pad[axis] = max(-begin, 0), max(end - along.shape[axis], 0)
                _least(squared[tuple(tile)], np.pad(source, pad, constant_values=np.inf), reach, axis)
                yield


def _least(squared: np.ndarray, source: np.ndarray, reach: int, axis: int) -> None:
    least, tried = squared.copy(), np.empty_like(squared)
    long = squared.shape[axis]
    known = np.concatenate([[0], np.cumsum(np.isfinite(source.min(axis=1 - axis)))]).tolist()
    for way in range(reach + 1):
        ahead, back = slice(reach + way, reach + way + long), slice(reach - way, reach - way + long)
        if known[ahead.stop] == known[ahead.start] and known[back.stop] == known[back.start]:
            continue
        if way % 8 == 0 and way * way >= least.max():
            break
        both = (source[ahead], source[back]) if axis == 0 else (source[:, ahead], source[:, back])
        np.minimum(*both, out=tried)
        tried += way * way
        np.minimum(least, tried, out=least)
    squared[:] = least


def _to_segments(depth: np.ndarray, sea: np.ndarray) -> np.ndarray:
    """Square of the distance to the shoreline's segments, at cells within NEAR of their quad; inf elsewhere."""
    rows, cols = depth.shape
    framed = np.full((rows + 2 * NEAR, cols + 2 * NEAR), np.inf, np.float32)
    flat, width = framed.reshape(-1), framed.shape[1]
    for row, col, (ax, ay, bx, by) in _segments(depth, sea):
        ex, ey = bx - ax, by - ay
        length2 = np.maximum(ex * ex + ey * ey, np.float32(1e-12))
        corner = (row + NEAR) * width + col + NEAR
        for y in range(-NEAR, NEAR + 2):
            for x in range(-NEAR, NEAR + 2):
                dx, dy = x - ax, y - ay
                along = np.clip((dx * ex + dy * ey) / length2, 0, 1)
                dx -= along * ex
                dy -= along * ey
                at = corner + (y * width + x)
                # no cell comes twice: one segment a quad in each round
                flat[at] = np.minimum(flat[at], dx * dx + dy * dy)
    return np.ascontiguousarray(framed[NEAR:-NEAR, NEAR:-NEAR])


def _segments(depth: np.ndarray, sea: np.ndarray):
    """Rounds of (row, column, ends x, y, x, y within the quad): marching squares, saddles as a bilinear bed has."""
    corners = sea[:-1, :-1].astype(np.int8) + sea[:-1, 1:] + sea[1:, :-1] + sea[1:, 1:]
    row, col = np.nonzero((corners > 0) & (corners < 4))
    at = [(row, col), (row, col + 1), (row + 1, col), (row + 1, col + 1)]
    d00, d01, d10, d11 = (depth[place] for place in at)
    s00, s01, s10, s11 = (sea[place] for place in at)
    zero, one = np.zeros_like(d00), np.ones_like(d00)
    edges = ((s00 != s01, d00, d01), (s10 != s11, d10, d11), (s00 != s10, d00, d10), (s01 != s11, d01, d11))
    there = np.stack([crossed for crossed, _, _ in edges])
    south, north, west, east = (_crossing(np.where(c, a, 1), np.where(c, b, 0)) for c, a, b in edges)
    x, y = np.stack([south, north, zero, one]), np.stack([zero, one, west, east])
    first, last = there.argmax(axis=0), 3 - there[::-1].argmax(axis=0)
    saddle = there.all(axis=0)
    # of a saddle, south meets east or west; the other two are the second segment
    to_east = d00 * d11 > d01 * d10
    first = np.where(saddle, 0, first)
    last = np.where(saddle, np.where(to_east, 3, 2), last)
    every = np.arange(len(row))
    yield row, col, (x[first, every], y[first, every], x[last, every], y[last, every])
    every = np.flatnonzero(saddle)
    other = np.where(to_east[every], 2, 3)
    if len(every):
        yield row[every], col[every], (x[1, every], y[1, every], x[other, every], y[other, every])
