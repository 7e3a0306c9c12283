"""Everything placed in the level: a list by kind, and below it the fields of the one in hand.

object_fields.py draws those.
"""

from __future__ import annotations

from imgui_bundle import imgui

from ...level.pick import ground_at
from .. import param_widgets, theme
from ..actions import ACTIONS
from ..editor import Editor
from ..object_markers import markers
from ..placing import BY_KIND, PLACEABLES
from ..tools import SELECT
from . import object_fields

LIST_SHARE = 0.42
FRAMED_M = 30.0  # how far off the camera stands from what it goes to
_state = {"filter": "", "seen": ""}


def draw(editor: Editor) -> None:
    session = editor.session
    _tools(editor)
    imgui.set_next_item_width(-imgui.FLT_MIN)
    _, _state["filter"] = imgui.input_text_with_hint("###object_filter", "Find an object", _state["filter"])
    thing = session.level.objects.get(session.selected)
    room = imgui.get_content_region_avail().y
    if imgui.begin_child("###objects", imgui.ImVec2(0, room * (LIST_SHARE if thing else 1.0))):
        _list(editor)
    imgui.end_child()
    if thing is not None:
        imgui.separator()
        if imgui.begin_child("###fields", imgui.ImVec2(0, 0)):
            object_fields.draw(editor, thing)
        imgui.end_child()


def _tools(editor: Editor) -> None:
    """Add, and what can be done with the object in hand."""
    if imgui.button(theme.titled("plus", "Add", "add_object")):
        imgui.open_popup("add_popup")
    param_widgets.tooltip("Place something in the middle of the picture.")
    if imgui.begin_popup("add_popup"):
        for row in PLACEABLES.values():
            if imgui.menu_item_simple(theme.titled(row.glyph, row.title, f"add_{row.name}")):
                editor.do(ACTIONS[f"place.{row.name}"])
            param_widgets.tooltip(row.doc)
        imgui.end_popup()
    for name, glyph in (("object.duplicate", "clone"), ("object.delete", "trash")):
        action = ACTIONS[name]
        imgui.same_line()
        imgui.begin_disabled(not action.enabled(editor.session))
        if imgui.button(f"{theme.icon(glyph) or action.title}###{name}"):
            editor.do(action)
        imgui.end_disabled()
        param_widgets.tooltip(f"{action.title} ({action.keys[0]}).")


def _list(editor: Editor) -> None:
    session = editor.session
    words = _state["filter"].lower().split()
    shown = 0
    for kind, row in BY_KIND.items():
        names = sorted(name for name, thing in session.level.objects.items() if thing.kind == kind)
        names = [name for name in names if all(word in f"{name} {row.title}".lower() for word in words)]
        if not names:
            continue
        shown += len(names)
        imgui.text_colored(theme.colour(theme.INK_FAINT), f"{row.title}  {len(names)}")
        for name in names:
            _row(editor, name, row.glyph)
    if not shown:
        faint = "Nothing is placed yet." if not session.level.objects else "Nothing is called like that."
        imgui.text_colored(theme.colour(theme.INK_FAINT), faint)


def _row(editor: Editor, name: str, glyph: str) -> None:
    session = editor.session
    clicked, _ = imgui.selectable(
        f"   {theme.icon(glyph)}   {name}###object_{name}", name == session.selected,
        imgui.SelectableFlags_.allow_double_click,
    )  # fmt: skip
    if clicked:
        session.selected = name
        if session.tool != SELECT:
            session.tool = SELECT
        if imgui.is_mouse_double_clicked(0):
            go_to(editor, name)
    if name == session.selected != _state["seen"]:  # taken in hand elsewhere
        _state["seen"] = name
        if not imgui.is_item_visible():
            imgui.set_scroll_here_y()
    param_widgets.tooltip("Double click goes there.")


def go_to(editor: Editor, name: str) -> None:
    """Fly to an object: through a saved camera's eyes, else so that it stands in the middle."""
    session = editor.session
    thing = session.level.objects[name]
    if thing.kind == "camera":
        editor.fly_to(thing)
        return
    if thing.kind == "marker":
        session.scrub(thing.time_s)
        return
    if thing.kind == "shot":
        session.scrub(min(thing.start_s + thing.fade_s, (thing.start_s + thing.end_s) / 2))
        if thing.camera in session.level.objects:
            go_to(editor, thing.camera)
        return
    for marker in markers(session.level):
        if marker.id == name:
            editor.fly_to(looking_at(session.camera, marker.place, session.level))


def looking_at(camera, at, level):
    """The camera moved along its view until a world point stands in its middle, `FRAMED_M` off, over the ground."""
    from ..camera_control import above_ground, axes, moved

    _, _, forward = axes(camera)
    x, y, z = (float(a - FRAMED_M * f) for a, f in zip(at, forward, strict=True))
    return above_ground(level, moved(camera, (x, y, max(z, float(ground_at(level, x, y)) + 2.0))))
