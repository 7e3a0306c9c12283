"""All settings of the level, made from the declared parameters: a header a section, a widget a row, a filter on top."""

from __future__ import annotations

from functools import cache

from imgui_bundle import imgui

from ...level import Settings
from ...level.environments import ENVIRONMENTS, environment_of
from ...level.params import Param, describe, get
from ...level.weather_presets import WEATHERS, weather_of
from .. import param_widgets
from ..actions import ACTIONS
from ..editor import Editor
from ..idle_settings import idle
from . import curve_editor, loop_table, tide_curve

OPEN = ("shore", "sea")
# what is turned most comes first
ORDER = ("shore", "sea", "timing", "water", "foam", "flow", "force", "caustics", "glare", "quiet", "things", "light",
         "weather", "clouds", "storm", "rain", "fog", "cloud_terms", "ground", "wet", "scatter", "tide", "walk",
         "beach_mesh", "time", "level")  # fmt: skip
TITLES = {"sea": "Open sea", "shore": "Shore waves", "water": "Water colour", "fog": "Haze", "wet": "Wet shore",
          "glare": "Highlight", "quiet": "Quiet area", "things": "Props and rings", "force": "Pushed water",
          "walk": "Walkable", "beach_mesh": "Beach mesh", "timing": "Timing of waves", "cloud_terms": "Terms of clouds",
          "level": "Sea level and seed"}  # fmt: skip
_filter = {"text": ""}


@cache
def sections() -> dict[str, list[Param]]:
    """Parameter rows by section, with dotted names, most turned first."""
    rows: dict[str, list[Param]] = {}
    for row in describe(Settings):
        rows.setdefault(row.name.partition(".")[0], []).append(row)
    return {name: rows[name] for name in sorted(rows, key=lambda n: ORDER.index(n) if n in ORDER else len(ORDER))}


def matches(row: Param, text: str) -> bool:
    """Whether every word of a filter is in a row's name, section title or sentence."""
    section = row.name.partition(".")[0]
    place = f"{row.name} {TITLES.get(section, section)} {row.doc}".replace("_", " ").lower()
    return all(word in place for word in text.lower().replace("_", " ").split())


def draw(editor: Editor) -> None:
    imgui.set_next_item_width(-imgui.FLT_MIN)
    _, _filter["text"] = imgui.input_text_with_hint("###filter", "Find a setting", _filter["text"])
    imgui.spacing()
    if imgui.begin_child("###rows", imgui.ImVec2(0, 0)):
        for name, rows in sections().items():
            shown = [row for row in rows if matches(row, _filter["text"])]
            if shown:
                _section(editor, name, shown)
    imgui.end_child()


def _section(editor: Editor, name: str, rows: list[Param]) -> None:
    settings = editor.session.level.settings
    switch = next((row for row in rows if row.name == f"{name}.on"), None)
    if _filter["text"]:
        imgui.set_next_item_open(True)
    flags = imgui.TreeNodeFlags_.default_open if name in OPEN else imgui.TreeNodeFlags_.none
    flags |= imgui.TreeNodeFlags_.allow_overlap
    title = TITLES.get(name, name.capitalize())
    opened = imgui.collapsing_header(f"{title}###section_{name}", flags)
    section = type(getattr(settings, name))
    param_widgets.tooltip((section.__doc__ or "").strip() if section.__doc__ != type(settings).__doc__ else "")
    if switch:
        imgui.same_line(imgui.get_cursor_start_pos().x + imgui.get_content_region_avail().x - imgui.get_frame_height())
        changed, on = imgui.checkbox(f"###switch_{name}", get(settings, switch.name))
        param_widgets.tooltip(switch.doc)
        if changed:
            editor.set(switch.name, on)
    if opened and name == "light":
        _named(editor, "environment", "light", ENVIRONMENTS, environment_of(settings))
    if opened and name == "weather":
        _named(editor, "weather", "weather", WEATHERS, weather_of(settings))
    if opened and name == "storm":
        _storm(editor)
    if opened:
        imgui.push_style_var(imgui.StyleVar_.item_spacing, imgui.ImVec2(7, 4))
        param_widgets.draw_all(
            [row for row in rows if row is not switch and row.name not in (*curve_editor.PATHS, tide_curve.PATH)],
            lambda path: get(settings, path),
            lambda path, value, merge: editor.set(path, value, merge),
            editor.session.seal,
            idle(editor.session.level, editor.session.clock.time_s),
        )
        imgui.pop_style_var()
        if any(row.name in curve_editor.PATHS for row in rows):
            curve_editor.draw(editor)
        if any(row.name == tide_curve.PATH for row in rows):
            tide_curve.draw(editor)
        if name == "time":
            loop_table.draw(editor)
        imgui.spacing()


def _storm(editor: Editor) -> None:
    """Z23: one that sets out now, and its end."""
    for number, name in enumerate(("storm", "storm_end")):
        if number:
            imgui.same_line()
        imgui.begin_disabled(not ACTIONS[name].enabled(editor.session))
        if imgui.button(f"{ACTIONS[name].title}###{name}"):
            editor.do(ACTIONS[name])
        imgui.end_disabled()
    imgui.spacing()


def _named(editor: Editor, what: str, actions: str, table: dict, now: str) -> None:
    """Named light and air, or weather, as buttons that set all of it in one step."""
    right = imgui.get_cursor_screen_pos().x + imgui.get_content_region_avail().x
    first = next(iter(table))
    for row in table.values():
        style = imgui.get_style()
        wide = imgui.calc_text_size(row.label).x + 2 * style.frame_padding.x + style.item_spacing.x
        if row.name != first and imgui.get_item_rect_max().x + wide < right:
            imgui.same_line()
        chosen = row.name == now
        if chosen:
            imgui.push_style_color(imgui.Col_.button, imgui.get_style_color_vec4(imgui.Col_.button_active))
        if imgui.button(f"{row.label}###{what}_{row.name}"):
            editor.do(ACTIONS[f"{actions}.{row.name}"])
        if chosen:
            imgui.pop_style_color()
        param_widgets.tooltip(row.doc)
    imgui.spacing()
