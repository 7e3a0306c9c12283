"""The surf zone (T06): where waves break and how, by the slope of the bed.

Surf similarity ξ = tan β / √(H / L0), H at the break, L0 = g P² / 2π (Battjes 1974): below 0.4 a breaker spills, above
2 it surges, between them it plunges.
"""

from __future__ import annotations

import math

import numpy as np

from .earth import GRAVITY

BROKEN_SHARE = 0.95  # of breaker · depth: from that height on a wave counts as broken
TYPES = ("spilling", "plunging", "surging")
LIMITS = (0.4, 2.0)


def similarity(slope, height_m, period_s: float) -> np.ndarray:
    """ξ of waves of that height at the break over a bed of that slope (rise over run); arrays."""
    length_m = GRAVITY * period_s**2 / (2 * math.pi)
    return np.asarray(slope) / np.sqrt(np.maximum(height_m, 1e-3) / length_m)


def breaker_type(slope, height_m, period_s: float) -> np.ndarray:
    """Index into TYPES."""
    return np.digitize(similarity(slope, height_m, period_s), LIMITS)
