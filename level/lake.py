"""Water filled in up to a level: lakes, ponds and pools at any height (D13, H32)."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from .bottleneck import bottleneck
from .errors import BadInput
from .grid import Rect
from .level import Level


def basin(level: Level, x: float, y: float, level_m: float) -> tuple[Rect, np.ndarray]:
    """The cells that fill up to a level from a world place, and their rectangle with a cell round it, bool.

    BadInput where the ground is dry at that level, or the water would run out of the level or into the sea.
    """
    grid, ground = level.grid, level.height
    row, col = grid.nearest(x, y)
    if ground[row, col] >= level_m:
        raise BadInput(f"the ground here is at {ground[row, col]:.2f} m, over the water's {level_m:.2f} m")
    labels, _ = ndimage.label(ground < level_m)
    inside = labels == labels[row, col]
    rows, cols = np.flatnonzero(inside.any(axis=1)), np.flatnonzero(inside.any(axis=0))
    rect = Rect(int(rows[0]), int(cols[0]), int(rows[-1]) + 1, int(cols[-1]) + 1)
    if rect.row0 == 0 or rect.col0 == 0 or rect.row1 == grid.rows or rect.col1 == grid.cols:
        raise BadInput(f"water at {level_m:.2f} m would run out of the level: take a lower one, or raise the rim")
    if (ground[inside] < level.mean_sea_m).any() and level_m > level.mean_sea_m and _joins_sea(level, inside):
        raise BadInput(f"water at {level_m:.2f} m would run into the sea: take a lower one, or raise the rim")
    rect = grid.clip(rect.pad(1))
    return rect, inside[rect.slices]


def brim_m(level: Level, x: float, y: float) -> float:
    """The level at which water from a world place would begin to run out of the level or into the sea, m."""
    grid, ground = level.grid, level.height
    row, col = grid.nearest(x, y)
    out = np.zeros(ground.shape, bool)
    out[0], out[-1], out[:, 0], out[:, -1] = True, True, True, True
    out |= ground < level.mean_sea_m
    return -float(bottleneck(np.where(out, -ground, -np.inf).astype(np.float32), -ground)[row, col])


def _joins_sea(level: Level, inside: np.ndarray) -> bool:
    from .shore import shore_map

    made = shore_map(level, now=True)
    sea = (made.packed[..., 1] > 0) & (made.packed[..., 2] > 0)
    return bool((sea & inside[:: made.stride, :: made.stride]).any())
