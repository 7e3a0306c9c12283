"""Where the player can go: wading depth and slope (the talk's navmesh view, D31)."""

from __future__ import annotations

import math

import numpy as np

from .grid import Rect
from .level import Level


def walkable(level: Level, rect: Rect | None = None) -> np.ndarray:
    """True `(rows, cols)` of `rect` where the still water is shallow enough to wade and the ground flat enough to walk.

    A change of height reaches one cell farther than itself.
    """
    walk, cell_m = level.settings.walk, level.grid.cell_m
    rect = level.grid.rect if rect is None else rect
    wide = level.grid.clip(rect.pad(1))
    height = level.height[wide.slices]
    north, east = np.gradient(height, cell_m)
    steepest = math.tan(math.radians(walk.slope_deg))
    dry = level.sea_level_m - height <= walk.depth_m
    here = dry & (north * north + east * east <= steepest * steepest)
    return here[rect.row0 - wide.row0 : rect.row1 - wide.row0, rect.col0 - wide.col0 : rect.col1 - wide.col0]
