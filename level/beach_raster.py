"""The beach mesh on samples, for a picture of it: bias and the distance from the nearest edge (H03)."""

from __future__ import annotations

import math

import numpy as np

from .beach_mesh import beach_mesh
from .level import Level
from .triangle_samples import samples_within

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
    corners = mesh.xy[mesh.triangles]
    which, row, col, share = samples_within(corners / cell_m, (rows, cols))
    opposite = np.linalg.norm(np.roll(corners, -1, 1) - np.roll(corners, -2, 1), axis=2)
    edge_m = (share * (2 * mesh.area_m2[:, None] / opposite)[which]).min(1)
    nodes = mesh.triangles[which]
    values = [(share * of[nodes]).sum(1) for of in (mesh.colours[:, 0], mesh.uv[:, 1])]
    out[row, col] = np.stack([values[0], edge_m, values[1], np.ones(len(share))], -1)
    return out, cell_m
