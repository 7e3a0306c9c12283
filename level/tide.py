"""The tide: the height of the still sea as a periodic function of the clock.

    sea_level_at(level, t)  # metres; `level.sea_level_m` of the level that `level_at` gives for t

Nothing is baked anew while it moves: maps are made once for the whole band between low and high water (shore.py), and
shaders and twins add `tide_m` to every depth.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from pydantic import field_validator

from .loop import looped, moment
from .params import Section, param

MOST_POINTS = 16
LEFT = 17  # heights of the band for which it is known since when they are dry
PAST = 257  # moments of the last period that are looked at


class Tide(Section):
    """The sea rises and falls; foam by the distance to the shore, currents and scatter keep to the mean level."""

    on: bool = param(False, doc="The sea rises and falls with the clock.")
    range_m: float = param(
        1.6, 0, 40, "m", "From low water to high water, half of it either side of level.sea_level_m. The sheet slides"
        " on sand up to 2 m over and under that level; past it nothing holds the water on the beach.", soft=(0, 3),
    )  # fmt: skip
    period_s: float = param(
        600.0, 5, 1e6, "s", "From one high water to the next; 44712 on Earth. A loop shorter than it stops the tide.",
        soft=(60, 86_400),
    )  # fmt: skip
    high_s: float = param(0.0, -1e7, 1e7, "s", "When the curve begins: high water of the one that comes by itself.",
                          soft=(0, 600))  # fmt: skip
    curve: tuple[float, ...] = param(
        (0.0, 1.0, 0.5, 0.0),
        doc="Height of the sea over a period, by turns part of the period and height, 0 low water, 1 high water; two "
        "points make a cosine.",
    )

    @field_validator("curve")
    @classmethod
    def _is_curve(cls, curve: tuple[float, ...]) -> tuple[float, ...]:
        """Two to sixteen points, parts of the period rising in 0 … 1, the last before 1."""
        if len(curve) % 2 or not 4 <= len(curve) <= 2 * MOST_POINTS:
            raise ValueError("a tide's curve is 2 to 16 pairs of a part of the period and a height")
        at = curve[::2]
        if not all(0 <= value <= 1 for value in curve) or at[-1] >= 1 or any(b <= a for a, b in pairwise(at)):
            raise ValueError("a tide's curve takes numbers from 0 to 1, its parts of the period rising and below 1")
        return curve


def curve_at(curve: tuple[float, ...], part):
    """Heights 0 … 1 at parts of a period (arrays too); half a cosine from each point to the next, without end."""
    at, height = np.array(curve[::2]), np.array(curve[1::2])
    part = np.mod(part, 1.0)
    at = np.concatenate([[at[-1] - 1], at, [at[0] + 1]])
    height = np.concatenate([height[-1:], height, height[:1]])
    left = np.clip(np.searchsorted(at, part, side="right") - 1, 0, len(at) - 2)
    along = (part - at[left]) / (at[left + 1] - at[left])
    return height[left] + (height[left + 1] - height[left]) * 0.5 * (1 - np.cos(np.pi * along))


def tide_m(settings, t):
    """How far the sea stands over its mean level at seconds t (arrays too).

    A loop of the clock shortens or lengthens the tide as it does waves; a tide longer than the loop stands as it does
    at time zero.
    """
    tide, loop_s = settings.tide, settings.time.loop_s
    if not tide.on:
        return np.zeros_like(t, np.float64) if np.ndim(t) else 0.0
    if 0 < loop_s < tide.period_s:
        t = np.zeros_like(t, np.float64)
    at = (moment(t, loop_s) - tide.high_s) / looped(tide.period_s, loop_s)
    height = tide.range_m * (curve_at(tide.curve, at) - 0.5)
    return height if np.ndim(t) else float(height)


def band_m(settings) -> tuple[float, float]:
    """Lowest and highest tide over the mean level; (0, 0) without one."""
    tide = settings.tide
    if not tide.on:
        return 0.0, 0.0
    heights = tide.curve[1::2]
    return tide.range_m * (min(heights) - 0.5), tide.range_m * (max(heights) - 0.5)


def left_s(settings, t: float, count: int = LEFT) -> np.ndarray:
    """Seconds since the still sea last stood at `count` heights from low to high water, float32; 0 under it."""
    low_m, high_m = band_m(settings)
    period_s = looped(settings.tide.period_s, settings.time.loop_s)
    if not settings.tide.on or 0 < settings.time.loop_s < settings.tide.period_s:
        return np.zeros(count, np.float32)  # a tide that stands has left nothing
    ago_s = np.linspace(0, period_s, PAST)
    highest = np.maximum.accumulate(tide_m(settings, moment(t, settings.time.loop_s) - ago_s + period_s))
    first = np.concatenate([[True], np.diff(highest) > 0])  # each height at the latest time that the sea stood there
    return np.interp(np.linspace(low_m, high_m, count), highest[first], ago_s[first]).astype(np.float32)


def sea_level_at(level, t):
    """Height of the still sea at seconds t (arrays too), metres."""
    return level.settings.level.sea_level_m + tide_m(level.settings, t)


def hours_text(seconds: float) -> str:
    """A period as people say it."""
    if seconds < 120:
        return f"{seconds:g} s"
    return f"{seconds / 60:.1f} min" if seconds < 7200 else f"{math.floor(seconds / 36) / 100:g} h"
