"""Where a GLB stands in each engine: a root node brings the level's meshes to where that engine's terrain lies.

glTF is right-handed, Y up; ours has north at −Z, the level's south-west corner at the origin. Unreal and Godot, whose
terrains begin at the north-west corner, get it moved by the level's size north. Importers for Unity (glTFast and
UnityGLTF, as Babylon's left-handed scenes) negate X, so there it is turned by half a circle first and comes out with X
east, Z north. In every engine the sea lies at 0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

NORTH, SEA = "size_north_m", "sea_level_m"


@dataclass(frozen=True)
class MeshPlace:
    """`formula` tells the world of a scene's X, Y, Z; `matrix` (4, 4) is the root's, in glTF's axes."""

    name: str
    formula: str
    turned: bool = False
    moved: bool = False
    over_sea: bool = True

    def matrix(self, numbers: dict[str, float]) -> np.ndarray:
        """By the level's NORTH and SEA."""
        found = np.diag([-1.0, 1.0, -1.0, 1.0] if self.turned else [1.0] * 4)
        found[1, 3] = -numbers[SEA] if self.over_sea else 0.0
        found[2, 3] = numbers[NORTH] if self.moved else 0.0
        return found


PLACES = {
    row.name: row
    for row in (
        MeshPlace("south-west", "x_m = X, y_m = -Z, height_m = Y, after the nodes' matrices", over_sea=False),
        MeshPlace(
            "north-west",
            f"x_m = X, y_m = {NORTH} - Z, height_m = Y + {SEA}, after the nodes' matrices",
            moved=True,
        ),
        MeshPlace(
            "x-negated",
            f"x_m = -X, y_m = Z, height_m = Y + {SEA}, after the nodes' matrices; an importer that negates X gives "
            "X = x_m, Z = y_m",
            turned=True,
        ),
    )
}
