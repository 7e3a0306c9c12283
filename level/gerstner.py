"""Gerstner waves offshore by frequency groups (Hitman talk, H05, H06, H28, H29; Diablo IV talk, D11).

`θ = w D·(x, y) − φ t`, crests go to D. Fronts of one group read one base position; between groups the base is deformed,
high frequencies first, so that small waves ride on large ones. Formula: M. Finch, GPU Gems 1, chapter 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrival_map import Passing
from .dual import Dual
from .earth import GRAVITY
from .settings import Sea

SHARES = {3: (0.5, 0.28, 0.22), 5: (0.26, 0.22, 0.2, 0.17, 0.15)}  # of the group's amplitude, the first front leads
AXIS_CLEARANCE_DEG = 6.0
# H07: how far noise bends the crests, by front differently far and to either side
PHASE_GAIN = {5: (1.0, -0.7, 0.85, -1.0, 0.6), 3: (1.0, -0.85, 0.7)}


@dataclass(frozen=True)
class Fronts:
    """One group: arrays of shape (n,); `east`, `north` unit direction, `length_m`, `omega` rad/s, amplitudes in m."""

    east: np.ndarray
    north: np.ndarray
    length_m: np.ndarray
    omega: np.ndarray
    amplitude_m: np.ndarray
    lateral_m: np.ndarray
    begin: np.ndarray  # where along its crests each front's noise begins, in cycles

    @property
    def rms_m(self) -> float:
        """Root mean square height of the group's sum: what adding fronts really brings (H28)."""
        return float(np.sqrt(0.5 * np.sum(self.amplitude_m**2)))


def _off_axis(heading_deg: float) -> float:
    """A heading at least AXIS_CLEARANCE_DEG from north, east, south and west (H05)."""
    off = (heading_deg + 45) % 90 - 45
    side = 1.0 if off >= 0 else -1.0
    return heading_deg + side * max(AXIS_CLEARANCE_DEG - abs(off), 0.0)


def _group(count, heading_deg, amplitude_m, length_m, speed, steepness, variance, rng) -> Fronts:
    wobble = rng.uniform(-1, 1, (3, count))
    begin = np.mod(np.arange(count) * 0.618034 + wobble[0], 1.0)
    spread = 360.0 / count
    headings = [_off_axis(heading_deg + i * spread + variance * 0.28 * spread * wobble[0, i]) for i in range(count)]
    heading = np.radians(headings)
    share = np.array(SHARES[count]) * (1 + 0.5 * variance * wobble[1])
    amplitude = amplitude_m * share / share.sum()
    length = length_m * (1 + 0.45 * variance * wobble[2])
    k = 2 * np.pi / length
    # Past 1 / (k n) the crest would fold over itself; Finch, equation 9 and the text below it.
    lateral = np.minimum(2 * steepness * amplitude, 0.9 / (k * count))
    return Fronts(np.sin(heading), np.cos(heading), length, speed * np.sqrt(GRAVITY * k), amplitude, lateral, begin)


def groups(sea: Sea, seed: int) -> list[Fronts]:
    """The level's groups, high frequency first: five fronts starting from the reverse direction, then three."""
    rng = np.random.Generator(np.random.PCG64(seed + 1))
    low = _group(
        3, sea.swell_heading_deg, sea.swell_m, sea.swell_length_m, sea.swell_speed, sea.swell_steepness,
        sea.variance, rng,
    )  # fmt: skip
    high = _group(
        5, sea.swell_heading_deg + 180, sea.chop_m, sea.chop_length_m, sea.chop_speed, sea.chop_steepness,
        sea.variance, rng,
    )  # fmt: skip
    return [high, low]


@dataclass
class Deformed:
    """A surface point as three duals of the undeformed x, y: world x, y and height over the still sea."""

    x: Dual
    y: Dual
    z: Dual


