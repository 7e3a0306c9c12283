"""A stroke: begin, move, end or abort. One undo step, the same bytes whenever its samples are played again.

stroke = Stroke(level, journal, BRUSHES["raise"], BRUSHES["raise"].with_params({"size_m": 8}))
stroke.begin(40, 52); stroke.move(60, 55, pressure=0.5); stroke.end()
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from ..level import BadInput, Journal, Level, Rect
from ..level.grid import NOWHERE
from ..level.level import cover
from ..level.params import Section
from .alphas import unpack
from .canvas import Canvas
from .catalog import BRUSHES, Brush
from .footprint import Footprint, Link
from .masks import settled
from .params import AlphaParams, SmoothParams
from .path import Bounds, Dab, Sample
from .stamp import Stamp

FARTHEST_M = 1e9  # a pointer past this is a slip of somebody's arithmetic
ROUNDS = 8  # times that a stroke may go round a torus
FRACTIONS = 65536  # of a cell: a stroke elsewhere on the torus is the same bit for bit


class Stroke:
    """One press of a brush. `invert` (Ctrl) turns the effect round, `smooth` (Shift) smooths with any brush."""

    def __init__(
        self, level: Level, journal: Journal, brush: Brush, params: Section, invert: bool = False, smooth: bool = False
    ) -> None:
        self.level = level
        self.journal = journal
        self.brush = brush
        self.params = params
        self.invert = invert
        self.smooth = smooth
        self.samples: list[Sample] = []
        self.layer = brush.target(params)[0]
        self.click: Dab | None = None  # what a press does that no move has followed yet
        self.step = None

    def begin(self, x: float, y: float, pressure: float = 1.0) -> Rect:
        """Press at world metres; returns the cells changed. BadInput when the place or the pressure is no number."""
        if self.step is not None:
            raise RuntimeError("a stroke begins once")
        sample = _usable(x, y, pressure)
        if sample is None:
            raise BadInput(f"a stroke cannot begin at {x}, {y} m with pressure {pressure}: it takes finite numbers")
        row, params = self._row_and_params()
        invert = self.invert and not self.smooth
        label = row.effect.label(params, invert) or (row.inverse if invert else row.label)
        text = getattr(self.params, "only_where", "")
        self.limits, self.surroundings = settled(self.level, text, row.effect.needs(params))
        self.step = self.journal.begin(label)
        try:
            self._take_up(row, params, invert, sample)
            self.effect.begin(self.canvas, *self.canvas.data.grid.to_cells(sample.x, sample.y))
        except BaseException:
            self.abort()
            raise
        self.samples.append(sample)
        return self._paint(self.path.begin(sample))

    def _take_up(self, row: Brush, params: Section, invert: bool, press: Sample) -> None:
        """Put together canvas, footprint, effect and path."""
        layer, channels = self.brush.target(params, row.effect)
        self.canvas = Canvas(self.level, self.step, layer, channels, self.limits, self.surroundings)
        grid = self.canvas.data.grid
        self.footprint = self._footprint(row, params, params.size_m / grid.cell_m)
        stamped = isinstance(self.footprint, Stamp) and params.alpha_turn == "along"
        self.waits = row.effect.goes_along(params) or stamped
        self.effect = row.effect(params, invert, self.footprint)
        self.masked = row.effect.masked(params, invert) and not row.path.replaces
        spacing_m = params.spacing * self.footprint.radius * grid.cell_m
        self.path = row.path(spacing_m, grid.cell_m, self._bounds(spacing_m + grid.cell_m, press))

    def _footprint(self, row: Brush, params: Section, radius: float) -> Footprint:
        """The row's own, or the brush's alpha."""
        if getattr(params, "alpha", ""):
            return Stamp(radius, unpack(params.alpha), params.alpha_turn, params.alpha_angle_deg, params.alpha_seed)
        return row.footprint(radius, params.falloff)

    def move(self, x: float, y: float, pressure: float = 1.0) -> Rect:
        """Drag to world metres; returns the cells changed. Samples that are no numbers are ignored."""
        sample = _usable(x, y, pressure)
        if sample is None or not self.open:
            return NOWHERE
        if self.path.replaces:
            del self.samples[1:]  # only where the pointer is now counts
        self.samples.append(sample)
        return self._paint(self.path.move(sample))

    def end(self) -> Rect:
        """Release: the stroke becomes one undo step, none when it changed nothing. Returns the cells it changed."""
        if not self.open:
            return NOWHERE
        if not self.path.replaces:
            self._paint(self.path.end())
            self._finish()
        return self.canvas.bounds if self.journal.commit() else NOWHERE

    def abort(self) -> None:
        """Leave no trace of the stroke."""
        if self.open:
            self.journal.abort()

    @property
    def open(self) -> bool:
        """True from begin to end or abort, or until somebody else ends the step (an undo in mid-stroke does)."""
        return self.step is not None and self.journal.open is self.step

    def preview(self) -> dict | None:
        """What the stroke tells while it goes on; a ramp its ends, heights, grade and front speed."""
        return self.effect.preview(self.canvas) if self.open and self.canvas.painted else None

    def _row_and_params(self) -> tuple[Brush, Section]:
        """The row that acts: with Shift it is the smooth one, in the size of the brush in hand."""
        smooth = BRUSHES["smooth"]
        own = self.brush.effect.smoothing(self.params) if self.smooth else None
        if own is not None:
            return self.brush, own
        if not self.smooth or isinstance(self.params, smooth.params):
            return (smooth if self.smooth else self.brush), self.params
        shared = [name for name in AlphaParams.model_fields if name in type(self.params).model_fields]
        return smooth, SmoothParams(**{name: getattr(self.params, name) for name in shared if name != "strength"})

    def _bounds(self, way_m: float, press: Sample) -> Bounds:
        """Where dabs count: round the level, on a torus some rounds about the press."""
        grid = self.canvas.data.grid
        reach_m = self.footprint.reach * grid.cell_m + way_m
        west_m, south_m = grid.origin_m
        east_m, north_m = grid.extent_m
        if grid.wraps:
            reach_m, (west_m, south_m) = ROUNDS * max(east_m, north_m), (press.x, press.y)
            east_m = north_m = 0.0
        return Bounds(west_m - reach_m, south_m - reach_m, west_m + east_m + reach_m, south_m + north_m + reach_m)

    def _paint(self, dabs: Iterable[Dab]) -> Rect:
        """Play dabs; the whole stroke goes when one of them fails."""
        try:
            rects: list[Rect] = self.canvas.rewind() if self.path.replaces else []
            for dab in dabs:
                if self.waits and dab.start == dab.end:
                    self.click = dab
                    continue
                self.click = None
                rects += self.canvas.paint(self._link(dab), self.footprint, self.effect, self.masked)
        except BaseException:
            self.abort()
            raise
        return self._mark(rects)

    def _finish(self) -> None:
        """What waited for the release: a press that became no way, and what an effect does to the whole."""
        rects = []
        try:
            if self.click:
                rects += self.canvas.paint(self._link(self.click), self.footprint, self.effect, self.masked)
            rects += self.effect.finish(self.canvas)
        except BaseException:
            self.abort()
            raise
        self._mark(rects)

    def _mark(self, rects: list[Rect]) -> Rect:
        changed = NOWHERE
        for rect in cover(rects):
            self.level.mark(self.layer, rect)
            changed = changed.union(rect)
        return changed

    def _link(self, dab: Dab) -> Link:
        start, end = dab
        grid = self.canvas.data.grid
        ends = (*grid.to_cells(start.x, start.y), *grid.to_cells(end.x, end.y))
        if grid.wraps:  # a step so fine that whole cells more or less leave the same fraction of a cell
            ends = tuple(round(at * FRACTIONS) / FRACTIONS for at in ends)
        if self.effect.takes_pressure(self.params):
            self.effect.pressed = end.pressure
            return Link(*ends)
        return Link(*ends, start.pressure, end.pressure)


def _usable(x: float, y: float, pressure: float) -> Sample | None:
    """A sample with finite numbers and a pressure held to 0 to 1, or None."""
    x, y, pressure = float(x), float(y), float(pressure)
    if not all(map(math.isfinite, (x, y, pressure))) or max(abs(x), abs(y)) > FARTHEST_M:
        return None
    return Sample(x, y, min(max(pressure, 0.0), 1.0))
