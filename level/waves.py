"""The CPU twin of the sea (D30): height, normal and masks at any world point and time, equal to the shader's.

Stateless in t. Games spawn particles and float things with it; tests hold the shader to it.
"""

from __future__ import annotations

import copy
from dataclasses import dataclass, replace

import numpy as np

from .arrival import arrival, shore_at
from .arrival_map import ArrivalMap
from .beach_map import NO_BEACH_M, beach_map
from .breaking import BREAK_S, break_rate, feels_from, overhang_m
from .dual import Dual, at_most, step
from .force import ForceField
from .gerstner import Deformed, Fronts, phase_noise, through
from .level import Level
from .loop import moment
from .noise import lattice
from .offshore import offshore
from .patches import beach_contact, patch_shore
from .pins import later
from .river_map import river_map
from .river_water import River, river_at
from .sea_keys import fronts_at, largest_amplitude_m
from .shore import shore_map
from .shore_waves import ShoreMasks, Travel, before_waves, s_cycles, shore_masks
from .spline import second_order
from .uncarried import Moved, uncarried
from .wave_objects import most_height_m
from .wave_regions import most_amplitude
from .weather_keys import level_at

DEEP_M = 4.0  # there is no sand that the slice knows
INVERSIONS = 12  # fixed-point steps from world xy back to the undeformed point; each shrinks the error by the slope


@dataclass
class SeaSample:
    """The surface at some points, arrays of one shape; metres; `normal` has a last axis of 3.

    `sheet_m` is the water over the sand; at or below 0 the sheet lies on it without thickness (H10).
    """

    x: np.ndarray
    y: np.ndarray
    height_m: np.ndarray
    normal: np.ndarray
    before_x: np.ndarray
    before_y: np.ndarray
    deep: np.ndarray
    shore: ShoreMasks
    depth_m: np.ndarray
    clock_depth_m: np.ndarray
    sheet_m: np.ndarray


def _under(level: Level, bed: dict[str, Dual], sand: Dual) -> np.ndarray:
    """The sand that the sheet slides on, over the still sea: only where the sea comes (H10)."""
    shore = level.settings.shore
    deep = before_waves(shore, bed) & (bed["depth"].v > DEEP_M)
    return np.where((bed["sea"].v > 0) & shore.slide & ~deep, sand.v - level.tide_m, NO_BEACH_M)


@dataclass
class _Shore:
    """The shore waves at some points that the offshore waves have carried: bed, sand and masks there."""

    bed: dict[str, Dual]
    sand: Dual
    masks: ShoreMasks
    river: River | None = None


def _shore_waves(level: Level, t: float, fronts: list[Fronts], made: ArrivalMap | None, x, y) -> _Shore:
    shore, settings = shore_map(level), level.settings
    bed = shore.at(x, y, level.tide_m)
    bed["within"] = bed["within"] * patch_shore(level, x, y)
    sand, sway = beach_map(level).at(x, y)
    breaks, share, late = settings.shore.plunge > 0, settings.timing.share, later(level, t, x, y)
    way = None
    if made is not None:
        bend = later(level, t, x, y, phase_noise(settings.sea, fronts[-1], 0, x, y))
        asked = breaks or settings.shore.runup_by_slope > 0
        steep, found = made.steep(x, y) if breaks else None, made.breaks(x, y) if asked else None
        way = Travel.of(made.at(x, y), bend, share, steep, found)
    steep = second_order(shore.packed[..., 3], shore.cell_m, x, y) if breaks else None
    values, loop_s = lattice(settings.level.seed), settings.time.loop_s
    masks = shore_masks(
        shore_at(level, t), t, bed, x, y, sway, values, loop_s, way, late * (1 - share), steep
    )  # fmt: skip
    river = river_at(level, t, x, y)
    return _Shore(bed, sand, masks if river is None else _met(masks, river.waves), river)


def _met(masks: ShoreMasks, waves: Dual) -> ShoreMasks:
    """What a river leaves of shore waves; where it makes them higher, they stay as wide."""
    return replace(masks.faded(at_most(1.0, waves)), lift=masks.lift * waves)


def _normal(point: Deformed, slope_x: np.ndarray, slope_y: np.ndarray) -> np.ndarray:
    """From how position and height change with the undeformed x and y (H29)."""
    east = np.stack(np.broadcast_arrays(point.x.dx, point.y.dx, slope_x), -1)
    north = np.stack(np.broadcast_arrays(point.x.dy, point.y.dy, slope_y), -1)
    normal = np.cross(east, north)
    return normal / np.linalg.norm(normal, axis=-1, keepdims=True)


