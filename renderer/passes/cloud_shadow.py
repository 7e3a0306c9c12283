"""Shadows of the clouds in volume: how much of the sun comes through them to the sea's level (Z19).

A map round the camera in whole texels, so that it doesn't crawl; higher places read it slid along the sun. It is that
of a whole second and moves with the wind until the next, which live pictures make ahead of it (slow_map.py).
"""

from __future__ import annotations

import numpy as np

from ...level.cloud_air import air_uniforms
from ...level.weather import TILE_M, drift_m
from ..frame import Frame
from ..kept_map import at_whole, kept_map
from ..slow_map import Making, Slow, in_strips, keep_up
from ..uniforms import set_uniforms
from .clouds import bind_cloud_textures, shown
from .weather import weather_kept, weather_making

REACH_M = 8000.0  # half the map's side
EVERY_S = 1.0
LOWEST_SUN = 0.08  # sine of the elevation below which shadows grow no longer
MIDDLE = 0.3  # of the layer's height: there most of the cloud lies that casts them


def falls(frame: Frame) -> bool:
    """Whether clouds throw shadows in this picture."""
    settings = frame.level.settings
    return shown(frame) and settings.clouds.shadows > 0 and settings.light.shadows and frame.sky.light.sun.any()


def draw(frame: Frame) -> None:
    if not falls(frame):
        return
    keep_up(frame, SLOW)
    made, clouds = frame.renderer.kept["cloud_shadow"], frame.level.settings.clouds
    slant, _ = _slant(frame)
    frame.uniforms |= {
        "u_cloud_shadow_place": (*(float(v) for v in _middle(frame, made.seen, slant)), REACH_M, clouds.shadows),
        "u_cloud_shadow_far": 1.0 - frame.sky.light.cover,
        "u_cloud_shadow_slant": slant,
    }
    frame.textures["u_cloud_shadow"] = made.texture
    frame.defines["CLOUD_SHADOW"] = ""


def _slant(frame: Frame) -> tuple[tuple[float, float], float]:
    """Metres towards the sun a metre up, and the sine of its elevation, no lower than shadows are made for."""
    sun = frame.uniforms["u_sun_direction"].astype(np.float64)
    sine = max(float(sun[2]), LOWEST_SUN)
    return tuple(float(v) for v in sun[:2] / sine), sine


def _middle(frame: Frame, seen: tuple, slant: tuple[float, float]) -> np.ndarray:
    """Where the map's middle lies now: blown on since its moment, and slid as shadows slide while the sun goes on."""
    middle, time_s, then = seen
    blown = drift_m(frame.level, frame.time_s) - drift_m(frame.level, time_s)
    blown -= TILE_M * np.round(blown / TILE_M)
    clouds = frame.level.settings.clouds
    turned = np.subtract(slant, then) * (clouds.base_m + MIDDLE * (clouds.top_m - clouds.base_m))
    return middle + blown - turned


def _make(frame: Frame, ending: str, strips: int) -> list[Making]:
    side = frame.tier.cloud_shadow[0]
    whole = at_whole(frame, EVERY_S, 8 * 2 * REACH_M / side)
    bind_cloud_textures(whole)
    weather = weather_making(whole, weather_kept(whole, "weather_shadow" + ending), strips=strips)
    whole.textures["u_weather"] = weather.made.texture
    return [weather, _shadow(whole, weather.key, ending, strips)]


def _shadow(whole: Frame, weather: tuple, ending: str, strips: int) -> Making:
    level, (side, steps) = whole.level, whole.tier.cloud_shadow
    made = kept_map(whole, "cloud_shadow" + ending, (side, side), 1)
    slant, sine = _slant(whole)
    middle = whole.matrices.position[:2]
    shader = whole.shader("cloud_shadow.glsl")
    values = {
        **air_uniforms(level, whole.time_s),
        "u_planet_m": level.settings.clouds.planet_km * 1000.0,
        "u_eye_m": 0.0,
        "u_cloud_camera": tuple(float(v) for v in middle),
        "u_cloud_shadow_slant": slant,
        "u_shadow_steps": steps,
        "u_shadow_sine": sine,
        "u_shadow_reach_m": REACH_M,
        "u_shadow_texels": float(side),
    }
    settings = level.settings
    key = (*values.values(), weather, settings.clouds, settings.cloud_terms, whole.textures["u_cloud_shape"],
           shader.generation)  # fmt: skip

    def draw() -> None:
        shader = whole.shader("cloud_shadow.glsl")
        set_uniforms(shader.program, values)
        shader.fullscreen()
        made.seen = middle.copy(), whole.time_s, slant

    return Making(made, key, in_strips(made, draw, strips), "cloud_shadows")


SLOW = Slow(("weather_shadow", "cloud_shadow"), EVERY_S, _make)
