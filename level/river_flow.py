"""How fast rivers run, everywhere in them: the potential flow over their beds (D13, D06).

div(h grad φ) = 0 over the wet cells, h the depth of the water: it keeps its discharge, goes faster in narrows and over
shallows, round rocks and through painted lakes, and has no seam at the middle as flow from distance fields has.

A river's discharge is the geometric mean along it of its points' speed times the wet cross-section: the speed that the
water then has comes as near to what the points say as one discharge can. It comes in over the first cross-section,
leaves over the last one before the sea; where a river ends or begins in other water it passes on what flows there.
Painted water that no line runs through flows from its highest rim to its lowest where its level falls; else it stands.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy import ndimage

from .level import Level
from .request import Request
from .river_jet import Mouth
from .river_line import Line
from .river_map import RiverMap, river_shape
from .river_solve import Solve, evened

MOST_CELLS = 200_000  # more are solved in twice as large cells: 200,000 take 3 s


@dataclass(frozen=True)
class RiverFlow:
    """`velocity` float32 `(rows, cols, 2)`, east and north in m/s on the map's samples from `corner` (row, col) on."""

    velocity: np.ndarray
    depth_m: np.ndarray  # float32 `(rows, cols)`: that of the water for which it is known, evened, else 0
    corner: tuple[int, int]
    cell_m: float
    mouths: tuple[Mouth, ...]
    key: tuple = ()

    @property
    def wet(self) -> np.ndarray:
        """Where there is such water, bool `(rows, cols)`."""
        return self.depth_m > 0

    def on(self, shape: tuple[int, int], cell_m: float) -> np.ndarray:
        """East, north in m/s and share 0 … 1 of it on other samples, float32 `(rows, cols, 3)`.

        It goes on under the banks by as much as a sample is wide: coarse ones don't lose a narrow river.
        """
        out = np.zeros((*shape, 3), np.float32)
        ratio = cell_m / self.cell_m
        pad = int(np.ceil(ratio)) + 2
        wet = np.pad(self.wet, pad)
        if not wet.any():
            return out
        rows, cols = (np.rint(np.arange(n) * ratio).astype(int) - at + pad
                      for n, at in zip(shape, self.corner, strict=True))  # fmt: skip
        inside = [(v >= 0) & (v < n) for v, n in zip((rows, cols), wet.shape, strict=True)]
        away, (row, col) = ndimage.distance_transform_edt(~wet, return_indices=True)
        there = np.ix_(rows[inside[0]], cols[inside[1]])
        share = np.clip(ratio + 1 - away[there], 0, 1)
        velocity = self._over(ratio)[row[there] - pad, col[there] - pad]
        out[np.ix_(*inside)] = np.concatenate([velocity * (share > 0)[..., None], share[..., None]], -1)
        return out

    def _over(self, ratio: float) -> np.ndarray:
        """Velocities as means over the water within samples `ratio` times as wide."""
        size = 2 * round(ratio / 2) + 1 if ratio > 1.01 else 1
        share = ndimage.uniform_filter(self.depth_m, size, mode="constant")
        means = [ndimage.uniform_filter(self.velocity[..., i] * self.depth_m, size, mode="constant") for i in (0, 1)]
        return np.stack(means, -1) / np.maximum(share, 1e-6)[..., None]


