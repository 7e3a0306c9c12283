"""Parameters declared once: default, range, unit, one sentence.

`param()` makes a pydantic field; widget, validation, file, command-line flag and manual table all read it back through
`describe()`. Models are frozen: a change makes a new one (`replace`), so an undo step can hold the old one.
"""

from __future__ import annotations

import math
import types
from dataclasses import dataclass
from typing import Any, Literal, TypeVar, Union, get_args, get_origin

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from .errors import BadInput

Model = TypeVar("Model", bound=BaseModel)
MOST_SHOWN = 60  # characters of a wrong value that a sentence repeats


class Section(BaseModel):
    """A frozen group of parameters; unknown names and values out of range are refused."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


def param(
    default: Any, low: float | None = None, high: float | None = None, unit: str = "", doc: str = "", *, soft=None
):
    """A parameter with its hard range, unit and sentence; `soft` is the slider's range where narrower."""
    extra = {"unit": unit, "soft": list(soft) if soft else None}
    return Field(default, ge=low, le=high, description=doc, json_schema_extra=extra)


@dataclass(frozen=True)
class Param:
    """One row of the parameter table; `kind` is float, int, bool, choice, text or vector (a tuple of floats)."""

    name: str
    kind: str
    default: Any
    low: float | None
    high: float | None
    soft: tuple[float, float] | None
    unit: str
    doc: str
    choices: tuple[str, ...] = ()

    def clamp(self, value: Any) -> Any:
        """A number held inside the hard range; what is no number becomes the default."""
        if self.kind not in ("float", "int"):
            return value
        if not math.isfinite(value):
            return self.default
        value = value if self.low is None else max(value, self.low)
        value = value if self.high is None else min(value, self.high)
        return int(value) if self.kind == "int" else float(value)


def _kind(annotation: Any) -> tuple[str, tuple[str, ...]]:
    if get_origin(annotation) is Literal:
        return "choice", tuple(get_args(annotation))
    if get_origin(annotation) in (Union, types.UnionType):
        return _kind(next(a for a in get_args(annotation) if a is not type(None)))
    if get_origin(annotation) is tuple:
        return "vector", ()
    return {float: "float", int: "int", bool: "bool", str: "text"}.get(annotation, "text"), ()


def describe(model: type[BaseModel], prefix: str = "") -> list[Param]:
    """Every parameter of a model, nested sections flattened to dotted names."""
    rows: list[Param] = []
    for name, field in model.model_fields.items():
        annotation = field.annotation
        if isinstance(annotation, type) and issubclass(annotation, BaseModel):
            rows += describe(annotation, f"{prefix}{name}.")
            continue
        kind, choices = _kind(annotation)
        bounds = {type(m).__name__: m for m in field.metadata}
        low = getattr(bounds.get("Ge"), "ge", None)
        high = getattr(bounds.get("Le"), "le", None)
        extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
        soft = extra.get("soft")
        default = field.get_default(call_default_factory=True)
        rows.append(
            Param(
                prefix + name,
                kind,
                default,
                low,
                high,
                tuple(soft) if soft else None,
                extra.get("unit", ""),
                field.description or "",
                choices,
            )
        )
    return rows


def row(model: type[BaseModel], path: str) -> Param:
    """The row of one parameter; KeyError when there is none."""
    return {row.name: row for row in describe(model)}[path]


def get(model: BaseModel, path: str) -> Any:
    """The value at a dotted path; BadInput names the nearest places when there is none."""
    here: Any = model
    for part in path.split("."):
        if not isinstance(here, BaseModel) or part not in type(here).model_fields:
            raise BadInput(f"no setting is called {path!r}; `shorewright settings` lists them all")
        here = getattr(here, part)
    return here


def replace(model: Model, path: str, value: Any) -> Model:
    """A copy with one dotted value changed and checked; BadInput says what the range is."""
    get(model, path)
    return _replace(model, path, value, path)


def _replace(model: Model, path: str, value: Any, whole: str) -> Model:
    head, _, rest = path.partition(".")
    if rest:
        return model.model_copy(update={head: _replace(getattr(model, head), rest, value, whole)})
    try:
        value = _numbers(model, head, value, whole)
        checked = type(model).model_validate({**{n: getattr(model, n) for n in type(model).model_fields}, head: value})
    except ValidationError as error:
        raise BadInput(sentence(error, whole, value)) from None
    return checked


def _numbers(model: BaseModel, name: str, value: Any, whole: str) -> Any:
    """A vector given as text, `0,0.5,1`, as numbers; everything else as it is."""
    if not isinstance(value, str) or _kind(type(model).model_fields[name].annotation)[0] != "vector":
        return value
    try:
        return tuple(float(part) for part in value.split(","))
    except ValueError:
        raise BadInput(f"{whole} takes numbers parted by commas, not {value!r}") from None


def sentence(error: ValidationError, name: str, value: Any = None) -> str:
    """A pydantic error as one sentence: the parameter, what was wrong with it."""
    first = error.errors()[0]
    place = ".".join(str(part) for part in first["loc"])
    name = name if not place or name.endswith(place) else f"{name}: {place}"
    shown = repr(first.get("input", value))
    told = first["msg"].removeprefix("Value error, ")
    shown = f" = {shown}" if len(shown) <= MOST_SHOWN else ""  # a whole list of numbers helps nobody
    return f"{name}{shown}: {told[0].lower()}{told[1:]}"
