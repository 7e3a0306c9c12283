"""The menu bar, made from ACTIONS; besides them recent levels, panels and the page of shortcuts."""

from __future__ import annotations

from imgui_bundle import hello_imgui, imgui

from ..level.environments import environment_of
from ..level.weather_presets import weather_of
from . import keys, theme
from .action import Action
from .actions import ACTIONS
from .editor import OVERLAYS, QUALITIES, Editor
from .tools import BRUSH

ORDER = ("File", "Edit", "Brush", "Light", "Weather", "Place", "Time", "View")
INNER = {"In the middle": "Place", "Clouds to paint": "Brush"}  # menus within others
RULED = {
    "import", "weather_import", "quit", "abort", "frame", "next_view", "brush.raise", "storm", "shot", "sky.fill",
    "tool.prop", "prop_file", "object.delete", "wave.fit",
    "tenth", "marker", "events",
}  # a line above these  # fmt: skip
CAMERA_HELP = (
    ("Left", "brush; Ctrl inverts, Shift smooths, Esc gives up"),
    ("L + left", "turn and lift the sun"),
    ("P + left", "with the weather brush: take the weather there as its target"),
    ("Alt + left, or middle", "orbit about what is under the pointer"),
    ("Shift + middle, Alt + middle", "pan"),
    ("Wheel, Alt + right", "zoom to the pointer"),
    ("Right held", "look round; W A S D fly, Q E down and up, Shift faster, wheel sets the speed"),
)


def draw(editor: Editor) -> None:
    for menu in ORDER:
        if imgui.begin_menu(menu):
            _rows(editor, menu)
            for inner in (name for name, outer in INNER.items() if outer == menu):
                if imgui.begin_menu(inner):
                    _rows(editor, inner)
                    imgui.end_menu()
            if menu == "File":
                _recent(editor)
            if menu == "View":
                _view(editor)
            imgui.end_menu()
    if imgui.begin_menu("Help"):
        help_rows()
        imgui.end_menu()


def _rows(editor: Editor, menu: str) -> None:
    for action in ACTIONS.values():
        if action.menu == menu and not action.id.startswith("show."):
            if action.id in RULED:
                imgui.separator()
            _row(editor, action)


def _row(editor: Editor, action: Action) -> None:
    chosen = _chosen(editor, action.id)
    if imgui.menu_item(action.title, keys.shown(action), chosen, action.enabled(editor.session))[0]:
        editor.do(action)


def _chosen(editor: Editor, name: str) -> bool:
    """Whether what an action switches is on."""
    session = editor.session
    if name == "water" or name.startswith("show."):
        return name.removeprefix("show.") in session.show
    if name.startswith("light."):
        return name == f"light.{environment_of(session.level.settings)}"
    if name.startswith("weather."):
        return name == f"weather.{weather_of(session.level.settings)}"
    if name.startswith("tool."):
        return name == f"tool.{session.tool}"
    if name.startswith("brush."):
        return name == f"brush.{session.brush}" and session.tool == BRUSH
    return name in OVERLAYS and getattr(editor, name)


def _recent(editor: Editor) -> None:
    recent = editor.preferences.recent_levels()
    if recent and imgui.begin_menu("Recent"):
        for path in recent:
            if imgui.menu_item_simple(f"{path.name}###{path}"):
                editor.session.ask(f"open:{path}")
            if imgui.is_item_hovered():
                imgui.set_tooltip(str(path))
        imgui.end_menu()


def _view(editor: Editor) -> None:
    if imgui.begin_menu("Show"):
        for action in ACTIONS.values():
            if action.id.startswith("show."):
                _row(editor, action)
        imgui.end_menu()
    if imgui.begin_menu("Quality"):
        for quality in QUALITIES:
            if imgui.menu_item_simple(quality.capitalize(), selected=editor.quality == quality):
                editor.choose_quality(quality)
        imgui.end_menu()
    docking = hello_imgui.get_runner_params().docking_params
    if imgui.begin_menu("Panels"):
        for window in docking.dockable_windows:
            if window.include_in_view_menu:
                _, window.is_visible = imgui.menu_item(window.label.split("###")[0], "", window.is_visible)
        imgui.separator()
        if imgui.menu_item_simple("Put all back"):
            docking.layout_reset = True
        imgui.end_menu()


def help_rows() -> None:
    """Every shortcut, and what the mouse does, in two columns."""
    with theme.bold():
        imgui.text_unformatted("Mouse in the viewport")
    rows = [*CAMERA_HELP, *((" or ".join(a.keys), a.title) for a in ACTIONS.values() if a.keys)]
    if imgui.begin_table("###help", 2, imgui.TableFlags_.sizing_fixed_fit):
        for number, (left, right) in enumerate(rows):
            if number == len(CAMERA_HELP):
                imgui.table_next_row(imgui.TableRowFlags_.none, 10)
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.text_colored(theme.colour(theme.ACCENT_BRIGHT), left)
            imgui.table_next_column()
            imgui.text_unformatted(right)
        imgui.end_table()
