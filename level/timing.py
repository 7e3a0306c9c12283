"""Reading the timing (T06): when fronts pass, how fast they go over the ground, where they stand and where they break.

    passage(level, t, x, y)       # all of it at points
    timing_map(level, t)          # all of it on a grid, kept with the level

One place for both sources of time: crest n passes at `cycles + n` periods. Its shader is lib/passage.glsl.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrival import arrival, shore_at
from .arrival_map import ArrivalMap
from .beach_map import beach_map
from .dispersion import phase_speed
from .dual import Dual, step
from .gerstner import Fronts, phase_noise
from .level import Level
from .noise import lattice
from .patches import patch_shore
from .pins import later
from .sea_keys import fronts_at
from .settings import Shore
from .shore import shore_map
from .shore_waves import BREAK_S, Travel, height_along, lead_arrival, s_cycles, shore_early
from .shore_waves import front_speed_mps as front_speed_of
from .surf import BROKEN_SHARE
from .weather_keys import level_at

FLAT = 0.03  # against where it stands highest: a lower wave is none that anybody sees
MAP_SIDE = 257  # samples a side of `timing_map`
KEPT = 2  # maps that a level keeps


@dataclass(frozen=True)
class Passage:
    """At some points, arrays of one shape: `cycles` dual, arrival over the period; `height` against the highest.

    `stands` is False on land, in ponds and where the wave lies flat. `broken` is below 0 before the break, 0 on the
    break line and above it behind; `depth_m` and `slope` are those of the bed without rocks.
    """

    cycles: Dual
    period_s: float
    height: np.ndarray
    height_m: np.ndarray
    stands: np.ndarray
    broken: np.ndarray
    depth_m: np.ndarray
    slope: np.ndarray
    settled: bool

    @property
    def arrival_s(self) -> np.ndarray:
        return self.cycles.v * self.period_s

    @property
    def speed_mps(self) -> np.ndarray:
        """Of the front over the ground, 1 / |∇A|."""
        return 1.0 / np.maximum(self.period_s * np.hypot(self.cycles.dx, self.cycles.dy), 1e-6)


@dataclass(frozen=True)
class Clock:
    """What a level's fronts follow at a moment, found once for many places; `made` is None by depth alone."""

    level: Level
    shore: Shore
    fronts: Fronts
    made: ArrivalMap | None

    @classmethod
    def of(cls, level: Level, t: float) -> Clock:
        level = level_at(level, t)
        return cls(level, shore_at(level, t), fronts_at(level, t)[-1], arrival(level, t))


def passage(level: Level, t: float, x, y, clock: Clock | None = None) -> Passage:
    """How fronts pass world points (arrays), in the source of time that the level has."""
    clock = clock or Clock.of(level, t)
    level, shore, made = clock.level, clock.shore, clock.made
    x, y = np.broadcast_arrays(np.asarray(x, np.float64), np.asarray(y, np.float64))
    bed = shore_map(level).at(x, y, level.tide_m)
    s = 1.0 - bed["smoothed"] * (1 / shore.range_m)
    early = shore_early(shore, x, y, beach_map(level).at(x, y)[1], lattice(level.settings.level.seed))
    late = later(level, t, x, y)
    if made is None:
        cycles, travel, share = s * s_cycles(shore) - early + late, None, 0.0
    else:
        share = level.settings.timing.share
        bend = phase_noise(level.settings.sea, clock.fronts, 0, x, y) + late
        travel = Travel.of(made.at(x, y), bend, share)
        cycles = lead_arrival(shore, s, early * step(0.0, 1.0, s) - late * (1 - share), travel)
    sea = bed["sea"].v * bed["within"].v * patch_shore(level, x, y).v
    height = _height(shore, s, travel)
    stands = (sea > 0.5) & (bed["depth"].v > 0) & (s.v < 1) & (height > FLAT)
    broken = _broken(level, shore, s.v, height, bed["smoothed"].v, share)
    slope = np.hypot(bed["smoothed"].dx, bed["smoothed"].dy)
    return Passage(
        Dual(*(np.broadcast_to(part, x.shape) for part in (cycles.v, cycles.dx, cycles.dy))), shore.interval_s, height,
        height * shore.height_m, stands, broken, bed["smoothed"].v, slope, made is None or made.settled,
    )  # fmt: skip


def _height(shore: Shore, s: Dual, travel: Travel | None) -> np.ndarray:
    """Of the wave against where it stands highest; it fades in at the outer edge unless it comes from the open sea."""
    if travel is not None and travel.share == 1.0:
        return np.asarray(travel.height.v)
    high = height_along(s, travel).v * step(0.0, max(shore.fade_in, 1e-3), s).v
    return high * float(shore.on)


def _broken(level: Level, shore: Shore, s, height, depth_m, share: float) -> np.ndarray:
    """How far past breaking: with the depth's clock along s, with travel times by height against depth."""
    by_depth = s / BREAK_S - 1.0
    most = level.settings.timing.breaker * BROKEN_SHARE * np.maximum(depth_m, 1e-3)
    by_height = np.clip(height * shore.height_m / most - 1.0, -1.0, 1.0)
    return by_depth + (by_height - by_depth) * share


