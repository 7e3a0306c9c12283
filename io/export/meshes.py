"""The ground as a mesh (GLB) and every written layer as a VTK image (`.vti` through pyvista).

glTF is right-handed, y up, metres: position = (x east, height, -y north), so north is -Z and the south-west sample
stands at x = z = 0. trimesh reads back what mesh_glb wrote, as a reader that isn't ours.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...level import BadInput, Level
from .mesh_glb import AXES, EAST, Part, tangents_for, write_parts

TRIANGLE_BUDGET = 1_000_000  # 36 MB of GLB; a 4097² level has 33 million triangles and would take 1.2 GB
SAND = (0.66, 0.6, 0.48)


@dataclass(frozen=True)
class TerrainMesh:
    """A regular mesh on every `stride`-th sample: `rows_at` and `cols_at` are the samples its vertices stand on.

    positions and normals float32 `(vertices, 3)` in glTF axes, uv float32 `(vertices, 2)` with v up, faces int64
    `(triangles, 3)` counter-clockwise from above.
    """

    positions: np.ndarray
    normals: np.ndarray
    uv: np.ndarray
    faces: np.ndarray
    rows_at: np.ndarray
    cols_at: np.ndarray
    stride: int


def stride_for(rows: int, cols: int, budget: int = TRIANGLE_BUDGET) -> int:
    """The smallest stride whose mesh has at most `budget` triangles."""
    stride = max(int(math.sqrt(2 * (rows - 1) * (cols - 1) / budget)), 1)
    while 2 * (len(_lines(rows, stride)) - 1) * (len(_lines(cols, stride)) - 1) > budget:
        stride += 1
    return stride


def _lines(count: int, stride: int) -> np.ndarray:
    """0, stride, 2 stride … and the last sample, so that the mesh always reaches the level's edge."""
    return np.append(np.arange(0, count - 1, stride), count - 1)


def terrain_mesh(height: np.ndarray, cell_m: float, budget: int = TRIANGLE_BUDGET) -> TerrainMesh:
    """The mesh of `height` `(rows, cols)` metres, row 0 south, within `budget` triangles."""
    stride = stride_for(*height.shape, budget)
    rows_at, cols_at = _lines(height.shape[0], stride), _lines(height.shape[1], stride)
    ground = np.asarray(height[np.ix_(rows_at, cols_at)], np.float64)
    north, east = rows_at * cell_m, cols_at * cell_m
    positions = np.stack([_across(east, ground), ground, -_down(north, ground)], axis=-1)
    slope_north, slope_east = np.gradient(ground, north, east)
    normals = np.stack([-slope_east, np.ones_like(ground), slope_north], axis=-1)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    uv = np.stack([_across(east / east[-1], ground), _down(north / north[-1], ground)], axis=-1)
    faces = quads(len(rows_at), len(cols_at))
    as_rows = [part.reshape(-1, part.shape[-1]).astype(np.float32) for part in (positions, normals, uv)]
    return TerrainMesh(*as_rows, faces, rows_at, cols_at, stride)


def _across(values: np.ndarray, like: np.ndarray) -> np.ndarray:
    return np.broadcast_to(values[None, :], like.shape)


def _down(values: np.ndarray, like: np.ndarray) -> np.ndarray:
    return np.broadcast_to(values[:, None], like.shape)


def quads(rows: int, cols: int) -> np.ndarray:
    """Two triangles a cell, split from its south-west to its north-east corner."""
    south_west = (np.arange(rows - 1)[:, None] * cols + np.arange(cols - 1)).ravel()
    south_east, north_west, north_east = south_west + 1, south_west + cols, south_west + cols + 1
    lower = np.stack([south_west, south_east, north_east], axis=-1)
    upper = np.stack([south_west, north_east, north_west], axis=-1)
    return np.stack([lower, upper], axis=1).reshape(-1, 3)


def surface_error_m(height: np.ndarray, mesh: TerrainMesh) -> float:
    """The largest vertical distance from a sample of the level to the triangles of the mesh."""
    return 0.0 if mesh.stride == 1 else lattice_error_m(height, mesh.rows_at, mesh.cols_at)


