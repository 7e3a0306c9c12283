"""Meshes from files and the props that show them, as edits (D12; part of the session)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..level import Level
from ..level.meshes import STAND_IN
from ..level.pick import ground_at
from . import words
from .weather_edits import WeatherMaps


class Props(WeatherMaps):
    """Taking in meshes, placing props."""

    def import_mesh(self, path: Path | str, up: str | None = None, scale: float = 1.0) -> str:
        """Take in a mesh from a file (`io.import_mesh` says how); returns the name by which props show it (D12)."""
        from ..io import import_mesh

        word = words.Mesh(path=str(path), up=up, scale=scale)
        found = import_mesh(path, up, scale)
        self.level.put_mesh(found.name, found.mesh)
        self._recorded(word)
        self.notes += found.notes
        return found.name

    def place_prop(self, mesh: str, x: float, y: float, **fields) -> str:
        """Place a prop that shows a mesh of the level, on the ground unless `fields` say more; returns its id."""
        thing = prop_at(self.level, mesh, x, y, fields)
        self.place(thing)
        return thing["id"]


def prop_at(level: Level, mesh: str, x: float, y: float, fields: dict[str, Any]) -> dict[str, Any]:
    """A prop as plain data: on the ground by its lowest point, with a free id, unless `fields` say otherwise."""
    scale, low = fields.get("scale", 1.0), float(level.meshes.get(mesh, STAND_IN).box[0, 2])
    number = 1
    while f"prop-{number}" in level.objects:
        number += 1
    where = {"x": round(x, 3), "y": round(y, 3), "z": round(float(ground_at(level, x, y)) - scale * low, 3)}
    return {"kind": "prop", "id": f"prop-{number}", "mesh": mesh, **where, **fields}
