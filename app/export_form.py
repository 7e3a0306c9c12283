"""The form for exports: a target, a folder; it runs beside the window on a copy of the level, shown by a bar."""

from __future__ import annotations

from pathlib import Path

from imgui_bundle import imgui

from . import theme
from .background import Background, export_work
from .editor import Editor
from .file_forms import WIDE, Form, PathField
from .param_widgets import tooltip


class ExportForm(Form):
    title, confirm = "Export", "Export"

    def __init__(self, editor: Editor) -> None:
        from ..io import EXPORTERS

        super().__init__(editor)
        self.targets = list(EXPORTERS.values())
        self.target = 0
        self.resample = False
        self.only = ""
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
        imgui.set_next_item_width(WIDE - 60)
        _, self.only = imgui.input_text_with_hint("Maps###export_maps", "all, or names by comma", self.only)
        tooltip(", ".join(name for name, _ in self.targets[self.target].maps))
        self.field.draw("folder")

    def _choose(self, number: int) -> None:
        before = self.targets[self.target].name
        if self.field.text.endswith(f"_{before}"):
            self.field.text = self.field.text[: -len(before)] + self.targets[number].name
        self.target = number

    def run(self) -> None:
        target = self.targets[self.target]
        resample = self.resample and bool(target.sizes)
        names = [name.strip() for name in self.only.split(",") if name.strip()]
        target.choose(names or None)  # refuses a name at once
        level, folder = self.editor.session.level, self.field.path
        self.background = Background(level, export_work, target.name, folder, self.stem, names or None, resample)

    def finish(self, result: list[Path] | None) -> None:
        where = self.field.path
        self.editor.messages.tell(
            f"Exported {len(result)} files to {where}" if result else "Export cancelled; what was there is as it was"
        )
