"""Where water stands that isn't the sea, and how high: rivers along lines, and painted lakes and ponds (D13, H32).

river_map(level) -> RiverMap or None

Worked out on the CPU on the shore map's samples and sent to the GPU as a block above it, so that both know one water.
Over the sea it is joined by the higher of the two, rounded off: a rising tide drowns the lower river, and there is no
line where one ends.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from .dual import Dual
from .level import Level
from .objects import River
from .river_join import line_of, main_first, rivers, runs_to_sea
from .river_line import Line
from .shore import MOST_SIDE

CHANNELS = ("stage", "share", "along", "swell", "chop", "white", "rough")
JOIN_M = 0.12  # within so much of the sea's level a river goes over into it
BANK_CELLS = 3.0  # the water goes on so far under its banks
DROWNED_M = (0.02, 0.5)  # water so far over the sea carries all of its waves, none
NOBODY, PAINTED = -1, -2
CODE_STEPS, CODE_ONE = 511, 255  # 255 steps stand for waves as they are, or their share 1 would not be exact
ROUGH_FALL = (0.004, 0.06)  # slope of the water at which it is smooth, wholly rough
FALL = 0.2, 0.6  # slope of the water at which its edges begin to stay, stay sharp
SMOOTH_CELLS = 1.2  # sigma over which the level is even across the inside of a bend


@dataclass(frozen=True)
class RiverMap:
    """`packed` float32 `(rows, cols, 4)`, row 0 south: level of the water over the mean sea in m, share 0 … 1 of water
    of its own, metres along its way, and the code of what of the sea's waves comes there (`code_of_waves`).
    """

    packed: np.ndarray
    cell_m: float
    key: tuple
    lines: tuple[Line, ...] = ()
    owner: np.ndarray | None = None  # int16 `(rows, cols)`: which of the lines has it, PAINTED, NOBODY
    nearest: np.ndarray | None = None  # int32: which point of that line
    most_gain: float = 1.0  # how much higher the sea's waves get where they meet a river

    def at(self, x, y) -> dict[str, Dual]:
        """Bilinear values with gradients at world points (arrays), by channel; its border beyond the level."""
        rows, cols = self.packed.shape[:2]
        u, v = np.asarray(x) / self.cell_m, np.asarray(y) / self.cell_m
        ui, vi = np.clip(u, 0, cols - 1), np.clip(v, 0, rows - 1)
        col, row = np.minimum(ui.astype(np.int64), cols - 2), np.minimum(vi.astype(np.int64), rows - 2)
        fu, fv = (ui - col)[..., None], (vi - row)[..., None]
        v00, v10, v01, v11 = (self._texels(row + j, col + i) for j in (0, 1) for i in (0, 1))
        south, north = v00 + (v10 - v00) * fu, v01 + (v11 - v01) * fu
        value = south + (north - south) * fv
        dx = ((v10 - v00) * (1 - fv) + (v11 - v01) * fv) / self.cell_m * (u == ui)[..., None]
        dy = (north - south) / self.cell_m * (v == vi)[..., None]
        return {name: Dual(value[..., i], dx[..., i], dy[..., i]) for i, name in enumerate(CHANNELS)}

    def _texels(self, row, col) -> np.ndarray:
        texels = self.packed[row, col].astype(np.float64)
        return np.concatenate([texels[..., :3], np.stack(waves_of_code(texels[..., 3]), -1)], -1)

    @property
    def felt(self) -> np.ndarray:
        """Where there is any of it, or it does anything to the sea's waves: float32 `(rows, cols)`, 0 or 1."""
        as_they_are = code_of_waves(1.0, 1.0, 0.0, 0.0)
        return ((self.packed[..., 1] > 0) | (self.packed[..., 3] != as_they_are)).astype(np.float32)

    @property
    def wet(self) -> np.ndarray:
        """Where it is, bool `(rows, cols)`, whatever the ground."""
        return self.packed[..., 1] >= 0.5


def code_of_waves(swell, chop, white, rough) -> np.ndarray:
    """One float32 that holds swell and chop (× amplitude, 0 … 2, 9 bits each) and white (0 … 1, 6 bits); where there
    are neither waves nor white, −`rough`. It is undone by sample, before anything lies between two.
    """
    low, high = (np.rint(np.clip(v, 0, CODE_STEPS / CODE_ONE) * CODE_ONE) for v in (swell, chop))
    code = low + (CODE_STEPS + 1) * (high + (CODE_STEPS + 1) * np.rint(63 * np.clip(white, 0, 1)))
    return np.where(code > 0, code, -np.asarray(rough)).astype(np.float32)


