"""Height curves of the three kinds of cloud: points dragged, the blend of a type and a cloud of it seen at once (Z03).

Up is up in the shell, to the right is denser. A click on the line of the kind in hand adds a point, on another line it
takes that kind in hand; right click removes a point.
"""

from __future__ import annotations

import functools

import numpy as np
from imgui_bundle import imgui

from ...level.cloud_profile import HEIGHTS, KINDS, curve_samples, profile
from ...level.sky_settings import Curve, curve_points
from ...level.textures import spectral_noise
from ...level.weather import weather_at
from .. import theme
from ..editor import Editor
from ..param_widgets import slider, tooltip

PATHS = tuple(f"clouds.{name}" for name in KINDS)
LABELS = ("Stratus", "Cumulus", "Cumulonimbus")
INKS = ((0.45, 0.72, 0.95), (0.98, 0.93, 0.72), (0.86, 0.50, 0.88))
PLOT_PX, PICTURE_PX, HANDLE_PX, NEAR_PX, CELL_PX = 190.0, 84.0, 5.5, 8.0, 3.0
GAP = 0.005  # of the shell's height, between two points that are dragged together
MOST = 16  # points
LINE_PIECES = 80
GUTTER_PX = 50.0  # right of the curves, for heights
_state = {"kind": 1, "dragged": -1, "type": -1.0}


def moved(curve: Curve, number: int, height: float, density: float) -> Curve:
    """A curve with one point elsewhere: it stays between its neighbours and in 0 … 1."""
    points = list(curve_points(curve))
    low = points[number - 1][0] + GAP if number else 0.0
    high = points[number + 1][0] - GAP if number + 1 < len(points) else 1.0
    height = points[number][0] if low > high else min(max(height, low), high)
    points[number] = (round(height, 4), round(min(max(density, 0.0), 1.0), 3))
    return tuple(part for point in points for part in point)


def inserted(curve: Curve, height: float) -> tuple[Curve, int]:
    """A curve with one more point on its line, and its number; the same and −1 where there is no room."""
    points = curve_points(curve)
    if len(points) >= MOST or any(abs(height - at) < GAP for at, _ in points) or not 0 <= height <= 1:
        return curve, -1
    at = np.linspace(0, 1, 1001)
    point = (round(height, 4), round(float(np.interp(height, at, curve_samples(curve, 1001))), 3))
    made = sorted((*points, point))
    return tuple(part for one in made for part in one), made.index(point)


def removed(curve: Curve, number: int) -> Curve:
    """A curve without one of its points; two stay."""
    return curve if len(curve) <= 4 else curve[: 2 * number] + curve[2 * number + 2 :]


def cloud_picture(curves: tuple[Curve, ...], kind: float, cols: int, rows: int) -> np.ndarray:
    """float32 `(rows, cols, 3)`, top first: a cut through a cloud of gradient coordinate `kind`, lit from above."""
    table = np.stack([curve_samples(curve) for curve in curves])
    noise = np.clip(0.5 + 0.25 * spectral_noise(128, 5, 1.4, 2, 30), 0, 1)[:rows, :cols]
    across = np.sin(np.pi * (np.arange(cols) + 0.5) / cols) ** 1.2  # the map's coverage, from edge to edge
    heights = (np.arange(rows)[::-1] + 0.5) / rows
    amount = profile(table, kind, heights)[:, None] * across[None, :]
    density = np.clip((noise - (1 - amount)) / np.maximum(amount, 1e-3), 0, 1)
    above = np.cumsum(density, axis=0) - density
    light = 0.42 + 0.58 * np.exp(-0.35 * above)
    cover = 1 - np.exp(-4 * density)
    sky, cloud = np.array([0.20, 0.36, 0.60]), light[..., None] * np.array([1.0, 0.99, 0.97])
    return (sky + (cloud - sky) * cover[..., None]).astype(np.float32)


def draw(editor: Editor) -> None:
    """The kinds, their curves in one plot, and what a type between them looks like."""
    clouds = editor.session.level.settings.clouds
    curves = tuple(getattr(clouds, name) for name in KINDS)
    if _state["dragged"] >= len(curve_points(curves[_state["kind"]])):  # an undo took it away
        _state["dragged"] = -1
    if _state["type"] < 0:
        _state["type"] = 0.5 * editor.session.level.settings.weather.type
    _kinds()
    corner, width = imgui.get_cursor_screen_pos(), max(imgui.get_content_region_avail().x, 80.0)
    imgui.invisible_button("###curves", imgui.ImVec2(width, PLOT_PX))
    _backdrop(corner, width, clouds)
    _lines(curves, corner, width)
    _handles(editor, curves, corner, width)
    _blend(editor)
    _picture(curves, width)