def _crest_bend(cycles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A smooth rise and fall over one cycle, 0 … 1, and how it changes."""
    f = cycles - np.floor(cycles)
    t = np.abs(2 * f - 1)
    return t * t * (3 - 2 * t), np.where(f < 0.5, -12.0, 12.0) * t * (1 - t)


def phase_noise(sea: Sea, fronts: Fronts, i: int, x: np.ndarray, y: np.ndarray) -> Dual:
    """How far ahead front i of a group is at undeformed points, in wavelengths, with its gradient (H07).

    Two lengths in the golden ratio along the crests, constant along their way: crests bend, and none changes its speed
    or its height.
    """
    crest_x, crest_y = fronts.north[i], -fronts.east[i]
    along = 0.5 * (x * crest_x + y * crest_y) / sea.phase_noise_m
    one, two = _crest_bend(along + fronts.begin[i]), _crest_bend(0.618034 * along - fronts.begin[i])
    gain = sea.phase_noise * PHASE_GAIN[len(fronts.length_m)][i]
    steep = gain * 0.25 * (one[1] + 0.618034 * two[1]) / sea.phase_noise_m
    return Dual(gain * (0.5 * (one[0] + two[0]) - 0.5), steep * crest_x, steep * crest_y)


def travel(point: Deformed, fronts: Fronts, t: float, noises: list[Dual], passing: Passing) -> tuple[Dual, Dual, Dual]:
    """`shift` of the low group on its way over the bed (T06): phases are times of arrival, in cycles, and crests go the
    way in which those grow. `passing` is that of the point."""
    dx, dy, dz = Dual(0.0), Dual(0.0), Dual(0.0)
    for i, (cycles, gain) in enumerate(zip(passing.swells, passing.gains, strict=True)):
        steep = np.hypot(cycles.dx, cycles.dy)
        known = steep > 1e-6
        east = np.where(known, cycles.dx / np.maximum(steep, 1e-6), fronts.east[i])
        north = np.where(known, cycles.dy / np.maximum(steep, 1e-6), fronts.north[i])
        # shorter waves would fold over
        lateral_m = fronts.lateral_m[i] * np.minimum(1, 1 / fronts.length_m[i] / np.maximum(steep, 1e-6))
        theta = 2 * np.pi * (cycles.v + noises[i].v + 0.25 - np.mod(fronts.omega[i] * t / (2 * np.pi), 1.0))
        sin, cos = np.sin(theta), np.cos(theta)
        slope_x, slope_y = (2 * np.pi * part for part in through(cycles, point))
        slope_x, slope_y = slope_x + 2 * np.pi * noises[i].dx, slope_y + 2 * np.pi * noises[i].dy
        gain = Dual(gain.v, *through(gain, point))
        lateral = Dual(lateral_m * cos, -lateral_m * sin * slope_x, -lateral_m * sin * slope_y) * gain
        high = fronts.amplitude_m[i]
        dz = dz + Dual(high * sin, high * cos * slope_x, high * cos * slope_y) * gain
        dx, dy = dx + lateral * east, dy + lateral * north
    return dx, dy, dz


def through(value: Dual, point: Deformed) -> tuple:
    """How something known at deformed places changes with the undeformed x and y."""
    return value.dx * point.x.dx + value.dy * point.y.dx, value.dx * point.x.dy + value.dy * point.y.dy


def shift(point: Deformed, fronts: Fronts, t: float, noises: list[Dual]) -> tuple[Dual, Dual, Dual]:
    """What one group of full weight adds to world x, y and height; gradients go through the chain rule (H29)."""
    dx, dy, dz = Dual(0.0), Dual(0.0), Dual(0.0)
    for i in range(len(fronts.length_m)):
        east, north, k = fronts.east[i], fronts.north[i], 2 * np.pi / fronts.length_m[i]
        cycles = (east * point.x.v + north * point.y.v) / fronts.length_m[i]
        cycles = cycles - np.mod(fronts.omega[i] * t / (2 * np.pi), 1.0) + noises[i].v
        theta = 2 * np.pi * (cycles - np.floor(cycles))
        sin, cos = np.sin(theta), np.cos(theta)
        slope_x = k * (east * point.x.dx + north * point.y.dx) + 2 * np.pi * noises[i].dx
        slope_y = k * (east * point.x.dy + north * point.y.dy) + 2 * np.pi * noises[i].dy
        lateral = Dual(
            fronts.lateral_m[i] * cos, -fronts.lateral_m[i] * sin * slope_x, -fronts.lateral_m[i] * sin * slope_y
        )
        rise = Dual(
            fronts.amplitude_m[i] * sin, fronts.amplitude_m[i] * cos * slope_x, fronts.amplitude_m[i] * cos * slope_y
        )
        dx, dy, dz = dx + lateral * east, dy + lateral * north, dz + rise
    return dx, dy, dz


def shifted(point: Deformed, by: tuple[Dual, Dual, Dual], weight: Dual) -> Deformed:
    """A point moved by a pass."""
    return Deformed(*(old + new * weight for old, new in zip((point.x, point.y, point.z), by, strict=True)))


def deform(point: Deformed, fronts: Fronts, t: float, weight: Dual, noises: list[Dual]) -> Deformed:
    """Add one group to a point; `noises`, by front: `phase_noise` there."""
    return shifted(point, shift(point, fronts, t, noises), weight)
