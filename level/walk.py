"""Where the player can go: wading depth and slope (the talk's navmesh view, D31)."""

from __future__ import annotations

import numpy as np

from .level import Level


def slope_deg(height: np.ndarray, cell_m: float) -> np.ndarray:
    """Steepness of the ground at every sample, degrees `(rows, cols)`, by central differences."""
    north, east = np.gradient(height.astype(np.float64), cell_m)
    return np.degrees(np.arctan(np.hypot(north, east)))


def walkable(level: Level) -> np.ndarray:
    """True `(rows, cols)` where the still water is shallow enough to wade and the ground flat enough to walk."""
    walk = level.settings.walk
    depth = level.sea_level_m - level.height
    return (depth <= walk.depth_m) & (slope_deg(level.height, level.grid.cell_m) <= walk.slope_deg)
