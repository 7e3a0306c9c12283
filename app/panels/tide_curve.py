"""The tide's curve over one period: points dragged, the present moment, high and low water told (D31).

A click on the line adds a point, right click removes one; two stay.
"""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui

from ...level.loop import looped, moment
from ...level.tide import MOST_POINTS, curve_at, hours_text, tide_m
from .. import theme
from ..editor import Editor
from ..param_widgets import tooltip
from ..timeline import clock_text

PATH = "tide.curve"
PLOT_PX, EDGE_PX, HANDLE_PX, NEAR_PX, PIECES = 96.0, 6.0, 5.0, 8.0, 96
GAP = 0.01  # of the period, between two points that are dragged together
Curve = tuple[float, ...]
_state = {"dragged": -1}


def moved(curve: Curve, number: int, at: float, height: float) -> Curve:
    """A curve with one point elsewhere, between its neighbours and in the period."""
    low = curve[2 * number - 2] + GAP if number else 0.0
    high = curve[2 * number + 2] - GAP if 2 * number + 2 < len(curve) else 1.0 - GAP
    at = curve[2 * number] if low > high else min(max(at, low), high)
    point = (round(at, 4), round(min(max(height, 0.0), 1.0), 3))
    return curve[: 2 * number] + point + curve[2 * number + 2 :]


def inserted(curve: Curve, at: float) -> tuple[Curve, int]:
    """A curve with one more point on its line, and its number; the same and −1 where there is no room."""
    points = list(zip(curve[::2], curve[1::2], strict=True))
    if len(points) >= MOST_POINTS or not 0 <= at <= 1 - GAP or any(abs(at - x) < GAP for x, _ in points):
        return curve, -1
    point = (round(at, 4), round(float(curve_at(curve, at)), 3))
    made = sorted([*points, point])
    return tuple(part for one in made for part in one), made.index(point)


def removed(curve: Curve, number: int) -> Curve:
    """A curve without one of its points; two stay."""
    return curve if len(curve) <= 4 else curve[: 2 * number] + curve[2 * number + 2 :]


def now_part(editor: Editor) -> float:
    """Where in the period the clock is."""
    settings, t = editor.session.level.settings, editor.session.clock.time_s
    loop_s, tide = settings.time.loop_s, settings.tide
    at = 0.0 if 0 < loop_s < tide.period_s else moment(t, loop_s)
    return float((at - tide.high_s) / looped(tide.period_s, loop_s) % 1.0)


def told(editor: Editor) -> str:
    """Where the sea stands, and how long to the next high water."""
    settings, t = editor.session.level.settings, editor.session.clock.time_s
    tide, part = settings.tide, now_part(editor)
    over = f"now {tide_m(settings, t):+.2f} m"
    if 0 < settings.time.loop_s < tide.period_s:
        return f"{over}; the loop of {settings.time.loop_s:g} s is shorter than the tide, so it stands"
    fine = np.linspace(0, 1, 721)
    highest = float(fine[int(np.argmax(curve_at(tide.curve, fine[:-1])))])
    wait_s = (highest - part) % 1.0 * looped(tide.period_s, settings.time.loop_s)
    return f"{over}, high water in {clock_text(wait_s) if wait_s < 3600 else hours_text(wait_s)}"


def draw(editor: Editor) -> None:
    """The curve, its points and the moment."""
    tide = editor.session.level.settings.tide
    corner, width = imgui.get_cursor_screen_pos(), max(imgui.get_content_region_avail().x, 80.0)
    imgui.invisible_button("###tide_curve", imgui.ImVec2(width, PLOT_PX))
    tooltip("Height of the sea over one period. Drag a point; a click on the line adds one, right click removes it.")
    hovered = imgui.is_item_hovered()
    _backdrop(editor, corner, width)
    _follow(editor, tide.curve, corner, width, hovered)
    ink = theme.INK if tide.on else theme.INK_FAINT
    imgui.text_colored(theme.colour(ink), told(editor) if tide.on else "The tide is off.")


