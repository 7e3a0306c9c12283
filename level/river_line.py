"""The line of a river: what may be drawn, and the dense line through its points (D13).

Places run through a centripetal Catmull-Rom spline (Yuksel, Schaefer & Keyser 2011: no loops, no cusps), width, level
and speed through a monotone one, so that water never runs uphill between two points that don't.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from .objects import River

STEP_M = 1.0  # between two points of the dense line
WIDEST_M, NARROWEST_M = 500.0, 0.2
FASTEST_MPS = 20.0
TAIL_FALL = 0.04  # how steeply the level of the water sinks beyond the mouth, till the sea is over it
SPREAD = 0.1  # metres that a jet's half width grows a metre (water.md 4.5)


@dataclass(frozen=True)
class Line:
    """Points every STEP_M or less, arrays of one length: world x, y, half width, level of the water, speed.

    `along_m` from the first point; from `mouth` on it is the tail out to sea, straight on.
    """

    x: np.ndarray
    y: np.ndarray
    half_m: np.ndarray
    level_m: np.ndarray
    speed_mps: np.ndarray
    along_m: np.ndarray
    mouth: int


def wrong_with(points) -> str:
    """Why a river can't run through these points, "" if it can."""
    if len(points) < 2:
        return "a river needs two points or more"
    for n, (_, _, width_m, level_m, speed_mps) in enumerate(points, 1):
        if not NARROWEST_M <= width_m <= WIDEST_M:
            return f"point {n} of the river is {width_m:g} m wide; {NARROWEST_M:g} to {WIDEST_M:g} m are possible"
        if not 0 <= speed_mps <= FASTEST_MPS:
            return f"the river runs {speed_mps:g} m/s at point {n}; 0 to {FASTEST_MPS:g} are possible"
        if n > 1 and level_m > points[n - 2][3] + 1e-6:
            rise = level_m - points[n - 2][3]
            return f"point {n} of the river lies {rise:.2f} m higher than the one before: water runs downhill"
        if n > 1 and np.hypot(points[n - 1][0] - points[n - 2][0], points[n - 1][1] - points[n - 2][1]) < 0.01:
            return f"points {n - 1} and {n} of the river lie in one place"
    return _crossing(points)


def _crossing(points) -> str:
    from shapely import LineString, is_simple

    if len(points) > 2:
        places, _ = _spline(np.array(points, float)[:, :2], 2.0)
        if not is_simple(LineString(places)):
            return "the river's line crosses itself: move one of its points"
    return ""


def _spline(knots: np.ndarray, step_m: float) -> tuple[np.ndarray, np.ndarray]:
    """Points through the knots `(n, 2)`, and for each the place among the knots, 0 … n − 1."""
    first, last = 2 * knots[0] - knots[1], 2 * knots[-1] - knots[-2]
    around = np.vstack([first, knots, last])
    gaps = np.maximum(np.linalg.norm(np.diff(around, axis=0), axis=1), 1e-6)
    places, among = [], []
    for i in range(len(knots) - 1):
        a, b, c, d = around[i : i + 4]
        t0, t1, t2 = np.sqrt(gaps[i : i + 3])  # centripetal: half powers of the chords
        parts = max(int(np.ceil(gaps[i + 1] / step_m)), 2)
        u = np.arange(parts + (i == len(knots) - 2)) / parts
        m1 = t1 * ((b - a) / t0 - (c - a) / (t0 + t1) + (c - b) / t1)
        m2 = t1 * ((c - b) / t1 - (d - b) / (t1 + t2) + (d - c) / t2)
        u2, u3 = u * u, u * u * u
        basis = np.stack([2 * u3 - 3 * u2 + 1, u3 - 2 * u2 + u, -2 * u3 + 3 * u2, u3 - u2], -1)
        places.append(basis @ np.stack([b, m1, c, m2]))
        among.append(i + u)
    return np.concatenate(places), np.concatenate(among)


@lru_cache(maxsize=64)
def centre_line(river: River, sea_m: float, step_m: float = STEP_M) -> Line:
    """The dense line of a river; where its last point lies at the sea's level or near it, with a tail out to sea."""
    from scipy.interpolate import PchipInterpolator

    knots = np.array(river.points, float)
    places, among = _spline(knots[:, :2], step_m)
    width_m, level_m, speed_mps = (PchipInterpolator(np.arange(len(knots)), knots[:, i])(among) for i in (2, 3, 4))
    mouth = len(places)
    if river.reach_m > 0 and level_m[-1] < sea_m + 0.5 * width_m[-1]:
        way = places[-1] - places[-2]
        way /= np.linalg.norm(way)
        off = np.arange(step_m, river.reach_m + step_m, step_m)
        places = np.vstack([places, places[-1] + off[:, None] * way])
        width_m = np.concatenate([width_m, width_m[-1] + 2 * SPREAD * off])
        level_m = np.concatenate([level_m, level_m[-1] - TAIL_FALL * off])
        speed_mps = np.concatenate([speed_mps, np.full(len(off), speed_mps[-1])])
    along_m = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(places, axis=0), axis=1))])
    x, y = places[:, 0] + river.x, places[:, 1] + river.y
    return Line(x, y, 0.5 * width_m, level_m, speed_mps, along_m, mouth)
