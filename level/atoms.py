"""Atoms of undo besides tiles (T08): settings, an object, a whole grid. Swapping one twice changes nothing."""

from __future__ import annotations

import pickle
from dataclasses import dataclass

import numpy as np
import zstandard

from .level import Level
from .objects import Placed
from .settings import Settings


@dataclass
class Value:
    """An atom: the whole settings model as it was (frozen, so holding it costs a reference)."""

    settings: Settings
    bytes: int = 512

    def swap(self, level: Level) -> None:
        now = level.settings
        level.set_settings(self.settings)
        self.settings = now


@dataclass
class Thing:
    """An atom: one object as it was; None = absent."""

    name: str
    thing: Placed | None
    bytes: int = 512

    def swap(self, level: Level) -> None:
        now = level.objects.get(self.name)
        level.put_object(self.name, self.thing)
        self.thing = now


@dataclass
class Whole:
    """An atom: grid, base, every written tile and the georeference, for import, resize and crop."""

    state: bytes

    @property
    def bytes(self) -> int:
        return len(self.state)

    def swap(self, level: Level) -> None:
        now = whole_state(level)
        restore_whole(level, self.state)
        self.state = now


def whole_state(level: Level) -> bytes:
    """Everything that a change of grid replaces, as bytes."""
    tiles = {
        name: {tile: data.tile(tile) for tile in map(tuple, np.argwhere(data.written))}
        for name, data in level.layers.items()
    }
    state = (level.grid, level.layers["height"].base, tiles, level.georeference)
    return zstandard.compress(pickle.dumps(state, protocol=5), 1)


def restore_whole(level: Level, state: bytes) -> None:
    grid, base, tiles, level.georeference = pickle.loads(zstandard.decompress(state))
    level.reset(grid, base)
    for name, held in tiles.items():
        for tile, values in held.items():
            level.layers[name].put_tile(tile, values)
