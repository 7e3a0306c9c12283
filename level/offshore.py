"""Where the offshore waves carry undeformed points (D30): swell, its regions, chop, wave objects, what a river leaves.

Groups come one after another, each by where those before it have carried the point.
"""

from __future__ import annotations

import numpy as np

from .arrival_map import ArrivalMap
from .dual import Dual, step
from .gerstner import Deformed, Fronts, phase_noise, shift, shifted, travel
from .level import Level
from .outline import region_weight
from .pins import later
from .river_map import has_rivers
from .river_water import river_at
from .shore import ShoreMap
from .wave_lists import wave_regions
from .wave_objects import HIGH, LOW, objects_shift, objects_water
from .wave_regions import ahead, keeps_times, region_fronts


def _weight(level: Level, bed: dict[str, Dual]) -> Dual:
    sea = level.settings.sea
    full = max(sea.deep_full_m, sea.deep_start_m + 1e-3)
    return step(sea.deep_start_m, full, bed["smoothed"]) * bed["sea"] * float(sea.on)


def offshore(
    level: Level, shore: ShoreMap, fronts: list[Fronts], made: ArrivalMap | None, t: float, x, y
) -> tuple[Deformed, Dual]:
    bed = shore.at(x, y, level.tide_m)
    weight = chop = _weight(level, bed)
    water = bed
    if has_rivers(level):
        river = river_at(level, t, x, y)
        water = objects_water(level.settings.sea, bed, river)
        weight, chop = weight * river.waves, weight * river.chop
    point = Deformed(Dual(x, 1.0, 0.0), Dual(y, 0.0, 1.0), Dual(np.zeros_like(x)))
    for which, group in zip((HIGH, LOW)[-len(fronts) :], fronts, strict=True):
        added = objects_shift(level, which, t, point.x, point.y, x, y, water)  # of the same base as the group (H06)
        moved = _group_shift(level, group, point, t, x, y, made if which == LOW else None)
        point = shifted(point, moved, weight if which == LOW else chop)
        point = shifted(point, added, Dual(1.0))
    return point, weight


def _group_shift(
    level: Level, group: Fronts, point: Deformed, t: float, x, y, made: ArrivalMap | None
) -> tuple[Dual, Dual, Dual]:
    """What one group of full weight moves points, in regions of swell blended with theirs (D32)."""
    sea = level.settings.sea

    def noises(fronts: Fronts, begin) -> list[Dual]:
        first, *others = (phase_noise(sea, fronts, i, x, y) + cycles for i, cycles in enumerate(begin))
        return [first if made is None else later(level, t, x, y, first), *others]

    def of(fronts: Fronts, begin) -> tuple[Dual, Dual, Dual]:
        return shift(point, fronts, t, noises(fronts, begin))

    still = np.zeros(len(group.length_m))
    passing = None if made is None else made.at(point.x.v, point.y.v)

    def passed(fronts: Fronts) -> tuple[Dual, Dual, Dual]:
        return of(fronts, still) if passing is None else travel(point, fronts, t, noises(fronts, still), passing)

    moved = passed(group)
    for region in wave_regions(level):
        weight = region_weight(region, x, y)
        if np.any(weight.v > 0):
            its = region_fronts(group, region)
            travels = passing is not None and keeps_times(region)
            there = passed(its) if travels else of(its, ahead(group, its, region))
            moved = tuple(a + (b - a) * weight for a, b in zip(moved, there, strict=True))
    return moved
