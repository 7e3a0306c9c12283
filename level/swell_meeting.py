"""Lines where a swell meets itself from two directions: behind islands, and where first arrivals cross.

There T has a crease and one crest line would be drawn with a kink; the waves are faded instead.
"""

from __future__ import annotations

import numpy as np
from scipy import ndimage

KINK_DEG = 35.0  # between the directions on both sides: refraction alone bends far less in two cells
LEAST_WAVES = 0.25  # length of a line in local wavelengths: behind a boulder waves close again
WIDTH_WAVES = 0.15  # how far to each side of the line waves fade


def meeting(seconds: np.ndarray, reached: np.ndarray, k: np.ndarray, cell_m: float) -> np.ndarray:
    """0 … 1, float32 (rows, cols): 1 on a crease of T, falling to 0 over a part of the wave's length 2 pi / k."""
    lines = _creases(seconds, reached)
    if lines.any():
        named, _ = ndimage.label(lines, np.ones((3, 3)))
        waves = np.bincount(named.ravel(), (k * cell_m / (2 * np.pi)).ravel())
        waves[0] = 0.0
        lines = (waves >= LEAST_WAVES)[named]
    if not lines.any():
        return np.zeros(seconds.shape, np.float32)
    away = ndimage.distance_transform_edt(~lines) * cell_m * k / (2 * np.pi * WIDTH_WAVES)
    x = np.clip(1 - away, 0, 1)
    return (x * x * (3 - 2 * x) * reached).astype(np.float32, order="C")


def _creases(seconds: np.ndarray, reached: np.ndarray) -> np.ndarray:
    """Bool: cells whose neighbours on two opposite sides run towards each other at an angle."""
    late = np.where(reached, seconds, np.inf)
    parts = {1: _from_earlier(late, 1), 0: _from_earlier(late, 0)}
    size = np.hypot(parts[0], parts[1])
    size[size == 0] = 1.0
    parts = {axis: part / size for axis, part in parts.items()}
    crease = np.zeros(seconds.shape, bool)
    for axis, part in parts.items():
        a, b = (slice(None),) * axis, (slice(None),) * (1 - axis)
        here, middle, there = ((*a, slice(i, i - 2 or None), *b) for i in (0, 1, 2))
        cosine = sum(p[here] * p[there] for p in parts.values())
        # Only where they close up: spreading, they go round something.
        crease[middle] |= (
            (cosine < np.cos(np.radians(KINK_DEG)))
            & (part[here] > part[there])
            & reached[here]
            & reached[middle]
            & reached[there]
        )
    return crease


def _from_earlier(late: np.ndarray, axis: int) -> np.ndarray:
    """Change of T along an axis from the earlier neighbour, with its sign; 0 where both are later."""
    first = (slice(None),) * axis
    lower, upper = (*first, slice(None, -1)), (*first, slice(1, None))
    with np.errstate(invalid="ignore"):
        step = late[upper] - late[lower]
    step = np.where(np.isfinite(step), step, 0.0)
    back, ahead = np.zeros(late.shape), np.zeros(late.shape)
    back[upper], ahead[lower] = np.maximum(step, 0.0), np.maximum(-step, 0.0)
    # Over the level's edge T goes on as it came.
    for edge, inner, side in ((0, 0, back), (-1, -1, ahead)):
        side[(*first, edge)] = np.maximum(step[(*first, inner)] * (1 if side is back else -1), 0.0)
    return np.where(back >= ahead, back, -ahead)
