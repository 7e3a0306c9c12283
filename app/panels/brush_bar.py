"""The brushes: a bar of buttons in table order with their keys, and the parameters of the one in hand."""

from __future__ import annotations

from imgui_bundle import imgui

from ...brushes import BRUSHES
from ...level.params import describe
from .. import param_widgets, theme
from ..editor import Editor
from ..tools import BRUSH, FRONT, SELECT, TOOLS, pick_tool
from . import brush_limits

TILE_PX = 56
# Profiles of the ground in a unit square, y up: what each brush makes of it. A brush without one shows a circle.
PROFILES: dict[str, tuple[tuple[float, float], ...]] = {
    "raise": ((0, 0.2), (0.22, 0.22), (0.38, 0.62), (0.5, 0.78), (0.62, 0.62), (0.78, 0.22), (1, 0.2)),
    "lower": ((0, 0.75), (0.22, 0.73), (0.38, 0.35), (0.5, 0.2), (0.62, 0.35), (0.78, 0.73), (1, 0.75)),
    "smooth": ((0, 0.45), (0.1, 0.8), (0.22, 0.25), (0.36, 0.6), (0.55, 0.5), (0.75, 0.44), (1, 0.42)),
    "flatten": ((0, 0.25), (0.16, 0.3), (0.26, 0.55), (0.74, 0.55), (0.84, 0.3), (1, 0.25)),
    "ramp": ((0, 0.2), (0.22, 0.2), (0.78, 0.78), (1, 0.78)),
    "rocks": ((0, 0.15), (0.1, 0.15), (0.14, 0.5), (0.3, 0.72), (0.48, 0.6), (0.56, 0.15), (0.66, 0.15), (0.7, 0.34),
              (0.82, 0.42), (0.92, 0.15), (1, 0.15)),
    "driftwood": ((0, 0.2), (0.08, 0.2), (0.1, 0.44), (0.36, 0.42), (0.44, 0.78), (0.52, 0.74), (0.5, 0.41),
                  (0.9, 0.36), (0.92, 0.2), (1, 0.2)),
    "tufts": ((0, 0.15), (0.3, 0.15), (0.06, 0.62), (0.38, 0.3), (0.32, 0.95), (0.47, 0.32), (0.6, 0.98), (0.58, 0.3),
              (0.94, 0.66), (0.68, 0.15), (1, 0.15)),
    "weather": ((0, 0.2), (0.04, 0.2), (0.05, 0.42), (0.14, 0.55), (0.24, 0.52), (0.3, 0.78), (0.46, 0.95),
                (0.62, 0.84), (0.7, 0.6), (0.84, 0.62), (0.95, 0.44), (0.96, 0.2), (1, 0.2)),
    "paint": ((0, 0.15), (0.06, 0.15), (0.12, 0.36), (0.28, 0.5), (0.8, 0.98), (0.94, 0.84), (0.46, 0.36), (0.34, 0.15),
              (1, 0.15)),
    "flow": ((0, 0.3), (0.2, 0.55), (0.42, 0.6), (0.66, 0.5), (0.62, 0.86), (1, 0.44), (0.6, 0.1), (0.63, 0.3),
             (0.42, 0.4), (0.2, 0.36)),
    "water": ((0, 0.85), (0.14, 0.8), (0.2, 0.52), (0.8, 0.52), (0.86, 0.8), (1, 0.85), (0.84, 0.42), (0.62, 0.2),
              (0.38, 0.2), (0.16, 0.42)),
}  # fmt: skip


