"""Weather keyed on the clock (D36): presets that follow each other, cross-faded; everything is a function of time.

    now = level_at(level, time_s)  # the level itself without keys, else a shallow copy with the settings of that moment

A key fades from whatever is there to its preset, in `fade_s` from `time_s` on. What moves with a speed that keys change
is the integral of that speed, so nothing jumps (`run_m`), and waves change their length one by one while they lie flat
(sea_keys.py). Flow points come and go in the current itself (`points_change`), not in the settings.
"""

from __future__ import annotations

import copy
import functools
from itertools import pairwise

import numpy as np

from .level import Level
from .loop import looped
from .objects import WeatherKey
from .params import get
from .settings import Settings
from .tide import tide_m
from .weather_presets import SKY, TOUCHED, WEATHERS

KEYED = tuple(path for path in TOUCHED if path != "flow.points")
MOST_AREAS = 16  # of the latest keys that a sky over an area is made of


def keys_of(level: Level) -> tuple[WeatherKey, ...]:
    """The level's keys by time."""
    found = (thing for thing in level.objects.values() if isinstance(thing, WeatherKey))
    return tuple(sorted(found, key=lambda key: (key.time_s, key.id)))


def whole_keys(level: Level) -> tuple[WeatherKey, ...]:
    """Those that act everywhere."""
    return tuple(key for key in keys_of(level) if not key.radius_m)


def base_settings(level: Level) -> Settings:
    """A level's own settings, whatever moment it stands for."""
    return level.undated or level.settings


def share(key: WeatherKey, time_s):
    """How far a key has faded in, 0 … 1; works on arrays."""
    t = np.clip((np.asarray(time_s, np.float64) - key.time_s) / key.fade_s, 0, 1)
    return t * t * (3 - 2 * t)


def faded(start: float, path: str, keys, time_s):
    """A setting's value at a time (arrays too) from its value before all keys."""
    value = start
    for key in keys:
        s = share(key, time_s)
        value = value * (1 - s) + WEATHERS[key.weather].values[path] * s
    return value


def level_at(level: Level, time_s: float) -> Level:
    """A level as keys, loop and tide make it at a time; a level that stands for a moment already stays as it is."""
    if level.undated is not None:
        return level
    dated, loop_s = _keyed(level, time_s), level.settings.time.loop_s
    if not level.settings.tide.on and loop_s <= 0:
        return dated
    if dated is level:
        dated = copy.copy(level)
        dated.undated = level.settings
    dated.tide_m = tide_m(level.settings, time_s)
    if loop_s > 0:
        dated.settings = _looped(dated.settings, loop_s)
    return dated


def _looped(settings: Settings, loop_s: float) -> Settings:
    """With the intervals that a loop makes of them."""
    sections = {name: getattr(settings, name) for name in ("shore", "flow")}
    return settings.model_copy(
        update={
            name: section.model_copy(update={"interval_s": looped(section.interval_s, loop_s)})
            for name, section in sections.items()
        }
    )


def _keyed(level: Level, time_s: float) -> Level:
    """A level as its keys make it at a time; itself where none has begun."""
    keys = whole_keys(level)
    begun = [key for key in keys if np.any(key.time_s < time_s)]
    if not begun:
        return level
    changed: dict[str, dict] = {}
    for path in KEYED:
        section, name = path.split(".")
        changed.setdefault(section, {})[name] = float(faded(get(level.settings, path), path, begun, time_s))
    changed["storm"]["start_s"] = _storm_start(level.settings, begun)
    dated = copy.copy(level)
    dated.undated = level.settings
    dated.settings = level.settings.model_copy(
        update={name: getattr(level.settings, name).model_copy(update=values) for name, values in changed.items()}
    )
    return dated


def points_change(level: Level, time_s: float) -> float:
    """How much stronger flow points are at a time than the level's own."""
    own, path = base_settings(level).flow.points, "flow.points"
    begun = [key for key in whole_keys(level) if key.time_s < time_s]
    return float(faded(own, path, begun, time_s)) - own if begun else 0.0


def _storm_start(settings: Settings, keys) -> float:
    """A key that brings a chance of storm where there was none sends one out; where there is one, it goes on."""
    start, path = settings.storm.start_s, "storm.chance"
    for n, key in enumerate(keys):
        if WEATHERS[key.weather].values[path] > 0 and faded(settings.storm.chance, path, keys[:n], key.time_s) == 0:
            start = key.time_s
    return start


def run_m(level: Level, time_s: float, path: str) -> float:
    """The integral over time of a speed among the settings, metres since time zero."""
    start, keys = get(base_settings(level), path), whole_keys(level)
    begun = tuple(key for key in keys if key.time_s < time_s)
    if not begun:
        return start * time_s
    whole, ends = _pieces(start, path, begun)
    n = int(np.searchsorted(ends, time_s, side="right")) - 1
    return float(whole[n] + _integral(start, path, begun, ends[n], time_s))


@functools.lru_cache(maxsize=64)
def _pieces(start: float, path: str, keys: tuple[WeatherKey, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Times at which a fade begins or ends, from 0 on, and the integral up to each."""
    ends = np.unique([0.0, *(key.time_s for key in keys), *(key.time_s + key.fade_s for key in keys)])
    parts = [_integral(start, path, keys, a, b) for a, b in pairwise(ends)]
    return np.concatenate([[0.0], np.cumsum(parts)]), ends


def _integral(start: float, path: str, keys, low: float, high: float) -> float:
    """Over a piece without a bend: a polynomial of three degrees a fade at most, which Gauss's rule sums exactly."""
    fading = sum(key.time_s < high and key.time_s + key.fade_s > low for key in keys)
    nodes, weights = np.polynomial.legendre.leggauss((3 * fading + 2) // 2)
    half = (high - low) / 2
    at = low + half * (nodes + 1)
    return half * float(np.sum(weights * (faded(start, path, keys, at) + np.zeros_like(at))))


def sky_areas(level: Level, time_s: float) -> tuple[tuple[float, float, float], np.ndarray]:
    """Coverage, type and precipitation everywhere, and float32 `(n, 2, 4)` keys that follow with areas among them.

    A row: east, north, radius (0: everywhere), share; coverage, type, precipitation, 0. Each fades what is before it.
    """
    keys = [key for key in keys_of(level) if key.time_s < time_s]
    if not any(key.radius_m for key in keys):
        return tuple(get(level.settings, path) for path in SKY), np.zeros((0, 2, 4), np.float32)
    done = max((n for n, key in enumerate(keys) if not key.radius_m and share(key, time_s) == 1), default=0)
    first = next((n for n, key in enumerate(keys) if key.radius_m and n >= done), len(keys))
    before = [key for key in keys[:first] if not key.radius_m]
    base = tuple(float(faded(get(base_settings(level), path), path, before, time_s)) for path in SKY)
    rows = [
        ((key.x, key.y, key.radius_m, float(share(key, time_s))),
         (*(WEATHERS[key.weather].values[path] for path in SKY), 0.0))
        for key in keys[first:]
    ]  # fmt: skip
    return base, np.array(rows[-MOST_AREAS:], np.float32).reshape(-1, 2, 4)
