"""What the panel of a brush shows beside its numbers: the alpha that shapes it, and the limits of where it works."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from imgui_bundle import imgui

from ...brushes.alphas import smaller, unpack
from ...brushes.masks import MOST, SOURCES, Limit, limits_of, text_of
from ...level.params import Section
from .. import param_widgets, theme
from ..editor import Editor

PIXELS = 20  # of the small picture, a side
PIXEL = 2.0
ENDS = (("low", "from"), ("high", "to"), ("soft", "fade"))


def draw(editor: Editor, params: Section) -> None:
    """Both, as far as the brush has them."""
    fields = type(params).model_fields
    if "alpha" in fields:
        _alpha(editor, params.alpha)
    if "only_where" in fields:
        _limits(editor, params.only_where)


def hidden(params: Section) -> frozenset[str]:
    """Parameters that have a widget here, or mean nothing with or without an alpha."""
    names = {"alpha", "only_where"}
    if getattr(params, "alpha", ""):
        names.add("falloff")
        if params.alpha_turn != "random":
            names.add("alpha_seed")
    else:
        names |= {"alpha_turn", "alpha_angle_deg", "alpha_seed"}
    return frozenset(names)


def _alpha(editor: Editor, text: str) -> None:
    param_widgets.beside("Alpha", "A grey picture that shapes the dab in place of the falloff.")
    name = unpack(text).name if text else "Round"
    wide = imgui.get_content_region_avail().x - (30 if text else 0)
    if imgui.button(f"{param_widgets.fitted(name, wide - 16)}###alpha", imgui.ImVec2(wide, 0)):
        editor.session.ask("alpha")
    param_widgets.tooltip("From a file…")
    if not text:
        return
    imgui.same_line(0, 4)
    if imgui.button("×###alpha_round", imgui.ImVec2(26, 0)):
        editor.attempt(editor.session.set_param, "alpha", "")
    param_widgets.tooltip("Round again")
    _thumbnail(text)


def _thumbnail(text: str) -> None:
    """The picture in few pixels."""
    grey = unpack(text).grey
    grey = smaller(grey, PIXELS) if len(grey) > PIXELS else grey
    corner, draw_list = imgui.get_cursor_screen_pos(), imgui.get_window_draw_list()
    pixel = PIXEL * PIXELS / len(grey)
    for (row, col), value in np.ndenumerate(grey[::-1]):
        low = imgui.ImVec2(corner.x + col * pixel, corner.y + row * pixel)
        high = imgui.ImVec2(low.x + pixel, low.y + pixel)
        draw_list.add_rect_filled(low, high, theme.packed((1.0, 1.0, 1.0), float(value)))
    imgui.dummy(imgui.ImVec2(PIXEL * PIXELS, PIXEL * PIXELS + 2))


def _limits(editor: Editor, text: str) -> None:
    """A block for each limit and a list to add one from."""
    limits = list(limits_of(text))
    imgui.spacing()
    with theme.bold():
        imgui.text_unformatted("Only where")
    changed = False
    for number, limit in enumerate(limits):
        imgui.push_id(f"limit_{number}")
        new = _limit(limit)
        imgui.pop_id()
        if new != limit:
            limits[number], changed = new, True
    if len(limits) < MOST:
        imgui.set_next_item_width(-imgui.FLT_MIN)
        added = _added()
        if added:
            limits, changed = [*limits, added], True
    if changed:
        editor.attempt(editor.session.set_param, "only_where", text_of(limit for limit in limits if limit))


def _added() -> Limit | None:
    found = None
    if imgui.begin_combo("###limit_new", "Add a limit…"):
        for source in SOURCES.values():
            if imgui.selectable(f"{_told(source.name)}###limit_{source.name}", False)[0]:
                found = Limit(source.name, *source.usual)
            param_widgets.tooltip(source.doc)
        imgui.end_combo()
    return found


def _limit(limit: Limit) -> Limit | None:
    """Its source, ends and fade; None when it was taken away."""
    source = SOURCES[limit.source]
    right = imgui.get_cursor_pos_x() + imgui.get_content_region_avail().x
    imgui.align_text_to_frame_padding()
    imgui.text_unformatted(_told(source.name) + (f", {source.unit}" if source.unit else ""))
    param_widgets.tooltip(source.doc)
    imgui.same_line(right - 26)
    if imgui.button("×###limit_gone", imgui.ImVec2(26, 0)):
        return None
    wide = (imgui.get_content_region_avail().x - 8) / len(ENDS)
    for number, (name, hint) in enumerate(ENDS):
        if number:
            imgui.same_line(0, 4)
        imgui.set_next_item_width(wide)
        value = getattr(limit, name)
        shown = "" if value is None or (name == "soft" and not value) else f"{value:g}"
        typed, text = imgui.input_text_with_hint(f"###limit_{name}", hint, shown)
        param_widgets.tooltip("How much of the range fades at either end." if name == "soft" else "Empty: an open end.")
        if typed:
            limit = _typed(limit, name, text)
    return limit


def _typed(limit: Limit, name: str, text: str) -> Limit:
    """With one number as it was typed; as it was while that is no number, or no range."""
    try:
        value = float(text) if text.strip() else None
    except ValueError:
        return limit
    if name == "soft":
        return replace(limit, soft=max(value or 0.0, 0.0)) if value is None or np.isfinite(value) else limit
    new = replace(limit, **{name: value})
    fits = None in (new.low, new.high) or new.low <= new.high
    return new if fits and (value is None or np.isfinite(value)) else limit


def _told(name: str) -> str:
    """`foam.constant` → `Foam constant`, `depth_m` → `Depth`."""
    words = name.replace(".", " ").replace("_", " ").split()
    if SOURCES[name].unit and len(words) > 1:
        words = words[:-1]
    return " ".join(words).capitalize()
