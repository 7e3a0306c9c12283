"""Rings on the water (H19): what struck it and what floats on it, as closed forms of distance and age.

    rows = rings(level, t, (x, y))    # of the nearest sources, float32 (n, 8); the formula is lib/rings.glsl

A hit sends out the deep-water packet of Cauchy and Poisson: at distance r after t seconds the waves have
k = g t² / (4 r²) and the phase g t² / (4 r), so that long ones run ahead. Its middle, where k is the source's own, goes
with the group speed ½ √(g / k). A floating thing sends out a steady train of that k.
"""

from __future__ import annotations

import math

import numpy as np

from .buoyancy import draft_of
from .drift import drifted
from .earth import GRAVITY
from .level import Level
from .objects import Hit, Prop

MOST = 16  # the nearest ones
HIT_LENGTH_M, FLOAT_LENGTH_M = 0.55, 0.8  # of the wave in the middle, for size 1
HIT_SLOPE, FLOAT_SLOPE = 1.2, 0.3
SPENT = 5.0  # decay times after which a ring is gone


def wave_number(length_m: float, size: float) -> float:
    """1/m of the waves that a thing of this size makes."""
    return 2 * math.pi / (length_m * math.sqrt(size))


def group_speed_mps(k: float) -> float:
    return 0.5 * math.sqrt(GRAVITY / k)


def rings(level: Level, t: float, centre: tuple[float, float]) -> np.ndarray:
    """Rings at time t, hits before what floats.

    World x, y, radius m of the middle (−1: it floats), reach m, wave number 1/m, slope, fading m, phase.
    """
    knobs, rows = level.settings.things, []
    if knobs.rings <= 0:
        return np.zeros((0, 8), np.float32)
    for thing in level.objects.values():
        if isinstance(thing, Hit) and 0 < t - thing.time_s < SPENT * knobs.ring_s:
            rows.append(_hit(thing, t - thing.time_s, knobs))
        elif isinstance(thing, Prop) and thing.floats and thing.ripples and knobs.on:
            rows.append(_float(level, thing, t, knobs))
    rows.sort(key=lambda row: math.hypot(row[0] - centre[0], row[1] - centre[1]))
    rows = sorted(rows[:MOST], key=lambda row: row[2] < 0)
    return np.array(rows, np.float32).reshape(-1, 8)


def _hit(hit: Hit, age_s: float, knobs) -> tuple:
    k = wave_number(HIT_LENGTH_M, hit.size)
    radius_m = group_speed_mps(k) * age_s
    left = math.exp(-age_s / knobs.ring_s) * (1 - (age_s / (SPENT * knobs.ring_s)) ** 2)
    rise = min(radius_m * k / math.pi, 1.0)  # it has to open before it is a ring
    slope = knobs.rings * HIT_SLOPE * min(math.sqrt(hit.size), 1.5) * left * rise
    return hit.x, hit.y, radius_m, 2.3 * radius_m, k, slope, 0.8 * math.sqrt(hit.size), 0.0


def _float(level: Level, prop: Prop, t: float, knobs) -> tuple:
    x, y = drifted(level, prop, t, draft_of(level, prop)) if prop.drifts else (prop.x, prop.y)
    k = wave_number(FLOAT_LENGTH_M, prop.scale)
    turns = math.sqrt(GRAVITY * k) / (2 * math.pi) * t
    fading_m = group_speed_mps(k) * knobs.ring_s
    slope = knobs.rings * FLOAT_SLOPE * min(math.sqrt(prop.scale), 2.0)
    return x, y, -1.0, 3 * fading_m, k, slope, fading_m, 2 * math.pi * (turns - math.floor(turns))
