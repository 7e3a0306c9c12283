"""DATA: what a level has that a game reads as numbers by name, one JSON file a row, each with a schema beside it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from pydantic import BaseModel

from ...level import Level
from . import data_events, data_keys, data_objects, data_settings
from .data_axes import Frame
from .data_models import DataFile
from .records import Manifest

SCHEMA = "schema"  # the row of the manifest's own schema
SCHEMA_DOC = "JSON Schema of the manifest (2020-12); those of the data files lie beside them."


def _none(level: Level, file: BaseModel) -> dict[str, float]:
    return {}


@dataclass(frozen=True)
class DataRow:
    """A file: `make(level, frame)` its fields but the head, None where the level has nothing of it.

    `off(level, file)` measures the file read back against the level in cm, inf where it is another; `check` gives
    findings from the file, the others that are whole, and the manifest; `numbers` go to the manifest.
    """

    name: str
    doc: str
    model: type[DataFile]
    make: Callable[[Level, Frame], dict[str, Any] | None]
    off: Callable[[Level, Any], float]
    check: Callable[[Any, dict[str, Any], Manifest], list[str]]
    formula: str = "values as written"
    numbers: Callable[[Level, Any], dict[str, float]] = _none


DATA: dict[str, DataRow] = {
    row.name: row
    for row in (
        DataRow("settings", "All settings of the level by section, and the presets of light and weather by name.",
                data_settings.SettingsFile, data_settings.make, data_settings.off, data_settings.check),
        DataRow("objects", "All that is placed: waves, flow points, rivers with their curves, lamps, props with their "
                "hulls, cameras, pushes, probes; in the level's coordinates and the engine's.",
                data_objects.ObjectsFile, data_objects.make, data_objects.off, data_objects.check),
        DataRow("keys", "What happens by the clock: weather keys, shots, marks, and tracks of weather, tide and sun.",
                data_keys.KeysFile, data_keys.make, data_keys.off, data_keys.check,
                "values as written, linear in time_s between two rows of a track", data_keys.numbers),
        DataRow("events", "When crests come to the probes and when these get wet and dry, over a span of the clock.",
                data_events.EventsFile, data_events.make, data_events.off, data_events.check),
    )
}  # fmt: skip


def told() -> tuple[tuple[str, str], ...]:
    """(name, sentence) of every row, for a target's list of what it writes."""
    return (*((row.name, row.doc) for row in DATA.values()), (SCHEMA, SCHEMA_DOC))
