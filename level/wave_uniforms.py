"""What the level's GLSL is given: the value of each of its uniforms at a time, and what it is compiled with."""

from __future__ import annotations

import numpy as np

from .arrival import arrival, arrival_uniforms, shore_at
from .beach_map import beach_map
from .breaking import breaking_uniforms
from .gerstner import Fronts
from .level import Level
from .loop import moment
from .patches import overrides, patch_uniforms
from .pins import pin_uniforms, pinned
from .plume import mouth_uniforms
from .river_map import has_rivers
from .river_water import river_uniforms
from .sea_keys import fronts_at
from .settings import Sea, Shore
from .shore import shore_map
from .shore_swash import uprush
from .shore_waves import clock_uniforms, s_cycles
from .wave_lists import counted, wave_regions
from .wave_objects import object_uniforms
from .wave_regions import front_rows, region_uniforms
from .waves import sea_height_m
from .weather_keys import level_at


def wave_uniforms(level: Level, t: float) -> dict[str, float | int | np.ndarray]:
    """The value of every uniform that the level's GLSL declares, samplers excepted, at time t."""
    level, t = level_at(level, t), moment(t, level.settings.time.loop_s)
    settings = level.settings
    sea, shore = settings.sea, shore_at(level, t)
    groups = fronts_at(level, t)
    return {
        **_front_uniforms(groups, sea, t),
        **clock_uniforms(shore, t, settings.time.loop_s),
        **_shore_uniforms(shore),
        "u_sea_on": float(sea.on),
        "u_sea_level_m": level.sea_level_m,
        "u_tide_m": level.tide_m,
        "u_tide_on": settings.tide.on,
        "u_deep_start_m": sea.deep_start_m,
        "u_deep_full_m": max(sea.deep_full_m, sea.deep_start_m + 1e-3),
        "u_wave_height_m": sea_height_m(level),  # foam elsewhere stays when an object is placed
        "u_bed_cell_m": shore_map(level).cell_m,
        "u_bed_rows": len(shore_map(level).packed),
        **river_uniforms(level, t),
        **mouth_uniforms(level, t),
        **patch_uniforms(level),
        "u_beach_cell_m": beach_map(level).cell_m,
        **arrival_uniforms(arrival(level, t), settings.timing.share),
        **pin_uniforms(level, t),
        **object_uniforms(level, t),
        **region_uniforms(level, groups, sea.phase_noise, t),
        **breaking_uniforms(shore, s_cycles(shore)),
    }


def _front_uniforms(groups: list[Fronts], sea: Sea, t: float) -> dict[str, float | np.ndarray]:
    way, size, turn = zip(*(row for group in groups for row in front_rows(group, sea.phase_noise, t)), strict=True)
    return {
        "u_front_way": np.array(way, np.float32),
        "u_front_size": np.array(size, np.float32),
        "u_front_turn": np.array(turn, np.float32),
        "u_phase_noise_m": sea.phase_noise_m,
    }


def _shore_uniforms(shore: Shore) -> dict[str, float | int]:
    names = ("range_m", "width", "gap", "runup", "back", "fall", "height_m", "draw_m", "fade_in", "fade_out")
    return {
        **{f"u_shore_{name}": float(getattr(shore, name)) for name in names},
        "u_shore_variety": shore.variety,
        "u_shore_variety_m": shore.variety_m,
        "u_shore_runup_variety": shore.runup_variety,
        "u_shore_runup_by_slope": shore.runup_by_slope,
        "u_shore_interval_s": shore.interval_s,
        "u_shore_stagger": shore.stagger,
        "u_shore_count": shore.count,
        "u_shore_uprush": uprush(shore),
        "u_shore_on": float(shore.on),
        "u_shore_vertex": float(shore.vertex),
        "u_shore_sway": shore.sway,
        "u_shore_slide": float(shore.slide),
    }


def wave_defines(level: Level) -> dict[str, str]:
    """What the level's GLSL is compiled with for what it has; without that it is what it was."""
    asked = {
        "WAVE_OBJECTS": counted(level)[0],
        "WAVE_REGIONS": wave_regions(level),
        "PATCHED": overrides(level),
        "PINS": pinned(level),
        "RIVERS": has_rivers(level),
        "PLUNGE": level.settings.shore.plunge > 0,
    }
    return {name: "" for name, on in asked.items() if on}
