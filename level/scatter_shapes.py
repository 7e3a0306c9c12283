"""Shapes that the meshes of scattered things are made of (L09): ball, tube, blade, and how parts become one mesh.

A part is a tuple of vertices `(n, 3)`, normals `(n, 3)`, sway `(n,)` and indices `(m, 3)`.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Mesh:
    """`vertices`, `normals` float32 `(n, 3)`, `sway` `(n,)` 0 at the root … 1 at the tip, `indices` int32 `(m, 3)`."""

    vertices: np.ndarray
    normals: np.ndarray
    sway: np.ndarray
    indices: np.ndarray

    @property
    def radius(self) -> float:
        """Of the sphere round the foot that holds it."""
        return float(np.sqrt((self.vertices**2).sum(axis=1)).max())


def join(parts: list[tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]]) -> Mesh:
    """One mesh of (vertices, normals, sway, indices)."""
    starts = np.cumsum([0, *(len(part[0]) for part in parts[:-1])])
    columns = [np.concatenate([part[i] for part in parts]).astype(np.float32) for i in range(3)]
    indices = np.concatenate([part[3] + start for part, start in zip(parts, starts, strict=True)])
    return Mesh(*columns, indices.astype(np.int32))


def vertex_normals(vertices: np.ndarray, indices: np.ndarray) -> np.ndarray:
    """Unit normals `(n, 3)`, those of the faces weighed by their area."""
    a, b, c = (vertices[indices[:, i]] for i in range(3))
    face = np.cross(b - a, c - a)
    normals = np.zeros_like(vertices)
    for corner in range(3):
        np.add.at(normals, indices[:, corner], face)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)


@functools.cache
def icosphere(level: int) -> tuple[np.ndarray, np.ndarray]:
    """Unit sphere: vertices `(n, 3)` and triangles `(20 · 4^level, 3)`."""
    g = (1 + 5**0.5) / 2
    v = np.array([(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g),
                  (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)], float)  # fmt: skip
    f = np.array([(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
                  (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5),
                  (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)])  # fmt: skip
    for _ in range(level):
        edges = np.sort(f[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        unique, where = np.unique(edges, axis=0, return_inverse=True)
        middle = where.reshape(-1, 3) + len(v)
        v = np.concatenate([v, v[unique].mean(axis=1)])
        f = np.concatenate([np.stack(t, 1) for t in (
            (f[:, 0], middle[:, 0], middle[:, 2]), (f[:, 1], middle[:, 1], middle[:, 0]),
            (f[:, 2], middle[:, 2], middle[:, 1]), (middle[:, 0], middle[:, 1], middle[:, 2]))])  # fmt: skip
    return v / np.linalg.norm(v, axis=1, keepdims=True), f


def tube(spine: np.ndarray, radius: np.ndarray, sides: int, lobes: np.ndarray) -> tuple:
    """A closed tube round a line `(n, 3)`: `radius` `(n,)` metres, `lobes` `(n, sides)` factors on it."""
    tangent = np.gradient(spine, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    aside = np.cross(np.array([0.13, 0.21, 1.0]), tangent)
    aside /= np.linalg.norm(aside, axis=1, keepdims=True)
    over = np.cross(tangent, aside)
    angle = np.arange(sides) * 2 * np.pi / sides
    rings = spine[:, None] + (radius[:, None] * lobes)[..., None] * (
        aside[:, None] * np.cos(angle)[:, None] + over[:, None] * np.sin(angle)[:, None])  # fmt: skip
    vertices = np.concatenate([rings.reshape(-1, 3), spine[[0, -1]] + tangent[[0, -1]] * (radius[[0, -1], None] *
                               np.array([[-0.3], [0.3]]))])  # fmt: skip
    n = len(spine)
    ring, side = np.meshgrid(np.arange(n - 1), np.arange(sides), indexing="ij")
    a, b = ring * sides + side, ring * sides + (side + 1) % sides
    walls = np.concatenate([np.stack([a, b, b + sides], -1), np.stack([a, b + sides, a + sides], -1)]).reshape(-1, 3)
    s = np.arange(sides)
    first = np.stack([np.full(sides, n * sides), (s + 1) % sides, s], 1)
    last = np.stack([np.full(sides, n * sides + 1), (n - 1) * sides + s, (n - 1) * sides + (s + 1) % sides], 1)
    indices = np.concatenate([walls, first, last])
    return vertices, vertex_normals(vertices, indices), np.zeros(len(vertices)), indices


def blade(root, azimuth: float, lean: float, droop: float, length: float, width: float, steps: int) -> tuple:
    """A bent strip that ends in a tip; normals look up and out. Its length along the curve is nearly `length`."""
    t = np.linspace(0, 1, steps + 1)
    out = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    # leaning on from the root, the tip hangs over
    angle = lean + droop * t * t
    step = length / steps * np.stack([np.sin(angle), np.cos(angle)], 1)[:-1]
    along = np.concatenate([[[0.0, 0.0]], np.cumsum(step, axis=0)])
    spine = np.asarray(root) + along[:, :1] * out + along[:, 1:] * (0.0, 0.0, 1.0)
    aside = np.array([-out[1], out[0], 0.0])
    half = (0.5 * width * (1 - t[:-1] ** 2.2))[:, None]
    left, right = spine[:-1] - half * aside, spine[:-1] + half * aside
    vertices = np.concatenate([np.stack([left, right], 1).reshape(-1, 3), spine[-1:]])
    normal = np.sin(angle)[:, None] * (0.0, 0.0, 1.0) + np.cos(angle)[:, None] * out * 0.6 + np.array([0, 0, 0.35])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    row = np.arange(steps - 1)[:, None] * 2
    quads = np.concatenate([row + np.array([0, 1, 3]), row + np.array([0, 3, 2])])
    indices = np.concatenate([quads, [[2 * steps - 2, 2 * steps - 1, 2 * steps]]])
    return vertices, np.concatenate([np.repeat(normal[:-1], 2, 0), normal[-1:]]), np.append(np.repeat(t[:-1], 2), 1), \
        indices.astype(int)  # fmt: skip
