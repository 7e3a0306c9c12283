"""Density of clouds by height in the shell: three curves of the settings, blended by type (Z03).

The curves are monotone cubics through their points (Fritsch and Carlson 1980): they round corners off but never leave
the range of two neighbours. Before the first point and after the last one their values go on.
"""

from __future__ import annotations

import functools

import numpy as np

from .settings import Settings
from .sky_settings import Curve

HEIGHTS = 64  # samples of a curve, the first at the shell's inner side, the last at its outer one
KINDS = ("stratus", "cumulus", "cumulonimbus")  # gradient coordinates 0, 0.5 and 1


@functools.lru_cache(maxsize=64)
def curve_samples(curve: Curve, count: int = HEIGHTS) -> np.ndarray:
    """float32 `(count,)`: one curve at heights from 0 to 1, ends included; not to be written to."""
    from scipy.interpolate import PchipInterpolator

    at, density = np.array(curve[::2]), np.array(curve[1::2])
    heights = np.clip(np.linspace(0, 1, count), at[0], at[-1])
    samples = np.clip(PchipInterpolator(at, density)(heights), 0, 1).astype(np.float32)
    samples.flags.writeable = False
    return samples


def profile_table(settings: Settings) -> np.ndarray:
    """float32 `(3, 64)`: stratus, cumulus and cumulonimbus from the shell's inner side to its outer one.

    As a texture with linear filters, clamped, it is read at `((63 h + 0.5) / 64, (2 g + 0.5) / 3)` as `profile` does.
    """
    return np.stack([curve_samples(getattr(settings.clouds, name)) for name in KINDS])


def profile(table: np.ndarray, g, h) -> np.ndarray:
    """Density 0 … 1 at gradient coordinates `g` (0 stratus, 0.5 cumulus, 1 cumulonimbus) and heights `h`, 0 … 1."""
    row, row_part = _split(np.asarray(g, np.float64) * (len(table) - 1), len(table))
    col, col_part = _split(np.asarray(h, np.float64) * (table.shape[1] - 1), table.shape[1])
    lower = table[row, col] + (table[row, col + 1] - table[row, col]) * col_part
    upper = table[row + 1, col] + (table[row + 1, col + 1] - table[row + 1, col]) * col_part
    return lower + (upper - lower) * row_part


def _split(at: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Whole index, so that index + 1 exists, and remainder of fractional ones, held inside."""
    held = np.clip(at, 0, count - 1)
    whole = np.minimum(held.astype(np.intp), count - 2)
    return whole, held - whole
