"""The words of a script: what can be done to a level, one class an action, each checked by its fields.

Points are world metres east and north with an optional pen pressure. script.py reads and writes many of them.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, get_args

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from ..level import BadInput
from ..level.objects import Object

Metres = Annotated[float, Field(ge=-1e9, le=1e9)]
Pressure = Annotated[float, Field(ge=0, le=1)]
Numbers = Annotated[tuple[float, ...], Field(min_length=2)]  # such as the height curve of a cloud
Scalar = bool | int | float | str | Numbers


class Do(BaseModel):
    """One action; unknown words are refused, so that a misspelt one cannot pass unseen."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Stroke(Do):
    do: Literal["stroke"] = "stroke"
    brush: str
    params: dict[str, Scalar] = {}
    points: list[tuple[Metres, Metres] | tuple[Metres, Metres, Pressure]] = Field(min_length=1)
    invert: bool = False
    smooth: bool = False


class ShapeFront(Do):
    """A crest brought to a line at a moment (T07): `wave`, or the one nearest to it, about `at`, or its middle."""

    do: Literal["shape_front"] = "shape_front"
    t: float = Field(ge=0)
    line: list[tuple[Metres, Metres]] = Field(min_length=2)
    radius_m: float = Field(gt=0)
    at: tuple[Metres, Metres] | None = None
    wave: int | None = None
    slope_deg: float = 35.0


class CarveRiver(Do):
    """The bed that a river needs (D13)."""

    do: Literal["carve_river"] = "carve_river"
    id: str


class FillWater(Do):
    """A hollow filled with water up to a level, or drained (D13)."""

    do: Literal["fill_water"] = "fill_water"
    at: tuple[Metres, Metres]
    level_m: float = Field(ge=-12_000, le=12_000)
    drain: bool = False


class Set(Do):
    do: Literal["set"] = "set"
    name: str
    value: Scalar


class SetAll(Do):
    """Settings that change together, as one step."""

    do: Literal["set_all"] = "set_all"
    label: str = Field("Settings", max_length=100)
    values: dict[str, Scalar] = Field(min_length=1)


class Time(Do):
    do: Literal["time"] = "time"
    t: float = Field(ge=0)


class Plain(Do):
    """An action that takes nothing."""

    do: Literal["pause", "run", "undo", "redo"]


class Steps(Do):
    do: Literal["step"] = "step"
    steps: int = Field(1, ge=-100_000, le=100_000)


class Place(Do):
    do: Literal["place"] = "place"
    object: Object
    use: bool = False  # a water table: from now on the level's


class Remove(Do):
    do: Literal["remove"] = "remove"
    id: str


class Rename(Do):
    do: Literal["rename"] = "rename"
    id: str
    to: str


class Resize(Do):
    do: Literal["resize"] = "resize"
    samples: int | None = None
    cell_m: float | None = None


class Crop(Do):
    do: Literal["crop"] = "crop"
    west_m: float
    south_m: float
    east_m: float
    north_m: float


class Import(Do):
    """Another ground under what was sculpted; a relative path starts at the working folder."""

    do: Literal["import"] = "import"
    path: str
    flags: dict[str, Any] = {}


class ShotAdd(Do):
    """A shot with a sky of its own: now, paint, an image, or one packed into the word."""

    do: Literal["shot_add"] = "shot_add"
    id: str = ""
    start_s: float | None = None
    end_s: float | None = None
    fade_s: float = 2.0
    camera: str = ""
    source: str = "now"
    at_s: float | None = None
    packed: str = ""


class ShotToPaint(Do):
    """The sky of a shot over the painted one."""

    do: Literal["shot_to_paint"] = "shot_to_paint"
    id: str


class Mesh(Do):
    """A mesh from a file, for props to name; its name follows from what is in it."""

    do: Literal["mesh"] = "mesh"
    path: str
    up: Literal["y", "z"] | None = None
    scale: float = Field(1.0, gt=0, le=1e6)


class WeatherImport(Do):
    """A weather map from an image over the painted sky; a relative path starts at the working folder."""

    do: Literal["weather_import"] = "weather_import"
    path: str
    layout: str = "ours"
    swizzle: str = ""
    weights: str = ""
    opacity: float = Field(1.0, ge=0, le=1)
    wrap_blend_m: float = Field(0.0, ge=0, le=35_000)
    feather_m: float = Field(0.0, ge=0, le=35_000)
    extent_m: float = Field(70_000.0, gt=0, le=70_000)
    at: tuple[Metres, Metres] | None = None


Action = Annotated[
    Stroke
    | ShapeFront
    | CarveRiver
    | FillWater
    | Set
    | SetAll
    | Time
    | Plain
    | Steps
    | Place
    | Remove
    | Rename
    | Resize
    | Crop
    | Import
    | Mesh
    | WeatherImport
    | ShotAdd
    | ShotToPaint,
    Field(discriminator="do"),
]
ACTION = TypeAdapter(Action)
WORDS = [word for row in get_args(get_args(Action)[0]) for word in get_args(row.model_fields["do"].annotation)]
POINT = TypeAdapter(tuple[Metres, Metres, Pressure], config=ConfigDict(allow_inf_nan=False))


def checked(word: type[Do], **fields: Any) -> Any:
    """A word made from what a caller gave; BadInput names the field that is wrong."""
    try:
        return word.model_validate(fields)
    except ValidationError as error:
        first = error.errors()[0]
        told = first["msg"].removeprefix("Value error, ")
        name = ".".join(str(part) for part in first["loc"])
        raise BadInput(f"{name} = {first['input']!r}: {told[0].lower()}{told[1:]}") from None
