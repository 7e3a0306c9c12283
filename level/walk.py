"""Where the player can go: wading depth and slope (the talk's navmesh view, D31), whatever the tide and the waves."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from .beat import beat
from .grid import Rect
from .level import Level

STEEP_M = -1e9  # no sea is so low
MOMENTS = 12  # of a period at which the sea is asked
TOGETHER = 1 << 14  # places that are asked at once, all moments one after another
NUMBERS = 1 << 18  # samples of the ground that are looked at together
SPARE_M = 0.1  # how much nearer than the highest waves the ground must come


def walkable(level: Level, rect: Rect | None = None) -> np.ndarray:
    """True `(rows, cols)` of `rect` where the still water is shallow enough to wade and the ground flat enough to walk.

    A change of height reaches one cell farther than itself.
    """
    rect = level.grid.rect if rect is None else rect
    found = np.empty(rect.shape, bool)
    for rows, height, flat in _flat(level, rect):
        found[rows] = flat & (level.sea_level_m - height <= level.settings.walk.depth_m)
    return found


def highest_sea_m(level: Level, rect: Rect, every: int = 1) -> np.ndarray:
    """Float32, every so many samples `(rows, cols)` of `rect`: up to which height of the still sea one walks there;
    STEEP_M where never."""
    found = np.empty((-(-rect.shape[0] // every), -(-rect.shape[1] // every)), np.float32)
    for rows, height, flat in _flat(level, rect):
        first = -(-rows.start // every)
        here = slice(first * every - rows.start, None, every), slice(None, None, every)
        highest = np.where(flat[here], height[here] + np.float32(level.settings.walk.depth_m), np.float32(STEEP_M))
        found[first : first + len(highest)] = highest
    return found


def _flat(level: Level, rect: Rect) -> Iterator[tuple[slice, np.ndarray, np.ndarray]]:
    """Blocks of rows of `rect`: which, the ground, and where it is flat enough."""
    walk, cell_m = level.settings.walk, level.grid.cell_m
    steepest = math.tan(math.radians(walk.slope_deg))
    deep = max(NUMBERS // max(rect.shape[1], 1), 1)
    for first in range(0, rect.shape[0], deep):
        rows = slice(first, min(first + deep, rect.shape[0]))
        part = Rect(rect.row0 + rows.start, rect.col0, rect.row0 + rows.stop, rect.col1)
        wide = level.grid.clip(part.pad(1))
        height = level.height[wide.slices]
        north, east = np.gradient(height, cell_m)
        inner = part.shifted(wide).slices
        yield rows, height[inner], (north * north + east * east <= steepest * steepest)[inner]
        beat()


def wading_m(level: Level, ground: np.ndarray, x, y, most_m: float) -> tuple[np.ndarray, np.ndarray]:
    """Least and greatest depth of the water over a period of the waves from clock time 0, m, held to 0 … `most_m`.

    `ground` are heights at world points x, y, arrays of one shape. The sea is asked only where waves decide.
    """
    from .river_map import river_map
    from .timing import period_s
    from .waves import largest_height_m, sea_at

    reach_m = largest_height_m(level) + level.settings.shore.draw_m + SPARE_M
    still = level.sea_level_m - ground
    asked = (still > -reach_m) & (still < most_m + reach_m)
    if (rivers := river_map(level)) is not None:
        asked |= rivers.at(x, y)["share"].v > 0
    least, most = (still.astype(np.float64) for _ in range(2))
    places, period = np.flatnonzero(asked), period_s(level, 0.0)
    for first in range(0, len(places), TOGETHER):
        at = places[first : first + TOGETHER]
        low, high = np.full(len(at), np.inf), np.full(len(at), -np.inf)
        for moment in range(MOMENTS):
            beat((first + len(at) * moment / MOMENTS) / len(places))
            sea = sea_at(level, period * moment / MOMENTS, x.flat[at], y.flat[at])
            depth = sea.height_m - ground.flat[at]
            low, high = np.minimum(low, depth), np.maximum(high, depth)
        least.flat[at], most.flat[at] = low, high
    return np.clip(least, 0.0, most_m), np.clip(most, 0.0, most_m)
