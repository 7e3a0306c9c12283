"""The sea's part of the kit: its uniforms over time, its maps, and what the twin says at places to compare with."""

from __future__ import annotations

import copy
import math
from itertools import pairwise

import numpy as np

from ....level import Level
from ....level.arrival import arrival
from ....level.beach_map import beach_map
from ....level.beat import beat
from ....level.flow import current
from ....level.foam_uniforms import CAP_STEPS, foam_uniforms
from ....level.loop import CAP_LIFE_S, FOAM_CYCLES, looped, turns
from ....level.river_map import river_map
from ....level.river_water import wave_times
from ....level.sea_keys import fronts_at
from ....level.setting_uniforms import settings_uniforms
from ....level.shore import shore_map
from ....level.tables import tables
from ....level.textures import foam_texture, noise_texture
from ....level.wave_lists import wave_regions
from ....level.wave_objects import HIGH, LOW, in_passes, object_fronts
from ....level.wave_uniforms import wave_defines, wave_uniforms
from ....level.waves import surface_at
from ....level.weather_keys import keys_of, level_at, points_change, whole_keys
from .changes import switches
from .data import CLOCK, KitData, Made
from .phases import Phase

PROBE_TIMES_S = (0.0, 3.7, 11.3, 61.0, 600.5, 3600.25, 86_400.5, 604_800.75)
PROBES_A_TIME = 25


def sea_defines(level: Level) -> list[str]:
    """What the level's GLSL is to be read with."""
    sea = level_at(level, 0.0)
    return sorted([*wave_defines(sea), *(["TRAVEL_TIME"] if arrival(sea, 0.0) is not None else [])])


def sea_made(level: Level) -> Made:
    """What the sea's uniforms are."""
    at_0, later = sea_uniforms(level, 0.0), level
    moved = [why for why, on in (("the tide", level.settings.tide.on), ("weather keys", whole_keys(level))) if on]
    held = _current_held(level)
    if moved and arrival(level_at(level, 0.0), 0.0) is not None:
        # maps of later moments would have to be solved, each in seconds: what comes of them stays
        later = copy.copy(level)
        later.settings = level.settings.model_copy(
            update={"timing": level.settings.timing.model_copy(update={"source": "depth"})}
        )
        names = [*_timed(at_0, sea_uniforms(later, 0.0)), *(CLOCK if whole_keys(level) else ())]
        held |= dict.fromkeys(names, f"times of arrival change with {' and '.join(moved)}")
    fixed = {name: at_0[name] for name in held if name in at_0}
    clock_hz = 1 / (float(at_0["u_shore_interval_s"]) * int(at_0["u_shore_count"]))
    phases = [*_fronts(later), *_objects(level), *_rivers(level), *_foam(level_at(level, 0.0))]
    loop_s = float(level.settings.time.loop_s)

    def truth(t: float) -> dict:
        return sea_uniforms(later, t) | fixed

    return Made(truth, lambda: sea_maps(level), phases, clock_hz, loop_s, held)


def _timed(at_0: dict, without: dict) -> list[str]:
    """The map of arrival, and the uniforms that follow from it."""
    apart = [name for name, value in at_0.items() if not np.array_equal(value, without.get(name))]
    return ["u_arrival", *apart]


def sea_uniforms(level: Level, t: float) -> dict:
    """All that the sea's GLSL is given at a time, samplers excepted."""
    dated = level_at(level, t)
    return {
        **settings_uniforms(dated.settings),
        **wave_uniforms(level, t),
        **foam_uniforms(dated.settings, t),
        "u_current_cell_m": current(dated).cell_m,
        "u_cell_m": level.grid.cell_m,
    }


