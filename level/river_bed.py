"""The ground that a river needs: a bed under its water, banks that hold it, valley sides that don't overhang (D13)."""

from __future__ import annotations

import numpy as np

from .grid import Rect
from .level import Level
from .objects import River
from .river_join import line_of, own_line, rivers
from .river_laid import along

BANK_RISE_M = 0.35  # a bank stands so far over the water
BANK_M = 1.5  # over this way it gets there
SIDE_SLOPE = 0.7  # of a valley that is cut
DAM_SLOPE = 0.35  # of a dam that is filled
REACH_M = 40.0  # farther away nothing is moved
FALL_M = 4.0  # banks stand as high as the water up to so far upstream: they hold a fall's lip


def carved(level: Level, river: River) -> tuple[Rect, np.ndarray]:
    """The ground round a river with its bed, float32 of the rectangle's shape: cut where it is too high, filled where
    the water would run out; over the sea and in other water only cut.
    """
    from scipy.ndimage import maximum_filter1d

    grid, sea_m = level.grid, level.mean_sea_m
    line = line_of(level, river, min(grid.cell_m, 1.0))
    laid = along(line, grid.shape, grid.cell_m, REACH_M)
    rect = Rect(laid.rows.start, laid.cols.start, laid.rows.stop, laid.cols.stop)
    ground = level.height[rect.slices].astype(np.float64)
    i = laid.nearest
    half_m, off_m = line.half_m[i], laid.off_m
    other_m = _other_water(level, river, rect)
    water_m = np.minimum(line.level_m[i], other_m)
    inside = np.clip(off_m / half_m, 0, 1)
    bed_m = water_m - river.depth_m * (1 - inside * inside)
    out_m = np.maximum(off_m - half_m, 0)
    step_m = max(float(line.along_m[1] - line.along_m[0]), 1e-3)
    held_m = maximum_filter1d(line.level_m, 2 * max(round(FALL_M / step_m), 1) + 1)[i]
    rise_m = np.clip(held_m - sea_m, 0, BANK_RISE_M)  # none at the sea: a beach needs no dam
    bank_m = held_m + rise_m * np.clip(out_m / BANK_M, 0, 1)
    beyond_m = np.maximum(out_m - BANK_M, 0)
    low, high = bank_m - DAM_SLOPE * beyond_m, bank_m + SIDE_SLOPE * beyond_m
    made = np.where(off_m < half_m, np.minimum(ground, bed_m), np.minimum(ground, high))
    dry = (i < line.mouth) & np.isinf(other_m)
    hold = (off_m >= half_m) & dry & (low > sea_m) & (ground > sea_m)
    beach = np.clip((ground - sea_m) / BANK_RISE_M, 0, 1)  # banks run out on it
    made = np.where(hold, np.maximum(made, ground + np.maximum(low - ground, 0) * beach), made)
    fill = (off_m < half_m) & dry & (ground < bed_m) & (bed_m > sea_m)  # no river over an abyss
    made = np.where(fill, bed_m, made)
    return rect, np.where(laid.near, made, ground).astype(np.float32)


def _other_water(level: Level, river: River, rect: Rect) -> np.ndarray:
    """Level of the water that other rivers and painted lakes have in a part of the grid, m; infinite where none is."""
    grid, found = level.grid, np.full(rect.shape, np.inf)
    for other in rivers(level):
        if other.id == river.id:
            continue
        line = own_line(other)
        laid = along(line, grid.shape, grid.cell_m, 0.0)
        theirs = Rect(laid.rows.start, laid.cols.start, laid.rows.stop, laid.cols.stop)
        both = rect.intersect(theirs)
        if both.empty:
            continue
        here, there = both.shifted(rect).slices, both.shifted(theirs).slices
        inside = laid.near[there] & (laid.off_m[there] < line.half_m[laid.nearest[there]])
        found[here] = np.where(inside, np.minimum(found[here], line.level_m[laid.nearest[there]]), found[here])
    if not level.layers["river_mask"].neutral:
        painted = level.layers["river_mask"].read(rect) > 0.5
        found = np.where(painted, np.minimum(found, level.layers["river_surface"].read(rect)), found)
    return found
