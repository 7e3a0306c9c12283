"""The level's arrival map (T06): asked for by a level and a time, solved elsewhere when an editor lends a solver.

    made = arrival(level, time_s)   # None while waves keep the clock of the depth alone

A still picture solves at once and depends on the level and the time alone. An editor sets `level.solver`: an object
whose `answer(asked)` returns the map when it has one of just these waters, else the last good one, `settled` False, or
None. Under a tide there are maps of several sea levels (arrival_tide.py).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from scipy import ndimage

from .arrival_map import BLOCKS, SWELLS, ArrivalMap
from .arrival_tide import TideMaps, levels_m
from .breaking_map import breaking_block
from .dispersion import group_speed, wavenumber
from .earth import GRAVITY
from .gerstner import Fronts
from .level import Level
from .request import Beside, Request
from .river_flow import river_flow
from .sea_keys import fronts_at
from .settings import Shore
from .shore import shore_map
from .swell_request import Swell, SwellRequest, SwellResult, solve_request
from .tide import tide_m
from .travel_time import stride
from .wave_current import wave_current

MOST_SIDE, LIVE_SIDE = 513, 257  # texels a side of the map, and of that under the brush
MOST_GAIN = 3.0  # of a swell against its height offshore
SHORE_SMOOTH_M = 3.0  # sigma of the time at the shoreline
BANK_MPS = 0.15  # a shore along which water runs faster is a bank
KEPT = 6  # maps that a level keeps: of the weathers that follow each other, and of the sea levels of a tide


@dataclass(frozen=True)
class Asked(Request[ArrivalMap]):
    """All that a map follows from; two of one `key` are the same.

    Under the brush no heights are asked for: those of the last whole map go on.
    """

    key: tuple
    request: SwellRequest
    lead_height_m: float  # of the shore waves where they stand highest

    def kept(self) -> Asked:
        return replace(self, request=self.request.kept())

    @property
    def answer_bytes(self) -> int:
        return (BLOCKS * 4 * 4 + SWELLS) * self.request.depth_m.size + (1 << 12)

    def answered(self) -> ArrivalMap:
        return arrival_map(self, solve_request(self.request))


class Solver(Beside, Protocol):
    """What an editor lends to a level, so that no window waits for a map."""

    def answer(self, asked: Asked) -> ArrivalMap | None: ...

    def latest(self) -> ArrivalMap | None:
        """The last good map while nobody can say yet of which waters the next one is."""


def swell(level: Level, time_s: float) -> Fronts:
    """The low group at a time: the swells whose times of arrival count."""
    return fronts_at(level, time_s)[1]


def shore_at(level: Level, time_s: float) -> Shore:
    """The shore settings at a time: with travel times the waves of the shore are those of the leading swell."""
    shore = level.settings.shore
    if not level.settings.timing.travels:
        return shore
    return shore.model_copy(update={"interval_s": period_s(swell(level, time_s))[0]})


def period_s(fronts: Fronts) -> tuple[float, ...]:
    """Periods of a group's fronts."""
    return tuple(float(2 * math.pi / omega) for omega in fronts.omega)


def offshore_height_m(break_height_m: float, period_s: float, depth_m: float, breaker: float) -> float:
    """Height over a depth of a swell that comes straight in and breaks with a height: its energy flux is the same there
    and where the depth is that height over `breaker` (long wave)."""
    k = float(wavenumber(period_s, depth_m))
    group_mps = float(group_speed(period_s, depth_m)) if k else 0.0
    return math.sqrt(break_height_m**2.5 * math.sqrt(GRAVITY / breaker) / max(group_mps, 1e-6))


def asked_of(level: Level, time_s: float, most_side: int | None = None, rise_m: float | None = None) -> Asked:
    """What a map at a time follows from: coarse and of times alone under the brush, else with heights.

    `most_side` texels a side, if that is not to follow from the brush; `rise_m` of the sea over its mean level, if that
    is not to be the tide of the moment.
    """
    if rise_m is None:
        rise_m = float(tide_of(level, time_s))
    bed, fronts, settings = shore_map(level), swell(level, time_s), level.settings
    side = most_side or (LIVE_SIDE if level.live else MOST_SIDE)
    step = stride(bed.packed.shape[:2], side)
    depth = bed.packed[::step, ::step, 1]
    if rise_m:
        depth = depth + np.float32(rise_m)
    periods, timing = period_s(fronts), settings.timing
    lead_m = offshore_height_m(settings.shore.height_m, periods[0], max(float(depth.max()), 1.0), timing.breaker)
    heights = (0.0,) * SWELLS if level.live else (lead_m, *(float(2 * a) for a in fronts.amplitude_m[1:]))
    headings = (float(np.degrees(np.arctan2(e, n)) % 360) for e, n in zip(fronts.east, fronts.north))
    swells = tuple(Swell(*one) for one in zip(periods, headings, heights, strict=True))
    moves = wave_current(level, depth, bed.cell_m * step, (bed.revision, bed.whole, rise_m))
    key = (bed.revision, bed.key[0], bed.whole, step, swells, settings.shore.height_m, timing, rise_m)
    key += () if moves is None else (moves.name,)
    request = SwellRequest(
        depth, bed.cell_m * step, swells, least_depth_m=timing.least_depth_m, breaks_at=timing.breaker,
        heights_side=MOST_SIDE, current=None if moves is None else moves.mps,
    )  # fmt: skip
    return Asked(key, request, settings.shore.height_m)


