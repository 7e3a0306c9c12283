"""Lines of the timing (T06): crests at a moment and isochrones as polylines in world metres, by marching squares."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from .contours import contours
from .level import Level
from .timing import TimingMap, timing_map

LEAP = 0.8  # cycles from sample to sample
MOST_LEVELS = 400  # of one field: closer than that no line can be told from the next


@dataclass(frozen=True)
class Line:
    """A polyline `(n, 2)` world metres and what it stands for: number of the wave, or seconds."""

    points: np.ndarray
    value: float

    @property
    def length_m(self) -> float:
        return float(np.hypot(*np.diff(self.points, axis=0).T).sum())


def crest_lines(level: Level, t: float, most_side: int | None = None) -> list[Line]:
    """Crests at a moment, `value` the number of the wave (that of `A + n · period`)."""
    found = _map(level, t, most_side)
    since = t / found.passage.period_s - found.passage.cycles.v
    return lines(since, found, 1.0)


def isochrones(level: Level, t: float, every_s: float, most_side: int | None = None) -> list[Line]:
    """Lines of one arrival time each `every_s` seconds, `value` in absolute seconds."""
    found = _map(level, t, most_side)
    return lines(found.passage.arrival_s, found, every_s)


def break_lines(level: Level, t: float, most_side: int | None = None) -> list[Line]:
    """Where waves break, seaward edge of the surf zone; `value` is the height there in metres."""
    found = _map(level, t, most_side)
    drawn = []
    for points in contours(found.passage.broken, 0.0, found.passage.stands):
        rows, cols = points[:, 1], points[:, 0]
        height = ndimage.map_coordinates(found.passage.height_m, [rows, cols], order=1, mode="nearest")
        drawn.append(Line(points * found.cell_m, float(height.mean())))
    return drawn


def lines(values: np.ndarray, found: TimingMap, every: float) -> list[Line]:
    """All multiples of `every` in a field on the grid of a map, where waves stand."""
    valid = found.passage.stands & ~_jumps(found.passage.cycles.v)
    known = values[valid]
    if not known.size:
        return []
    first, last = np.ceil(known.min() / every), np.floor(known.max() / every)
    last = min(last, first + MOST_LEVELS)
    return [
        Line(points * found.cell_m, float(n * every) + 0.0)
        for n in np.arange(first, last + 1)
        for points in contours(values, n * every, valid)
    ]


def _jumps(cycles: np.ndarray) -> np.ndarray:
    """Samples beside a leap in time, where fronts meet from two sides: lines would run along it in a bundle."""
    found = np.zeros(cycles.shape, bool)
    for axis in (0, 1):
        leap = np.abs(np.diff(cycles, axis=axis)) > LEAP
        at = [slice(None), slice(None)]
        for part in (slice(None, -1), slice(1, None)):
            at[axis] = part
            found[tuple(at)] |= leap
    return found


def _map(level: Level, t: float, most_side: int | None) -> TimingMap:
    return timing_map(level, t) if most_side is None else timing_map(level, t, most_side)
