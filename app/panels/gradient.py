"""A water table as gradients over metres: stops dragged, added, removed and coloured, seen in the sea at once (H15)."""

from __future__ import annotations

import math

import numpy as np
from imgui_bundle import imgui

from ...level.objects import WaterTable
from ...level.water_table import LENGTH_M
from .. import theme
from ..editor import Editor
from ..param_widgets import tooltip

KNEE_M = 0.5  # the axis is nearly linear below, by factors above: most colour turns in the first metres
STRIP_PX, HANDLE_PX, PIECES = 30.0, 7.0, 96
GAP_M = 0.01  # between two stops that are dragged together
MARKS_M = (0.0, 1.0, 5.0, 20.0, 50.0, 200.0)
_state = {"table": "", "stop": 0, "dragged": -1}


def to_axis(metres: float) -> float:
    """Metres as a part of the strip, 0 … 1."""
    return math.log1p(metres / KNEE_M) / math.log1p(LENGTH_M / KNEE_M)


def to_metres(part: float) -> float:
    """The inverse of `to_axis`, held to the strip."""
    return KNEE_M * math.expm1(min(max(part, 0.0), 1.0) * math.log1p(LENGTH_M / KNEE_M))


def with_stop(stops, number: int, **changes) -> tuple:
    """Stops with one changed (`metres`, `left`, `added`): it stays between its neighbours, a drag never swaps two."""
    metres, left, added = stops[number][0], stops[number][1:4], stops[number][4:7]
    if "metres" in changes:
        low = stops[number - 1][0] if number else 0.0
        high = stops[number + 1][0] if number + 1 < len(stops) else 1000.0
        gap = min(GAP_M, (high - low) / 2)
        metres = round(min(max(changes["metres"], low + gap * (number > 0)), high - gap), 3)
    stop = (metres, *changes.get("left", left), *changes.get("added", added))
    return (*stops[:number], stop, *stops[number + 1 :])


def inserted(stops, metres: float) -> tuple[tuple, int]:
    """Stops with one more on the line between its neighbours, and its number."""
    table = np.array(stops)
    stop = (round(metres, 3), *(float(np.interp(metres, table[:, 0], table[:, i])) for i in range(1, 7)))
    made = tuple(sorted((*stops, stop)))
    return made, made.index(stop)


def draw(editor: Editor, table: WaterTable) -> None:
    """The strips, their stops, the colours of the one in hand, and whether the level uses it."""
    if _state["table"] != table.id:
        _state.update(table=table.id, stop=0, dragged=-1)
    _state["stop"] = min(_state["stop"], len(table.stops) - 1)
    if _state["dragged"] >= len(table.stops):  # an undo took it away
        _state["dragged"] = -1
    _use(editor, table)
    corner, width = imgui.get_cursor_screen_pos(), max(imgui.get_content_region_avail().x, 60.0)
    imgui.invisible_button("###gradient", imgui.ImVec2(width, 2 * STRIP_PX + 3 * HANDLE_PX))
    tooltip("Above what is left of white light, below what the water adds.\nDrag a stop, double click adds one,"
            " right click removes it.")  # fmt: skip
    _strips(table, corner, width)
    _handles(editor, table, corner, width)
    _marks(corner, width)
    _colours(editor, table)


def _use(editor: Editor, table: WaterTable) -> None:
    used = editor.session.level.settings.water.table == table.id
    changed, on = imgui.checkbox("The sea's colour", used)
    tooltip("Use this table (water.table); off, the water is what the settings say.")
    if changed:
        editor.set("water.table", table.id if on else "")


def _strips(table: WaterTable, corner, width: float) -> None:
    """Colours left, then colours added four times as bright: they are dark."""
    stops, draw_list = np.array(table.stops), imgui.get_window_draw_list()
    metres = [to_metres(n / PIECES) for n in range(PIECES + 1)]
    for strip, (first, gain) in enumerate(((1, 1.0), (4, 4.0))):
        top = corner.y + strip * (STRIP_PX + HANDLE_PX)
        rows = [np.interp(metres, stops[:, 0], stops[:, first + i]) for i in range(3)]
        shown = np.clip(gain * np.stack(rows, 1), 0, 1) ** (1 / 2.2)
        for n in range(PIECES):
            low = imgui.ImVec2(corner.x + width * n / PIECES, top)
            high = imgui.ImVec2(corner.x + width * (n + 1) / PIECES + 0.5, top + STRIP_PX)
            left, right = (theme.packed(tuple(float(v) for v in shown[i])) for i in (n, n + 1))
            draw_list.add_rect_filled_multi_color(low, high, left, right, right, left)


