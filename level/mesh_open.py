"""How much of the sky over each vertex of a mesh the mesh itself leaves open (L03, D12): a hull is darker inside.

Points strewn over its surface are slid along each of some directions onto a grid that keeps the farthest; a vertex that
lies well behind what its cell keeps is hidden from there. Weighed by the cosine, as light of an even sky is.
"""

from __future__ import annotations

import numpy as np

from .meshes import Mesh

WAYS, CELLS, POINTS = 40, 96, 80_000
AHEAD, BEHIND = 1.5, 1.0  # cells by which a vertex is moved out along its normal, and has to lie behind
DARKEST = 0.12


def open_sky(mesh: Mesh) -> np.ndarray:
    """Share of the hemisphere about each vertex' normal that is open, float32 `(n,)`, 1 for what hides nothing."""
    low, high = mesh.box
    middle, cell_m = (low + high) / 2, max(float(np.linalg.norm(high - low)), 1e-6) / CELLS
    points = (strewn(mesh) - middle) / cell_m
    normals = mesh.normals.astype(np.float64)
    places = (mesh.vertices - middle) / cell_m + AHEAD * normals
    seen, whole = np.zeros(len(places)), np.zeros(len(places))
    for way in sphere(WAYS):
        weight = np.maximum(normals @ way, 0.0)
        side = np.cross(way, (0.0, 0.0, 1.0) if abs(way[2]) < 0.9 else (1.0, 0.0, 0.0))
        side /= np.linalg.norm(side)
        axes = np.column_stack([side, np.cross(way, side), way])
        farthest = np.full((CELLS + 4, CELLS + 4), -np.inf)
        at = points @ axes
        np.maximum.at(farthest, tuple(_cells(at)), at[:, 2])
        at = places @ axes
        hidden = farthest[tuple(_cells(at))] > at[:, 2] + BEHIND
        seen += weight * ~hidden
        whole += weight
    return np.maximum(seen / np.maximum(whole, 1e-9), DARKEST).astype(np.float32)


def _cells(at: np.ndarray) -> np.ndarray:
    """Rows and columns `(2, n)` of places in cells round the middle."""
    return np.clip((at[:, :2] + CELLS / 2 + 2).astype(np.int64).T, 0, CELLS + 3)


def strewn(mesh: Mesh) -> np.ndarray:
    """Points `(POINTS, 3)` evenly over the surface, the same each time."""
    a, b, c = (mesh.vertices[mesh.triangles[:, i]].astype(np.float64) for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    share = (np.arange(POINTS) + 0.5) / POINTS
    which = np.minimum(np.searchsorted(np.cumsum(area) / area.sum(), share), len(area) - 1)
    # two additive sequences of irrational steps fill each triangle evenly (Roberts 2018, R2)
    u, v = (np.arange(POINTS) * step % 1.0 for step in (0.7548776662466927, 0.5698402909980532))
    over = u + v > 1
    u, v = np.where(over, 1 - u, u)[:, None], np.where(over, 1 - v, v)[:, None]
    return a[which] + u * (b - a)[which] + v * (c - a)[which]


def sphere(count: int) -> np.ndarray:
    """Unit vectors `(count, 3)` spread evenly: a spiral of golden angles."""
    z = 1 - (2 * np.arange(count) + 1) / count
    turn = np.arange(count) * np.pi * (3 - 5**0.5)
    flat = np.sqrt(1 - z * z)
    return np.column_stack([flat * np.cos(turn), flat * np.sin(turn), z])
