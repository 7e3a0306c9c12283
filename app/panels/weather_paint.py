"""Below the weather map: named weather and storm, what hides the paint, skies with a name to paint with (T04, D36)."""

from __future__ import annotations

from imgui_bundle import imgui

from ...level.cloud_types import CLOUD_TYPES, CloudType
from ...level.weather_presets import WEATHERS, weather_of
from .. import sky_brush, theme
from ..actions import ACTIONS
from ..editor import Editor
from ..param_widgets import tooltip

STORM_DOC = {
    "storm": "Sends thunderheads out upwind that come with the wind until they rain here; section Storm has distance"
    " and depth.",
    "storm_end": "No storm any more, as one step.",
}


def draw(editor: Editor) -> None:
    """All of it, into the current imgui window."""
    _weather(editor)
    _hints(editor)
    _swatches(editor)


def _weather(editor: Editor) -> None:
    """The named weather that the simulation is under, and a storm that comes or goes."""
    now = weather_of(editor.session.level.settings)
    imgui.set_next_item_width(100)
    if imgui.begin_combo("###weather_preset", WEATHERS[now].label if now else "Own mix"):
        for row in WEATHERS.values():
            if imgui.selectable(f"{row.label}###preset_{row.name}", row.name == now)[0]:
                editor.do(ACTIONS[f"weather.{row.name}"])
            tooltip(row.doc)
        imgui.end_combo()
    tooltip("Named weather: sets waves, wind and sky in one step. Paint and shots lie over its sky.")
    imgui.same_line()
    storm = ACTIONS["storm_end" if ACTIONS["storm_end"].enabled(editor.session) else "storm"]
    if imgui.button(theme.titled("cloud_bolt", storm.title, "weather_storm")):
        editor.do(storm)
    tooltip(STORM_DOC[storm.id])


def _hints(editor: Editor) -> None:
    """What keeps the paint from being seen, with a way out."""
    settings = editor.session.level.settings
    for path, on, text in (
        ("clouds.on", settings.clouds.on, "Clouds are not drawn."),
        ("weather.painted", settings.weather.painted, "Painted weather does not count."),
    ):
        if on:
            continue
        imgui.align_text_to_frame_padding()
        imgui.text_colored(theme.colour(theme.WARM), text)
        imgui.same_line()
        if imgui.button(f"Switch on###on_{path}"):
            editor.set(path, True)
        tooltip(f"Sets {path}.")


def _swatches(editor: Editor) -> None:
    """Skies with a name: a click makes one the target of the brush."""
    imgui.separator_text("Paint")
    for name, title, text, doc in (
        ("sky.fill", "fill", "Fill the sky", "The brush's targets over the whole sky, as one step."),
        ("sky.erase", "eraser", "Erase paint", "No paint anywhere: the simulation alone, as one step."),
    ):
        imgui.begin_disabled(not ACTIONS[name].enabled(editor.session))
        if imgui.button(theme.titled(title, text, name)):
            editor.do(name)
        imgui.end_disabled()
        tooltip(doc)
        imgui.same_line()
    imgui.new_line()
    session, chosen = editor.session, sky_brush.chosen(editor.session)
    columns = max(int(imgui.get_content_region_avail().x // 140), 1)
    if not imgui.begin_table("###swatches", columns, imgui.TableFlags_.sizing_stretch_same):
        return
    for row in CLOUD_TYPES.values():
        imgui.table_next_column()
        if _swatch(row, row.name == chosen and sky_brush.in_hand(session)):
            editor.attempt(sky_brush.choose, session, row.name)
        numbers = f"coverage {row.coverage:g}, precipitation {row.precipitation:g}, type {row.type:g}"
        tooltip(f"{row.doc}\nTakes the brush with {numbers}.")
    imgui.end_table()


def _swatch(row: CloudType, lit: bool) -> bool:
    corner, height = imgui.get_cursor_screen_pos(), imgui.get_frame_height()
    if lit:
        for name in ("header", "header_hovered"):
            imgui.push_style_color(getattr(imgui.Col_, name), theme.colour(theme.ACCENT_DEEP))
    clicked = imgui.selectable(f"###cloud_{row.name}", lit, 0, imgui.ImVec2(0, height))[0]
    if lit:
        imgui.pop_style_color(2)
    draw_list, ink = imgui.get_window_draw_list(), (row.coverage, row.precipitation, row.type)
    low, high = imgui.ImVec2(corner.x + 3, corner.y + 3), imgui.ImVec2(corner.x + height - 3, corner.y + height - 3)
    draw_list.add_rect_filled(low, high, theme.packed(ink), 3)
    draw_list.add_rect(low, high, theme.packed(theme.INK_FAINT, 0.7), 3)
    middle = corner.y + (height - imgui.get_font_size()) / 2
    draw_list.add_text(imgui.ImVec2(corner.x + height + 4, middle), theme.packed(theme.INK), row.label)
    return clicked
