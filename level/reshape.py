"""Another grid under the same coast: resample or crop every map of a level (the steps behind resize and crop, T08).

Samples stand at vertices and the south-west one stays where it is. Shrinking averages over what a new cell covers,
growing interpolates linearly, the same spacing copies: constant and even slopes survive all three.
"""

from __future__ import annotations

import math

import numpy as np

from . import earth
from .errors import BadInput
from .grid import Grid, Rect
from .layers import WEATHER_GRID, LayerData
from .level import Level
from .params import get


def resample(values: np.ndarray, shape: tuple[int, int], step: tuple[float, float]) -> np.ndarray:
    """Samples `(rows, cols[, channels])` float32 read every `step` (rows, columns) old cells, from the first one on.

    Places past the last sample repeat it. A triangle filter as wide as the step keeps detail that the new spacing
    cannot carry from turning into false bumps.
    """
    along_rows = _filtered(values, shape[0], step[0])
    return np.ascontiguousarray(_filtered(along_rows.swapaxes(0, 1), shape[1], step[1]).swapaxes(0, 1))


def _filtered(values: np.ndarray, count: int, step: float) -> np.ndarray:
    """`values` resampled along its first axis."""
    old = len(values)
    place = np.minimum(np.arange(count) * step, old - 1)
    reach = max(step, 1.0)
    first = np.floor(place - reach).astype(np.int64) + 1
    # Towards an edge the filter narrows on both sides alike: cut on one side only it would bend a slope.
    room = np.maximum(np.minimum(np.minimum(place, old - 1 - place), reach), 1.0)
    width = np.minimum(room, reach)
    index = first[:, None] + np.arange(math.ceil(2 * reach) + 1)
    off = index - place[:, None]
    weight = np.maximum(1 - np.abs(off) / width[:, None], 0) * ((index >= 0) & (index < old))
    # Taps stand unevenly about a place between samples; weights tilted to have their mean there keep slopes even.
    total, first_moment, second = (np.sum(weight * off**power, axis=1) for power in (0, 1, 2))
    tilt = np.where(second > 0, first_moment / np.maximum(second, 1e-12), 0)
    share = weight * (1 - tilt[:, None] * off) / (total - tilt * first_moment)[:, None]
    out = np.zeros((count, *values.shape[1:]), np.float32)
    for at, part in zip(np.clip(index, 0, old - 1).T, share.T.astype(np.float32)):
        if part.any():
            out += part.reshape(-1, *(1,) * (values.ndim - 1)) * values[at]
    return out


def resized_grid(grid: Grid, samples: int | None = None, cell_m: float | None = None) -> Grid:
    """The grid that covers the same land with `samples` on its longer side, or with another cell; BadInput for both."""
    if (samples is None) == (cell_m is None):
        raise BadInput("a new size takes either a number of samples or a cell in metres, not both and not neither")
    if samples is not None:
        if samples < 2:
            raise BadInput(f"a level of {samples} samples has no area: use at least 2")
        cell_m = max(grid.extent_m) / (samples - 1)
    if not (math.isfinite(cell_m) and cell_m > 0):
        raise BadInput(f"a cell of {cell_m} m has no size")
    east, north = grid.extent_m
    rows, cols = (max(math.floor(side / cell_m + 1e-6) + 1, 2) for side in (north, east))
    return Grid(rows, cols, cell_m)


def resize(level: Level, grid: Grid) -> None:
    """Resample every map to another grid that starts at the same south-west corner."""
    step = grid.cell_m / level.grid.cell_m
    _refill(level, grid, lambda values: resample(values, grid.shape, (step, step)))


def crop_rect(grid: Grid, west_m: float, south_m: float, east_m: float, north_m: float) -> Rect:
    """The cells of a rectangle given in metres, outward to whole cells; BadInput outside the level or without area."""
    if not all(map(math.isfinite, (west_m, south_m, east_m, north_m))):
        raise BadInput("a crop needs four finite numbers: west, south, east, north in metres")
    size = f"{grid.extent_m[0]:g} × {grid.extent_m[1]:g} m"
    if not (0 <= west_m < east_m <= grid.extent_m[0] + 1e-6 and 0 <= south_m < north_m <= grid.extent_m[1] + 1e-6):
        asked = f"{west_m:g},{south_m:g} to {east_m:g},{north_m:g} m"
        raise BadInput(f"a crop from {asked} is empty or leaves the level, which is {size}")
    cell = grid.cell_m
    low = (math.floor(south_m / cell + 1e-6), math.floor(west_m / cell + 1e-6))
    high = (math.ceil(north_m / cell - 1e-6) + 1, math.ceil(east_m / cell - 1e-6) + 1)
    rect = grid.clip(Rect(*low, *high))
    if min(rect.shape) < 2:
        raise BadInput(f"a crop of {rect.shape[1]} × {rect.shape[0]} samples has no area")
    return rect


def crop(level: Level, rect: Rect) -> tuple[float, float]:
    """Keep the cells in `rect`, bit for bit; returns how far (x, y) metres the origin moved north-east.

    The sky stays over the same coast: the middle of its map is counted from the corner (Z04).
    """
    grid = Grid(*rect.shape, level.grid.cell_m)
    moved = level.grid.to_metres(rect.row0, rect.col0)
    _refill(level, grid, lambda values: np.ascontiguousarray(values[rect.slices]))
    level.georeference = earth.moved(level.georeference, *moved)
    for name, way in zip(("weather.east_m", "weather.north_m"), moved):
        level.set(name, _on_torus(get(level.settings, name) - way))
    return moved


def _on_torus(metres: float) -> float:
    """The same place of the weather map's torus, as near to zero as it takes to be a setting."""
    return math.remainder(metres, WEATHER_GRID.extent_m[0]) if abs(metres) > WEATHER_GRID.extent_m[0] else metres


def _refill(level: Level, grid: Grid, change) -> None:
    """Give the level another grid and put `change(samples)` of every map into it."""
    old = {name: data for name, data in level.layers.items() if not data.neutral}
    base = change(level.layers["height"].base)
    level.reset(grid, base)
    for name, data in old.items():
        target = level.layers[name]
        if data.row.grid != "level":
            for tile in map(tuple, np.argwhere(data.written)):
                target.put_tile(tile, data.tile(tile))
            continue
        values = change(data.sculpt if name == "height" else data.array)
        _put(target, values.astype(np.float32, copy=False))


def _put(target: LayerData, values: np.ndarray) -> None:
    for tile in target.grid.tiles(target.grid.rect):
        samples = values[target.grid.tile_rect(tile).slices]
        if samples.any():  # tiles that stayed neutral are not written
            target.put_tile(tile, samples.copy())


def replace_base(level: Level, base: np.ndarray, cell_m: float) -> bool:
    """Import under the artist's work: another ground; True when the grid is the same, so that the layers stay."""
    grid = Grid(*base.shape, cell_m)
    same = grid == level.grid
    old = {name: data for name, data in level.layers.items() if not data.neutral}
    level.reset(grid, base)
    for name, data in old.items():
        if same or data.row.grid != "level":
            for tile in map(tuple, np.argwhere(data.written)):
                level.layers[name].put_tile(tile, data.tile(tile))
    return same