def waves_of_code(code) -> tuple[np.ndarray, ...]:
    """(swell, chop, white, rough) of `code_of_waves`."""
    waves = np.maximum(code, 0.0)
    above = np.floor(waves / (CODE_STEPS + 1))
    white = np.floor(above / (CODE_STEPS + 1))
    swell, chop = waves - above * (CODE_STEPS + 1), above - white * (CODE_STEPS + 1)
    return swell / CODE_ONE, chop / CODE_ONE, white / 63, np.maximum(-code, 0.0)


def has_rivers(level: Level) -> bool:
    """Whether any water isn't the sea."""
    return level.settings.river.on and (bool(rivers(level)) or not level.layers["river_mask"].neutral)


def river_map(level: Level) -> RiverMap | None:
    """The level's map, kept until something that it follows from changes; None where all water is the sea."""
    from .river_mouth import with_waves  # which follows from the shape

    return with_waves(level) if has_rivers(level) else None


def river_shape(level: Level) -> RiverMap | None:
    """The same before the sea's waves meet it: level, share and way of the water alone."""
    if not has_rivers(level):
        return None
    painted = tuple(level.layer_revision(name) for name in ("river_mask", "river_surface"))
    lines = tuple(rivers(level))
    to_sea = tuple(runs_to_sea(level, river) for river in lines)
    key = (id(level.layers["height"]), lines, painted, level.mean_sea_m, to_sea)
    have = level.derived.get("river_shape")
    if have is None or have.key != key:
        have = level.derived["river_shape"] = _made(level, lines, key)
    return have


def _made(level: Level, lines: tuple[River, ...], key: tuple) -> RiverMap:
    stride = max(1, math.ceil((max(level.grid.shape) - 1) / (MOST_SIDE - 1)))
    cell_m = level.grid.cell_m * stride
    shape = level.height[::stride, ::stride].shape
    packed = np.zeros((*shape, 4), np.float32)
    packed[..., 0] = -1e3
    dense = tuple(line_of(level, river, min(cell_m, 1.0)) for river in lines)
    made = RiverMap(packed, cell_m, key, dense, np.full(shape, NOBODY, np.int16), np.zeros(shape, np.int32))
    for which in main_first(lines):
        _lay(made, which, level.mean_sea_m)
    _paint(made, level, stride)
    _even(packed, _falls(made))
    return made


@dataclass
class Laid:
    """A line on a window of a grid: what the nearest of its points is `(rows, cols)`, and how far away.

    `near`: within reach of it; elsewhere the rest means nothing.
    """

    rows: slice
    cols: slice
    nearest: np.ndarray
    off_m: np.ndarray  # metres across
    ahead_m: np.ndarray  # metres along, beyond that point
    near: np.ndarray


