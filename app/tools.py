"""TOOLS: what the left button does in the viewport, one row each: brush, fronts, select and move, drop an object."""

from __future__ import annotations

from dataclasses import dataclass

from ..level import BadInput
from .placing import PLACEABLES
from .session import Session

BRUSH, SELECT, FRONT, LAKE = "brush", "select", "front", "lake"


@dataclass(frozen=True)
class Tool:
    name: str
    title: str
    glyph: str
    doc: str
    keys: tuple[str, ...] = ()


TOOLS: dict[str, Tool] = {
    row.name: row
    for row in (
        Tool(BRUSH, "Brush", "paintbrush", "Strokes of the brush in hand.", ("B",)),
        Tool(SELECT, "Select", "arrow_pointer",
             "Click selects an object, drag moves it; Ctrl+drag turns, Shift+drag raises it.", ("V",)),
        Tool(FRONT, "Shape front", "wave_square",
             "Drag a crest where it shall stand at this moment; the bed follows. Shift draws that part anew.", ("C",)),
        Tool(LAKE, "Fill with water", "fill_drip",
             "Click fills the hollow there almost to its brim; Ctrl+click drains it."),
        *(
            Tool(row.name, row.title, row.glyph, f"Click drops one, drag goes on to move it. {row.doc}")
            for row in PLACEABLES.values() if row.clicks
        ),
    )
}  # fmt: skip


def pick_tool(session: Session, name: str) -> None:
    """Take a tool; BadInput when there is none of that name."""
    if name not in TOOLS:
        raise BadInput(f"no tool is called {name!r}; there are: {', '.join(TOOLS)}")
    if name == "prop" and not session.level.meshes:
        session.ask("prop")
    session.tool = name
    if name not in (SELECT, BRUSH, FRONT, LAKE):
        session.selected = ""


def put_away(session: Session) -> None:
    """Let go: first of the object, then of the tool."""
    if session.selected and session.tool in (SELECT, BRUSH):
        session.selected = ""
    else:
        session.tool = BRUSH
