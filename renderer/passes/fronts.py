"""When fronts pass, laid over the water (T06): crests and their ghosts, isochrones, speed, breakers."""

from __future__ import annotations

import math

import numpy as np

from ...level.arrival import shore_at
from ...level.shaping_limits import SLOPE_DEG
from ...level.speed_ramp import BREAKERS, ISOCHRONE, moment_alpha, moment_colour, stops
from ..frame import Frame
from ..show import MOST_GHOSTS, FrontLines


def draw(frame: Frame) -> None:
    wanted, ctx = frame.overlays.fronts, frame.renderer.ctx
    if wanted is None or wanted == FrontLines() or not frame.level.settings.water.on:
        return
    frame.targets.display.use()
    drawn = frame.uniforms["u_size"]
    frame.uniforms["u_size"] = tuple(float(side) for side in frame.full_size)
    frame.uniforms |= passage_uniforms(frame) | front_uniforms(frame, wanted)
    ctx.enable(ctx.BLEND)
    ctx.blend_func = ctx.SRC_ALPHA, ctx.ONE_MINUS_SRC_ALPHA
    frame.shader("fronts.glsl").fullscreen()
    ctx.disable(ctx.BLEND)
    frame.uniforms["u_size"] = drawn


def passage_uniforms(frame: Frame) -> dict:
    """What lib/passage.glsl asks for besides the level's own uniforms."""
    return {
        "u_breaker_colours": np.array(list(BREAKERS.values()), np.float32),
        "u_front_period_s": shore_at(frame.level, frame.time_s).interval_s,
        "u_shaping": (math.tan(math.radians(SLOPE_DEG)), frame.level.settings.shore.smooth_m),
    }


def front_uniforms(frame: Frame, wanted: FrontLines) -> dict:
    """Lines and colours; seconds as cycles of the clock in use, wrapped in float64."""
    period_s = shore_at(frame.level, frame.time_s).interval_s
    count = frame.level.settings.shore.count
    ghosts = np.zeros((2 * MOST_GHOSTS + 1, 4), np.float32)
    for n in range(2 * wanted.ghosts + 1):
        part = (n - wanted.ghosts) / max(wanted.ghosts, 1)
        ghosts[n] = *moment_colour(part), moment_alpha(part)
    every = wanted.isochrones_s / period_s
    waves = frame.time_s / period_s
    begun = waves % count  # what `since` counts from: A = begun − since in cycles
    return {
        "u_ghosts": ghosts,
        "u_ghost_cycles": wanted.step_s / period_s,
        "u_ghost_count": wanted.ghosts,
        "u_front_crests": wanted.crests,
        "u_front_speed": wanted.speed,
        "u_front_breakers": wanted.breakers,
        "u_isochrone_cycles": every,
        "u_isochrone_first": math.fmod(begun, every) if every else 0.0,
        "u_isochrone_colour": ISOCHRONE,
        "u_speed_ramp": stops().astype(np.float32),
        "u_speed_range": (wanted.slowest_mps, max(wanted.fastest_mps, wanted.slowest_mps + 1e-3)),
    }
