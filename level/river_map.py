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
from .river_laid import near_line
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
CARRIED_CELLS = 4.0  # the level goes on so far past the rim of what is smoothed
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


def _lay(made: RiverMap, which: int, sea_m: float) -> None:
    """A river over what the map has there: where two meet, the one that a place is more inside of."""
    packed, line, cell_m = made.packed, made.lines[which], made.cell_m
    bank_m = BANK_CELLS * cell_m
    near = near_line(line, packed.shape[:2], cell_m, bank_m)
    i = near.nearest
    along_m, last = line.along_m[i] + near.ahead_m, len(line.x) - 1
    share = np.clip((line.half_m[i] + bank_m - near.off_m) / (bank_m - cell_m), 0, 1)  # it falls off under the bank
    share[(i == last) & (near.ahead_m > 0) | (i == 0) & (near.ahead_m < -bank_m)] = 0.0
    if line.mouth <= last:
        tail_m = line.along_m[-1] - line.along_m[line.mouth]
        share *= np.clip((line.along_m[-1] - along_m) / (0.4 * tail_m), 0, 1)
    fall = np.gradient(line.level_m, line.along_m)
    rough = np.clip((-fall - ROUGH_FALL[0]) / (ROUGH_FALL[1] - ROUGH_FALL[0]), 0, 1)
    level_m = line.level_m[i] + fall[i] * np.clip(near.ahead_m, -1, 1) - sea_m
    more = share > packed[near.row, near.col, 1]
    at = near.row[more], near.col[more]
    packed[at] = np.stack([level_m, share, along_m, -rough[i]], axis=-1)[more]
    made.owner[at] = which
    made.nearest[at] = i[more]


@dataclass(frozen=True)
class Painted:
    """Painted water on the map's samples, kept while nobody paints: share `(rows, cols)` and its level over zero, m."""

    key: tuple
    share: np.ndarray
    level_m: np.ndarray


def _painted(level: Level, stride: int) -> Painted | None:
    """Painted water whose level goes on under its banks as at the nearest painted place; None without any."""
    layers = [level.layers[name] for name in ("river_mask", "river_surface")]
    if layers[0].neutral:
        return None
    key = (*(level.layer_revision(data.row.name) for data in layers), stride)
    have = level.derived.get("painted_water")
    if have is None or have.key != key:
        mask, surface = (data.read(level.grid.rect)[::stride, ::stride] for data in layers)
        inside = mask > 0.5
        if not inside.any():
            return None
        away, (row, col) = ndimage.distance_transform_edt(~inside, return_indices=True)
        share = np.clip((1.5 * BANK_CELLS - away) / BANK_CELLS, 0, 1).astype(np.float32)
        have = level.derived["painted_water"] = Painted(key, share, surface[row, col])
    return have


def _paint(made: RiverMap, level: Level, stride: int) -> None:
    """Painted water over the rivers."""
    water = _painted(level, stride)
    if water is None:
        return
    packed = made.packed
    row, col = np.nonzero(water.share > 0)
    share, there = water.share[row, col], packed[row, col]
    more = share >= np.maximum(there[:, 1], 1e-6)
    row, col, share, there = row[more], col[more], share[more], there[more]
    alone = there[:, 1] < 0.5  # within a river it is that river's water
    made.owner[row[alone], col[alone]] = PAINTED
    there[:, 0] = water.level_m[row, col] - level.mean_sea_m
    there[:, 1], there[:, 3] = share, 0.0
    packed[row, col] = there


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
    level_m, own = np.ascontiguousarray(packed[..., 0]), packed[..., 1] > 0
    if not own.any():
        return
    weight = ndimage.gaussian_filter(own.astype(np.float32), SMOOTH_CELLS)
    stage = ndimage.gaussian_filter(np.where(own, level_m, np.float32(0)), SMOOTH_CELLS)
    near = weight > 1e-3
    stage /= np.maximum(weight, 1e-3)
    kept = np.nonzero(own & (falls > 0))
    stage[kept] += falls[kept] * (level_m[kept] - stage[kept])
    stage[~near] = 0.0
    away, (from_row, from_col) = ndimage.distance_transform_edt(~near, return_indices=True)
    row, col = np.nonzero((away > 0) & (away < CARRIED_CELLS))
    stage[row, col] = stage[from_row[row, col], from_col[row, col]]
    packed[..., 0] = stage
