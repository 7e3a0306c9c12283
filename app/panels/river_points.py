"""The points of a river in the panel of objects: which one is in hand, its width, level and speed; snap and carve."""

from __future__ import annotations

from imgui_bundle import imgui

from ...level.objects import River
from ...level.params import describe
from ...level.river_edit import FIELDS, RiverPoint, set_point
from .. import param_widgets, theme
from ..actions import ACTIONS
from ..editor import Editor

BUTTONS = (("river.snap", "down_long", "Snap to ground"), ("river.carve", "mountain", "Carve the bed"))


def draw(editor: Editor, river: River) -> None:
    """Buttons, a row to choose a point from, and that point's numbers."""
    session = editor.session
    for name, glyph, text in BUTTONS:
        if imgui.button(theme.titled(glyph, text, name)):
            editor.do(ACTIONS[name])
        param_widgets.tooltip(f"{ACTIONS[name].title}.")
        imgui.same_line()
    imgui.new_line()
    for n in range(len(river.points)):
        if n and imgui.get_content_region_avail().x > 40:
            imgui.same_line()
        chosen = n == session.river_point
        if chosen:
            imgui.push_style_color(imgui.Col_.button, theme.colour(theme.ACCENT_DEEP))
        if imgui.button(f" {n + 1} ###river_point_{n}"):
            session.river_point = -1 if chosen else n
        if chosen:
            imgui.pop_style_color()
        param_widgets.tooltip(f"Point {n + 1} of {len(river.points)}; Delete takes the one in hand out.")
    if 0 <= session.river_point < len(river.points):
        _point(editor, river, session.river_point)
    else:
        imgui.text_colored(theme.colour(theme.INK_FAINT), "Take a point: here, or its handle in the picture.")


def _point(editor: Editor, river: River, n: int) -> None:
    point = dict(zip(FIELDS, river.points[n], strict=True))

    def change(name: str, value: float, merge: bool) -> None:
        editor.attempt(editor.session.alter, river.id, {"points": set_point(river, n, **{name: value})}, merge)

    param_widgets.draw_all(list(describe(RiverPoint)), point.__getitem__, change, editor.session.seal)
