"""How high waves run up a beach above still water, and how they break on it: by surf similarity (Iribarren number)."""

from __future__ import annotations

import numpy as np

from .dispersion import deep_water_length

UNBROKEN, SPILLING, PLUNGING, SURGING = 0, 1, 2, 3
PLUNGES_FROM, SURGES_FROM = 0.4, 2.0  # surf similarity at the break point (Battjes 1974)
MOST_HEIGHTS = 3.0  # Hunt's formula is for waves that break: steeper, they reflect and reach two to three heights


def surf_similarity(slope, height_m, period_s: float) -> np.ndarray:
    """tan(beta) / sqrt(H / L0): slope of the bed by the root of the wave's steepness."""
    return np.asarray(slope) / np.sqrt(np.maximum(height_m, 1e-9) / deep_water_length(period_s))


def breaker_type(similarity) -> np.ndarray:
    """1 spilling, 2 plunging, 3 surging (int8) by surf similarity at the break point."""
    return (SPILLING + (similarity >= PLUNGES_FROM) + (similarity > SURGES_FROM)).astype(np.int8)


def hunt(slope, height_m, period_s: float) -> np.ndarray:
    """Run-up in metres of regular waves: R = tan(beta) sqrt(H0 L0), H0 in deep water (Hunt 1959)."""
    height = np.asarray(height_m, np.float64)
    return np.minimum(slope * np.sqrt(height * deep_water_length(period_s)), MOST_HEIGHTS * height)


def stockdon(slope, height_m, period_s: float) -> np.ndarray:
    """Run-up in metres that 2 % of a natural sea exceed: set-up and swash by Stockdon et al. (2006)."""
    slope, height = np.asarray(slope, np.float64), np.asarray(height_m, np.float64)
    length = np.sqrt(height * deep_water_length(period_s))
    return 1.1 * length * (0.35 * slope + 0.5 * np.sqrt(0.563 * slope**2 + 0.004))


RUNUP = {"hunt": hunt, "stockdon": stockdon}
