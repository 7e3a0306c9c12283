"""The bed as the waves know it: depth, sea mask and the monotone depth that the shore clock reads (D03).

Derived from height, sea level and a few settings; cached by revision, never saved. While a step is open only the window
that changed is worked out again, so the sea answers in the next frame; when it closes the whole map is made anew, so
that a settled picture depends on the level alone.
"""

from __future__ import annotations

import functools
import math
from collections import deque
from dataclasses import dataclass, field

import numpy as np

from .bottleneck import bottleneck, falling
from .dual import Dual, step
from .grid import Rect
from .level import Level, merge
from .objects import SeaSeed
from .shore_bed import ROCKS_M, Bed, BedRequest, pack, toll_of
from .tide import band_m

MOST_SIDE = 1025  # samples a side: larger levels are read with a stride
LIVE_MARGIN = 24  # cells round a change that are worked out with it
BEYOND_M = 80.0  # how far past the level's border shore waves go on: there the bed is only a guess
CHANNELS = ("clock", "depth", "sea", "smoothed")


@dataclass
class ShoreMap:
    """`packed` is float32 `(rows, cols, 4)`, row 0 south: clock depth, depth, sea 0 … 1, clock without rocks; m.

    Depths are those at mean sea level. Where the sea has a tide (`tidal`) the third channel holds the tide over which
    a cell is sea, and clock depths of cells that only high water reaches are those of high water.
    """

    packed: np.ndarray
    bottleneck: np.ndarray  # least depth on the way from the sea, before smoothing
    falling: np.ndarray  # the same less the toll on flats: what the clock reads
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


def shore_map(level: Level, now: bool = False) -> ShoreMap:
    """The level's map, up to date with its height; worked out in the changed window only while a step is open.

    Where an editor lends a process, it stays as it is till that has the whole of it; `now`: nothing but the whole will
    do.
    """
    shore = level.settings.shore
    seeds = sea_seeds(level)
    tide = (level.settings.tide.on, band_m(level.settings)[1])
    key = (level.mean_sea_m, shore.range_m, shore.runup, shore.monotone, shore.smooth_m, seeds, tide,
           toll_of(level.settings))  # fmt: skip
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
    made = ShoreMap(bed.packed, bed.bottleneck, bed.falling, level.grid.cell_m * stride, stride, at, key)
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
    bed = bed_in(level, have, window, level.mean_sea_m - ground.astype(np.float32))
    inner = fresh.shifted(window)
    for kept, made in ((have.packed, bed.packed), (have.bottleneck, bed.bottleneck), (have.falling, bed.falling)):
        kept[fresh.slices] = made[inner.slices]


def bed_in(level: Level, have: ShoreMap, window: Rect, depth: np.ndarray, every: int = 1) -> Bed:
    """A window of the map if its depth were this, against what stands round it.

    `depth` holds every `every`th sample of the window.
    """
    rim = np.ones(depth.shape, bool)
    rim[1:-1, 1:-1] = False
    skip = slice(None, None, every)
    known, fell = (values[window.slices][skip, skip] for values in (have.bottleneck, have.falling))
    edge_of_level = np.zeros(have.packed.shape[:2], bool)
    edge_of_level[[0, -1]], edge_of_level[:, [0, -1]] = True, True
    outer = edge_of_level[window.slices][skip, skip] & (depth > 0)
    least = bottleneck(np.where(rim, np.where(outer, depth, known), -np.inf).astype(np.float32), depth)
    cell_m, toll, fallen = have.cell_m * every, toll_of(level.settings), least
    if toll is not None:
        marker = np.where(outer & ~(fell > 0), depth, fell)
        fallen = falling(np.where(rim, marker, -np.inf).astype(np.float32), least, cell_m, toll)
    return Bed(pack(level.settings, depth, least, fallen, cell_m), least, fallen)
