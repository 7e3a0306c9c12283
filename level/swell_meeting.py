"""Lines where a swell meets itself from two directions: behind islands, and where first arrivals cross.

There T has a crease and one crest line would be drawn with a kink; the waves are faded instead.
"""

from __future__ import annotations

import numpy as np
from scipy import ndimage

KINK_FROM_DEG, KINK_FULL_DEG = 25.0, 60.0  # between neighbours' directions: refraction alone bends far less in a cell
WIDTH = 0.15  # of the deep wave's length: how far to each side of the line waves fade


def meeting(seconds: np.ndarray, reached: np.ndarray, cell_m: float, length_m: float) -> np.ndarray:
    """0 … 1, float32 (rows, cols): 1 on a crease of T, falling to 0 over a part of a wave's length."""
    late = np.where(reached, seconds, np.inf)
    dx, dy = _from_where(late, 1), _from_where(late, 0)
    size = np.hypot(dx, dy)
    size[size == 0] = 1.0
    dx, dy = (dx / size).astype(np.float32), (dy / size).astype(np.float32)
    kink = np.zeros(seconds.shape, np.float32)
    for axis, part in ((1, dx), (0, dy)):
        a, b = (slice(None),) * axis, (slice(None),) * (1 - axis)
        here, there = (*a, slice(None, -2), *b), (*a, slice(2, None), *b)
        # Only where they run towards each other: apart, they go round something.
        towards = (part[here] - part[there]) > 0
        dot = dx[here] * dx[there] + dy[here] * dy[there]
        both = reached[here] & reached[there] & towards
        angle = np.degrees(np.arccos(np.clip(dot, -1, 1)))
        x = np.clip((angle - KINK_FROM_DEG) / (KINK_FULL_DEG - KINK_FROM_DEG), 0, 1) * both
        middle = (*a, slice(1, -1), *b)
        kink[middle] = np.maximum(kink[middle], x * x * (3 - 2 * x))
    if not kink.any():
        return kink
    reach = max(1, round(WIDTH * length_m / cell_m))
    kink = ndimage.maximum_filter(kink, 2 * ((reach + 1) // 2) + 1)
    return ndimage.uniform_filter(kink, 2 * (reach // 2) + 1) * reached


def _from_where(late: np.ndarray, axis: int) -> np.ndarray:
    """Change of T along an axis from the earlier neighbour (upwind), with its sign; 0 where both are later."""
    back, ahead = np.full(late.shape, 0.0), np.full(late.shape, 0.0)
    first = (slice(None),) * axis
    lower, upper = (*first, slice(None, -1)), (*first, slice(1, None))
    with np.errstate(invalid="ignore"):
        step = late[upper] - late[lower]
    step = np.where(np.isfinite(step), step, 0.0)
    back[upper] = np.maximum(step, 0.0)
    ahead[lower] = np.maximum(-step, 0.0)
    return np.where(back >= ahead, back, -ahead)
