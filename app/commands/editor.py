"""`edit`: the window."""

from __future__ import annotations

from ...level.errors import BadInput
from .common import LevelPath, put_notes


def edit(level: LevelPath | None = None) -> int:
    """Open the editor on a level, or on a new beach."""
    from ..launch import has_display

    if not has_display():
        raise BadInput("there is no display to open a window on; set DISPLAY, or use `render`, `stroke` and `export`")
    from .. import window
    from ..session import Session

    session = Session.open(level) if level is not None else Session.new()
    put_notes(session.notes)
    try:
        session.keep_log()
        return window.run(session) or 0
    finally:
        session.close()
