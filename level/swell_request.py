"""What is asked of the solver of travel time and wave heights, and what comes back: data that a process can carry.

`solve_request` is the one way to an answer: called at once or in another process it gives the same bits.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy import ndimage

from .beat import beat
from .request import Request
from .travel_time import LEAST_DEPTH_M, TravelTime, solve, stride
from .wave_heights import BREAKS_AT, WaveHeights, wave_heights

BYTES_PER_CELL = 13 + 38  # of `TravelTime` and `WaveHeights` together
LAND_COUNTS_M = 3.0  # height of land in the smoothed bed: a cliff isn't deeper under water for being high
LEAST_OF_DEPTH = 0.25  # of the water's own depth: a channel between rocks stays one


@dataclass(frozen=True)
class Swell:
    """One swell: period, where it goes to (clockwise from north), crest to trough beyond the level."""

    period_s: float
    heading_deg: float
    height_m: float = 0.0  # 0: only its time is asked for


@dataclass(frozen=True)
class SwellRequest(Request[tuple["SwellResult", ...]]):
    """A bed and the swells over it."""

    depth_m: np.ndarray  # float32 (rows, cols), row 0 south, land <= 0
    cell_m: float
    swells: tuple[Swell, ...]
    speed: np.ndarray | None = None  # painted, multiplies the phase speed
    current: np.ndarray | None = None  # (rows, cols, 2), east and north m/s
    origin_m: tuple[float, float] = (0.0, 0.0)
    least_depth_m: float = LEAST_DEPTH_M
    bed_over_m: float = 4.0  # waves feel a bed smoothed so wide (sigma): not each boulder; 0: the bed as it is
    heights_side: int = 513  # most samples a side of the maps of height
    breaks_at: float = BREAKS_AT
    runup: str = "hunt"

    def kept(self) -> SwellRequest:
        names = [name for name in ("depth_m", "speed", "current") if getattr(self, name) is not None]
        return replace(self, **{name: np.array(getattr(self, name), np.float32) for name in names})

    @property
    def answer_bytes(self) -> int:
        return (BYTES_PER_CELL * self.depth_m.size + (1 << 12)) * len(self.swells)

    def answered(self) -> tuple[SwellResult, ...]:
        return solve_request(self)

    @property
    def step(self) -> int:
        """Every how many samples the maps of height have one."""
        return stride(self.depth_m.shape, self.heights_side)


@dataclass(frozen=True)
class SwellResult:
    """Of one swell; `heights` has every `step`-th sample, None where no height was asked for."""

    time: TravelTime
    heights: WaveHeights | None
    step: int


def solve_request(request: SwellRequest) -> tuple[SwellResult, ...]:
    """Travel time and heights of each swell, in the order asked."""
    bed_m = felt_bed(np.asarray(request.depth_m, np.float32), request.cell_m, request.bed_over_m)
    return tuple(_solve(request, bed_m, swell) for swell in request.swells)


def felt_bed(depth_m: np.ndarray, cell_m: float, over_m: float) -> np.ndarray:
    """Depth as long waves feel it: boulders and ripples smoothed away, channels and pools kept, float32.

    A wave goes over and round what is small against its length; each boulder would cast a shadow along a ray.
    """
    if over_m <= 0:
        return depth_m
    wide = ndimage.gaussian_filter(np.maximum(depth_m, -LAND_COUNTS_M), over_m / cell_m, mode="nearest")
    wet = np.where(depth_m > 0, np.maximum(wide, LEAST_OF_DEPTH * depth_m), wide)
    return np.where((depth_m > 0) | (wide > 0), wet, np.minimum(depth_m, 0.0)).astype(np.float32)


def _solve(request: SwellRequest, depth_m: np.ndarray, swell: Swell) -> SwellResult:
    beat()
    step = request.step
    speed = 1.0 if request.speed is None else request.speed
    found = solve(
        depth_m, request.cell_m, swell.period_s, swell.heading_deg, speed, request.least_depth_m, request.origin_m,
        current=request.current,
    )  # fmt: skip
    beat()
    if swell.height_m <= 0:
        return SwellResult(found, None, step)
    thinned = found if step == 1 else found.strided(step)
    least = min(0.1, request.least_depth_m)
    heights = wave_heights(
        depth_m[::step, ::step],
        thinned,
        swell.height_m,
        breaks_at=request.breaks_at,
        least_depth_m=least,
        runup=request.runup,
    )
    return SwellResult(found, heights, step)
