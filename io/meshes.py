"""Meshes from other programs (D12): GLB, glTF, OBJ, PLY and STL, read with trimesh, turned z up, coloured by vertex.

glTF and, unless told otherwise, OBJ have y up and look along +z: x, y, z becomes −x, z, y, so that what looked forward
looks north, where a prop's heading starts. PLY and STL are taken as they are, z up.
"""

from __future__ import annotations

import json
import logging
import re
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal
from urllib.parse import unquote

import numpy as np

from ..level import BadInput
from ..level.meshes import GREY, MOST_TRIANGLES, Mesh, content_name, decode_srgb, made_of

FORMATS = {".glb": "y", ".gltf": "y", ".obj": "y", ".ply": "z", ".stl": "z"}
MAX_BYTES = 512 << 20
TEXELS = 256  # a texture is averaged to so many a side before vertices take their colour from it
Y_UP = np.array([(-1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 1.0, 0.0)])


@dataclass
class Imported:
    """A mesh from a file, the name a level gives it, and what is worth telling."""

    name: str
    mesh: Mesh
    notes: list[str] = field(default_factory=list)


def import_mesh(path: Path | str, up: Literal["y", "z"] | None = None, scale: float = 1.0) -> Imported:
    """The mesh in a file, all its parts in their places as one; `up` says which axis is, else the format does.

    `scale` is metres a unit of the file. BadInput in a sentence when the file holds no mesh that can be drawn.
    """
    path = Path(path)
    kind = path.suffix.lower()
    if kind not in FORMATS:
        raise BadInput(f"{path} is no mesh that can be read: give {', '.join(FORMATS)}")
    up = up or FORMATS[kind]
    notes = _missing(path, kind)
    scene = _loaded(path)
    parts = [part for node in scene.graph.nodes_geometry if (part := _part(scene, node, kind, path))]
    if not parts:
        raise BadInput(f"{path} holds no triangles")
    if sum(len(part[0]) for part in parts) > MOST_TRIANGLES:
        total = sum(len(part[0]) for part in parts)
        raise BadInput(f"{path} has {total} triangles, a prop takes {MOST_TRIANGLES} at most: simplify it first")
    corners, colours = (np.concatenate([part[i] for part in parts]) for i in (0, 1))
    with np.errstate(invalid="ignore", over="ignore"):
        corners = (corners @ Y_UP.T if up == "y" else corners) * scale
    try:
        mesh = made_of(corners, colours)
    except BadInput as error:
        raise BadInput(f"{path} {error}") from None
    return Imported(content_name(path.stem, mesh), mesh, notes)


def _loaded(path: Path):
    """The scene in a file; whatever trimesh makes of a bad one becomes one sentence."""
    try:
        size = path.stat().st_size
        if size > MAX_BYTES:
            raise BadInput(f"{path} is larger than {MAX_BYTES >> 20} MB: simplify it first")
        if not path.is_file():
            raise BadInput(f"{path} is no file")
    except FileNotFoundError:
        raise BadInput(f"{path} does not exist") from None
    except OSError as error:
        raise BadInput(f"{path} cannot be read: {error.strerror or error}") from None
    import trimesh

    log = logging.getLogger("trimesh")
    level = log.level
    log.setLevel(logging.CRITICAL)
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            return trimesh.load_scene(path, process=False)
    except MemoryError:
        raise
    except Exception as error:  # trimesh raises whatever its parsers meet
        told = " ".join(str(error).split())[:120]
        raise BadInput(
            f"{path} is damaged or no {path.suffix[1:].upper()} file ({told or type(error).__name__})"
        ) from None
    finally:
        log.setLevel(level)


