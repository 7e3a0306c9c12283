"""Regions of swell: places in which the sea's own groups are higher, longer, faster or turned (Diablo IV talk, D32).

A second set of fronts is evaluated and *displacements* are blended by weight: a blend of phases would tear. The second
set is anchored at the region's middle, where its phase is the sea's own at t = 0, so that small changes stay near it.
Swells on their way over the bed (T06) keep their times of arrival in a region that changes no more than their height;
longer, faster or turned ones are plane waves there, for no map says when those would come.
The twin is shaders/wave_regions.glsl.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .gerstner import PHASE_GAIN, Fronts
from .level import Level
from .outline import band_m, edges_of, reach_m, whole_m
from .water_objects import MOST_OUTLINE, SwellRegion
from .wave_lists import MOST_REGIONS, wave_regions


def region_fronts(fronts: Fronts, region: SwellRegion) -> Fronts:
    """A group as it is within a region; all factors 1 and no turn: the very same."""
    turn = np.radians(region.turn_deg)
    length = fronts.length_m * region.length
    fold_m = 0.9 * length / (2 * np.pi * len(length))
    return replace(
        fronts, east=fronts.east * np.cos(turn) + fronts.north * np.sin(turn),
        north=fronts.north * np.cos(turn) - fronts.east * np.sin(turn), length_m=length,
        omega=fronts.omega * region.speed / np.sqrt(region.length), amplitude_m=fronts.amplitude_m * region.amplitude,
        lateral_m=np.minimum(fronts.lateral_m * region.amplitude, fold_m),
    )  # fmt: skip


def keeps_times(region: SwellRegion) -> bool:
    """Whether swells come when they would without it."""
    return (region.length, region.speed, region.turn_deg) == (1.0, 1.0, 0.0)


def ahead(fronts: Fronts, there: Fronts, region: SwellRegion) -> np.ndarray:
    """Cycles to add to a region's fronts so that at its middle they begin as the sea's own do, by front, 0 … 1."""
    own, its = ((f.east * region.x + f.north * region.y) / f.length_m for f in (fronts, there))
    return np.mod(own - its, 1.0)


def most_amplitude(level: Level) -> float:
    """How much higher than elsewhere the sea is in some region, × (1 or more)."""
    return max([1.0, *(region.amplitude for region in wave_regions(level))])


def region_uniforms(level: Level, groups: list[Fronts], noise: float, t: float) -> dict:
    """What shaders/wave_regions.glsl asks for, {} without regions."""
    regions = wave_regions(level)
    if not regions:
        return {}
    count = sum(len(fronts.length_m) for fronts in groups)
    place = np.zeros((MOST_REGIONS, 4), np.float32)
    way, size = np.zeros((2, MOST_REGIONS * count, 4), np.float32)
    edges, band = np.zeros((MOST_REGIONS * MOST_OUTLINE, 4), np.float32), np.zeros((MOST_REGIONS, 4), np.float32)
    for n, region in enumerate(regions):
        place[n] = region.x, region.y, whole_m(region), reach_m(region)
        band[n] = len(region.outline) // 2, *band_m(region), keeps_times(region)
        if region.outline:
            own = edges_of(region.outline)
            edges[n * MOST_OUTLINE : n * MOST_OUTLINE + len(own)] = own
        rows = []
        for fronts in groups:
            there = region_fronts(fronts, region)
            rows += front_rows(there, noise, t, ahead(fronts, there, region))
        way[n * count : (n + 1) * count] = [row[0] for row in rows]
        size[n * count : (n + 1) * count] = [row[1] for row in rows]
    return {
        "u_region_count": len(regions), "u_region_place": place, "u_region_way": way, "u_region_size": size,
        "u_region_edge": edges, "u_region_band": band,
    }  # fmt: skip


def front_rows(fronts: Fronts, noise: float, t: float, begin=0.0) -> list[tuple]:
    """`u_front_way`, `u_front_size` and `u_front_turn` of each front of a group at time t, `begin` cycles ahead."""
    phase = np.mod(np.mod(fronts.omega * t / (2 * np.pi), 1.0) - begin, 1.0)
    return [
        (
            (east / length, north / length, phase[i], 2 * np.pi / length),
            (fronts.amplitude_m[i], fronts.lateral_m[i], east, north),
            (noise * PHASE_GAIN[len(fronts.length_m)][i], fronts.begin[i]),
        )
        for i, (east, north, length) in enumerate(zip(fronts.east, fronts.north, fronts.length_m, strict=True))
    ]
