"""FORMS: what answers each request for a dialog; here also the one that takes in a mesh."""

from __future__ import annotations

from imgui_bundle import imgui

from ..brushes.alphas import pack
from ..io.alphas import read_alpha
from . import event_form, placing, shot_forms, theme
from .editor import Editor
from .export_form import ExportForm
from .file_forms import Form, ImportForm, NewForm, OpenForm, PathField, SaveAsForm
from .weather_forms import WeatherExportForm, WeatherImportForm


class PropForm(Form):
    title, confirm = "Prop from a file", "Place it"

    def __init__(self, editor: Editor) -> None:
        super().__init__(editor)
        self.field = PathField("open", "Mesh")
        self.up = 0

    def draw(self) -> None:
        faint = theme.colour(theme.INK_FAINT)
        imgui.text_colored(faint, "The level keeps a copy; over water it floats. Clicks drop further ones.")
        self.field.draw("mesh.glb, .obj, .ply or .stl", focus=True)
        imgui.set_next_item_width(160)
        _, self.up = imgui.combo("Up in the file", self.up, ["as the format has it", "y", "z"])

    def run(self) -> None:
        session = self.editor.session
        session.mesh = session.import_mesh(self.field.path, ("", "y", "z")[self.up] or None)
        placing.put(session, "prop")
        session.tool = "prop"


class AlphaForm(Form):
    title, confirm = "Shape of the brush from a file", "Take it"

    def __init__(self, editor: Editor) -> None:
        super().__init__(editor)
        self.field = PathField("open", "Picture")

    def draw(self) -> None:
        imgui.text_colored(theme.colour(theme.INK_FAINT), "A grey picture; its white is where the brush works.")
        self.field.draw("shape.png, .exr, .tif or .jpg", focus=True)

    def run(self) -> None:
        grey = read_alpha(self.field.path)
        self.editor.session.set_param("alpha", pack(self.field.path.stem, grey))


FORMS: dict[str, type[Form]] = {
    "shot_file": shot_forms.ShotForm, "events": event_form.EventForm,
    "new": NewForm, "open": OpenForm, "save_as": SaveAsForm, "import": ImportForm, "export": ExportForm,
    "alpha": AlphaForm, "prop": PropForm, "weather_import": WeatherImportForm, "weather_export": WeatherExportForm,
}  # fmt: skip
