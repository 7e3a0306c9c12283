"""`new`, `info`, `resize`, `crop`: levels as a whole."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from ...level.errors import BadInput
from ...level.objects import OBJECT_KINDS
from .common import LevelPath, numbers, put, put_json, put_notes, put_table, size
from .tables import Json

RECTANGLE = "WEST,SOUTH,EAST,NORTH in metres, such as 0,0,400,300."


def new(
    level: LevelPath,
    *,
    terrain: Annotated[Path | None, Parameter(name="--from", help="PNG, EXR, TIFF, npz, r16 or text grid.")] = None,
    cell_m: Annotated[str | None, Parameter(help="Metres between samples: 1, or 2x1 (east x north).")] = None,
    rows: Annotated[Literal["north-first", "south-first"] | None, Parameter(help="Order of the file's rows.")] = None,
    depth_down: Annotated[bool, Parameter(negative="", help="The file counts depth downward.")] = False,
    array: Annotated[str | None, Parameter(help="Which array of an .npz, or channel of an image.")] = None,
    sea_level: Annotated[float, Parameter(allow_leading_hyphen=True, help="Height of the still sea, m.")] = 0.0,
    height_range: Annotated[
        tuple[float, float] | None,
        Parameter(negative="", allow_leading_hyphen=True, help="Metres of black and white."),
    ] = None,
    fill: Annotated[float | None, Parameter(allow_leading_hyphen=True, help="Height of missing samples, m.")] = None,
    size_text: Annotated[
        str | None, Parameter(name="--size", help="N or COLSxROWS of a raw file or a new beach.")
    ] = None,
    resample: Annotated[int | None, Parameter(help="Samples on the longer side of the level made.")] = None,
) -> int:
    """Make a level from a height map, or a beach without one.

    What the file leaves open is told (1 m cells, north row first); what contradicts a flag is refused.
    """
    from ...io.lock import is_husk
    from ..session import Session

    if level.exists() and not is_husk(level):
        raise BadInput(f"{level} exists already: choose another name")
    if terrain is None:
        given = {"--rows": rows, "--depth-down": depth_down, "--array": array, "--height-range": height_range}
        for flag, value in {**given, "--fill": fill}.items():
            if value:
                raise BadInput(f"{flag} says how to read a file: name it with --from TERRAIN")
        session = _beach(size_text, cell_m, sea_level, resample)
    else:
        flags = {"cell_m": cell_m, "rows": rows, "depth_down": depth_down, "array": array, "size": _pair(size_text)}
        flags |= {"height_range": height_range, "fill_m": fill}
        flags = {name: value for name, value in flags.items() if value is not None}
        session = Session.imported(terrain, sea_level_m=sea_level, samples=resample, **flags)
    with session:
        session.save(level)
        put_notes(session.notes)
        put(str(level))
    return 0


def _pair(text: str | None) -> int | tuple[int, int] | None:
    """`513` or `401x601` as samples (columns, rows)."""
    if text is None:
        return None
    if text.isdigit() and len(text) < 6:
        return int(text)
    return size(text, most=16385)


def _beach(text: str | None, cell_text: str | None, sea_level_m: float, resample: int | None):
    from ...level import Grid
    from ..session import Session

    pair = _pair(text) or 513
    cols, rows = (pair, pair) if isinstance(pair, int) else pair
    try:
        cell_m = float(cell_text or 1)
    except ValueError:
        raise BadInput(f"--cell-m {cell_text} is no size: give metres") from None
    session = Session.new(Grid(rows, cols, cell_m))
    session.level.set("level.sea_level_m", sea_level_m)
    if resample:
        session.resize(samples=resample)
    return session


def resize(
    level: LevelPath,
    *,
    samples: Annotated[int | None, Parameter(name=["--size", "--samples"], help="Samples on the longer side.")] = None,
    cell_m: Annotated[float | None, Parameter(help="Metres between samples.")] = None,
    sea_level: Annotated[float | None, Parameter(allow_leading_hyphen=True, help="Height of the still sea, m.")] = None,
) -> int:
    """Resample every map of a level, and move its sea."""
    from ..session import Session

    if samples is None and cell_m is None and sea_level is None:
        raise BadInput("resize needs --size SAMPLES, --cell-m METRES or --sea-level METRES")
    with Session.open(level) as session:
        if sea_level is not None:
            session.set("level.sea_level_m", sea_level)
        if samples is not None or cell_m is not None:
            session.resize(samples, cell_m)
        session.save()
        put_notes(session.notes)
        put(_shape(session.level))
    return 0


def crop(level: LevelPath, rectangle: Annotated[str, Parameter(allow_leading_hyphen=True, help=RECTANGLE)]) -> int:
    """Keep a rectangle of a level."""
    from ..session import Session

    sides = numbers(rectangle, 4, "crop", f"a rectangle: give {RECTANGLE[:-1]}")
    with Session.open(level) as session:
        session.crop(*sides)
        session.save()
        put_notes(session.notes)
        put(_shape(session.level))
    return 0


def _shape(level) -> str:
    east, north = level.grid.extent_m
    return f"{level.grid.cols} × {level.grid.rows} samples, {level.grid.cell_m:g} m apart: {east:g} × {north:g} m"


def info(level: LevelPath, *, as_json: Json = False) -> int:
    """Tell what a level holds: size, maps, cameras."""
    from ...io import read_level

    notes: list[str] = []
    found = read_level(level, notes)
    told = _told(found, level)
    put_notes(notes)
    if as_json:
        put_json(told)
        return 0
    heights = f"{told['lowest_m']:.2f} … {told['highest_m']:.2f} m, sea at {told['sea_level_m']:g} m"
    rows = [("level", told["name"]), ("ground", _shape(found)), ("heights", heights)]
    rows.append(("sea", f"{100 * told['sea_share']:.0f} % of the level"))
    rows += [("map", f"{m['name']}: {m['tiles']} tiles, {m['bytes'] / 2**20:.2f} MB") for m in told["layers"]]
    rows += [("mesh", f"{m['name']}: {m['triangles']} triangles") for m in told["meshes"]]
    for thing in told["objects"]:
        where = "" if OBJECT_KINDS[thing["kind"]].placeless else f" at {thing['x']:.1f}, {thing['y']:.1f}"
        when = f" from {thing['start_s']:g} to {thing['end_s']:g} s" if thing["kind"] == "shot" else ""
        rows.append((thing["kind"], f"{thing['name']}{where}{when}"))
    for row in told["loop"]:
        new = f"{row['new_s']:.3f} s, {row['percent']:+.1f} %" if row["new_s"] else "stands still"
        rows.append(("loop", f"{row['name']}: {row['old_s']:.3f} s becomes {new}"))
    rows += [("georeference", f"{key} = {value}") for key, value in told["georeference"].items()]
    put_table(rows)
    return 0


def _loop(level) -> list[dict]:
    """What the level's loop makes of each period of its sea; nothing without one."""
    from ...level.loop import loop_changes

    if level.settings.time.loop_s <= 0:
        return []
    return [
        {"name": row.name, "old_s": row.old_s, "new_s": row.new_s, "percent": row.percent}
        for row in loop_changes(level)
    ]


def _told(level, path: Path) -> dict:
    import numpy as np

    height = level.height
    layers = [
        {"name": name, "tiles": int(data.written.sum()), "bytes": data.bytes}
        for name, data in level.layers.items()
        if not data.neutral
    ]
    objects = [
        {"name": key, **{k: v for k, v in thing.model_dump(mode="json").items() if k != "id"}}
        for key, thing in sorted(level.objects.items())
    ]
    return {
        "name": path.resolve().name,
        "rows": level.grid.rows,
        "cols": level.grid.cols,
        "cell_m": level.grid.cell_m,
        "extent_m": list(level.grid.extent_m),
        "sea_level_m": level.sea_level_m,
        "lowest_m": float(height.min()),
        "highest_m": float(height.max()),
        "sea_share": float(np.mean(height < level.sea_level_m)),
        "layers": layers,
        "meshes": [{"name": key, "triangles": len(mesh.triangles)} for key, mesh in sorted(level.meshes.items())],
        "objects": objects,
        "cameras": [thing["name"] for thing in objects if thing["kind"] == "camera"],
        "loop": _loop(level),
        "georeference": level.georeference,
        "settings": level.settings.model_dump(mode="json"),
    }
