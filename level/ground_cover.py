"""Which material lies where: the rule of `shaders/lib/ground.glsl` of the renderer in NumPy (L05), for exports.

`cover_weights` gives the eight weights that the renderer makes pictures of, before the heaviest meet by height. The
painted layer `cover` overrides the rule as it does there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from .ground_materials import MATERIALS
from .level import Level
from .open_sky import WAYS, open_sky
from .textures import noise_texture

SAND, SHINGLE, STRATA, REEF, GRASS, DUNE, FLOOR, WEED = range(len(MATERIALS))
WIDE_EDGE = 0.45  # half the width of the border between two patches of noise
TORN_M = 9.0  # tile of the noise that tears painted borders
BESIDE_M = 0.56  # at most, where the open sky is read: 0.8 of 1.4 / 2


def cover_weights(level: Level, rows: np.ndarray, cols: np.ndarray, pixel_m: float, ways: int = WAYS) -> np.ndarray:
    """Float64 `(rows, cols, 8)` at those samples of the level: the weight of each of MATERIALS, which sum to 1.

    `pixel_m` is the size of what a sample stands for: finer noise is left out. `ways`: of `open_sky`.
    """
    cell_m = level.grid.cell_m
    x, y = np.meshgrid(cols * cell_m, rows * cell_m)
    torn = (noise_at(x, y, TORN_M, pixel_m)[..., 1:3] - 0.5) * 1.4
    cover = _layer_at(level.layers["cover"], cell_m, x + torn[..., 0], y + torn[..., 1])
    return weights_of(level, site_at(level, rows, cols, (x, y), torn, pixel_m, ways), cover)


@dataclass(frozen=True)
class Site:
    """What is known of places before their materials are chosen, arrays of one shape."""

    rise: np.ndarray
    height: np.ndarray  # over the still sea
    rough: np.ndarray
    open: np.ndarray
    broad: np.ndarray  # noise, `(…, 4)`
    mid: np.ndarray

    @property
    def ragged(self) -> np.ndarray:
        """About −0.5 … 0.5."""
        return (self.mid[..., 1] - 0.5) * 0.55 + (self.mid[..., 2] - 0.5) * 0.35 + (self.broad[..., 0] - 0.5) * 0.5


def site_at(level: Level, rows, cols, at, torn, pixel_m: float, ways: int) -> Site:
    (x, y), cell_m = at, level.grid.cell_m
    wide = _wide_patch(x, y, pixel_m)
    broad = _free_noise(*_turn(x, y, 0.43, 0.903), 173.0, pixel_m, wide)
    mid = _free_noise(*_turn(x, y, -0.31, 0.951), 31.0, pixel_m, wide)
    reach = slice(max(rows[0] - 2, 0), min(rows[-1] + 3, level.grid.rows))
    slopes = np.gradient(level.height[reach].astype(np.float64), cell_m)
    north, east = (slope[np.ix_(rows - reach.start, cols)] for slope in slopes)
    rise = np.minimum(np.hypot(north, east), 20.0)
    seen = _sky(level, rows, cols, (x + 0.8 * torn[..., 0], y + 0.8 * torn[..., 1]), ways)
    east_m, north_m = level.grid.extent_m
    inside = np.minimum.reduce([x, y, east_m - x, north_m - y])
    rough = seen[..., 1] * _smoothstep(9.0, 14.0, inside)
    height = level.height[np.ix_(rows, cols)].astype(np.float64) - level.mean_sea_m
    return Site(rise, height, rough, seen[..., 0], broad, mid)


def _sky(level: Level, rows, cols, at, ways: int) -> np.ndarray:
    """Open sky and roughness, read beside samples as painted borders are; at them where only some are asked for."""
    cell_m = level.grid.cell_m
    if any(len(n) > 1 and n[1] - n[0] > 1 for n in (rows, cols)):
        return np.stack(open_sky(level.height, cell_m, rows, cols, ways), -1)
    room = math.ceil(BESIDE_M / cell_m) + 1
    wide = [np.arange(max(n[0] - room, 0), min(n[-1] + room + 1, most)) for n, most in
            ((rows, level.grid.rows), (cols, level.grid.cols))]  # fmt: skip
    sky = np.stack(open_sky(level.height, cell_m, *wide, ways), -1)
    return _bilinear(sky, at[0] / cell_m - wide[1][0], at[1] / cell_m - wide[0][0])


def weights_of(level: Level, s: Site, cover: np.ndarray) -> np.ndarray:
    ground, h, ragged, rise = level.settings.ground, s.height, s.ragged, s.rise
    rock_slope, grass_slope = (math.tan(math.radians(deg)) for deg in (ground.rock_slope_deg, ground.grass_slope_deg))
    sand, painted_rock, painted_grass = (cover[..., i] for i in range(3))
    rock = _smoothstep(0.85, 1.25, rise / rock_slope + 0.5 * ragged)
    steep = _smoothstep(0.95, 1.45, rise / grass_slope + 0.7 * ragged)
    dry_land = _smoothstep(-1.0, 1.0, (h - ground.sand_top_m) / 0.9 + 2.2 * ragged)
    grass = dry_land * (1 - steep)
    rock = np.maximum(rock, dry_land * steep)
    # flat but broken ground by the sea is a reef, not a beach
    rock = np.maximum(rock, _smoothstep(0.085, 0.17, s.rough + 0.02 * ragged) * (1 - dry_land))
    rock = (rock + (1 - rock) * painted_rock) * (1 - np.maximum(sand, painted_grass))
    grass = grass * (1 - sand)
    grass = grass + (1 - grass) * painted_grass
    cliff = _smoothstep(0.34, 0.58, rise + 0.25 * ragged)
    seaward = 1 - _smoothstep(0.6, 3.4, h - ground.sand_top_m + 3.5 * ragged)
    seaward = seaward * (1 - _smoothstep(0.5, 0.9, rise))
    bed = -h + 0.3 * ragged
    weights = np.zeros((*h.shape, len(MATERIALS)))
    weights[..., SAND] = 1
    for layer, share in (
        (FLOOR, _smoothstep(0.1, 0.7, bed) * (1 - sand)),
        (SHINGLE, np.where(h > -1, _shingle(level, s) * (1 - sand), 0)),
        (GRASS, grass * (1 - seaward)),
        (DUNE, grass * seaward),
        (STRATA, rock * cliff),
        (REEF, rock * (1 - cliff)),
        (WEED, np.where(bed > 0.2, _weed(ground.weed, s, bed, rock) * (1 - sand), 0)),
    ):
        weights *= 1 - share[..., None]
        weights[..., layer] += share
    return weights


def _shingle(level: Level, s: Site) -> np.ndarray:
    """Pebbles where the swash ends and at the feet of cliffs."""
    amount, sand_top_m = level.settings.ground.shingle, level.settings.ground.sand_top_m
    top, h = max(level.settings.shore.range_m * level.settings.shore.runup, 0.2), s.height + 0.4 * s.ragged
    swash = _smoothstep(0.30 * top, 0.80 * top, h) * (1 - _smoothstep(1.15 * top, 1.8 * top + 0.2, h))
    swash = swash * _patches(0.55 * s.broad[..., 0] + 0.30 * s.broad[..., 1] + 0.15 * s.mid[..., 0], amount, 0.10)
    foot = (1 - _smoothstep(0.84, 0.94, s.open + 0.14 * s.ragged)) * _smoothstep(-0.9, 0.2, s.height)
    foot = foot * (1 - _smoothstep(sand_top_m, sand_top_m + 3.0, h)) * min(2 * amount, 1.0)
    return np.maximum(swash, foot) * (1 - _smoothstep(0.45, 0.8, s.rise))


def _weed(amount: float, s: Site, bed: np.ndarray, rock: np.ndarray) -> np.ndarray:
    """Meadows on the bed, and tufts on rock under water."""
    field = 0.60 * s.broad[..., 0] + 0.24 * s.broad[..., 1] + 0.16 * s.mid[..., 1]
    deep = 1 - _smoothstep(12.0, 18.0, bed)
    meadow = _patches(field, 0.62 * amount, 0.14) * _smoothstep(1.6, 3.2, bed) * deep
    on_rock = _patches(0.5 * s.mid[..., 0] + 0.5 * s.mid[..., 1], amount, 0.14) * _smoothstep(0.2, 0.8, bed) * deep
    return meadow + (on_rock - meadow) * rock


def _patches(field: np.ndarray, amount: float, edge: float) -> np.ndarray:
    """Where a patchy thing lies: noise spread evenly over 0 … 1 above what leaves `amount` of it."""
    return _smoothstep(-edge, edge, field - (0.86 + (0.14 - 0.86) * amount)) * (amount >= 1e-4)


def _smoothstep(low: float, high: float, x: np.ndarray) -> np.ndarray:
    t = np.clip((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3 - 2 * t)


# Noise as lib/noise.glsl and lib/ground_layers.glsl read it


@lru_cache(maxsize=1)
def noise_levels() -> tuple[np.ndarray, ...]:
    """The noise texture and its mip levels, uint8, each the mean of four of the one before."""
    levels = [noise_texture()]
    while len(levels[-1]) > 1:
        fine = levels[-1].astype(np.uint16)
        levels.append(
            ((fine[::2, ::2] + fine[1::2, ::2] + fine[::2, 1::2] + fine[1::2, 1::2] + 2) // 4).astype(np.uint8)
        )
    return tuple(levels)


def noise_at(x: np.ndarray, y: np.ndarray, tile_m: float, pixel_m: float) -> np.ndarray:
    """`(…, 4)` in 0 … 1 of the mip level that a pixel of that size sees."""
    levels = noise_levels()
    lod = math.log2(max(pixel_m * len(levels[0]) / tile_m, 1e-4))
    texels = levels[min(max(math.ceil(lod - 0.5), 0), len(levels) - 1)]
    size = len(texels)
    u, v = x / tile_m * size - 0.5, y / tile_m * size - 0.5
    col, row = np.floor(u), np.floor(v)
    fu, fv = (u - col)[..., None], (v - row)[..., None]
    col, row = col.astype(np.int64) % size, row.astype(np.int64) % size
    east, north = (col + 1) % size, (row + 1) % size
    south = texels[row, col] * (1 - fu) + texels[row, east] * fu
    return (south * (1 - fv) + (texels[north, col] * (1 - fu) + texels[north, east] * fu) * fv) / 255


def _turn(x, y, sine: float, cosine: float) -> tuple[np.ndarray, np.ndarray]:
    return cosine * x - sine * y, sine * x + cosine * y


def _wide_patch(x, y, pixel_m: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Shifts of the two nearest patches, in tiles, and the share of the other."""
    place = 12.0 * noise_at(*_turn(x, y, -0.66, 0.751), 877.0, min(pixel_m, 2.0))[..., 0]
    index = np.floor(place).astype(np.float32)
    one, other = (_shift(index + np.float32(i)) for i in (0, 1))
    return one, other, _smoothstep(0.5 - WIDE_EDGE, 0.5 + WIDE_EDGE, place - index)


