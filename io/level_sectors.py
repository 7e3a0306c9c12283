"""The sectors of a level: which belong in its folder, which are dirty, what each holds, and putting them back."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np

from ..level import LAYERS, BadInput, Grid, Level
from ..level.grid import TILE
from .images import read_header
from .level_json import BASE, grid_of, join, split
from .migrate import new_sector, old_channels
from .sectors import check_header, read_sector, write_sector

Stored = tuple[np.ndarray, np.ndarray | None]


def channels_of(layer: str) -> int:
    """Channels of the maps in a layer's files."""
    return 1 if layer == BASE else len(LAYERS[layer].channels)


def sector_names(level: Level) -> list[str]:
    """Every sector that belongs in the folder: all of the base, of the others those with written tiles."""
    names = [join(BASE, sector) for sector in level.grid.sectors()]
    for layer, data in level.layers.items():
        if data.neutral:
            continue
        for sector in data.grid.sectors():
            if data.written[data.grid.sector_rect(sector).tiles].any():
                names.append(join(layer, sector))
    return sorted(names)


def revision_of(level: Level, name: str) -> int:
    """The revision at which a sector last changed."""
    layer, sector = split(name)
    return int(level.sector_revisions["height" if layer == BASE else layer][sector])


def stored(level: Level, name: str) -> Stored:
    """(samples as the file holds them, written tiles or None for the base)."""
    layer, sector = split(name)
    data = level.layers["height" if layer == BASE else layer]
    rect = data.grid.sector_rect(sector)
    if layer == BASE:
        return data.base[rect.slices], None
    samples = data.sculpt if layer == "height" else data.array
    return samples[rect.slices], data.written[rect.tiles]


def write_checked(level: Level, name: str, path: Path) -> str:
    """Write a sector, read it back, return the hash of the file; OSError when the disk does not give it back."""
    samples, written = stored(level, name)
    layer = split(name)[0]
    half = layer != BASE and LAYERS[layer].half and np.array_equal(samples.astype(np.float16), samples)
    write_sector(path, samples, half, written)
    try:
        again = read_sector(path, samples.shape[:2], channels_of(layer))[0]
    except BadInput as error:
        raise OSError(0, f"what was written cannot be read back: {error}") from None
    if not np.array_equal(again, samples):
        raise OSError(0, f"{path.name} came back other than it was written")
    return file_hash(path)


def refuse_nan(level: Level, names: list[str]) -> None:
    """BadInput when a sector about to be saved holds something that isn't a number."""
    for name in names:
        samples = stored(level, name)[0]
        if not (np.isfinite(samples.min()) and np.isfinite(samples.max())):
            layer = split(name)[0]
            raise BadInput(f"the level's {layer} holds samples that are not numbers: undo the last change, then save")


def check_sector(path: Path, grid: Grid, name: str) -> None:
    """BadInput unless a sector's file is there and has the right size; takes no memory."""
    layer, sector = split(name)
    if not path.exists():
        raise BadInput(f"{path} is missing: level.json lists it; restore it from a copy or delete {name!r} there")
    check_header(path, grid_of(layer, grid).sector_rect(sector).shape, channels_of(layer), old_channels(layer))


def decode(path: Path, grid: Grid, name: str) -> tuple[np.ndarray, np.ndarray]:
    """(samples, written tiles) of a sector's file, an old one made new."""
    layer, sector = split(name)
    shape = grid_of(layer, grid).sector_rect(sector).shape
    return new_sector(layer, *read_sector(path, shape, channels_of(layer), old_channels(layer)))


def is_old(path: Path, name: str) -> bool:
    """Whether a file is as an older version wrote it, so that the next save writes it anew."""
    older = old_channels(split(name)[0])
    return bool(older) and len(read_header(path).channels) in older


def put_tiles(level: Level, name: str, samples: np.ndarray, written: np.ndarray) -> None:
    """Give a level the written tiles of one sector."""
    layer, sector = split(name)
    data = level.layers[layer]
    rect = data.grid.sector_rect(sector)
    for row, col in np.argwhere(written):
        tile = rect.row0 // TILE + int(row), rect.col0 // TILE + int(col)
        at = data.grid.tile_rect(tile)
        inside = slice(at.row0 - rect.row0, at.row1 - rect.row0), slice(at.col0 - rect.col0, at.col1 - rect.col0)
        data.put_tile(tile, samples[inside])


def file_hash(path: Path) -> str:
    """SHA-256 of a file, in hex."""
    return hashlib.sha256(path.read_bytes()).hexdigest()
