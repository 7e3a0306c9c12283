"""The operating system's own file dialogs, where there are any; everywhere else people type the path."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

LINUX_TOOLS = ("zenity", "kdialog", "matedialog", "qarma")


def available() -> bool:
    """Whether a native dialog can be shown here."""
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY")) and any(shutil.which(tool) for tool in LINUX_TOOLS)


class NativeAsk:
    """A native dialog that is open; `poll` it every frame. `kind` is folder, open or save."""

    def __init__(self, kind: str, title: str, start: str = "") -> None:
        from imgui_bundle import portable_file_dialogs as native

        start = start or str(Path.cwd())
        if kind == "folder":
            self._dialog = native.select_folder(title, start)
        elif kind == "save":
            self._dialog = native.save_file(title, start)
        else:
            self._dialog = native.open_file(title, start)

    def poll(self) -> str | None:
        """None while it is open, then the path, empty when the person thought better of it."""
        if not self._dialog.ready(0):
            return None
        result = self._dialog.result()
        return (result[0] if result else "") if isinstance(result, list) else result
