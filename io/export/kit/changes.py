"""How weather keys, storms and the tide change a kit's uniforms: straight lines between knots, a curve."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ....level import Level
from ....level.beat import beat
from ....level.loop import looped
from ....level.sea_keys import TURNS, flat_s
from ....level.storm import FARTHEST_M, FORMS_M
from ....level.weather_keys import keys_of, whole_keys

STEPS = 160  # straight pieces of a fade: a front lies down and rises in a fifth of it
BESIDE_S = 1e-4  # knots so close to either side of a jump

TIDE_FORMULA = (
    "part = fract((t - high_s) / period_s), t taken modulo loop_s where that is above 0; between its neighbours "
    "(p0, h0) and (p1, h1) of curve, which goes round: h = h0 + (h1 - h0) * (1 - cos(pi * (part - p0) / (p1 - p0))) / 2"
    "; tide = range_m * (h - 0.5); uniform = base + tide"
)


@dataclass(frozen=True)
class Track:
    """Values `(knots, …)` by uniform at `times_s`, and how far off the straight lines between were measured to be."""

    times_s: tuple[float, ...]
    values: dict[str, np.ndarray]
    error: dict[str, float]

    def at(self, name: str, t: float) -> np.ndarray:
        """A uniform at a time, from the first knot to the last."""
        n = int(np.clip(np.searchsorted(self.times_s, t, side="right") - 1, 0, len(self.times_s) - 2))
        low, high = self.times_s[n], self.times_s[n + 1]
        part, values = min(max((t - low) / (high - low), 0.0), 1.0), self.values[name]
        return values[n] + (values[n + 1] - values[n]) * part


NO_TRACK = Track((), {}, {})


@dataclass(frozen=True)
class Tide:
    """The tide's curve, and the uniforms that it is added to."""

    period_s: float
    high_s: float
    range_m: float
    curve: tuple[float, ...]
    base: dict[str, float]


def tide_of(level: Level, at_0: dict) -> Tide | None:
    """The tide of a level; None where none moves the sea."""
    tide, loop_s = level.settings.tide, level.settings.time.loop_s
    if not tide.on or 0 < loop_s < tide.period_s:
        return None
    mean = level.settings.level.sea_level_m
    base = {name: off for name, off in (("u_tide_m", 0.0), ("u_sea_level_m", mean)) if name in at_0}
    return Tide(looped(tide.period_s, loop_s), tide.high_s, tide.range_m, tide.curve, base)


def knots_of(level: Level) -> list[float]:
    """Times in seconds between which what keys and storms change is nearly straight, rising; [] without any."""
    keys, found = keys_of(level), []
    for key in keys:
        found += list(np.linspace(key.time_s, key.time_s + key.fade_s, STEPS + 1))
    found += [middle + side for middle in switches(level) for side in (-BESIDE_S, BESIDE_S)]
    storm, wind_mps = level.settings.storm, max(level.settings.weather.wind_mps, 0.1)
    if storm.chance > 0:
        formed_s = min(FORMS_M, storm.distance_m / 4) / wind_mps
        found += [*(storm.start_s + np.linspace(0, formed_s, STEPS + 1)), storm.start_s + FARTHEST_M / wind_mps]
    if not found:
        return []
    return sorted({0.0, *(float(t) for t in found if t > 0)})


def switches(level: Level) -> list[float]:
    """When some front takes the wave of a key (sea_keys.py), rising."""
    turns = tuple(turn for group in TURNS for turn in group)
    return sorted({float(t) for key in whole_keys(level) for t in flat_s(key, turns)})


def track_of(knots: list[float], names: list[str], truth: Callable[[float], dict]) -> Track:
    """The track of some uniforms, its error measured half-way between knots."""
    if not knots or not names:
        return NO_TRACK
    if len(knots) == 1:
        knots = [*knots, knots[0] + 1.0]
    seen = [_heard(truth, t) for t in knots]
    values = {name: np.stack([np.asarray(one[name], np.float64) for one in seen]) for name in names}
    middles = [(a + b) / 2 for a, b in pairwise(knots) if b - a > 2.5 * BESIDE_S]
    track, error = Track(tuple(knots), values, {}), dict.fromkeys(names, 0.0)
    for t in middles:
        its = _heard(truth, t)
        for name in names:
            off = np.abs(track.at(name, t) - np.asarray(its[name], np.float64)).max()
            error[name] = float(np.maximum(error[name], off))  # max() would drop a NaN
    return Track(track.times_s, values, error)


def _heard(truth: Callable[[float], dict], t: float) -> dict:
    beat()
    return truth(t)
