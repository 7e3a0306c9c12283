"""Where the player can go: wading depth and slope (the talk's navmesh view, D31), whatever the tide."""

from __future__ import annotations

import math

import numpy as np

from .grid import Rect
from .level import Level

STEEP_M = -1e9  # no sea is so low


def walkable(level: Level, rect: Rect | None = None) -> np.ndarray:
    """True `(rows, cols)` of `rect` where the still water is shallow enough to wade and the ground flat enough to walk.

    A change of height reaches one cell farther than itself.
    """
    rect = level.grid.rect if rect is None else rect
    height, flat = _flat(level, rect)
    return flat & (level.sea_level_m - height <= level.settings.walk.depth_m)


def highest_sea_m(level: Level, rect: Rect) -> np.ndarray:
    """Float32 `(rows, cols)` of `rect`: up to which height of the still sea one walks there; STEEP_M where never."""
    height, flat = _flat(level, rect)
    return np.where(flat, height + np.float32(level.settings.walk.depth_m), np.float32(STEEP_M))


def _flat(level: Level, rect: Rect) -> tuple[np.ndarray, np.ndarray]:
    """The ground of `rect`, and where it is flat enough."""
    walk, cell_m = level.settings.walk, level.grid.cell_m
    wide = level.grid.clip(rect.pad(1))
    height = level.height[wide.slices]
    north, east = np.gradient(height, cell_m)
    steepest = math.tan(math.radians(walk.slope_deg))
    inner = rect.shifted(wide).slices
    return height[inner], (north * north + east * east <= steepest * steepest)[inner]
