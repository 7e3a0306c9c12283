"""How much foam there is (D04, H18): what shaders/foam_amount.glsl is given at a time, and how white a wind is."""

from __future__ import annotations

import math

import numpy as np

from .loop import CAP_LIFE_S, FOAM_CYCLES, looped, moment, turns
from .settings import Sea, Settings

LIGHT_MPS = 3.7  # up to this wind nothing on the open sea is white
CALM_M, ROUGH_M = 0.1, 0.4  # waves from which on crests bear foam, and bear it whole
CAP_STEPS = (0.7548776662, 0.5698402910)  # multiples of them: no two generations near each other share a place


def water_wind_way(sea: Sea) -> tuple[float, float]:
    """Unit vector to where the wind over the water blows, east and north."""
    heading = math.radians(sea.swell_heading_deg)
    return math.sin(heading), math.cos(heading)


def foam_uniforms(settings: Settings, time_s: float) -> dict:
    """What foam_amount.glsl and flow_places.glsl ask for besides settings, cycles wrapped at `time_s`."""
    water, interval_s, loop_s = settings.water, settings.flow.interval_s, settings.time.loop_s
    cycles = moment(time_s, loop_s) / interval_s
    whole = math.floor(cycles)
    phase = (cycles - whole, whole % FOAM_CYCLES, interval_s if settings.flow.on else 0.0)
    # heights count against the largest possible: a calm's crests are as high in it as a storm's, and bear no foam
    sea = settings.sea
    rough = min(max((sea.swell_m + sea.chop_m - CALM_M) / (ROUGH_M - CALM_M), 0.0), 1.0) if sea.on else 0.0
    rough *= min(max(sea.wind_mps - LIGHT_MPS, 0.0), 1.0)
    return {
        "u_foam_height": settings.foam.height * rough,
        "u_foam_cycle": phase,
        "u_foam_turns": float(turns(interval_s, loop_s)),
        "u_foam_tile_m": water.foam_tile_m,
        "u_foam_amount": water.foam,
        "u_wind_way": water_wind_way(sea),
        **_whitecaps(settings, time_s),
    }


def whitecap_share(wind_mps: float) -> float:
    """Share of the open sea that is white: 3.84e-6 U^3.41 (Monahan & O'Muircheartaigh 1980), none in light wind."""
    return min(3.84e-6 * wind_mps**3.41, 0.6) * min(max(wind_mps - LIGHT_MPS, 0.0), 1.0)


def _whitecaps(settings: Settings, time_s: float) -> dict:
    """Two generations of caps, half a life apart: each comes up, shrinks and is somewhere else the next time."""
    loop_s = settings.time.loop_s
    first = moment(time_s, loop_s) / looped(CAP_LIFE_S, loop_s)
    cycles = [first, first + 0.5]
    ages = [cycle - math.floor(cycle) for cycle in cycles]
    again = turns(CAP_LIFE_S, loop_s)  # after so many the same ones come
    numbers = [math.floor(cycle) % again if again else math.floor(cycle) for cycle in cycles]
    numbers = [2 * number + i for i, number in enumerate(numbers)]
    places = [n * step % 1.0 for n in numbers for step in CAP_STEPS]
    shares = [1 - abs(2 * age - 1) for age in ages]
    return {
        "u_whitecaps": whitecap_share(settings.sea.wind_mps) * float(settings.sea.on),
        "u_cap_place": np.array(places, np.float32),
        "u_cap_age": np.array([*(age - 0.5 for age in ages), *shares], np.float32),
    }
