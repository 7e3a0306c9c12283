"""Meshes of MESHES as GLB files, read back, so that the record's numbers are those of the bytes."""

from __future__ import annotations

from functools import partial

import numpy as np

from .earlier import Piece
from .job import Job
from .manifest import describe_file
from .mesh_glb import AXES, Part, ReadPart, read_parts, write_parts
from .mesh_places import NORTH, SEA, MeshPlace
from .mesh_rows import MESHES, MeshRow
from .records import Channel, Decode, FileRecord, MeshPart

LEVELS = "; _lod0, _lod1, _lod2 of a tile stand at the same place: show one of them, or make them a group of levels"


def write_meshes(job: Job, place: MeshPlace) -> Piece:
    """All chosen meshes that the level has anything of, as `NAME_mesh.glb`, where the target's terrain stands."""
    made = (job.piece(row.name, partial(_piece, job, row, place)) for row in MESHES.values())
    return Piece([file for piece in made for file in piece.files])


def _piece(job: Job, row: MeshRow, place: MeshPlace) -> Piece:
    parts, off_m = row.make(job.level)
    return Piece([write_mesh(job, row, parts, off_m, place)] if parts else [])


def write_mesh(job: Job, row: MeshRow, parts: list[Part], off_m: float, place: MeshPlace) -> FileRecord:
    """One GLB; `max_error` is of its bytes, how far thinning is off the ground stands in its parts."""
    path = job.folder / f"{job.name}_{row.name}.glb"
    numbers = {NORTH: job.level.grid.extent_m[1], SEA: job.level.sea_level_m}
    write_parts(path, parts, row.name, row.colour, place.matrix(numbers))
    back = read_parts(path)
    wanted = [(part.positions @ AXES.T).astype(np.float32) for part in parts]
    error_m = max(
        float(np.abs(found.values["POSITION"] - made).max()) for made, found in zip(wanted, back, strict=True)
    )
    told = [
        _part(part, found, off_m if part.off_m is None else part.off_m) for part, found in zip(parts, back, strict=True)
    ]
    return describe_file(
        path,
        map=row.name,
        doc=row.doc,
        width=0,
        height=0,
        bit_depth=32,
        sample_type="float32",
        row_0=None,
        channels=_channels(row),
        decode=Decode(formula=place.formula, numbers=numbers),
        max_error=100 * error_m,
        parts=tuple(told),
    )


def _channels(row: MeshRow) -> list[Channel]:
    return [
        Channel(name="POSITION", meaning="X east, Y up, -Z north, before the nodes' matrices", unit="m"),
        Channel(name="NORMAL", meaning="unit normal", unit=""),
        Channel(name="TANGENT", meaning="direction of growing u, square to the normal; w 1", unit=""),
        Channel(name="TEXCOORD_0", meaning=row.uv, unit=""),
        *(
            Channel(name=f"COLOR_0.{letter}", meaning=told, unit="")
            for letter, told in zip("RGBA", row.masks, strict=True)
        ),
    ]


def _part(part: Part, found: ReadPart, off_m: float) -> MeshPart:
    positions, uv = found.values["POSITION"], found.values["TEXCOORD_0"]
    return MeshPart(
        name=found.name,
        vertices=len(positions),
        triangles=len(found.triangles),
        nodes=found.nodes,
        low=tuple(positions.min(0).tolist()),
        high=tuple(positions.max(0).tolist()),
        uv_low=tuple(uv.min(0).tolist()),
        uv_high=tuple(uv.max(0).tolist()),
        upward=part.upward,
        surface_error_cm=100 * off_m,
    )


def mesh_line(record: FileRecord) -> str:
    """How to take it up, in one line."""
    triangles = sum(part.triangles for part in record.parts)
    masks = "; ".join(f"{c.name[-1]} {c.meaning}" for c in record.channels if c.name.startswith("COLOR_0"))
    uv = next(c.meaning for c in record.channels if c.name == "TEXCOORD_0")
    off_cm = max((part.surface_error_cm for part in record.parts), default=0.0)
    thinned = f", up to {off_cm:.3g} cm off what it shows" if off_cm else ""
    return (
        f"{record.name}: {len(record.parts)} meshes, {triangles} triangles{thinned}; glTF's axes (Y up, metres), "
        f"which importers turn to their engine's, its root where the terrain stands; UV {uv}; vertex colour, linear "
        f"data, not tint: {masks}{LEVELS if record.map == 'tiles' else ''}"
    )
