"""Old levels made new: one function a version, applied in turn to the raw JSON before it is checked; and old maps."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from ..level import BadInput
from ..level.grid import TILE
from ..level.layers import LAYERS, WEATHER_GRID
from ..level.water_optics import PURE_ABSORPTION

VERSION = 3
OLD_WEATHER = 4  # channels of the painted sky up to version 2: coverage, precipitation, type, one weight


def _added_absorption(raw: dict) -> dict:
    """1 to 2: `water.absorb_…` were totals, now they are added to what pure water takes.

    Water keeps its colour; what was clearer than pure water becomes pure.
    """
    settings = raw.get("settings")
    water = settings.get("water") if isinstance(settings, dict) else None
    if not isinstance(water, dict):
        return raw
    water = {**water, "plankton": 0.0, "silt": 0.0}
    for name, pure in zip(("absorb_red", "absorb_green", "absorb_blue"), PURE_ABSORPTION.tolist()):
        if isinstance(water.get(name), int | float):
            water[name] = max(water[name] - pure, 0.0)
    return {**raw, "settings": {**settings, "water": water}}


def _same(raw: dict) -> dict:
    """2 to 3: nothing in the description; the painted sky has a weight a channel and another origin (`new_tiles`)."""
    return raw


# MIGRATIONS[n] turns version n into n + 1
MIGRATIONS: dict[int, Callable[[dict], dict]] = {1: _added_absorption, 2: _same}


def migrate(raw: dict, path: Path) -> dict:
    """`raw` in the current version; BadInput when it is newer, or older than any migration reaches."""
    version = raw.get("shorewright_level")
    if not isinstance(version, int) or isinstance(version, bool) or version < 1:
        raise BadInput(f"{path} has the version {version!r}, which is not a number from 1 to {VERSION}")
    if version > VERSION:
        raise BadInput(
            f"{path} was saved by a newer Shorewright (level version {version}, this one reads up to {VERSION}): update"
        )
    while version < VERSION:
        if version not in MIGRATIONS:
            raise BadInput(f"{path} has level version {version}, which this Shorewright can no longer read")
        raw = MIGRATIONS[version](dict(raw))
        version += 1
        raw["shorewright_level"] = version
    return raw


def migrate_settings(settings: dict, version: int) -> dict:
    """A level's settings alone, in the current version: recovery logs hold them."""
    return migrate({"shorewright_level": version, "settings": settings}, Path("settings"))["settings"]


# Maps. What an old one is shows in its channels: a folder may hold old files under a new description.


def old_channels(layer: str) -> tuple[int, ...]:
    """Numbers of channels that older versions wrote for a layer."""
    return (OLD_WEATHER,) if layer == "weather" else ()


def new_samples(layer: str, samples: np.ndarray) -> np.ndarray:
    """Samples `(rows, cols, channels)` with the layer's present channels: the one weight of a sky becomes three."""
    if samples.shape[-1] not in old_channels(layer) or samples.ndim < 3:
        return samples
    spare = len(LAYERS[layer].channels) - samples.shape[-1]
    return np.concatenate([samples, np.repeat(samples[..., -1:], spare, axis=-1)], axis=-1)


def new_tile(tile: tuple[int, int]) -> tuple[int, int]:
    """Where a tile of an old painted sky lies now: cell (0, 0) stood at the level's corner, the grid's middle."""
    tiles = WEATHER_GRID.tile_shape
    row, col = (round(at) // TILE for at in WEATHER_GRID.to_cells(0.0, 0.0))
    return (tile[0] + row) % tiles[0], (tile[1] + col) % tiles[1]


def new_tiles(layer: str, tiles: dict) -> dict:
    """A layer's tiles by place as recovery logs hold them (None: never written), old ones made new.

    One whose samples tell that it is old tells it of all: an unwritten tile has none.
    """
    if not any(values is not None and values.shape[-1] in old_channels(layer) for values in tiles.values()):
        return tiles
    return {new_tile(at): None if held is None else new_samples(layer, held) for at, held in tiles.items()}


def new_sector(layer: str, samples: np.ndarray, written: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(samples, written tiles) of a layer's file, an old one made new."""
    if samples.ndim < 3 or samples.shape[-1] not in old_channels(layer):
        return samples, written
    rows, cols = new_tile((0, 0))
    moved = np.roll(new_samples(layer, samples), (rows * TILE, cols * TILE), (0, 1))
    return moved, np.roll(written, (rows, cols), (0, 1))
