"""Where rain stays: the hollows of the ground, filled to the lowest place at which they run over.

Filled is the lowest of all ways' highest places to where water leaves, the border, the sea and rivers: the grey-scale
reconstruction of `bottleneck.py` upside down (as in terrain analysis: L. Wang and H. Liu 2006).
"""

from __future__ import annotations

import numpy as np

from .bottleneck import bottleneck
from .level import Level
from .river_map import has_rivers, river_map

MOST_ROUNDS = 10_000  # of sweeps: as many as it takes


def filled_m(ground: np.ndarray, water: np.ndarray) -> np.ndarray:
    """Float32 `(rows, cols)`: the ground with its hollows full. `water` stands there already and carries rain away, NaN
    where there is none; so does the border.
    """
    upside_down = -np.fmax(ground, water)
    leaves = np.isfinite(water)
    leaves[[0, -1]] = leaves[:, [0, -1]] = True
    return -bottleneck(np.where(leaves, upside_down, np.float32(-np.inf)), upside_down, MOST_ROUNDS)


def puddles_m(level: Level, every: int = 1) -> np.ndarray:
    """Depth of the water where rain has filled every hollow, float32, at every so many samples `(rows, cols)`.

    0 where sea or river stand, and as much less as is painted in `puddle_keepout`.
    """
    skip = slice(None, None, every)
    ground = level.height[skip, skip].astype(np.float32)
    water = np.where(ground <= level.sea_level_m, np.float32(level.sea_level_m), np.float32(np.nan))
    if has_rivers(level):
        cell_m = every * level.grid.cell_m
        x, y = np.meshgrid(np.arange(ground.shape[1]) * cell_m, np.arange(ground.shape[0]) * cell_m)
        river = river_map(level).at(x, y)
        stage = (level.mean_sea_m + river["stage"].v).astype(np.float32)
        water = np.where((river["share"].v >= 0.5) & (stage > ground), np.fmax(stage, water), water)
    depth = np.where(np.isnan(water), filled_m(ground, water) - ground, 0)
    keepout = level.layers["puddle_keepout"]
    return depth if keepout.neutral else depth * (1 - np.clip(keepout.array[skip, skip], 0, 1))
