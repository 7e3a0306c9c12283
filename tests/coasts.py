"""Small coasts that tests build on."""

import numpy as np
from shorewright.level import Grid, Level


def make_beach(rows=129, cols=161, cell_m=1.0, slope=0.06, rough_m=0.0, sway=0.0):
    """A planar beach rising to the north, the water line in the middle; optionally rough, its waves swaying."""
    north = np.arange(rows, dtype=np.float64)[:, None] * cell_m
    height = (north - north.mean()) * slope + np.zeros((1, cols))
    height += rough_m * np.random.default_rng(3).standard_normal(height.shape)
    level = Level(Grid(rows, cols, cell_m), height.astype(np.float32))
    level.set("shore.sway", sway)
    return level
