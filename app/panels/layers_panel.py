"""LAYERS: what is painted where, what it keeps in memory, and a button that shows it; below, the memory table."""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import imgui

from ...level import LAYERS
from ...level.tiles import Tiles
from .. import theme
from ..editor import Editor
from ..param_widgets import tooltip
from .history_panel import bytes_text


@dataclass(frozen=True)
class Memory:
    """Bytes a layer holds: CPU tiles, GPU texture, undo."""

    cpu: int
    gpu: int
    undo: int


def memory(editor: Editor, gpu: dict[str, int]) -> dict[str, Memory]:
    """Bytes by layer, for all of LAYERS."""
    undo = dict.fromkeys(LAYERS, 0)
    journal = editor.session.journal
    for step in [*journal.done, *journal.undone]:
        for atom in step.atoms:
            if isinstance(atom, Tiles):
                undo[atom.layer] += atom.bytes
    level = editor.session.level
    cpu = {name: data.bytes + (level.layers["height"].base.nbytes if name == "height" else 0)
           for name, data in level.layers.items()}  # fmt: skip
    return {name: Memory(cpu[name], gpu.get(name, 0), undo[name]) for name in LAYERS}


def draw(editor: Editor, gpu: dict[str, int]) -> None:
    """`gpu` is bytes of texture by layer name, `generated` ones, and `other` for everything else the renderer holds."""
    held = memory(editor, gpu)
    flags = imgui.TableFlags_.row_bg | imgui.TableFlags_.pad_outer_x | imgui.TableFlags_.borders_inner_h
    if imgui.begin_table("###layers", 5, flags):
        imgui.table_setup_column("Layer", imgui.TableColumnFlags_.width_stretch)
        for title in ("Tiles", "CPU", "GPU", "Undo"):
            imgui.table_setup_column(title, imgui.TableColumnFlags_.width_fixed)
        imgui.table_headers_row()
        for name in LAYERS:
            _row(editor, name, held[name])
        _total(editor, held, gpu.get("generated", 0), gpu.get("other", 0))
        imgui.end_table()


def _row(editor: Editor, name: str, held: Memory) -> None:
    session, row = editor.session, LAYERS[name]
    data = session.level.layers[name]
    view = f"layer_{name}"
    seen = session.view == view
    imgui.table_next_row()
    imgui.table_next_column()
    ink = theme.INK_FAINT if data.neutral else theme.INK
    imgui.push_style_color(imgui.Col_.text, theme.colour(theme.ACCENT_BRIGHT if seen else ink))
    eye = f"{theme.icon('eye')}  " if seen else ""
    if imgui.selectable(f"{eye}{row.label}###{view}", seen)[0]:
        session.view = "final" if seen else view
    imgui.pop_style_color()
    tooltip(f"{row.doc}\nChannels: {', '.join(row.channels)}{f' in {row.unit}' if row.unit else ''}.\n"
            "Click shows the layer, again the picture.")  # fmt: skip
    for text in (str(int(data.written.sum()) or "–"), *(_bytes(v) for v in (held.cpu, held.gpu, held.undo))):
        imgui.table_next_column()
        imgui.text_colored(theme.colour(theme.INK_FAINT), text)


def _total(editor: Editor, held: dict[str, Memory], generated: int, other_gpu: int) -> None:
    cpu, undo = sum(m.cpu for m in held.values()), editor.session.journal.bytes
    gpu = sum(m.gpu for m in held.values()) + generated + other_gpu
    for label, texts in (
        ("Generated textures", ("", "", _bytes(generated), "")),
        ("Targets, maps", ("", "", _bytes(other_gpu), "")),
        ("All", ("", _bytes(cpu), _bytes(gpu), _bytes(undo))),
    ):
        imgui.table_next_row()
        imgui.table_next_column()
        imgui.text_unformatted(label)
        for text in texts:
            imgui.table_next_column()
            imgui.text_unformatted(text)


def _bytes(count: int) -> str:
    return bytes_text(count) if count else "–"
