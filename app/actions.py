"""ACTIONS: every command of the editor declared once; menus, shortcuts, palette and tests read these rows.

`keys` are text such as `Ctrl+Shift+Z`, as printed on a US keyboard; `run` works on a `Session`, window or not.
What needs a person's answer (which file?) leaves a request with `Session.ask`, and the window answers.
"""

from __future__ import annotations

from . import brush_actions, session_actions, world_actions
from .action import Action

ROWS = (
    session_actions.file_rows,
    session_actions.time_rows,
    session_actions.view_rows,
    world_actions.air_rows,
    world_actions.place_rows,
    world_actions.object_rows,
    session_actions.finding_rows,
    brush_actions.brush_rows,
)
ACTIONS: dict[str, Action] = {row.id: row for rows in ROWS for row in rows()}


def by_key(keys: str) -> Action | None:
    """The row a shortcut stands for."""
    return next((row for row in ACTIONS.values() if keys in row.keys), None)
