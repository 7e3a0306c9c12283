"""The bed in a disc while a front is shaped: what the clock makes of it, what limits allow, what is changed (T07)."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from scipy import ndimage, sparse

from .arrival import Asked, shore_at, swell
from .beach_map import beach_map
from .dual import Dual, step
from .errors import BadInput
from .gerstner import phase_noise
from .grid import Rect
from .level import Level
from .noise import lattice
from .pins import pins
from .shaping_limits import SlopeLimit, sills
from .shaping_plate import Plate
from .shaping_travel import Times
from .shore import bed_in, shore_map
from .shore_bed import ROCKS_M
from .shore_waves import LANDING_S, Travel, lead_arrival, s_cycles, shore_early
from .weather_keys import level_at

QUICK_SIDE = 160  # samples a side that the clock looks at in each frame of a drag
COARSE = {True: 129, False: 257}  # texels a side of the level in which times of travel are looked for


class ShapingGround:
    """`field` is g over the window, less where slopes would pass the limit: depth becomes depth · e^g."""

    def __init__(self, level: Level, t: float, at, radius_m: float, slope_deg: float, quick: bool) -> None:
        self.level = then = level_at(level, t)
        self.t, self.at, self.radius_m, self.quick = t, at, radius_m, quick
        self.shore, self.share = shore_at(then, t), then.settings.timing.share
        have = shore_map(then, now=True)
        self.map = have = dataclasses.replace(
            have, bottleneck=have.bottleneck + np.float32(then.tide_m)
        )  # a drag changes that of the level
        if not (self.shore.on and (have.bottleneck > 0).any()):
            raise BadInput("there is no sea in this level whose waves could be shaped")
        self._wet = (have.bottleneck > 0).astype(np.float32)
        self.window = self._window()
        self.every = max(1, math.ceil(max(self.window.shape) / QUICK_SIDE)) if quick else 1
        skip = slice(None, None, self.every)
        self.cell_m = have.cell_m * self.every
        self.depth = have.packed[..., 1][self.window.slices][skip, skip] + np.float32(then.tide_m)
        self.sea = (have.bottleneck[self.window.slices][skip, skip] > 0) & (self.depth > 0)
        rows, cols = self.depth.shape
        self.axes = (self.window.col0 * have.cell_m + np.arange(cols) * self.cell_m,
                     self.window.row0 * have.cell_m + np.arange(rows) * self.cell_m)  # fmt: skip
        self.limit = SlopeLimit(self.depth, self.cell_m, self.shore.smooth_m, slope_deg)
        self.pins = pins(then, t)
        self.values = lattice(then.settings.level.seed)
        self.times = Times(then, t, COARSE[quick])
        self.begin()

    def _window(self) -> Rect:
        """The disc and what the clock's smoothing sees round it, in cells of the shore map."""
        cell_m, margin = self.map.cell_m, 3 * max(self.shore.smooth_m, ROCKS_M)
        low = [int((centre - self.radius_m - margin) // cell_m) for centre in self.at]
        high = [math.ceil((centre + self.radius_m + margin) / cell_m) + 1 for centre in self.at]
        rows, cols = self.map.packed.shape[:2]
        window = Rect(low[1], low[0], high[1], high[0]).intersect(Rect(0, 0, rows, cols))
        if window.empty or min(window.shape) < 4:
            raise BadInput("the place is outside the level")
        return window

    def begin(self) -> None:
        """As the bed is."""
        self.plain = np.zeros(self.depth.shape)
        self.local = np.zeros(self.depth.shape)
        self.calm = np.ones(self.depth.shape)
        self._look()

    # What the clock makes of it

    @property
    def field(self) -> np.ndarray:
        return (self.plain + self.local) * self.calm

    def bend(self, plain: np.ndarray) -> None:
        """Take another g, within the limits."""
        self.plain = np.where(self.sea, plain, 0.0)
        self.calm = self.limit.calm(self.plain + self.local)
        self._look()

    def correct(self, points: np.ndarray, more: np.ndarray) -> None:
        """Add to g near the points what is missing there, fading over some cells."""
        sigma = 2.0
        row, col = self._cells(points)
        sums = np.zeros((2, *self.depth.shape))
        for r, wr in ((np.floor(row), 1 - row % 1), (np.floor(row) + 1, row % 1)):
            for c, wc in ((np.floor(col), 1 - col % 1), (np.floor(col) + 1, col % 1)):
                at = np.clip(r, 0, sums.shape[1] - 1).astype(int), np.clip(c, 0, sums.shape[2] - 1).astype(int)
                np.add.at(sums[0], at, wr * wc * np.clip(more, -0.2, 0.2))
                np.add.at(sums[1], at, wr * wc)
        value, weight = (ndimage.gaussian_filter(part, sigma, truncate=4) for part in sums)
        most = float(weight.max())
        if most <= 0:
            return
        near = np.clip(weight / most * 2.5, 0, 1)
        away = np.hypot(self.axes[0][None] - self.at[0], self.axes[1][:, None] - self.at[1]) / self.radius_m
        inside = np.clip((1 - away) / 0.15, 0, 1)
        inside = inside * inside * (3 - 2 * inside)
        self.local += np.where(self.sea, value / np.maximum(weight, 1e-9 * most) * near * near * (3 - 2 * near), 0) * (
            inside * self._off_border()
        )
        self.calm = self.limit.calm(self.plain + self.local)
        self._look()

    def _off_border(self) -> np.ndarray:
        """0 on the level's border, 1 three cells inside."""
        sides = []
        for axis, at in enumerate(self.axes):
            end = self.level.grid.extent_m[axis]
            sides.append(np.clip(np.minimum(at, end - at) / (3 * self.cell_m) - 0.34, 0, 1))
        return np.minimum(sides[0][None], sides[1][:, None])

    def _look(self) -> None:
        depth = (self.depth * np.exp(self.field)).astype(np.float32)
        bed = bed_in(self.level, self.map, self.window, depth, self.every)
        self.packed, self.least = bed.packed, bed.bottleneck

    def solve_times(self, fine: bool = False) -> None:
        """Times of travel over the bed as it is bent, coarsely or as they are drawn."""
        self.times.solve(self._on_texels, fine)

    def _on_texels(self, asked: Asked) -> np.ndarray:
        """g on the texels of an arrival map, 0 outside the window."""
        rows, cols = (np.arange(side) * asked.request.cell_m for side in asked.request.depth_m.shape)
        at_row, at_col = (rows - self.axes[1][0]) / self.cell_m, (cols - self.axes[0][0]) / self.cell_m
        out = np.zeros(asked.request.depth_m.shape)
        inner = [np.flatnonzero((at >= 0) & (at <= side - 1)) for at, side in zip((at_row, at_col), self.depth.shape)]
        if min(map(len, inner)):
            at = np.meshgrid(at_row[inner[0]], at_col[inner[1]], indexing="ij")
            out[np.ix_(*inner)] = ndimage.map_coordinates(self.field, at, order=1)
        return out

    # Along the line

    def _cells(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return (points[:, 1] - self.axes[1][0]) / self.cell_m, (points[:, 0] - self.axes[0][0]) / self.cell_m

    def _at(self, values: np.ndarray, points: np.ndarray) -> np.ndarray:
        return ndimage.map_coordinates(values, self._cells(points), order=1, mode="nearest", output=np.float64)

    def wet(self, points: np.ndarray) -> np.ndarray:
        """Whether points, in the disc or not, lie in the sea."""
        at = points[:, 1] / self.map.cell_m, points[:, 0] / self.map.cell_m
        return ndimage.map_coordinates(self._wet, at, order=1, mode="nearest") > 0.5

    def limited(self, points: np.ndarray) -> np.ndarray:
        """Whether the limits took something away at points."""
        return self._at(self.calm, points) < 0.985

    def possible(self, points: np.ndarray, wave: int) -> np.ndarray:
        """Whether some depth at points makes that wave stand there now, with the depth's clock."""
        s = (self.t / self.shore.interval_s + self._early(points) - self._late(points) - wave) / s_cycles(self.shore)
        return (s > 0.01) & (s < 0.995)

    def _early(self, points: np.ndarray) -> np.ndarray:
        sway = beach_map(self.level).at(*points.T)[1]
        return shore_early(self.shore, *points.T, sway, self.values).v

    def _late(self, points: np.ndarray) -> np.ndarray | float:
        """What the pins make of it, as they stand before the bed changes."""
        return 0.0 if self.pins is None else self.pins.at(*points.T).v

    def passes(self, points: np.ndarray, wave: int) -> np.ndarray:
        """When the crest of a wave passes points over the bed as it is bent, s."""
        early, s_body, late = self._early(points), self._s(points), self._late(points)
        if self.share == 0:
            return (s_body * s_cycles(self.shore) - early + late + wave) * self.shore.interval_s
        bend = phase_noise(self.level.settings.sea, swell(self.level, self.t), 0, *points.T) + late
        way = Travel.of(self.times.at(points), bend, self.share)
        cycles = lead_arrival(
            self.shore, Dual(s_body), Dual(early) * step(0.0, 1.0, Dual(s_body)) - late * (1 - self.share), way
        )
        return (cycles.v + wave) * self.shore.interval_s

    def _s(self, points: np.ndarray) -> np.ndarray:
        """s of the front that is seen: on the clock's depth without rocks."""
        return 1.0 - self._at(self.packed[..., 3], points) / self.shore.range_m

    def speed_mps(self, points: np.ndarray) -> np.ndarray:
        """Ground speed of the crest at points."""
        step_m, parts = self.map.cell_m, []
        for off in ((step_m, 0.0), (0.0, step_m)):
            parts.append((self.passes(points + off, 0) - self.passes(points - off, 0)) / (2 * step_m))
        return 1 / np.maximum(np.hypot(*parts), 1e-3)

    def by_depth_s(self, points: np.ndarray) -> np.ndarray:
        """How the moment follows from g at the points themselves, s."""
        depth = self.shore.range_m * (1 - self._s(points))
        return -np.maximum(depth, 0.05) / self.shore.range_m * s_cycles(self.shore) * self.shore.interval_s

    def demands(self, plate: Plate, points: np.ndarray, wave: int, left_s: np.ndarray):
        """(rows, wanted): what the plate's coefficients do to the moments at the line, and what is missing there."""
        here = plate.rows(*points.T)
        if self.share == 1:
            return self._by_travel(plate, points), left_s
        rows = sparse.diags_array(self.by_depth_s(points)) @ here
        if self.share > 0:
            return ((1 - self.share) * rows + self._by_travel(plate, points)).tocsr(), left_s
        sills, wanted = self._sills(points, wave, left_s)
        if len(sills):
            rows, left_s = sparse.vstack([rows, plate.rows(*sills.T) * -8.0]), np.concatenate([left_s, -8.0 * wanted])
        return rows.tocsr(), left_s

    def _by_travel(self, plate: Plate, points: np.ndarray):
        rows = self.times.rows(plate, points, self.radius_m, np.asarray(self.at))
        landed = step(LANDING_S, 1.0, Dual(self._s(points))).v
        rows = sparse.diags_array(self.share * (1 - landed)) @ rows
        return rows + sparse.diags_array(self.share * landed * self.by_depth_s(points)) @ plate.rows(*points.T)

    def _sills(self, points: np.ndarray, wave: int, left_s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """World places of sills before those points where the clock is too shallow though the bed isn't; missing g."""
        s = (self.t / self.shore.interval_s + self._early(points) - self._late(points) - wave) / s_cycles(self.shore)
        depth = self.depth * np.exp(self.field)
        held = (left_s < -0.02) & (self._at(depth, points) > self._at(self.least, points) + 0.04)
        row, col = self._cells(points[held])
        row, col, missing = sills(depth, self.least, row, col, self.shore.range_m * (1 - s[held]))
        places = np.stack([self.axes[0][0] + col * self.cell_m, self.axes[1][0] + row * self.cell_m], axis=1)
        return places, missing

    # The result

    # Limits and result

    def change(self) -> tuple[Rect, np.ndarray]:
        """(cells of the level, float32 metres of ground) of what is bent; exactly 0 outside the disc and on land."""
        stride, grid, field = self.map.stride, self.level.grid, self.field
        inner = np.argwhere(field != 0)
        if not len(inner):
            return Rect(0, 0, 0, 0), np.zeros((0, 0), np.float32)
        fine = stride * self.every
        row0, col0, row1, col1 = (int(v) for v in (*(inner.min(axis=0) - 2), *(inner.max(axis=0) + 3)))
        corner = self.window.row0 * stride, self.window.col0 * stride
        rect = Rect(corner[0] + row0 * fine, corner[1] + col0 * fine, corner[0] + row1 * fine, corner[1] + col1 * fine)
        rect = rect.intersect(Rect(1, 1, grid.rows - 1, grid.cols - 1))
        depth = self.level.sea_level_m - self.level.height[rect.slices].astype(np.float64)
        row, col = (np.arange(a, b) for a, b in ((rect.row0, rect.row1), (rect.col0, rect.col1)))
        g = field[row[0] - corner[0] : row[-1] + 1 - corner[0], col[0] - corner[1] : col[-1] + 1 - corner[1]]
        if fine > 1:
            at = np.meshgrid((row - corner[0]) / fine, (col - corner[1]) / fine, indexing="ij")
            g = ndimage.map_coordinates(field, at, order=3, mode="constant")
        away = np.hypot(col[None] * grid.cell_m - self.at[0], row[:, None] * grid.cell_m - self.at[1])
        g = np.where((away < self.radius_m) & (depth > 0), g, 0.0)
        return rect, (-depth * np.expm1(g)).astype(np.float32)
