"""The bed as the waves know it: depth, sea mask and the monotone depth that the shore clock reads (D03).

Derived from height, sea level and a few settings; cached by revision, never saved. While a step is open only the window
that changed is worked out again, so the sea answers in the next frame; when it closes the whole map is made anew, so
that a settled picture depends on the level alone.
"""

from __future__ import annotations

import functools
import math
from collections import deque
from dataclasses import dataclass, field, replace

import numpy as np
from scipy import ndimage

from .bottleneck import bottleneck
from .dual import Dual, step
from .grid import Rect
from .level import Level, merge
from .objects import SeaSeed
from .request import Request
from .settings import Settings
from .tide import band_m

MOST_SIDE = 1025  # samples a side: larger levels are read with a stride
LIVE_MARGIN = 24  # cells round a change that are worked out with it
BEYOND_M = 80.0  # how far past the level's border shore waves go on: there the bed is only a guess
ROCKS_M = 4.0  # sigma of the bed that the water's body knows: rocks smaller than that don't dent it
CHANNELS = ("clock", "depth", "sea", "smoothed")


@dataclass
class ShoreMap:
    """`packed` is float32 `(rows, cols, 4)`, row 0 south: clock depth, depth, sea 0 … 1, clock without rocks; m.

    Depths are those at mean sea level. Where the sea has a tide (`tidal`) the third channel holds the tide over which
    a cell is sea, and clock depths of cells that only high water reaches are those of high water.
    """

    packed: np.ndarray
    bottleneck: np.ndarray  # least depth on the way from the sea, before smoothing
    cell_m: float
    stride: int
    revision: int = 0
    key: tuple = ()
    whole: bool = True
    tidal: bool = False
    log: deque = field(default_factory=lambda: deque(maxlen=64))

    def changed_since(self, revision: int) -> list[Rect]:
        """Rectangles of `packed` that changed after that revision of the map."""
        rows, cols = self.packed.shape[:2]
        if not self.log or revision < self.log[0][0] - 1:
            return [Rect(0, 0, rows, cols)]
        return [rect for at, rect in self.log if at > revision]

    def at(self, x, y, tide_m=0.0) -> dict[str, Dual]:
        """Bilinear values with gradients at world points (arrays), by channel; constant outside the level.

        `tide_m` is how far the sea stands over its mean level, a number or one a point.
        """
        rows, cols = self.packed.shape[:2]
        u, v = np.asarray(x) / self.cell_m, np.asarray(y) / self.cell_m
        ui, vi = np.clip(u, 0, cols - 1), np.clip(v, 0, rows - 1)
        col, row = np.minimum(ui.astype(np.int64), cols - 2), np.minimum(vi.astype(np.int64), rows - 2)
        fu, fv = (ui - col)[..., None], (vi - row)[..., None]
        v00, v10 = (self._texels(row, col + i, tide_m) for i in (0, 1))
        v01, v11 = (self._texels(row + 1, col + i, tide_m) for i in (0, 1))
        south, north = v00 + (v10 - v00) * fu, v01 + (v11 - v01) * fu
        value = south + (north - south) * fv + np.asarray(tide_m)[..., None] * np.array([1.0, 1.0, 0.0, 1.0])
        dx = ((v10 - v00) * (1 - fv) + (v11 - v01) * fv) / self.cell_m * (u == ui)[..., None]
        dy = (north - south) / self.cell_m * (v == vi)[..., None]
        bed = {name: Dual(value[..., i], dx[..., i], dy[..., i]) for i, name in enumerate(CHANNELS)}
        out_x, out_y = (u - ui) * self.cell_m, (v - vi) * self.cell_m
        away = np.hypot(out_x, out_y)
        reach = np.maximum(away, 1e-6)
        bed["within"] = 1.0 - step(0.0, BEYOND_M, Dual(away, out_x / reach, out_y / reach))
        return bed

    def _texels(self, row, col, tide_m) -> np.ndarray:
        texels = self.packed[row, col].astype(np.float64)
        if self.tidal:
            texels[..., 2] = texels[..., 2] < np.float32(tide_m)
        return texels


@dataclass(frozen=True)
class BedRequest(Request["Bed"]):
    """All that the map follows from, as a process can carry it."""

    depth_m: np.ndarray
    cell_m: float
    seeds: tuple
    settings: Settings

    def kept(self) -> BedRequest:
        return replace(self, depth_m=np.array(self.depth_m, np.float32))

    @property
    def answer_bytes(self) -> int:
        return 5 * 4 * self.depth_m.size + (1 << 12)

    def answered(self) -> Bed:
        depth = self.depth_m
        start = (depth > 0) & open_edge(depth.shape, self.seeds, self.cell_m)
        least = _from_the_deep(depth, start, self.settings.shore.range_m)
        return Bed(_pack(self.settings, depth, least, self.cell_m), least)


