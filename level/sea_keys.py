"""The fronts of the offshore waves while weather changes (D36): each lies down in its turn, changes, and rises again.

A front whose length changed while it stood would run away far from the origin, and its phase would jump; flat, nobody
sees it. Stateless in time.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from .gerstner import Fronts, groups
from .level import Level
from .loop import looped_omega
from .settings import Sea
from .weather_keys import WeatherKey, base_settings, whole_keys
from .weather_presets import WAVES, WEATHERS

TURNS = ((0, 2, 3, 5, 7), (4, 1, 6))  # in which turn the fronts of chop and of swell lie down
HALF = 0.2  # of the fade: the time in which one of them does


@lru_cache(maxsize=64)
def _groups(sea: Sea, seed: int) -> tuple[Fronts, ...]:
    return tuple(groups(sea, seed))


def seas(level: Level) -> list[Sea]:
    """The sea before all keys and under each of those that act everywhere."""
    sea = base_settings(level).sea
    return [sea, *(_under(sea, key.weather) for key in whole_keys(level))]


def _under(sea: Sea, weather: str) -> Sea:
    values = WEATHERS[weather].values
    return sea.model_copy(update={path.split(".")[1]: values[path] for path in WAVES})


def fronts_at(level: Level, time_s: float) -> list[Fronts]:
    """The level's groups at a time, high frequency first; without keys those of its settings."""
    fronts, loop_s = _fronts(level, time_s), level.settings.time.loop_s
    return [replace(group, omega=looped_omega(group.omega, loop_s)) for group in fronts] if loop_s > 0 else fronts


def _fronts(level: Level, time_s: float) -> list[Fronts]:
    keys, seed = whole_keys(level), level.settings.level.seed
    if not any(np.any(key.time_s < time_s) for key in keys):
        return groups(base_settings(level).sea if keys else level.settings.sea, seed)
    states = [_groups(sea, seed) for sea in seas(level)]
    return [_group([state[n] for state in states], keys, turns, time_s) for n, turns in enumerate(TURNS)]


def flat_s(key: WeatherKey, turns: tuple[int, ...]) -> np.ndarray:
    """When fronts lie flat under a key and take its waves, by their turns."""
    return key.time_s + key.fade_s * (HALF + (1 - 2 * HALF) * np.array(turns) / 7)


def _group(states: list[Fronts], keys: tuple[WeatherKey, ...], turns: tuple[int, ...], time_s: float) -> Fronts:
    """One group: of each front the state that it rose with last, and how far it stands."""
    middles = [flat_s(key, turns) for key in keys]
    gain = np.ones(len(turns))
    for n, (key, middle) in enumerate(zip(keys, middles, strict=True), 1):
        before = _latest(middles, lambda other, middle=middle: other < middle)
        changes = [a < n and states[a] is not states[n] for a in before]  # a later key may have come first
        t = np.clip(np.abs(time_s - middle) / (HALF * key.fade_s), 0, 1)
        gain = np.where(changes, gain * t * t * (3 - 2 * t), gain)
    which = _latest(middles, lambda middle: middle <= time_s)
    picked = {
        name: np.array([getattr(states[state], name)[i] for i, state in enumerate(which)])
        for name in ("east", "north", "length_m", "omega", "amplitude_m", "lateral_m", "begin")
    }
    fronts = Fronts(**picked)
    return replace(fronts, amplitude_m=fronts.amplitude_m * gain, lateral_m=fronts.lateral_m * gain)


def _latest(middles: list[np.ndarray], passed) -> np.ndarray:
    """Number of the last key, 0 for none, of whose middles `passed` holds, by front."""
    which = np.zeros_like(middles[0], int)
    for n, middle in enumerate(middles, 1):
        which = np.where(passed(middle), n, which)
    return which


def largest_amplitude_m(level: Level) -> float:
    """The largest sum of the offshore waves' amplitudes at any time, or at the moment that a level stands for."""
    now = level.settings.sea
    if level.undated is not None:
        return now.swell_m + now.chop_m
    return max(sea.swell_m + sea.chop_m for sea in (now, *seas(level)))