def to_px(corner, width: float, at, height):
    """Screen pixels of parts of the period and heights."""
    foot = corner.y + PLOT_PX - EDGE_PX
    return corner.x + EDGE_PX + at * (width - 2 * EDGE_PX), foot - height * (PLOT_PX - 2 * EDGE_PX)


def _backdrop(editor: Editor, corner, width: float) -> None:
    tide, draw_list = editor.session.level.settings.tide, imgui.get_window_draw_list()
    end = imgui.ImVec2(corner.x + width, corner.y + PLOT_PX)
    draw_list.add_rect_filled(corner, end, theme.packed(theme.FIELD), 4)
    for height, text in ((0.0, f"{-tide.range_m / 2:+.2f} m"), (0.5, ""), (1.0, f"{tide.range_m / 2:+.2f} m")):
        _, y = to_px(corner, width, 0.0, height)
        draw_list.add_line(imgui.ImVec2(corner.x, y), imgui.ImVec2(end.x, y), theme.packed(theme.INK_FAINT, 0.25))
        wide, high = imgui.calc_text_size(text)
        top = min(max(y - high / 2, corner.y + 2), end.y - high - 2)
        draw_list.add_text(imgui.ImVec2(end.x - wide - 5, top), theme.packed(theme.INK_FAINT, 0.8), text)
    at = np.linspace(0, 1, PIECES)
    x, y = to_px(corner, width, at, curve_at(tide.curve, at))
    points = [imgui.ImVec2(float(a), float(b)) for a, b in zip(x, y)]
    ink = theme.packed(theme.BLUE, 1.0 if tide.on else 0.5)
    draw_list.add_polyline(points, ink, 2.0, imgui.ImDrawFlags_.none)
    if tide.on:
        part = now_part(editor)
        x, y = to_px(corner, width, part, float(curve_at(tide.curve, part)))
        draw_list.add_line(imgui.ImVec2(x, corner.y), imgui.ImVec2(x, end.y), theme.packed(theme.INK, 0.5))
        draw_list.add_circle_filled(imgui.ImVec2(x, y), 3.5, theme.packed(theme.INK))


def _follow(editor: Editor, curve: Curve, corner, width: float, hovered: bool) -> None:
    """Draw the points and follow the mouse over them."""
    session, mouse = editor.session, imgui.get_mouse_pos()
    places = [to_px(corner, width, at, height) for at, height in zip(curve[::2], curve[1::2], strict=True)]
    away = [max(abs(x - mouse.x), abs(y - mouse.y)) for x, y in places]
    near = int(np.argmin(away)) if hovered and min(away) <= NEAR_PX else -1
    at = (mouse.x - corner.x - EDGE_PX) / (width - 2 * EDGE_PX)
    height = (corner.y + PLOT_PX - EDGE_PX - mouse.y) / (PLOT_PX - 2 * EDGE_PX)
    if _state["dragged"] >= len(places):  # an undo took it away
        _state["dragged"] = -1
    if hovered and imgui.is_mouse_clicked(0):
        _state["dragged"] = near
        if near < 0 and abs(float(curve_at(curve, at)) - height) * PLOT_PX <= NEAR_PX:
            changed, _state["dragged"] = inserted(curve, at)
            editor.set(PATH, changed, True)
    elif near >= 0 and imgui.is_mouse_clicked(1):
        editor.set(PATH, removed(curve, near))
    if _state["dragged"] >= 0:
        delta = imgui.get_io().mouse_delta
        if not imgui.is_mouse_down(0):
            _state["dragged"] = -1
            session.seal()
        elif delta.x or delta.y:
            editor.set(PATH, moved(session.level.settings.tide.curve, _state["dragged"], at, height), True)
    draw_list = imgui.get_window_draw_list()
    for number, (x, y) in enumerate(places):
        held = number in (near, _state["dragged"])
        draw_list.add_circle_filled(imgui.ImVec2(x, y), HANDLE_PX + held, theme.packed(theme.BLUE))
        draw_list.add_circle(imgui.ImVec2(x, y), HANDLE_PX + held, theme.packed(theme.SHADE), 0, 1.5)
