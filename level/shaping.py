"""Inverse sculpting (T07): say where a crest shall stand at a moment, get the change of the bed that brings it there.

    shaped = shape_front(level, 14.0, line, 40.0)    # writes nothing: `shaped.change` over `shaped.rect`, m

The sea's depth is multiplied by e^g; g is the least bent plate (shaping_plate.py) that meets the moments asked for
along the line, found again after each look through the real clock: bottleneck, smoothing and noise, or times of
travel. So land stays land, sea stays sea, and no water is joined or cut off.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from .errors import BadInput
from .grid import Rect
from .level import Level
from .shaping_ground import ShapingGround
from .shaping_limits import SLOPE_DEG
from .shaping_lines import crosses_itself, middle, phase_at, resampled
from .shaping_plate import Plate

NODES = {True: 64, False: 112}  # of the plate, a side: while dragging, and at rest
DEMANDS = {True: 44, False: 72}  # at most so many points of the line ask something of it
ROUNDS = {True: 3, False: 6}
TRAVEL_ROUNDS = {True: 2, False: 5}
FURTHEST = 0.7  # of g in one round
CAP = 2.3  # of g at all: ten times as deep, or a tenth
ENOUGH_S = 0.25  # with times of travel a crest that comes this near in time stands where it should
ENOUGH = 0.5  # cells
NEAR = 0.2  # of all that may be missing: no further round
FRAME_S = 1 / 60  # sooner or later than that is now: behind a bar a front passes all of a trough at once
LEAST_M, MOST_M = 2.0, 400.0  # of the radius


@dataclass(frozen=True)
class Forbidden:
    """Points `first` to `last` of the line that the crest doesn't reach: the metres left, and why."""

    first: int
    last: int
    left_m: float
    why: str

    @property
    def text(self) -> str:
        return f"{self.left_m:.1f} m short: {self.why}"


@dataclass(frozen=True)
class Shaped:
    """`change` float32 over `rect`, ground metres; `line` (n, 2) with what is left on it, in metres and seconds."""

    rect: Rect
    change: np.ndarray
    line: np.ndarray
    left_m: np.ndarray
    left_s: np.ndarray
    forbidden: tuple[Forbidden, ...]
    notes: tuple[str, ...]
    wave: int


def shape_front(
    level: Level, t: float, line, radius_m: float, *, at=None, wave: int | None = None, slope_deg: float = SLOPE_DEG
) -> Shaped:
    """The change of the bed within `radius_m` of `at` that makes crest `wave` stand on `line` (n, 2) at moment t.

    `at` is the middle of the line by default, `wave` the one nearest to the line. BadInput says what cannot be.
    """
    line = checked_line(level, line)
    at = middle(line) if at is None else at
    return Shaping(level, t, at, radius_m, wave, slope_deg).shape(line)


