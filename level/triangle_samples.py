"""Samples of a grid that lie within triangles."""

from __future__ import annotations

import numpy as np


def samples_within(corners: np.ndarray, shape: tuple[int, int]) -> tuple[np.ndarray, ...]:
    """Of anticlockwise triangles `(m, 3, 2)`, in samples: (triangle, row, column, share of each corner `(k, 3)`) of
    every sample of a grid of `shape` in them; on an edge of two it is in both.
    """
    which, row, col = _boxes(corners, shape)
    point = np.stack([col, row], -1)
    shares = []
    for k in range(3):
        a, b, c = (corners[which, (k + n) % 3] for n in (1, 2, 0))
        way, to, height = b - a, point - a, c - a
        over = way[:, 0] * to[:, 1] - way[:, 1] * to[:, 0]
        shares.append(over / (way[:, 0] * height[:, 1] - way[:, 1] * height[:, 0]))
    share = np.stack(shares, -1)
    inside = share.min(1) >= -1e-6
    return which[inside], row[inside], col[inside], share[inside]


def _boxes(corners: np.ndarray, shape: tuple[int, int]) -> tuple[np.ndarray, ...]:
    """(triangle, row, column) of every sample in the boxes round triangles."""
    low = np.ceil(corners.min(1) - 1e-6).astype(int)
    size = np.floor(corners.max(1) + 1e-6).astype(int) - low + 1
    count = size.prod(1)
    which = np.repeat(np.arange(len(corners)), count)
    at = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
    row, col = low[which, 1] + at // size[which, 0], low[which, 0] + at % size[which, 0]
    there = (row >= 0) & (row < shape[0]) & (col >= 0) & (col < shape[1])
    return which[there], row[there], col[there]
