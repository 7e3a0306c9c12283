"""What the sea does at a point over time: heights, and when crests come (T06); all from the twin.

heights_at(level, times, x, y)                # metres, any number of times and points at once
crest_times(level, probe, 0.0, 60.0)          # [(seconds, metres)], each within a millisecond
wet_times(level, probe, 0.0, 60.0)            # [(seconds, metres, "wet" or "dry")], likewise
"""

from __future__ import annotations

import numpy as np
from scipy.signal import find_peaks

from .gerstner import groups
from .level import Level
from .objects import Probe
from .pick import ground_at
from .pins import pinned
from .river_water import river_at
from .shore import shore_map
from .tide import band_m
from .waves import sea_at
from .weather_keys import whole_keys

EXACT_S = 2.5e-4
GOLDEN = (np.sqrt(5.0) - 1) / 2
SAMPLES = 14  # of the shortest wave's period, enough to see each crest
MOST_SAMPLES = 200_000
AT_ONCE = 4096
WET_M = 0.01  # of water over the ground: less is a film


def probes_of(level: Level) -> list[Probe]:
    """The level's probes by name."""
    return sorted((o for o in level.objects.values() if isinstance(o, Probe)), key=lambda probe: probe.id)


def heights_at(level: Level, times, x, y) -> np.ndarray:
    """Height of the surface in metres, arrays that broadcast: seconds, and world x, y."""
    times, x, y = np.broadcast_arrays(*(np.asarray(v, np.float64) for v in (times, x, y)))
    if _each_its_own(level, times.max(initial=-np.inf)):
        found = [float(sea_at(level, float(t), a, b).height_m) for t, a, b in zip(times.flat, x.flat, y.flat)]
        return np.array(found).reshape(times.shape)
    flat = [values.ravel() for values in (times, x, y)]
    parts = [slice(i, i + AT_ONCE) for i in range(0, times.size, AT_ONCE)]
    found = [sea_at(level, flat[0][part], flat[1][part], flat[2][part]).height_m for part in parts]
    return np.concatenate([*found, np.zeros(0)]).reshape(times.shape)


def _each_its_own(level: Level, latest_s: float) -> bool:
    """Whether moments up to a time can't be asked at once: weather has changed, or pins stand over a sea that moves."""
    changed = any(key.time_s < latest_s for key in whole_keys(level))
    return changed or (level.settings.tide.on and bool(pinned(level)))


def shortest_period_s(level: Level) -> float:
    """Of what moves the surface."""
    settings = level.settings
    omegas = np.concatenate([fronts.omega for fronts in groups(settings.sea, settings.level.seed)])
    fastest = float(omegas.max(initial=0.0)) if settings.sea.on else 0.0
    waves = [2 * np.pi / fastest] if fastest > 0 else []
    return min([*waves, settings.shore.interval_s / 4])


def crest_times(level: Level, probe: Probe, t0: float, t1: float) -> list[tuple[float, float]]:
    """Crests (seconds, metres) that pass a probe from t0 to t1, in order.

    A crest is a moment at which the surface stands highest, `probe.rise_m` or more over the troughs beside it.
    """
    if not t1 > t0:
        return []
    step = max(shortest_period_s(level) / SAMPLES, (t1 - t0) / MOST_SAMPLES)
    spare = max(level.settings.shore.interval_s, 4 * step)  # so that what stands beside the ends is known
    times = np.arange(t0 - spare, t1 + spare + step, step)
    heights = heights_at(level, times, probe.x, probe.y)
    peaks, _ = find_peaks(heights, prominence=max(probe.rise_m, 1e-6))
    if not len(peaks):
        return []
    found, height = _highest(level, probe, times[peaks - 1], times[peaks + 1])
    return [(float(t), float(h)) for t, h in zip(found, height) if t0 <= t <= t1]


def _highest(level: Level, probe: Probe, low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where the surface stands highest in each of some stretches of time, by golden section."""

    def at(times):
        return heights_at(level, times, probe.x, probe.y)

    left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_left, at_right = at(left), at(right)
    while (high - low).max() > EXACT_S:
        earlier = at_left > at_right
        low, high = np.where(earlier, low, left), np.where(earlier, right, high)
        new = np.where(earlier, high - GOLDEN * (high - low), low + GOLDEN * (high - low))
        value = at(new)
        left, right = np.where(earlier, new, right), np.where(earlier, left, new)
        at_left, at_right = np.where(earlier, value, at_right), np.where(earlier, at_left, value)
    middle = 0.5 * (low + high)
    return middle, at(middle)


def events(level: Level, t0: float, t1: float) -> list[dict]:
    """Crests at every probe from t0 to t1, in order of time: rows of events.json."""
    rows = [
        {"probe": probe.id, "time_s": round(time_s, 4), "height_m": round(height_m, 4), "kind": "crest"}
        for probe in probes_of(level)
        for time_s, height_m in crest_times(level, probe, t0, t1)
    ]
    return sorted(rows, key=lambda row: (row["time_s"], row["probe"]))


def wet_and_dry(level: Level, t0: float, t1: float) -> list[dict]:
    """When the ground at every probe comes under water and out of it, from t0 to t1: rows as those of `events`."""
    rows = [
        {"probe": probe.id, "time_s": round(time_s, 4), "height_m": round(height_m, 4), "kind": kind}
        for probe in probes_of(level)
        for time_s, height_m, kind in wet_times(level, probe, t0, t1)
    ]
    return sorted(rows, key=lambda row: (row["time_s"], row["probe"]))


def wet_times(level: Level, probe: Probe, t0: float, t1: float) -> list[tuple[float, float, str]]:
    """Moments (seconds, metres of the water, "wet" or "dry") from t0 to t1 at which WET_M of water come or go."""
    if not t1 > t0 or not _reached(level, probe):
        return []
    step = max(shortest_period_s(level) / SAMPLES, (t1 - t0) / MOST_SAMPLES)
    times = np.linspace(t0, t1, int(np.ceil((t1 - t0) / step)) + 1)
    under = _over_ground_m(level, probe, times) >= WET_M
    turns = np.flatnonzero(under[1:] != under[:-1])
    low, high, comes = times[turns], times[turns + 1], under[turns + 1]
    while len(turns) and (high - low).max() > EXACT_S:
        middle = 0.5 * (low + high)
        past = (_over_ground_m(level, probe, middle) >= WET_M) == comes
        low, high = np.where(past, low, middle), np.where(past, middle, high)
    heights = heights_at(level, high, probe.x, probe.y)
    return [(float(t), float(h), "wet" if wet else "dry") for t, h, wet in zip(high, heights, comes)]


def is_wet(level: Level, probe: Probe, t: float) -> bool:
    """Whether WET_M of water or more stand over the ground at a probe."""
    return _reached(level, probe) and bool(_over_ground_m(level, probe, np.array([t]))[0] >= WET_M)


def _over_ground_m(level: Level, probe: Probe, times: np.ndarray) -> np.ndarray:
    ground_m = ground_at(level, np.array([probe.x]), np.array([probe.y]))
    return heights_at(level, times, probe.x, probe.y) - ground_m


def _reached(level: Level, probe: Probe) -> bool:
    """Whether sea or river ever come there: a hollow inland below the sea's level is dry."""
    at = np.array([probe.x]), np.array([probe.y])
    river = river_at(level, 0.0, *at)
    comes = shore_map(level).at(*at, band_m(level.settings)[1])["sea"].v[0] > 0
    return bool(comes or (river is not None and river.share[0] > 0))
