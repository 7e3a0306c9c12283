"""The surface of water that isn't the sea at a moment, twin of level/shaders/river.glsl (D13)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .dual import Dual, step
from .earth import GRAVITY
from .level import Level
from .loop import looped
from .river_map import DROWNED_M, JOIN_M, river_map

TRAINS = ((0.6, 1.0, 1.0), (0.4, 1.618034, 1.272020))  # share of the height, cycles, their speed: √ of that, deep water


@dataclass
class River:
    """`rise` over the still sea, `still` that without waves, and what comes there of the sea's swell and chop; duals.

    `white` 0 … 1: how far the current has the chop break.
    """

    rise: Dual
    waves: Dual
    chop: Dual
    share: np.ndarray
    still: Dual
    white: np.ndarray
    own: Dual  # share, as a dual


def over_sea(level: Dual) -> Dual:
    """The higher of a level and the sea (0), rounded off within JOIN_M of it."""
    u = np.clip((level.v + JOIN_M) / (2 * JOIN_M), 0, 1)
    return Dual(np.where(u >= 1, level.v, JOIN_M * u * u), u * level.dx, u * level.dy)


def wave_times(level: Level, t) -> list:
    """Cycles that passed till t of both trains, wrapped (or arrays of those)."""
    look = level.settings.river
    first_s = look.wave_length_m / max(look.wave_speed * math.sqrt(GRAVITY * look.wave_length_m / (2 * math.pi)), 1e-6)
    periods = [looped(first_s / faster, level.settings.time.loop_s) for *_, faster in TRAINS]
    return [np.asarray(t, np.float64) % period / period for period in periods]


def river_uniforms(level: Level, t: float) -> dict[str, float | tuple]:
    """What river.glsl declares, samplers excepted."""
    look = level.settings.river
    times = tuple(float(v) for v in wave_times(level, t))
    return {"u_river_wave_m": look.wave_m, "u_river_wave_cycles": 1 / look.wave_length_m, "u_river_wave_time": times}


def river_at(level: Level, t, x, y) -> River | None:
    """The river's surface at world points; None where the level has none."""
    made = river_map(level)
    if made is None:
        return None
    at = made.at(x, y)
    still = at["share"] * over_sea(at["stage"] - level.tide_m)
    rise = still + _waves(level, t, at["along"], at["rough"].v * at["share"].v)
    runs = 1.0 - step(*DROWNED_M, still)
    return River(rise, at["swell"] * runs, at["chop"] * runs, at["share"].v, still, at["white"].v * runs.v, at["share"])


def still_water_m(level: Level, x, y) -> np.ndarray:
    """Height of the water without waves at world points: the sea's at its mean level, or a river's over it."""
    made = river_map(level)
    if made is None:
        return np.full(np.shape(x), level.mean_sea_m)
    at = made.at(x, y)
    return level.mean_sea_m + (at["share"] * over_sea(at["stage"])).v


def _waves(level: Level, t, along: Dual, rough: np.ndarray) -> Dual:
    look = level.settings.river
    height, slope = 0.0, 0.0
    for (part, more, _), gone in zip(TRAINS, wave_times(level, t), strict=True):
        cycles, size = more / look.wave_length_m, look.wave_m * rough * part
        phase = 2 * np.pi * (along.v * cycles - gone)
        height = height + size * np.sin(phase)
        slope = slope + 2 * np.pi * cycles * size * np.cos(phase)
    return Dual(height, slope * along.dx, slope * along.dy)
