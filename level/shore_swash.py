"""How far the sheet runs up the sand and back, and how waves differ (D10, H20). Twin: shaders/shore_swash.glsl."""

from __future__ import annotations

import numpy as np

from .dual import Dual, step
from .noise import value_noise
from .settings import Shore


def uprush(shore: Shore) -> float:
    """Part of an interval a wave takes from the water line to the run-up limit; waves closer than that overlap."""
    return min(max(shore.count * shore.runup / (1 + shore.runup), 1e-3), 0.85)


def looped(clock: dict, wave):
    """Number of a wave among those of the loop."""
    return np.mod(wave, clock["u_shore_turns"]) if clock["u_shore_turns"] else wave


def wave_noise(shore: Shore, clock: dict, values: np.ndarray, x, y, wave) -> Dual:
    """0 … 1 along the shore for the wave of this number: what it lacks in height and in reach."""
    wave = looped(clock, wave)
    return value_noise(values, x, y, shore.variety_m, (wave * 17, wave * 29))


def swash(shore: Shore, clock: dict, arrived: Dual, values: np.ndarray, x, y) -> Dual:
    """How far the swash has run, 1 at the run-up limit: up with the front, back before the next one (D10).

    It starts with the speed of its front, and gravity stops it: no corner where neighbours turn at different times.
    The wave that is here now is the one whose front passed the water line last, and reaches as far as it is tall.
    """
    number = np.floor(arrived.v)
    q = arrived - Dual(number)
    wave = clock["u_shore_cycle"] * shore.count + number.astype(np.int64)
    reach = 1.0 - wave_noise(shore, clock, values, x, y, wave) * shore.runup_variety
    up = uprush(shore)
    u = q * (1 / up)
    rising = u * (1.0 + u * (1.0 - u))
    falling = 1.0 - step(up, 1.0, q)
    going_up = q.v < up
    run = Dual(*(np.where(going_up, m, n) for m, n in zip(_parts(rising), _parts(falling), strict=True)))
    return run * reach


def slope_reach(shore: Shore, runup_m: Dual, share: float) -> Dual:
    """Part of the run-up limit that waves reach at all, by the run-up on a beach of this slope; never more than 1."""
    part = runup_m * (1 / max(shore.range_m * shore.runup, 1e-3))
    part = Dual(*(np.where(part.v < 1, low, high) for low, high in zip(_parts(part), (1.0, 0.0, 0.0), strict=True)))
    return 1.0 + (part - 1.0) * (shore.runup_by_slope * share)


def _parts(x: Dual) -> tuple:
    return x.v, x.dx, x.dy
