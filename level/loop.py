"""A clock that comes round without a seam: every period of the sea becomes a divisor of `time.loop_s` (T05).

The time that the sea reads is the clock's modulo the loop, so the first and the last frame are the same bytes. Weather,
sky and sun keep to the clock; so does what happens once: bursts, hits, movers and what drifts.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .earth import GRAVITY

FOAM_CYCLES = 600  # after so many the jumps of moving foam have come round: 6 / 25 and 5 / 24 of a tile
CAP_LIFE_S = 7.0  # of a whitecap
# baked ripples: tile in metres, turn from the wind in degrees, share of the slope's variance
RIPPLES = ((17.0, -24.0, 0.40), (6.1, 31.0, 0.33), (2.3, -7.0, 0.27))


def looped(period_s: float, loop_s: float) -> float:
    """The period nearest to this one in the number of times that it fits into the loop; without a loop (0), itself."""
    if loop_s <= 0 or not 0 < period_s < math.inf:
        return period_s
    return loop_s / max(round(loop_s / period_s), 1)


def turns(period_s: float, loop_s: float) -> int:
    """How often a looped period comes in the loop; 0 without one."""
    return max(round(loop_s / period_s), 1) if loop_s > 0 else 0


def moment(t, loop_s: float):
    """The time that the sea reads."""
    return t % loop_s if loop_s > 0 else t


def ripple_period_s(tile_m: float) -> float:
    """Time in which a tile of ripples passes: its strongest waves are about a fifth of it, on deep water."""
    return tile_m / math.sqrt(GRAVITY * tile_m / 5 / (2 * math.pi))


@dataclass(frozen=True)
class Change:
    """What a loop does to one period; 0 s where it stands still."""

    name: str
    old_s: float
    new_s: float

    @property
    def percent(self) -> float:
        """How much longer it is, per cent."""
        return 100 * (self.new_s / self.old_s - 1) if self.new_s else 0.0


def loop_changes(level) -> list[Change]:
    """Every period of the level's sea with what the loop makes of it; without a loop none changes."""
    from .gerstner import groups
    from .rain_rings import cell_sides_m, cycle_s

    settings, loop_s = level.settings, level.settings.time.loop_s
    periods = [("shore waves", settings.shore.interval_s), ("foam that moves", settings.flow.interval_s)]
    for word, fronts in zip(("chop", "swell"), groups(settings.sea, settings.level.seed), strict=True):
        for number, omega in enumerate(fronts.omega, 1):
            periods += [(f"{word} front {number}", 2 * math.pi / omega)] if omega > 0 else []
    periods += [(f"ripples of {tile:g} m", ripple_period_s(tile)) for tile, _, _ in RIPPLES]
    periods.append(("whitecaps", CAP_LIFE_S))
    if settings.clouds.on and settings.rain.ripples > 0:
        periods += [(f"drops in cells of {side:.2f} m", cycle_s(side)) for side in cell_sides_m(settings.rain.ring_m)]
    for thing in sorted(level.objects.values(), key=lambda thing: thing.id):
        periods += [(f"lamp {thing.id}", thing.period_s)] if thing.kind == "light" and thing.orbit_m > 0 else []
    rows = [Change(name, float(old), float(looped(old, loop_s))) for name, old in periods]
    if settings.tide.on:
        stands = 0 < loop_s < settings.tide.period_s
        new = 0.0 if stands else looped(settings.tide.period_s, loop_s)
        rows.append(Change("tide", settings.tide.period_s, new))
    return rows


def looped_shore(settings):
    """The shore waves' section with the interval that the loop makes of theirs."""
    shore, loop_s = settings.shore, settings.time.loop_s
    if loop_s <= 0:
        return shore
    return shore.model_copy(update={"interval_s": looped(shore.interval_s, loop_s)})


def looped_omega(omega: np.ndarray, loop_s: float) -> np.ndarray:
    """Angular frequencies (n,) whose periods divide the loop; those that stand, stand."""
    return np.array([2 * math.pi / looped(2 * math.pi / w, loop_s) if w > 0 else w for w in omega])
