"""MESHES: what a level has that a game takes as a mesh, one row each, as MAPS is for pictures (T09, H03)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...level import Level
from .mesh_glb import EAST, Part, smooth_normals, tangents_for

UP = np.array([0.0, 0.0, 1.0])
ACROSS_V = "v 0 at the farthest row at sea, 1 at the last on land"


@dataclass(frozen=True)
class MeshRow:
    """One GLB: `make(level)` its parts and how far they are off what they stand for, m; no parts, no file.

    `uv` and `masks` (R, G, B, A of COLOR_0) say what they mean; `colour` is linear, of its plain material.
    """

    name: str
    doc: str
    uv: str
    masks: tuple[str, str, str, str]
    make: Callable[[Level], tuple[list[Part], float]]
    colour: tuple[float, float, float] = (0.4, 0.33, 0.22)


def _beach(level: Level) -> tuple[list[Part], float]:
    """`water` and `sand` over one another, the sand's distance from the ground taken at every sample of that."""
    from ...level.beach_fit import misses
    from ...level.beach_mesh import beach_mesh

    made = beach_mesh(level)
    if made is None:
        return [], 0.0
    way = np.pad(made.tangent, ((0, 0), (0, 1)))
    same = np.unique(made.xy, axis=0, return_inverse=True)[1].ravel()
    parts = []
    off_m = float(misses(level, made.xy, made.triangles)[2].max(initial=0.0))
    for name, height, off in (("water", made.water_m, 0.0), ("sand", made.ground_m, off_m)):
        positions = np.column_stack([made.xy, height])
        normals = smooth_normals(positions, made.triangles, same)
        tangents = tangents_for(normals, way)
        parts.append(Part(name, positions, normals, tangents, made.uv, made.colours, made.triangles, off_m=off))
    return parts, off_m


def _rivers(level: Level) -> tuple[list[Part], float]:
    from ...level.river_mesh import ribbons

    parts, off_m = [], 0.0
    for made in ribbons(level):
        normals = smooth_normals(made.xyz, made.triangles)
        tangents = tangents_for(normals, np.pad(made.left, ((0, 0), (0, 1))))
        parts.append(Part(made.name, made.xyz, normals, tangents, made.uv, made.colours, made.triangles))
        off_m = max(off_m, made.off_m)
    return parts, off_m


def _tiles(level: Level) -> tuple[list[Part], float]:
    from .mesh_ground import terrain_tiles

    return terrain_tiles(level)


def _walkable(level: Level) -> tuple[list[Part], float]:
    from .mesh_ground import walkable_mesh

    return walkable_mesh(level)


def _props(level: Level) -> tuple[list[Part], float]:
    """A mesh of each kind, and a node of every prop that shows it, where it is at time 0."""
    from ...level.buoyancy import poses
    from ...level.meshes import mesh_of
    from ...level.objects import Prop

    kinds: dict[str, list] = {}
    props = {key: thing for key, thing in level.objects.items() if isinstance(thing, Prop)}
    for key, pose in poses(level, 0.0).items():
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = pose.axes * props[key].scale, pose.place
        kinds.setdefault(props[key].mesh, []).append((key, matrix))
    parts = []
    for name, nodes in kinds.items():
        mesh = mesh_of(level, props[nodes[0][0]])
        normals = mesh.normals.astype(float)
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-9)
        normals[np.linalg.norm(normals, axis=1) < 0.5] = UP
        colours = np.column_stack([mesh.colours, np.ones(len(mesh.colours))])
        uv = mesh.vertices[:, :2] * (1, -1)
        vertices = mesh.vertices.astype(float)
        parts.append(Part(name or "stand_in", vertices, normals, tangents_for(normals, EAST), uv, colours,
                          mesh.triangles, tuple(nodes), upward=False))  # fmt: skip
    return parts, 0.0


MESHES: dict[str, MeshRow] = {
    row.name: row
    for row in (
        MeshRow(
            "beach",
            "The strip along the waterline as water and as sand of one topology, for patches marked beach.",
            f"u metres along the shore, the sea on its left; {ACROSS_V}",
            (
                "tessellation bias: triangle area / 50 m2, at most 1; 1 on the 10 m border",
                "nearness of the waterline, 1 on it",
                "painted foam",
                "share of the sea's contact with the beach",
            ),
            _beach,
            (0.9, 0.9, 0.9),
        ),
        MeshRow(
            "rivers",
            "A ribbon along each river at its own level, falls included.",
            "u metres across from the right bank, v metres along from its first point",
            ("speed / 10 m/s", "foam by speed and fall", "0 on the banks, 1 in the middle", "1"),
            _rivers,
            (0.9, 0.9, 0.9),
        ),
        MeshRow(
            "tiles",
            "The ground in tiles of 128 quads, three levels of detail each with skirts, as nodes tile_ROW_COL_lodN.",
            "u east, v from the north edge to the south edge of the level, 0 to 1",
            ("1 on the ground, 0 at a skirt's foot", "as R", "as R", "1"),
            _tiles,
        ),
        MeshRow(
            "walkable_mesh",
            "Where a walker can be: no steeper and no deeper under the still sea than the level's limits.",
            "u east, v from the north edge to the south edge of the level, 0 to 1",
            ("depth of water / deepest that is waded", "1 - normal's part upwards", "0", "1"),
            _walkable,
            (0.1, 0.6, 0.2),
        ),
        MeshRow(
            "props",
            "Props with their meshes, placed as they are at time 0.",
            "u metres east and v metres south in the mesh's own axes, seen from above",
            ("albedo red, linear", "albedo green", "albedo blue", "1"),
            _props,
            (1.0, 1.0, 1.0),
        ),
    )
}


def told() -> tuple[tuple[str, str], ...]:
    """(name, sentence) of every row, for a target's list of what it writes."""
    return tuple((row.name, row.doc) for row in MESHES.values())
