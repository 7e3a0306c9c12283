"""The numbers of a part of the kit: uniforms at time 0, what changes them over time, maps, and what stands still."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from ....level import Level
from ....level.beat import beat
from .changes import NO_TRACK, Tide, Track, knots_of, tide_of, track_of
from .phases import Phase
from .tree import Unit

CYCLES = 4096  # of the shore clock, after which the same waves come
CLOCK = ("u_shore_clock", "u_shore_cycle")
OFF, TRACKED = 1e-4, 2e-3  # what a uniform may be off and not be called held, of its size or of 1; that by a track


@dataclass(frozen=True)
class KitData:
    """What a level makes of the uniforms of a part; `held` are those that only stand still in it, with the reason."""

    level: Level
    values: dict[str, np.ndarray]
    maps: dict[str, np.ndarray]
    phases: list[Phase]
    clock_hz: float = 0.0
    loop_s: float = 0.0
    tide: Tide | None = None
    track: Track = NO_TRACK
    held: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Made:
    """What one part says of a level: `truth` gives all uniforms at a time, `maps` all maps by sampler."""

    truth: Callable[[float], dict]
    maps: Callable[[], dict[str, np.ndarray]]
    phases: list[Phase]
    clock_hz: float = 0.0
    loop_s: float = 0.0
    held: dict[str, str] = field(default_factory=dict)


def kit_data(level: Level, unit: Unit, made: Made) -> KitData:
    """The numbers for the uniforms that a unit declares."""
    at_0 = made.truth(0.0)
    values = {one.name: np.asarray(at_0[one.name]) for one in unit.variables("uniform") if one.type != "sampler2D"}
    phases = [phase for phase in made.phases if phase.uniform in values]
    maps = made.maps()
    maps = {one.name: maps[one.name] for one in unit.variables("uniform") if one.type == "sampler2D"}
    found = KitData(level, values, maps, phases, made.clock_hz, made.loop_s, tide_of(level, values))
    knots = knots_of(level)
    names = _differing(found, made.truth, knots, OFF)
    moving = [name for name in names if np.asarray(at_0[name]).dtype.kind == "f"]
    found = replace(found, track=track_of(knots, moving, lambda t: _without_phases(made.truth(t), phases, moving)))
    held = dict.fromkeys(_differing(found, made.truth, knots, TRACKED), "it changes in jumps, or in a way of its own")
    return replace(found, held=held | {name: why for name, why in made.held.items() if name in values or name in maps})


def _without_phases(values: dict, phases: list[Phase], names: list[str]) -> dict:
    """Some uniforms with 0 for what phases say."""
    found = {name: np.array(values[name], np.float64) for name in names}
    for phase in phases:
        if phase.uniform in found:
            found[phase.uniform][phase.place(found[phase.uniform])] = 0.0
    return found


def uniforms_at(data: KitData, t: float) -> dict[str, np.ndarray]:
    """What the kit's code makes of the uniforms at a time."""
    t = t % data.loop_s if data.loop_s > 0 else t
    values = {name: np.array(value) for name, value in data.values.items()}
    values |= {name: data.track.at(name, t) for name in data.track.values}
    for phase in data.phases:
        if t < phase.from_s:
            continue
        values[phase.uniform][phase.place(values[phase.uniform])] = phase.at(t)
    if data.clock_hz:
        waves = t * data.clock_hz
        values |= zip(
            CLOCK, (np.asarray(waves - math.floor(waves)), np.asarray(math.floor(waves) % CYCLES)), strict=True
        )
    if data.tide:
        values |= {name: np.asarray(base + tide_at(data, t)) for name, base in data.tide.base.items()}
    return values


def tide_at(data: KitData, t: float) -> float:
    """The tide as the kit's code has it, metres over the mean level."""
    from ....level.tide import curve_at

    tide = data.tide
    return tide.range_m * float(curve_at(tide.curve, (t - tide.high_s) / tide.period_s) - 0.5)


def _differing(data: KitData, truth: Callable[[float], dict], knots: list[float], off: float) -> list[str]:
    """Uniforms that change with time in the level and not in the kit, or not alike."""
    tide_s = data.level.settings.tide.period_s
    times = [0.3 * tide_s, 0.55 * tide_s, 3600.25, *[t + 0.37 for t in knots[::5]], *[t + 1.0 for t in knots[-1:]]]
    found: dict[str, None] = {}
    for t in times:
        beat()
        ours, its = uniforms_at(data, t), truth(t)
        wraps = {phase.uniform: phase.scale for phase in data.phases}
        for name in ours.keys() - set(CLOCK):
            if not _apart(ours[name], its[name], wraps.get(name, 0.0)) <= off:  # NaN is apart too
                found[name] = None
    return sorted(found)


def _apart(a, b, wraps: float) -> float:
    """The largest difference against a number's size or 1, whole turns of what goes round left out."""
    a, b = np.asarray(a, np.float64), np.asarray(b, np.float64)
    off = np.abs(a - b)
    off = np.minimum(off, np.abs(off - wraps)) if wraps else off
    return float((off / np.maximum(np.abs(b), max(1.0, wraps))).max())
