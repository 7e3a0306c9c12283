"""Colours of the timing (T06), one place for shader, legend and files.

Speeds run on a straight line in OKLab (B. Ottosson 2020) from dark blue to yellow: equal steps look equal, lightness
alone tells them apart, and no eye confuses blue with yellow. Moments run from blue (before) to orange (after), kinds of
breakers are three colours of Okabe and Ito (2008), each with a pattern of its own.
"""

from __future__ import annotations

import functools

import numpy as np

STOPS = 9
DARK, BRIGHT = (0.28, -0.015, -0.105), (0.93, -0.02, 0.165)  # OKLab
BEFORE, NOW, AFTER = (0.40, 0.72, 1.0), (1.0, 1.0, 1.0), (1.0, 0.62, 0.12)
BREAKERS = {"spilling": (0.34, 0.71, 0.91), "plunging": (0.90, 0.62, 0.0), "surging": (0.80, 0.47, 0.65)}
ISOCHRONE = (0.98, 0.97, 0.90)
_LMS = np.array([[1, 0.3963377774, 0.2158037573], [1, -0.1055613458, -0.0638541728], [1, -0.0894841775, -1.291485548]])
_RGB = np.array(
    [[4.0767416621, -3.3077115913, 0.2309699292], [-1.2684380046, 2.6097574011, -0.3413193965],
     [-0.0041960863, -0.7034186147, 1.707614701]]
)  # fmt: skip


@functools.cache
def stops() -> np.ndarray:
    """The ramp as sRGB 0 … 1 `(STOPS, 3)`, evenly spaced."""
    part = np.linspace(0, 1, STOPS)[:, None]
    lab = np.array(DARK) + (np.array(BRIGHT) - np.array(DARK)) * part
    linear = np.clip((lab @ _LMS.T) ** 3 @ _RGB.T, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def ramp_colour(part) -> np.ndarray:
    """sRGB `(…, 3)` at 0 … 1 of the ramp."""
    part = np.clip(np.asarray(part, np.float64), 0, 1) * (STOPS - 1)
    return np.stack([np.interp(part, np.arange(STOPS), stops()[:, i]) for i in range(3)], -1)


def moment_colour(part: float) -> np.ndarray:
    """sRGB of a crest that is `part` −1 … 1 of the way from the earliest to the latest ghost; 0 is now."""
    end = np.array(BEFORE if part < 0 else AFTER)
    return np.array(NOW) if part == 0 else end


def moment_alpha(part: float) -> float:
    """How much of a ghost is seen: the farther in time the less."""
    return 1.0 if part == 0 else 0.95 - 0.4 * abs(part)
