"""When each crest of a swell passes each point: the eikonal equation |grad T| = 1 / c by fast marching (Sethian 1996).

T is absolute: `T(x) = D · x / c_ref` where the swell comes in, 0 at the world's origin, so crest n passes x at
`T + n · period`. It refracts over the bed, goes round islands, and meets itself behind them. Compiled fast marching
(scikit-fmm) holds Python's lock: in the window this runs in a process of its own.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy import ndimage

from .blocking import met_wavenumber
from .dispersion import wavenumber
from .errors import BadInput
from .swell_border import Border, direction, find_border, side_phase
from .swell_meeting import meeting

LEAST_DEPTH_M = 0.3  # below it crests would take for ever to reach the water's edge
OVER_LAND = 4  # cells that T goes on past the water's edge, for bilinear reading
ROUNDS = 4  # through a current: with the ways that crests went the round before
EVENS = 1.0  # cells (sigma) over which those turn: where two fronts meet they would jump from round to round
NEVER_S = 1e6  # on the guard outside the border: later than anything, so no stencil reads it
NEEDS_SKFMM = (
    "The travel-time source needs scikit-fmm, which could not be loaded: install it with 'pip install scikit-fmm' "
    "(it is compiled: on Debian first 'apt-get install g++ python3-dev'), or set timing.source to depth."
)


@dataclass(frozen=True)
class TravelTime:
    """Maps `(rows, cols)`, row 0 south, of one swell; `origin_m` is the world place of sample (0, 0)."""

    seconds: np.ndarray  # float32, finite everywhere
    reached: np.ndarray  # bool: water that the swell comes to
    wavenumber: np.ndarray  # float32, rad/m of still water (without painted speed)
    meets: np.ndarray  # float32, 1 where fronts meet from two directions
    origin_m: tuple[float, float]
    cell_m: float
    period_s: float
    heading_deg: float
    depth_ref_m: float  # of the plane wave beyond the border
    speed_ref: float  # its phase speed, m/s
    border: Border | None  # how it comes in; None: it doesn't

    def plane(self, x, y) -> np.ndarray:
        """Seconds of the plane wave that the swell is beyond the level, at world points."""
        return plane_time(x, y, self.heading_deg, self.speed_ref)

    def strided(self, step: int) -> TravelTime:
        """Every `step`-th sample, as depth[::step, ::step] has it."""
        names = ("seconds", "reached", "wavenumber", "meets")
        maps = {name: np.ascontiguousarray(getattr(self, name)[::step, ::step]) for name in names}
        return replace(self, cell_m=self.cell_m * step, **maps)


def plane_time(x, y, heading_deg: float, speed: float) -> np.ndarray:
    """Seconds at which the crest through the world's origin at 0 passes points (x, y), in deep uniform water."""
    east, north = direction(heading_deg)
    return (east * np.asarray(x) + north * np.asarray(y)) / speed


def stride(shape: tuple[int, int], most_side: int) -> int:
    """Every how many samples to take, so that no side has more than `most_side`; at least two are left of each."""
    return max(1, min(math.ceil((max(shape) - 1) / (most_side - 1)), min(shape) - 1))


def strided(depth_m: np.ndarray, cell_m: float, most_side: int) -> tuple[np.ndarray, float]:
    """Every n-th sample and how far they are apart: 256 a side for a brush's preview, 1025 for what stays."""
    step = stride(depth_m.shape, most_side)
    return depth_m[::step, ::step], cell_m * step


def solve(
    depth_m: np.ndarray,
    cell_m: float,
    period_s: float,
    heading_deg: float,
    speed=1.0,
    least_depth_m: float = LEAST_DEPTH_M,
    origin_m: tuple[float, float] = (0.0, 0.0),
    order: int = 2,
    current: np.ndarray | None = None,
) -> TravelTime:
    """Travel time of a swell of one period over a bed: depth (rows, cols), land <= 0; it goes towards `heading_deg`.

    `speed` (number or map) multiplies the phase speed inside the level; `current` (rows, cols, 2) is how fast the water
    goes east and north, m/s: 0 on the level's border.
    """
    depth = np.asarray(depth_m, np.float64)
    felt_m = np.maximum(depth, least_depth_m)
    k = still = wavenumber(period_s, felt_m)
    omega = 2 * np.pi / period_s
    rows, cols = depth.shape
    x, y = origin_m[0] + np.arange(cols) * cell_m, origin_m[1] + np.arange(rows)[:, None] * cell_m
    border = find_border(depth, period_s, heading_deg)
    if border is None:  # it would come from land: the plane wave's time, for something finite, and no water reached
        depth_ref = max(float(depth.max()), least_depth_m)
        speed_ref = omega / float(wavenumber(period_s, depth_ref))
        seconds = np.full(depth.shape, np.nan)
    else:
        depth_ref, speed_ref, turn = border.depth_m, omega / border.k, border.turn
        corner = x[-1 if turn.flip_cols else 0], y[-1 if turn.flip_rows else 0, 0]

        def arrives(k: np.ndarray) -> np.ndarray:
            slowness = k / (omega * np.asarray(speed, np.float64))
            marched = _march(turn.into(depth), turn.into(slowness), border, omega, cell_m, order)
            return turn.back(marched) + float(plane_time(*corner, heading_deg, speed_ref))

        seconds = arrives(k)
        for _ in range(0 if current is None else ROUNDS):
            k = _through(current, seconds, still, felt_m, period_s)
            seconds = arrives(k)
    reached = np.isfinite(seconds)
    meets = meeting(seconds, reached, k, cell_m)
    seconds = over_land(seconds, reached, plane_time(x, y, heading_deg, speed_ref))
    maps = seconds.astype(np.float32, order="C"), reached.copy(order="C"), still.astype(np.float32), meets
    return TravelTime(*maps, origin_m, cell_m, period_s, heading_deg, depth_ref, speed_ref, border)


