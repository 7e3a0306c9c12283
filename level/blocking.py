"""Waves that meet a current: what stops them, and how high they get before (D35).

Waves against a current U: energy comes no farther than where cg + U = 0, in deep water U = −g P / (8 π). Till there
they get shorter and higher by wave action: with r = −U / (that speed) and s = √(1 − r), (cg + U) / cg is s, and
amplitudes grow as 2 / ((1 + s) √s) (Longuet-Higgins & Stewart 1961: deep water; the speed that stops them is that of
the depth).
"""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np

from .dispersion import wavenumber
from .earth import GRAVITY
from .river_jet import smooth

MOST_GAIN = 1.6  # waves get no higher than so many times what they were
STEEPEST = 0.14  # of waves, height by length, × tanh k h (Miche)
STOPS = (0.92, 1.08)  # of the speed that stops waves: all of them, none get through
SHORTEST_AT = 0.97  # of the speed that stops waves: against more of it they get no shorter, for they are gone
NEWTON_STEPS = 9
WHITE = (0.2, 0.5)  # (cg + U) / cg up to which they are white, at which they aren't


@functools.lru_cache(1)
def _stopping() -> tuple[np.ndarray, np.ndarray]:
    """ω √(h / g), and the speed by √(g h) that stops waves of it: at the largest ω that k has against a current."""
    kh = np.geomspace(1e-3, 60, 800)
    tanh = np.tanh(kh)
    sigma = np.sqrt(kh * tanh)
    group = (tanh + kh * (1 - tanh * tanh)) / (2 * sigma)
    return sigma - kh * group, group


def stopping_speed(period_s, depth_m) -> np.ndarray:
    """m/s of a current against waves that lets none of that period pass; arrays of one shape."""
    depth = np.maximum(depth_m, 0.05)
    pace = 2 * np.pi / np.asarray(period_s, np.float64) * np.sqrt(depth / GRAVITY)
    known, stops = _stopping()
    return np.where(pace > known[-1], 0.25 / pace, np.interp(pace, known, stops)) * np.sqrt(GRAVITY * depth)


def met_wavenumber(period_s: float, depth_m, along_mps) -> np.ndarray:
    """Radians per metre of waves of a period through water that goes `along_mps` their way: (ω − k U)² = g k tanh k h.

    Arrays of one shape. A current that stops them shortens them as one of SHORTEST_AT of its speed.
    """
    depth = np.asarray(depth_m, np.float64)
    along = np.maximum(along_mps, -SHORTEST_AT * stopping_speed(period_s, depth))
    omega, k = 2 * np.pi / period_s, wavenumber(period_s, depth)
    # σ(k) + k U − ω is concave and grows up to the speed that stops waves: from its left no step goes too far
    for _ in range(NEWTON_STEPS):
        tanh = np.tanh(k * depth)
        sigma = np.sqrt(GRAVITY * k * tanh)
        group = GRAVITY * (tanh + k * depth * (1 - tanh * tanh)) / (2 * sigma)
        k = k - (sigma + k * along - omega) / np.maximum(group + along, 1e-3 * group)
    return k


@dataclass
class Met:
    """What a current leaves of waves, arrays of one shape: × amplitude, share that gets through, how white 0 … 1."""

    gain: np.ndarray
    through: np.ndarray
    white: np.ndarray


def met(period_s, depth_m, against_mps, amplitude_m: float = 0.0) -> Met:
    """Waves of a period that meet a current, m/s against them; with it they get lower."""
    r = against_mps / stopping_speed(period_s, depth_m)
    s = np.sqrt(np.maximum(1 - r, 1e-4))
    most = MOST_GAIN
    if amplitude_m > 0:
        length = GRAVITY * np.asarray(period_s) ** 2 / (2 * np.pi) * (0.5 * (1 + s)) ** 2
        steepest = 0.5 * STEEPEST * length * np.tanh(2 * np.pi / length * np.maximum(depth_m, 0.05)) / amplitude_m
        most = np.clip(steepest, 1.0, MOST_GAIN)
    through = 1 - smooth(*STOPS, r)
    white = (1 - smooth(*WHITE, s)) * (1 - smooth(1.0, STOPS[1] + 0.1, r))
    return Met(np.minimum(2 / ((1 + s) * np.sqrt(s)), most), through, white)
