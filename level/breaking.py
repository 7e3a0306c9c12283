"""How a shore wave breaks (D34, H23): it steepens, its lip falls over or foam rolls down, it goes on as a bore.

Points of the water's body are carried ahead, the way the wave goes, and let down: a displacement over phase and
progress in closed form. The type follows from slope and steepness, ξ = tan β / √(H / L₀) (Battjes 1974). The twin is
shaders/breaking.glsl; both sources of phase call it with `u` (phase, 0 on the front), `q` (progress: 0 where the lip
leaves the crest, 1 where it meets the water) and a `Breaker`. By the depth's clock a wave breaks at a share of the
range, by times of travel where it is too high for its depth (breaking_map.py): then it takes `shore.breaking_s`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .arrival_map import Breaks
from .dual import Dual, step
from .earth import GRAVITY
from .noise import value_noise
from .settings import Shore

BREAK_S = 0.78  # where along the range a front stands highest and its lip leaves it; from there it falls
STEEPENED = 0.62  # of its face's width a crest has moved over it when it breaks
SPILLED = 0.5  # share of that where it spills
FACE_MOST_M = 5.0  # a front on a flat is wider than any wave's face
SPILLS, SURGES = (0.3, 0.5), (1.7, 2.4)  # ξ between the types
LIP_OF_M = (0.25, 0.7)  # heights between which a crest throws a lip: a smaller one is thinner than the mesh's cells
FLAT = (0.004, 0.015)  # slopes below which the bed has no way of its own
ASHORE_S = (0.9, 1.0)  # nothing is carried ahead where the water is thin
RAGGED_M = (13.0, 3.1)  # lengths along the crest over which it breaks sooner and later
STEEPENS = -2.5  # progress from which on the landward face steepens

Gradient = tuple[Dual, Dual]  # east and north


@dataclass
class Breaker:
    """Duals at some points: the unit way that waves go, width of a front's face in metres, how far it falls over
    (`plunging`) or leans at all (`leaning`), 0 … 1; progress of a crest that passes `here`, and how far it shows."""

    east: Dual
    north: Dual
    face_m: Dual
    plunging: Dual
    leaning: Dual
    here: Dual
    shows: Dual


@dataclass
class Swell:
    """Of the lead swell at some points: gradient of its times of arrival in cycles per metre, where it breaks, by how
    many cycles the shoreline bends those times, and by what share all this counts against the depth."""

    steep: Gradient
    breaks: Breaks
    bent: Dual
    share: float


@dataclass
class Carried:
    """What breaking does to some points: metres ahead along their way, and their height as a share of the body's own,
    with a `splash` on top."""

    ahead_m: Dual
    stands: Dual
    splash: Dual


def breaking_uniforms(shore: Shore, cycles_a_range: float) -> dict[str, float]:
    """What shaders/breaking.glsl asks for."""
    return {
        "u_shore_plunge": shore.plunge,
        "u_shore_lip_m": shore.lip_m,
        "u_shore_break_rate": break_rate(shore, cycles_a_range),
        "u_shore_iribarren": iribarren(shore),
        "u_shore_ragged": shore.ragged,
        "u_shore_feels_from": feels_from(shore, cycles_a_range),
        "u_shore_breaking_s": shore.breaking_s,
    }


def feels_from(shore: Shore, cycles_a_range: float) -> float:
    """Progress of a crest that passes a place from which on something shows there of waves that break, their tails too:
    before that nobody asks."""
    tail = shore.gap + max(shore.back, shore.width)
    return STEEPENS - shore.ragged - tail * break_rate(shore, cycles_a_range)


def break_rate(shore: Shore, cycles_a_range: float) -> float:
    """Progress that a front makes in one range."""
    return cycles_a_range * shore.interval_s / shore.breaking_s


def iribarren(shore: Shore) -> float:
    """ξ on a bed of slope 1: √(L₀ / H) with the length of the waves in deep water."""
    return math.sqrt(GRAVITY * shore.interval_s**2 / (2 * math.pi) / max(shore.height_m, 0.05))


def length(east: Dual, north: Dual) -> Dual:
    """Length of a vector of duals."""
    size = np.hypot(east.v, north.v)
    safe = np.maximum(size, 1e-9)
    return Dual(size, (east.v * east.dx + north.v * north.dx) / safe, (east.v * east.dy + north.v * north.dy) / safe)


def inverse(x: Dual, least: float) -> Dual:
    """1 / max(x, least)."""
    over = 1.0 / np.maximum(x.v, least)
    rate = np.where(x.v > least, -over * over, 0.0)
    return Dual(over, rate * x.dx, rate * x.dy)


def breaker_at(shore: Shore, cycles_a_range: float, s_body: Dual, bed: Gradient, swell: Swell | None) -> Breaker:
    """`s_body`: place along the range; `bed`: gradient of the depth."""
    along = -cycles_a_range / shore.range_m
    east, north = bed[0] * along, bed[1] * along
    slope = length(*bed)
    here = (s_body - BREAK_S) * break_rate(shore, cycles_a_range)
    xi, known, shows = slope * iribarren(shore), step(*FLAT, slope), Dual(np.ones(np.shape(s_body.v)))
    if swell is not None:
        share, breaks = swell.share, swell.breaks
        east, north = east + (swell.steep[0] - east) * share, north + (swell.steep[1] - north) * share
        xi, known = xi + (breaks.similarity - xi) * share, known + (1.0 - known) * share
        shows = shows + (breaks.shows - shows) * share
        since = (breaks.since_s + swell.bent * shore.interval_s) * (1 / shore.breaking_s)
        here = here + (since - here) * share
    fast = length(east, north)
    over = inverse(fast, 1e-6)
    calm = (1.0 - step(*SURGES, xi)) * known * shows
    face = inverse(fast * (1 / (cycles_a_range * shore.width)), 1 / FACE_MOST_M)
    plunging = step(*SPILLS, xi)
    leaning = (plunging * (1.0 - SPILLED) + SPILLED) * calm
    return Breaker(east * over, north * over, face, plunging * calm, leaning, here, shows)


def progress(shore: Shore, cycles_a_range: float, breaker: Breaker, u: Dual) -> Dual:
    """Progress of a wave, from what it would be were its crest here."""
    return breaker.here - u * break_rate(shore, cycles_a_range)


def raggedness(shore: Shore, values: np.ndarray, x, y, wave) -> Dual:
    """How much sooner the wave of this number breaks at a place, in times of its fall; `values`: the noise lattice."""
    long, short = (value_noise(values, x, y, size, (wave * 13, wave * 31)) - 0.5 for size in RAGGED_M)
    return (long + short * 0.5) * shore.ragged


def carried(shore: Shore, u: Dual, q: Dual, breaker: Breaker, high: Dual, sooner: Dual) -> Carried:
    """What breaking does to points of one wave; `high`: its height there against the highest, `sooner`: raggedness."""
    w, gap, back_s = shore.width, shore.gap, shore.back
    body = step(-gap - 0.4 * back_s, -0.5 * w, u) * (1.0 - step(-0.5 * w, 0.5 * w, u))
    onto_lip = step(-gap - 0.5 * w, -0.5 * w, u)
    lip, underside = onto_lip * (1.0 - step(-0.5 * w, 0.15 * w, u)), 1.0 - step(-0.3 * w, 0.45 * w, u)
    spent = 1.0 - step(1.0, 2.6, q)
    steep = step(STEEPENS, 0.0, q) * (0.45 + 0.55 * spent)
    plunging = breaker.plunging * step(*LIP_OF_M, high * shore.height_m)
    thrown = step(-0.5, 1.1, q) * spent * plunging
    falls = step(-0.2, 1.1, q)
    falls = falls * falls * spent * plunging
    lean = breaker.face_m * body * steep * breaker.leaning * STEEPENED
    ahead = (lean + lip * thrown * high * shore.lip_m) * shore.plunge
    stands = 1.0 - onto_lip * onto_lip * underside * falls * min(shore.plunge, 1.0)
    up = step(0.8, 1.3, q) * (1.0 - step(1.3, 2.6, q)) * plunging * (0.5 * shore.plunge)
    splash = step(0.3 * w, 1.1 * w, u) * (1.0 - step(1.1 * w, 2.4 * w, u)) * up * (1.0 + sooner)
    return Carried(ahead, stands, splash)


def white_water(q: np.ndarray, breaker: Breaker) -> np.ndarray:
    """How white a wave is: from when its lip falls, or slowly where foam only rolls down its face; less once spent."""
    falling, rolling = step(-0.3, 0.9, Dual(q)).v, step(-1.2, 1.2, Dual(q)).v
    grown = rolling + (falling - rolling) * breaker.plunging.v
    return grown * (1.0 - 0.35 * step(3.0, 6.0, Dual(q)).v) * breaker.shows.v


def overhang_m(shore: Shore) -> float:
    """The farthest that anything is carried ahead."""
    return shore.plunge * (STEEPENED * FACE_MOST_M + shore.lip_m)
