"""Files of MESHES against their records: counts, extents, unit normals and tangents, indices, range of the UVs."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ...level import BadInput
from .mesh_glb import ReadPart, read_parts
from .mesh_places import NORTH, PLACES, SEA
from .mesh_rows import MESHES
from .records import FileRecord, Manifest, MeshPart

SLACK = 2e-5  # of a unit vector in float32


def check_meshes(manifest: Manifest, whole: dict[str, Path]) -> list[str]:
    """Findings about all files of a manifest that are meshes of MESHES."""
    return [found for record in manifest.files if record.map in MESHES for found in _check(record, whole)]


def _check(record: FileRecord, whole: dict[str, Path]) -> Iterator[str]:
    place = next((row for row in PLACES.values() if row.formula == record.decode.formula), None)
    if place is None or {NORTH, SEA} - record.decode.numbers.keys():
        yield f"{record.name} is to be placed by a formula that this program doesn't know"
        return
    if record.name not in whole:
        return
    try:
        parts = read_parts(whole[record.name])
    except BadInput as error:
        yield str(error)
        return
    if [part.name for part in parts] != [part.name for part in record.parts]:
        yield f"{record.name} holds other meshes than the manifest says"
        return
    if any((part.placed != place.matrix(record.decode.numbers)).any() for part in parts):
        yield f"{record.name}: its root stands elsewhere than the manifest says"
    for part, stated in zip(parts, record.parts, strict=True):
        wrong = _wrong(part, stated)
        if wrong:
            yield f"{record.name}: {part.name} {wrong}"


def _wrong(part: ReadPart, stated: MeshPart) -> str:
    """The first thing that is wrong with a mesh, "" if nothing is."""
    positions, uv = part.values["POSITION"], part.values["TEXCOORD_0"]
    counts = len(positions), len(part.triangles), part.nodes
    if counts != (stated.vertices, stated.triangles, stated.nodes):
        return f"has {counts[0]} vertices, {counts[1]} triangles, {counts[2]} nodes; the manifest says otherwise"
    if not all(len(values) == len(positions) and np.isfinite(values).all() for values in part.values.values()):
        return "has an attribute that isn't whole"
    if part.triangles.min() < 0 or part.triangles.max() >= len(positions):
        return "has faces that name vertices it hasn't got"
    for values, low, high, what in (
        (positions, stated.low, stated.high, "reaches"), (uv, stated.uv_low, stated.uv_high, "has UVs"),
    ):  # fmt: skip
        slack = 1e-6 * max(1.0, float(np.abs((low, high)).max()))
        if np.abs(values.min(0) - low).max() > slack or np.abs(values.max(0) - high).max() > slack:
            return f"{what} from {values.min(0)} to {values.max(0)}; the manifest says from {low} to {high}"
    return _wrong_frame(part, stated)


def _wrong_frame(part: ReadPart, stated: MeshPart) -> str:
    normals, tangents = part.values["NORMAL"], part.values["TANGENT"]
    if np.abs(np.linalg.norm(normals, axis=1) - 1).max() > SLACK:
        return "has normals that aren't unit vectors"
    if stated.upward and normals[:, 1].min() < 0:
        return "has normals that point down"
    if np.abs(np.linalg.norm(tangents[:, :3], axis=1) - 1).max() > SLACK or (np.abs(tangents[:, 3]) != 1).any():
        return "has tangents that aren't unit vectors with a sign"
    if np.abs((normals * tangents[:, :3]).sum(1)).max() > 1e-4:
        return "has tangents that aren't square to their normals"
    return ""
