"""Where a surface that hangs over comes from: the lateral shift of breaking waves undone at world points (H23)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .beat import beat
from .dual import Dual

TRIES = 32  # stretches along the way of the wave that are told apart
SPARSE = 4  # every so many are asked of all points, those between only where something may cross
STEEPEST = 4.0  # metres farther that things are carried, from metre to metre along the way
HALVINGS = 7  # of the one that is taken
NEWTONS = 8
MOST_STEP_M = 0.25  # near a fold Newton's steps would be far too long
LEAST_FOLD = 0.05  # and there they count the surface as no steeper than this
ENOUGH_M = 1e-7
TOGETHER = 1 << 14  # places that are asked at once


@dataclass
class Moved:
    """At some points: shift east and north, unit way of the waves `(2, n)`, height."""

    shift: tuple[Dual, Dual]
    way: np.ndarray
    height_m: np.ndarray

    def along(self, way: np.ndarray) -> np.ndarray:
        return self.shift[0].v * way[0] + self.shift[1].v * way[1]


Carrying = Callable[[np.ndarray, np.ndarray], Moved]  # places `(2, m)`, and of which of the points each is one


def uncarried(carried: Carrying, at: np.ndarray, most_m: float) -> np.ndarray:
    """Points `(2, n)` that are carried to `at`, the highest where there are several; nothing goes over `most_m`."""
    found = at.copy()
    moves, guess = _along_the_way(carried, at, most_m)
    found[:, moves] = _polished(carried, at[:, moves], guess, moves)
    return found


def _along_the_way(carried: Carrying, at: np.ndarray, most_m: float) -> tuple[np.ndarray, np.ndarray]:
    """Which points anything is carried to, and the first guess for each: a place on the line back along the way of the
    wave, the highest of those that come to `at`."""
    here = np.arange(at.shape[1])
    first = _in_parts(carried, at, here)
    way = first.way
    back = np.linspace(0.0, most_m * 1.01, TRIES + 1)
    wide = np.arange(0, TRIES + 1, SPARSE)
    along, height = _stretches(carried, at, way, back, *np.meshgrid(wide[1:], here, indexing="ij"))
    along, height = np.vstack([first.along(way), along]), np.vstack([first.height_m, height])
    moves = np.flatnonzero((along != 0.0).any(0))
    at, way, along = at[:, moves], way[:, moves], along[:, moves]
    short, high = np.full((TRIES + 1, len(moves)), -1.0), np.full((TRIES + 1, len(moves)), -np.inf)
    short[wide], high[wide] = along - back[wide, None], height[:, moves]
    most = 0.5 * (along[:-1] + along[1:] + STEEPEST * back[SPARSE])
    between, point = np.nonzero(np.repeat(most >= back[wide[:-1], None], SPARSE, axis=0))
    inner = between % SPARSE > 0
    between, point = between[inner], point[inner]
    asked, high[between, point] = _stretches(carried, at, way, back, between, point, moves)
    short[between, point] = asked - back[between]
    return moves, at - way * _crossing(carried, at, way, back, short, high, moves)


def _crossing(carried: Carrying, at, way, back, short, high, which) -> np.ndarray:
    """How far back the highest place lies that is carried no less far than it is away."""
    crosses = (short[:-1] >= 0) != (short[1:] >= 0)
    highest = np.where(crosses, np.maximum(high[:-1], high[1:]), -np.inf)
    stretch, column = highest.argmax(0), np.arange(at.shape[1])
    near, far, sign = back[stretch], back[stretch + 1], short[stretch, column] >= 0
    for _ in range(HALVINGS):
        middle = 0.5 * (near + far)
        same = (_in_parts(carried, at - way * middle, which).along(way) - middle >= 0) == sign
        near, far = np.where(same, middle, near), np.where(same, far, middle)
    return np.where(crosses.any(0), 0.5 * (near + far), 0.0)


def _stretches(carried: Carrying, at, way, back, stretch, point, which=None) -> tuple[np.ndarray, np.ndarray]:
    """How far along `way` the places `back[stretch]` behind points are carried, and their heights."""
    shape, stretch, point = np.shape(stretch), np.ravel(stretch), np.ravel(point)
    ways = way[:, point]
    moved = _in_parts(carried, at[:, point] - ways * back[stretch], point if which is None else which[point])
    return moved.along(ways).reshape(shape), moved.height_m.reshape(shape)


def _in_parts(carried: Carrying, at: np.ndarray, which: np.ndarray) -> Moved:
    """`carried`, so many places at once that a processor's cache holds them."""
    beat()
    if len(which) <= TOGETHER:
        return carried(at, which)
    parts = [slice(first, first + TOGETHER) for first in range(0, len(which), TOGETHER)]
    asked = []
    for part in parts:
        asked.append(carried(at[:, part], which[part]))
        beat()
    shift = (
        Dual(*(np.concatenate([getattr(one.shift[axis], n) for one in asked]) for n in ("v", "dx", "dy")))
        for axis in (0, 1)
    )
    height = np.concatenate([one.height_m for one in asked])
    return Moved(tuple(shift), np.concatenate([one.way for one in asked], -1), height)


def _polished(carried: Carrying, at: np.ndarray, start: np.ndarray, which: np.ndarray) -> np.ndarray:
    """Newton's method in the plane, each step short; the best place so far is kept."""
    best, best_off, left = start.copy(), np.full(at.shape[1], np.inf), np.arange(at.shape[1])
    for _ in range(NEWTONS):
        east, north = _in_parts(carried, start, which[left]).shift
        off = at[:, left] - start - np.array([east.v, north.v])
        away = np.hypot(*off)
        closer = away < best_off[left]
        best[:, left[closer]] = start[:, closer]
        best_off[left] = np.minimum(away, best_off[left])
        a, b, c, d = 1 + east.dx, east.dy, north.dx, 1 + north.dy
        fold = a * d - b * c
        fold = np.where(np.abs(fold) < LEAST_FOLD, np.where(fold < 0, -LEAST_FOLD, LEAST_FOLD), fold)
        step = np.array([d * off[0] - b * off[1], a * off[1] - c * off[0]]) / fold
        start = start + step * np.minimum(1.0, MOST_STEP_M / np.maximum(np.hypot(*step), 1e-12))
        go_on = best_off[left] >= ENOUGH_M
        left, start = left[go_on], start[:, go_on]
        if not len(left):
            break
    return best
