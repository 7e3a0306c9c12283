"""The form for exports: a target, maps, a folder; it runs beside the window on a copy of the level, shown by a bar."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from imgui_bundle import imgui

from . import theme
from .background import Background, export_work
from .editor import Editor
from .file_forms import WIDE, Form, PathField
from .param_widgets import tooltip

LARGE = imgui.ComboFlags_.height_large


class MapChoice:
    """Which maps of a target are written: all but those that were switched off, whatever target that was for."""

    def __init__(self) -> None:
        self.left_out: set[str] = set()
        self._shown = False
        self.takes_escape = False

    def wanted(self, maps: Sequence[tuple[str, str]]) -> list[str] | None:
        """Names for `only`: None when it is all of them."""
        names = [name for name, _ in maps if name not in self.left_out]
        return None if len(names) == len(maps) else names

    def told(self, maps: Sequence[tuple[str, str]]) -> str:
        wanted = self.wanted(maps)
        return "all" if wanted is None else f"{len(wanted)} of {len(maps)}"

    def draw(self, maps: Sequence[tuple[str, str]]) -> None:
        """A field that opens a list with a box and a sentence for each map."""
        imgui.set_next_item_width(WIDE - 60)
        before, self._shown = self._shown, imgui.begin_combo("Maps###export_maps", self.told(maps), LARGE)
        self.takes_escape = before or self._shown
        if not self._shown:
            return
        if imgui.is_key_pressed(imgui.Key.escape):
            imgui.close_current_popup()
        if imgui.button("All###maps_all"):
            self.left_out.clear()
        imgui.same_line()
        if imgui.button("None###maps_none"):
            self.left_out |= {name for name, _ in maps}
        for name, doc in maps:
            changed, on = imgui.checkbox(f"{name}###map_{name}", name not in self.left_out)
            tooltip(doc)
            if changed:
                (self.left_out.discard if on else self.left_out.add)(name)
        imgui.end_combo()


class ExportForm(Form):
    title, confirm = "Export", "Export"

    def __init__(self, editor: Editor) -> None:
        from ..io import EXPORTERS

        super().__init__(editor)
        self.targets = list(EXPORTERS.values())
        self.target = 0
        self.resample = False
        self.choice = MapChoice()
        held = editor.session.path
        self.stem = held.stem if held else "level"
        folder = (held.parent if held else Path.cwd()) / f"{self.stem}_{self.targets[0].name}"
        self.field = PathField("folder", "Folder to export into", str(folder))

    def draw(self) -> None:
        for number, target in enumerate(self.targets):
            if imgui.radio_button(f"{target.label}###target_{target.name}", self.target == number):
                self._choose(number)
            imgui.push_text_wrap_pos(WIDE)
            imgui.text_colored(theme.colour(theme.INK_FAINT), target.doc)
            imgui.pop_text_wrap_pos()
        imgui.spacing()
        if self.targets[self.target].sizes:
            _, self.resample = imgui.checkbox("Resample to a size the engine takes", self.resample)
            tooltip("Else the level lies in a corner of the next larger size, sample for sample. The error is told.")
        self.choice.draw(self.targets[self.target].maps)
        self.takes_escape = self.choice.takes_escape
        self.field.draw("folder")

    def _choose(self, number: int) -> None:
        before = self.targets[self.target].name
        if self.field.text.endswith(f"_{before}"):
            self.field.text = self.field.text[: -len(before)] + self.targets[number].name
        self.target = number

    def run(self) -> None:
        target = self.targets[self.target]
        resample = self.resample and bool(target.sizes)
        names = self.choice.wanted(target.maps)
        target.choose(names)  # refuses none at all at once
        level, folder = self.editor.session.level, self.field.path
        self.background = Background(level, export_work, target.name, folder, self.stem, names, resample)

    def finish(self, result: list[Path] | None) -> None:
        where = self.field.path
        self.editor.messages.tell(
            f"Exported {len(result)} files to {where}" if result else "Export cancelled; what was there is as it was"
        )