def lattice_error_m(height: np.ndarray, rows_at: np.ndarray, cols_at: np.ndarray) -> float:
    """The same of triangles over those rows and columns of the level, as `quads` cuts them."""
    ground = height[np.ix_(rows_at, cols_at)].astype(np.float64)
    col, u = _cell(cols_at, height.shape[1])
    row, v = _cell(rows_at, height.shape[0])
    worst = 0.0
    for at in range(height.shape[0]):
        south, north = ground[row[at]], ground[row[at] + 1]
        a, b, c, d = south[col], south[col + 1], north[col], north[col + 1]
        below_diagonal = u >= v[at]
        on = np.where(below_diagonal, a + u * (b - a) + v[at] * (d - b), a + v[at] * (c - a) + u * (d - c))
        worst = max(worst, float(np.abs(on - height[at]).max()))
    return worst


def _cell(lines: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Which mesh cell each of `count` samples lies in, and how far along."""
    at = np.arange(count)
    cell = np.clip(np.searchsorted(lines, at, side="right") - 1, 0, len(lines) - 2)
    return cell, (at - lines[cell]) / (lines[cell + 1] - lines[cell])


def write_glb(path: Path, mesh: TerrainMesh, name: str) -> None:
    """One mesh with normals, tangents to the east, UVs from the north-west corner and a plain sand material."""
    normals = mesh.normals @ AXES
    uv = mesh.uv * (1, -1) + (0, 1)
    part = Part(name, mesh.positions @ AXES, normals, tangents_for(normals, EAST), uv, None, mesh.faces)
    write_parts(path, [part], "ground", SAND)


def read_glb(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(positions, normals, faces) of the one mesh in a GLB; BadInput where trimesh would pass over damage silently."""
    import trimesh

    try:
        scene = trimesh.load(path, process=False, file_type="glb", force="scene")
        meshes = list(scene.geometry.values())
    except Exception as error:  # trimesh raises whatever its parsers raise
        raise BadInput(f"{path.name} cannot be read as GLB: {' '.join(str(error).split())[:160]}") from None
    if len(meshes) != 1 or not len(meshes[0].faces):
        raise BadInput(f"{path.name} holds {len(meshes)} meshes instead of one with faces")
    positions, faces = np.asarray(meshes[0].vertices), np.asarray(meshes[0].faces)
    if faces.min() < 0 or faces.max() >= len(positions):
        raise BadInput(f"{path.name} has faces that name vertices it hasn't got")
    if "vertex_normals" not in meshes[0]._cache.cache:
        raise BadInput(f"{path.name} carries no normals")
    return positions, np.asarray(meshes[0].vertex_normals), faces


# VTK image


def write_vti(path: Path, level: Level) -> None:
    """The level's samples as an ImageData, x east, y north, metres: `height` and every other written layer.

    Flow gets a third, vertical component of 0, which streamlines in ParaView and pyvista need.
    """
    import pyvista

    grid = level.grid
    image = pyvista.ImageData(dimensions=(grid.cols, grid.rows, 1), spacing=(grid.cell_m, grid.cell_m, 1.0))
    image.point_data["height"] = level.height.ravel()
    for name in vti_layers(level):
        values = level.layers[name].array
        values = values.reshape(grid.rows * grid.cols, -1)
        if name == "flow":
            values = np.column_stack([values, np.zeros(len(values), np.float32)])
        image.point_data[name] = values[:, 0] if values.shape[1] == 1 else values
    image.point_data.active_scalars_name = "height"
    image.field_data["sea_level_m"] = np.array([level.sea_level_m])
    image.save(path)


def vti_layers(level: Level) -> list[str]:
    """The written layers beside height that share the level's grid; the weather map has its own."""
    return [
        name
        for name, data in level.layers.items()
        if name != "height" and not data.neutral and data.row.grid == "level"
    ]


def read_vti(path: Path):
    """The ImageData in a `.vti`; BadInput when there is none with a height."""
    import pyvista

    try:
        image = pyvista.read(path)
    except Exception as error:
        raise BadInput(f"{path.name} cannot be read as a VTK image: {' '.join(str(error).split())[:160]}") from None
    if not isinstance(image, pyvista.ImageData) or "height" not in image.point_data:
        raise BadInput(f"{path.name} holds no VTK image with a height")
    return image
