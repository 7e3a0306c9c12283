"""The command palette: type a few letters of any action or view, Enter does it."""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import imgui
from imgui_bundle import imgui_command_palette as commands

from ..renderer import VIEWS
from . import keys, theme
from .actions import ACTIONS
from .editor import Editor

NAME = "###palette"


class Palette:
    """Draw it once a frame; `show` opens it."""

    def __init__(self, editor: Editor) -> None:
        self.editor = editor
        self.open = False
        self._context = None
        self._kept: list = []  # imgui-bundle holds only the callbacks, not what they belong to

    def show(self) -> None:
        if self._context is None:
            self._fill()
        self.open = True
        commands.remove_cache(NAME)
        commands.set_next_command_palette_search_box_focused()

    def draw(self) -> None:
        if not self.open:
            return
        width = imgui.get_main_viewport().size.x
        imgui.set_next_window_size(imgui.ImVec2(min(520, width * 0.8), 0))
        commands.set_next_window_affixed_top(imgui.Cond_.always)
        self.open = commands.command_palette_window(NAME, True)
        if imgui.is_key_pressed(imgui.Key.escape):
            self.open = False

    def _fill(self) -> None:
        self._context = commands.ContextWrapper()
        commands.set_style_color(commands.ImCmdTextType.highlight, theme.packed(theme.WARM))
        for action in ACTIONS.values():
            if action.id != "palette":
                shortcut = f"   ({keys.shown(action)})" if action.keys else ""
                self._add(f"{action.title}{shortcut}", lambda action=action: self.editor.do(action))
        for view in VIEWS.values():
            self._add(f"View: {view.label}", lambda name=view.name: self._view(name))

    def _view(self, name: str) -> None:
        self.editor.session.view = name

    def _add(self, name: str, run: Callable[[], None]) -> None:
        command = commands.Command()
        command.name = name
        command.initial_callback = run
        commands.add_command(command)
        self._kept.append(command)
