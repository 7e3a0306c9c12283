"""The samples of each map of MAPS, made from a level: float32, row 0 south, with the range that they are coded over."""

from __future__ import annotations

import math
import weakref
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import wraps
from tempfile import SpooledTemporaryFile

import numpy as np

from ...level import LAYERS, Level
from ...level.layers import WEATHER_GRID
from .records import Channel

STILL_MPS = 1e-4
HELD_BYTES = 8_000_000  # a map that took long to make and is larger waits on the disk


@dataclass(frozen=True)
class Rows:
    """float32 `(rows, cols, channels)` that are made some rows at a time: a large map never lies in memory as such."""

    shape: tuple[int, int, int]
    read: Callable[[int, int], np.ndarray]  # rows from … to

    def __array__(self, dtype=None, copy=None) -> np.ndarray:
        return np.asarray(self.read(0, self.shape[0]), dtype)

    def __getitem__(self, rows: slice) -> np.ndarray:
        start, stop, _ = rows.indices(self.shape[0])
        return self.read(start, stop)


def spooled(shape: tuple[int, int, int], blocks: Iterable[np.ndarray], parts: int | None = None) -> Rows:
    """Rows that were worked out once, from the south: in memory, or in a file without a name when they are many.

    With `parts` the blocks are whole numbers up to 255, and so many of them are 1.
    """
    file, dtype = SpooledTemporaryFile(HELD_BYTES), np.dtype(np.uint8 if parts else np.float32)  # noqa: SIM115
    try:
        for block in blocks:
            file.write(np.ascontiguousarray(block, dtype).data)
    except BaseException:
        file.close()
        raise
    row_bytes = dtype.itemsize * shape[1] * shape[2]

    def read(start: int, stop: int) -> np.ndarray:
        file.seek(start * row_bytes)
        held = np.frombuffer(file.read((stop - start) * row_bytes), dtype).reshape(stop - start, *shape[1:])
        return held / np.float32(parts) if parts else held

    weakref.finalize(read, file.close)
    return Rows(shape, read)


@dataclass(frozen=True)
class Samples:
    """float32 `(rows, cols, channels)`, row 0 south, `cell_m` apart; whole numbers reach from `low` to `high`.

    Both are one number for all channels, or a tuple. `numbers` go into the record, beside the code's.
    """

    values: np.ndarray | Rows
    cell_m: float
    low: float | tuple[float, ...] = 0.0
    high: float | tuple[float, ...] = 1.0
    numbers: dict[str, float] = field(default_factory=dict)


def kept(make: Callable[[Level], Samples | None]) -> Callable[[Level], Samples | None]:
    """A maker whose samples stay with the level until it changes, for other targets and maps."""

    @wraps(make)
    def made(level: Level) -> Samples | None:
        name = f"export {make.__name__}"
        now = level.revision, level.settings_revision, level.objects_revision
        then, samples = level.derived.get(name, (None, None))
        if then != now:
            samples = make(level)
            level.derived[name] = now, samples
        return samples

    return made


@dataclass(frozen=True)
class MapRow:
    """One map: `code` is one of CODES, `bits` those that it needs in a picture of whole numbers.

    `north` is the channel with a part to the north, which targets whose second axis goes south turn round; `green` that
    of a normal map, turned for those that want green down. `follows` are the layers that it is made of; () stands for
    all a level holds.
    """

    name: str
    doc: str
    channels: tuple[Channel, ...]
    make: Callable[[Level], Samples | None]
    code: str = "unsigned"
    bits: int = 16
    north: int | None = None
    green: int | None = None
    follows: tuple[str, ...] = ()


def painted(name: str) -> MapRow:
    """The row of a painted layer on the level's grid."""
    layer = LAYERS[name]

    def make(level: Level) -> Samples | None:
        data = level.layers[name]
        if data.neutral:
            return None
        return Samples(data.array.reshape(*level.grid.shape, -1), level.grid.cell_m, layer.low, layer.high)

    label = layer.label.lower()
    channels = tuple(Channel(name=c, meaning=f"{label}: {c}", unit=layer.unit, neutral=0) for c in layer.channels)
    return MapRow(name, layer.doc, channels, make, "signed" if layer.low < 0 else "unsigned", 8, follows=(name,))


def normals(level: Level) -> Samples:
    height, cell_m = level.height, level.grid.cell_m
    rows, cols = height.shape

    def read(start: int, stop: int) -> np.ndarray:
        """One row more on either side, for the slope."""
        first = max(start - 1, 0)
        ground = height[first : min(stop + 1, rows)].astype(np.float32)
        north, east = (slope[start - first :][: stop - start] for slope in np.gradient(ground, cell_m))
        up = 1 / np.sqrt(1 + east * east + north * north)
        return np.stack([-east * up, -north * up, up], axis=-1)

    return Samples(Rows((rows, cols, 3), read), cell_m, -1.0, 1.0)


def flow(level: Level) -> Samples | None:
    from ...level.flow import current

    made = current(level)
    fastest = float(np.abs(made.packed[..., :2]).max())
    if fastest < STILL_MPS:
        return None
    range_mps = 2.0 ** math.ceil(math.log2(fastest))
    return Samples(made.packed[..., :2], made.cell_m, -range_mps, range_mps, {"range_mps": range_mps})


def river(level: Level) -> Samples | None:
    from ...level.river_map import river_shape

    shape = river_shape(level)
    if shape is None or not (wet := shape.packed[..., 1] > 0).any():
        return None
    level_m = shape.packed[..., 0] + level.mean_sea_m
    low, high = float(level_m[wet].min()), float(level_m[wet].max())
    high = max(high, low + 0.01)
    values = np.stack([np.where(wet, level_m, low), shape.packed[..., 1]], axis=-1)
    return Samples(values.astype(np.float32), shape.cell_m, (low, 0.0), (high, 1.0))


def shore(level: Level) -> Samples | None:
    """The field's own bytes, as the shaders of the editor read them: whole-number ends stand for half a step less."""
    from ...level import shore_field as of

    made = of.shore_field(level, now=True)
    if not made.sea.any():
        return None
    red, alpha = (np.array([0.0, 255.0]) for _ in range(2))
    distance, beach = of.decode_distance_m(red, made.range_m), of.decode_beach_m(alpha)
    towards = of.decode_direction(np.array([0.0, 255.0]))

    def read(start: int, stop: int) -> np.ndarray:
        packed = made.packed[start:stop]
        return np.concatenate(
            [
                of.decode_distance_m(packed[..., :1], made.range_m),
                of.decode_direction(packed[..., 1:3]),
                of.decode_beach_m(packed[..., 3:]),
            ],
            axis=-1,
        ).astype(np.float32)

    low, high = ((float(distance[i]), float(towards[i]), float(towards[i]), float(beach[i])) for i in (0, 1))
    return Samples(Rows(made.packed.shape, read), made.cell_m, low, high, {"range_m": made.range_m})


def weather(layout: str) -> Callable[[Level], Samples | None]:
    """A maker of the sky in one of the layouts of weather_maps."""

    def make(level: Level) -> Samples | None:
        from ..weather_maps import layout_values

        if not level.settings.clouds.on:
            return None
        sky, _ = layout_values(level, layout, "final" if layout == "hdrp" else "painted", 0.0)
        return Samples(np.clip(sky[..., :3], 0, 1), WEATHER_GRID.cell_m)

    return make
