"""The numbers of a level's sea for the kit: uniforms at time 0, phases and how fast they grow, maps, probes."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ....level import Level
from ....level.arrival import arrival
from ....level.beach_map import beach_map
from ....level.flow import current
from ....level.loop import FOAM_CYCLES, turns
from ....level.river_map import river_map
from ....level.river_water import wave_times
from ....level.sea_keys import fronts_at
from ....level.shore import shore_map
from ....level.tables import tables
from ....level.wave_lists import wave_regions
from ....level.wave_objects import HIGH, LOW, in_passes, object_fronts
from ....level.wave_uniforms import wave_defines, wave_uniforms
from ....level.waves import surface_at
from ....level.weather_keys import level_at, whole_keys
from .tree import Unit
from .write_data import CYCLES

PROBE_TIMES_S = (0.0, 3.7, 11.3, 61.0, 600.5, 3600.25, 86_400.5, 604_800.75)
PROBES_A_TIME = 25


@dataclass(frozen=True)
class Phase:
    """Component `part` of row `row` (-1: the uniform has none) of a uniform is fract(start + rate_hz · t).

    With `turns` it is the number of whole ones instead, modulo that.
    """

    uniform: str
    row: int
    part: int
    start: float
    rate_hz: float
    turns: int = 0

    def at(self, t: float) -> float:
        """Its value at a time."""
        cycles = self.start + self.rate_hz * t
        return math.floor(cycles) % self.turns if self.turns else cycles % 1.0


@dataclass(frozen=True)
class SeaData:
    """What `level` makes of the kit's uniforms; `held` those that only stand still in it."""

    level: Level
    values: dict[str, np.ndarray]
    phases: list[Phase]
    clock_hz: float
    loop_s: float
    maps: dict[str, np.ndarray]
    held: list[str]


def level_defines(level: Level) -> list[str]:
    """What the level's GLSL is to be read with."""
    sea = level_at(level, 0.0)
    return sorted([*wave_defines(sea), *(["TRAVEL_TIME"] if arrival(sea, 0.0) is not None else [])])


def sea_data(level: Level, unit: Unit) -> SeaData:
    """The numbers for the uniforms that a unit declares."""
    sea = level_at(level, 0.0)
    at_0 = {**wave_uniforms(sea, 0.0), **_flow_uniforms(sea)}
    wanted = [one.name for one in unit.variables("uniform") if one.type != "sampler2D"]
    values = {name: np.asarray(at_0[name]) for name in wanted}
    clock_hz = 1 / (float(at_0["u_shore_interval_s"]) * int(at_0["u_shore_count"]))
    loop_s = float(sea.settings.time.loop_s)
    phases = [phase for phase in _phases(sea, at_0) if phase.uniform in values]
    names = [one.name for one in unit.variables("uniform") if one.type == "sampler2D"]
    maps = {name: sea_maps(sea)[name] for name in names}
    made = SeaData(sea, values, phases, clock_hz, loop_s, maps, [])
    return replace(made, held=_held(level, made))


def _phases(level: Level, at_0: dict) -> list[Phase]:
    groups = fronts_at(level, 0.0)
    rates = [float(omega) / (2 * math.pi) for group in groups for omega in group.omega]
    found = [Phase("u_front_way", i, 2, float(at_0["u_front_way"][i][2]), rate) for i, rate in enumerate(rates)]
    for n in range(len(wave_regions(level))):
        rows = [n * len(rates) + i for i in range(len(rates))]
        found += [Phase("u_region_way", row, 2, float(at_0["u_region_way"][row][2]), rate)
                  for row, rate in zip(rows, rates, strict=True)]  # fmt: skip
    passes = in_passes(level)
    for n, thing in enumerate([*passes[HIGH], *passes[LOW]]):
        for i, omega in enumerate(object_fronts(thing, level.settings.level.seed).omega):
            row = 3 * n + i
            found.append(Phase("u_wave_way", row, 3, float(at_0["u_wave_way"][row][3]), float(omega) / (2 * math.pi)))
    once = wave_times(level, 1e-3)  # both begin at 0 and need longer than that
    found += [Phase("u_river_wave_time", -1, i, 0.0, float(gone) / 1e-3) for i, gone in enumerate(once)]
    rate = 1 / level.settings.flow.interval_s
    return [*found, Phase("u_foam_cycle", -1, 0, 0.0, rate), Phase("u_foam_cycle", -1, 1, 0.0, rate, FOAM_CYCLES)]


