"""Noise that makes land: gradient noise, ridges, cells, warps; arrays in, arrays out, the same numbers for a seed.

Coordinates are metres, `scale_m` the size of the largest feature. Values of `perlin` and `fbm` are about -1 … 1,
those of `ridged`, `worley` and `value01` 0 … 1. Only additions, products and roots touch the arrays, so that processors
agree on the bits.
"""

from __future__ import annotations

import functools
import math

import numpy as np

TABLE = 256


@functools.lru_cache(maxsize=256)
def _gradients(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Unit gradients of a wrapping lattice, east and north parts, `(256 · 256,)` each."""
    angle = np.random.default_rng(seed).random(TABLE * TABLE) * (2 * math.pi)
    return np.cos(angle), np.sin(angle)


@functools.lru_cache(maxsize=64)
def _points(seed: int) -> np.ndarray:
    """Jittered lattice points, `(256 · 256, 3)`: place inside the cell (0 … 1) and a value of its own."""
    return np.random.default_rng(seed).random((TABLE * TABLE, 3))


def _cell(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    whole = np.floor(x)
    return whole.astype(np.int64) & (TABLE - 1), x - whole


def fade(t: np.ndarray) -> np.ndarray:
    """Perlin's quintic (Improving Noise, 2002): slope and curvature are 0 at both ends."""
    return t * t * t * (t * (t * 6 - 15) + 10)


def smoothstep(low: float, high: float, x: np.ndarray) -> np.ndarray:
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def perlin(x: np.ndarray, y: np.ndarray, seed: int) -> np.ndarray:
    """Gradient noise at lattice coordinates."""
    east, north = _gradients(seed)
    column, fx = _cell(x)
    row, fy = _cell(y)
    u, v = fade(fx), fade(fy)
    columns = column, (column + 1) & (TABLE - 1)
    rows = row * TABLE, ((row + 1) & (TABLE - 1)) * TABLE

    def corner(dx: int, dy: int) -> np.ndarray:
        place = rows[dy] + columns[dx]
        return east.take(place) * (fx - dx) + north.take(place) * (fy - dy)

    bottom = corner(0, 0) * (1 - u) + corner(1, 0) * u
    top = corner(0, 1) * (1 - u) + corner(1, 1) * u
    return (bottom * (1 - v) + top * v) * 1.5


def octaves(x, y, scale_m: float, count: int, seed: int, lacunarity: float = 2.03):
    """Noise of each octave, largest first; turned from one to the next so that no lattice shows."""
    cosine, sine = 0.7986, 0.6018
    x, y = x / scale_m + 7.31 * seed, y / scale_m - 3.77 * seed
    for octave in range(count):
        yield perlin(x, y, seed * 31 + octave)
        x, y = (cosine * x - sine * y) * lacunarity, (sine * x + cosine * y) * lacunarity


def fbm(x, y, scale_m: float, count: int, seed: int, gain: float = 0.5) -> np.ndarray:
    """Sum of octaves, each `gain` times the last."""
    total, amplitude, weight = 0.0, 1.0, 0.0
    for noise in octaves(x, y, scale_m, count, seed):
        total = total + amplitude * noise
        weight += amplitude
        amplitude *= gain
    return total / weight * 1.4


def ridged(x, y, scale_m: float, count: int, seed: int, gain: float = 0.5) -> np.ndarray:
    """Ridged multifractal (Musgrave, in Texturing & Modeling, ch. 16): detail gathers on the crests."""
    total, amplitude, weight, most = 0.0, 1.0, 1.0, 0.0
    for noise in octaves(x, y, scale_m, count, seed):
        signal = np.square(1 - np.minimum(np.abs(noise) * 1.3, 1)) * weight
        weight = np.clip(signal * 2, 0, 1)
        total = total + amplitude * signal
        most += amplitude
        amplitude *= gain
    return total / most


def worley(x, y, scale_m: float, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(nearest, second nearest, value of the nearest cell): distances in cells (Worley 1996)."""
    table = _points(seed)
    column, fx = _cell(x / scale_m)
    row, fy = _cell(y / scale_m)
    first = np.full(np.shape(fx), 9.0)
    second = np.full(np.shape(fx), 9.0)
    value = np.zeros(np.shape(fx))
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            point = table[((row + dy) & (TABLE - 1)) * TABLE + ((column + dx) & (TABLE - 1))]
            away = np.square(point[..., 0] + dx - fx) + np.square(point[..., 1] + dy - fy)
            nearer = away < first
            second = np.where(nearer, first, np.minimum(second, away))
            value = np.where(nearer, point[..., 2], value)
            first = np.where(nearer, away, first)
    return np.sqrt(first), np.sqrt(second), value


def warp(x, y, scale_m: float, reach_m: float, seed: int, count: int = 3) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates pushed about by noise: what is looked up there loses its straight lines."""
    return x + reach_m * fbm(x, y, scale_m, count, seed), y + reach_m * fbm(x, y, scale_m, count, seed + 101)


def smooth_max(a, b, width: float):
    """Maximum with a fillet of about `width` metres of height."""
    h = np.maximum(width - np.abs(a - b), 0) / width
    return np.maximum(a, b) + h * h * width / 4


def smooth_min(a, b, width: float):
    return -smooth_max(-a, -b, width)
