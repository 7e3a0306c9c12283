"""`edit`: the window."""

from __future__ import annotations

import os
import sys

from ...level.errors import BadInput
from .common import LevelPath, put_notes


def edit(level: LevelPath | None = None) -> int:
    """Open the editor on a level, or on a new beach."""
    _need_display()
    from .. import window
    from ..session import Session

    session = Session.open(level) if level is not None else Session.new()
    put_notes(session.notes)
    try:
        session.keep_log()
        return window.run(session) or 0
    finally:
        session.close()


def _need_display() -> None:
    """Refuse before anything is opened when no window could be shown."""
    from ..launch import has_display

    instead = "use `render`, `stroke` and `export` without one"
    if not has_display():
        raise BadInput(f"there is no display to open a window on; set DISPLAY, or {instead}")
    if not _display_answers():
        raise BadInput(f"the display {os.environ['DISPLAY']} does not answer; set another DISPLAY, or {instead}")


def _display_answers() -> bool:
    """Whether the X server in DISPLAY lets us in; True where that cannot be asked."""
    if not sys.platform.startswith("linux") or os.environ.get("WAYLAND_DISPLAY"):
        return True
    import ctypes

    try:
        x11 = ctypes.CDLL("libX11.so.6")
    except OSError:
        return True
    x11.XOpenDisplay.restype, x11.XOpenDisplay.argtypes = ctypes.c_void_p, [ctypes.c_char_p]
    x11.XCloseDisplay.argtypes = [ctypes.c_void_p]
    display = x11.XOpenDisplay(None)
    if not display:
        return False
    x11.XCloseDisplay(display)
    return True
