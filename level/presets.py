"""Named sets of settings, one row each (environments, weathers)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from .errors import BadInput
from .params import get, replace
from .settings import Settings


@dataclass(frozen=True)
class Preset:
    """A row: what it sets, by dotted path."""

    name: str
    label: str
    doc: str
    values: dict[str, Any]


def named(rows: Mapping[str, Preset], name: str, kind: str) -> Preset:
    """The row of that name; BadInput lists them when there is none."""
    if name not in rows:
        raise BadInput(f"no {kind} is called {name!r}; there are: {', '.join(rows)}")
    return rows[name]


def applied(settings: Settings, row: Preset) -> Settings:
    """The settings with all that a row sets."""
    for path, value in row.values.items():
        settings = replace(settings, path, value)
    return settings


def name_of(rows: Mapping[str, Preset], settings: Settings) -> str:
    """The name of the row that settings are exactly under, "" for none."""
    for row in rows.values():
        if all(get(settings, path) == value for path, value in row.values.items()):
            return row.name
    return ""