def _part(scene, node: str, kind: str, path: Path) -> tuple[np.ndarray, np.ndarray] | None:
    """Corners in the scene's metres and linear colours `(m, 3, 3)` of a node's triangles; None for lines and points."""
    place, name = scene.graph[node]
    geometry = scene.geometry[name]
    faces = getattr(geometry, "faces", None)
    if faces is None or not len(faces):
        return None
    faces, vertices = np.asarray(faces, np.int64), np.asarray(geometry.vertices, np.float64)
    if faces.ndim != 2 or faces.shape[1] != 3 or faces.min() < 0 or faces.max() >= len(vertices):
        raise BadInput(f"{path} has triangles between vertices that it does not have")
    if len(faces) > MOST_TRIANGLES:
        raise BadInput(f"{path} has {len(faces)} triangles, a prop takes {MOST_TRIANGLES} at most: simplify it first")
    with np.errstate(all="ignore"):
        vertices = vertices @ place[:3, :3].T + place[:3, 3]
        colours = np.broadcast_to(_colours(geometry, faces, kind), (*faces.shape, 3))
    if np.linalg.det(place[:3, :3]) < 0:  # a mirror turns triangles over
        faces, colours = faces[:, ::-1], colours[:, ::-1]
    return vertices[faces], colours


def _colours(geometry, faces: np.ndarray, kind: str) -> np.ndarray:
    """Linear colours that broadcast to `(m, 3, 3)`: texture times material, else of vertices or faces, else grey."""
    visual = geometry.visual
    if visual.kind == "texture":
        base = _base(visual.material)
        image = getattr(visual.material, "baseColorTexture", None) or getattr(visual.material, "image", None)
        if image is not None and visual.uv is not None and len(visual.uv) == len(geometry.vertices):
            return (base * _sampled(image, np.asarray(visual.uv, np.float64)))[faces]
        return base
    if visual.kind == "vertex":
        values = np.asarray(visual.vertex_colors)[:, :3] / 255.0
        return (values if kind in (".glb", ".gltf") else decode_srgb(values))[faces]  # glTF's are linear
    if visual.kind == "face":
        return decode_srgb(np.asarray(visual.face_colors)[:, None, :3] / 255.0)
    return np.full(3, GREY)


def _base(material) -> np.ndarray:
    """Linear colour of a material `(3,)`: glTF's factor is linear, an OBJ's diffuse colour a display colour."""
    if hasattr(material, "baseColorFactor"):
        factor = material.baseColorFactor
        return np.ones(3) if factor is None else np.asarray(factor)[:3] / (255.0 if np.max(factor) > 1 else 1.0)
    diffuse = getattr(material, "diffuse", None)
    if getattr(material, "image", None) is not None:
        return np.ones(3)
    return np.full(3, GREY) if diffuse is None else decode_srgb(np.asarray(diffuse)[:3] / 255.0)


def _sampled(image, uv: np.ndarray) -> np.ndarray:
    """Linear colours `(n, 3)` of a texture at texture places, v upward, repeated beyond 0 … 1."""
    image = image.convert("RGB")
    step = max(1, -(-max(image.size) // TEXELS))
    texels = decode_srgb(np.asarray(image.reduce(step) if step > 1 else image, np.float64) / 255.0)
    rows, cols = texels.shape[:2]
    u, v = np.nan_to_num(uv, posinf=0, neginf=0).T % 1.0
    return texels[np.minimum(((1 - v) * rows).astype(int), rows - 1), np.minimum((u * cols).astype(int), cols - 1)]


def _missing(path: Path, kind: str) -> list[str]:
    """Notes on materials and textures that a file names and that are not there; the mesh does without."""
    try:
        if kind == ".obj":
            files = _of_obj(path)
        elif kind == ".gltf":
            raw = json.loads(path.read_bytes())
            uris = [image.get("uri", "") for image in raw.get("images", [])]
            files = [uri if uri.startswith("data:") else unquote(uri) for uri in uris]
        else:
            return []
        # only a name or a path below the file's folder is looked for
        gone = [name for name in files if name and not name.startswith("data:") and not (path.parent / name).is_file()]
    except (OSError, ValueError, AttributeError, TypeError):
        return []
    return [
        f"{path.name} names {name}, which is not there; those parts have plain colours" for name in dict.fromkeys(gone)
    ]


def _of_obj(path: Path) -> list[str]:
    """Material files of an OBJ, and the textures that they name."""
    found = re.findall(r"^mtllib[ \t]+(.+?)[ \t]*$", path.read_text("utf-8", "replace"), re.MULTILINE)
    images = []
    for name in found:
        if (path.parent / name).is_file():
            text = (path.parent / name).read_text("utf-8", "replace")
            images += re.findall(r"^[ \t]*map_Kd[ \t]+(?:.*[ \t])?(\S+)[ \t]*$", text, re.MULTILINE)
    return [*found, *images]