class Shaping:
    """What is made once for a whole drag: a disc of bed, its clock, the plate's factors; `quick` for each frame."""

    def __init__(
        self,
        level: Level,
        t: float,
        at,
        radius_m: float,
        wave: int | None = None,
        slope_deg=SLOPE_DEG,
        quick: bool = False,
    ) -> None:
        if not LEAST_M <= radius_m <= MOST_M:
            raise BadInput(f"a radius of {radius_m:g} m is outside {LEAST_M:g} to {MOST_M:g} m")
        if not 1 <= slope_deg <= 80:
            raise BadInput(f"a slope limit of {slope_deg:g}° is outside 1° to 80°")
        self.level, self.t, self.wave, self.quick = level, t, wave, quick
        self.at, self.radius_m = (float(at[0]), float(at[1])), float(radius_m)
        self.ground = ShapingGround(level, t, self.at, self.radius_m, slope_deg, quick)
        self.plate = Plate(self.at, self.radius_m, NODES[quick], level.grid.extent_m)
        if not len(self.plate.free):
            raise BadInput("the disc lies wholly on the border of the level, which shaping leaves alone")

    def shape(self, line: np.ndarray) -> Shaped:
        """The change for a line; BadInput says what cannot be."""
        line = checked_line(self.level, line)
        points = resampled(line, max(self.ground.cell_m, self.plate.step_m / 3), 400)
        wave = self._wave(points)
        sparse_points = resampled(line, 0.75 * self.plate.step_m, DEMANDS[self.quick])
        self._solve(sparse_points, wave)
        if self.ground.share < 1 and not self.quick:
            self._correct(points, wave)
        left_s = self.t - self.ground.passes(points, wave)
        left_m = np.maximum(np.abs(left_s) - FRAME_S, 0) * self.ground.speed_mps(points)
        rect, change = self.ground.change()
        forbidden = self._forbidden(points, left_m, left_s)
        return Shaped(rect, change, points, left_m, left_s, forbidden, _notes(left_m, left_s), wave)

    def _wave(self, points: np.ndarray) -> int:
        """The number of the wave to be moved; BadInput when the line is no place for a crest, or none is near."""
        phase, _ = phase_at(self.level, self.t, *points.T)
        wet = self.ground.wet(points)
        if not wet.all():
            raise BadInput("the line runs onto dry land: a crest can only be moved over the sea's bed")
        wave = int(np.rint(np.median(phase.v))) if self.wave is None else self.wave
        x, y = (np.linspace(-self.radius_m, self.radius_m, 41) + centre for centre in self.at)
        near, here = phase_at(self.level, self.t, *np.meshgrid(x, y))
        here &= np.hypot(x[None] - self.at[0], y[:, None] - self.at[1]) <= self.radius_m
        if not here.any() or not near.v[here].min() - 0.02 <= wave <= near.v[here].max() + 0.02:
            raise BadInput(f"no crest is within {self.radius_m:g} m of there at {self.t:.2f} s")
        if self.ground.share == 0 and not self.ground.possible(points, wave).all():
            raise BadInput("no crest is on the line at that moment: it is spent before, or not yet there")
        return wave

    def _solve(self, points: np.ndarray, wave: int) -> None:
        """Round by round: look through the clock, and bend the plate by what is missing; the best round stays."""
        ground, total, fine = self.ground, np.zeros((self.plate.nodes,) * 2), False
        ground.begin()
        rounds = (TRAVEL_ROUNDS if ground.share > 0 else ROUNDS)[self.quick]
        best = np.inf, total
        for number in range(rounds + 1):
            fine = not self.quick and (fine or number >= rounds - 1)
            missing, left_s = self._missing(points, wave, fine)
            if missing < NEAR and not (fine or self.quick) and ground.share > 0:
                fine = True
                missing, left_s = self._missing(points, wave, fine)
            if missing < best[0] or number == rounds - 1:
                best = missing, total.copy()
            if missing < NEAR or number == rounds:
                break
            rows, wanted = ground.demands(self.plate, points, wave, left_s)
            more = self.plate.meet(rows, wanted)
            total = total + more * min(1.0, FURTHEST / max(float(np.abs(more).max()), 1e-9))
            self._bend(total)
        if missing > best[0]:
            self._bend(best[1])
            if ground.share > 0:
                ground.solve_times(fine)

    def _missing(self, points: np.ndarray, wave: int, fine: bool) -> tuple[float, np.ndarray]:
        """(what is missing on the worst twentieth, 1 is all that may be; seconds at each point, 0 where limits act)."""
        ground = self.ground
        if ground.share > 0:
            ground.solve_times(fine)
        left_s = np.where(ground.limited(points), 0.0, self.t - ground.passes(points, wave))
        if ground.share > 0:
            missing = np.abs(left_s) / ENOUGH_S
        else:
            missing = np.maximum(np.abs(left_s) - FRAME_S, 0) * ground.speed_mps(points) / (ENOUGH * ground.cell_m)
        return float(np.sort(missing)[int(0.95 * (len(points) - 1))]), left_s

    def _bend(self, coefficients: np.ndarray) -> None:
        raised = self.plate.raised(coefficients, *self.ground.axes)
        self.ground.bend(CAP * np.tanh(raised / CAP))

    def _correct(self, points: np.ndarray, wave: int) -> None:
        """What the plate is too coarse for, along the line at full resolution."""
        for _ in range(3):
            left_s = self.t - self.ground.passes(points, wave)
            left_s = np.where(self.ground.limited(points), 0.0, left_s)
            self.ground.correct(points, left_s / self.ground.by_depth_s(points))

    def _forbidden(self, points: np.ndarray, left_m: np.ndarray, left_s: np.ndarray) -> tuple[Forbidden, ...]:
        short = left_m > ENOUGH * self.ground.cell_m * (2 if self.quick else 1)
        if self.ground.share > 0 or self.quick:  # a quick look is coarse where the bed is flat
            short &= np.abs(left_s) > (ENOUGH_S if self.ground.share > 0 else 6 * FRAME_S)
        short = ndimage.binary_opening(short, np.ones(3)) if len(short) > 8 else short
        labels, count = ndimage.label(short)
        found = []
        for number in range(1, count + 1):
            run = np.flatnonzero(labels == number)
            worst = run[np.argmax(left_m[run])]
            found.append(
                Forbidden(int(run[0]), int(run[-1]), float(left_m[worst]), self._why(points[worst : worst + 1]))
            )
        return tuple(found)

    def _why(self, point: np.ndarray) -> str:
        away = float(np.hypot(*(point[0] - self.at)))
        if self.ground.limited(point)[0]:
            return "slope limit"
        if away > self.radius_m - 5 * self.plate.step_m:
            return "too near the edge of the circle"
        if self.ground.share > 0:
            return "the bed in the circle can hold it up or let it run no further"
        return "the water on the way is too shallow or too rough"


def checked_line(level: Level, line) -> np.ndarray:
    """A line as float64 (n, 2); BadInput when it is none, leaves the level or crosses itself."""
    line = np.asarray(line, np.float64)
    if line.ndim != 2 or line.shape[1] != 2 or len(line) < 2 or not np.isfinite(line).all():
        raise BadInput("a line is two points or more, each x and y in metres")
    line = line[np.concatenate([[True], np.hypot(*np.diff(line, axis=0).T) > 1e-6])]
    if len(line) < 2 or math.fsum(np.hypot(*np.diff(line, axis=0).T)) < level.grid.cell_m:
        raise BadInput("the line is shorter than a cell")
    east, north = level.grid.extent_m
    if (line < 0).any() or (line > (east, north)).any():
        raise BadInput("the line leaves the level")
    if crosses_itself(line):
        raise BadInput("the line crosses itself")
    return line


def _notes(left_m: np.ndarray, left_s: np.ndarray) -> tuple[str, ...]:
    part = float(np.quantile(left_m, 0.95)), float(np.quantile(np.abs(left_s), 0.95))
    return (f"95 % of the line within {part[0]:.2f} m and {part[1]:.2f} s",)
