"""MAPS: what a level has beside its ground that a game can read as a picture, one row each.

A row makes its samples from the level (`make`; None where the level has nothing of it) and names the code for them; how
they get into a file, for which target in which format, is map_files.py's.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...level import LAYERS, Level
from .records import Channel


@dataclass(frozen=True)
class Samples:
    """float32 `(rows, cols, channels)`, row 0 south, `cell_m` apart; an integer code reaches from `low` to `high`."""

    values: np.ndarray
    cell_m: float
    low: float = 0.0
    high: float = 1.0


@dataclass(frozen=True)
class MapRow:
    """One map: `code` is one of CODES, `bits` those that it needs in a picture of whole numbers.

    `north` is the channel that holds a component to the north, which targets with y down or green down turn round.
    """

    name: str
    doc: str
    channels: tuple[Channel, ...]
    make: Callable[[Level], Samples | None]
    code: str = "unsigned"
    bits: int = 16
    north: int | None = None


def _painted(name: str) -> MapRow:
    """The row of a painted layer on the level's grid."""
    layer = LAYERS[name]

    def make(level: Level) -> Samples | None:
        data = level.layers[name]
        if data.neutral:
            return None
        values = data.array.reshape(*level.grid.shape, -1)
        return Samples(values, level.grid.cell_m, layer.low, layer.high)

    channels = tuple(
        Channel(name=c, meaning=f"{layer.label.lower()}: {c}", unit=layer.unit, neutral=0) for c in layer.channels
    )
    return MapRow(name, layer.doc, channels, make, "signed" if layer.low < 0 else "unsigned", 8)


def _normals(level: Level) -> Samples:
    north, east = np.gradient(level.height.astype(np.float32), level.grid.cell_m)
    up = 1 / np.sqrt(1 + east * east + north * north)
    return Samples(np.stack([-east * up, -north * up, up], axis=-1), level.grid.cell_m, -1.0, 1.0)


MASKS = ("puddle_keepout", "shelter", "snow", "ice", "corruption", "yielding", "quiet", "mouth", "cover", "scatter")
MAPS: dict[str, MapRow] = {
    row.name: row
    for row in (
        MapRow(
            "normals",
            "Normals of the ground, unit length.",
            (
                Channel(name="east", meaning="normal's part to the east", unit="", neutral=0),
                Channel(name="north", meaning="normal's part to the north", unit="", neutral=0),
                Channel(name="up", meaning="normal's part upwards", unit="", neutral=1),
            ),
            _normals,
            "signed",
            north=1,
        ),
        _painted("foam"),
        _painted("river_foam"),
        *(_painted(name) for name in MASKS),
    )
}


def told() -> tuple[tuple[str, str], ...]:
    """(name, sentence) of every row, for a target's list of what it writes."""
    return tuple((row.name, row.doc) for row in MAPS.values())
