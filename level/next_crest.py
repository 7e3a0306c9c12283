"""The next crest at a place: when it comes, when it breaks, how high (T06).

Where a wave object's fronts stand higher than the shore wave it is theirs that are told (H08): those that are seen.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .level import Level
from .loop import turns
from .noise import LATTICE, lattice
from .object_crests import object_crest
from .shore_swash import wave_noise
from .surf import TYPES, breaker_type
from .timing import Clock, Passage, passage

PIECE = 16  # samples of the way that are asked at once; it is straight over them
PIECES = 80
STEP_M = 0.75


@dataclass(frozen=True)
class NextCrest:
    """`breaks_after_s` is None where the wave has broken before or never does; `broken` tells which.

    `height_m` and `type` (surf.TYPES) are those at the break, of a broken wave those where it is now. `of` names the
    wave object that it comes from, whose waves don't break and have no type; "" for waves of the sea.
    """

    in_s: float
    breaks_after_s: float | None
    height_m: float
    type: str
    broken: bool
    at: tuple[float, float]  # the break, world metres
    of: str = ""
    speed_mps: float | None = None  # over the ground, where it isn't that of the sea's fronts

    @property
    def sentence(self) -> str:
        """`next crest in 3.2 s, breaks 1.4 s later, 0.8 m high`."""
        if self.of:
            return f"next crest of {self.of} in {self.in_s:.1f} s, {self.height_m:.1f} m high"
        told = "already broken" if self.broken else "does not break"
        if self.breaks_after_s is not None:
            told = f"breaks {self.breaks_after_s:.1f} s later"
        return f"next crest in {self.in_s:.1f} s, {told}, {self.height_m:.1f} m high"


def next_crest(level: Level, t: float, x: float, y: float) -> NextCrest | None:
    """The crest that comes next to a world point, of the waves that stand highest there; None where none do."""
    clock = Clock.of(level, t)
    here = passage(level, t, [x], [y], clock)
    placed = object_crest(clock.level, t, x, y)
    if placed is not None and not (here.stands[0] and here.height_m[0] > placed.height_m):
        return NextCrest(placed.in_s, None, placed.height_m, "", False, (x, y), placed.name, placed.speed_mps)
    if not here.stands[0]:
        return None
    cycles = float(here.cycles.v[0])
    number = int(np.floor(t / here.period_s - cycles)) + 1
    in_s = (cycles + number) * here.period_s - t
    broken = bool(here.broken[0] >= 0)
    found = None if broken else _break(clock, t, x, y, here)
    after = None if found is None else (found[2] - cycles) * here.period_s
    place = (x, y) if found is None else found[:2]
    there = passage(level, t, [place[0]], [place[1]], clock)
    height_m = float(there.height_m[0]) * _tall(clock, *place, number)
    kind = TYPES[int(breaker_type(there.slope[0], there.height_m[0], there.period_s))]
    return NextCrest(in_s, after, height_m, kind, broken, place)


def _tall(clock: Clock, x: float, y: float, number: int) -> float:
    """What the wave of that number has of the full height there (shore.variety)."""
    shore = clock.shore
    wave = np.array([number % (shore.count * LATTICE * 64)])
    again = {"u_shore_turns": turns(shore.interval_s, clock.level.settings.time.loop_s)}
    noise = wave_noise(shore, again, lattice(clock.level.settings.level.seed), np.array([x]), np.array([y]), wave)
    return float(1.0 - noise.v[0] * shore.variety)


def _break(clock: Clock, t: float, x: float, y: float, here: Passage) -> tuple[float, float, float] | None:
    """Where the wave breaks on its way from a point on, and its cycles there; None where it comes to land before."""
    step_m = max(STEP_M, 0.5 * clock.level.grid.cell_m)
    along = np.arange(1, PIECE + 1) * step_m
    east, north = float(here.cycles.dx[0]), float(here.cycles.dy[0])
    last = (float(here.broken[0]), x, y, float(here.cycles.v[0]))
    for _ in range(PIECES):
        steep = float(np.hypot(east, north))
        if steep < 1e-9:
            return None
        xs, ys = x + along * east / steep, y + along * north / steep
        way = passage(clock.level, t, xs, ys, clock)
        past = np.flatnonzero(way.broken >= 0)
        ends = np.flatnonzero(~way.stands)
        if past.size and not (ends.size and ends[0] < past[0]):
            i = int(past[0])
            before = last if i == 0 else _sample(way, xs, ys, i - 1)
            return _between(before, _sample(way, xs, ys, i))
        if ends.size:
            return None
        last = _sample(way, xs, ys, -1)
        x, y, east, north = last[1], last[2], float(way.cycles.dx[-1]), float(way.cycles.dy[-1])
    return None


def _sample(way: Passage, xs, ys, i: int) -> tuple[float, float, float, float]:
    return float(way.broken[i]), float(xs[i]), float(ys[i]), float(way.cycles.v[i])


def _between(a: tuple, b: tuple) -> tuple[float, float, float]:
    """Where `broken` is 0 on the line from a to b."""
    part = a[0] / (a[0] - b[0]) if a[0] != b[0] else 1.0
    return tuple(m + (n - m) * part for m, n in zip(a[1:], b[1:]))
