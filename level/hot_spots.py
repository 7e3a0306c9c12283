"""Hot spots of the timing (T06): where fronts race, stall, break off the beach or meet a bar, and a way out."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from .earth import GRAVITY
from .level import Level
from .shore import shore_map
from .shore_bed import toll_of
from .timing import TimingMap, timing_map
from .weather_keys import level_at

KINDS = {
    "too_fast": "Too fast",
    "stalling": "Stalling",
    "off_the_beach": "Breaks off the beach",
    "bar": "Doubles over a bar",
}
LEAST_M = 8.0  # across; what is smaller no player sees
AFTER_BREAKING = 0.5  # so much of breaker · depth a wave keeps behind a bar that broke it
MOST = 12  # of one kind, the largest
ROUND = np.ones((3, 3), bool)


@dataclass(frozen=True)
class HotSpot:
    """`x`, `y` world metres of its worst place, `size_m` across (the root of its area), `value` in the kind's unit."""

    kind: str
    x: float
    y: float
    size_m: float
    value: float
    sentence: str
    advice: str


@dataclass(frozen=True)
class Field:
    """What the rules read, on the grid of a timing map."""

    level: Level
    time_s: float
    map: TimingMap
    inner: np.ndarray  # where waves stand, a cell away from the border of that: gradients are known


def hot_spots(level: Level, t: float) -> list[HotSpot]:
    """All hot spots at a moment, the largest of each kind first."""
    now, found = level_at(level, t), timing_map(level, t)
    stands = found.passage.stands
    field = Field(now, t, found, ndimage.binary_erosion(stands, ROUND, border_value=1))
    return [spot for rule in RULES for spot in sorted(rule(field), key=lambda spot: -spot.size_m)[:MOST]]


def _patches(field: Field, where: np.ndarray, worst: np.ndarray) -> Iterator[tuple]:
    """Connected patches of `where`: slices, mask within them, size in metres, (row, col) in the middle of the worst."""
    labels, _ = ndimage.label(where, ROUND)
    for number, box in enumerate(ndimage.find_objects(labels), 1):
        mask = labels[box] == number
        size_m = float(np.sqrt(mask.sum())) * field.map.cell_m
        if size_m < LEAST_M:
            continue
        values = np.where(mask, worst[box], -np.inf)
        at = np.argwhere(values >= values.max() - 0.02 * abs(values.max()))
        row, col = at[np.argmin(((at - at.mean(axis=0)) ** 2).sum(axis=1))]
        yield box, mask, size_m, (int(row) + box[0].start, int(col) + box[1].start)


def _place(field: Field, at: tuple[int, int]) -> tuple[float, float]:
    return at[1] * field.map.cell_m, at[0] * field.map.cell_m


def _too_fast(field: Field) -> Iterator[HotSpot]:
    """Fronts of the depth's clock race over flat ground, swells over deep; only where they run in, not out at sea."""
    passage, timing, shore = field.map.passage, field.level.settings.timing, field.level.settings.shore
    near = passage.depth_m < shore.range_m
    speed = np.minimum(passage.speed_mps, 1e3)
    for _, _, size_m, at in _patches(field, field.inner & near & (speed > timing.fast_mps), speed):
        value = float(speed[at])
        told = f"Fronts race at {_mps(value)} over {size_m:.0f} m, more than {timing.fast_mps:g} m/s."
        yield HotSpot("too_fast", *_place(field, at), size_m, value, told, _slow_down(field, at))


def _slow_down(field: Field, at: tuple[int, int]) -> str:
    """What makes fronts as slow as the limit: by the depth's clock a slope, by travel time a depth."""
    timing, shore, passage = field.level.settings.timing, field.level.settings.shore, field.map.passage
    if timing.share > 0.5:
        depth_m = timing.fast_mps**2 / GRAVITY
        rise_m = float(passage.depth_m[at]) - depth_m
        if rise_m > 0.05:
            return f"Raise the bed here by {rise_m:.1f} m, to {depth_m:.1f} m of depth."
        return "Even out the bed round here: fronts meet from two sides."
    slope = shore.range_m * (1 + shore.runup) / (passage.period_s * shore.count * timing.fast_mps)
    return f"Slope the bed here at 1 : {1 / slope:.0f} or steeper: raise it towards land or lower it towards the sea."


