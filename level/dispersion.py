"""The linear dispersion relation omega² = g k tanh(k h): how long and how fast a wave of one period is in given depth.

Small-amplitude (Airy) theory, as in the Coastal Engineering Manual, part II-1.
"""

from __future__ import annotations

import numpy as np

from .earth import GRAVITY

NEWTON_STEPS = 3  # relative error of the start by Eckart 5e-2, then 5e-4, 7e-8, below rounding


def wavenumber(period_s: float, depth_m) -> np.ndarray:
    """Radians per metre of a wave of that period over water of that depth (> 0, any shape), float64."""
    omega = 2 * np.pi / period_s
    deep = omega * omega / GRAVITY
    depth = np.asarray(depth_m, np.float64)
    kh = deep * depth
    # Eckart (1952): right in both limits, 5 % off between them.
    kh = kh / np.sqrt(np.tanh(kh))
    for _ in range(NEWTON_STEPS):
        tanh = np.tanh(kh)
        kh = kh - (kh * tanh - deep * depth) / (tanh + kh * (1 - tanh * tanh))
    return kh / depth


def phase_speed(period_s: float, depth_m) -> np.ndarray:
    """Metres a second that a crest goes."""
    return 2 * np.pi / period_s / wavenumber(period_s, depth_m)


def group_speed(period_s: float, depth_m) -> np.ndarray:
    """Metres a second that the energy goes: half the phase speed in deep water, all of it in shallow."""
    k = wavenumber(period_s, depth_m)
    return 2 * np.pi / period_s / k * group_ratio(k, depth_m)


def group_ratio(k, depth_m) -> np.ndarray:
    """Group speed by phase speed, 0.5 … 1, of wavenumber k (1/m)."""
    twice = 2 * np.asarray(k, np.float64) * depth_m
    # sinh grows past float64 where the ratio has long been one half.
    return 0.5 * (1 + twice / np.sinh(np.clip(twice, 1e-9, 300.0)))


def deep_water_length(period_s: float) -> float:
    """Metres from crest to crest where the bed is not felt."""
    return GRAVITY * period_s**2 / (2 * np.pi)
