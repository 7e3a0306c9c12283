"""Patterns of the high layers: cirrus combed by the wind and hooked, altocumulus in ripples and heaps (Z13)."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from .textures import spectral_noise, worley

SIDE = 512
COMBED = 60  # steps of the comb
PIECE = 2.1  # texels a step
RIPPLES = 26  # over the tile


def high_clouds(seed: int) -> np.ndarray:
    """uint8 `(512, 512, 4)`, tiling: streaks of cirrus, hooked cirrus, ripples and heaps of altocumulus."""
    parts = (_streaks(seed), _hooks(seed + 20), _ripples(seed + 40), _heaps(seed + 60))
    return np.stack([np.round(255 * np.clip(part, 0, 1)).astype(np.uint8) for part in parts], -1)


def _noise(seed: int, low: float, high: float, power: float = 1.2) -> np.ndarray:
    return spectral_noise(SIDE, seed, power, low, high)


def _even(values: np.ndarray) -> np.ndarray:
    """The same pattern, its values evenly spread over 0 … 1."""
    ranks = np.empty(values.size, np.float64)
    ranks[np.argsort(values, axis=None, kind="stable")] = np.arange(values.size)
    return (ranks / (values.size - 1)).reshape(values.shape)


def _combed(grain: np.ndarray, bend: np.ndarray, fade: float) -> np.ndarray:
    """Grain drawn out along the columns, turned by `bend`: a head, and a tail that thins (Cabral & Leedom 1993)."""
    row, col = np.mgrid[0:SIDE, 0:SIDE].astype(np.float64)
    along, across = PIECE * np.cos(bend), PIECE * np.sin(bend)
    total, weight = np.zeros_like(grain), 0.0
    for step in range(COMBED):
        share = np.exp(-fade * step / COMBED)
        total += share * ndimage.map_coordinates(grain, [row, col], order=1, mode="grid-wrap")
        weight += share
        at = np.round(row).astype(np.int64) % SIDE, np.round(col).astype(np.int64) % SIDE
        col, row = col - along[at], row - across[at]
    return total / weight


def _streaks(seed: int) -> np.ndarray:
    """Long fibres side by side, in sheaves."""
    bend = 0.15 * _noise(seed, 1, 4)
    fibres = _even(_combed(_noise(seed + 1, 20, 120, 0.4), bend, 1.0))
    broad = _even(_combed(_noise(seed + 2, 3, 12), bend, 1.0))
    return np.clip(broad * 0.75 + fibres * 0.45 - 0.2, 0, 1) * (0.55 + 0.45 * fibres)


def _hooks(seed: int) -> np.ndarray:
    """Heads here and there, each with a tail that curves away as it falls through slower air."""
    sparse = np.maximum(_noise(seed, 10, 60, 0.6) - 1.3, 0)
    bend = 0.9 * _even(_noise(seed + 1, 1, 3)) - 0.2 + 0.12 * _noise(seed + 2, 6, 16)
    tails = _combed(sparse, bend, 2.2)
    tails = tails / np.quantile(tails, 0.985)
    return np.clip(tails, 0, 1) ** 0.8 * np.clip(1.6 * _even(_noise(seed + 3, 1, 4)) - 0.3, 0, 1)


def _ripples(seed: int) -> np.ndarray:
    """Rows of small clouds across the wind, broken along each row."""
    row, col = np.mgrid[0:SIDE, 0:SIDE] / SIDE
    waves = np.sin(2 * np.pi * (RIPPLES * col + 3 * row) + 1.5 * _noise(seed, 2, 7))
    return _soft(waves + 1.1 * _cells(seed + 1, 34) + 0.25 * _noise(seed + 2, 40, 160, 0.8))


def _heaps(seed: int) -> np.ndarray:
    """Small heaps, close together, as in a field of sheep."""
    return _soft(_cells(seed, 30) + 0.35 * _cells(seed + 1, 73) + 0.22 * _noise(seed + 2, 40, 200, 0.8))


def _cells(seed: int, cells: int) -> np.ndarray:
    """A round lump in each cell, big and small ones; deviation 1."""
    warp = 0.16 / cells * _noise(seed, 8, 60), 0.16 / cells * _noise(seed + 7, 8, 60)
    near, _, number = worley(SIDE, cells, seed, warp)
    lumps = np.clip(1.0 - near / (0.55 + 0.35 * number), 0, 1)
    return (lumps - lumps.mean()) / lumps.std()


def _soft(values: np.ndarray) -> np.ndarray:
    """From nothing in the gaps to 1 in the middle of lumps."""
    return np.clip((_even(values) - 0.3) / 0.7, 0, 1)