def _stalling(field: Field) -> Iterator[HotSpot]:
    """Slow for longer than the limit: the time that a front spends within the patch."""
    passage, timing = field.map.passage, field.level.settings.timing
    slow = field.inner & (passage.speed_mps < timing.slow_mps)
    for box, mask, size_m, at in _patches(field, slow, -passage.speed_mps):
        spent = ndimage.maximum(_crossing_s(field)[box], mask)
        if spent < timing.stall_s:
            continue
        told = f"Fronts stall: slower than {timing.slow_mps:g} m/s for {spent:.1f} s over {size_m:.0f} m."
        advice = "Lower the bed here or make it flatter: fronts of the depth's clock stand on steep ground."
        if timing.share > 0.5:
            advice = f"Lower the bed here to {timing.slow_mps**2 / GRAVITY + 0.1:.1f} m of depth or more."
        yield HotSpot("stalling", *_place(field, at), size_m, float(spent), told, advice)


def _crossing_s(field: Field) -> np.ndarray:
    """Seconds that a front has been slow when it comes to a cell: since the earliest slow cell round it.

    Not of the whole patch, which may lie along the crests.
    """
    passage, timing = field.map.passage, field.level.settings.timing
    slow = field.inner & (passage.speed_mps < timing.slow_mps)
    reach_m = max(LEAST_M, 2 * timing.slow_mps * timing.stall_s)
    first = ndimage.minimum_filter(np.where(slow, passage.arrival_s, np.inf), 2 * round(reach_m / field.map.cell_m) + 1)
    return np.where(slow, passage.arrival_s - first, 0.0)


def _off_the_beach(field: Field) -> Iterator[HotSpot]:
    """Where the seaward edge of the surf zone lies far from the still shoreline."""
    passage, timing = field.map.passage, field.level.settings.timing
    edge = field.inner & (passage.broken >= 0) & ndimage.binary_dilation(field.inner & (passage.broken < 0), ROUND)
    bed = shore_map(field.level)
    stride = max(1, round(field.map.cell_m / bed.cell_m))
    land = bed.packed[::stride, ::stride, 1] <= 0
    if not land.any():
        return
    away = ndimage.distance_transform_edt(~land[: edge.shape[0], : edge.shape[1]]) * field.map.cell_m
    wide = ndimage.binary_dilation(edge & (away > timing.far_m), ROUND) & field.inner
    for _, _, size_m, at in _patches(field, wide, np.where(edge, away, -1.0)):
        depth_m = float(passage.depth_m[at])
        told = f"Waves break {away[at]:.0f} m off the beach, on {depth_m:.1f} m of depth."
        advice = f"Lower the bed here by {max(0.5, 0.5 * depth_m):.1f} m, or raise it nearer to the beach."
        yield HotSpot("off_the_beach", *_place(field, at), size_m, float(away[at]), told, advice)


def _bar(field: Field) -> Iterator[HotSpot]:
    """The bed falls again on the way in: deeper than the least depth that lies between it and the sea."""
    bed, timing, shore = shore_map(field.level), field.level.settings.timing, field.level.settings.shore
    stride = max(1, round(field.map.cell_m / bed.cell_m))
    rows, cols = field.map.shape
    depth, least = (values[::stride, ::stride][:rows, :cols] for values in (bed.packed[..., 1], bed.bottleneck))
    trough = depth - least
    near = field.map.passage.stands & (least > 0) & (least < shore.range_m) & (trough > timing.bar_m)
    if timing.share > 0.5:  # a swell breaks on it only where it is shallow for such a wave
        near &= field.map.passage.height_m > AFTER_BREAKING * timing.breaker * least
    for _, _, size_m, at in _patches(field, near, trough):
        deep_m, bar_m = float(depth[at]), float(least[at])
        told = f"Behind a bar at {bar_m:.1f} m of depth the bed falls to {deep_m:.1f} m over {size_m:.0f} m: "
        told += f"{_at_a_bar(field)}."
        advice = f"Fill the trough by {deep_m - bar_m:.1f} m, or dig a gap of that depth through the bar."
        yield HotSpot("bar", *_place(field, at), size_m, deep_m - bar_m, told, advice)


def _at_a_bar(field: Field) -> str:
    if field.level.settings.timing.share > 0.5:
        return "waves break on the bar and again on the beach"
    if toll_of(field.level.settings):
        return "a front takes the trough for as shallow as the bar"
    if field.level.settings.shore.monotone:
        return "a front crosses the trough all at once"
    return "one front stands at three places at once"


def _mps(value: float) -> str:
    return f"{value:.1f} m/s" if value < 100 else "over 100 m/s"


RULES: tuple[Callable[[Field], Iterator[HotSpot]], ...] = (_too_fast, _stalling, _off_the_beach, _bar)
