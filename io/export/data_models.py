"""What data files have in common, and models made from those of the level: a parameter stays declared in one place.

Everything is written to be read by the weakest reader, Unity's JsonUtility: no lists of lists, no keys that are names
of things, one shape a list, vectors as objects with x, y, z.
"""

from __future__ import annotations

import json
from copy import deepcopy
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, create_model

from ...level.settings import Settings
from .data_axes import Frame
from .engine_records import Record

VERSION = 1  # of all data files; a reader that knows another says so


class Vector(Record):
    x: float
    y: float
    z: float


class Rotation(Record):
    """A quaternion."""

    x: float
    y: float
    z: float
    w: float


class Place(Vector):
    """A point: in `place` world metres, x east, y north, z up; in `engine` the target's axes and units."""


class Pose(Place):
    """A point, and where the thing there looks: `ahead` (its own y) and `up` are unit vectors, square to each other."""

    ahead: Vector
    up: Vector


class EnginePose(Pose):
    """The same in the engine's axes and units."""

    rotation: Rotation = Field(
        description="Quaternion that turns what looks along the engine's own axis ahead (`engine.ahead` of the file)."
    )


class EngineAxes(Record):
    """How places of the level become the target's, in words that are formulas too."""

    target: str
    x: str = Field(description="From x, y, z in metres of the level.")
    y: str
    z: str
    units_per_m: float = Field(gt=0, description="Lengths that are no places stay in metres everywhere: times this.")
    north_m: float = Field(description="Size of the level to the north.")
    sea_level_m: float = Field(description="Height of the mean sea in the level.")
    ahead: str = Field(description="Axis along which a camera or an object looks that is not turned.")

    @classmethod
    def of(cls, frame: Frame) -> EngineAxes:
        x, y, z = frame.axes.formula
        return cls(
            target=frame.target, x=x, y=y, z=z, units_per_m=frame.axes.units_per_m, north_m=frame.north_m,
            sea_level_m=frame.sea_m, ahead=frame.axes.ahead,
        )  # fmt: skip


class DataFile(BaseModel):
    """The head of every data file."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, populate_by_name=True)

    schema_file: str = Field(alias="$schema", description="The file beside this one that describes it.")
    version: int = Field(VERSION, ge=VERSION, le=VERSION, description="Of this kind of file.")
    level: str = Field(description="Name of the level.")


def copied(
    name: str, source: type[BaseModel], extra: dict[str, Any] | None = None, without: tuple[str, ...] = (), base=Record
) -> type[BaseModel]:
    """A model with the fields of another, ranges, units and sentences included, but not what it checks beyond them."""
    fields = {
        key: (field.annotation, deepcopy(field)) for key, field in source.model_fields.items() if key not in without
    }
    return create_model(name, __base__=base, __doc__=source.__doc__, __module__=__name__, **fields, **(extra or {}))


def some_settings(name: str, paths: tuple[str, ...], doc: str) -> type[BaseModel]:
    """A model of a few settings by dotted path, in sections as all of them are."""
    sections: dict[str, list[str]] = {}
    for path in paths:
        section, key = path.split(".")
        sections.setdefault(section, []).append(key)
    fields = {}
    for section, keys in sections.items():
        source = Settings.model_fields[section].annotation
        without = tuple(key for key in source.model_fields if key not in keys)
        fields[section] = (copied(f"{name}_{section}", source, without=without), Field())
    return create_model(name, __base__=Record, __doc__=doc, __module__=__name__, **fields)


def in_sections(values: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Values by dotted path as such a model takes them."""
    out: dict[str, dict[str, Any]] = {}
    for path, value in values.items():
        section, key = path.split(".")
        out.setdefault(section, {})[key] = value
    return out


def vector(values) -> dict[str, float]:
    return dict(zip("xyzw", (float(value) for value in values)))


# Text


def text_of(file: BaseModel) -> str:
    """JSON: a line each for what is at the top, a setting, or a row of a list; the same file gives the same bytes."""
    return _block(_positive(file.model_dump(mode="json", by_alias=True)), 0) + "\n"


def _positive(value: Any) -> Any:
    """Without a zero that is negative."""
    if isinstance(value, dict):
        return {key: _positive(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_positive(one) for one in value]
    return value + 0.0 if isinstance(value, float) else value


def _block(value: Any, depth: int) -> str:
    pad, end = "\n" + " " * (depth + 1), "\n" + " " * depth
    if isinstance(value, dict) and value and depth < 3:
        rows = [f"{_line(key)}: {_block(one, depth + 1)}" for key, one in value.items()]
        return "{" + pad + f",{pad}".join(rows) + end + "}"
    if isinstance(value, list) and value and isinstance(value[0], dict) and depth < 3:
        return "[" + pad + f",{pad}".join(map(_line, value)) + end + "]"
    return _line(value)


def _line(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