def _flow_uniforms(level: Level) -> dict:
    flow, loop_s = level.settings.flow, level.settings.time.loop_s
    return {
        "u_foam_tile_m": level.settings.water.foam_tile_m,
        "u_foam_cycle": (0.0, 0.0, flow.interval_s if flow.on else 0.0),
        "u_foam_turns": float(turns(flow.interval_s, loop_s)),
        "u_current_cell_m": current(level).cell_m,
    }


def uniforms_at(data: SeaData, t: float) -> dict[str, np.ndarray]:
    """What the kit's `sea_at_time` makes of the uniforms."""
    t = t % data.loop_s if data.loop_s > 0 else t
    values = {name: np.array(value) for name, value in data.values.items()}
    for phase in data.phases:
        at = (phase.part,) if phase.row < 0 else (phase.row, phase.part)
        values[phase.uniform][at] = phase.at(t)
    waves = t * data.clock_hz
    values["u_shore_clock"] = np.asarray(waves - math.floor(waves))
    values["u_shore_cycle"] = np.asarray(math.floor(waves) % CYCLES)
    return values


def _held(level: Level, data: SeaData) -> list[str]:
    """Uniforms that change with time in the level (tide, keys of the weather) and not in the kit."""
    found: set[str] = set()
    times = [0.3 * level.settings.tide.period_s, 3600.25, *(key.time_s + key.fade_s + 1.0 for key in whole_keys(level))]
    for t in times:
        ours, its = uniforms_at(data, t), wave_uniforms(level, t)
        found |= {name for name in ours if name in its and np.abs(_apart(ours[name], its[name])).max() > 1e-4}
    return sorted(found)


def _apart(a, b) -> np.ndarray:
    off = np.asarray(a, np.float64) - np.asarray(b, np.float64)
    return np.where(np.abs(np.abs(off) - 1.0) < 1e-4, 0.0, off)  # phases just before and just after a turn


def sea_maps(level: Level) -> dict[str, np.ndarray]:
    """float32 maps (rows, cols, channels) by sampler, row 0 south."""
    rivers, bed, made = river_map(level), shore_map(level).packed, arrival(level, 0.0)
    found = {
        "u_bed": bed if rivers is None else np.concatenate([bed, rivers.packed]),
        "u_tables": tables(level),
        "u_beach": beach_map(level).packed,
        "u_current": current(level).packed,
    }
    if made is not None:
        found["u_arrival"] = made.texture
    return {name: np.ascontiguousarray(values, "<f4") for name, values in found.items()}


def probes(data: SeaData) -> list[dict]:
    """The twin's sea at undeformed points, for times that the kit reaches: only 0 where something is held."""
    rng = np.random.default_rng(11)
    east, north = data.level.grid.extent_m
    found = []
    for t in PROBE_TIMES_S[: 1 if data.held else None]:
        x = np.float32(rng.uniform(0, east, PROBES_A_TIME)).astype(np.float64)
        y = np.float32(rng.uniform(0, north, PROBES_A_TIME)).astype(np.float64)
        sea = surface_at(data.level, t, x, y)
        for i in range(PROBES_A_TIME):
            found.append({
                "time_s": t, "before": [x[i], y[i]],
                "position": [float(v[i]) for v in (sea.x, sea.y, sea.height_m)],
                "normal": [float(v) for v in sea.normal[i]],
            })  # fmt: skip
    return found
