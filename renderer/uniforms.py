"""Uniforms: all that a frame's passes may ask for, and one helper that skips what the compiler removed."""

from __future__ import annotations

import numpy as np

from ..level import Level, Settings
from ..level.rain_rings import mean_slope2, rain_drops
from ..level.rings import MOST, rings
from ..level.setting_uniforms import settings_uniforms
from ..level.shore_field import shore_field
from ..level.tide import band_m, left_s
from ..level.water_table import table_in_use
from ..level.wave_uniforms import wave_uniforms
from .look import look_uniforms, wave_slopes
from .quality import APRON_DEPTH_M, APRON_M

WET_WAVES = 4  # so many waves back sand remembers each (lib/wet.glsl)


def frame_uniforms(frame) -> dict:
    """What every pass may ask for: camera, settings, waves, light, show flags (samplers and mesh excepted)."""
    level, matrices = frame.level, frame.matrices
    forward = -matrices.view[2]
    return {
        **settings_uniforms(level.settings),
        **look_uniforms(level.settings, frame.time_s, frame.sky.light),
        **wave_uniforms(level, frame.time_s),
        **frame.show.uniforms(),
        "u_camera": tuple(matrices.position),
        "u_forward": tuple(forward),
        "u_view_projection": np.ascontiguousarray(matrices.view_projection.T, np.float32),
        "u_ray_centre": tuple(matrices.ray_centre),
        "u_ray_x": tuple(matrices.ray_x),
        "u_ray_y": tuple(matrices.ray_y),
        "u_size": tuple(float(side) for side in frame.size),
        "u_pixel_angle": 2 * float(np.linalg.norm(matrices.ray_y)) / frame.size[1],
        "u_extent_m": level.grid.extent_m,
        "u_cell_m": level.grid.cell_m,
        "u_apron": (APRON_M, APRON_DEPTH_M),
        "u_still_m": level.mean_sea_m,
        "u_sea_now_m": level.sea_level_m,
        "u_tide_left_s": left_s(level.settings, frame.time_s),
        "u_tide_band_m": tuple(level.mean_sea_m + part for part in band_m(level.settings)),
        "u_table_on": table_in_use(level) is not None,
        "u_wet_waves": WET_WAVES if frame.tier.sea_exact else 2,
        "u_swash_top_m": level.settings.shore.range_m * level.settings.shore.runup,
        **ring_uniforms(level, frame.time_s, matrices.position),
        **rain_ring_uniforms(level, frame.time_s, matrices.position, frame.camera.id),
        **_sea_shape(level.settings),
        **(
            {"u_light_cloud_cover": 0.0, "u_cirrus": 0.0} if level.settings.clouds.on else {}
        ),  # they stand there by themselves
    }


def _sea_shape(settings: Settings) -> dict:
    """How the sea coarsens with distance (H31), and how steep waves are that mesh and pixels no longer carry."""
    sea = settings.sea
    chop, swell = wave_slopes(sea, settings.level.seed, 0.0).sum(axis=1)
    return {
        "u_sea_near_m": sea.near_m,
        "u_sea_falloff": sea.falloff,
        "u_sea_length_m": (sea.swell_length_m, sea.chop_length_m),
        "u_swell_length_m": sea.swell_length_m,
        "u_chop_length_m": sea.chop_length_m,
        "u_wave_slope": (swell, chop),
    }


def ring_uniforms(level: Level, time_s: float, position) -> dict:
    """The rings nearest to the camera, for lib/rings.glsl (H19)."""
    rows = rings(level, time_s, (float(position[0]), float(position[1])))
    table = np.zeros((2, MOST, 4), np.float32)
    table[0, : len(rows)], table[1, : len(rows)] = rows[:, :4], rows[:, 4:]
    return {
        "u_ring_hits": int((rows[:, 2] >= 0).sum()),
        "u_ring_count": len(rows),
        "u_ring_place": table[0],
        "u_ring_wave": table[1],
    }


def rain_ring_uniforms(level: Level, time_s: float, position, seen_by: str = "") -> dict:
    """How much it rains where the camera is, for lib/rain_rings.glsl (D17); a share of 0 alone where it is dry."""
    drops = rain_drops(level, time_s, float(position[0]), float(position[1]), seen_by)
    if drops is None:
        return {"u_rain_share": 0.0}
    return {
        "u_rain_share": drops.share,
        "u_rain_rings_mean": drops.share * level.settings.rain.ripples**2 * mean_slope2(),
        "u_rain_layer": np.array(drops.layers, np.float32),
    }


def shore_field_uniforms(level: Level) -> dict[str, float]:
    """What lib/shore_field.glsl asks for besides its texture."""
    field = shore_field(level)
    return {"u_shore_distance_range_m": field.range_m, "u_shore_field_cell_m": field.cell_m}


def set_uniforms(program, values: dict) -> None:
    """Set those of `values` that the program has; a name the compiler removed is skipped (moderngl raises KeyError)."""
    for name, value in values.items():
        member = program.get(name, None)
        if member is None:
            continue
        if isinstance(value, np.ndarray):
            _write_array(member, value)
        else:
            member.value = value


def _write_array(member, value: np.ndarray) -> None:
    """Write an array, cut to the length the compiler kept."""
    kind = np.int32 if value.dtype.kind in "iu" else np.float32
    data = np.ascontiguousarray(value, kind).tobytes()
    member.write(data[: 4 * member.dimension * member.array_length])


def bind_textures(shader, textures: dict) -> None:
    """Bind to each sampler of the program the texture of its name; KeyError names a sampler nobody feeds."""
    for unit, name in enumerate(shader.samplers):
        textures[name].use(unit)
        shader.program[name].value = unit
