"""Everything placed in the level: a list by kind, and below it the fields of the one in hand.

Works for every row of OBJECT_KINDS by its declaration; a water table has its gradient besides (gradient.py).
"""

from __future__ import annotations

from functools import cache

from imgui_bundle import imgui

from ...level.objects import OBJECT_KINDS, Placed
from ...level.outline import ring
from ...level.params import Param, describe
from ...level.pick import ground_at
from ...level.wave_lists import counted
from .. import param_widgets, theme
from ..actions import ACTIONS
from ..editor import Editor
from ..object_markers import markers
from ..placing import BY_KIND, PLACEABLES
from ..tools import SELECT
from . import gradient, river_points

HIDDEN_FIELDS = (
    "id",
    "kind",
    "stops",
    "points",
    "mesh",
    "map",
    "camera",
    "outline",
)  # what has its own widget, or none
LIST_SHARE = 0.42
RING_POINTS = 8  # that an outline begins with
FRAMED_M = 30.0  # how far off the camera stands from what it goes to
_state = {"filter": "", "renaming": "", "name": "", "seen": ""}


@cache
def fields(kind: str) -> tuple[Param, ...]:
    """The rows that are drawn for an object of a kind."""
    model = OBJECT_KINDS[kind]
    hidden = (*HIDDEN_FIELDS, "x", "y") if model.placeless else HIDDEN_FIELDS
    return tuple(row for row in describe(model) if row.name not in hidden)


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
            _selected(editor, thing)
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


def _selected(editor: Editor, thing: Placed) -> None:
    session = editor.session
    _name(editor, thing)
    imgui.push_style_color(imgui.Col_.text, theme.colour(theme.INK_FAINT))
    imgui.text_wrapped((type(thing).__doc__ or BY_KIND[thing.kind].doc).strip().partition("\n")[0])
    imgui.pop_style_color()
    imgui.spacing()
    if thing.kind == "water_table":
        gradient.draw(editor, thing)
        return
    if thing.kind == "prop":
        _mesh(editor, thing)
    if thing.kind == "shot":
        _sky(editor, thing)
    if thing.kind == "weather_key":
        _reach(editor, thing)
    if thing.kind == "river":
        river_points.draw(editor, thing)
    if thing.kind == "wave":
        _fit(editor, thing)
    if thing.kind == "wave_region":
        _shape(editor, thing)
    no_radius = bool(getattr(thing, "outline", ()))
    param_widgets.draw_all(
        [row for row in fields(thing.kind) if row.name != "radius_m" or not no_radius],
        lambda name: getattr(thing, name),
        lambda name, value, merge: editor.attempt(session.alter, thing.id, {name: value}, merge),
        session.seal,
    )


def _name(editor: Editor, thing: Placed) -> None:
    """The id as a text; Enter renames."""
    if _state["renaming"] != thing.id:
        _state.update(renaming=thing.id, name=thing.id)
    imgui.set_next_item_width(-imgui.FLT_MIN)
    flags = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all
    entered, _state["name"] = imgui.input_text("###object_name", _state["name"], flags)
    param_widgets.tooltip("Name, unique in the level; Enter renames.")
    if entered:
        editor.attempt(editor.session.rename, thing.id, _state["name"])
        _state["renaming"] = ""


def _fit(editor: Editor, thing: Placed) -> None:
    """Both ways to fit a wave object to the shore; whether it is one too many."""
    for told in counted(editor.session.level)[1]:
        if f": {thing.id}, " in told:
            imgui.push_style_color(imgui.Col_.text, theme.colour(theme.WARM))
            imgui.text_wrapped(told)
            imgui.pop_style_color()
    for name, text in (("wave.fit", "Fit to the bay"), ("wave.fit_place", "Fit and move")):
        if imgui.button(theme.titled("water", text, name)):
            editor.do(ACTIONS[name])
        param_widgets.tooltip(f"{ACTIONS[name].title}: its fronts come in along the shore within its circle.")
        imgui.same_line()
    imgui.new_line()


def _shape(editor: Editor, region: Placed) -> None:
    """A circle, or an outline whose points are dragged on the water."""
    count = len(region.outline) // 2
    told = f"{count} points: drag them, or the dots between." if count else "A circle."
    imgui.text_colored(theme.colour(theme.INK_FAINT), told)
    text, made = ("Circle", ()) if count else ("Outline", ring(RING_POINTS, region.radius_m))
    if imgui.button(theme.titled("draw_polygon", text, "region_shape")):
        editor.attempt(editor.session.alter, region.id, {"outline": made})
    param_widgets.tooltip(
        "Back to the circle of its radius."
        if count
        else "Points on its circle, to be dragged; onto each other they join."
    )


def _mesh(editor: Editor, thing: Placed) -> None:
    """Which of the level's meshes a prop shows."""
    session = editor.session
    imgui.set_next_item_width(-imgui.FLT_MIN)
    if imgui.begin_combo("###mesh", thing.mesh or "no mesh"):
        for name in session.level.meshes:
            if imgui.selectable(f"{name}###mesh_{name}", name == thing.mesh)[0]:
                editor.attempt(session.alter, thing.id, {"mesh": name})
        if imgui.selectable("From a file…", False)[0]:
            session.ask("prop")
        imgui.end_combo()
    param_widgets.tooltip("The mesh it shows, of those that the level holds.")


def _reach(editor: Editor, key: Placed) -> None:
    """What a key of the weather acts on, which its circle decides (D36)."""
    weather = editor.session.level.settings.weather
    text = (
        "Everywhere: sky, waves, wind, rain and current."
        if not key.radius_m
        else ("Over its circle the sky alone: coverage, type, precipitation.")
    )
    imgui.push_text_wrap_pos(0)
    imgui.text_unformatted(text)
    if key.radius_m and key.weather == "snow" and weather.temperature_c > weather.snow_below_c:
        cold = f"It rains here: snow falls below {weather.snow_below_c:g} °C, and the whole level has"
        imgui.text_colored(theme.colour(theme.WARM), f"{cold} {weather.temperature_c:g} °C.")
    imgui.pop_text_wrap_pos()
    imgui.spacing()


def _sky(editor: Editor, thing: Placed) -> None:
    """Which of the level's skies a shot shows, and in whose picture."""
    session = editor.session
    cameras = sorted(name for name, other in session.level.objects.items() if other.kind == "camera")
    for field, title, names, none, doc in (
        ("map", "Sky", sorted(session.level.skies), "no sky", "The sky it shows, of those that the level holds."),
        ("camera", "Camera", cameras, "all cameras", "The camera whose picture has it; others don't see it."),
    ):
        value = getattr(thing, field)
        param_widgets.beside(title, doc)
        if imgui.begin_combo(f"###{field}", value or none):
            for name in names if field == "map" else ["", *names]:
                if imgui.selectable(f"{name or none}###{field}_{name}", name == value)[0]:
                    editor.attempt(session.alter, thing.id, {field: name})
            imgui.end_combo()
        param_widgets.tooltip(doc)
    action = ACTIONS["shot_to_paint"]
    imgui.begin_disabled(not action.enabled(session))
    if imgui.button(theme.titled("paintbrush", "Into the paint", "shot_to_paint")):
        editor.do(action)
    imgui.end_disabled()
    param_widgets.tooltip("Its sky becomes the painted one, to be painted on; what was painted before goes (undo).")
    if thing.end_s <= thing.start_s:
        imgui.text_colored(theme.colour(theme.WARM), "It ends before it starts, so it is never seen.")
