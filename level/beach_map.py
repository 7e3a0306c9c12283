"""What the sea knows of the beach: the sand its sheet slides on (H10) and the sway of its waves along the shore (H20).

Both are made from the shore field, a texel each, and kept as half floats: the twin and the shader read one array. A
change is worked out again in its window only, to the bits of the whole map, so it is the same live and settled.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from scipy import ndimage

from .dual import Dual
from .grid import Rect
from .level import Level
from .request import Parts, finished
from .shore_field import BAND, BEACH_M, ShoreField, decode_beach_m, direction, shore_field

BANDS = 2  # of the field, worked out at once
BENEATH_M = 1 / 256  # under the sand, so that half floats never lift the sheet above it
NO_BEACH_M = -64.0  # where the slice ends there is no clamp
SMOOTH_M = 3.0  # sigma; where two shores are as near as each other the sway would jump
TRUNCATE = 3.0
FADE = 0.5  # share of the field's range over which the sway dies out
TURNS = ((0.7, 0.7071, 0.7071), (0.4326, 0.7071, -0.7071))  # lengths against sway_m, in the golden ratio; ways


@dataclass
class BeachMap:
    """`packed` float16 `(rows, cols, 2)`, texels at vertices: sand over the still sea in metres, sway −1 … 1."""

    packed: np.ndarray
    cell_m: float
    source: ShoreField
    key: tuple
    revision: int = 0
    log: deque = field(default_factory=lambda: deque(maxlen=64))
    work: Parts | None = None  # the change that is being worked out

    def changed_since(self, revision: int) -> list[Rect]:
        """Rectangles of `packed` that changed after that revision of the map."""
        if not self.log or revision < self.log[0][0] - 1:
            return [Rect(0, 0, *self.packed.shape[:2])]
        return [rect for at, rect in self.log if at > revision]

    def at(self, x, y) -> tuple[Dual, Dual]:
        """Sand and sway at world points (arrays), bilinear with gradients; beyond the level that of its border."""
        rows, cols = self.packed.shape[:2]
        u, v = np.asarray(x) / self.cell_m, np.asarray(y) / self.cell_m
        ui, vi = np.clip(u, 0, cols - 1), np.clip(v, 0, rows - 1)
        col, row = np.minimum(ui.astype(np.int64), cols - 2), np.minimum(vi.astype(np.int64), rows - 2)
        fu, fv = (ui - col)[..., None], (vi - row)[..., None]
        v00, v10 = (self.packed[row, col + i].astype(np.float64) for i in (0, 1))
        v01, v11 = (self.packed[row + 1, col + i].astype(np.float64) for i in (0, 1))
        south, north = v00 + (v10 - v00) * fu, v01 + (v11 - v01) * fu
        value = south + (north - south) * fv
        dx = ((v10 - v00) * (1 - fv) + (v11 - v01) * fv) / self.cell_m * (u == ui)[..., None]
        dy = (north - south) / self.cell_m * (v == vi)[..., None]
        value[..., 0] = np.where((u == ui) & (v == vi), value[..., 0], NO_BEACH_M)
        return tuple(Dual(value[..., i], dx[..., i], dy[..., i]) for i in (0, 1))


def beach_map(level: Level) -> BeachMap:
    """The level's map, up to date with its shore field; where an editor lends its frames it follows in some of them."""
    source, key = shore_field(level), (level.settings.shore.sway_m,)
    have: BeachMap | None = level.derived.get("beach_map")
    every = Rect(0, 0, *source.packed.shape[:2])
    if have is None or have.source is not source or have.key != key:
        packed = np.empty((*every.shape, 2), np.float16)
        have = level.derived["beach_map"] = BeachMap(packed, source.cell_m, source, key)
        finished(_update(level, have, [every]))
        return have
    while have.work is not None or have.revision != source.revision:
        have.work = have.work or _update(level, have)
        if level.solver is None:
            finished(have.work)
        elif not level.solver.in_parts("beach_map", have.work):
            break
        have.work = None
    return have


def _update(level: Level, have: BeachMap, changed: list[Rect] | None = None) -> Iterator[None]:
    """Work out what changed of the field; what changes meanwhile is in the next update."""
    source, at = have.source, have.source.revision
    every = Rect(0, 0, *source.packed.shape[:2])
    for rect in changed or source.changed_since(have.revision):
        wide = rect.pad(_reach(have)).intersect(every)
        for band in _bands(wide):
            sand = band.intersect(rect)
            if not sand.empty:
                have.packed[(*sand.slices, 0)] = _sand(level, source, sand)
            have.packed[(*band.slices, 1)] = _sway(source, band, have.key[0])
            yield
        have.log.append((at, wide))
    have.revision = at


def _bands(rect: Rect) -> list[Rect]:
    """A rectangle cut into rows of bands, so that no part of a work takes long."""
    return [
        rect.intersect(Rect(row, rect.col0, row + BANDS * BAND, rect.col1))
        for row in range(rect.row0, rect.row1, BANDS * BAND)
    ]


def _reach(have: BeachMap) -> int:
    return math.ceil(TRUNCATE * SMOOTH_M / have.cell_m) + 1


def _sand(level: Level, source: ShoreField, rect: Rect) -> np.ndarray:
    """The slice at the lower edge of its quantum, never above the ground; NO_BEACH_M outside ±BEACH_M.

    The slice is smooth: in the corner below a cliff it runs above the ground, and would hold the water off it.
    """
    lower = (decode_beach_m(np.arange(256)) - BEACH_M / 256 - BENEATH_M).astype(np.float32)
    lower[[0, 255]] = NO_BEACH_M
    sand = lower[source.packed[(*rect.slices, 3)]]
    return np.minimum(sand, source.ground(level, rect) - np.float32(BENEATH_M))


def _sway(source: ShoreField, rect: Rect, length_m: float) -> np.ndarray:
    """Two cosines of the nearest point of the shoreline: across the beach they stay, along it they turn (H20)."""
    every, reach = Rect(0, 0, *source.packed.shape[:2]), math.ceil(TRUNCATE * SMOOTH_M / source.cell_m) + 1
    wide = rect.pad(reach + 1).intersect(every)
    distance = source.distance_m[wide.slices]
    east, north = direction(distance, source.cell_m) * distance
    x = (np.arange(wide.col0, wide.col1, dtype=np.float32) * np.float32(source.cell_m))[None] + east
    y = (np.arange(wide.row0, wide.row1, dtype=np.float32) * np.float32(source.cell_m))[:, None] + north
    waves = [
        np.float32(2 * np.pi / (part * length_m)) * (np.float32(a) * x + np.float32(b) * y) for part, a, b in TURNS
    ]
    sway = sum(np.cos(wave) for wave in waves) / np.float32(len(TURNS))
    near = np.clip((1 - np.abs(distance) / source.range_m) / FADE, 0, 1)
    sway = (sway * (near * near * (3 - 2 * near))).astype(np.float32)
    smooth = ndimage.gaussian_filter(sway, SMOOTH_M / source.cell_m, mode="nearest", truncate=TRUNCATE)
    return smooth[rect.shifted(wide).slices]