def _shift(index: np.ndarray) -> np.ndarray:
    """In single precision as on the GPU: the sine of a large number, times many, has no more digits."""
    sine = np.sin(
        np.stack([index * np.float32(12.99) + np.float32(1.7), index * np.float32(78.23) + np.float32(4.1)], -1)
    )
    return np.mod(sine * np.float32(43.7), np.float32(1.0)).astype(np.float64)


def _free_noise(x, y, tile_m: float, pixel_m: float, patch) -> np.ndarray:
    """Noise without a period: two shifts of it, blended so that its contrast stays (Heitz & Neyret 2018)."""
    one, other, share = patch
    here, there = (noise_at(x + by[..., 0] * tile_m, y + by[..., 1] * tile_m, tile_m, pixel_m) for by in (one, other))
    share = share[..., None]
    mixed = here + (there - here) * share - 0.5
    return np.clip(0.5 + mixed / np.sqrt(1 - 2 * share * (1 - share)), 0.0, 1.0)


def _layer_at(layer, cell_m: float, x, y) -> np.ndarray:
    """A painted layer at world metres, mirrored beyond the border as the ground is."""
    if layer.neutral:
        return np.zeros((*np.shape(x), len(layer.row.channels)))
    rows, cols = layer.array.shape[:2]
    u, v = ((n - 1) - np.abs((n - 1) - np.abs(at / cell_m)) for at, n in ((x, cols), (y, rows)))
    return _bilinear(layer.array, u, v)


def _bilinear(values: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """`(rows, cols, channels)` at fractional columns and rows, held at its border."""
    rows, cols = values.shape[:2]
    u, v = np.clip(u, 0, cols - 1), np.clip(v, 0, rows - 1)
    col, row = np.minimum(u.astype(np.int64), cols - 2), np.minimum(v.astype(np.int64), rows - 2)
    fu, fv = (u - col)[..., None], (v - row)[..., None]
    south = values[row, col] * (1 - fu) + values[row, col + 1] * fu
    return south * (1 - fv) + (values[row + 1, col] * (1 - fu) + values[row + 1, col + 1] * fu) * fv
