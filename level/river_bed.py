"""The ground that a river needs: a bed under its water, banks that hold it, valley sides that don't overhang (D13)."""

from __future__ import annotations

import numpy as np

from .grid import Rect
from .level import Level
from .objects import River
from .river_line import centre_line
from .river_map import along

BANK_RISE_M = 0.35  # a bank stands so far over the water
BANK_M = 1.5  # over this way it gets there
SIDE_SLOPE = 0.7  # of a valley that is cut
DAM_SLOPE = 0.35  # of a dam that is filled
REACH_M = 40.0  # farther away nothing is moved


def carved(level: Level, river: River) -> tuple[Rect, np.ndarray]:
    """The ground round a river with its bed, float32 of the rectangle's shape: cut where it is too high, filled where
    the water would run out; over the sea only cut.
    """
    grid, sea_m = level.grid, level.mean_sea_m
    line = centre_line(river, sea_m, min(grid.cell_m, 1.0))
    laid = along(line, grid.shape, grid.cell_m, REACH_M)
    rect = Rect(laid.rows.start, laid.cols.start, laid.rows.stop, laid.cols.stop)
    ground = level.height[rect.slices].astype(np.float64)
    i = laid.nearest
    half_m, water_m, off_m = line.half_m[i], line.level_m[i], laid.off_m
    inside = np.clip(off_m / half_m, 0, 1)
    bed_m = water_m - river.depth_m * (1 - inside * inside)
    out_m = np.maximum(off_m - half_m, 0)
    rise_m = np.clip(water_m - sea_m, 0, BANK_RISE_M)  # none at the sea: a beach needs no dam
    bank_m = water_m + rise_m * np.clip(out_m / BANK_M, 0, 1)
    beyond_m = np.maximum(out_m - BANK_M, 0)
    low, high = bank_m - DAM_SLOPE * beyond_m, bank_m + SIDE_SLOPE * beyond_m
    made = np.where(off_m < half_m, np.minimum(ground, bed_m), np.minimum(ground, high))
    hold = (off_m >= half_m) & (i < line.mouth) & (low > sea_m) & (ground > sea_m)
    beach = np.clip((ground - sea_m) / BANK_RISE_M, 0, 1)  # banks run out on it
    made = np.where(hold, np.maximum(made, ground + np.maximum(low - ground, 0) * beach), made)
    fill = (off_m < half_m) & (i < line.mouth) & (ground < bed_m) & (bed_m > sea_m)  # no river over an abyss
    made = np.where(fill, bed_m, made)
    return rect, np.where(laid.near, made, ground).astype(np.float32)
