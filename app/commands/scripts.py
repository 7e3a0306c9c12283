"""`stroke`: replay a script on a level; the same engine and the same bytes as the window."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from .common import LevelPath, progress, put, put_notes


def stroke(level: LevelPath, script: Annotated[Path, Parameter(help="Actions as JSON.")]) -> int:
    """Replay a script of strokes and settings on a level.

    Saves when all of it is done, changes nothing when any of it fails.
    """
    from ..script import load
    from ..session import Session

    todo = load(script)
    with Session.open(level) as session:
        put_notes(session.notes)
        with progress("Sculpting") as tell:
            count = session.run(todo, str(script), tell)
        session.save()
        steps = len(session.journal.done)
    put(f"{count} action{'s' if count != 1 else ''} done, {steps} step{'s' if steps != 1 else ''} saved in {level}")
    return 0
