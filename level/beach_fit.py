"""Vertices that the beach mesh needs besides its rows, where rock and cliff would stick through the sand (H03).

Greedy insertion (Garland and Heckbert 1995): where a triangle misses the ground by more than allowed, the worst sample
within it becomes a vertex, round after round.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.spatial import cKDTree

from .level import Level
from .pick import ground_at
from .triangle_samples import samples_within

ROUNDS = 40
LEAST_M = 1.5  # no new vertex nearer to another
MOST = 60_000  # vertices in all
OfPlaces = Callable[[np.ndarray], np.ndarray]  # of places (n, 2)


def fitted(level: Level, xy: np.ndarray, triangles: OfPlaces, free: OfPlaces, apart: Callable) -> np.ndarray:
    """`xy` `(n, 2)` and what is added to it, so that `triangles(xy)` miss the ground by `beach_mesh.error_m` at most.

    Only where places are `free(xy)` and stay `apart(new, old, least_m)`: a cliff is as steep as that allows.
    """
    error_m, least_m = level.settings.beach_mesh.error_m, max(LEAST_M, level.grid.cell_m)
    for _ in range(ROUNDS):
        which, place, off_m = misses(level, xy, triangles(xy))
        over = np.flatnonzero(off_m > error_m)
        over = over[free(place[over])]
        over = over[cKDTree(xy).query(place[over])[0] >= least_m]
        order = over[np.lexsort((-off_m[over], which[over]))]
        worst = order[np.unique(which[order], return_index=True)[1]]
        worst = worst[np.argsort(-off_m[worst], kind="stable")][: max(MOST - len(xy), 0)]
        added = apart(place[worst], xy, least_m)
        if not len(added):
            break
        xy = np.concatenate([xy, added])
    return xy


def misses(level: Level, xy: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of every sample of the ground in a triangle: which it is in, its place `(k, 2)`, how far that misses it, m."""
    cell_m = level.grid.cell_m
    which, row, col, share = samples_within(xy[triangles] / cell_m, level.grid.shape)
    over = (ground_at(level, *xy.T)[triangles[which]] * share).sum(1)
    return which, np.stack([col, row], -1) * cell_m, np.abs(over - level.height[row, col])
