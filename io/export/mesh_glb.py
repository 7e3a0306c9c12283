"""GLB of named meshes with normals, tangents, one set of UVs and vertex colours: written and read to the bit.

trimesh's writer knows no TANGENT and turns v round, so this is our own (glTF 2.0: 4-byte alignment, little-endian,
least and most of POSITION stated). Colours are unsigned shorts: a bias of 1 is exactly 1.
"""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ...level import BadInput

ROOT = "level"
MAGIC, JSON_CHUNK, BIN_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942
FLOAT, U16, U32 = 5126, 5123, 5125
TYPES = {"POSITION": ("VEC3", FLOAT), "NORMAL": ("VEC3", FLOAT), "TANGENT": ("VEC4", FLOAT),
         "TEXCOORD_0": ("VEC2", FLOAT), "COLOR_0": ("VEC4", U16)}  # fmt: skip
DTYPES = {FLOAT: "<f4", U16: "<u2", U32: "<u4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
EAST, NORTH = np.array([1.0, 0, 0]), np.array([0, 1.0, 0])
AXES = np.array([(1, 0, 0), (0, 0, 1), (0, -1, 0)], float)  # world x east, y north, z up to glTF's x, y up, z south


@dataclass(frozen=True)
class Part:
    """A named mesh in world axes (metres, z up): `positions`, unit `normals`, `tangents` float `(n, 3)`, `uv` `(n, 2)`,
    `colours` `(n, 4)` 0 … 1 or None, `triangles` `(m, 3)` anticlockwise from outside.

    A bitangent is normal × tangent and points to falling v. `nodes`: (name, matrix 4 × 4 in world axes) that show it.
    `off_m`: how far it is off what it stands for, where that is not what all of its file are.
    """

    name: str
    positions: np.ndarray
    normals: np.ndarray
    tangents: np.ndarray
    uv: np.ndarray
    colours: np.ndarray | None
    triangles: np.ndarray
    nodes: tuple = ()
    upward: bool = True
    off_m: float | None = None


def tangents_for(normals: np.ndarray, way: np.ndarray) -> np.ndarray:
    """The part of `way` `(n, 3)` square to unit normals, unit length; the east's or north's where there is none."""
    found, missing = np.zeros_like(normals), np.ones(len(normals), bool)
    for one in (way, EAST, NORTH):
        normal, wanted = normals[missing], np.broadcast_to(one, normals.shape)[missing]
        across = wanted - (wanted * normal).sum(-1, keepdims=True) * normal
        length = np.linalg.norm(across, axis=-1, keepdims=True)
        found[missing] = np.where(length > 1e-3, across / np.maximum(length, 1e-12), 0)
        missing[missing] = length[:, 0] <= 1e-3
        if not missing.any():
            break
    return found


def smooth_normals(positions: np.ndarray, triangles: np.ndarray, same: np.ndarray | None = None) -> np.ndarray:
    """Unit normals `(n, 3)` by area; `same` `(n,)` numbers vertices that share one."""
    same = np.arange(len(positions)) if same is None else same
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    faces = np.cross(b - a, c - a)
    at, most = same[triangles].ravel(), same.max() + 1
    total = np.stack([np.bincount(at, np.repeat(faces[:, i], 3), most) for i in range(3)], -1)
    total[np.linalg.norm(total, axis=-1) < 1e-12] = (0, 0, 1)
    return (total / np.linalg.norm(total, axis=-1, keepdims=True))[same]


@dataclass
class _Blob:
    """The binary chunk as it grows, and what describes it."""

    data: bytearray = field(default_factory=bytearray)
    views: list = field(default_factory=list)
    accessors: list = field(default_factory=list)

    def add(self, values: np.ndarray, kind: str, component: int, target: int, **more) -> int:
        values = np.ascontiguousarray(values, DTYPES[component])
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": values.nbytes, "target": target}
        self.views.append(view)
        self.data += values.tobytes() + bytes(-values.nbytes % 4)
        about = {"bufferView": len(self.views) - 1, "componentType": component, "count": len(values), "type": kind}
        self.accessors.append(about | more)
        return len(self.accessors) - 1


def write_parts(
    path: Path, parts: list[Part], material: str, colour: tuple[float, float, float], placed: np.ndarray | None = None
) -> None:
    """All parts, each under the nodes that show it, those under one node that is `placed` (4, 4) in glTF's axes."""
    blob, meshes, nodes = _Blob(), [], []
    for part in parts:
        primitive = {"attributes": _attributes(blob, part), "material": 0, "mode": 4}
        primitive["indices"] = blob.add(part.triangles.ravel(), "SCALAR", U32, 34963)
        meshes.append({"name": part.name, "primitives": [primitive]})
        for name, matrix in part.nodes or ((part.name, None),):
            node = {"name": name, "mesh": len(meshes) - 1}
            if matrix is not None:
                node["matrix"] = _turned(np.asarray(matrix, float)).T.ravel().tolist()
            nodes.append(node)
    roots = list(range(len(nodes)))
    if placed is not None and (placed != np.eye(4)).any():
        nodes.append({"name": ROOT, "matrix": placed.T.ravel().tolist(), "children": roots})
        roots = [len(nodes) - 1]
    root = {
        "asset": {"version": "2.0", "generator": "Shorewright"},
        "scene": 0,
        "scenes": [{"nodes": roots}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": [{"name": material, "pbrMetallicRoughness": {
            "baseColorFactor": [*colour, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.9}}],
        "accessors": blob.accessors,
        "bufferViews": blob.views,
        "buffers": [{"byteLength": len(blob.data)}],
    }  # fmt: skip
    text = json.dumps(root, separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<III", MAGIC, 2, 28 + len(text) + len(blob.data))
    chunks = struct.pack("<II", len(text), JSON_CHUNK) + text + struct.pack("<II", len(blob.data), BIN_CHUNK)
    path.write_bytes(head + chunks + bytes(blob.data))


def _attributes(blob: _Blob, part: Part) -> dict[str, int]:
    positions = (part.positions @ AXES.T).astype(np.float32)
    tangents = np.concatenate([part.tangents @ AXES.T, np.ones((len(positions), 1))], -1)
    values = {"POSITION": positions, "NORMAL": part.normals @ AXES.T, "TANGENT": tangents, "TEXCOORD_0": part.uv}
    if part.colours is not None:
        values["COLOR_0"] = np.rint(np.clip(part.colours, 0, 1) * 65535)
    found = {}
    for name, array in values.items():
        kind, component = TYPES[name]
        more = {"normalized": True} if component == U16 else {}
        if name == "POSITION":
            more = {"min": positions.min(0).tolist(), "max": positions.max(0).tolist()}
        found[name] = blob.add(array, kind, component, 34962, **more)
    return found


def _turned(matrix: np.ndarray) -> np.ndarray:
    """A world's 4 × 4 in glTF's axes."""
    wide = np.eye(4)
    wide[:3, :3] = AXES
    return wide @ matrix @ wide.T


@dataclass(frozen=True)
class ReadPart:
    """What a GLB of ours holds, in glTF's axes; `values` by attribute, `triangles` `(m, 3)`, `nodes` that show it, all
    `placed` (4, 4) by their root.
    """

    name: str
    values: dict[str, np.ndarray]
    triangles: np.ndarray
    nodes: int
    placed: np.ndarray


def read_parts(path: Path) -> list[ReadPart]:
    """All meshes of a GLB that `write_parts` wrote; BadInput where it is damaged."""
    try:
        data = path.read_bytes()
        magic, version, total = struct.unpack_from("<III", data)
        size, kind = struct.unpack_from("<II", data, 12)
        if (magic, version, total, kind) != (MAGIC, 2, len(data), JSON_CHUNK):
            raise ValueError("no glTF 2.0 container of its own size")
        root = json.loads(data[20 : 20 + size])
        binary = data[28 + size :]
        shown = np.bincount([n["mesh"] for n in root["nodes"] if "mesh" in n], minlength=len(root["meshes"]))
        placed = next((n["matrix"] for n in root["nodes"] if "children" in n), np.eye(4).ravel())
        placed = np.reshape(placed, (4, 4)).T
        return [_read(root, binary, mesh, int(n), placed) for mesh, n in zip(root["meshes"], shown, strict=True)]
    except (OSError, ValueError, KeyError, IndexError, TypeError, struct.error) as error:
        raise BadInput(f"{path.name} cannot be read as GLB: {' '.join(str(error).split())[:160]}") from None


def _read(root: dict, binary: bytes, mesh: dict, nodes: int, placed: np.ndarray) -> ReadPart:
    (primitive,) = mesh["primitives"]
    values = {name: _accessor(root, binary, primitive["attributes"][name]) for name in TYPES}
    indices = _accessor(root, binary, primitive["indices"]).reshape(-1, 3)
    return ReadPart(mesh["name"], values, indices.astype(np.int64), nodes, placed)


def _accessor(root: dict, binary: bytes, number: int) -> np.ndarray:
    about = root["accessors"][number]
    width = WIDTHS[about["type"]]
    start = root["bufferViews"][about["bufferView"]]["byteOffset"]
    values = np.frombuffer(binary, DTYPES[about["componentType"]], about["count"] * width, start)
    return values.reshape(-1, width)
