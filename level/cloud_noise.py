"""The noises that shape clouds: three tiling textures made from a seed (Z01).

Shape, 128³: Perlin noise dilated by Worley noise, and three octaves of inverted Worley fBm. Detail, 32³: three such
octaves. Curl, 128²: a vector field without divergence. Arrays are uint8 `(z, y, x, channels)` or `(y, x, channels)`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .textures import spectral_noise

SEED = 7
SHAPE_SIDE, DETAIL_SIDE, CURL_SIDE = 128, 32, 128
OCTAVES = (0.625, 0.25, 0.125)  # weights of a fBm, each twice as fine as the one before
SHAPE_CELLS = (4, 8, 16)  # cells a tile of the coarsest octave of G, B and A
DETAIL_CELLS = (4, 8, 16)
PERLIN_CELLS = 4
PERLIN_OCTAVES = 5


def worley(side: int, cells: int, seed: int) -> np.ndarray:
    """Inverted cell noise (Worley 1996), 1 at the points and 0 far off: packed billows; float32 `(side,) * 3`."""
    rng = np.random.default_rng((seed, side, cells))
    points = rng.random((3, cells, cells, cells), np.float32)
    voxels = side // cells
    inside = (np.arange(voxels, dtype=np.float32) + 0.5) / voxels
    nearest = np.full((cells, cells, cells, voxels, voxels, voxels), 9.0, np.float32)
    for shift in np.ndindex(3, 3, 3):
        step = np.array(shift) - 1
        there = np.roll(points, tuple(-step), axis=(1, 2, 3))
        apart = [
            np.square((there[i] + np.float32(step[i]))[..., None] - inside) for i in range(3)
        ]  # each (cells, cells, cells, voxels)
        total = apart[0][..., :, None, None] + apart[1][..., None, :, None]
        np.minimum(nearest, total + apart[2][..., None, None, :], out=nearest)
    return 1 - np.minimum(np.sqrt(_cube(nearest, side)), 1)


def worley_fbm(side: int, cells: int, seed: int, cache: dict) -> np.ndarray:
    """Octaves of inverted cell noise from `cells` a tile on, as long as a cell has two voxels."""
    total, weights = np.zeros((side,) * 3, np.float32), 0.0
    for octave, weight in enumerate(OCTAVES):
        count = cells << octave
        if side // count < 2:
            break
        if count not in cache:
            cache[count] = worley(side, count, seed)
        total += np.float32(weight) * cache[count]
        weights += weight
    return total / np.float32(weights)


def perlin(side: int, cells: int, seed: int) -> np.ndarray:
    """Tiling gradient noise (Perlin 2002), about −1 … 1; float32 `(side,) * 3`."""
    rng = np.random.default_rng((seed, 1, cells))
    way = rng.standard_normal((3, cells, cells, cells)).astype(np.float32)
    way /= np.linalg.norm(way, axis=0)
    voxels = side // cells
    f = (np.arange(voxels, dtype=np.float32) + 0.5) / voxels
    fade = f * f * f * (f * (f * 6 - 15) + 10)
    total = np.zeros((cells, cells, cells, voxels, voxels, voxels), np.float32)
    for corner in np.ndindex(2, 2, 2):
        there = np.roll(way, tuple(-c for c in corner), axis=(1, 2, 3))
        weight = [fade if c else 1 - fade for c in corner]
        part = [there[i][..., None] * (f - corner[i]) for i in range(3)]
        slope = part[0][..., :, None, None] + part[1][..., None, :, None] + part[2][..., None, None, :]
        total += slope * (weight[0][:, None, None] * weight[1][None, :, None] * weight[2][None, None, :])
    return _cube(total, side)


def _cube(blocks: np.ndarray, side: int) -> np.ndarray:
    """`(cells, cells, cells, voxels, voxels, voxels)` put side by side, `(side,) * 3`."""
    return np.ascontiguousarray(blocks.transpose(0, 3, 1, 4, 2, 5)).reshape(side, side, side)


def _stretched(values: np.ndarray, low: float = 0.5, high: float = 99.5) -> np.ndarray:
    """Values spread so that all but the rarest fill 0 … 1."""
    bottom, top = np.percentile(values[::2, ::2, ::2] if values.ndim == 3 else values, (low, high))
    return np.clip((values - bottom) / (top - bottom), 0, 1)


def perlin_fbm(side: int, seed: int) -> np.ndarray:
    """Octaves of gradient noise, spread over 0 … 1."""
    total = sum(0.5**n * perlin(side, PERLIN_CELLS << n, seed) for n in range(PERLIN_OCTAVES))
    return _stretched(total)


def perlin_slice(seed: int = SEED, at: float = 0.37) -> np.ndarray:
    """uint8 `(128, 128, 1)`: the Perlin noise in the shape, at a height in tiles."""
    return _bytes(perlin_fbm(SHAPE_SIDE, seed)[int(at * SHAPE_SIDE)])


def shape_noise(seed: int = SEED) -> np.ndarray:
    """uint8 `(128, 128, 128, 4)`: Perlin-Worley and three Worley octaves, each twice as fine as the one before."""
    cache: dict = {}
    octaves = [_stretched(worley_fbm(SHAPE_SIDE, cells, seed, cache)) for cells in SHAPE_CELLS]
    connected = perlin_fbm(SHAPE_SIDE, seed)
    # the seed's talk: Worley fBm dilates Perlin noise, which keeps it connected and gives it billows
    dilated = _stretched(octaves[0] + connected * (1 - octaves[0]))
    return _bytes(dilated, *octaves)


def detail_noise(seed: int = SEED) -> np.ndarray:
    """uint8 `(32, 32, 32, 4)`: three octaves of inverted Worley noise; A is their fBm."""
    cache: dict = {}
    octaves = [_stretched(worley_fbm(DETAIL_SIDE, cells, seed + 101, cache)) for cells in DETAIL_CELLS]
    return _bytes(*octaves, sum(weight * octave for weight, octave in zip(OCTAVES, octaves, strict=True)))


def curl_field(seed: int = SEED) -> np.ndarray:
    """float64 `(128, 128, 3)`: the curl of a potential that doesn't change with height, deviation 1.

    The difference that makes it is the one that asks for its divergence, which is therefore zero.
    """
    flat, up = (spectral_noise(CURL_SIDE, 1000 * seed + n, 1.4, 2, 14) for n in (5, 6))
    east = (np.roll(flat, -1, 0) - np.roll(flat, 1, 0)) / 2
    north = -(np.roll(flat, -1, 1) - np.roll(flat, 1, 1)) / 2
    scale = np.sqrt((east**2 + north**2).mean() / 2)
    return np.stack([east / scale, north / scale, up], -1)


def curl_noise(seed: int = SEED) -> np.ndarray:
    """uint8 `(128, 128, 3)`: curl_field, ±3 deviations as 0 … 255."""
    return _bytes(*np.moveaxis(curl_field(seed) / 6 + 0.5, -1, 0))


def _bytes(*channels: np.ndarray) -> np.ndarray:
    return np.round(np.clip(np.stack(channels, -1), 0, 1) * 255).astype(np.uint8)


CLOUD_NOISES: dict[str, Callable[[int], np.ndarray]] = {
    "u_cloud_shape": shape_noise,
    "u_cloud_detail": detail_noise,
    "u_cloud_curl": curl_noise,
}
