"""The shore wave clock (Diablo IV talk, D03, D04, D10): one function for shader, CPU twin, timing and shaping.

`s = 1 − clock depth / range` runs up towards land; the front of wave k is at
`f = fract(t / travel + k / count) · (1 + runup)`. Masks are differences of smoothsteps about f, never negative.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from .arrival_map import Breaks, Passing
from .breaking import BREAK_S, Swell, raggedness
from .breaking_waves import BreakingWaves
from .dual import Dual, positive, step
from .loop import turns
from .noise import LATTICE, value_noise
from .settings import Shore
from .shore_swash import looped, slope_reach, swash, wave_noise

POOL_M = 0.2  # how far below the rim before it ground counts as a pool
POOL_S = 0.97, 1.0  # and where such a rim stands: no wave goes on behind one
LANDING_S = 0.85  # from here to the water line times of arrival become those of the shoreline
SWASH_S = 0.55  # from here to the water line the level follows the swash


@dataclass
class ShoreMasks:
    """Masks at some points; `lift` is height over the still sea with its gradient, `edge_s` the water's edge.

    `arrived` counts the waves that have passed the still water line: its fraction is the phase of beach and sand (H20).
    Where waves break (D34) `shift` is how far east and north points are carried, `way` `(2, …)` whereto, `progress`
    that of the nearest wave and `white` how white the waves are there.
    """

    a: np.ndarray
    b: np.ndarray
    line: np.ndarray
    back: np.ndarray
    fall: np.ndarray
    lift: Dual
    edge_s: np.ndarray
    arrived: np.ndarray
    shift: tuple[Dual, Dual] | None = None
    way: np.ndarray | None = None
    progress: np.ndarray | None = None
    white: np.ndarray | None = None

    def faded(self, waves: Dual) -> ShoreMasks:
        """With as much of the waves as a river leaves there (D35)."""
        own = {name: getattr(self, name) * waves.v for name in ("line", "back", "fall")}
        shift = None if self.shift is None else tuple(way * waves for way in self.shift)
        return replace(self, **own, lift=self.lift * waves, shift=shift)


@dataclass(frozen=True)
class Travel:
    """When the lead swell comes to some points and to the shoreline near them, duals in cycles; its height there
    against where it stands highest, and the share of all this against what follows from the depth (T06)."""

    arrival: Dual
    shore: Dual
    height: Dual
    share: float
    steep: tuple[Dual, Dual] | None = None  # gradient of the lead's arrival, cycles per metre: asked where waves break
    breaks: Breaks | None = None  # and where it does

    @classmethod
    def of(cls, passing: Passing, bend: Dual, share: float, steep=None, breaks=None) -> Travel:
        """`bend`: how much later noise makes the lead's crests, in cycles (H07)."""
        return cls(passing.swells[0] + bend, passing.shore + bend, passing.lead_height, share, steep, breaks)

    def swell(self, shore: Shore, s_body: Dual) -> Swell:
        """What breaking asks of it."""
        return Swell(self.steep, self.breaks, self.bent(shore, s_body), self.share)

    def bent(self, shore: Shore, s_body: Dual) -> Dual:
        """How much later the lead comes for the shoreline's sake: on the sand fronts go on as by the depth's clock."""
        on_land = self.shore + (s_body - 1.0) * s_cycles(shore)
        return (on_land - self.arrival) * step(LANDING_S, 1.0, s_body)


def s_cycles(shore: Shore) -> float:
    """Cycles that a front of the depth's clock takes for the whole range, s = 0 … 1."""
    return shore.count / (1 + shore.runup)


def lead_arrival(shore: Shore, s_body: Dual, early: Dual, travel: Travel) -> Dual:
    """When fronts come, in cycles."""
    by_depth, lead = s_body * s_cycles(shore), travel.arrival + travel.bent(shore, s_body)
    return by_depth + (lead - by_depth) * travel.share - early


def clock_uniforms(shore: Shore, t: float, loop_s: float = 0.0) -> dict[str, float | int]:
    """The clock at t in float64, wrapped, so that no shader ever sees a large time.

    `u_shore_turns`: after so many waves the same ones come again, 0 for never; `t` lies in the loop then (loop.py).
    """
    waves = t / shore.interval_s / shore.count
    whole = np.floor(waves).astype(np.int64) if np.ndim(t) else math.floor(waves)
    return {
        "u_shore_clock": waves - whole,
        "u_shore_cycle": whole % (LATTICE * 64),
        "u_shore_turns": turns(shore.interval_s, loop_s),
    }


