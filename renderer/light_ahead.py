"""The light of a day's steps, worked out beside the pictures before the sun gets there (Z25).

A step takes 60 to 90 ms, of which NumPy leaves the interpreter free for most. What is not there in time is worked out
by whoever asks: the light is the same either way.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from concurrent.futures import Future, ThreadPoolExecutor
from functools import lru_cache

from ..level import Settings
from ..level.sun import MOON_BELOW_DEG, day_runs, sun_place
from .overcast import Overcast
from .sky_light import SkyLight, made, sky_of

AHEAD_S = 3.0  # mirrored clouds are made up to 2 s before their moment
LOOKS = 24  # moments in that time that are asked for
KEPT = 128  # steps under a sky each

_steps: OrderedDict[tuple, Future] = OrderedDict()
_lock = threading.Lock()


@lru_cache(maxsize=1)
def _worker() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(1, "light")


def step_light(elevation_deg: float, sky: tuple) -> SkyLight:
    """Light under a sun at a step's elevation; `sky` is all else that `made` takes."""
    key = elevation_deg, sky
    with _lock:
        found = _steps.get(key)
        if found is None or found.cancel() or found.cancelled():  # one that waits behind others is quicker made here
            found = None
        else:
            _steps.move_to_end(key)
    if found is not None:
        return found.result()
    light, done = made(elevation_deg, *sky), Future()
    done.set_result(light)
    _keep(key, done)
    return light


def light_ahead(settings: Settings, time_s: float, overcast: Overcast | None, ahead_s: float = AHEAD_S) -> None:
    """Have the steps of the next seconds made by the thread, those of exposure (no clouds in volume) with them."""
    if not day_runs(settings.light) or settings.light.body == "even":
        return
    skies = sky_of(settings, overcast), sky_of(settings, None)
    for key in _coming(settings, time_s, ahead_s, skies):
        with _lock:
            known = key in _steps
        if not known:
            _keep(key, _worker().submit(made, key[0], *key[1]))


def _coming(settings: Settings, time_s: float, ahead_s: float, skies: tuple) -> list[tuple]:
    """Steps in the order in which the sun, and by night the moon, comes to them."""
    from .day_light import LOWEST_DEG, steps_about

    light, found = settings.light, {}
    for look in range(LOOKS + 1):
        sun = sun_place(light, time_s + look * ahead_s / LOOKS)[1]
        for sky in skies:
            for step in steps_about(max(sun, LOWEST_DEG)):
                found[step, sky] = None
            if light.moonlit and sky[1] == "sun" and sun < MOON_BELOW_DEG:
                for step in steps_about(-sun):
                    found[step, (sky[0], "moon", *sky[2:])] = None
    return list(found)


def _keep(key: tuple, future: Future) -> None:
    with _lock:
        _steps[key] = future
        while len(_steps) > KEPT:
            _steps.popitem(last=False)[1].cancel()
