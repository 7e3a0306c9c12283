"""Where a surface that hangs over comes from: the lateral shift of breaking waves undone at world points (H23)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .dual import Dual

TRIES = 32  # stretches along the way of the wave that are asked
HALVINGS = 7  # of the one that is taken
NEWTONS = 8
MOST_STEP_M = 0.25  # near a fold Newton's steps would be far too long
LEAST_FOLD = 0.05  # and there they count the surface as no steeper than this
ENOUGH_M = 1e-7


@dataclass
class Moved:
    """At some points: shift east and north, unit way of the waves `(2, n)`, height."""

    shift: tuple[Dual, Dual]
    way: np.ndarray
    height_m: np.ndarray

    def along(self, way: np.ndarray) -> np.ndarray:
        return self.shift[0].v * way[0] + self.shift[1].v * way[1]


Carrying = Callable[[np.ndarray], Moved]


def uncarried(carried: Carrying, at: np.ndarray, most_m: float) -> np.ndarray:
    """Points `(2, n)` that are carried to `at`, the highest where there are several; nothing goes over `most_m`."""
    return _polished(carried, at, _along_the_way(carried, at, most_m))


def _along_the_way(carried: Carrying, at: np.ndarray, most_m: float) -> np.ndarray:
    """The first guess: a place on the line back along the way of the wave, the highest of those that come to `at`."""
    way = carried(at).way
    back = np.linspace(0.0, most_m * 1.01, TRIES + 1)
    asked = [carried(at - way * d) for d in back]
    short = np.array([one.along(way) - d for one, d in zip(asked, back, strict=True)])
    height = np.array([one.height_m for one in asked])
    crosses = (short[:-1] >= 0) != (short[1:] >= 0)
    highest = np.where(crosses, np.maximum(height[:-1], height[1:]), -np.inf)
    which, column = highest.argmax(0), np.arange(at.shape[1])
    low, high, sign = back[which], back[which + 1], short[which, column] >= 0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        same = (carried(at - way * middle).along(way) - middle >= 0) == sign
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    guess = np.where(crosses.any(0), 0.5 * (low + high), 0.0)
    return at - way * guess


def _polished(carried: Carrying, at: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Newton's method in the plane, each step short; the best place so far is kept."""
    best, best_off = start.copy(), np.full(at.shape[1], np.inf)
    for _ in range(NEWTONS):
        east, north = carried(start).shift
        off = at - start - np.array([east.v, north.v])
        away = np.hypot(*off)
        closer = away < best_off
        best[:, closer], best_off = start[:, closer], np.minimum(away, best_off)
        if best_off.max(initial=0) < ENOUGH_M:
            break
        a, b, c, d = 1 + east.dx, east.dy, north.dx, 1 + north.dy
        fold = a * d - b * c
        fold = np.where(np.abs(fold) < LEAST_FOLD, np.where(fold < 0, -LEAST_FOLD, LEAST_FOLD), fold)
        step = np.array([d * off[0] - b * off[1], a * off[1] - c * off[0]]) / fold
        start = start + step * np.minimum(1.0, MOST_STEP_M / np.maximum(np.hypot(*step), 1e-12))
    return best