def _blend(editor: Editor) -> None:
    """Which blend is shown: any, or that of the sky over the camera."""
    imgui.set_next_item_width(-imgui.calc_text_size("Overhead").x - 28)
    _, _state["type"] = slider("###curve_type", _state["type"], 0.0, 1.0, _blend_text(_state["type"]))
    tooltip("The blend shown: 0 stratus, 0.5 cumulus, 1 cumulonimbus. Changes nothing in the level.")
    imgui.same_line()
    if imgui.button("Overhead###curve_above"):
        session = editor.session
        camera = session.camera
        x, y = np.array([camera.x]), np.array([camera.y])
        sky = weather_at(session.level, session.clock.time_s, x, y, (camera.x, camera.y), seen_by=camera.id)
        _state["type"] = float(sky[0, 2])
    tooltip("Show the blend that the weather map has over the camera now.")


def _blend_text(kind: float) -> str:
    low = min(int(2 * kind), 1)
    share = 2 * kind - low
    names = (LABELS[low], LABELS[low + 1])
    return f"{names[0]}" if share < 0.005 else f"{100 * (1 - share):.0f} %% {names[0]}, {100 * share:.0f} %% {names[1]}"


def _kinds() -> None:
    for number, label in enumerate(LABELS):
        if number:
            imgui.same_line()
        imgui.push_style_color(imgui.Col_.text, theme.colour(INKS[number]))
        if imgui.radio_button(f"{label}###kind_{KINDS[number]}", _state["kind"] == number):
            _state.update(kind=number, dragged=-1)
        imgui.pop_style_color()
        tooltip("Drag a point; a click on the line adds one, right click removes it. A click on another line takes that"
                " kind in hand. White is the blend below.")  # fmt: skip


def _to_px(corner, width: float, height, density):
    """Screen pixels of heights and densities."""
    return corner.x + 6 + density * (width - 12 - GUTTER_PX), corner.y + PLOT_PX - 6 - height * (PLOT_PX - 12)


def _from_px(corner, width: float, mouse) -> tuple[float, float]:
    """Height and density under the mouse."""
    return (corner.y + PLOT_PX - 6 - mouse.y) / (PLOT_PX - 12), (mouse.x - corner.x - 6) / (width - 12 - GUTTER_PX)


def _backdrop(corner, width: float, clouds) -> None:
    draw_list = imgui.get_window_draw_list()
    end = imgui.ImVec2(corner.x + width, corner.y + PLOT_PX)
    draw_list.add_rect_filled(corner, end, theme.packed(theme.FIELD), 4)
    faint = theme.packed(theme.INK_FAINT)
    side, _ = _to_px(corner, width, 0.0, 1.0)
    upper, lower = imgui.ImVec2(side + 6, corner.y), imgui.ImVec2(side + 6, end.y)
    draw_list.add_line(upper, lower, theme.packed(theme.INK_FAINT, 0.3))
    for part in (0.0, 0.25, 0.5, 0.75, 1.0):
        _, y = _to_px(corner, width, part, 0.0)
        draw_list.add_line(imgui.ImVec2(corner.x, y), imgui.ImVec2(upper.x, y), theme.packed(theme.INK_FAINT, 0.18))
        if part in (0.0, 0.5, 1.0):
            text = f"{clouds.base_m + part * (max(clouds.top_m, clouds.base_m) - clouds.base_m):.0f} m"
            wide, high = imgui.calc_text_size(text)
            top = min(max(y - high / 2, corner.y + 2), end.y - high - 2)
            draw_list.add_text(imgui.ImVec2(end.x - wide - 5, top), faint, text)


def _line(samples: np.ndarray, corner, width: float, ink: int, thick: float) -> None:
    x, y = _to_px(corner, width, np.linspace(0, 1, len(samples)), samples)
    points = [imgui.ImVec2(float(a), float(b)) for a, b in zip(x, y)]
    imgui.get_window_draw_list().add_polyline(points, ink, thick, imgui.ImDrawFlags_.none)


