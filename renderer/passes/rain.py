"""Rain and snow: curtains under the clouds and what falls round the camera (Z18, Z24)."""

from __future__ import annotations

import math

import numpy as np

from ...level.weather import drift_m, middle_m
from ..frame import Frame
from ..uniforms import set_uniforms
from .clouds import shown

CYLINDERS_M = np.array([2.0, 5.0, 11.0, 24.0])  # lib/rain_near.glsl has the same
ROWS = 64
DROP_ROWS_M, FLAKE_ROWS_M = 0.30 * CYLINDERS_M + 0.6, 0.05 * CYLINDERS_M + 0.03
FOLDS_M = 7800.0
SWIRL_S = 7.0
AT_GROUND = 0.35  # of the clouds' wind
SHEARED = 0.5  # how far rain stays behind its cloud, of what the wind goes while it falls


def falls(frame: Frame) -> bool:
    """Whether rain or snow may be seen in this picture."""
    level = frame.level
    weather, rain = level.settings.weather, level.settings.rain
    source = weather.precipitation > 0 or level.settings.storm.chance > 0
    source = source or (weather.painted and not level.layers["weather"].neutral)
    return shown(frame) and source and weather.rain_mm_h > 0 and (rain.shafts > 0 or rain.streaks > 0)


def draw(frame: Frame) -> None:
    if not falls(frame):
        return
    ctx = frame.renderer.ctx
    shader = frame.shader("rain.glsl")
    set_uniforms(shader.program, rain_uniforms(frame))
    frame.targets.picture.use()
    ctx.enable(ctx.BLEND)
    ctx.blend_func = ctx.ONE, ctx.SRC_ALPHA
    shader.fullscreen()
    ctx.disable(ctx.BLEND)
    frame.stats["rain"] = 1


def rain_uniforms(frame: Frame) -> dict:
    """How far things have fallen and been blown, each within what it repeats after."""
    level = frame.level
    rain, weather = level.settings.rain, level.settings.weather
    heading = math.radians(weather.heading_deg)
    way = np.array([math.sin(heading), math.cos(heading)])
    fallen = np.array([rain.fall_mps, rain.flake_mps]) * frame.time_s + float(frame.matrices.position[2])
    trail = SHEARED * weather.wind_mps / rain.fall_mps * way
    return {
        "u_shaft_steps": frame.tier.shaft_steps,
        "u_rain_fallen": tuple(fallen[0] / DROP_ROWS_M % ROWS),
        "u_flakes_fallen": tuple(fallen[1] / FLAKE_ROWS_M % ROWS),
        "u_flakes_swirl": frame.time_s / SWIRL_S % 1.0,
        "u_rain_wind": tuple(AT_GROUND * weather.wind_mps * way),
        "u_rain_drift": tuple((drift_m(level, frame.time_s) + middle_m(level.settings)) % FOLDS_M),
        "u_rain_trail": tuple(-trail),
    }
