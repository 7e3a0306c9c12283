"""What the editor told so far, newest last; the line of a failure opens to its traceback."""

from __future__ import annotations

import time

from imgui_bundle import imgui

from .. import theme
from ..editor import Editor


def draw(editor: Editor) -> None:
    if imgui.button(theme.titled("copy", "Copy", "copy_log")):
        imgui.set_clipboard_text(as_text(editor))
    imgui.same_line()
    if imgui.button("Clear"):
        editor.messages.lines.clear()
    if imgui.begin_child("###lines", imgui.ImVec2(0, 0)):
        for number, line in enumerate(list(editor.messages.lines)):
            stamp = time.strftime("%H:%M:%S", time.localtime(line.at))
            imgui.text_colored(theme.colour(theme.INK_FAINT), stamp)
            imgui.same_line()
            imgui.push_style_color(imgui.Col_.text, theme.colour(theme.WARM if line.bad else theme.INK))
            imgui.text_wrapped(line.text)
            imgui.pop_style_color()
            if line.detail and imgui.tree_node(f"where###{number}"):
                imgui.text_unformatted(line.detail)
                imgui.tree_pop()
        if imgui.get_scroll_y() >= imgui.get_scroll_max_y() - 2:
            imgui.set_scroll_here_y(1.0)
    imgui.end_child()


def as_text(editor: Editor) -> str:
    """The whole log, for a report."""
    return "\n".join(f"{line.text}\n{line.detail}".rstrip() for line in editor.messages.lines)
