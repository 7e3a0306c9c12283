"""Seeded patterns that tile, the same at every resolution: each is made of waves or points whose number is fixed.

A smaller picture leaves out the waves that it can't hold (its spectrum is cropped) and asks the same feature points; a
draft, whose only worth is to be there at once, draws other waves and none that it can't hold.
Lengths are in tiles, counts in a tile; arrays are `(size, size)`, row 0 at y = 0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import map_coordinates

FINEST = 511  # cycles a tile that 1024 samples hold
DRAFT = 64  # samples a side, up to which a picture only stands in


def _field(size: int, seed: int, weight, most: int) -> np.ndarray:
    """Complex field of random waves, kx ≥ 0 only, each of amplitude `weight(kx, ky)`; its real part has deviation 1."""
    rng = np.random.default_rng(seed)
    most = min(most, FINEST if size > DRAFT else size // 2 - 1)
    ky, kx = np.meshgrid(np.arange(-most, most + 1), np.arange(most + 1), indexing="ij")
    waves = rng.standard_normal((*kx.shape, 2)).view(np.complex128)[..., 0] * weight(kx, ky)
    waves[:, 0] *= ky[:, 0] > 0  # one of each pair of opposite waves
    waves /= max(np.sqrt((np.abs(waves) ** 2).sum() / 2), 1e-9)
    kept = min(most, size // 2 - 1)
    spectrum = np.zeros((size, size), np.complex128)
    rows = np.arange(-kept, kept + 1)
    spectrum[rows % size, : kept + 1] = waves[rows + most, : kept + 1]
    return np.fft.ifft2(spectrum) * size**2


def waves(size: int, seed: int, falloff: float, low: float = 1.0, high: float = FINEST, stretch: float = 1.0):
    """Gaussian noise, amplitude `f ** -falloff` between `low` and `high` cycles, `stretch` times longer along x."""

    def weight(kx, ky):
        k = np.hypot(kx * stretch, ky)
        return np.where((k >= low) & (k <= high), np.maximum(k, 1.0) ** -falloff, 0.0)

    return _field(size, seed, weight, int(high)).real


def ripples(size: int, seed: int, count: float, spread: float, bend: float) -> np.ndarray:
    """Ripple marks −1 … 1, about `count` crests along x that fork and end; lee sides steeper than stoss sides."""

    def weight(kx, ky):
        return np.exp(-(((kx - count) / spread) ** 2) - (ky / (spread * bend)) ** 2)

    field = _field(size, seed, weight, int(count + 3 * spread * max(bend, 1)))
    strength = np.abs(field) / np.maximum(np.abs(field).mean(), 1e-9)
    phase = np.angle(field)
    return np.cos(phase + 0.45 * np.sin(phase)) * strength / (0.35 + strength)


@dataclass(frozen=True)
class Cells:
    """Cell noise: distance to the nearest and the second point, and to the border between (all in cells), numbers."""

    first: np.ndarray
    second: np.ndarray
    number: np.ndarray  # 0 … 1, one a cell
    other: np.ndarray  # another
    dx: np.ndarray  # from the nearest point, in cells
    dy: np.ndarray

    @property
    def border(self) -> np.ndarray:
        """Distance to the border between the two nearest cells, about."""
        return self.second - self.first


def cells(size: int, across: int, up: int, seed: int, warp=(0.0, 0.0), jitter: float = 0.9) -> Cells:
    """`across` × `up` cells a tile (Worley 1996); `warp` moves the places that are asked, in tiles."""
    rng = np.random.default_rng(seed)
    points = ((rng.random((up, across, 2)) - 0.5) * jitter + 0.5).astype(np.float32)
    numbers = rng.random((up, across, 2)).astype(np.float32)
    axis = np.arange(size, dtype=np.float32) / size
    x = (axis[None, :] + np.float32(0) + warp[0]).astype(np.float32) * across + np.zeros((size, 1), np.float32)
    y = (axis[:, None] + np.float32(0) + warp[1]).astype(np.float32) * up + np.zeros((1, size), np.float32)
    column, row = np.floor(x).astype(np.int32), np.floor(y).astype(np.int32)
    first, second = np.full((2, size, size), 9.0, np.float32)
    number, other, near_x, near_y = np.zeros((4, size, size), np.float32)
    for j in (-1, 0, 1):
        for i in (-1, 0, 1):
            r, c = (row + j) % up, (column + i) % across
            dx, dy = x - (column + i + points[r, c, 0]), y - (row + j + points[r, c, 1])
            distance = np.sqrt(dx * dx + dy * dy)
            closer = distance < first
            second = np.where(closer, first, np.minimum(second, distance))
            first = np.where(closer, distance, first)
            for held, value in ((number, numbers[r, c, 0]), (other, numbers[r, c, 1]), (near_x, dx), (near_y, dy)):
                np.copyto(held, value, where=closer)
    return Cells(first, second, number, other, near_x, near_y)


def comb(values: np.ndarray, along_x: np.ndarray, along_y: np.ndarray, length: float, steps: int = 9) -> np.ndarray:
    """Mean of `values` along a field of directions, `length` tiles each way: strands (Cabral & Leedom 1993)."""
    size = values.shape[0]
    total = values.copy()
    for way in (1.0, -1.0):
        y, x = np.mgrid[0:size, 0:size].astype(np.float64)
        for _ in range(steps):
            at = [np.round(y).astype(int) % size, np.round(x).astype(int) % size]
            x += way * along_x[at[0], at[1]] * length * size / steps
            y += way * along_y[at[0], at[1]] * length * size / steps
            total += map_coordinates(values, [y, x], order=1, mode="grid-wrap")
    return total / max(total.std(), 1e-9)


def smooth(low: float, high: float, x: np.ndarray) -> np.ndarray:
    """GLSL's smoothstep."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)
