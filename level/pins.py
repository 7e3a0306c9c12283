"""Pins: a crest is here at this moment (T07). One shifts the phase of all waves, several bend it, in closed form.

`later(x)` in cycles is added to the moments of arrival: a constant and a bump about each pin, exp(−(r / reach)²), whose
weights sum to 0, so that far away all waves come alike. The twin of `at` is shaders/pins.glsl.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrival import shore_at
from .dual import Dual
from .earth import GRAVITY
from .errors import BadInput
from .level import Level
from .objects import Pin

MOST_PINS = 8
REVERSED = 0.5  # |∇d| · c from which on crests would overtake each other
SIDE = 65  # samples a side of the level in which that is looked for
LEAST_REACH_M = 5.0


@dataclass(frozen=True)
class Pins:
    """`places` (n, 2) world metres, `weights` (n,) and `shift` in cycles."""

    places: np.ndarray
    weights: np.ndarray
    shift: float
    reach_m: float

    def at(self, x, y) -> Dual:
        """How much later waves come to world points than without pins, cycles."""
        x, y = np.asarray(x, np.float64), np.asarray(y, np.float64)
        total = Dual(np.full(np.shape(x), self.shift), np.zeros(np.shape(x)), np.zeros(np.shape(x)))
        for (east, north), weight in zip(self.places, self.weights, strict=True):
            u, v = (x - east) / self.reach_m, (y - north) / self.reach_m
            bump = weight * np.exp(-(u * u + v * v))
            total = total + Dual(bump, -2 * u * bump / self.reach_m, -2 * v * bump / self.reach_m)
        return total


def bent(places: np.ndarray, cycles: np.ndarray) -> Pins:
    """Pins (n, 2) at which waves shall come that many cycles later, or as many and some whole ones."""
    cycles = cycles[0] + (cycles - cycles[0] + 0.5) % 1.0 - 0.5
    away = np.hypot(*(places[:, None] - places[None]).transpose(2, 0, 1))
    count = len(places)
    if count == 1:
        return Pins(places, np.zeros(1), float(cycles[0]), 1.0)
    nearest = np.where(np.eye(count, dtype=bool), np.inf, away).min(axis=0)
    reach_m = max(float(nearest.mean()), LEAST_REACH_M)
    system = np.zeros((count + 1, count + 1))
    system[:count, :count] = np.exp(-((away / reach_m) ** 2))
    system[:count, count] = system[count, :count] = 1.0
    solved = np.linalg.lstsq(system, np.append(cycles, 0.0), rcond=1e-9)[0]
    return Pins(places, solved[:count], float(solved[count]), reach_m)


def pins(level: Level, t: float) -> Pins | None:
    """The level's pins over the bed as it is; None where it has none."""
    placed = pinned(level)
    if not placed:
        return None
    timing, shore = level.settings.timing, level.settings.shore
    key = (tuple(placed), level.layer_revision("height"), level.sea_level_m, timing, shore, level.settings.sea,
           level.live)  # fmt: skip
    kept = level.derived.get("pins")
    if kept is None or kept[0] != key:
        kept = level.derived["pins"] = key, _of(level, placed)
    return kept[1]


def later(level: Level, t: float, x, y, noise: Dual | None = None) -> Dual:
    """How much later the pins make waves come to world points, cycles, on top of `noise`."""
    found = pins(level, t)
    noise = Dual(0.0) if noise is None else noise
    return noise if found is None else noise + found.at(x, y)


def pinned(level: Level) -> list[Pin]:
    """The pins of a level, by id."""
    found = sorted((o for o in level.objects.values() if isinstance(o, Pin)), key=lambda pin: pin.id)
    return found[:MOST_PINS]


def _of(level: Level, placed: list[Pin]) -> Pins:
    from .shaping_lines import phase_at

    places = np.array([(pin.x, pin.y) for pin in placed], np.float64)
    phases = [float(phase_at(level, pin.time_s, pin.x, pin.y, pinned=False)[0].v) for pin in placed]
    return bent(places, np.array(phases) % 1.0)


def check_pins(level: Level, placed: list[Pin]) -> None:
    """BadInput when pins are too many, or so near each other want such different moments that crests would swap."""
    from .shaping_lines import phase_at

    if len(placed) > MOST_PINS:
        raise BadInput(f"a level has at most {MOST_PINS} pins")
    if len(placed) < 2:
        return
    found = _of(level, placed)
    east, north = level.grid.extent_m
    x, y = np.meshgrid(np.linspace(0, east, SIDE), np.linspace(0, north, SIDE))
    x, y = np.append(x, found.places[:, 0]), np.append(y, found.places[:, 1])
    phase, here = phase_at(level, placed[0].time_s, x, y, pinned=False)
    later = found.at(x, y)
    interval_s = shore_at(level, placed[0].time_s).interval_s
    slowest = 2 * np.pi / (GRAVITY * interval_s**2)  # cycles a metre: no wave of this period is faster
    steep = np.maximum(np.hypot(phase.dx, phase.dy), slowest)
    if (np.hypot(later.dx, later.dy)[here] >= REVERSED * steep[here]).any():
        raise BadInput("pins so near each other want so different moments: crests would change their order")


def pin_uniforms(level: Level, t: float) -> dict:
    """What shaders/pins.glsl asks for."""
    found = pins(level, t)
    if found is None:
        return {}
    packed = np.zeros((MOST_PINS, 4), np.float32)
    packed[: len(found.places), :2] = found.places
    packed[: len(found.places), 2] = found.weights
    return {"u_pins": packed, "u_pin_shift": found.shift, "u_pin_reach_m": found.reach_m}
