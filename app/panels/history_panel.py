"""The undo steps, oldest first, with what each keeps in memory; a click goes there (T08)."""

from __future__ import annotations

from imgui_bundle import imgui

from .. import theme
from ..editor import Editor
from ..param_widgets import tooltip


def bytes_text(count: float) -> str:
    """Bytes as people read them."""
    for unit in ("B", "kB", "MB"):
        if count < 1000:
            return f"{count:.0f} {unit}" if unit == "B" or count >= 100 else f"{count:.1f} {unit}"
        count /= 1000
    return f"{count:.2f} GB"


def go_to(editor: Editor, count: int) -> None:
    """Undo or redo until `count` steps are done."""
    session = editor.session
    while len(session.journal.done) > count and session.undo():
        pass
    while len(session.journal.done) < count and session.redo():
        pass


def draw(editor: Editor) -> None:
    journal = editor.session.journal
    kept = f"{bytes_text(journal.bytes)} of {bytes_text(journal.budget_bytes)}"
    imgui.text_colored(theme.colour(theme.INK_FAINT), f"{len(journal.done)} steps, {kept}")
    tooltip("What undo keeps in memory; past the budget the oldest steps go to the disk.")
    imgui.spacing()
    flags = imgui.TableFlags_.scroll_y | imgui.TableFlags_.row_bg | imgui.TableFlags_.pad_outer_x
    if not imgui.begin_table("###history", 2, flags):
        return
    imgui.table_setup_column("step", imgui.TableColumnFlags_.width_stretch)
    imgui.table_setup_column("bytes", imgui.TableColumnFlags_.width_fixed, 70)
    done = len(journal.done)
    steps = [*journal.done, *reversed(journal.undone)]
    chosen = _row(0, "As opened", "", done == 0, False)
    for number, step in enumerate(steps, 1):
        kept = "on disk" if step.spilled else bytes_text(step.bytes)
        if _row(number, step.label, kept, number == done, number > done):
            chosen = True
            target = number
            break
    else:
        target = 0
    _follow(done)
    imgui.end_table()
    if chosen and not editor.session.stroke:
        editor.attempt(go_to, editor, target)


def _row(number: int, label: str, kept: str, here: bool, undone: bool) -> bool:
    imgui.table_next_row()
    imgui.table_next_column()
    ink = theme.INK_FAINT if undone else theme.INK
    imgui.push_style_color(imgui.Col_.text, theme.colour(ink, 0.6 if undone else 1))
    mark = theme.icon("caret_right") if here else "  "
    clicked = imgui.selectable(f"{mark}  {label}###step_{number}", here, imgui.SelectableFlags_.span_all_columns)[0]
    if here and _moved["to"] == number:
        imgui.set_scroll_here_y(0.7)
        _moved["to"] = -1
    imgui.table_next_column()
    imgui.text_colored(theme.colour(theme.INK_FAINT), kept)
    imgui.pop_style_color()
    return clicked


_moved = {"done": -1, "to": -1}


def _follow(done: int) -> None:
    """Scroll to the present step when it changed."""
    if _moved["done"] != done:
        _moved.update(done=done, to=done)
