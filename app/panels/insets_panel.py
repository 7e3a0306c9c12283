"""Views in the corners of the picture: which, where, how large, how turned (T12)."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from ...renderer.show import CORNERS, Inset
from ...renderer.sky_insets import SKY_INSETS, find_inset, inset_views
from .. import theme
from ..editor import FORCE_INSET, Editor
from ..param_widgets import tooltip

MOST = 6
LABEL_PX = 70


def draw(editor: Editor) -> None:
    """A few lines for each inset, and a button for one more."""
    for number, inset in enumerate(editor.insets):
        imgui.push_id(number)
        changed = _inset(inset)
        imgui.pop_id()
        if changed != inset:
            rest = editor.insets[number + 1 :]
            editor.insets = (*editor.insets[:number], *(() if changed is None else (changed,)), *rest)
            break
        imgui.separator()
    imgui.begin_disabled(len(editor.insets) >= MOST)
    if imgui.button(theme.titled("plus", "Add an inset", "add_inset")):
        editor.insets = (*editor.insets, FORCE_INSET if not editor.insets else Inset("flow", _free_corner(editor)))
    imgui.end_disabled()
    tooltip("A view in a corner of the running picture; I shows the pushed water, Shift+I the sky.")


def _free_corner(editor: Editor) -> str:
    taken = [inset.corner for inset in editor.insets]
    return min(CORNERS, key=taken.count)


def _inset(inset: Inset) -> Inset | None:
    """The inset as the widgets leave it; None when it is to go."""
    imgui.set_next_item_width(-34)
    if imgui.begin_combo("###inset_view", find_inset(inset.view).label, imgui.ComboFlags_.height_large):
        for view in inset_views().values():
            if imgui.selectable(f"{view.label}###inset_{view.name}", view.name == inset.view)[0]:
                inset = replace(inset, view=view.name)
            tooltip(view.doc)
        imgui.end_combo()
    imgui.same_line()
    if imgui.button(f"{theme.icon('trash') or 'x'}###remove_inset"):
        return None
    imgui.set_next_item_width(-LABEL_PX)
    changed, corner = imgui.combo("Corner", CORNERS.index(inset.corner), [c.replace("-", " ") for c in CORNERS])
    inset = replace(inset, corner=CORNERS[corner]) if changed else inset
    imgui.set_next_item_width(-LABEL_PX)
    changed, size = imgui.slider_float("Size", inset.size, 0.08, 0.9, "%.2f")
    inset = replace(inset, size=min(max(size, 0.05), 1.0)) if changed else inset
    return _map(inset) if find_inset(inset.view).mapped else inset


def _map(inset: Inset) -> Inset:
    """How a map is turned, and how much it shows."""
    changed, heading = imgui.checkbox("Ahead is up", inset.heading)
    inset = replace(inset, heading=heading) if changed else inset
    if not inset.heading:
        imgui.set_next_item_width(-LABEL_PX)
        changed, turn = imgui.slider_float("Turn", inset.turn_deg, -180, 180, "%.0f°")
        inset = replace(inset, turn_deg=min(max(turn, -360.0), 360.0)) if changed else inset
    imgui.set_next_item_width(-LABEL_PX)
    most = 70_000 if inset.view in SKY_INSETS else 2000
    changed, extent = imgui.slider_float("Across", inset.extent_m, 0, most, "%.0f m" if inset.extent_m else "all of it")
    return replace(inset, extent_m=min(max(extent, 0.0), 1e6)) if changed else inset