@dataclass(frozen=True)
class Bed:
    """`packed` and `bottleneck` of a map."""

    packed: np.ndarray
    bottleneck: np.ndarray


def shore_map(level: Level, now: bool = False) -> ShoreMap:
    """The level's map, up to date with its height; worked out in the changed window only while a step is open.

    Where an editor lends a process, it stays as it is till that has the whole of it; `now`: nothing but the whole will
    do.
    """
    shore = level.settings.shore
    seeds = sea_seeds(level)
    tide = (level.settings.tide.on, band_m(level.settings)[1])
    key = (level.mean_sea_m, shore.range_m, shore.runup, shore.monotone, shore.smooth_m, seeds, tide)
    have: ShoreMap | None = level.derived.get("shore_map")
    at = level.layer_revision("height")
    if have is not None and have.key == key:
        if have.revision == at and (have.whole or (level.live and not now)):
            return have
        if level.live and not now:
            return _update(level, have, at)
    request = functools.partial(_request, level, seeds)
    if have is None or have.key != key or level.solver is None or now:
        bed = request().answered()
    elif (bed := level.solver.beside("bed", (at, key), request)) is None:
        have.whole = False
        return have
    stride = _stride(level)
    made = ShoreMap(bed.packed, bed.bottleneck, level.grid.cell_m * stride, stride, at, key)
    made.tidal = level.settings.tide.on
    if have is not None and have.key == key:
        made.log = have.log.copy()  # that of the map before ends with it
    made.log.append((at, Rect(0, 0, *made.packed.shape[:2])))
    level.derived["shore_map"] = made
    return made


def _stride(level: Level) -> int:
    return max(1, math.ceil((max(level.grid.shape) - 1) / (MOST_SIDE - 1)))


def _request(level: Level, seeds: tuple) -> BedRequest:
    stride = _stride(level)
    depth = level.mean_sea_m - level.height[::stride, ::stride].astype(np.float32)
    return BedRequest(depth, level.grid.cell_m * stride, seeds, level.settings)


def sea_seeds(level: Level) -> tuple:
    """Points (x, y) that the level marks as sea."""
    return tuple(sorted((o.x, o.y) for o in level.objects.values() if isinstance(o, SeaSeed)))


def open_edge(shape: tuple[int, int], seeds: tuple, cell_m: float) -> np.ndarray:
    """Where the sea comes from if it is wet there: cells of the level's border, and seed points."""
    start = np.zeros(shape, bool)
    start[0], start[-1], start[:, 0], start[:, -1] = True, True, True, True
    for x, y in seeds:
        row, col = round(y / cell_m), round(x / cell_m)
        if 0 <= row < shape[0] and 0 <= col < shape[1]:
            start[row, col] = True
    return start


def _from_the_deep(depth: np.ndarray, start: np.ndarray, range_m: float) -> np.ndarray:
    """Bottleneck depth from the deep part of the border: where it cuts a beach, fronts come from the sea too."""
    if not start.any():
        return np.full(depth.shape, -np.inf, np.float32)
    deep = start & (depth >= min(range_m, 0.95 * float(depth[start].max())))
    least = bottleneck(np.where(deep, depth, -np.inf).astype(np.float32), depth)
    cut_off = start & ~(least > 0)  # water that only its own shallow border joins to the sea
    if cut_off.any():
        least = bottleneck(np.where(cut_off, depth, least).astype(np.float32), depth)
    return least


def _pack(settings: Settings, depth, least, cell_m: float) -> np.ndarray:
    """The four channels from depth and the bottleneck depth.

    The swash comes as far as the lowest way from the sea stays below the run-up: a tide pool behind a low rim is
    topped, a hollow inland stays still (D03).
    """
    limit = 1.1 * settings.shore.range_m * settings.shore.runup + 0.05
    packed = _packed(settings, depth, least, cell_m, limit)
    if settings.tide.on:
        sea = packed[..., 2] > 0
        high = _packed(settings, depth, least, cell_m, limit + band_m(settings)[1])
        packed = np.where(sea[..., None], packed, high)
        packed[..., 2] = _wakes(sea, depth, least, limit)
    return packed