def draw(editor: Editor) -> None:
    """The bar; as many columns as fit."""
    columns = max(int((imgui.get_content_region_avail().x + 4) // (TILE_PX + 4)), 1)
    for number, name in enumerate(BRUSHES):
        if number % columns:
            imgui.same_line(0, 4)
        _tile(editor, name)
    if len(BRUSHES) % columns:
        imgui.same_line(0, 4)
    _select(editor)


def _select(editor: Editor) -> None:
    """A tile that is no brush: objects."""
    row, session = TOOLS[SELECT], editor.session
    corner = imgui.get_cursor_screen_pos()
    width = min(imgui.get_content_region_avail().x, TILE_PX)
    chosen = session.tool not in (BRUSH, FRONT)
    if chosen:
        imgui.push_style_color(imgui.Col_.button, theme.colour(theme.ACCENT_DEEP))
    if imgui.button("###select_tool", imgui.ImVec2(width, TILE_PX)):
        pick_tool(session, BRUSH if chosen else SELECT)
    if chosen:
        imgui.pop_style_color()
    param_widgets.tooltip(f"Objects   key {row.keys[0]}\n{row.doc}")
    ink, draw_list = theme.INK if chosen else theme.INK_FAINT, imgui.get_window_draw_list()
    for text, down in ((theme.icon(row.glyph), TILE_PX * 0.28), ("Objects", TILE_PX - imgui.get_font_size() - 4)):
        size = imgui.calc_text_size(text)
        draw_list.add_text(imgui.ImVec2(corner.x + (width - size.x) / 2, corner.y + down), theme.packed(ink), text)
    draw_list.add_text(imgui.ImVec2(corner.x + 5, corner.y + 3), theme.packed(theme.INK, 0.35), row.keys[0])


def _tile(editor: Editor, name: str) -> None:
    session, brush = editor.session, BRUSHES[name]
    chosen = session.brush == name and session.tool == BRUSH
    corner = imgui.get_cursor_screen_pos()
    width = min(imgui.get_content_region_avail().x, TILE_PX)
    if chosen:
        imgui.push_style_color(imgui.Col_.button, theme.colour(theme.ACCENT_DEEP))
    if imgui.button(f"###{name}", imgui.ImVec2(width, TILE_PX)):
        editor.attempt(session.pick_brush, name)
    if chosen:
        imgui.pop_style_color()
    key = f"   key {brush.key}" if brush.key else ""
    param_widgets.tooltip(f"{brush.label}{key}\n{brush.doc}\nShift smooths with any brush.")
    _profile(name, corner, width, theme.INK if chosen else theme.INK_FAINT)
    draw_list = imgui.get_window_draw_list()
    size = imgui.calc_text_size(brush.label)
    under = imgui.ImVec2(corner.x + (width - size.x) / 2, corner.y + TILE_PX - size.y - 4)
    draw_list.add_text(under, theme.packed(theme.INK if chosen else theme.INK_FAINT), brush.label)
    draw_list.add_text(imgui.ImVec2(corner.x + 5, corner.y + 3), theme.packed(theme.INK, 0.35), brush.key)


def _profile(name: str, corner, width: float, ink: tuple) -> None:
    draw_list = imgui.get_window_draw_list()
    left, top, wide, high = corner.x + 13, corner.y + 9, width - 26, TILE_PX - 36
    points = PROFILES.get(name)
    if points is None:
        draw_list.add_circle(imgui.ImVec2(left + wide / 2, top + high / 2), high / 2, theme.packed(ink), 0, 1.6)
        return
    line = [imgui.ImVec2(left + x * wide, top + (1 - y) * high) for x, y in points]
    floor = [imgui.ImVec2(line[-1].x, top + high), imgui.ImVec2(line[0].x, top + high)]
    draw_list.add_concave_poly_filled(line + floor, theme.packed(theme.ACCENT, 0.30))
    draw_list.add_polyline(line, theme.packed(ink), 1.8, 0)


def draw_parameters(editor: Editor) -> None:
    """A widget for every parameter of the brush in hand; for another tool what it does."""
    session = editor.session
    if session.tool != BRUSH:
        _told(TOOLS[session.tool].title, TOOLS[session.tool].doc)
        if session.tool == "prop":
            _meshes(editor)
        if session.tool == FRONT:
            param_widgets.draw_all(
                describe(type(session.front)),
                lambda name: getattr(session.front, name),
                lambda name, value, merge: editor.attempt(session.set_front, name, value),
                lambda: None,
            )
        return
    brush, params = BRUSHES[session.brush], session.params[session.brush]
    _told(brush.label, brush.doc)
    # a target that its own switch turns off keeps its line, for the switch
    switches = [name for name in type(params).model_fields if name.startswith(param_widgets.PAINT)]
    idle = brush.effect.idle(params.model_copy(update=dict.fromkeys(switches, True)))
    param_widgets.draw_all(
        [row for row in describe(type(params)) if row.name not in idle | brush_limits.hidden(params)],
        lambda name: getattr(params, name),
        lambda name, value, merge: editor.attempt(session.set_param, name, value),
        lambda: None,
    )
    brush_limits.draw(editor, session.params[session.brush])


def _told(title: str, doc: str) -> None:
    with theme.bold():
        imgui.text_unformatted(title)
    imgui.push_style_color(imgui.Col_.text, theme.colour(theme.INK_FAINT))
    imgui.text_wrapped(doc)
    imgui.pop_style_color()
    imgui.spacing()


def _meshes(editor: Editor) -> None:
    """Which mesh the next prop shows."""
    session = editor.session
    for name in session.level.meshes:
        if imgui.radio_button(f"{name}###mesh_{name}", name == (session.mesh or next(reversed(session.level.meshes)))):
            session.mesh = name
    if imgui.button(theme.titled("folder_open", "From a file…", "mesh_file")):
        session.ask("prop")
