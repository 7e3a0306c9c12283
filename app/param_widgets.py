"""A widget from a row of the parameter table: slider over the soft range, typed value to the hard one, unit, sentence.

A drag is one undo step: while it runs `change(value, merge=True)` is called, at its end `seal()`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from imgui_bundle import imgui

from ..level.params import Param
from . import theme

Change = Callable[[Any, bool], None]

# Suffixes of names that the unit beside the value already says (style: units in names)
UNIT_SUFFIXES = ("m", "km", "mm", "s", "h", "deg", "c", "ev", "mps", "px", "pct")
LABEL_SHARE = 0.42
PAINT = "paint_"
NONE_IDLE: Mapping[str, str] = MappingProxyType({})


def label_of(row: Param) -> str:
    """What stands beside the widget: `sea.swell_length_m` → `Swell length`."""
    words = row.name.rpartition(".")[2].split("_")
    while len(words) > 1 and words[-1] in UNIT_SUFFIXES and row.unit:
        words = words[:-1]
    text = " ".join(words)
    return text[:1].upper() + text[1:]


def labels(rows: list[Param]) -> list[str]:
    """Labels of rows that stand together; two that would read the same keep their unit."""
    plain = [label_of(row) for row in rows]
    return [
        f"{text} ({row.unit})" if row.unit and plain.count(text) > 1 else text
        for row, text in zip(rows, plain, strict=True)
    ]


def slider_range(row: Param) -> tuple[float, float]:
    """The soft range, else the hard one; open ends are closed about the default."""
    if row.soft:
        return row.soft
    reach = max(abs(float(row.default or 0)) * 4, 1.0)
    low = row.low if row.low is not None else float(row.default or 0) - reach
    high = row.high if row.high is not None else float(row.default or 0) + reach
    return low, high


def digits(row: Param) -> int:
    """Decimals that let a slider of this range move in a hundred steps or more."""
    low, high = slider_range(row)
    span = max(high - low, 1e-9)
    return min(max(math.ceil(1.7 - math.log10(span)), 0), 6)


def format_of(row: Param) -> str:
    """printf format of a number with its unit."""
    unit = row.unit.replace("%", "%%")
    gap = "" if unit in ("°", "×") or not unit else " "
    return f"%d{gap}{unit}" if row.kind == "int" else f"%.{digits(row)}f{gap}{unit}"


def logarithmic(row: Param) -> bool:
    """Whether a range spans so much that equal ways should be equal factors: sizes and lengths from small to huge."""
    low, high = slider_range(row)
    return row.kind == "float" and low > 0 and high / low >= 50


def same(row: Param, a: Any, b: Any) -> bool:
    """Equal as far as the widget shows it."""
    if row.kind == "float":
        return abs(a - b) <= 0.5 * 10.0 ** -digits(row)
    return a == b


def tooltip_of(row: Param) -> str:
    """The sentence, the hard range and the default."""
    lines = [row.doc] if row.doc else []
    unit = f" {row.unit}" if row.unit else ""
    if row.kind in ("float", "int") and row.low is not None and row.high is not None:
        lines.append(f"{row.low:g} to {row.high:g}{unit}; Ctrl+click types a value.")
    shown = f"{row.default:g}{unit}" if row.kind in ("float", "int") else str(row.default)
    lines.append(f"Default {shown}; right click goes back to it.")
    return "\n".join(lines)


def tooltip(text: str) -> None:
    """A wrapped tooltip for the item before, shown after the usual delay."""
    if text and imgui.begin_item_tooltip():
        imgui.push_text_wrap_pos(imgui.get_font_size() * 22)
        imgui.text_unformatted(text)
        imgui.pop_text_wrap_pos()
        imgui.end_tooltip()


def draw(
    row: Param, value: Any, change: Change, seal: Callable[[], None], label: str = "",
    switch: Callable[[], bool] | None = None, idle: str = "",
) -> bool:  # fmt: skip
    """One line: label, then the widget; calls `change(new, merge)` and `seal()`; returns whether it changed.

    `switch` draws a checkbox in front of the widget and returns whether there is to be one. `idle` says in a few words
    why the value changes nothing now; it stands where the widget would.
    """
    imgui.push_id(row.name)
    _label(row, value, label or label_of(row))
    imgui.same_line(_label_width())
    if idle:
        imgui.align_text_to_frame_padding()
        imgui.text_colored(theme.colour(theme.INK_FAINT), fitted(idle, imgui.get_content_region_avail().x))
        tooltip(f"{idle}.\n{tooltip_of(row)}")
        imgui.pop_id()
        return False
    if switch is not None:
        shown = switch()
        imgui.same_line()
        if not shown:
            imgui.text_colored(theme.colour(theme.INK_FAINT), "stays as it is")
            imgui.pop_id()
            return False
    imgui.set_next_item_width(-imgui.FLT_MIN)
    changed, new = _widget(row, value)
    ended = imgui.is_item_deactivated()
    live = imgui.is_item_active()
    tooltip(tooltip_of(row))
    if imgui.is_item_clicked(imgui.MouseButton_.right) and not same(row, value, row.default):
        changed, new, ended, live = True, row.default, True, False
    if changed:
        change(row.clamp(new), live or row.kind in ("float", "int", "vector"))
    if ended:
        seal()
    imgui.pop_id()
    return changed


def draw_all(
    rows: list[Param], values: Callable[[str], Any], change: Callable[[str, Any, bool], None],
    seal: Callable[[], None], idle: Mapping[str, str] = NONE_IDLE,
) -> None:  # fmt: skip
    """A line for every row; `values(name)` and `change(name, value, merge)` use the rows' own names.

    A switch that is called by PAINT and a row's name stands in that row's line. `idle` tells by name why a row changes
    nothing now.
    """
    names = {row.name for row in rows}
    switches = {row.name: row for row in rows if row.name.removeprefix(PAINT) in names - {row.name}}
    lines = [row for row in rows if row.name not in switches]
    for row, label in zip(lines, labels(lines), strict=True):
        own = switches.get(PAINT + row.name)
        switch = (lambda own=own: _switch(own, values(own.name), change)) if own else None
        draw(row, values(row.name), lambda value, merge, name=row.name: change(name, value, merge), seal, label, switch,
             idle.get(row.name, ""))  # fmt: skip


def _switch(row: Param, on: bool, change: Callable[[str, Any, bool], None]) -> bool:
    changed, now = imgui.checkbox(f"##{row.name}", on)
    tooltip(tooltip_of(row))
    if changed:
        change(row.name, now, False)
    return now


def _label_width() -> float:
    return imgui.get_cursor_start_pos().x + imgui.get_content_region_avail().x * LABEL_SHARE


def _label(row: Param, value: Any, label: str) -> None:
    """The name, warm where the value isn't the default."""
    imgui.align_text_to_frame_padding()
    ink = theme.INK if same(row, value, row.default) else theme.WARM
    width = imgui.get_content_region_avail().x * LABEL_SHARE - imgui.get_style().item_spacing.x
    imgui.push_style_color(imgui.Col_.text, theme.colour(ink))
    imgui.text_unformatted(fitted(label, width))
    imgui.pop_style_color()
    tooltip(tooltip_of(row))