@dataclass(frozen=True)
class RiverFlowRequest(Request["RiverFlow"]):
    """All that it follows from: depths and lines on the window that has water."""

    depth_m: np.ndarray  # float32 `(rows, cols)`, 0 where it is dry or the sea
    owner: np.ndarray
    nearest: np.ndarray
    cell_m: float
    lines: tuple[Line, ...]
    corner: tuple[int, int]
    level_m: np.ndarray  # of the water, `(rows, cols)`
    painted_mps: float = 0.0  # the mean speed of painted water that no line runs through

    def kept(self) -> RiverFlowRequest:
        arrays = ("depth_m", "owner", "nearest", "level_m")
        return replace(self, **{name: np.array(getattr(self, name)) for name in arrays})

    @property
    def answer_bytes(self) -> int:
        return 12 * self.depth_m.size + (1 << 12)

    def answered(self) -> RiverFlow:
        cells = np.count_nonzero(self.depth_m)
        if cells > MOST_CELLS:
            return self._coarsely()
        if cells and (self.lines or self.painted_mps > 0):
            velocity, mouths = Solve(self).done()
        else:
            velocity, mouths = np.zeros((*self.depth_m.shape, 2), np.float32), ()
        depth = np.where(self.depth_m > 0, evened(self.depth_m), np.float32(0))
        return RiverFlow(velocity, depth, self.corner, self.cell_m, mouths)

    def _coarsely(self) -> RiverFlow:
        """Solved in cells of two by two, each velocity then at all four."""
        rows, cols = (n // 2 for n in self.depth_m.shape)
        quads = self.depth_m[: 2 * rows, : 2 * cols].reshape(rows, 2, cols, 2)
        wet = (quads > 0).sum((1, 3))
        depth = np.where(wet >= 2, quads.sum((1, 3)) / np.maximum(wet, 1), 0).astype(np.float32)
        firsts = (slice(0, 2 * rows, 2), slice(0, 2 * cols, 2))
        half = replace(self, depth_m=depth, owner=self.owner[firsts], nearest=self.nearest[firsts],
                       level_m=self.level_m[firsts], cell_m=2 * self.cell_m).answered()  # fmt: skip
        known = np.zeros(self.depth_m.shape, bool)
        known[: 2 * rows, : 2 * cols] = np.repeat(np.repeat(half.wet, 2, 0), 2, 1)
        row, col = ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)
        wide = half.velocity[np.minimum(row // 2, rows - 1), np.minimum(col // 2, cols - 1)]
        here = self.depth_m > 0
        velocity = np.where(here[..., None], wide, 0).astype(np.float32)
        return replace(half, velocity=velocity, depth_m=np.array(self.depth_m), cell_m=self.cell_m)


def river_flow(level: Level) -> RiverFlow | None:
    """How fast the level's rivers run, kept until something that it follows from changes; None without any.

    While a stroke is open the last one stays.
    """
    made = river_shape(level)
    if made is None:
        return None
    have = level.derived.get("river_flow")
    if have is not None and level.live:
        return have
    key = (made.key, level.layer_revision("height"), level.settings.river.painted_mps)
    if have is not None and have.key == key:
        return have
    if have is None or level.solver is None:
        found = flow_request(level, made).answered()
    else:
        found = level.solver.beside("river_flow", key, lambda: flow_request(level, made))
        if found is None:
            return have  # till the new one has come
    have = level.derived["river_flow"] = replace(found, key=key)
    return have


def flow_request(level: Level, made: RiverMap) -> RiverFlowRequest:
    """What the flow of a level follows from."""
    stride = round(made.cell_m / level.grid.cell_m)
    depth = made.packed[..., 0] + np.float32(level.mean_sea_m) - level.height[::stride, ::stride]
    wet = made.wet & (depth > 0)
    for which, line in enumerate(made.lines):
        wet &= (made.owner != which) | (made.nearest < line.mouth)  # the tail is the sea's
    rows, cols = np.flatnonzero(wet.any(1)), np.flatnonzero(wet.any(0))
    row, col = (max(int(v[0]) - 2, 0) if len(v) else 0 for v in (rows, cols))
    window = (slice(row, int(rows[-1]) + 3), slice(col, int(cols[-1]) + 3)) if len(rows) else np.s_[:1, :1]
    depth = np.where(wet, depth, 0).astype(np.float32)
    return RiverFlowRequest(
        depth[window], made.owner[window], made.nearest[window], made.cell_m, made.lines, (row, col),
        np.ascontiguousarray(made.packed[window][..., 0]), float(level.settings.river.painted_mps),
    )  # fmt: skip
