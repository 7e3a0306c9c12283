"""A cut through the shore at one moment: bed, surface and the masks along it, from the CPU twin (D03, D30, T06).

It goes the way that a front takes through the point: across the contours of the bed that the clock reads.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .level import Level
from .pick import ground_at
from .probes import heights_at
from .shore import ShoreMap, shore_map
from .tide import sea_level_at
from .waves import sea_at

STEEP_ENOUGH = 1e-4  # below that the bed has no direction of its own and the cut goes straight on, at first north
TURNING = 0.25  # of the way to the bed's own direction, a step: ripples of the sand don't bend the cut
STEP_M = 2.0


@dataclass(frozen=True)
class Way:
    """World points of a cut, arrays of one length; `along_m` is 0 at the picked point and grows towards land."""

    along_m: np.ndarray
    x: np.ndarray
    y: np.ndarray


@dataclass(frozen=True)
class Section:
    """Arrays along a way, heights in level metres; `still_m` is the still sea with its tide."""

    along_m: np.ndarray
    ground_m: np.ndarray
    surface_m: np.ndarray
    a: np.ndarray
    b: np.ndarray
    line: np.ndarray
    back: np.ndarray
    fall: np.ndarray
    still_m: float


def way_of_front(level: Level, x: float, y: float, length_m: float = 160.0, samples: int = 240) -> Way:
    """The way of a front through a world point, `length_m` long, half of it to either side."""
    bed, steps = shore_map(level), int(np.ceil(length_m / 2 / STEP_M))
    start = _uphill(bed, np.array([x]), np.array([y]), np.array([[0.0, 1.0]]))
    places, ways = np.array([[x, y], [x, y]]), np.concatenate([-start, start])  # to the sea, to land
    sides = np.array([[-1.0], [1.0]])
    points = [places]
    for _ in range(steps):
        places = places + STEP_M * ways
        uphill = sides * _uphill(bed, places[:, 0], places[:, 1], sides * ways)
        ways = ways + TURNING * (uphill - ways)
        ways = ways / np.maximum(np.linalg.norm(ways, axis=1, keepdims=True), 1e-9)
        points.append(places)
    sea, land = np.stack(points, 1)
    whole = np.concatenate([sea[:0:-1], land])
    at = STEP_M * np.arange(-steps, steps + 1)
    along = np.linspace(-length_m / 2, length_m / 2, samples)
    return Way(along, np.interp(along, at, whole[:, 0]), np.interp(along, at, whole[:, 1]))


def _uphill(bed: ShoreMap, x: np.ndarray, y: np.ndarray, otherwise: np.ndarray) -> np.ndarray:
    """Unit vectors (n, 2) to where the bed rises; `otherwise` where it is level."""
    smoothed = bed.at(x, y)["smoothed"]
    rise = -np.stack([smoothed.dx, smoothed.dy], 1)
    steep = np.linalg.norm(rise, axis=1, keepdims=True)
    return np.where(steep > STEEP_ENOUGH, rise / np.maximum(steep, STEEP_ENOUGH), otherwise)


def section(
    level: Level, t: float, x: float, y: float, length_m: float = 160.0, samples: int = 240, way: Way | None = None
) -> Section:  # fmt: skip
    """The cut at a moment along the way of the front through a world point, or along one that is known."""
    way = way or way_of_front(level, x, y, length_m, samples)
    sea = sea_at(level, t, way.x, way.y)
    ground = np.asarray(ground_at(level, way.x, way.y), np.float64)
    m = sea.shore
    return Section(
        way.along_m, ground, np.maximum(sea.height_m, ground), m.a, m.b, m.line, m.back, m.fall, sea_level_at(level, t)
    )


def ghosts(level: Level, times, way: Way) -> np.ndarray:
    """Surfaces `(times, samples)` along a way at other moments, never under the ground."""
    heights = heights_at(level, np.asarray(times, np.float64)[:, None], way.x, way.y)
    return np.maximum(heights, ground_at(level, way.x, way.y))


def reach(level: Level, t: float, period_s: float, way: Way, count: int = 20) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest surface along a way over a period from t on, of so many moments."""
    heights = ghosts(level, t + period_s * np.arange(count) / count, way)
    return heights.min(axis=0), heights.max(axis=0)