def _through(current: np.ndarray, seconds: np.ndarray, still: np.ndarray, depth_m, period_s: float) -> np.ndarray:
    """Wavenumbers where water moves, of crests that go the way in which those `seconds` grow."""
    k, felt = still.copy(), current.any(-1)
    slopes = np.gradient(over_land(seconds, np.isfinite(seconds), 0.0))
    north, east = (ndimage.gaussian_filter(slope, EVENS, mode="nearest", truncate=3) for slope in slopes)
    steep = np.maximum(np.hypot(north, east)[felt], 1e-9)
    along = (current[felt, 0] * east[felt] + current[felt, 1] * north[felt]) / steep
    k[felt] = met_wavenumber(period_s, depth_m[felt], along)
    return k


def _march(depth, slowness, border: Border, omega: float, cell_m: float, order: int) -> np.ndarray:
    """Seconds after the plane wave's crest passes the first corner, in the turned frame; NaN where none comes."""
    skfmm = _skfmm()
    rows, cols = depth.shape
    front = np.ones((rows + 2, cols + 2))
    pace = np.ones((rows + 2, cols + 2))
    closed = np.ones((rows + 2, cols + 2), bool)
    wet = depth > 0
    closed[2:, 2:] = ~wet
    pace[2:, 2:] = 1 / slowness
    main, side = _seeds(depth, slowness, border, omega, cell_m)
    # Marching starts from 0 on the zero line of `front`, and takes distance over speed for cells beside it: a chosen
    # speed there gives each cell of the border its own time, a late guard behind it the change of sign.
    early = 1.0 - float(np.fmin.reduce(np.concatenate((main, side)), initial=0.0))
    half = 0.5 * cell_m
    front[0, 1:], front[1:, 0] = -1.0, -1.0
    for seeds, row, guard in ((main, np.s_[1, 1:], np.s_[0, 1:]), (side, np.s_[2:, 1], np.s_[2:, 0])):
        here = np.isfinite(seeds)
        closed[row], closed[guard] = ~here, ~here
        pace[row] = np.where(here, half / (np.where(here, seeds, 0.0) + early), 1.0)
        pace[guard] = half / NEVER_S
    if not closed[1, 1]:  # two signs change at the corner: its distance to the line is shorter
        closed[1, 0] = False
        pace[1, 1] /= math.sqrt(2.0)
        pace[1, 0] = half / NEVER_S
    found = skfmm.travel_time(np.ma.MaskedArray(front, closed), pace, dx=[float(cell_m)] * 2, order=order)
    return np.ma.filled(found, np.nan)[2:, 2:] - early


def _seeds(depth, slowness, border: Border, omega: float, cell_m: float) -> tuple[np.ndarray, np.ndarray]:
    """Seconds on the cells just outside the main side, corner first, and outside the other; NaN: no wave."""
    wet = depth > 0
    along, across = border.k * border.along * cell_m, border.k * border.across * cell_m
    open_main = np.concatenate(([wet[0, 0]], wet[0]))
    main = np.where(open_main, np.arange(-1, depth.shape[1]) * along - across, np.nan)
    if along <= 0:
        side = np.full(depth.shape[0], np.nan)
    else:
        k = slowness[:, 0] * omega
        side = side_phase(k, border.k / k, wet[:, 0], border, cell_m) - along
    return main / omega, side / omega


def over_land(seconds: np.ndarray, reached: np.ndarray, beyond) -> np.ndarray:
    """A map goes on for a few cells past what is reached, as the mean of neighbours; `beyond` farther out."""
    known = reached.copy()
    seconds = np.where(known, seconds, 0.0)
    for _ in range(OVER_LAND):
        total, count = np.zeros_like(seconds), np.zeros(seconds.shape, np.int8)
        for to, of in ((np.s_[1:], np.s_[:-1]), (np.s_[:-1], np.s_[1:])):
            for here, there in (((to, slice(None)), (of, slice(None))), ((slice(None), to), (slice(None), of))):
                total[here] += seconds[there]
                count[here] += known[there]
        new = ~known & (count > 0)
        seconds[new] = total[new] / count[new]
        known |= new
    return np.where(known, seconds, beyond)


def _skfmm():
    """The compiled solver, or one clear sentence: nothing else of the program needs it."""
    try:
        import skfmm
    except ImportError as error:
        raise BadInput(NEEDS_SKFMM) from error
    return skfmm