def arrival(level: Level, time_s: float) -> ArrivalMap | None:
    """When waves come, at a time of a level; None where that follows from the depth alone, or nobody knows yet."""
    if not level.settings.timing.travels:
        return None
    tides = level.derived.setdefault("arrival_tides", TideMaps()) if level.settings.tide.on else None
    if level.solver is not None and not level.live and not shore_map(level).whole:
        return level.solver.latest() if tides is None else tides.latest(tide_of(level, time_s))
    if tides is None:
        asked = _asked_once(level, time_s, 0.0)
        return level.solver.answer(asked) if level.solver is not None else _kept(level, asked)
    tide = tide_of(level, time_s)
    if level.solver is None:
        rises = levels_m(level.settings, tide)
        return tides.of([_kept(level, _asked_once(level, time_s, rise)) for rise in rises], rises, tide)
    return tides.lent(level, tide, lambda rise: _asked_once(level, time_s, rise))


def tide_of(level: Level, time_s):
    """How far the sea of a level stands over its mean level at a time (arrays too)."""
    return level.tide_m if level.undated is not None else tide_m(level.settings, time_s)


def _kept(level: Level, asked: Asked) -> ArrivalMap:
    """The answer, worked out now if the level has it no more."""
    kept: dict = level.derived.setdefault("arrivals", {})
    if asked.key not in kept:
        kept[asked.key] = asked.answered()
        for key in list(kept)[:-KEPT]:
            del kept[key]
    return kept[asked.key]


def _asked_once(level: Level, time_s: float, rise_m: float) -> Asked:
    """`asked_of`, remembered: all who ask for one frame ask the same."""
    if np.ndim(time_s):  # many moments at once are nobody's frame
        return asked_of(level, time_s, rise_m=rise_m)
    bed, settings = shore_map(level), level.settings
    key = time_s, rise_m, level.live, bed.revision, bed.whole, level.objects_revision, level.layer_revision("flow")
    kept: dict = level.derived.setdefault("asked", {})
    known, others = kept.get(key), (bed, settings, level.undated, river_flow(level))
    if known is None or any(had is not has for had, has in zip(known, others)):
        known = kept[key] = *others, asked_of(level, time_s, rise_m=rise_m)
        for gone in list(kept)[:-KEPT]:
            del kept[gone]
    return known[-1]


def arrival_map(asked: Asked, found: tuple[SwellResult, ...]) -> ArrivalMap:
    """The map that shader and twin read, of what was solved; heights 0 where none were asked for."""
    request = asked.request
    rows, cols = request.depth_m.shape
    times, heights, breaks = (np.zeros((rows, cols, 4), np.float32) for _ in range(BLOCKS))
    plane = np.zeros((SWELLS, 2))
    for i, (one, swell_i) in enumerate(zip(found, request.swells, strict=True)):
        times[..., i] = one.time.seconds
        plane[i] = one.time.plane(1.0, 0.0), one.time.plane(0.0, 1.0)
        if one.heights is None:
            continue
        # where two fronts meet the phase jumps from one to the other: there the wave lies down
        stands = np.where(one.time.reached, 1.0 - np.clip(one.time.meets, 0, 1), 0.0)
        heights[..., 1 + i] = np.clip(one.heights.height_m / swell_i.height_m, 0, MOST_GAIN) * stands
        if i == 0:
            heights[..., 0] = one.heights.height_m / max(asked.lead_height_m, 1e-6) * stands
            meets = None if request.current is None else one.time.meets
            breaks = breaking_block(one.heights, one.time.reached, request.cell_m, meets)
    times[..., 3] = _at_the_shore(request, times[..., 0], found[0].time.reached)
    periods = tuple(one.period_s for one in request.swells)
    reached = np.stack([one.time.reached for one in found], -1)
    return ArrivalMap(np.concatenate([times, heights, breaks]), request.cell_m, periods, plane, reached=reached)


def _at_the_shore(request: SwellRequest, seconds: np.ndarray, reached: np.ndarray) -> np.ndarray:
    """When waves meet the shoreline that is nearest, in seconds; smooth, or two shores as near would meet in a step.

    Banks that a current runs along don't count: waves come there late, and no sheet runs up them.
    """
    land = request.depth_m <= 0
    line = reached & ndimage.binary_dilation(land) & ~land
    if request.current is not None:
        beach = line & (np.hypot(request.current[..., 0], request.current[..., 1]) < BANK_MPS)
        line = beach if beach.any() else line
    if not line.any():
        return seconds
    row, col = ndimage.distance_transform_edt(~line, return_distances=False, return_indices=True)
    return ndimage.gaussian_filter(seconds[row, col], SHORE_SMOOTH_M / request.cell_m, mode="nearest", truncate=3)


def arrival_uniforms(made: ArrivalMap | None, share: float) -> dict:
    """What shaders/arrival.glsl asks for; made for None too, for a program without it ignores them."""
    if made is None:
        return {}
    return {
        "u_arrival_cell_m": made.cell_m,
        "u_arrival_rate": tuple(1 / period for period in made.period_s),
        "u_arrival_plane": np.asarray(made.plane_now, np.float32),
        "u_arrival_levels": 1 + len(made.above),
        "u_arrival_rise": float(made.rise),
        "u_arrival_share": share,
    }
