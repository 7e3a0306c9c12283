"""`place`: a mesh from a file into a level."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from ...level.errors import BadInput
from .common import LevelPath, numbers, put, put_notes


def place(
    level: LevelPath,
    mesh: Annotated[Path, Parameter(help="GLB, glTF, OBJ, PLY or STL.")],
    *,
    at: Annotated[str, Parameter(allow_leading_hyphen=True, help="X,Y in metres, or X,Y,Z.")],
    floats: Annotated[bool, Parameter(negative="", help="It floats on the waves.")] = False,
    drifts: Annotated[bool, Parameter(negative="", help="It floats and the current takes it along.")] = False,
    density: Annotated[float | None, Parameter(help="Share of its height under water.")] = None,
    yaw: Annotated[float, Parameter(allow_leading_hyphen=True, help="Degrees clockwise from north.")] = 0.0,
    scale: Annotated[float, Parameter(help="Size against that in the file.")] = 1.0,
    up: Annotated[
        Literal["y", "z"] | None, Parameter(help="Which axis of the file is up; else its format says.")
    ] = None,
    name: Annotated[str | None, Parameter(help="Id of the prop; else one that is free.")] = None,
) -> int:
    """Put a mesh from a file into a level as a prop.

    Without Z it stands on the ground. Where --name is that of a prop in the level, it takes its place.
    """
    from ..session import Session

    x, y, *z = numbers(at, 3 if at.count(",") == 2 else 2, "--at", "a place: give X,Y or X,Y,Z in metres")
    fields = {"floats": floats or drifts, "drifts": drifts, "yaw_deg": yaw, "scale": scale}
    fields |= {"density": density} if density is not None else {}
    fields |= {"z": z[0]} if z else {}
    fields |= {"id": name} if name else {}
    with Session.open(level) as session:
        before = session.level.objects.get(name or "")
        if before is not None and before.kind != "prop":
            raise BadInput(f"{name} is a {before.kind} of this level: choose another --name")
        held = session.import_mesh(mesh, up=up)
        thing = session.place_prop(held, x, y, **fields)
        session.save()
        put_notes(session.notes)
        low, high = (session.level.meshes[held].box * scale).tolist()
        sides = " × ".join(f"{b - a:.2f}" for a, b in zip(low, high))
        triangles = len(session.level.meshes[held].triangles)
    put(f"{thing} at {x:g}, {y:g}: {triangles} triangles, {sides} m")
    return 0
