"""`stroke`: replay a script on a level; the same engine and the same bytes as the window."""

from __future__ import annotations

from pathlib import Path

from .common import progress, put, put_notes


def stroke(level: Path, script: Path) -> int:
    """Do what SCRIPT.json says (strokes, settings, objects, undo) and save, or change nothing when any of it fails."""
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