def shore_early(shore: Shore, x, y, sway: Dual, values: np.ndarray) -> Dual:
    """How much earlier waves arrive at a place, in intervals: noise, and the sway along the shore (H20)."""
    noise = (value_noise(values, x, y, 3 * shore.variety_m, (11, 37)) - 0.5) * (2 * shore.stagger)
    return noise + sway * shore.sway


def before_waves(shore: Shore, bed: dict[str, Dual]) -> np.ndarray:
    """True where no wave has come yet: deeper than the tail of the outermost one, so every mask and the lift are 0."""
    tail = max(shore.gap + 2 * shore.back, shore.gap + shore.width, shore.width + shore.fall)
    return (not shore.on) | (np.minimum(bed["clock"].v, bed["smoothed"].v) > (1 + tail) * shore.range_m)


def shore_masks(
    shore: Shore, t: float, bed: dict[str, Dual], x, y, sway: Dual, values: np.ndarray, loop_s: float = 0.0,
    travel: Travel | None = None, later: Dual | None = None, steep: tuple[Dual, Dual] | None = None,
) -> ShoreMasks:  # fmt: skip
    """Masks and lift at world points over the bed there (`ShoreMap.at`), with the `sway` there (`BeachMap.at`).

    `values` is the level's noise lattice; `travel` says when waves come where that doesn't follow from the depth alone.
    `steep` is the gradient of the depth, smooth, where waves break (D34).

    The edge on the sand stands on the bed's own contours; waves go over a bed without rocks, or the body would sink
    into a hole round each of them, and foam flicker while its front races through the gaps.
    """
    clock = clock_uniforms(shore, t, loop_s)
    s_body = 1.0 - bed["smoothed"] * (1 / shore.range_m)
    sea = bed["sea"] * bed["within"]
    early = shore_early(shore, x, y, sway, values)
    if travel is not None:
        early = early * step(0.0, 1.0, s_body)
    if later is not None:  # pins (T07)
        early = early - later
    nearest = np.full(np.shape(s_body.v), 9.0)
    a, b, *masks = np.zeros((5, *np.shape(nearest)))
    lift = Dual(*np.zeros((3, *np.shape(nearest))))
    breaks = None
    if steep is not None and shore.plunge > 0:
        breaks = BreakingWaves.begun(shore, s_cycles(shore), s_body, steep, travel and travel.swell(shore, s_body))
    along = height_along(s_body, travel)
    for u, f, wave in _fronts(shore, clock, s_body, early, travel):
        tall = 1.0 - wave_noise(shore, clock, values, x, y, wave) * shore.variety
        a_here, b_here, *here = _wave(shore, u.v, f.v)
        masks = [np.maximum(old, new) for old, new in zip(masks, here, strict=True)]
        closer = np.abs(u.v) < nearest
        nearest = np.where(closer, np.abs(u.v), nearest)
        a, b = np.where(closer, a_here, a), np.where(closer, b_here, b)
        body = _body(shore, u, f)
        if breaks is not None:
            sooner = raggedness(shore, values, x, y, looped(clock, wave))
            body = breaks.broken(u, body, tall * along, sooner, here, closer)
        lift = lift + body * tall
    arrived = _arrived(shore, clock, early, travel)
    run = swash(shore, clock, arrived, values, x, y)
    if travel is not None and shore.runup_by_slope > 0:
        run = run * slope_reach(shore, travel.breaks.runup_m, travel.share)
    edge, rise = 1.0 + shore.runup * run.v, run * (shore.range_m * shore.runup)
    drop = bed["depth"] - bed["clock"]  # how far the bed lies below the rim that its waves came over
    # Behind a rim the swash rises only while it tops the rim; on an open beach drop is 0 and this is 1.
    over = rise + bed["clock"] + (1.0 - step(0.0, POOL_M, drop)) * POOL_M
    level = rise * step(SWASH_S, 1.0, s_body) * step(0.0, POOL_M, over)
    lift = (lift * along * shore.height_m + level) * sea
    on, moving = float(shore.on), float(shore.on and shore.vertex)
    calm = 1.0 - 0.8 * _step(POOL_M, 5 * POOL_M, drop.v) * _step(*POOL_S, s_body.v)
    line, back, fall = (mask * calm * sea.v * on for mask in masks)
    come = ~before_waves(shore, bed)
    edge_s = 1.0 + (edge - 1.0) * moving * come
    masks = ShoreMasks(a * on, b * on, line, back, fall, lift * moving, edge_s, arrived.v * come)
    if breaks is not None:
        masks.shift = breaks.shift(sea * (moving * come))
        masks.way = np.stack([breaks.breaker.east.v, breaks.breaker.north.v])
        masks.progress = np.where(come, breaks.progress, -9.0)
        masks.white = breaks.white * calm * sea.v * on * come
    return masks


