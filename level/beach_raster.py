"""The beach mesh on samples, for a picture of it: bias and the distance from the nearest edge (H03)."""

from __future__ import annotations

import math

import numpy as np

from .beach_mesh import beach_mesh
from .level import Level

CELL_M, MOST_SIDE = 0.5, 2048


def beach_raster(level: Level) -> tuple[np.ndarray, float]:
    """float32 `(rows, cols, 4)`, row 0 south: bias, metres to the edge of its triangle, v, 1 where the mesh is; and
    metres a sample.
    """
    cell_m = max(CELL_M, max(level.grid.extent_m) / (MOST_SIDE - 1))
    cols, rows = (math.ceil(side / cell_m - 1e-6) + 1 for side in level.grid.extent_m)
    out = np.zeros((rows, cols, 4), np.float32)
    mesh = beach_mesh(level)
    if mesh is None:
        return out, cell_m
    which, row, col = _candidates(mesh.xy[mesh.triangles] / cell_m, rows, cols)
    corners = mesh.xy[mesh.triangles[which]]
    point = np.stack([col, row], -1) * cell_m
    shares, edge_m = [], np.full(len(which), np.inf)
    for k in range(3):
        a, b, c = corners[:, k], corners[:, (k + 1) % 3], corners[:, (k + 2) % 3]
        way, to, height = b - a, point - a, c - a
        over = way[:, 0] * to[:, 1] - way[:, 1] * to[:, 0]
        shares.append(over / (way[:, 0] * height[:, 1] - way[:, 1] * height[:, 0]))  # of corner c
        edge_m = np.minimum(edge_m, over / np.linalg.norm(way, axis=1))
    inside = edge_m >= -1e-6
    share = np.stack([shares[1], shares[2], shares[0]], -1)[inside]
    nodes = mesh.triangles[which[inside]]
    values = [(share * of[nodes]).sum(1) for of in (mesh.colours[:, 0], mesh.uv[:, 1])]
    made = np.stack([values[0], edge_m[inside], values[1], np.ones(len(share))], -1)
    out[row[inside], col[inside]] = made
    return out, cell_m


def _candidates(corners: np.ndarray, rows: int, cols: int) -> tuple[np.ndarray, ...]:
    """(triangle, row, column) of every sample in the boxes round triangles `(m, 3, 2)`, in samples."""
    low = np.ceil(corners.min(1) - 1e-6).astype(int)
    size = np.floor(corners.max(1) + 1e-6).astype(int) - low + 1
    count = size.prod(1)
    which = np.repeat(np.arange(len(corners)), count)
    at = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
    row, col = low[which, 1] + at // size[which, 0], low[which, 0] + at % size[which, 0]
    there = (row >= 0) & (row < rows) & (col >= 0) & (col < cols)
    return which[there], row[there], col[there]
