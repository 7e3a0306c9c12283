"""What the loop makes of each period of the sea, as a table under the settings of time (T05)."""

from __future__ import annotations

from imgui_bundle import imgui

from ...level.loop import Change, loop_changes
from .. import theme
from ..editor import Editor

MUCH_PERCENT = 10.0  # from here on a period looks another
_kept: dict = {"key": None, "rows": []}


def rows_of(editor: Editor) -> list[Change]:
    """Changes of the level in hand, worked out once for a state of it."""
    level = editor.session.level
    key = id(level), level.revision
    if _kept["key"] != key:
        _kept.update(key=key, rows=loop_changes(level))
    return _kept["rows"]


def draw(editor: Editor) -> None:
    if editor.session.level.settings.time.loop_s <= 0:
        return
    imgui.text_colored(theme.colour(theme.INK_FAINT), "What the loop makes of the sea's periods")
    if not imgui.begin_table("###loop_table", 3, imgui.TableFlags_.sizing_stretch_prop | imgui.TableFlags_.row_bg):
        return
    for row in rows_of(editor):
        imgui.table_next_row()
        imgui.table_next_column()
        imgui.text_unformatted(row.name)
        imgui.table_next_column()
        imgui.text_unformatted(f"{row.old_s:.2f} to {row.new_s:.2f} s" if row.new_s else "stands still")
        imgui.table_next_column()
        ink = theme.WARM if abs(row.percent) >= MUCH_PERCENT or not row.new_s else theme.INK_FAINT
        imgui.text_colored(theme.colour(ink), f"{row.percent:+.1f} %" if row.new_s else "")
    imgui.end_table()