def _fronts(shore: Shore, clock: dict, s_body: Dual, early: Dual, travel: Travel | None):
    """(s after the front, the front's own s, number) of the waves about some points."""
    if travel is None:
        for k in range(shore.count):
            c = (early + k) * (1 / shore.count) + clock["u_shore_clock"]
            cycle = np.floor(c.v)
            f = (c - Dual(cycle)) * (1 + shore.runup)
            yield s_body - f, f, (clock["u_shore_cycle"] + cycle.astype(np.int64)) * shore.count - k
        return
    since = Dual(clock["u_shore_clock"] * shore.count) - lead_arrival(shore, s_body, early, travel)
    last = np.floor(since.v)
    for k in range(shore.count + 1):
        u = (Dual(last + 1.0 - k) - since) * (1 / s_cycles(shore))
        yield u, s_body - u, clock["u_shore_cycle"] * shore.count + last.astype(np.int64) + 1 - k


def _step(low: float, high: float, x: np.ndarray) -> np.ndarray:
    return step(low, high, Dual(x)).v


def _wave(shore: Shore, u: np.ndarray, f: np.ndarray) -> tuple[np.ndarray, ...]:
    """A, B, line, back and crest-fall of one wave; u = s − f is 0 on its front, below 0 behind it (D03, D04)."""
    w, gap, back_s, limit = shore.width, shore.gap, shore.back, 1 + shore.runup
    fade = _step(0.0, shore.fade_in, f) * (1.0 - _step(limit - shore.fade_out, limit, f))
    b = _step(-w / 2, w / 2, u)
    a = _step(-gap - w / 2, -gap + w / 2, u)
    c = _step(-gap - back_s, -gap, u)
    fall = _step(-w / 2 - shore.fall / 2, 0.0, u) - _step(0.0, w / 2 + shore.fall, u)
    return a, b, *(np.maximum(mask, 0.0) * fade for mask in (a - b, c - a, fall))


def _body(shore: Shore, u: Dual, f: Dual) -> Dual:
    """The water's body over one wave, of height 1: lifted from the back to the front flank, drawn down behind (D10)."""
    w, gap, back_s, limit = shore.width, shore.gap, shore.back, 1 + shore.runup
    fade = step(0.0, shore.fade_in, f) * (1.0 - step(limit - shore.fade_out, limit, f))
    c = step(-gap - back_s, -gap, u)
    trail = positive(step(-gap - 2 * back_s, -gap - back_s, u) - c)
    shape = positive(c - step(-w / 2, w / 2, u)) - trail * (shore.draw_m / max(shore.height_m, 1e-6))
    return shape * fade


def height_along(s: Dual, travel: Travel | None) -> Dual:
    """Shoaling and breaking as a shape over s: fronts rise on the way in and are spent at the water line."""
    shape = (step(0.0, BREAK_S, s) * 0.7 + 0.3) * (1.0 - step(BREAK_S, 1.0, s))
    return shape if travel is None else shape + (travel.height - shape) * travel.share


def _arrived(shore: Shore, clock: dict, early: Dual, travel: Travel | None) -> Dual:
    """Waves that have passed the still water line since the cycle began."""
    shoreline = s_cycles(shore)
    if travel is not None:
        shoreline = (travel.shore - shoreline) * travel.share + shoreline
    return early - shoreline + clock["u_shore_clock"] * shore.count


def front_speed_mps(shore: Shore, slope: float | np.ndarray) -> float | np.ndarray:
    """Ground speed of a front on a bed of this slope (rise over run): flatter is faster (D03)."""
    return shore.range_m * (1 + shore.runup) / (shore.interval_s * shore.count * np.maximum(slope, 1e-4))
