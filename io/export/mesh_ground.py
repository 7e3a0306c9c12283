"""Meshes of the ground: tiles with levels of detail, and where one can walk."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy import ndimage

from ...level import Level
from ...level.walk import walkable
from . import meshes
from .mesh_glb import EAST, Part, smooth_normals, tangents_for

TILE = 128  # quads a side
LODS = 3
TILE_BUDGET = 600_000  # triangles of the finest level of detail


def terrain_tiles(level: Level) -> tuple[list[Part], float]:
    """`tile_ROW_COL_lodN` of 128 quads a side, 64, 32, and how far the finest is off the ground, m.

    Neighbours share their edges' vertices at one level of detail; between two a skirt hangs down as far as they can
    differ there.
    """
    height, cell_m = level.height, level.grid.cell_m
    base = meshes.terrain_mesh(height, cell_m, TILE_BUDGET)
    ground = height[np.ix_(base.rows_at, base.cols_at)].astype(float)
    north, east = base.rows_at * cell_m, base.cols_at * cell_m
    slopes = np.gradient(ground, north, east)
    normals = np.stack([-slopes[1], -slopes[0], np.ones_like(ground)], -1)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    size = 2 * 2 ** (LODS - 1) + 1
    skirt_m = float((ndimage.maximum_filter(ground, size) - ndimage.minimum_filter(ground, size)).max()) + 0.1
    parts, off_m = [], [_lod_error_m(height, base, 2**lod) for lod in range(LODS)]
    for row in range(0, len(north) - 1, TILE):
        for col in range(0, len(east) - 1, TILE):
            for lod in range(LODS):
                lines = [_lines(at, count, 2**lod) for at, count in ((row, len(north)), (col, len(east)))]
                name = f"tile_{row // TILE}_{col // TILE}_lod{lod}"
                tile = _tile(name, lines, (north, east, ground, normals), skirt_m)
                parts.append(replace(tile, off_m=off_m[lod]))
    return parts, off_m[0]


def _lod_error_m(height: np.ndarray, base: meshes.TerrainMesh, stride: int) -> float:
    """How far the ground over all tiles of one level of detail is off."""
    if base.stride * stride == 1:
        return 0.0
    rows, cols = (
        at[np.unique(np.concatenate([_lines(first, len(at), stride) for first in range(0, len(at) - 1, TILE)]))]
        for at in (base.rows_at, base.cols_at)
    )
    return meshes.lattice_error_m(height, rows, cols)


def _lines(first: int, count: int, stride: int) -> np.ndarray:
    last = min(first + TILE, count - 1)
    return np.append(np.arange(first, last, stride), last)


def _tile(name: str, lines: list[np.ndarray], of: tuple, skirt_m: float) -> Part:
    north, east, ground, normals = of
    rows, cols = lines
    at = np.ix_(rows, cols)
    x, y = np.meshgrid(east[cols], north[rows])
    top = np.stack([x, y, ground[at]], -1).reshape(-1, 3)
    shape = len(rows), len(cols)
    ring = _ring(*shape)
    positions = np.concatenate([top, top[ring] - (0, 0, skirt_m)])
    of_top = normals[at].reshape(-1, 3)
    normal = np.concatenate([of_top, of_top[ring]])
    uv = np.stack([x / east[-1], 1 - y / north[-1]], -1).reshape(-1, 2)
    here, below = ring, len(top) + np.arange(len(ring))
    on, below_on = np.roll(here, -1), np.roll(below, -1)
    walls = np.concatenate([np.stack([below, below_on, on], -1), np.stack([below, on, here], -1)])
    triangles = np.concatenate([meshes.quads(*shape), walls])
    colours = np.concatenate([np.ones(len(top)), np.zeros(len(ring))])[:, None] * (1, 1, 1, 0) + (0, 0, 0, 1)
    uv = np.concatenate([uv, uv[ring]])
    return Part(name, positions, normal, tangents_for(normal, EAST), uv, colours, triangles)


def _ring(rows: int, cols: int) -> np.ndarray:
    """Vertices round a grid, anticlockwise from above from the south-west on."""
    number = np.arange(rows * cols).reshape(rows, cols)
    return np.concatenate([number[0, :-1], number[:-1, -1], number[-1, :0:-1], number[:0:-1, 0]])


def walkable_mesh(level: Level) -> tuple[list[Part], float]:
    """Quads of the ground all of whose samples a walker can reach, thinned as the terrain is; and how far it is off."""
    base = meshes.terrain_mesh(level.height, level.grid.cell_m, TILE_BUDGET)
    free = walkable(level)
    strips = np.logical_and.reduceat(free, base.rows_at[:-1], 0) & free[base.rows_at[1:]]
    inside = np.logical_and.reduceat(strips, base.cols_at[:-1], 1) & strips[:, base.cols_at[1:]]
    triangles = base.faces[np.repeat(inside.ravel(), 2)]
    if not len(triangles):
        return [], 0.0
    used, triangles = np.unique(triangles, return_inverse=True)
    glb = base.positions[used].astype(float)
    positions = np.stack([glb[:, 0], -glb[:, 2], glb[:, 1]], -1)
    triangles = triangles.reshape(-1, 3)
    normals = smooth_normals(positions, triangles)
    depth = np.clip((level.sea_level_m - positions[:, 2]) / max(level.settings.walk.depth_m, 1e-6), 0, 1)
    colours = np.stack([depth, 1 - normals[:, 2], 0 * depth, 0 * depth + 1], -1)
    uv = base.uv[used] * (1, -1) + (0, 1)
    part = Part("walkable", positions, normals, tangents_for(normals, EAST), uv, colours, triangles)
    return [part], meshes.surface_error_m(level.height, base)