def beside(label: str, doc: str) -> None:
    """Begin a line as `draw` does: a label, and the next widget in the column of widgets."""
    imgui.align_text_to_frame_padding()
    imgui.text_unformatted(label)
    tooltip(doc)
    imgui.same_line(_label_width())
    imgui.set_next_item_width(-imgui.FLT_MIN)


def fitted(text: str, width: float) -> str:
    """A text shortened with … until it fits."""
    if imgui.calc_text_size(text).x <= width:
        return text
    while len(text) > 1 and imgui.calc_text_size(text + "…").x > width:
        text = text[:-1]
    return text.rstrip() + "…"


def _widget(row: Param, value: Any) -> tuple[bool, Any]:
    if row.kind == "bool":
        return imgui.checkbox("##value", bool(value))
    if row.kind == "choice":
        index = row.choices.index(value) if value in row.choices else 0
        changed, index = imgui.combo("##value", index, [choice.replace("_", " ") for choice in row.choices])
        return changed, row.choices[index]
    if row.kind == "text":
        return imgui.input_text("##value", str(value or ""), imgui.InputTextFlags_.enter_returns_true)
    if row.kind == "vector":
        return _vector(value)
    low, high = slider_range(row)
    return slider("##value", value, low, high, format_of(row), row.kind == "int", logarithmic(row))


def filled(value: float, low: float, high: float, log: bool = False) -> float:
    """Which part of a slider's bar is filled, 0 … 1."""
    if log:
        value, low, high = (math.log(max(v, 1e-12)) for v in (value, low, high))
    return min(max((value - low) / (high - low), 0.0), 1.0) if high > low else 0.0


def slider(
    label: str, value: float, low: float, high: float, text: str, whole: bool = False, log: bool = False
) -> tuple[bool, Any]:
    """A slider as a bar that fills up, so that its number can always be read; takes the item width set before."""
    corner = imgui.get_cursor_screen_pos()
    width, height = imgui.calc_item_width(), imgui.get_frame_height()
    draw_list, rounding = imgui.get_window_draw_list(), imgui.get_style().frame_rounding
    end = imgui.ImVec2(corner.x + width, corner.y + height)
    hovered = imgui.is_window_hovered() and imgui.is_mouse_hovering_rect(corner, end)
    draw_list.add_rect_filled(corner, end, theme.packed(theme.FIELD_HOVER if hovered else theme.FIELD), rounding)
    full = imgui.ImVec2(corner.x + width * filled(value, low, high, log), end.y)
    if full.x > corner.x + 1:
        draw_list.add_rect_filled(corner, full, theme.packed(theme.ACCENT_DEEP, 1.0 if hovered else 0.85), rounding)
    clear = theme.colour(theme.FIELD, 0)
    hidden = ("frame_bg", "frame_bg_hovered", "frame_bg_active", "slider_grab", "slider_grab_active")
    for name in hidden:
        imgui.push_style_color(getattr(imgui.Col_, name), clear)
    if whole:
        result = imgui.slider_int(label, int(value), int(low), int(min(high, 2**30)), text)
    else:
        flags = imgui.SliderFlags_.logarithmic if log else imgui.SliderFlags_.none
        result = imgui.slider_float(label, float(value), low, high, text, flags)
    imgui.pop_style_color(len(hidden))
    return result


def _vector(value: Any) -> tuple[bool, tuple[float, ...]]:
    values = [float(v) for v in value]
    widget = {2: imgui.input_float2, 3: imgui.input_float3, 4: imgui.input_float4}.get(len(values))
    if widget is None:
        return False, tuple(values)
    changed, values = widget("##value", values)
    return changed, tuple(values)
