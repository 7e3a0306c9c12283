"""The dialog that makes a shot of an image (Z20)."""

from __future__ import annotations

from imgui_bundle import imgui

from . import theme
from .editor import Editor
from .file_forms import Form, PathField


class ShotForm(Form):
    title, confirm = "Shot from a weather map", "Make it"

    def __init__(self, editor: Editor) -> None:
        super().__init__(editor)
        self.field = PathField("open", "Weather map")

    def draw(self) -> None:
        faint = theme.colour(theme.INK_FAINT)
        imgui.text_colored(faint, "Red coverage, green precipitation, blue type; north on top. It starts now.")
        self.field.draw("sky.png, .exr or .tif", focus=True)

    def run(self) -> None:
        session = self.editor.session
        session.selected = session.shot_add(source=self.field.path)