def _packed(settings: Settings, depth, least, cell_m: float, limit: float) -> np.ndarray:
    shore = settings.shore
    reached = least > -limit
    clock = np.where(reached, least, depth) if shore.monotone else depth
    sigma = shore.smooth_m / cell_m
    if sigma > 0.05:
        smooth = ndimage.gaussian_filter(clock, sigma, mode="nearest", truncate=3)
        keep = np.clip(clock / 1.0, 0, 1)  # the true bed at the water line, so that lines and water meet there
        clock = clock + (smooth - clock) * keep * keep * (3 - 2 * keep)
    wide = ndimage.gaussian_filter(clock, max(ROCKS_M / cell_m, 0.3), mode="nearest", truncate=3)
    packed = np.zeros((*depth.shape, 4), np.float32)
    packed[..., 0], packed[..., 1], packed[..., 3] = clock, depth, wide
    packed[..., 2] = reached | _banks(reached, depth, limit)
    return packed


def _banks(reached, depth, limit_m: float) -> np.ndarray:
    """Land too high for the swash, right beside it: counted as sea, or a steep beach would wear the cells as teeth.

    Not where a hollow lies behind it that the sea doesn't reach.
    """
    high = depth <= -limit_m
    beside = ndimage.binary_dilation(reached, np.ones((3, 3), bool))
    return high & beside & ~ndimage.binary_dilation(~high & ~reached, np.ones((3, 3), bool))


def _wakes(sea, depth, least, limit_m: float) -> np.ndarray:
    """The tide over which each cell is sea: it is reached itself, or the bank of one that is; exact at tide 0.

    A bank that a hollow comes to lie behind at a higher tide stays one.
    """
    own = -np.float32(limit_m) - least
    bank = ndimage.minimum_filter(own, 3, mode="nearest")
    rows, cols = own.shape
    around_own, around_depth = (np.pad(values, 1, mode="edge") for values in (own, depth))
    hollow = np.zeros(own.shape, bool)
    for row, col in np.ndindex(3, 3):
        there = slice(row, row + rows), slice(col, col + cols)
        hollow |= (around_depth[there] > -limit_m - bank) & (around_own[there] > bank)
    wakes = np.where(hollow, own, bank)
    return np.where(sea, np.minimum(wakes, -1e-6), np.maximum(wakes, 0.0))


def _update(level: Level, have: ShoreMap, at: int) -> ShoreMap:
    """The map with the changed windows worked out again against what stands round them."""
    rows, cols = have.packed.shape[:2]
    margin = LIVE_MARGIN + math.ceil(3 * max(level.settings.shore.smooth_m, ROCKS_M) / have.cell_m)
    for rect in merge(rect.pad(1) for rect in level.changed_since("height", have.revision)):
        core = Rect(rect.row0 // have.stride, rect.col0 // have.stride,
                    -(-rect.row1 // have.stride) + 1, -(-rect.col1 // have.stride) + 1)  # fmt: skip
        window = core.pad(2 * margin).intersect(Rect(0, 0, rows, cols))
        fresh = core.pad(margin).intersect(Rect(0, 0, rows, cols))
        if not fresh.empty:
            _update_window(level, have, window, fresh)
            have.log.append((at, fresh))
    have.revision, have.whole = at, False
    return have


def _update_window(level: Level, have: ShoreMap, window: Rect, fresh: Rect) -> None:
    stride = have.stride
    ground = level.height[window.row0 * stride : window.row1 * stride : stride,
                          window.col0 * stride : window.col1 * stride : stride]  # fmt: skip
    packed, least = bed_in(level, have, window, level.mean_sea_m - ground.astype(np.float32))
    inner = fresh.shifted(window)
    have.packed[fresh.slices] = packed[inner.slices]
    have.bottleneck[fresh.slices] = least[inner.slices]


def bed_in(level: Level, have: ShoreMap, window: Rect, depth: np.ndarray, every: int = 1):
    """(packed, bottleneck) of a window of the map if its depth were this, against what stands round it.

    `depth` holds every `every`th sample of the window.
    """
    rim = np.ones(depth.shape, bool)
    rim[1:-1, 1:-1] = False
    skip = slice(None, None, every)
    known = have.bottleneck[window.slices][skip, skip]
    edge_of_level = np.zeros(have.packed.shape[:2], bool)
    edge_of_level[[0, -1]], edge_of_level[:, [0, -1]] = True, True
    outer = edge_of_level[window.slices][skip, skip] & (depth > 0)
    marker = np.where(rim, np.where(outer, depth, known), -np.inf).astype(np.float32)
    least = bottleneck(marker, depth)
    return _pack(level.settings, depth, least, have.cell_m * every), least