def arrival_s(level: Level, t: float, x, y) -> np.ndarray:
    """Absolute seconds: crest n passes a point at this + n · `period_s`."""
    return passage(level, t, x, y).arrival_s


def period_s(level: Level, t: float) -> float:
    """Seconds between two crests."""
    return shore_at(level_at(level, t), t).interval_s


def front_speed_mps(level: Level, t: float, x, y) -> np.ndarray:
    """Speed of the front over the ground, 1 / |∇A|."""
    return passage(level, t, x, y).speed_mps


def speed_on(level: Level, t: float, depth_m: float, slope: float) -> float:
    """Speed over the ground of a front that goes straight up a bed of that depth and slope, m/s (D31)."""
    level = level_at(level, t)
    shore, timing = shore_at(level, t), level.settings.timing
    by_depth = float(front_speed_of(shore, slope))
    if not timing.travels:
        return by_depth
    by_travel = float(phase_speed(shore.interval_s, max(depth_m, timing.least_depth_m)))
    return 1.0 / ((1.0 - timing.share) / by_depth + timing.share / by_travel)


def swell_arrivals(level: Level, t: float, x, y, clock: Clock | None = None) -> dict[str, np.ndarray]:
    """Absolute seconds by swell: `shore` with the depth's clock, else `swell1` to `swell3`, the leading one first."""
    clock = clock or Clock.of(level, t)
    return _by_swell(clock, x, y, passage(level, t, x, y, clock).arrival_s)


def _by_swell(clock: Clock, x, y, lead: np.ndarray) -> dict[str, np.ndarray]:
    """The arrival of the leading swell with those of the others."""
    made = clock.made
    if made is None:
        return {"shore": lead}
    if not np.ptp(made.plane, axis=0).any():  # one swell in place of the level's (one_swell.py)
        return {"swell1": lead}
    at, sea = made.at(x, y, heights=False).swells, clock.level.settings.sea
    others = {
        f"swell{i + 1}": made.period_s[i] * (at[i].v + phase_noise(sea, clock.fronts, i, x, y).v)
        for i in range(1, len(at))
    }
    return {"swell1": lead, **others}


@dataclass(frozen=True)
class TimingMap:
    """A `Passage` on a grid `(rows, cols)`, row 0 south, samples at (col, row) · cell_m."""

    passage: Passage
    cell_m: float

    @property
    def shape(self) -> tuple[int, int]:
        return self.passage.stands.shape


def timing_map(level: Level, t: float, most_side: int = MAP_SIDE) -> TimingMap:
    """The level's timing on a grid of at most so many samples a side; kept while neither level nor swell change."""
    clock = Clock.of(level, t)
    settings, made = clock.level.settings, clock.made
    tide_m = round(clock.level.tide_m, 2)
    sources = None if made is None else (made.settled, *map(id, made.sources))
    changed = level.revision, beach_map(level).revision  # the beach may follow some frames later
    key = (*changed, clock.shore, settings.sea, settings.level, settings.timing, sources, tide_m, most_side)
    kept: dict = level.derived.setdefault("timing_maps", {})
    if key not in kept:
        stride = max(1, -(-(max(level.grid.shape) - 1) // (most_side - 1)))
        cell_m = level.grid.cell_m * stride
        rows, cols = (-(-side // stride) for side in level.grid.shape)
        x, y = np.meshgrid(np.arange(cols) * cell_m, np.arange(rows) * cell_m)
        # the map stays with what was made of it: its sources' ids are part of the key
        kept[key] = TimingMap(passage(level, t, x, y, clock), cell_m), made
        for old in list(kept)[:-KEPT]:
            del kept[old]
    return kept[key][0]


def map_rows(level: Level, t: float, rows: slice, clock: Clock | None = None) -> dict[str, np.ndarray]:
    """Float32 `(rows, cols)` of some rows of height vertices, from the south: arrival in seconds by swell, and
    `front_speed`; NaN where no wave stands."""
    clock = clock or Clock.of(level, t)
    cell_m = level.grid.cell_m
    x, y = np.meshgrid(np.arange(level.grid.cols) * cell_m, np.arange(rows.start, rows.stop) * cell_m)
    here = passage(level, t, x, y, clock)
    maps = {**_by_swell(clock, x, y, here.arrival_s), "front_speed": here.speed_mps}
    return {name: np.where(here.stands, values, np.nan).astype(np.float32) for name, values in maps.items()}


def whole_maps(level: Level, t: float, band: int = 128) -> dict[str, np.ndarray]:
    """`map_rows` of the whole level, worked out a band of rows at a time."""
    rows, clock = level.grid.rows, Clock.of(level, t)
    bands = [map_rows(level, t, slice(row, min(row + band, rows)), clock) for row in range(0, rows, band)]
    return {name: np.concatenate([one[name] for one in bands]) for name in bands[0]}
