"""VIEWS, show flags and cameras: everything about how the level is looked at (T11, D40)."""

from __future__ import annotations

import re

from imgui_bundle import imgui

from ...level.objects import Camera
from ...renderer import SHOW_FLAGS, VIEWS
from .. import theme
from ..editor import Editor
from ..param_widgets import tooltip
from . import insets_panel

_filter = {"text": "", "camera": ""}


def draw(editor: Editor) -> None:
    session = editor.session
    if imgui.collapsing_header("Show", imgui.TreeNodeFlags_.default_open):
        _flags(editor)
    if imgui.collapsing_header("Cameras", imgui.TreeNodeFlags_.default_open):
        cameras(editor)
    if imgui.collapsing_header("Insets"):
        insets_panel.draw(editor)
    if imgui.collapsing_header("Views", imgui.TreeNodeFlags_.default_open):
        imgui.set_next_item_width(-imgui.FLT_MIN)
        _, _filter["text"] = imgui.input_text_with_hint("###view_filter", "Find a view", _filter["text"])
        if imgui.begin_child("###views", imgui.ImVec2(0, 0)):
            for view in VIEWS.values():
                if _filter["text"].lower() not in f"{view.label} {view.doc} {view.ids}".lower():
                    continue
                if imgui.selectable(f"{view.label}###{view.name}", session.view == view.name)[0]:
                    session.view = view.name
                tooltip(view.doc)
        imgui.end_child()


def _flags(editor: Editor) -> None:
    if imgui.begin_table("###flags", 2):
        for name in SHOW_FLAGS:
            imgui.table_next_column()
            flag_box(editor, name)
        imgui.end_table()


def flag_box(editor: Editor, name: str) -> None:
    """The switch of a part of the picture."""
    session, flag = editor.session, SHOW_FLAGS[name]
    changed, _ = imgui.checkbox(f"{flag.label}###flag_{name}", name in session.show)
    tooltip(flag.doc)
    if changed:
        session.show = session.show.toggled(name)


def cameras(editor: Editor) -> None:
    """Saved cameras to go to, and this view as a new one."""
    session = editor.session
    saved = sorted((o for o in session.level.objects.values() if isinstance(o, Camera)), key=lambda c: c.id)
    for camera in saved:
        if imgui.selectable(f"{theme.icon('video')}  {camera.id}###camera_{camera.id}", session.camera == camera)[0]:
            editor.fly_to(camera)
        tooltip(f"Go to {camera.id}. Right click for more.")
        if imgui.begin_popup_context_item(f"###menu_{camera.id}"):
            if imgui.menu_item_simple("Set it to this view"):
                editor.attempt(session.place, session.camera.model_copy(update={"id": camera.id}))
            if imgui.menu_item_simple("Remove"):
                editor.attempt(session.remove, camera.id)
            imgui.end_popup()
    imgui.set_next_item_width(max(imgui.get_content_region_avail().x - 90, 90))
    _, _filter["camera"] = imgui.input_text_with_hint("###camera_name", "name", _filter["camera"])
    imgui.same_line()
    name = re.sub(r"[^A-Za-z0-9_.-]+", "_", _filter["camera"]).strip("_")
    imgui.begin_disabled(not name)
    if imgui.button("Save view"):
        editor.attempt(session.place, session.camera.model_copy(update={"id": name}))
        _filter["camera"] = ""
    imgui.end_disabled()
    tooltip("Keep this view as a camera of the level, for the game and for `render --camera`.")
