"""Meshes in a level's folder: `meshes/NAME.ply`, binary PLY of one fixed form, so that any program can open them.

Opening a level reads nothing else of them: what has another form is told and left out, the level opens all the same.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from ..level import BadInput, Level
from ..level.meshes import MOST_M, MOST_TRIANGLES, NAME, Mesh, decode_srgb, names_in_use

FOLDER = "meshes"
_HEAD = (
    "ply\nformat binary_little_endian 1.0\ncomment Shorewright: metres, z up, sRGB\nelement vertex {}\n"
    "property float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face {}\n"
    "property list uchar int vertex_indices\nend_header\n"
)
_HEAD_FORM = re.compile(re.escape(_HEAD).replace(r"\{\}", r"(\d{1,8})").encode())
_VERTEX = np.dtype([("place", "<f4", 3), ("normal", "<f4", 3), ("colour", "u1", 3)])
_FACE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])


def file_of(name: str) -> str:
    """The file of a mesh, from the level's folder."""
    return f"{FOLDER}/{name}.ply"


def packed(mesh: Mesh) -> bytes:
    """The bytes of a mesh's file."""
    vertices, faces = np.empty(len(mesh.vertices), _VERTEX), np.empty(len(mesh.triangles), _FACE)
    vertices["place"], vertices["normal"], vertices["colour"] = mesh.vertices, mesh.normals, mesh.bytes8
    faces["count"], faces["corners"] = 3, mesh.triangles
    return _HEAD.format(len(vertices), len(faces)).encode() + vertices.tobytes() + faces.tobytes()


def unpacked(data: bytes) -> Mesh:
    """The mesh in the bytes of a file; BadInput, the end of a sentence, when there is none."""
    head = _HEAD_FORM.match(data)
    if head is None:
        raise BadInput("is no mesh that Shorewright wrote")
    count, faces = int(head[1]), int(head[2])
    if not (0 < count <= 3 * MOST_TRIANGLES and 0 < faces <= MOST_TRIANGLES):
        raise BadInput("holds no mesh of a size that a prop may have")
    if len(data) != head.end() + count * _VERTEX.itemsize + faces * _FACE.itemsize:
        raise BadInput("was cut short or has something added")
    rows = np.frombuffer(data, _VERTEX, count, head.end())
    corners = np.frombuffer(data, _FACE, faces, head.end() + rows.nbytes)
    sound = np.isfinite(rows["place"]).all() and np.isfinite(rows["normal"]).all()
    if not sound or np.abs(rows["place"]).max() > MOST_M:
        raise BadInput("holds places that are no finite numbers, or far too large")
    triangles = np.ascontiguousarray(corners["corners"])
    if triangles.min() < 0 or triangles.max() >= count or (corners["count"] != 3).any():
        raise BadInput("has triangles between vertices that it does not have")
    colours = decode_srgb(rows["colour"] / 255.0).astype(np.float32)
    return Mesh(*(np.ascontiguousarray(rows[name]) for name in ("place", "normal")), colours, triangles)


def read_meshes(level: Level, paths: dict[str, Path], notes: list[str]) -> None:
    """Give a level the meshes in some files; what is missing or damaged is noted, and a box will stand in its place."""
    for name, path in sorted(paths.items()):
        try:
            mesh = unpacked(path.read_bytes())
            if not name.endswith(mesh.digest()[:8]):
                notes.append(f"{path} was changed since it was saved; used as it is")
            level.meshes[name] = mesh
        except FileNotFoundError:
            notes.append(f"{path} is missing, so a box stands in its place: bring the mesh in again")
        except (OSError, BadInput) as error:
            told = getattr(error, "strerror", None) or error
            notes.append(f"{path} cannot be used ({told}), so a box stands in its place: bring the mesh in again")


def wanted(level: Level) -> list[str]:
    """Names of meshes that belong in the level's folder."""
    return sorted(name for name in names_in_use(level) if NAME.fullmatch(name))
