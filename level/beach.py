"""The beach without rocks (H10): what the sheet of water slides up on.

Bumps narrower than STONE_M that stand over the sand round them are taken off by a grey-scale opening (Serra 1982), done
twice: first on the bed, then on what differs from the broad shape the first one left, so that the ground under a rock
on a slope goes on sloping. Where nothing stands out the ground is kept as it is.
"""

from __future__ import annotations

import math

import numpy as np
from scipy import ndimage

from .grid import Rect

STONE_M = 8.0  # wider things are part of the beach
TREND_M = 4.0  # sigma of the broad shape
SMOOTH_M = 0.8  # sigma of the light smoothing at the end
KEPT_M, TAKEN_M = 0.06, 0.3  # a bump up to the first is ripples and berms, from the second on a stone
TRUNCATE = 3.0


def beach_reach(cell_m: float) -> int:
    """Cells round a sample that its beach height depends on."""
    half = _half(cell_m)
    smooths = sum(_radius(sigma, cell_m) for sigma in (TREND_M, SMOOTH_M))
    return 4 * half + smooths


def bare_beach(height: np.ndarray, rect: Rect, cell_m: float) -> np.ndarray:
    """Ground of `rect` without stones, float32 metres; the level's edge is continued by its slope."""
    ground = _window(height, rect, beach_reach(cell_m))
    size = 2 * _half(cell_m) + 1
    trend = ndimage.gaussian_filter(_opened(ground, size), TREND_M / cell_m, mode="nearest", truncate=TRUNCATE)
    rest = ground - trend
    bump = rest - _opened(rest, size)
    part = np.clip((bump - KEPT_M) / (TAKEN_M - KEPT_M), 0, 1)
    bare = ground - bump * (part * part * (3 - 2 * part))
    bare = ndimage.gaussian_filter(bare, SMOOTH_M / cell_m, mode="nearest", truncate=TRUNCATE)
    reach = beach_reach(cell_m)
    return bare[reach : reach + rect.shape[0], reach : reach + rect.shape[1]]


def _half(cell_m: float) -> int:
    return round(STONE_M / 2 / cell_m)


def _radius(sigma_m: float, cell_m: float) -> int:
    return math.ceil(TRUNCATE * sigma_m / cell_m) + 1


def _opened(values: np.ndarray, size: int) -> np.ndarray:
    if size == 1:
        return values
    for axis in (0, 1):
        values = ndimage.minimum_filter1d(values, size, axis, mode="nearest")
    for axis in (0, 1):
        values = ndimage.maximum_filter1d(values, size, axis, mode="nearest")
    return values


def _window(height: np.ndarray, rect: Rect, reach: int) -> np.ndarray:
    """Samples of `rect` and `reach` cells round it; beyond the level mirrored in the edge's height."""
    rows, cols = height.shape
    wide = rect.pad(reach)
    inside = wide.intersect(Rect(0, 0, rows, cols))
    pad = [(inside.row0 - wide.row0, wide.row1 - inside.row1), (inside.col0 - wide.col0, wide.col1 - inside.col1)]
    return np.pad(height[inside.slices], pad, mode="reflect", reflect_type="odd")
