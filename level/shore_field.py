"""The shore map for foam, flow and the sheet of water (H10, H11): distance, direction, beach; a texel each 0.5 m.

Cached by revision, never saved. A distance counts up to `shore.distance_range_m` and no farther, so a change reaches
no farther either: only the window round it is worked out again, and it has the very bits of the whole map. The float
copy is clamped to that range too, so that this holds for it as well. What joins water to the sea may change far away:
the sea mask is made anew whenever ground rises out of the water or sinks into it, and what differs is a change too.
In a window a change is worked out over some frames (`behind` till then), a script waits for it.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Generator, Iterator
from dataclasses import dataclass, field

import numpy as np

from .beach import bare_beach, beach_reach
from .grid import Rect
from .level import Level, merge
from .request import Parts, finished
from .shore import sea_seeds
from .shore_bed import open_edge
from .shore_distance import NEAR, distance_in_parts, joined_water

CELL_M = 0.5  # 4 texels a m² (H10)
MOST_SIDE = 2049  # texels a side
BEACH_M = 2.0  # the slice is this much above and below the still sea
BAND = 32  # rows packed at once
MOST_WINDOW = 112  # mask cells a side of what is measured at once
STEEP_ENOUGH = 1e-3  # a distance that changes less along the ground, m/m, has no direction


@dataclass
class ShoreField:
    """`distance_m` and `beach_m` float32, `packed` uint8 RGBA, `(rows, cols)` texels at vertices, row 0 south.

    R distance, G and B direction east and north, A beach: see the `decode` functions. `distance_m` is positive in the
    sea, negative on land and in ponds, clamped to ±`range_m`; `beach_m` is over the still sea, not clamped.
    """

    distance_m: np.ndarray
    beach_m: np.ndarray
    packed: np.ndarray
    cell_m: float
    range_m: float
    stride: int  # samples of the level a cell of the masks
    times: int  # texels a cell of the masks: 1 or 2
    wet: np.ndarray  # below the still sea
    sea: np.ndarray  # and joined to it
    revision: int = 0
    key: tuple = ()
    log: deque = field(default_factory=lambda: deque(maxlen=64))
    work: Parts | None = None  # the change that is being worked out

    @property
    def behind(self) -> bool:
        """Whether something changed that isn't whole in here yet."""
        return self.work is not None

    def changed_since(self, revision: int) -> list[Rect]:
        """Rectangles of `packed` that changed after that revision of the map."""
        if not self.log or revision < self.log[0][0]:
            return [Rect(0, 0, *self.packed.shape[:2])]
        return [rect for at, rect in self.log if at > revision]

    def ground(self, level: Level, rect: Rect) -> np.ndarray:
        """Ground over the still sea at the texels of `rect`, m."""
        cells = Rect(rect.row0 // self.times, rect.col0 // self.times,
                     -(-(rect.row1 - 1) // self.times) + 1, -(-(rect.col1 - 1) // self.times) + 1)  # fmt: skip
        every = _texels(cells, self.times)
        return _finer(-_depth(level, self.stride, cells), self.times)[rect.shifted(every).slices]


# How the packed copy is read: the same names and formulas as in renderer/shaders/lib/shore_field.glsl


def decode_distance_m(red, range_m: float):
    """Metres to the shoreline from R, 0 … 255: from 128 on sea, below land; right within range / 256."""
    return (np.asarray(red, np.float64) - 127.5) * (range_m / 128.0)


def decode_direction(green_blue):
    """Unit vector (east, north) from G and B, 0 … 255: to the shore in the sea, on inland; (0, 0) beyond the range."""
    return (np.asarray(green_blue, np.float64) - 128.0) / 127.0


def decode_beach_m(alpha):
    """Metres of bare beach over the still sea from A, 0 … 255: −2 … 2 in steps of 4 m / 256."""
    return (np.asarray(alpha, np.float64) + 0.5) * (2 * BEACH_M / 256.0) - BEACH_M


def pack(distance_m: np.ndarray, direction: np.ndarray, beach_m: np.ndarray, range_m: float) -> np.ndarray:
    """The four channels as uint8; water stays water (`ceil` keeps the sign of the least distance)."""
    packed = np.empty((*distance_m.shape, 4), np.uint8)
    packed[..., 0] = np.clip(np.ceil(distance_m * np.float32(128 / range_m) + 127), 0, 255)
    packed[..., 1], packed[..., 2] = np.rint(direction * 127 + 128)
    packed[..., 3] = np.clip(np.floor((beach_m + BEACH_M) * (256 / (2 * BEACH_M))), 0, 255)
    return packed


def direction(distance_m: np.ndarray, cell_m: float) -> np.ndarray:
    """Unit vectors east and north down the distance, float32 `(2, rows, cols)`; zero where it is level."""
    north, east = np.gradient(distance_m, cell_m)
    length = np.sqrt(east * east + north * north)
    scale = np.where(length < STEEP_ENOUGH, 0, -1 / np.maximum(length, np.float32(STEEP_ENOUGH)))
    return np.stack([east * scale, north * scale])


def shore_field(level: Level, now: bool = False) -> ShoreField:
    """The level's field, up to date with its height; changed in place by window while its settings stay.

    Where an editor lends its frames it may be `behind`; `now`: nothing but the whole will do.
    """
    seeds = sea_seeds(level)
    key = level.mean_sea_m, level.settings.shore.distance_range_m, seeds
    have: ShoreField | None = level.derived.get("shore_field")
    at = level.layer_revision("height")
    if have is not None and have.key == key:
        while have.behind or have.revision != at:
            have.work = have.work or _update(level, have, seeds, at)
            if level.solver is None or now:
                finished(have.work)
            elif not level.solver.in_parts("shore_field", have.work):
                break
            have.work = None
        return have
    level.derived["shore_field"] = made = _whole(level, seeds)
    made.revision, made.key = at, key
    made.log.append((at, Rect(0, 0, *made.packed.shape[:2])))
    return made


def _sizes(level: Level) -> tuple[int, int]:
    """(stride, times): samples of the level a mask cell, texels a mask cell; never finer than half a cell."""
    side, cell_m = max(level.grid.shape) - 1, level.grid.cell_m
    stride = max(1, math.floor(CELL_M / cell_m), math.ceil(side / (MOST_SIDE - 1)))
    stride = min(stride, min(level.grid.shape) - 1)  # a thin level keeps both its sides
    fine = stride * cell_m > 1.4 * CELL_M and 2 * (side // stride) < MOST_SIDE
    return stride, 2 if fine else 1


def _whole(level: Level, seeds: tuple) -> ShoreField:
    stride, times = _sizes(level)
    mask_m = level.grid.cell_m * stride
    wet = _depth(level, stride) > 0
    sea = joined_water(wet, wet & open_edge(wet.shape, seeds, mask_m))
    shape = tuple(times * (side - 1) + 1 for side in wet.shape)
    made = ShoreField(
        np.empty(shape, np.float32), np.empty(shape, np.float32), np.empty((*shape, 4), np.uint8), mask_m / times,
        level.settings.shore.distance_range_m, stride, times, wet, sea,
    )  # fmt: skip
    every = Rect(0, 0, *wet.shape)
    finished(_measure(level, made, every))
    _bare(level, made, every)
    finished(_pack(made, every))
    return made


def _depth(level: Level, stride: int, rect: Rect | None = None) -> np.ndarray:
    """Depth of the still sea at mask cells, float32."""
    rows, cols = (slice(None), slice(None)) if rect is None else rect.slices
    return level.mean_sea_m - level.height[::stride, ::stride][rows, cols].astype(np.float32)


def _update(level: Level, have: ShoreField, seeds: tuple, at: int) -> Iterator[None]:
    """Work out the windows that changes of height reach; what changes meanwhile is in the next update's."""
    every = Rect(0, 0, *have.wet.shape)
    rects = [_coarse(rect, have.stride).intersect(every) for rect in level.changed_since("height", have.revision)]
    moved = yield from _shore_moved(level, have, seeds, rects)
    yield
    reach, bare_reach = _reach(have) + 1, beach_reach(have.cell_m * have.times)
    shores = merge(rect.pad(reach).intersect(every) for rect in moved)
    beaches = merge(rect.pad(bare_reach).intersect(every) for rect in rects)
    for piece in [piece for window in beaches for piece in _pieces(window)]:
        _bare(level, have, piece)
        yield
    for piece in [piece for window in shores for piece in _pieces(window)]:
        yield from _measure(level, have, piece)
    for window in merge((*shores, *beaches)):
        wide = window.pad(1).intersect(every)
        yield from _pack(have, wide)
        have.log.append((at, _texels(wide, have.times)))
    have.revision = at


def _pieces(window: Rect) -> list[Rect]:
    """A window cut up, so that no part of a work takes long; pieces share a cell, for texels lie between two."""
    side = MOST_WINDOW
    rows, cols = (range(first, max(end - 1, first + 1), side) for first, end in zip(window[:2], window[2:]))
    return [Rect(row, col, row + side + 1, col + side + 1).intersect(window) for row in rows for col in cols]


def _coarse(rect: Rect, stride: int) -> Rect:
    return Rect(rect.row0 // stride, rect.col0 // stride, (rect.row1 - 1) // stride + 1, (rect.col1 - 1) // stride + 1)


def _shore_moved(
    level: Level, have: ShoreField, seeds: tuple, rects: list[Rect]
) -> Generator[None, None, list[Rect]]:  # fmt: skip
    """Rectangles of mask cells in which the shoreline may have moved; brings both masks up to date."""
    every, flipped = Rect(0, 0, *have.wet.shape), False
    near = [rect.pad(1).intersect(every) for rect in rects]
    moved = [rect for rect in near if _crossed(have.sea[rect.slices])]
    for rect in rects:
        wet = _depth(level, have.stride, rect) > 0
        flipped |= not np.array_equal(wet, have.wet[rect.slices])
        have.wet[rect.slices] = wet
    if flipped:
        sea = joined_water(have.wet, have.wet & open_edge(have.wet.shape, seeds, have.cell_m * have.times))
        yield
        other = sea != have.sea
        have.sea = sea
        rows, cols = (np.flatnonzero(other.any(axis=axis)) for axis in (1, 0))
        if len(rows):
            moved.append(Rect(int(rows[0]), int(cols[0]), int(rows[-1]) + 1, int(cols[-1]) + 1).pad(1))
    return merge(rect.intersect(every) for rect in moved)


def _crossed(sea: np.ndarray) -> bool:
    return bool(sea.any() and not sea.all())


def _reach(have: ShoreField) -> int:
    """Mask cells over which a shoreline counts."""
    return math.ceil(have.range_m / (have.cell_m * have.times))


def _measure(level: Level, have: ShoreField, rect: Rect) -> Iterator[None]:
    """Distances at the mask cells of `rect` and the texels between them."""
    window = rect.pad(_reach(have) + NEAR + 2).intersect(Rect(0, 0, *have.wet.shape))
    depth = _finer(_depth(level, have.stride, window), have.times)
    sea = _finer_any(have.sea[window.slices], have.times) & (depth > 0)
    np.minimum(depth, 0, out=depth, where=~sea)  # what changed since the mask was made comes in the next update
    inner = _texels(rect.shifted(window), have.times)
    yield
    cells = yield from distance_in_parts(depth, sea, math.ceil(have.range_m / have.cell_m), inner)
    metres = np.clip(cells * np.float32(have.cell_m), -have.range_m, have.range_m)
    have.distance_m[_texels(rect, have.times).slices] = metres


def _bare(level: Level, have: ShoreField, rect: Rect) -> None:
    ground = level.height[:: have.stride, :: have.stride]
    bare = bare_beach(ground, rect, have.cell_m * have.times) - np.float32(level.mean_sea_m)
    have.beach_m[_texels(rect, have.times).slices] = _finer(bare, have.times)


def _pack(have: ShoreField, rect: Rect) -> Iterator[None]:
    """Pack the texels of mask cells, some rows at a time."""
    texels, every = _texels(rect, have.times), Rect(0, 0, *have.packed.shape[:2])
    for row in range(texels.row0, texels.row1, BAND):
        band = texels.intersect(Rect(row, texels.col0, row + BAND, texels.col1))
        wide = band.pad(1).intersect(every)  # a direction looks at the neighbours
        toward = direction(have.distance_m[wide.slices], have.cell_m)[(slice(None), *band.shifted(wide).slices)]
        have.packed[band.slices] = pack(have.distance_m[band.slices], toward, have.beach_m[band.slices], have.range_m)
        yield


def _texels(rect: Rect, times: int) -> Rect:
    return Rect(times * rect.row0, times * rect.col0, times * (rect.row1 - 1) + 1, times * (rect.col1 - 1) + 1)


def _finer(values: np.ndarray, times: int) -> np.ndarray:
    """Bilinear between mask cells."""
    if times == 1:
        return values
    finer = np.empty(tuple(2 * side - 1 for side in values.shape), np.float32)
    finer[::2, ::2] = values
    finer[1::2, ::2] = 0.5 * (values[:-1] + values[1:])
    finer[:, 1::2] = 0.5 * (finer[:, :-1:2] + finer[:, 2::2])
    return finer


def _finer_any(mask: np.ndarray, times: int) -> np.ndarray:
    """True at and between mask cells that are; water across a cell's corner is one water."""
    if times == 1:
        return mask
    finer = np.empty(tuple(2 * side - 1 for side in mask.shape), bool)
    finer[::2, ::2] = mask
    finer[1::2, ::2] = mask[:-1] | mask[1:]
    finer[:, 1::2] = finer[:, :-1:2] | finer[:, 2::2]
    return finer
