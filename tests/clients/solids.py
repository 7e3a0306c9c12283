"""Meshes of an export as a client read them, beside what the level says they are: both a row a corner of a triangle."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from shorewright.io.export.mesh_rows import MESHES
from shorewright.io.export.meshes import terrain_mesh
from shorewright.level import Level

TERRAIN = "mesh"  # the ground in one piece, that isn't a row of MESHES


@dataclass(frozen=True)
class Axes:
    """How a client's world lies: the level's east, north and up are its axes `order`, times `sign`.

    `v_up`: it turns v round, so that pictures begin at the bottom.
    """

    order: tuple[int, int, int]
    sign: tuple[int, int, int]
    v_up: bool = False

    def turned(self, values: np.ndarray) -> np.ndarray:
        """Vectors `(n, 3)` of the client in the level's axes."""
        return values[:, self.order] * np.array(self.sign, np.float32)


AXES = {
    "Blender": Axes((0, 1, 2), (1, 1, 1), v_up=True),
    "three": Axes((0, 2, 1), (1, -1, 1)),
    "Babylon": Axes((0, 2, 1), (-1, -1, 1)),  # left-handed, as Unity: X is west
}


def read_solids(folder: Path, client: str) -> dict[str, dict[str, np.ndarray]]:
    """Arrays by name of each mesh that a client's script left in `folder`, in the level's axes."""
    axes, found = AXES[client], {}
    for path in sorted(folder.glob("*.f32"), key=lambda path: ("positions" not in path.name, path.name)):
        mesh, name, _ = path.name.rsplit(".", 2)
        arrays = found.setdefault(mesh, {})
        values = np.fromfile(path, "<f4")
        values = values.reshape(len(arrays["positions"]) if arrays else len(values) // 3, -1)
        if name in ("positions", "normals", "tangents"):
            values = axes.turned(values[:, :3])
        if name == "uv" and axes.v_up:
            values = values * np.float32([1, -1]) + np.float32([0, 1])
        arrays[name] = values
    return found


def true_solids(level: Level, kind: str, name: str) -> dict[str, dict[str, np.ndarray]]:
    """The same from the level itself, by the name of the node that shows it."""
    if kind == TERRAIN:
        return {name: _terrain(level)}
    found = {}
    for part in MESHES[kind].make(level)[0]:
        at = part.triangles.ravel()
        for node, matrix in part.nodes or ((part.name, np.eye(4)),):
            turn = matrix[:3, :3] / np.linalg.norm(matrix[:3, 0])
            found[node] = {
                "positions": part.positions[at] @ matrix[:3, :3].T + matrix[:3, 3],
                "normals": part.normals[at] @ turn.T,
                "tangents": part.tangents[at] @ turn.T,
                "uv": part.uv[at],
                "colours": np.clip(part.colours[at], 0, 1),
            }
    return found


def _terrain(level: Level) -> dict[str, np.ndarray]:
    mesh = terrain_mesh(level.height, level.grid.cell_m)
    at, gltf = mesh.faces.ravel(), AXES["three"]
    uv = mesh.uv * np.float32([1, -1]) + np.float32([0, 1])
    normals = gltf.turned(mesh.normals)
    tangents = np.float32([1, 0, 0]) - normals[:, :1] * normals  # east, square to the normal
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    found = {"positions": gltf.turned(mesh.positions), "normals": normals, "tangents": tangents, "uv": uv}
    return {name: values[at] for name, values in found.items()}
