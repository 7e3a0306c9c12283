"""The bottleneck depth: over all ways from the sea to a cell, the largest least depth.

A front passes a bar once because behind it this never grows again: the grey-scale reconstruction of the depth from
cells where the sea begins, by sweeps in four directions (L. Vincent 1993, sequential reconstruction).
"""

from __future__ import annotations

import numpy as np

ROUNDS = 60  # of four sweeps; two or three are enough for coasts, a maze of walls is cut short here


def bottleneck(marker: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """Reconstruction of `depth` from `marker`, float32 `(rows, cols)`; -inf where no way leads."""
    least, floor = _framed(np.minimum(marker, depth)), _framed(depth)
    floor_turned = np.ascontiguousarray(floor.T)
    for _ in range(ROUNDS):
        _sweep(least, floor)
        turned = np.ascontiguousarray(least.T)  # rows that lie together in memory sweep three times as fast
        _sweep(turned, floor_turned)
        least[:] = turned.T
        if not _rises(least, floor):
            break
    return least[1:-1, 1:-1].copy()


def _framed(values: np.ndarray) -> np.ndarray:
    """The values with a border of one cell that leads nowhere."""
    framed = np.full((values.shape[0] + 2, values.shape[1] + 2), -np.inf, np.float32)
    framed[1:-1, 1:-1] = values
    return framed


def _sweep(least: np.ndarray, floor: np.ndarray) -> None:
    """Carry depths from row to row, down and up again, in place."""
    west, here, east = list(least[:, :-2]), list(least[:, 1:-1]), list(least[:, 2:])
    floor = list(floor[:, 1:-1])
    came = np.zeros_like(here[0])
    maximum, minimum, last = np.maximum, np.minimum, len(here) - 1
    for rows in (range(1, last), range(last - 1, 0, -1)):
        before = rows.start - rows.step
        for row in rows:
            maximum(west[before], east[before], out=came)
            maximum(came, here[before], out=came)
            maximum(came, here[row], out=came)
            minimum(came, floor[row], out=here[row])
            before = row


def _rises(least: np.ndarray, floor: np.ndarray) -> bool:
    """Whether some cell could still be reached by a deeper way."""
    came = np.maximum(np.maximum(least[:-2], least[2:]), least[1:-1])
    came = np.maximum(np.maximum(came[:, :-2], came[:, 2:]), came[:, 1:-1])
    return bool((np.minimum(came, floor[1:-1, 1:-1]) > least[1:-1, 1:-1]).any())
