"""The form that writes crest times to a file (T06)."""

from __future__ import annotations

from pathlib import Path

from imgui_bundle import imgui

from . import theme, time_edits
from .editor import Editor
from .file_forms import Form, PathField

FIELD_PX = 120


class EventForm(Form):
    title, confirm = "Export crest times", "Export"

    def __init__(self, editor: Editor) -> None:
        super().__init__(editor)
        held, clock = editor.session.path, editor.session.clock
        folder = held.parent if held else Path.cwd()
        self.field = PathField("save", "Crest times", str(folder / "events.json"))
        loop_s = editor.session.level.settings.time.loop_s
        self.first_s, self.last_s = clock.loop or (0.0, loop_s or 60.0)

    def draw(self) -> None:
        imgui.text_colored(theme.colour(theme.INK_FAINT), "When crests come to each probe, and how high they stand.")
        self.field.draw("events.json", focus=True)
        imgui.set_next_item_width(FIELD_PX)
        _, self.first_s = imgui.input_float("From", self.first_s, 0, 0, "%.2f s")
        imgui.set_next_item_width(FIELD_PX)
        _, self.last_s = imgui.input_float("To", self.last_s, 0, 0, "%.2f s")

    def run(self) -> None:
        count = time_edits.export_events(self.editor.session, self.field.path, self.first_s, self.last_s)
        self.editor.messages.tell(f"Wrote {count} crests to {self.field.path.name}")
