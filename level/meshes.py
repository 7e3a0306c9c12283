"""What a mesh is to a level (D12): triangles in metres, z up, with a normal and a colour a vertex. Props name them.

A mesh never changes; its name ends in a hash of what it is, so that two of one name are the same.
"""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph

from .errors import BadInput
from .objects import Prop

MOST_TRIANGLES = 500_000
MOST_M = 10_000.0
CREASE_DEG = 38.0  # faces that meet at a larger angle keep an edge between them
GREY = 0.35  # linear albedo of what has no colour
NAME = re.compile(r"[A-Za-z0-9_]{1,80}")


@dataclass(frozen=True, eq=False)
class Mesh:
    """`vertices`, unit `normals`, linear `colours` float32 `(n, 3)`; `triangles` int32 `(m, 3)`."""

    vertices: np.ndarray
    normals: np.ndarray
    colours: np.ndarray
    triangles: np.ndarray

    def __post_init__(self) -> None:
        for array in (self.vertices, self.normals, self.colours, self.triangles):
            array.flags.writeable = False

    @cached_property
    def box(self) -> np.ndarray:
        """Lowest and highest x, y, z in metres, `(2, 3)`."""
        return np.stack([self.vertices.min(axis=0), self.vertices.max(axis=0)]).astype(np.float64)

    @cached_property
    def radius_m(self) -> float:
        """Of the ball round the mesh's origin that holds it."""
        return float(np.sqrt((self.vertices.astype(np.float64) ** 2).sum(axis=1).max()))

    @cached_property
    def closed(self) -> bool:
        """Whether every edge lies between two triangles, so that there is an inside."""
        place = numbered(*self.vertices.T)[self.triangles]
        edges = np.sort(place[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        return bool((np.bincount(numbered(*edges.T)) % 2 == 0).all())

    @cached_property
    def bytes8(self) -> np.ndarray:
        """Colours as sRGB bytes, uint8 `(n, 3)`: what files hold."""
        return np.rint(255 * encode_srgb(self.colours)).astype(np.uint8)

    def digest(self) -> str:
        """Hash of all that it is, in hex; normals follow from the rest, but not to the last bit everywhere."""
        parts = (self.vertices, self.bytes8, self.triangles)
        return hashlib.sha256(b"".join(np.ascontiguousarray(part).tobytes() for part in parts)).hexdigest()


def numbered(*columns: np.ndarray) -> np.ndarray:
    """A number for each row of some columns `(n,)`, from 0 on, the same for equal rows."""
    found = np.unique(columns[0], return_inverse=True)[1]
    for column in columns[1:]:
        values, where = np.unique(column, return_inverse=True)
        found = np.unique(found * len(values) + where, return_inverse=True)[1]
    return found


def decode_srgb(values: np.ndarray) -> np.ndarray:
    """sRGB 0 … 1 to linear (IEC 61966-2-1)."""
    return np.where(values <= 0.04045, values / 12.92, ((np.maximum(values, 0.04045) + 0.055) / 1.055) ** 2.4)


def encode_srgb(values: np.ndarray) -> np.ndarray:
    """Linear 0 … 1 to sRGB."""
    values = np.clip(values, 0, 1)
    return np.where(values <= 0.0031308, values * 12.92, 1.055 * np.maximum(values, 0.0031308) ** (1 / 2.4) - 0.055)


def made_of(corners: np.ndarray, colours: np.ndarray | None = None, smooth: bool = True) -> Mesh:
    """A mesh of loose triangles: corners `(m, 3, 3)` metres, linear colours `(m, 3, 3)` of each corner.

    Corners that lie together are joined, edges sharper than CREASE_DEG kept; triangles without area fall away, a closed
    mesh that is inside out is turned. BadInput when nothing is left, it is too large, or numbers are none.
    """
    corners = np.asarray(corners, np.float32).reshape(-1, 3, 3)
    if colours is None:
        colours = np.full(corners.shape, GREY)
    if len(corners) > MOST_TRIANGLES:
        raise BadInput(f"has {len(corners)} triangles, a prop takes {MOST_TRIANGLES} at most: simplify it first")
    if not (np.isfinite(corners).all() and np.isfinite(colours).all()):
        raise BadInput("has places or colours that are no finite numbers")
    if len(corners) and np.abs(corners).max() > MOST_M:
        raise BadInput(f"reaches farther than {MOST_M:g} m from its origin: scale it down")
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).astype(np.float64)
    kept = np.linalg.norm(face, axis=1) > 1e-12
    corners, colours, face = corners[kept], np.asarray(colours).reshape(-1, 3, 3)[kept], face[kept]
    if not len(corners):
        raise BadInput("has no triangle with an area")
    return _welded(corners, np.rint(255 * encode_srgb(colours)).astype(np.uint8), face, smooth)


def _welded(corners: np.ndarray, colours: np.ndarray, face: np.ndarray, smooth: bool) -> Mesh:
    points, paint = corners.reshape(-1, 3) + np.float32(0), colours.reshape(-1, 3)
    place = numbered(*points.T)
    label = np.repeat(_smooth_parts(place.reshape(-1, 3), face) if smooth else np.arange(len(face)), 3)
    # one normal for each place of a smooth part, whatever its colours
    shared = numbered(place, label)
    normals = np.zeros((shared.max() + 1, 3))
    np.add.at(normals, shared, np.repeat(face, 3, axis=0))
    _, first, where = np.unique(numbered(shared, *paint.T), return_index=True, return_inverse=True)
    normals = normals[shared[first]]
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.where(length > 1e-12, normals / np.maximum(length, 1e-12), (0.0, 0.0, 1.0))
    triangles = where.reshape(-1, 3)
    linear = decode_srgb(paint[first] / 255.0)
    mesh = Mesh(points[first], normals.astype(np.float32), linear.astype(np.float32), triangles.astype(np.int32))
    if mesh.closed and float(np.einsum("ij,ij->", corners.astype(np.float64).mean(axis=1), face)) < 0:
        return Mesh(mesh.vertices, -mesh.normals, mesh.colours, np.ascontiguousarray(mesh.triangles[:, ::-1]))
    return mesh


def _smooth_parts(place: np.ndarray, face: np.ndarray) -> np.ndarray:
    """A number for each face `(m,)`: those that meet at less than CREASE_DEG, and theirs, have the same."""
    count = len(place)
    edges = np.sort(place[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    owner = np.repeat(np.arange(count), 3)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    edges, owner = edges[order], owner[order]
    same = (edges[1:] == edges[:-1]).all(axis=1)
    a, b = owner[:-1][same], owner[1:][same]
    unit = face / np.linalg.norm(face, axis=1, keepdims=True)
    near = (unit[a] * unit[b]).sum(axis=1) > np.cos(np.radians(CREASE_DEG))
    graph = sparse.coo_matrix((np.ones(near.sum(), np.int8), (a[near], b[near])), shape=(count, count))
    return csgraph.connected_components(graph, directed=False)[1]


def content_name(stem: str, mesh: Mesh) -> str:
    """The name of a mesh in a level: the stem of its file and eight digits of its hash."""
    plain = re.sub(r"[^A-Za-z0-9]+", "_", stem).strip("_")[:40] or "mesh"
    return f"{plain}_{mesh.digest()[:8]}"


def block(size: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> Mesh:
    """A grey box of that width, length and height in metres that stands on z = 0."""
    corner = np.array([(i & 1, i >> 1 & 1, i >> 2) for i in range(8)], np.float64) - (0.5, 0.5, 0.0)
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    faces = [(a, b, c) for a, b, c, d in sides] + [(a, c, d) for a, b, c, d in sides]
    return made_of((corner * size)[np.array(faces)])


STAND_IN = block()


def mesh_of(level, prop: Prop) -> Mesh:
    """The mesh that a prop shows; a box of a metre where the level does not hold the one it names."""
    return level.meshes.get(prop.mesh, STAND_IN)


def names_in_use(level) -> set[str]:
    """Names of meshes that props of a level ask for."""
    return {thing.mesh for thing in level.objects.values() if isinstance(thing, Prop) and thing.mesh}
