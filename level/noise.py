"""Seeded noise that shader, twin, brushes and exporters share: one small lattice, interpolated the same way by all."""

from __future__ import annotations

import functools

import numpy as np

from .dual import Dual

LATTICE = 64  # values a side; tiles


@functools.lru_cache(maxsize=8)
def lattice(seed: int) -> np.ndarray:
    """The lattice of a level: float32 `(64, 64)` in 0 … 1, tiling, its values spread evenly."""
    rng = np.random.Generator(np.random.PCG64(seed))
    values = rng.permutation(LATTICE * LATTICE).astype(np.float32).reshape(LATTICE, LATTICE)
    return values / np.float32(LATTICE * LATTICE - 1)


def value_noise(values: np.ndarray, x: np.ndarray, y: np.ndarray, cell_m: float, shift=(0, 0)) -> Dual:
    """Smooth noise in 0 … 1 at world x, y with its gradient; `shift` moves by whole lattice cells."""
    u, v = x / cell_m, y / cell_m
    col, row = np.floor(u).astype(np.int64), np.floor(v).astype(np.int64)
    fu, fv = u - col, v - row
    wu, wv = fu * fu * (3 - 2 * fu), fv * fv * (3 - 2 * fv)
    du, dv = 6 * fu * (1 - fu) / cell_m, 6 * fv * (1 - fv) / cell_m

    def at(r, c):
        return values[(row + r + shift[1]) % LATTICE, (col + c + shift[0]) % LATTICE].astype(np.float64)

    v00, v10, v01, v11 = at(0, 0), at(0, 1), at(1, 0), at(1, 1)
    south, north = v00 + (v10 - v00) * wu, v01 + (v11 - v01) * wu
    return Dual(
        south + (north - south) * wv,
        du * ((v10 - v00) + ((v11 - v01) - (v10 - v00)) * wv),
        dv * (north - south),
    )