def surface_at(
    level: Level, t: float, before_x, before_y, skip_chop: bool = False, force: ForceField | None = None
) -> SeaSample:  # fmt: skip
    """The surface that the undeformed points `before_x, before_y` (world metres, arrays) are carried to at time t.

    `skip_chop` leaves out the high group, as physics may (H22); `force` adds what that field lifts (D18).
    """
    level, loop_s = level_at(level, t), level.settings.time.loop_s
    t = moment(t, loop_s)
    x, y = np.broadcast_arrays(np.asarray(before_x, np.float64), np.asarray(before_y, np.float64))
    shore = shore_map(level)
    fronts, made = fronts_at(level, t)[1 if skip_chop else 0 :], arrival(level, t)
    point, weight = offshore(level, shore, fronts, made, t, x, y)
    after_x, after_y = point.x.v, point.y.v
    here = _shore_waves(level, t, fronts, made, after_x, after_y)
    bed, sand, masks = here.bed, here.sand, here.masks
    lift = masks.lift if here.river is None else masks.lift + here.river.rise
    if force is not None:
        floats, depth = bed["sea"], bed["depth"]
        if here.river is not None:
            floats, depth = floats * (1 - here.river.share) + here.river.share, depth + here.river.rise
        lift = lift + force.lift(after_x, after_y) * floats * step(0.0, 0.5, depth)
    sheet = point.z.v + lift.v - _under(level, bed, sand)
    # H10: the higher of the two, with its slope
    held = np.where(sheet < 0, beach_contact(level, after_x, after_y).v, 0.0)
    up_x, up_y = (wave + held * (land - wave) for wave, land in ((lift.dx, sand.dx), (lift.dy, sand.dy)))
    slope_x = (1 - held) * point.z.dx + up_x * point.x.dx + up_y * point.y.dx
    slope_y = (1 - held) * point.z.dy + up_x * point.x.dy + up_y * point.y.dy
    point = _carried_on(point, masks.shift)
    return SeaSample(
        point.x.v, point.y.v, level.sea_level_m + point.z.v + lift.v - held * sheet,
        _normal(point, slope_x, slope_y), x, y,
        np.minimum(weight.v, 1.0), masks, bed["depth"].v, bed["clock"].v, sheet,
    )  # fmt: skip


def _carried_on(point: Deformed, shift: tuple[Dual, Dual] | None) -> Deformed:
    """A point carried by the shore wave that breaks there (H23); `shift` by where the offshore waves took it."""
    if shift is None:
        return point
    x = point.x + Dual(shift[0].v, *through(shift[0], point))
    y = point.y + Dual(shift[1].v, *through(shift[1], point))
    return Deformed(x, y, point.z)


def sea_at(level: Level, t: float, x, y, skip_chop: bool = False, force: ForceField | None = None) -> SeaSample:
    """The surface at **world** points x, y (metres, arrays) and time t; the lateral shift is inverted.

    Without weather keys `t` may be an array of the points' shape, each with a time of its own.
    """
    level, t = level_at(level, t), moment(t, level.settings.time.loop_s)
    x, y = np.broadcast_arrays(np.asarray(x, np.float64), np.asarray(y, np.float64))
    shore = shore_map(level)
    fronts, made = fronts_at(level, t)[1 if skip_chop else 0 :], arrival(level, t)
    if level.settings.shore.plunge > 0:
        x, y = _before_breaking(level, t, fronts, made, x, y)
    before_x, before_y = x.copy(), y.copy()
    for _ in range(INVERSIONS):
        point, _ = offshore(level, shore, fronts, made, t, before_x, before_y)
        off_x, off_y = x - point.x.v, y - point.y.v
        before_x, before_y = before_x + off_x, before_y + off_y
        if max(np.abs(off_x).max(initial=0), np.abs(off_y).max(initial=0)) < 1e-6:
            break
    return surface_at(level, t, before_x, before_y, skip_chop, force)


def _before_breaking(level: Level, t: float, fronts: list[Fronts], made: ArrivalMap | None, x, y):
    """Where shore waves that break carry world points from (H23). Under a lip there are three: the highest is taken."""
    shape, at, shore = x.shape, np.stack([x.ravel(), y.ravel()]), shore_at(level, t)
    tide_m = np.broadcast_to(level.tide_m, shape).ravel() if np.ndim(level.tide_m) else level.tide_m
    bed = shore_map(level).at(*at, tide_m)
    s = 1.0 - bed["smoothed"].v / shore.range_m
    # by times of travel waves may break anywhere
    here = 0.0 if made is not None else (s - BREAK_S) * break_rate(shore, s_cycles(shore))
    near = (here > feels_from(shore, s_cycles(shore))) & (s < 1 + shore.runup) & ~before_waves(shore, bed)
    if not near.any():
        return x, y

    times = np.broadcast_to(t, shape).ravel()[near] if np.ndim(t) else t
    tides = np.broadcast_to(level.tide_m, shape).ravel()[near] if np.ndim(level.tide_m) else None
    rises = None if tides is None or made is None else np.broadcast_to(made.rise, shape).ravel()[near]

    def carried(at: np.ndarray, which: np.ndarray) -> Moved:
        here, its = level, made
        if tides is not None:
            here = copy.copy(level)
            here.tide_m = tides[which]
            its = made if rises is None else made.only(rises[which])
        masks = _shore_waves(here, times[which] if np.ndim(times) else times, fronts, its, *at).masks
        return Moved(masks.shift, masks.way, masks.lift.v)

    at[:, near] = uncarried(carried, at[:, near], overhang_m(shore))
    return at[0].reshape(shape), at[1].reshape(shape)


def sea_height_m(level: Level) -> float:
    """The largest height the wave sum can reach over the still sea where no wave object or region is."""
    shore = level.settings.shore
    return max(largest_amplitude_m(level), shore.height_m + shore.range_m * shore.runup, 1e-3)


def largest_height_m(level: Level) -> float:
    """The largest height the wave sum can reach over the still sea anywhere."""
    offshore, rivers = largest_amplitude_m(level) * most_amplitude(level), river_map(level)
    gain = 1.0 if rivers is None else rivers.most_gain
    return gain * max(sea_height_m(level), offshore) + most_height_m(level)
