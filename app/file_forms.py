"""Forms for files: new, open, save as, import, export. Each is a path to type or browse for, and what goes with it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from imgui_bundle import imgui

from ..level import BadInput, Grid
from . import native_files, theme
from .background import Background
from .editor import Editor
from .param_widgets import tooltip
from .session import Session

WIDE = 430


class PathField:
    """A path to type, and a button for the native dialog where there is one."""

    def __init__(self, kind: str, title: str, text: str = "") -> None:
        self.kind = kind
        self.title = title
        self.text = text
        self._asking: native_files.NativeAsk | None = None
        self._browse = native_files.available()

    def draw(self, hint: str, focus: bool = False) -> None:
        imgui.set_next_item_width(WIDE - (95 if self._browse else 0))
        if focus and imgui.is_window_appearing():
            imgui.set_keyboard_focus_here()
        _, self.text = imgui.input_text_with_hint(f"###{self.kind}_path", hint, self.text)
        if self._browse:
            imgui.same_line()
            if imgui.button(f"Browse…###{self.kind}_browse") and self._asking is None:
                self._asking = native_files.NativeAsk(self.kind, self.title, self.text)
        if self._asking and (found := self._asking.poll()) is not None:
            self._asking, self.text = None, found or self.text

    @property
    def path(self) -> Path:
        """What was typed; BadInput when nothing was."""
        if not self.text.strip():
            raise BadInput("type a path first")
        return Path(self.text.strip()).expanduser()


class Form:
    """A dialog: `draw` its fields, `run` what it is for (BadInput is shown in the dialog, which stays).

    Long work is left running as `background`; what comes of it goes to `finish`.
    """

    title = ""
    confirm = "OK"
    replaces = False  # another level takes the place of the one being edited
    takes_escape = False  # while a list of its own is open: the key closes that

    def __init__(self, editor: Editor) -> None:
        self.editor = editor
        self.background: Background | None = None

    def draw(self) -> None: ...

    def run(self) -> None: ...

    def finish(self, result: Any) -> None: ...


class ImportFields:
    """How to read a height map: only what a file leaves open needs an answer."""

    def __init__(self) -> None:
        self.field = PathField("open", "Height map")
        self.cell, self.rows, self.depth_down, self.array, self.range = "", 0, False, "", ""

    def draw(self) -> None:
        self.field.draw("heights.png, .exr, .tif, .npz, .r16 or a text grid", focus=True)
        imgui.set_next_item_width(120)
        _, self.cell = imgui.input_text_with_hint("Cell in metres", "from the file", self.cell)
        tooltip("Metres between samples: 1, or 2x1 for east x north.")
        imgui.set_next_item_width(120)
        _, self.rows = imgui.combo("First row", self.rows, ["as the file says", "north", "south"])
        _, self.depth_down = imgui.checkbox("The file counts depth downward", self.depth_down)
        imgui.set_next_item_width(120)
        _, self.range = imgui.input_text_with_hint("Height range", "low, high", self.range)
        tooltip("Metres that black and white mean, such as -20, 45.")
        imgui.set_next_item_width(120)
        _, self.array = imgui.input_text_with_hint("Array", "the only one", self.array)
        tooltip("Which array of an .npz, or channel of an image.")

    def flags(self) -> dict[str, Any]:
        """As `io.import_height` takes them; BadInput for a range that is none."""
        flags: dict[str, Any] = {}
        if self.cell.strip():
            flags["cell_m"] = self.cell.strip()
        if self.rows:
            flags["rows"] = ("north-first", "south-first")[self.rows - 1]
        if self.depth_down:
            flags["depth_down"] = True
        if self.array.strip():
            flags["array"] = self.array.strip()
        if self.range.strip():
            try:
                low, high = (float(part) for part in self.range.replace(",", " ").split())
            except ValueError:
                raise BadInput(f"{self.range!r} is no height range: give two numbers, such as -20, 45") from None
            flags["height_range"] = (low, high)
        return flags


class NewForm(Form):
    title, confirm, replaces = "New level", "Make it", True

    def __init__(self, editor: Editor) -> None:
        super().__init__(editor)
        self.kind, self.samples, self.cell_m, self.sea_level_m = 0, 513, 1.0, 0.0
        self.source = ImportFields()

    def draw(self) -> None:
        if imgui.radio_button("A sloping beach", self.kind == 0):
            self.kind = 0
        imgui.same_line()
        if imgui.radio_button("From a height map", self.kind == 1):
            self.kind = 1
        imgui.spacing()
        if self.kind == 0:
            imgui.set_next_item_width(120)
            _, self.samples = imgui.input_int("Samples a side", self.samples, 0)
            imgui.set_next_item_width(120)
            _, self.cell_m = imgui.input_float("Metres between samples", self.cell_m, 0, 0, "%.3g")
        else:
            self.source.draw()
        imgui.set_next_item_width(120)
        _, self.sea_level_m = imgui.input_float("Sea level in metres", self.sea_level_m, 0, 0, "%.2f")

    def run(self) -> None:
        if self.kind:
            made = Session.imported(self.source.field.path, sea_level_m=self.sea_level_m, **self.source.flags())
        else:
            made = Session.new(Grid(self.samples, self.samples, self.cell_m))
            made.level.set("level.sea_level_m", self.sea_level_m)
        self.editor.show_session(made)


class OpenForm(Form):
    title, confirm, replaces = "Open level", "Open", True

    def __init__(self, editor: Editor, path: str = "") -> None:
        super().__init__(editor)
        self.field = PathField("folder", "Level folder (name.shore)", path)

    def draw(self) -> None:
        self.field.draw("path of a level, such as cove.shore", focus=True)
        recent = self.editor.preferences.recent_levels()
        if recent:
            imgui.separator_text("Recent")
        for path in recent:
            if imgui.selectable(f"{theme.icon('folder')}  {path.name}###{path}", self.field.text == str(path),
                                imgui.SelectableFlags_.no_auto_close_popups, imgui.ImVec2(WIDE, 0))[0]:  # fmt: skip
                self.field.text = str(path)
            tooltip(str(path))

    def run(self) -> None:
        open_level(self.editor, self.field.path)


def open_level(editor: Editor, path: Path) -> None:
    """Edit another level; the one before stays when that fails."""
    held = editor.session.path
    if held and held.resolve() == path.resolve():
        raise BadInput(f"{path.name} is open already")
    editor.show_session(Session.open(path))
    editor.messages.tell(f"Opened {path.name}")


class SaveAsForm(Form):
    title, confirm = "Save level as", "Save"

    def __init__(self, editor: Editor) -> None:
        super().__init__(editor)
        held = editor.session.path
        self.field = PathField("save", "Save as", str(held) if held else str(Path.cwd() / "untitled.shore"))

    def draw(self) -> None:
        self.field.draw("name.shore", focus=True)

    def run(self) -> None:
        path = self.field.path
        path = path if path.suffix else path.with_suffix(".shore")
        self.editor.saved(self.editor.session.save(path))


class ImportForm(Form):
    title, confirm = "Import height", "Import"

    def __init__(self, editor: Editor) -> None:
        super().__init__(editor)
        self.source = ImportFields()

    def draw(self) -> None:
        faint = theme.colour(theme.INK_FAINT)
        imgui.text_colored(faint, "Puts another ground under what you sculpted; undo brings it back.")
        self.source.draw()

    def run(self) -> None:
        self.editor.session.import_height(self.source.field.path, **self.source.flags())
