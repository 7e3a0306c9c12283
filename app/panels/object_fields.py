"""The fields of the object in hand, below the list of all: by the declaration of its kind, and what it has besides.

A water table has its gradient (gradient.py), a river its points (river_points.py).
"""

from __future__ import annotations

from functools import cache

from imgui_bundle import imgui

from ...level.objects import OBJECT_KINDS, Placed
from ...level.outline import ring
from ...level.params import Param, describe
from ...level.wave_lists import counted
from .. import param_widgets, theme
from ..actions import ACTIONS
from ..editor import Editor
from ..placing import BY_KIND
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
RING_POINTS = 8  # that an outline begins with
_state = {"renaming": "", "name": ""}


@cache
def fields(kind: str) -> tuple[Param, ...]:
    """The rows that are drawn for an object of a kind."""
    model = OBJECT_KINDS[kind]
    hidden = (*HIDDEN_FIELDS, "x", "y") if model.placeless else HIDDEN_FIELDS
    return tuple(row for row in describe(model) if row.name not in hidden)


def draw(editor: Editor, thing: Placed) -> None:
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
