"""`level.json`: what a level is apart from its maps, checked by pydantic, written so that two people's edits merge.

No hash, counter or date is in it; one setting a line, one object a line sorted by id, one sector a line sorted by name.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ..level import LAYERS, BadInput, Grid, Level, Settings
from ..level.layers import WEATHER_GRID
from ..level.objects import Object
from ..level.params import sentence
from .migrate import VERSION, migrate

NAME = "level.json"
BASE = "height_base"  # the imported ground; `height` files hold what was sculpted on it
MAX_BYTES = 64 << 20
SECTOR_NAME = r"^[a-z_]{1,40}\.r\d{1,2}\.c\d{1,2}$"  # no slash, no dot-dot: a name cannot leave the folder
Scalar = str | int | float | bool | None


class Extent(BaseModel):
    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)
    rows: int
    cols: int
    cell_m: float


class Manifest(BaseModel):
    """The file as it stands; `layers` names the sectors that exist."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)
    shorewright_level: int
    grid: Extent
    georeference: dict[str, Scalar | list[float]] = {}
    layers: list[str] = Field(default=[], max_length=len(LAYERS) * 400)
    settings: Settings = Settings()
    objects: list[Object] = Field(default=[], max_length=100_000)


def dump(level: Level, sectors: list[str]) -> bytes:
    """The bytes of `level.json`: the same level gives the same bytes."""
    settings = json.dumps(level.settings.model_dump(mode="json"), indent=1, ensure_ascii=False, allow_nan=False)
    fields = {
        "shorewright_level": str(VERSION),
        "grid": json.dumps({"rows": level.grid.rows, "cols": level.grid.cols, "cell_m": level.grid.cell_m}),
        "georeference": json.dumps(level.georeference, indent=1, ensure_ascii=False, allow_nan=False, sort_keys=True),
        "layers": _lines(json.dumps(name) for name in sorted(sectors)),
        "settings": settings,
        "objects": _lines(_object_line(level.objects[key]) for key in sorted(level.objects)),
    }
    return ("{\n" + ",\n".join(f'"{key}": {value}' for key, value in fields.items()) + "\n}\n").encode()


def _object_line(thing) -> str:
    values = thing.model_dump(mode="json")
    first = {key: values.pop(key) for key in ("id", "kind")}
    return json.dumps({**first, **values}, ensure_ascii=False, allow_nan=False)


def _lines(rows) -> str:
    rows = list(rows)
    return "[\n" + ",\n".join(rows) + "\n]" if rows else "[]"


def parse(path: Path, data: bytes) -> Manifest:
    """A checked manifest; BadInput in one sentence for anything that isn't one this version can read."""
    try:
        raw = json.loads(data.decode("utf-8"))
    except UnicodeDecodeError:
        raise BadInput(f"{path} is not UTF-8 text, so it is no level description") from None
    except (ValueError, RecursionError) as error:
        conflict = next((n for n, line in enumerate(data.split(b"\n"), 1) if line.startswith(b"<<<<<<<")), 0)
        if conflict:
            raise BadInput(f"{path} has an unresolved merge conflict at line {conflict}: settle it first") from None
        raise BadInput(f"{path} is not valid JSON: {error}") from None
    if not isinstance(raw, dict) or "shorewright_level" not in raw:
        raise BadInput(f"{path} is not the description of a Shorewright level")
    raw = migrate(raw, path)
    try:
        manifest = Manifest.model_validate(raw)
    except ValidationError as error:
        raise BadInput(f"{path} cannot be used: {_told(error, raw)[:300]}") from None
    _check(path, manifest)
    return manifest


def _told(error: ValidationError, raw: dict) -> str:
    """The sentence of an error; what is wrong with an object is told by its id, not by its number."""
    told, (first, *rest) = sentence(error, "level"), error.errors()[0]["loc"] or ("",)
    if first != "objects" or len(rest) < 2:
        return told
    thing = raw["objects"][rest[0]]
    name = thing.get("id") if isinstance(thing, dict) else None
    place = ".".join(map(str, (first, *rest)))
    return told.replace(f"level: {place}", f"object {name!r}, {'.'.join(map(str, rest[2:]))}", 1) if name else told


def _check(path: Path, manifest: Manifest) -> None:
    grid = Grid(manifest.grid.rows, manifest.grid.cols, manifest.grid.cell_m)
    seen = set()
    for thing in manifest.objects:
        if thing.id in seen:
            raise BadInput(f"{path} has two objects called {thing.id!r}: rename one of them")
        seen.add(thing.id)
    for name in manifest.layers:
        if not re.fullmatch(SECTOR_NAME, name):
            raise BadInput(f"{path} names {name!r} among its layers, which is not the name of a sector in its folder")
        layer, sector = split(name)
        if layer != BASE and layer not in LAYERS:
            raise BadInput(f"{path} has a layer {layer!r} that this version does not know: update Shorewright")
        here = grid_of(layer, grid).sector_shape
        if sector[0] >= here[0] or sector[1] >= here[1]:
            raise BadInput(f"{path} names {name!r}, but its grid has only {here[0]} × {here[1]} sectors")
    missing = {join(BASE, sector) for sector in grid.sectors()} - set(manifest.layers)
    if missing:
        raise BadInput(f"{path} lists no ground for sector {min(missing)}: the level is incomplete")


def grid_of(layer: str, grid: Grid) -> Grid:
    """The grid that a layer's files are cut by."""
    return WEATHER_GRID if layer in LAYERS and LAYERS[layer].grid == "weather" else grid


def is_sector(name: str) -> bool:
    """Whether a file of this stem is one of ours."""
    return bool(re.fullmatch(SECTOR_NAME, name)) and split(name)[0] in (BASE, *LAYERS)


def join(layer: str, sector: tuple[int, int]) -> str:
    return f"{layer}.r{sector[0]}.c{sector[1]}"


def split(name: str) -> tuple[str, tuple[int, int]]:
    layer, row, col = name.split(".")
    return layer, (int(row[1:]), int(col[1:]))