def _lines(curves, corner, width: float) -> None:
    """Faint the other kinds, then the blend, then the one in hand."""
    for number, curve in enumerate(curves):
        if number != _state["kind"]:
            _line(curve_samples(curve, LINE_PIECES), corner, width, theme.packed(INKS[number], 0.55), 1.5)
    blend = profile(np.stack([curve_samples(c) for c in curves]), _state["type"], np.linspace(0, 1, HEIGHTS))
    _line(blend, corner, width, theme.packed(theme.INK, 0.8), 1.5)
    kind = _state["kind"]
    _line(curve_samples(curves[kind], LINE_PIECES), corner, width, theme.packed(INKS[kind]), 2.5)


def _handles(editor: Editor, curves, corner, width: float) -> None:
    """Draw the points of the kind in hand and follow the mouse over them."""
    kind, mouse, hovered = _state["kind"], imgui.get_mouse_pos(), imgui.is_item_hovered()
    places = [_to_px(corner, width, h, v) for h, v in curve_points(curves[kind])]
    away = [max(abs(x - mouse.x), abs(y - mouse.y)) for x, y in places]
    near = int(np.argmin(away)) if hovered and min(away) <= NEAR_PX else -1
    _pressed(editor, curves, near, hovered, corner, width)
    if _state["dragged"] >= 0:
        delta = imgui.get_io().mouse_delta
        if not imgui.is_mouse_down(0):
            _state["dragged"] = -1
            editor.session.seal()
        elif delta.x or delta.y:
            now = getattr(editor.session.level.settings.clouds, KINDS[kind])
            changed = moved(now, _state["dragged"], *_from_px(corner, width, mouse))
            editor.set(PATHS[kind], changed, True)
    draw_list = imgui.get_window_draw_list()
    for number, (x, y) in enumerate(places):
        held = number in (near, _state["dragged"])
        draw_list.add_circle_filled(imgui.ImVec2(x, y), HANDLE_PX + held, theme.packed(INKS[kind]))
        draw_list.add_circle(imgui.ImVec2(x, y), HANDLE_PX + held, theme.packed(theme.SHADE), 0, 1.5)


def _pressed(editor: Editor, curves, near: int, hovered: bool, corner, width: float) -> None:
    kind, mouse = _state["kind"], imgui.get_mouse_pos()
    if near >= 0 and imgui.is_mouse_clicked(0):
        _state["dragged"] = near
    elif near >= 0 and imgui.is_mouse_clicked(1) and _state["dragged"] < 0:
        editor.set(PATHS[kind], removed(curves[kind], near))
    elif hovered and near < 0 and imgui.is_mouse_clicked(0):
        hit = _line_at(curves, corner, width, mouse)
        if hit == kind:
            changed, number = inserted(curves[kind], _from_px(corner, width, mouse)[0])
            if number >= 0:
                editor.set(PATHS[kind], changed, True)
                _state["dragged"] = number
        elif hit >= 0:
            _state["kind"] = hit


def _line_at(curves, corner, width: float, mouse) -> int:
    """Which kind's line is under the mouse, the one in hand before others; −1 for none."""
    order = sorted(range(len(curves)), key=lambda number: number != _state["kind"])
    for number in order:
        samples = curve_samples(curves[number], 400)
        x, y = _to_px(corner, width, np.linspace(0, 1, 400), samples)
        if np.hypot(x - mouse.x, y - mouse.y).min() <= NEAR_PX:
            return number
    return -1


@functools.lru_cache(maxsize=8)
def _picture_inks(curves: tuple[Curve, ...], kind: float, cols: int, rows: int) -> list[list[int]]:
    return theme.packed_rows(cloud_picture(curves, kind, cols, rows))


def _picture(curves, width: float) -> None:
    """A cut through a cloud of the blend."""
    corner, draw_list = imgui.get_cursor_screen_pos(), imgui.get_window_draw_list()
    imgui.dummy(imgui.ImVec2(width, PICTURE_PX))
    cols, rows = min(int(width / CELL_PX), 128), int(PICTURE_PX / CELL_PX)
    inks = _picture_inks(curves, round(_state["type"], 2), cols, rows)
    step = width / (cols - 1)
    for row in range(rows - 1):
        for col in range(cols - 1):
            low = imgui.ImVec2(corner.x + col * step, corner.y + row * CELL_PX)
            high = imgui.ImVec2(low.x + step, low.y + CELL_PX)
            draw_list.add_rect_filled_multi_color(
                low, high, inks[row][col], inks[row][col + 1], inks[row + 1][col + 1], inks[row + 1][col]
            )
    tooltip("A cut through a cloud of this blend: coverage falls off to both sides.")
    imgui.text_colored(theme.colour(theme.INK_FAINT), "Right is denser; up is up, from the base to the top of clouds.")
