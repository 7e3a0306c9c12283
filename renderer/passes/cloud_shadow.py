"""Shadows of the clouds in volume: how much of the sun comes through them to the sea's level (Z19).

A map round the camera in whole texels, so that it doesn't crawl; higher places read it slid along the sun. It is that
of a whole second and moves with the wind until the next.
"""

from __future__ import annotations

import numpy as np

from ...level.weather import TILE_M, drift_m
from ..frame import Frame
from ..kept_map import KeptMap, at_whole, kept_map
from ..uniforms import set_uniforms
from .cloud_dome import bind_weather_of
from .clouds import air_uniforms, bind_cloud_textures, shown

REACH_M = 8000.0  # half the map's side
EVERY_S = 1.0
LOWEST_SUN = 0.08  # sine of the elevation below which shadows grow no longer


def falls(frame: Frame) -> bool:
    """Whether clouds throw shadows in this picture."""
    settings = frame.level.settings
    return (
        shown(frame) and settings.clouds.shadows > 0 and settings.light.shadows and frame.renderer.sky.light.sun.any()
    )


def draw(frame: Frame) -> None:
    if not falls(frame):
        return
    side = frame.tier.cloud_shadow[0]
    made = kept_map(frame, "cloud_shadow", (side, side), 1)
    texel = 2 * REACH_M / side
    whole = at_whole(frame, EVERY_S, 8 * texel)
    middle = whole.matrices.position[:2]
    blown = drift_m(frame.level, frame.time_s) - drift_m(frame.level, whole.time_s)
    blown -= TILE_M * np.round(blown / TILE_M)
    sun = frame.uniforms["u_sun_direction"].astype(np.float64)
    sine = max(float(sun[2]), LOWEST_SUN)
    clouds = frame.level.settings.clouds
    whole.uniforms["u_cloud_shadow_slant"] = slant = tuple(float(v) for v in sun[:2] / sine)
    frame.uniforms |= {
        "u_cloud_shadow_place": (*(float(v) for v in middle + blown), REACH_M, clouds.shadows),
        "u_cloud_shadow_far": 1.0 - frame.renderer.sky.light.cover,
        "u_cloud_shadow_slant": slant,
    }
    frame.textures["u_cloud_shadow"] = made.texture
    frame.defines["CLOUD_SHADOW"] = ""
    _make(whole, made, sine, frame.stats)


def _make(frame: Frame, made: KeptMap, sine: float, stats: dict) -> None:
    bind_cloud_textures(frame)
    weather = bind_weather_of(frame, "weather_shadow")
    level, middle = frame.level, tuple(float(v) for v in frame.matrices.position[:2])
    shader = frame.shader("cloud_shadow.glsl")
    values = {
        **air_uniforms(level, frame.time_s),
        "u_planet_m": level.settings.clouds.planet_km * 1000.0,
        "u_eye_m": 0.0,
        "u_cloud_camera": middle,
        "u_shadow_steps": frame.tier.cloud_shadow[1],
        "u_shadow_sine": sine,
        "u_shadow_reach_m": REACH_M,
        "u_shadow_texels": float(made.size[0]),
    }
    settings = level.settings
    key = (*values.values(), frame.uniforms["u_cloud_shadow_slant"], weather, settings.clouds,
           settings.cloud_terms, frame.textures["u_cloud_shape"], shader.generation)  # fmt: skip
    if made.key == key:
        return
    made.framebuffer.use()
    set_uniforms(shader.program, values)
    shader.fullscreen()
    made.key = key
    stats["cloud_shadows"] = made.size[0] ** 2