def _handles(editor: Editor, table: WaterTable, corner, width: float) -> None:
    """Draw the stops and follow the mouse over them."""
    places = [corner.x + width * to_axis(stop[0]) for stop in table.stops]
    mouse, hovered = imgui.get_mouse_pos(), imgui.is_item_hovered()
    near = min(range(len(places)), key=lambda n: abs(places[n] - mouse.x))
    near = near if hovered and abs(places[near] - mouse.x) <= HANDLE_PX + 2 else -1
    _pressed(editor, table, near, hovered, (mouse.x - corner.x) / width)
    if _state["dragged"] >= 0:
        if not imgui.is_mouse_down(0):
            _state["dragged"] = -1
            editor.session.seal()
        elif imgui.get_io().mouse_delta.x:
            stops = with_stop(table.stops, _state["dragged"], metres=to_metres((mouse.x - corner.x) / width))
            editor.attempt(editor.session.alter, table.id, {"stops": stops}, True)
    draw_list = imgui.get_window_draw_list()
    middle = corner.y + STRIP_PX + HANDLE_PX / 2
    for number, x in enumerate(places):
        chosen = number == _state["stop"]
        ink = theme.ACCENT_BRIGHT if chosen else theme.INK if number == near else theme.INK_FAINT
        draw_list.add_circle_filled(imgui.ImVec2(x, middle), HANDLE_PX - (1 if chosen else 2.5), theme.packed(ink))
        draw_list.add_circle(imgui.ImVec2(x, middle), HANDLE_PX - 1, theme.packed(theme.SHADE), 0, 1.5)


def _pressed(editor: Editor, table: WaterTable, near: int, hovered: bool, part: float) -> None:
    session = editor.session
    if hovered and near < 0 and imgui.is_mouse_double_clicked(0):
        stops, _state["stop"] = inserted(table.stops, to_metres(part))
        editor.attempt(session.alter, table.id, {"stops": stops})
    elif near >= 0 and imgui.is_mouse_clicked(0):
        _state["stop"] = _state["dragged"] = near
    elif near >= 0 and imgui.is_mouse_clicked(1) and _state["dragged"] < 0 and len(table.stops) > 2:
        stops = table.stops[:near] + table.stops[near + 1 :]
        editor.attempt(session.alter, table.id, {"stops": stops})
        _state["stop"] = min(_state["stop"], len(stops) - 1)


def _marks(corner, width: float) -> None:
    """Metres under the strips."""
    draw_list = imgui.get_window_draw_list()
    for metres in MARKS_M:
        text = f"{metres:g} m" if metres == MARKS_M[-1] else f"{metres:g}"
        wide = imgui.calc_text_size(text).x
        x = min(max(corner.x + width * to_axis(metres) - wide / 2, corner.x), corner.x + width - wide)
        at = imgui.ImVec2(x, corner.y + 2 * STRIP_PX + HANDLE_PX + 2)
        draw_list.add_text(at, theme.packed(theme.INK_FAINT), text)


def _colours(editor: Editor, table: WaterTable) -> None:
    """Metres and both colours of the stop in hand."""
    session, number = editor.session, _state["stop"]
    stop = table.stops[number]
    imgui.text_colored(theme.colour(theme.INK_FAINT), f"Stop {number + 1} of {len(table.stops)}")
    imgui.set_next_item_width(-90)
    changed, metres = imgui.drag_float("Metres", stop[0], 0.02 + 0.01 * stop[0], 0.0, 1000.0, "%.2f m")
    changes = {"metres": metres} if changed else {}
    sealed = imgui.is_item_deactivated()
    flags = imgui.ColorEditFlags_.float | imgui.ColorEditFlags_.display_rgb
    for label, key, first in (("Left", "left", 1), ("Added", "added", 4)):
        imgui.set_next_item_width(-90)
        changed, colour = imgui.color_edit3(label, list(stop[first : first + 3]), flags)
        sealed = sealed or imgui.is_item_deactivated()
        if changed:
            changes[key] = tuple(min(max(float(v), 0.0), 1.0) for v in colour[:3])
    if changes:
        stops = with_stop(table.stops, number, **changes)
        editor.attempt(session.alter, table.id, {"stops": stops}, True)
    if sealed:
        session.seal()