def along(line: Line, shape: tuple[int, int], cell_m: float, beyond_m: float) -> Laid:
    """Where the samples of a grid lie along a line, up to `beyond_m` past its width."""
    from scipy.spatial import cKDTree

    reach = float(line.half_m.max()) + beyond_m
    low = [int(np.clip((v.min() - reach) // cell_m, 0, n)) for v, n in zip((line.y, line.x), shape, strict=True)]
    high = [int(np.clip((v.max() + reach) // cell_m + 2, 0, n)) for v, n in zip((line.y, line.x), shape, strict=True)]
    rows, cols = (slice(a, max(b, a)) for a, b in zip(low, high, strict=True))
    y, x = np.mgrid[rows, cols] * cell_m
    nearest, off_m, ahead_m = np.zeros(y.shape, np.int64), np.full(y.shape, np.inf), np.zeros(y.shape)
    near = _near(line, y, x, cell_m, reach)
    off_m[near], nearest[near] = cKDTree(np.stack([line.x, line.y], -1)).query(np.stack([x[near], y[near]], -1))
    near &= off_m <= line.half_m[nearest] + beyond_m
    way = np.stack([np.gradient(line.x), np.gradient(line.y)])
    way /= np.maximum(np.hypot(*way), 1e-9)
    ahead_m[near] = ((x - line.x[nearest]) * way[0][nearest] + (y - line.y[nearest]) * way[1][nearest])[near]
    return Laid(rows, cols, nearest, off_m, ahead_m, near)


def _near(line: Line, y: np.ndarray, x: np.ndarray, cell_m: float, reach: float) -> np.ndarray:
    """Which samples may lie within reach of the line: only those are asked for the nearest point."""
    near = np.zeros(y.shape, bool)
    if near.size:
        row = np.clip(((line.y - y[0, 0]) / cell_m).astype(int), 0, y.shape[0] - 1)
        col = np.clip(((line.x - x[0, 0]) / cell_m).astype(int), 0, y.shape[1] - 1)
        near[row, col] = True
        near = ndimage.distance_transform_edt(~near) <= reach / cell_m + 2
    return near


def _lay(made: RiverMap, which: int, sea_m: float) -> None:
    """A river over what the map has there: where two meet, the one that a place is more inside of."""
    packed, line, cell_m = made.packed, made.lines[which], made.cell_m
    bank_m = BANK_CELLS * cell_m
    laid = along(line, packed.shape[:2], cell_m, bank_m)
    i, here = laid.nearest, packed[laid.rows, laid.cols]
    along_m, last = line.along_m[i] + laid.ahead_m, len(line.x) - 1
    share = np.clip((line.half_m[i] + bank_m - laid.off_m) / (bank_m - cell_m), 0, 1)  # it falls off under the bank
    share[(i == last) & (laid.ahead_m > 0) | (i == 0) & (laid.ahead_m < -bank_m)] = 0.0
    if line.mouth <= last:
        tail_m = line.along_m[-1] - line.along_m[line.mouth]
        share *= np.clip((line.along_m[-1] - along_m) / (0.4 * tail_m), 0, 1)
    fall = np.gradient(line.level_m, line.along_m)
    rough = np.clip((-fall - ROUGH_FALL[0]) / (ROUGH_FALL[1] - ROUGH_FALL[0]), 0, 1)
    level_m = line.level_m[i] + fall[i] * np.clip(laid.ahead_m, -1, 1) - sea_m
    more = share > here[..., 1]
    for channel, values in enumerate((level_m, share, along_m, -rough[i])):
        here[..., channel][more] = values[more]
    made.owner[laid.rows, laid.cols][more] = which
    made.nearest[laid.rows, laid.cols][more] = i[more]


def _paint(made: RiverMap, level: Level, stride: int) -> None:
    """Painted water over the rivers; its level goes on under its banks as at the nearest painted place."""
    packed = made.packed
    if level.layers["river_mask"].neutral:
        return
    mask, surface = (level.layers[name].read(level.grid.rect)[::stride, ::stride] for name in
                     ("river_mask", "river_surface"))  # fmt: skip
    inside = mask > 0.5
    if not inside.any():
        return
    away, (row, col) = ndimage.distance_transform_edt(~inside, return_indices=True)
    share = np.clip((1.5 * BANK_CELLS - away) / BANK_CELLS, 0, 1)
    more = share >= np.maximum(packed[..., 1], 1e-6)
    made.owner[more & (packed[..., 1] < 0.5)] = PAINTED  # within a river it is that river's water
    packed[..., 0] = np.where(more, surface[row, col] - level.mean_sea_m, packed[..., 0])
    packed[..., 1] = np.where(more, share, packed[..., 1])
    packed[..., 3] = np.where(more, 0.0, packed[..., 3])


def _falls(made: RiverMap) -> np.ndarray:
    """Where water drops steeply, 0 … 1 `(rows, cols)`."""
    steep = np.zeros(made.owner.shape, np.float32)
    for which, line in enumerate(made.lines):
        fall = ndimage.maximum_filter1d(-np.gradient(line.level_m, line.along_m), 5)
        own = made.owner == which
        steep[own] = np.clip((fall[made.nearest[own]] - FALL[0]) / (FALL[1] - FALL[0]), 0, 1)
    return steep


def _even(packed: np.ndarray, falls: np.ndarray) -> None:
    """The level a little smoothed within the water but for the edge of falls (0 … 1), then carried on past its rim, so
    that no filter meets a hole.
    """
    own = packed[..., 1] > 0
    if not own.any():
        return
    weight = ndimage.gaussian_filter(own.astype(np.float32), SMOOTH_CELLS)
    stage = ndimage.gaussian_filter(np.where(own, packed[..., 0], 0).astype(np.float32), SMOOTH_CELLS)
    near = weight > 1e-3
    kept = np.where(own, falls, 0.0)
    stage = stage / np.maximum(weight, 1e-3)
    packed[..., 0] = np.where(near, stage + kept * (packed[..., 0] - stage), 0.0)
    away, (row, col) = ndimage.distance_transform_edt(~near, return_indices=True)
    packed[..., 0] = np.where(away < 4, packed[row, col, 0], 0.0)
    packed[..., 3] = np.where(own, packed[..., 3], np.where(away < 4, packed[row, col, 3], 0.0))
