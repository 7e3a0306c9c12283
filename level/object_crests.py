"""When crests of a wave object come to a place (T06, H08): the sum of its three fronts, as the sea shows it there.

An object's waves keep their own time and don't break. Fronts draw the water sideways by a cosine where they raise it by
a sine, so on a crest the water stands where it belongs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .dual import Dual, step
from .level import Level
from .loop import moment
from .objects import WaveObject
from .river_water import river_at
from .shore import shore_map
from .wave_lists import counted
from .wave_objects import circle_weight, front_coordinate, full_depth_m, object_fronts, objects_water, phase_cycles
from .weather_keys import level_at

PERIODS, SAMPLES = 4, 32  # of the leading front: how far ahead crests are looked for, and how often in each
LEAST = 0.3  # of the leading front's amplitude: a lower one is between two groups
EXACT_S = 1e-5
LEAST_M = 0.02  # a lower wave is none that anybody sees


@dataclass(frozen=True)
class ObjectCrest:
    """The next crest of one object at a place: when, how high over the still sea, how fast the leading front is."""

    name: str
    in_s: float
    height_m: float
    speed_mps: float


def highest_object(level: Level, t: float, x: float, y: float) -> tuple[WaveObject, float] | None:
    """The object whose waves stand highest at a world point at time t, and the share of them that is left there."""
    level = level_at(level, t)
    at = np.array([float(x)]), np.array([float(y)])
    bed, sea, best = None, level.settings.sea, None
    for thing in counted(level)[0]:
        share = float(circle_weight(thing, *at).v[0])
        if share <= 0 or not sea.on:
            continue
        if bed is None:
            bed, river = shore_map(level).at(*at, level.tide_m), river_at(level, t, *at)
            bed = bed if river is None else objects_water(sea, bed, river)
        share *= float((step(sea.deep_start_m, full_depth_m(sea, thing), bed["smoothed"]) * bed["sea"]).v[0])
        if share * thing.amplitude_m > max(LEAST_M, best[1] * best[0].amplitude_m if best else 0.0):
            best = thing, share
    return best


def object_crest(level: Level, t: float, x: float, y: float) -> ObjectCrest | None:
    """The next crest of the object whose waves stand highest at a world point; None where none are."""
    found = highest_object(level, t, x, y)
    if found is None:
        return None
    thing, share = found
    seed = level.settings.level.seed
    fronts = object_fronts(thing, seed)
    px, py = Dual(np.array([float(x)]), 1.0, 0.0), Dual(np.array([float(y)]), 0.0, 1.0)
    ways = [front_coordinate(thing, e, n, px, py)[0] for e, n in zip(fronts.east, fronts.north, strict=True)]
    begin = np.array([float(q.v[0]) for q in ways]) / fronts.length_m
    begin = begin - phase_cycles(fronts, moment(t, level.settings.time.loop_s))
    rate = fronts.omega / (2 * np.pi)

    def rises(ahead_s):
        """How fast the water rises, and how high it stands, against full weight."""
        angle = 2 * np.pi * (begin - np.multiply.outer(ahead_s, rate))
        return -(fronts.omega * fronts.amplitude_m * np.cos(angle)).sum(-1), (fronts.amplitude_m * np.sin(angle)).sum(
            -1
        )

    if fronts.omega[0] <= 0:
        return None
    times = np.linspace(0, PERIODS / rate[0], PERIODS * SAMPLES + 1)
    speed, height = rises(times)
    tops = (speed[:-1] > 0) & (speed[1:] <= 0) & (np.maximum(height[:-1], height[1:]) > LEAST * fronts.amplitude_m[0])
    if not tops.any():
        return None
    first = int(np.argmax(tops))
    low, high = times[first], times[first + 1]
    while high - low > EXACT_S:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if rises(middle)[0] > 0 else (low, middle)
    return ObjectCrest(thing.id, float(high), share * float(rises(high)[1]), _speed(ways[0], fronts))


def _speed(way: Dual, fronts) -> float:
    """Of the leading front over the ground: its bent coordinate grows slower than the metres towards its sides."""
    steep = float(np.hypot(np.ravel(way.dx)[0], np.ravel(way.dy)[0]))
    return float(fronts.omega[0] * fronts.length_m[0] / (2 * np.pi) / max(steep, 1e-6))
