"""What lies over the weather map in its panel: level, camera, brush, wind, scale (T04, Z04)."""

from __future__ import annotations

import math

import numpy as np
from imgui_bundle import imgui

from .. import sky_brush, theme
from ..editor import Editor
from ..map_sight import Sight


def draw(editor: Editor, sight: Sight, origin, ring: bool) -> None:
    """Draw over a map whose upper left corner is at `origin`; `ring` says whether the brush is shown."""
    draw_list, session = imgui.get_window_draw_list(), editor.session
    level, camera = session.level, session.camera

    def at(x: float, y: float) -> imgui.ImVec2:
        px, py = sight.pixels(x, y)
        return imgui.ImVec2(origin.x + px, origin.y + py)

    def line(points, ink, width: float, closed: bool = False) -> None:
        flags = imgui.ImDrawFlags_.closed if closed else 0
        draw_list.add_polyline(points, theme.packed(theme.SHADE, 0.6), width + 2, flags)
        draw_list.add_polyline(points, theme.packed(ink), width, flags)

    east, north = level.grid.extent_m
    line([at(0, 0), at(east, 0), at(east, north), at(0, north)], theme.INK, 1, True)
    if ring:
        _ring(editor, at, line)
    _camera(line, at(camera.x, camera.y), math.radians(camera.yaw_deg))
    _wind(draw_list, line, level.settings.weather, imgui.ImVec2(origin.x + sight.side - 28, origin.y + 28))
    _scale(draw_list, line, sight, origin)


def _ring(editor: Editor, at, line) -> None:
    """The brush where the pointer is, here or in the viewport's sky."""
    session = editor.session
    point = editor.map_pointer or session.sky_cursor
    if point is None:
        return
    io, turn = imgui.get_io(), np.linspace(0, 2 * np.pi, 64, endpoint=False)
    held = session.stroke or sky_brush.Held(io.key_ctrl, io.key_shift)
    ink = theme.BLUE if held.smooth else theme.WARM if held.invert else theme.INK
    params = session.params[sky_brush.NAME]
    for radius_m, width in ((params.size_m, 1.8), (params.inner_m, 1.0)):
        x, y = point[0] + radius_m * np.cos(turn), point[1] + radius_m * np.sin(turn)
        line([at(*place) for place in zip(x, y)], ink, width, True)


def _camera(line, at, yaw: float) -> None:
    """An arrowhead that looks where the camera does."""
    ahead, side = (math.sin(yaw), -math.cos(yaw)), (math.cos(yaw), math.sin(yaw))
    points = ((9, 0), (-6, 6), (-3, 0), (-6, -6))
    line(
        [imgui.ImVec2(at.x + a * ahead[0] + s * side[0], at.y + a * ahead[1] + s * side[1]) for a, s in points],
        theme.WARM, 1.6, True,
    )  # fmt: skip


def _wind(draw_list, line, weather, at) -> None:
    """An arrow the way the clouds go, and how fast."""
    heading = math.radians(weather.heading_deg)
    way = (math.sin(heading), -math.cos(heading))
    tip, tail = (imgui.ImVec2(at.x + way[0] * r, at.y + way[1] * r) for r in (15, -15))
    barbs = [imgui.ImVec2(tip.x - 8 * math.sin(heading + t), tip.y + 8 * math.cos(heading + t)) for t in (0.5, -0.5)]
    line([tail, tip], theme.INK, 1.6)
    line([barbs[0], tip, barbs[1]], theme.INK, 1.6)
    _text(draw_list, imgui.ImVec2(at.x, at.y + 20), f"{weather.wind_mps:.0f} m/s", 0.5)


def _scale(draw_list, line, sight: Sight, origin) -> None:
    """A bar of a round length, lower left; north is up."""
    length = sight.scale_m / sight.span_m * sight.side
    left, y = origin.x + 10, origin.y + sight.side - 10
    line([imgui.ImVec2(left, y), imgui.ImVec2(left + length, y)], theme.INK, 1.6)
    text = f"{sight.scale_m / 1000:g} km" if sight.scale_m >= 1000 else f"{sight.scale_m:g} m"
    _text(draw_list, imgui.ImVec2(left, y - imgui.get_font_size() - 4), text, 0.0)
    _text(draw_list, imgui.ImVec2(left, origin.y + 6), f"{theme.icon('arrow_up')} N", 0.0)


def _text(draw_list, at, text: str, back: float) -> None:
    """A text with a shadow; `back` is the part of its width that it is moved to the left."""
    x = at.x - imgui.calc_text_size(text).x * back
    draw_list.add_text(imgui.ImVec2(x + 1, at.y + 1), theme.packed(theme.SHADE, 0.9), text)
    draw_list.add_text(imgui.ImVec2(x, at.y), theme.packed(theme.INK), text)
