"""Height curves of the three cloud types as a table, and their blend (Z03)."""

from __future__ import annotations

import numpy as np

from .settings import Settings
from .sky_settings import curve_points

SAMPLES = 64
TYPES = ("stratus", "cumulus", "cumulonimbus")


def profile_table(settings: Settings) -> np.ndarray:
    """float32 `(3, 64)`: density by height in the shell, a row a type."""
    heights = np.linspace(0, 1, SAMPLES)
    rows = [np.interp(heights, *np.array(curve_points(getattr(settings.clouds, name))).T) for name in TYPES]
    return np.array(rows, np.float32)
