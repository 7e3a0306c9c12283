"""The moments at which swells arrive, as a map that shader and twin read alike (T06).

Crest n of swell i passes a place at `seconds[i] + n · period_s[i]`. The twin of `at` is shaders/arrival.glsl: a
quadratic B-spline over the texels, for the way of a wave is the map's gradient, and that must not jump between them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .dual import Dual, step
from .spline import second_order, spline_weights

SWELLS = 3  # fronts of the low group
BEYOND_M = 160.0  # over this way past the level's border times become those of the plane wave that comes in
APART = (0.2, 0.6)  # cycles between the two from which on the wave lies down in between
TIMES, HEIGHTS, BREAKS = range(3)
BLOCKS = 3


@dataclass(frozen=True)
class Passing:
    """At some points, duals: `swells` in cycles of their periods, `lead_height` against where it stands highest.

    `gains` are the swells' heights against those offshore; `shore` is when the lead meets the shoreline near by.
    """

    swells: tuple[Dual, ...]
    shore: Dual
    gains: tuple[Dual, ...]
    lead_height: Dual


@dataclass(frozen=True)
class Breaks:
    """At some points, duals: seconds since the lead broke that passes now, below 0 before it does; 0 … 1 how far that
    shows; surf similarity as it breaks; run-up of the shore near by in metres."""

    since_s: Dual
    shows: Dual
    similarity: Dual
    runup_m: Dual


@dataclass(frozen=True)
class ArrivalMap:
    """`packed` float32 `(3 rows, cols, 4)`, row 0 south: times in seconds of three swells and of the lead at the
    shoreline; above them the height of the lead's shore wave and the gains of the swells; above those how the lead
    breaks: seconds since then, below 0 before, how far that shows, surf similarity, run-up in metres.

    `plane` `(3, 2)`: s/m, the way of the plane wave that comes in, over its speed. With a tide there are maps of higher
    seas `above`, and everything is a straight line from one to the next (arrival_tide.py).
    """

    packed: np.ndarray
    cell_m: float
    period_s: tuple[float, float, float]
    plane: np.ndarray
    settled: bool = True  # False: coarse, or of a bed that has changed since
    reached: np.ndarray | None = None  # bool (rows, cols, 3): water that each swell comes to
    above: tuple[ArrivalMap, ...] = ()
    rise: float | np.ndarray = 0.0  # 0 this map, 1 the first above; one a point where each has a moment of its own

    @property
    def shape(self) -> tuple[int, int]:
        rows, cols = self.packed.shape[:2]
        return rows // BLOCKS, cols

    def block(self, which: int) -> np.ndarray:
        """TIMES, HEIGHTS or BREAKS, `(rows, cols, 4)`, of one moment."""
        rows = self.shape[0]
        return self._packed_now[which * rows : (which + 1) * rows]

    @property
    def sources(self) -> tuple[np.ndarray, ...]:
        """`packed` of each sea level that it knows; two maps of the very same sources differ in `rise` at most."""
        return self.packed, *(one.packed for one in self.above)

    @property
    def texture(self) -> np.ndarray:
        """What the shader reads: the sources, the lowest sea first."""
        return np.concatenate(self.sources) if self.above else self.packed

    def only(self, rise) -> ArrivalMap:
        """The same at other moments."""
        return replace(self, rise=rise)

    @property
    def plane_now(self) -> np.ndarray:
        """`plane` `(3, 2)` of one moment."""
        return self._mixed(one.plane for one in (self, *self.above))

    @cached_property
    def _packed_now(self) -> np.ndarray:
        return self._mixed(self.sources).astype(np.float32) if self.above else self.packed

    @property
    def _shares(self) -> list:
        """Of each level in what is between."""
        return [np.maximum(1.0 - np.abs(self.rise - level), 0.0) for level in range(1 + len(self.above))]

    def _mixed(self, parts):
        """A straight line between things of each level, arrays or duals."""
        first, *others = (part * share for part, share in zip(parts, self._shares, strict=True))
        return sum(others, start=first)

    def rest_at(self, shape: tuple[int, int]) -> np.ndarray:
        """Heights and how waves break at as many samples as another map of the same ground has, one over the other."""
        return np.concatenate([resized(self.block(which), shape) for which in (HEIGHTS, BREAKS)]).astype(np.float32)

    def with_rest(self, rest: np.ndarray) -> ArrivalMap:
        """These times with the heights and the rest of another map."""
        return replace(self, packed=np.concatenate([self.block(TIMES), rest]))

    def steep(self, x, y) -> tuple[Dual, Dual]:
        """Gradient of the lead's time of arrival in cycles per metre, east and north with their gradients (H23)."""
        if self.above:
            both = zip(*(one.steep(x, y) for one in self._levels), strict=True)
            return tuple(self._mixed(parts) for parts in both)
        east, north = second_order(self.block(TIMES)[..., 0], self.cell_m, x, y)
        return east * (1 / self.period_s[0]), north * (1 / self.period_s[0])

    @property
    def _levels(self) -> tuple[ArrivalMap, ...]:
        return replace(self, above=(), rise=0.0), *self.above

    def breaks(self, x, y) -> Breaks:
        """How the lead breaks at world points; beyond the border as on it."""
        (rows, cols), u, v = self.shape, np.asarray(x) / self.cell_m, np.asarray(y) / self.cell_m
        ui, vi = np.clip(u, 0, cols - 1), np.clip(v, 0, rows - 1)
        found = self._spline(BREAKS, ui, vi)
        in_x, in_y = u == ui, v == vi
        return Breaks(*(Dual(found.v[..., i], found.dx[..., i] * in_x, found.dy[..., i] * in_y) for i in range(4)))

    def at(self, x, y, heights: bool = True) -> Passing:
        """What passes world points (arrays); without `heights` only when: no gains, a height of 0."""
        (rows, cols), x, y = self.shape, np.asarray(x, np.float64), np.asarray(y, np.float64)
        u, v = x / self.cell_m, y / self.cell_m
        ui, vi = np.clip(u, 0, cols - 1), np.clip(v, 0, rows - 1)
        out_x, out_y = (u - ui) * self.cell_m, (v - vi) * self.cell_m
        times = self._spline(TIMES, ui, vi)
        high = self._spline(HEIGHTS, ui, vi) if heights else None
        times = times.v + times.dx * out_x[..., None] + times.dy * out_y[..., None], times.dx, times.dy
        away = np.hypot(out_x, out_y)
        reach = np.maximum(away, 1e-6)
        beyond = step(0.0, BEYOND_M, Dual(away, out_x / reach, out_y / reach))
        swells, gains = [], []
        for i in range(SWELLS):
            cycles = Dual(*(part[..., i] for part in times)) * (1 / self.period_s[i])
            cycles, lies = self._joined(i, cycles, beyond, x, y)
            swells.append(cycles)
            if high is not None:
                gain = Dual(*(part[..., 1 + i] for part in (high.v, high.dx, high.dy)))
                gains.append((gain + (1.0 - gain) * beyond) * lies)
        shore = Dual(*(part[..., 3] for part in times)) * (1 / self.period_s[0])
        lead = Dual(0.0) if high is None else Dual(*(part[..., 0] for part in (high.v, high.dx, high.dy)))
        return Passing(tuple(swells), shore, tuple(gains), lead)

    def _joined(self, i: int, cycles: Dual, beyond: Dual, x, y) -> tuple[Dual, np.ndarray]:
        """Cycles that become those of the plane wave beyond the border, and what is left of the height in between."""
        east, north = (
            self._mixed(one.plane[i, axis] for one in (self, *self.above)) / self.period_s[i] for axis in (0, 1)
        )
        plane = Dual(east * x + north * y, east, north)
        gap = plane - cycles
        lies = 1.0 - 4.0 * beyond.v * (1.0 - beyond.v) * step(*APART, Dual(np.abs(gap.v))).v
        return cycles + gap * beyond, lies

    def _spline(self, which: int, u: np.ndarray, v: np.ndarray) -> Dual:
        """A block at texel coordinates within the map, its channels on the last axis."""
        if self.above:
            parts = [one._spline(which, u, v) for one in self._levels]
            shares = [np.asarray(share)[..., None] for share in self._shares]
            return Dual(*(sum(getattr(p, n) * share for p, share in zip(parts, shares)) for n in ("v", "dx", "dy")))
        rows, cols = self.shape
        col = np.clip(np.floor(u + 0.5), 1, cols - 2).astype(np.int64)
        row = np.clip(np.floor(v + 0.5), 1, rows - 2).astype(np.int64)
        (wx, dx), (wy, dy) = spline_weights(u - col), spline_weights(v - row)
        block, sums = self.block(which), [0.0, 0.0, 0.0]
        for r in range(3):
            for c in range(3):
                # the channel first: several times faster than with runs of four numbers
                value = np.moveaxis(block[row + r - 1, col + c - 1], -1, 0).astype(np.float64, order="C")
                for n, weight in enumerate((wx[c] * wy[r], dx[c] * wy[r], wx[c] * dy[r])):
                    sums[n] = sums[n] + value * weight
        value, to_x, to_y = (np.moveaxis(part, 0, -1) for part in sums)
        return Dual(value, to_x / self.cell_m, to_y / self.cell_m)


def resized(values: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """A map `(rows, cols, channels)` at as many samples as another has, over the same ground: bilinear, float32."""
    for axis, (had, has) in enumerate(zip(values.shape[:2], shape, strict=True)):
        if had != has:
            at = np.linspace(0, had - 1, has)
            first = np.minimum(at.astype(int), had - 2)
            part = (at - first).astype(np.float32).reshape((-1, 1, 1) if axis == 0 else (1, -1, 1))
            low = values.take(first, axis)
            values = low + (values.take(first + 1, axis) - low) * part
    return values.astype(np.float32, copy=False)
