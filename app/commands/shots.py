"""`shot add`, `shot list`, `shot remove`: skies of their own for a camera and a stretch of time."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import cyclopts
from cyclopts import Parameter

from ...level.errors import BadInput
from .common import LevelPath, finite, put, put_json, put_notes, put_table

app = cyclopts.App(name="shot", help="Shots: skies of their own for a camera and a stretch of time.")
Name = Annotated[str, Parameter(help="Id of the shot.")]


@app.command(name="add")
def add(
    level: LevelPath,
    *,
    start: Annotated[float, Parameter(help="Seconds on the level's clock when it begins to come up.")],
    end: Annotated[float, Parameter(help="Seconds when it is gone.")],
    fade: Annotated[float, Parameter(help="Seconds it takes to come and to go.")] = 2.0,
    camera: Annotated[str, Parameter(help="The camera whose picture has it; else all of them.")] = "",
    name: Annotated[str, Parameter(help="Its id; else one that is free.")] = "",
    sky: Annotated[str, Parameter(name="--from", help="now, paint, or the image of a weather map.")] = "now",
    time: Annotated[float | None, Parameter(help="Seconds at which --from now looks; else the start.")] = None,
) -> int:
    """Give a shot a sky of its own.

    From now: the sky as it is at its start. From paint: the painted sky over the simulation.
    """
    from ..session import Session
    from ..shot_edits import SOURCES

    if sky not in SOURCES and not Path(sky).exists():
        raise BadInput(f"--from {sky} is neither {' nor '.join(SOURCES)} nor a file that exists")
    start, end, fade = finite(start, "--start", 0, 1e7), finite(end, "--end", 0, 1e7), finite(fade, "--fade", 0, 1e5)
    at = start if time is None else finite(time, "--time", 0, 1e9)
    with Session.open(level) as session:
        made = session.shot_add(name, start, end, fade, camera, sky, at)
        session.save()
        put_notes(session.notes)
        held = session.level.objects[made].map
    put(f"{made} from {start:g} to {end:g} s: skies/{held}.exr")
    return 0


@app.command(name="list")
def list_shots(
    level: LevelPath, *, json: Annotated[bool, Parameter(negative="", help="As JSON.")] = False
) -> int:  # fmt: skip
    """List the shots of a level, in order of their start."""
    from ...io import read_level
    from ...level.objects import Shot

    notes: list[str] = []
    found = [thing for thing in read_level(level, notes).objects.values() if isinstance(thing, Shot)]
    found.sort(key=lambda shot: (shot.start_s, shot.id))
    put_notes(notes)
    if json:
        put_json([shot.model_dump(mode="json", exclude={"kind", "x", "y"}) for shot in found])
    else:
        put_table([
            (shot.id, f"{shot.start_s:g} to {shot.end_s:g} s", f"fade {shot.fade_s:g} s",
             shot.camera or "all cameras", shot.map) for shot in found
        ])  # fmt: skip
    return 0


@app.command(name="remove")
def remove(level: LevelPath, name: Name) -> int:
    """Remove a shot, and its sky where no other shot has it."""
    from ..session import Session

    with Session.open(level) as session:
        session.shot_remove(name)
        session.save()
        put_notes(session.notes)
    return 0