def _fronts(level: Level) -> list[Phase]:
    """Of the offshore waves, everywhere and in regions; anew where a key gives a front another length."""
    found, ends = [], [0.0, *switches(level)]
    for low, high in pairwise([*ends, ends[-1] + 20.0]):
        t = (low + high) / 2 if low else 0.0
        at_t, groups = wave_uniforms(level, t), fronts_at(level, t)
        rates = [float(omega) / (2 * math.pi) for group in groups for omega in group.omega]
        for uniform, count in (("u_front_way", 1), ("u_region_way", len(wave_regions(level)))):
            for row, rate in enumerate(rates * count):
                start = float(at_t[uniform][row][2]) - rate * t
                found.append(Phase(uniform, row, 2, start, rate, from_s=low))
    return found


def _objects(level: Level) -> list[Phase]:
    at_0, passes, found = wave_uniforms(level, 0.0), in_passes(level), []
    for n, thing in enumerate([*passes[HIGH], *passes[LOW]]):
        for i, omega in enumerate(object_fronts(thing, level.settings.level.seed).omega):
            row = 3 * n + i
            found.append(Phase("u_wave_way", row, 3, float(at_0["u_wave_way"][row][3]), float(omega) / (2 * math.pi)))
    return found


def _rivers(level: Level) -> list[Phase]:
    once = wave_times(level, 1e-3)  # both begin at 0 and need longer than that
    return [Phase("u_river_wave_time", -1, i, 0.0, float(gone) / 1e-3) for i, gone in enumerate(once)]


def _foam(level: Level) -> list[Phase]:
    """Of foam that moves, and of whitecaps: two generations half a life apart."""
    loop_s, rate = level.settings.time.loop_s, 1 / level.settings.flow.interval_s
    found = [Phase("u_foam_cycle", -1, 0, 0.0, rate), Phase("u_foam_cycle", -1, 1, 0.0, rate, FOAM_CYCLES, "whole")]
    rate, again = 1 / looped(CAP_LIFE_S, loop_s), turns(CAP_LIFE_S, loop_s)
    for i in (0, 1):
        found.append(Phase("u_cap_age", -1, i, 0.5 * i, rate, offset=-0.5))
        found.append(Phase("u_cap_age", -1, 2 + i, 0.5 * i, rate, form="ramp"))
        for j, step in enumerate(CAP_STEPS):
            part = 2 * i + j
            found.append(Phase("u_cap_place", -1, part, 0.5 * i, rate, again, "hop", hop=2 * step, first=i * step))
    return found


def _current_held(level: Level) -> dict[str, str]:
    moved = any(points_change(level, key.time_s + key.fade_s + 1.0) for key in keys_of(level))
    return {"u_current": "flow points change with weather keys"} if moved else {}


def sea_maps(level: Level) -> dict[str, np.ndarray]:
    """Maps (rows, cols, channels) by sampler, row 0 south; uint8 those of textures that tile, float32 the others."""
    level = level_at(level, 0.0)
    rivers, bed, made = river_map(level), shore_map(level).packed, arrival(level, 0.0)
    foam = level.layers["foam"]
    painted = np.zeros((1, 1, 2)) if foam.neutral else foam.array.astype(np.float16)  # as the editor's texture has it
    found = {
        "u_bed": bed if rivers is None else np.concatenate([bed, rivers.packed]),
        "u_tables": tables(level),
        "u_beach": beach_map(level).packed,
        "u_current": current(level).packed,
        "u_layer_foam": painted,
    }
    if made is not None:
        found["u_arrival"] = made.texture
    found = {name: np.ascontiguousarray(values, "<f4") for name, values in found.items()}
    return found | {"u_noise": noise_texture(), "u_foam": foam_texture()}


def sea_probes(data: KitData) -> list[dict]:
    """The twin's sea at undeformed points, for times that the kit reaches: only 0 where something held moves it."""
    rng = np.random.default_rng(11)
    east, north = data.level.grid.extent_m
    found = []
    for t in PROBE_TIMES_S[: 1 if data.held.keys() - {"u_current"} else None]:
        beat()
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
