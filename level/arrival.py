"""The level's arrival map (T06): asked for by a level and a time, solved elsewhere when an editor lends a solver.

    made = arrival(level, time_s)   # None while waves keep the clock of the depth alone

A still picture solves at once and depends on the level and the time alone. An editor sets `level.solver`: an object whose
`answer(asked)` returns the map when it has one of just these waters, else the last good one, `settled` False, or None.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from scipy import ndimage

from .arrival_map import SWELLS, ArrivalMap
from .gerstner import Fronts
from .level import Level
from .sea_keys import fronts_at
from .settings import Shore
from .shore import shore_map

MOST_SIDE = 513  # texels a side of the map that is drawn with
KEPT = 4  # maps that a level keeps: of the weathers that follow each other


@dataclass(frozen=True)
class Asked:
    """All that a map follows from; `depth_m` float32 `(rows, cols)`, row 0 south, below 0 on land.

    Two of one `key` are the same. `heading_deg` is where swells go, `height_m` the lead's offshore.
    """

    key: tuple
    depth_m: np.ndarray = field(compare=False, repr=False)
    cell_m: float
    period_s: tuple[float, ...]
    heading_deg: tuple[float, ...]
    height_m: tuple[float, ...]
    shore_height_m: float
    least_depth_m: float
    breaker: float


class Solver(Protocol):
    """What an editor lends to a level, so that no window waits for a map."""

    def answer(self, asked: Asked) -> ArrivalMap | None: ...


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


def asked_of(level: Level, time_s: float, most_side: int = MOST_SIDE) -> Asked:
    """What the level's map at a time follows from; depth with a stride that keeps it within `most_side`."""
    bed, fronts, settings = shore_map(level), swell(level, time_s), level.settings
    stride = max(1, math.ceil((max(bed.packed.shape[:2]) - 1) / (most_side - 1)))
    cell_m = bed.cell_m * stride
    periods, timing = period_s(fronts), settings.timing
    headings = tuple(float(np.degrees(np.arctan2(e, n)) % 360) for e, n in zip(fronts.east, fronts.north))
    heights = tuple(float(2 * a) for a in fronts.amplitude_m)
    key = (bed.revision, bed.key[0], bed.whole, level.layer_revision("height"), stride, settings.shore.smooth_m, periods,
           headings, heights, settings.shore.height_m, timing.least_depth_m, timing.breaker)  # fmt: skip
    depth = _depth(level, bed.packed[..., 1], bed.cell_m, stride)
    return Asked(key, depth, cell_m, periods, headings, heights, settings.shore.height_m, timing.least_depth_m,
                 timing.breaker)  # fmt: skip


def _depth(level: Level, depth: np.ndarray, cell_m: float, stride: int) -> np.ndarray:
    """Depth without pebbles, every `stride`th sample; kept with the level while it is the same."""
    sigma = max(level.settings.shore.smooth_m / cell_m, 0.5 * (stride - 1))
    smooth = ndimage.gaussian_filter(depth, sigma, mode="nearest", truncate=3) if sigma > 0.05 else depth
    return np.ascontiguousarray(smooth[::stride, ::stride], np.float32)


def arrival(level: Level, time_s: float) -> ArrivalMap | None:
    """When waves come, at a time of a level; None where that follows from the depth alone, or nobody knows yet."""
    if not level.settings.timing.travels:
        return None
    asked = asked_of(level, time_s)
    solver: Solver | None = level.derived.get("solver")
    if solver is not None:
        return solver.answer(asked)
    kept: dict = level.derived.setdefault("arrivals", {})
    if asked.key not in kept:
        kept[asked.key] = solved(asked)
        for key in list(kept)[:-KEPT]:
            del kept[key]
    return kept[asked.key]


def solved(asked: Asked) -> ArrivalMap:
    """Work out a map now."""
    from .travel_time import solve
    from .wave_heights import wave_heights

    rows, cols = asked.depth_m.shape
    times, heights = (np.zeros((rows, cols, 4), np.float32) for _ in range(2))
    plane = np.zeros((SWELLS, 2))
    for i in range(SWELLS):
        way = solve(asked.depth_m, asked.cell_m, asked.period_s[i], asked.heading_deg[i],
                    least_depth_m=asked.least_depth_m)  # fmt: skip
        times[..., i], plane[i] = way.seconds, way.plane
        high = wave_heights(asked.depth_m, asked.cell_m, way, asked.height_m[i], breaker=asked.breaker)
        heights[..., 1 + i] = high.gain
        if i == 0:
            heights[..., 0] = high.height_m / max(asked.shore_height_m, 1e-6)
            times[..., 3] = _at_the_shore(asked, way.seconds, way.reached)
    return ArrivalMap(np.concatenate([times, heights]), asked.cell_m, asked.period_s, plane)


def _at_the_shore(asked: Asked, seconds: np.ndarray, reached: np.ndarray) -> np.ndarray:
    """When waves meet the shoreline that is nearest, in seconds; smooth, or two shores as near would meet in a step."""
    land = asked.depth_m <= 0
    line = reached & ndimage.binary_dilation(land) & ~land
    if not line.any():
        return seconds
    row, col = ndimage.distance_transform_edt(~line, return_distances=False, return_indices=True)
    return ndimage.gaussian_filter(seconds[row, col], 3.0 / asked.cell_m, mode="nearest", truncate=3)


def arrival_uniforms(made: ArrivalMap | None, share: float) -> dict:
    """What shaders/arrival.glsl asks for; made for None too, for a program without it ignores them."""
    if made is None:
        return {}
    return {
        "u_arrival_cell_m": made.cell_m,
        "u_arrival_rate": tuple(1 / period for period in made.period_s),
        "u_arrival_plane": np.asarray(made.plane, np.float32),
        "u_arrival_share": share,
    }
