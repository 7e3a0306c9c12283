"""Contour lines of a field as joined polylines: marching squares (Lorensen and Cline 1987, in two dimensions)."""

from __future__ import annotations

import numpy as np


def contours(values: np.ndarray, at: float, valid: np.ndarray) -> list[np.ndarray]:
    """Joined polylines `(n, 2)` (col, row) where a field `(rows, cols)` is `at`, in cells of four valid corners.

    The higher side lies to the left of the way; closed lines end where they begin.
    """
    high = values >= at
    cells = valid[:-1, :-1] & valid[1:, :-1] & valid[:-1, 1:] & valid[1:, 1:]
    case = high[:-1, :-1] + 2 * high[:-1, 1:] + 4 * high[1:, 1:] + 8 * high[1:, :-1]
    row, col = np.nonzero(cells & (case > 0) & (case < 15))
    if not row.size:
        return []
    start, end = _segments(values, at, case[row, col], row, col)
    points = _crossings(values, at, np.concatenate([start, end]))
    return [np.array([points[edge] for edge in chain]) for chain in _chains(start, end)]


# Sides of a cell: 0 south, 1 east, 2 north, 3 west. By case (bits: south-west, south-east, north-east, north-west high)
# the sides from and to which the line goes with the high side on its left.
SIDES = {
    1: ((0, 3),), 2: ((1, 0),), 3: ((1, 3),), 4: ((2, 1),), 6: ((2, 0),), 7: ((2, 3),), 8: ((3, 2),), 9: ((0, 2),),
    11: ((1, 2),), 12: ((3, 1),), 13: ((0, 1),), 14: ((3, 0),),
}  # fmt: skip
SADDLES = {5: (((0, 1), (2, 3)), ((0, 3), (2, 1))), 10: (((3, 0), (1, 2)), ((1, 0), (3, 2)))}  # middle high, low


def _segments(values, at: float, case, row, col) -> tuple[np.ndarray, np.ndarray]:
    """Edges (numbers of `_edge`) at which the line enters and leaves each cell."""
    cols = values.shape[1]
    middle = 0.25 * (values[row, col] + values[row + 1, col] + values[row, col + 1] + values[row + 1, col + 1]) >= at
    starts, ends = [], []

    def add(which, pairs) -> None:
        for a, b in pairs:
            starts.append(_edge(a, row[which], col[which], cols))
            ends.append(_edge(b, row[which], col[which], cols))

    for number, pairs in SIDES.items():
        add(case == number, pairs)
    for number, (inside, outside) in SADDLES.items():
        add((case == number) & middle, inside)
        add((case == number) & ~middle, outside)
    return np.concatenate(starts), np.concatenate(ends)


def _edge(side: int, row, col, cols: int) -> np.ndarray:
    """A number of a cell's side, the same for its neighbour: twice the sample it begins at, + 1 on the way north."""
    if side in (0, 2):
        return 2 * ((row + side // 2) * cols + col)
    return 2 * (row * cols + col + (side == 1)) + 1


def _crossings(values, at: float, edges: np.ndarray) -> dict[int, tuple[float, float]]:
    """Where the line crosses each edge, (col, row)."""
    edges = np.unique(edges)
    sample, north = edges // 2, edges % 2
    row, col = np.divmod(sample, values.shape[1])
    a, b = values[row, col].astype(np.float64), values[row + north, col + 1 - north].astype(np.float64)
    part = np.clip((at - a) / np.where(a == b, 1.0, b - a), 0, 1)
    x, y = col + part * (1 - north), row + part * north
    return dict(zip(edges.tolist(), zip(x.tolist(), y.tolist())))


def _chains(start: np.ndarray, end: np.ndarray) -> list[list[int]]:
    """Segments joined end to start; open ones first, from where nothing leads to them."""
    follows = dict(zip(start.tolist(), end.tolist()))
    heads = sorted(set(follows) - set(follows.values()))
    chains = []
    for head in [*heads, *sorted(follows)]:
        if head not in follows:
            continue
        chain = [head]
        while chain[-1] in follows:
            chain.append(follows.pop(chain[-1]))
        chains.append(chain)
    return chains
