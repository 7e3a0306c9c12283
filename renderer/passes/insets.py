"""Views as small pictures in the corners of the finished one (T12): maps turned as wanted, buffers as they are."""

from __future__ import annotations

import math

from ...level.force import SIDE
from ...level.weather import STAGES, TILE_M, middle_m, weather_uniforms
from ..frame import Frame
from ..show import Inset
from ..sky_insets import SKY_INSETS, find_inset, stage_of
from ..views import RAMPS, View
from .view import bind_view
from .weather import bind_weather

MARGIN = 0.02  # of the picture's height, between insets and to the border
STRONG_MPS = 30.0  # the wind whose arrow is as long as it gets


def draw(frame: Frame) -> None:
    ctx, used = frame.renderer.ctx, {}
    if not frame.overlays.insets:
        return
    for inset in frame.overlays.insets:
        view = find_inset(inset.view)
        box = _box(inset, view, frame.full_size, used.get(inset.corner, 0.0))
        used[inset.corner] = used.get(inset.corner, 0.0) + box[3] + MARGIN * frame.full_size[1]
        frame.uniforms["u_inset"] = box
        shader = _sky(frame, inset, box) if inset.view in SKY_INSETS else _view(frame, inset, view, box)
        shader.program["u_ramp"].value = RAMPS.index(view.ramp)
        shader.program["u_range"].value = view.low, view.high
        frame.targets.display.use()  # only now: what a view binds may be drawn first
        frame.targets.display.scissor = tuple(int(v) for v in box)
        ctx.disable(ctx.BLEND)
        try:
            shader.fullscreen()
        finally:
            frame.targets.display.scissor = None


def _view(frame: Frame, inset: Inset, view: View, box: tuple[float, float, float, float]):
    """The program of a row of VIEWS."""
    defines = bind_view(frame, view) | {"INSET": ""}
    if view.mapped:
        defines["INSET_MAP"] = ""
        frame.uniforms |= _map(frame, inset, box[2])
    return frame.shader("view.glsl", **defines)


def _sky(frame: Frame, inset: Inset, box: tuple[float, float, float, float]):
    """The program of the weather map, with the wind as it is seen in the inset."""
    defines = bind_weather(frame, weather_uniforms(frame.level, frame.time_s)) | {"INSET_MAP": ""}
    frame.uniforms |= _map(frame, inset, box[2])
    weather = frame.level.settings.weather
    to = math.radians(weather.heading_deg)
    east, north = math.sin(to), math.cos(to)
    right_x, right_y, up_x, up_y = frame.uniforms["u_inset_turn"]
    length = 0.35 + 0.65 * min(weather.wind_mps / STRONG_MPS, 1.0) if weather.wind_mps > 0 else 0.0
    frame.uniforms |= {
        "u_inset_wind": (length * (east * right_x + north * right_y), length * (east * up_x + north * up_y)),
        "u_stage": STAGES.index(stage_of(inset.view)),
    }
    return frame.shader("weather_inset.glsl", **defines)


def _box(inset: Inset, view: View, size: tuple[int, int], taken: float) -> tuple[float, float, float, float]:
    """Left, bottom, width, height in pixels; what shares a corner stands one over the other."""
    width, height = size
    high = max(round(inset.size * height), 8)
    wide = high if view.mapped else max(round(high * width / height), 8)
    margin = round(MARGIN * height)
    left = margin if inset.corner.endswith("left") else width - wide - margin
    bottom = margin + taken if inset.corner.startswith("lower") else height - high - margin - taken
    return float(left), float(round(bottom)), float(wide), float(high)


def _map(frame: Frame, inset: Inset, pixels: float) -> dict:
    """Middle, scale and direction of a map: the pushed water's window, the sky, the level, or about the camera."""
    x, y, _ = frame.matrices.position
    half = inset.extent_m / 2
    if not half and inset.view.startswith("force"):
        half = frame.level.settings.force.cell_m * SIDE / 2
        west, south, _, stirred = frame.uniforms["u_force_place"]
        x, y = (west + half, south + half) if stirred else (x, y)
    elif not half and inset.view in SKY_INSETS:
        half = TILE_M / 2
        x, y = middle_m(frame.level.settings)
    elif not half:
        east, north = frame.level.grid.extent_m
        x, y, half = east / 2, north / 2, max(east, north) / 2
    yaw = math.radians(frame.camera.yaw_deg)
    turn = yaw if inset.heading else math.radians(inset.turn_deg)
    cos, sin = math.cos(turn), math.sin(turn)
    right, up = (cos, -sin), (sin, cos)
    ahead = (math.sin(yaw), math.cos(yaw))
    return {
        "u_inset_map": (x, y, half, 2 * half / pixels),
        "u_inset_turn": (*right, *up),
        "u_inset_ahead": tuple(ahead[0] * way[0] + ahead[1] * way[1] for way in (right, up)),
    }
