"""`views`, `brushes`, `layers`, `settings`, `environments`, `weathers`: the tables the program is made of."""

from __future__ import annotations

from dataclasses import asdict
from typing import Annotated

from cyclopts import Parameter

from .common import put, put_json, put_table

Json = Annotated[bool, Parameter(name="--json", negative="", help="A list of objects, each with a name.")]


def views(*, as_json: Json = False) -> int:
    """List the views and the show flags."""
    from ...renderer import SHOW_FLAGS, VIEWS

    if as_json:
        put_json([{"name": v.name, "label": v.label, "doc": v.doc, "ids": v.ids.split()} for v in VIEWS.values()])
        return 0
    put_table([(row.name, row.doc) for row in VIEWS.values()])
    put("\nShow flags, for --hide:")
    put_table([(row.name, row.doc) for row in SHOW_FLAGS.values()])
    return 0


def brushes(*, as_json: Json = False) -> int:
    """List the brushes with their parameters."""
    from ...brushes import BRUSHES
    from ...level.params import describe

    if as_json:
        put_json([_brush(row, [asdict(param) for param in describe(row.params)]) for row in BRUSHES.values()])
        return 0
    for row in BRUSHES.values():
        put(f"{row.name}  [{row.key}]  {row.doc}")
        put_table([_param(param) for param in describe(row.params)], indent="    ")
    return 0


def _brush(row, params: list[dict]) -> dict:
    parts = {part: getattr(row, part).__name__ for part in ("effect", "footprint", "path")}
    plain = {part: getattr(row, part) for part in ("name", "label", "key", "layer", "doc", "inverse")}
    return {**plain, **parts, "params": params}


def layers(*, as_json: Json = False) -> int:
    """List the maps a level can carry."""
    from ...level import LAYERS

    if as_json:
        put_json([{**asdict(row), "channels": list(row.channels)} for row in LAYERS.values()])
        return 0
    kinds = {True: "float16", False: "float32"}
    put_table([(r.name, kinds[r.half], " ".join(r.channels), r.unit, r.doc) for r in LAYERS.values()])
    return 0


def settings(*, as_json: Json = False) -> int:
    """List the settings of a level, as --set names them."""
    from ...level import Settings
    from ...level.params import describe

    rows = describe(Settings)
    if as_json:
        put_json([asdict(row) for row in rows])
    else:
        put_table([_param(row) for row in rows])
    return 0


def environments(*, as_json: Json = False) -> int:
    """List the environments: named light and air, as --environment takes them."""
    from ...level.environments import ENVIRONMENTS

    if as_json:
        put_json([asdict(row) for row in ENVIRONMENTS.values()])
    else:
        put_table([(row.name, row.doc) for row in ENVIRONMENTS.values()])
    return 0


def weathers(*, as_json: Json = False) -> int:
    """List the weathers: named waves, wind and sky, as --weather takes them."""
    from ...level.weather_presets import WEATHERS

    if as_json:
        put_json([asdict(row) for row in WEATHERS.values()])
    else:
        put_table([(row.name, row.doc) for row in WEATHERS.values()])
    return 0


def _param(row) -> tuple[str, ...]:
    """name, default with unit, range, sentence."""
    span = " | ".join(row.choices) or ("" if row.low is None else f"{row.low:g} … {row.high:g}")
    default = {"bool": lambda: str(row.default).lower(), "float": lambda: f"{row.default:g}"}
    told = default[row.kind]() if row.kind in default else str(row.default)
    return row.name, f"{told} {row.unit}".strip(), span, row.doc
