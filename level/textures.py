"""Seeded tiling textures: noise, ripples, foam. Shader, twin, brushes and exporters share these arrays.

Everything tiles on both axes, is made once from a seed and holds no file. Arrays are `(rows, cols, channels)`.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from .tiling import smooth

SIZE = 512
CAUSTICS_MEAN = 48  # of 255: lines are up to five times as bright as the mean


def spectral_noise(size: int, seed: int, falloff: float, low: float = 1.0, high: float | None = None) -> np.ndarray:
    """Tiling Gaussian noise, amplitude `f ** -falloff` between `low` and `high` cycles; mean 0, deviation 1."""
    rng = np.random.default_rng(seed)
    spectrum = np.fft.rfft2(rng.standard_normal((size, size)))
    frequency = np.hypot(*np.meshgrid(np.fft.fftfreq(size, 1 / size), np.fft.rfftfreq(size, 1 / size), indexing="ij"))
    weight = np.where((frequency >= low) & (frequency <= (high or size)), np.maximum(frequency, 1.0) ** -falloff, 0.0)
    noise = np.fft.irfft2(spectrum * weight, (size, size))
    return noise / noise.std()


def worley(size: int, cells: int, seed: int, warp: tuple[np.ndarray, np.ndarray] | None = None) -> tuple:
    """Tiling cell noise (Worley 1996): distances to the nearest and second feature point in cells, and a cell number.

    `warp` moves the places that are asked, in tiles.
    """
    rng = np.random.default_rng(seed)
    points = rng.random((cells, cells, 2)) * 0.9 + 0.05
    number = rng.random((cells, cells))
    axis = np.arange(size) / size
    y, x = np.meshgrid(axis, axis, indexing="ij")
    if warp is not None:
        x, y = x + warp[0], y + warp[1]
    x, y = x * cells, y * cells
    column, row = np.floor(x).astype(int), np.floor(y).astype(int)
    first = np.full((size, size), 9.0)
    second = first.copy()
    nearest = np.zeros((size, size))
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            r, c = (row + dy) % cells, (column + dx) % cells
            distance = np.hypot(column + dx + points[r, c, 0] - x, row + dy + points[r, c, 1] - y)
            closer = distance < first
            second = np.where(closer, first, np.minimum(second, distance))
            nearest = np.where(closer, number[r, c], nearest)
            first = np.where(closer, distance, first)
    return first, second, nearest


def equalise(values: np.ndarray) -> np.ndarray:
    """Values replaced by their rank, 0 … 1: a threshold at `1 − a` then covers exactly the part `a` of the tile."""
    ranks = np.empty(values.size)
    ranks[np.argsort(values, axis=None, kind="stable")] = np.arange(values.size) / (values.size - 1)
    return ranks.reshape(values.shape)


def to_bytes(*channels: np.ndarray) -> np.ndarray:
    """Channels in 0 … 1 as uint8 `(rows, cols, channels)`."""
    return np.round(np.clip(np.stack(channels, -1), 0, 1) * 255).astype(np.uint8)


@lru_cache(maxsize=4)
def noise_texture(size: int = SIZE, seed: int = 7) -> np.ndarray:
    """uint8 RGBA for borders and tints: broad clouds, middle, fine, ridges; each equalised about one half."""
    broad = spectral_noise(size, seed, 1.7, 1, 24)
    middle = spectral_noise(size, seed + 1, 1.3, 5, 80)
    fine = spectral_noise(size, seed + 2, 0.6, 30, 200)
    ridges = -np.abs(spectral_noise(size, seed + 3, 1.8, 2, 90))
    return to_bytes(*(equalise(c) for c in (broad, middle, fine, ridges)))


@lru_cache(maxsize=4)
def foam_texture(size: int = SIZE, seed: int = 7) -> np.ndarray:
    """uint8 RGBA foam (H18): R thin lace with holes, G middle, B dense with round holes, A bubbles.

    R, G and B are equalised: a threshold at `1 − amount` covers `amount` of the water, so foam that thins tears into
    lace and then into threads instead of fading, and its far-off average is simply `amount`.
    """
    warp = tuple(spectral_noise(size, seed + i, 2.3, 2, 40) * 0.022 for i in (1, 2))
    broad = spectral_noise(size, seed + 5, 1.4, 2, 14)
    patch = spectral_noise(size, seed + 6, 1.6, 4, 30)
    grain = spectral_noise(size, seed + 7, 0.8, 40, 160)
    edges = {}
    for cells in (7, 15, 29, 52):
        first, second, number = worley(size, cells, seed + 10 + cells, warp)
        edges[cells] = second - first, first, number
    sparse = smooth(-0.8, 1.4, broad)
    thread = np.minimum(edges[7][0] / 7 * (1 + 0.3 * patch), edges[15][0] / 15 * 1.3 + 0.02 * sparse)
    thread = np.minimum(thread, edges[29][0] / 29 * 1.4 + 0.045 * sparse - 0.002)
    lace = -thread - 0.009 * sparse + 0.0008 * grain
    web = np.minimum(edges[15][0] / 15, edges[29][0] / 29 * 1.3 + 0.010 * (1 + 0.7 * patch))
    middle = -web + 0.008 * broad + 0.0011 * grain
    holes = np.minimum(edges[29][1] * 0.8, edges[52][1] * 0.62 + 0.14 + 0.08 * patch)
    dense = holes + 0.09 * broad + 0.025 * grain
    first, number = edges[52][1], edges[52][2]
    radius = 0.16 + 0.3 * number
    rim = np.exp(-(((first - radius) / 0.07) ** 2)) + 0.35 * (first < radius)
    return to_bytes(equalise(lace), equalise(middle), equalise(dense), rim)


def ocean_amplitude(kx: np.ndarray, ky: np.ndarray, size: int, spread: float = 2.0) -> np.ndarray:
    """Amplitude of waves of so many cycles a tile, by the form of Phillips' spectrum (Tessendorf 2001, eq. 40).

    exp(−(k₀ / k)²) k⁻² |cos|: no waves much longer than a third of the tile, for those are the mesh's; a floor under
    the spread keeps short waves on all sides; what `size` samples could not hold is damped away.
    """
    k = np.maximum(np.hypot(kx, ky), 1e-9)
    along = np.abs(kx) / k  # both ways: a real field has no direction, its scroll has
    amplitude = np.exp(-((2.2 / k) ** 2) - (k / (size * 0.16)) ** 2) * k**-2.1 * (0.18 + along**spread)
    return np.where(k < 1, 0, amplitude)


@lru_cache(maxsize=4)
def ripple_texture(size: int = 256, seed: int = 7, spread: float = 2.0) -> np.ndarray:
    """float32 `(size, size, 4)` small waves going east in a tile of side 1: slope east, slope north, slope², height.

    One state of an ocean's spectrum by FFT (H16). The slope's total variance is 1, so the shader scales it to any wind;
    averaged over a mip level, slope² minus the square of the mean slope is the variance that level lost (LEAN mapping,
    Olano & Baker 2010), which becomes roughness.
    """
    rng = np.random.default_rng(seed)
    spectrum = np.fft.fft2(rng.standard_normal((size, size)))
    ky, kx = np.meshgrid(*(np.fft.fftfreq(size, 1 / size),) * 2, indexing="ij")
    spectrum = spectrum * ocean_amplitude(kx, ky, size, spread)
    height = np.fft.ifft2(spectrum).real
    east = np.fft.ifft2(2j * np.pi * kx * spectrum).real
    north = np.fft.ifft2(2j * np.pi * ky * spectrum).real
    scale = 1 / np.sqrt((east**2 + north**2).mean())
    east, north, height = east * scale, north * scale, height * scale
    return np.stack([east, north, east**2 + north**2, height], -1).astype(np.float32)


@lru_cache(maxsize=4)
def caustics_texture(size: int = 512, seed: int = 7, ways: int = 6) -> np.ndarray:
    """uint8 `(size, size, 1)` light on a bed under small waves, mean 1 at CAUSTICS_MEAN / 255 (D08, H13).

    Rays straight down, bent by the slopes of a tiling sea and counted where they land: lines are where it folds.
    """
    height = spectral_noise(size * 2, seed + 40, 3.0, 3, 22)
    slopes = [(np.roll(height, -1, axis) - np.roll(height, 1, axis)) * 0.5 * size * 2 for axis in (1, 0)]
    steep = np.sqrt(np.mean(slopes[0] ** 2 + slopes[1] ** 2))
    y, x = np.mgrid[0 : size * 2, 0 : size * 2] / (size * 2)
    light = np.zeros((size, size))
    for shift in np.arange(ways) / ways:
        # from a focus just under the surface to one far below: the sun is wide and the sea has many lengths of wave
        reach = 0.030 * (0.75 + 0.5 * shift) / steep
        col, row = ((v - reach * s) % 1.0 * size for v, s in ((x, slopes[0]), (y, slopes[1])))
        light += _splat(col, row, size)
    gain = mean = CAUSTICS_MEAN / 255
    light /= light.mean()
    for _ in range(8):  # what the brightest lose the others get
        gain *= mean / np.minimum(light * gain, 1.0).mean()
    return to_bytes(light * gain)


def _splat(col: np.ndarray, row: np.ndarray, size: int) -> np.ndarray:
    """How many points fall on each texel of a tile, shared between the four nearest, `(size, size)`."""
    c, r = np.floor(col).astype(int), np.floor(row).astype(int)
    fc, fr = col - c, row - r
    total = np.zeros(size * size)
    for dr, dc in ((0, 0), (0, 1), (1, 0), (1, 1)):
        weight = np.where(dr, fr, 1 - fr) * np.where(dc, fc, 1 - fc)
        index = (r + dr) % size * size + (c + dc) % size
        total += np.bincount(index.ravel(), weight.ravel(), size * size)
    return total.reshape(size, size)
