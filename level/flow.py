"""The current that carries foam and floating things (D05, D06): the coast, flow points, rivers, and paint.

current(level).at(x, y) -> east, north in m/s

Worked out on the CPU and sent to the GPU as it is, so that both know the same current. While a stroke is open the last
one stays; it settles when the stroke ends.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy import ndimage

from .level import Level
from .objects import FlowPoint
from .request import Request
from .river_flow import RiverFlow, river_flow
from .river_jet import Mouth
from .settings import Flow
from .shore_field import ShoreField, decode_direction, shore_field

MOST_SIDE = 513  # samples a side: a current is broad
SMOOTH_M = 6.0  # the way to the shore turns over this length, or it would show the rays of its distance field
CALM_M = 2.0  # beside the shoreline the current dies out over this
FADE = 0.5  # share of the shore field's range over which the current to the shore dies out
FAR_M = 200.0  # in a river the shore counts as so far: it throws no foam there (D13)
POINT_EDGE = 0.5  # share of a flow point's radius up to which it is whole


@dataclass
class Current:
    """`packed` float32 `(rows, cols, 4)`: east, north m/s, quiet 0 … 1, metres to the shoreline, + sea."""

    packed: np.ndarray
    cell_m: float
    key: tuple
    to_points: np.ndarray | None = None  # what flow points give at strength 1, `(rows, cols, 2)`; None without any

    def with_points(self, more: float) -> np.ndarray:
        """`packed` with flow points so much stronger, as weather makes them (D36)."""
        if not more or self.to_points is None:
            return self.packed
        return np.concatenate([self.packed[..., :2] + np.float32(more) * self.to_points, self.packed[..., 2:]], -1)

    def at(self, x, y, more: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
        """East and north in m/s at world points, bilinear; beyond the level that of its border."""
        rows, cols = self.packed.shape[:2]
        v, u = (np.clip(np.asarray(p, np.float64) / self.cell_m, 0, n - 1) for p, n in ((y, rows), (x, cols)))
        row, col = (np.minimum(p.astype(int), n - 2) for p, n in ((v, rows), (u, cols)))
        fv, fu = (v - row)[..., None], (u - col)[..., None]
        flow = _between(self.packed, row, col, fu, fv)
        if more and self.to_points is not None:
            flow = flow + more * _between(self.to_points, row, col, fu, fv)
        return flow[..., 0], flow[..., 1]


def _between(values: np.ndarray, row, col, fu, fv) -> np.ndarray:
    south, north = (values[r, col, :2] * (1 - fu) + values[r, col + 1, :2] * fu for r in (row, row + 1))
    return south * (1 - fv) + north * fv


def current(level: Level) -> Current:
    """The current of a level, kept until something that it follows from changes."""
    have = level.derived.get("current")
    if have is not None and level.live:
        return have
    field, rivers = shore_field(level), river_flow(level)
    if have is not None and field.behind:
        return have
    points = tuple(sorted((o for o in level.objects.values() if isinstance(o, FlowPoint)), key=lambda o: o.id))
    flow, quiet = (level.layer_revision(name) for name in ("flow", "quiet"))
    settings = level.settings
    key = (id(field), field.revision, flow, quiet, points, settings.flow, settings.quiet.flow)
    key += () if rivers is None else (rivers.key,)
    if have is not None and have.key == key:
        return have
    if have is None or level.solver is None:
        made = _request(level, field, points, rivers).answered()
    else:
        made = level.solver.beside("current", key, lambda: _request(level, field, points, rivers))
        if made is None:
            return have  # till the new one has come
    have = level.derived["current"] = replace(made, key=key)
    return have


@dataclass(frozen=True)
class CurrentRequest(Request[Current]):
    """All that a current follows from: the shore field at its samples, paint, points, rivers, settings."""

    distance_m: np.ndarray
    way: np.ndarray  # uint8 `(rows, cols, 2)`, as packed
    range_m: float
    quiet: np.ndarray
    painted: np.ndarray
    cell_m: float
    points: tuple
    settings: Flow
    held: float  # by quiet
    river: np.ndarray  # float32 `(rows, cols, 3)`: east, north m/s, share of its water; one sample where there is none
    mouths: tuple[Mouth, ...]

    def kept(self) -> CurrentRequest:
        arrays = {name: np.array(getattr(self, name)) for name in ("distance_m", "way", "quiet", "painted", "river")}
        return replace(self, **arrays)

    @property
    def answer_bytes(self) -> int:
        return 6 * 4 * self.quiet.size + (1 << 12)

    def answered(self) -> Current:
        rows, cols = self.quiet.shape
        y, x = np.mgrid[0:rows, 0:cols] * self.cell_m
        distance, to_shore = self._shore()
        packed = np.zeros((rows, cols, 4), np.float32)
        packed[..., 2], packed[..., 3] = self.quiet, distance + self.river[..., 2] * (FAR_M - distance)
        to_points = None
        if self.settings.on:
            wet = np.clip(distance / CALM_M, 0, 1)
            wet = (wet * wet * (3 - 2 * wet))[..., None]
            free = (1 - self.held * self.quiet)[..., None]
            flow, pull = to_shore * self.settings.shore_mps, _to_points(self.points, x, y)
            flow += pull * self.settings.points
            own = self.river[..., 2:]  # in a river it is the river's
            flow *= wet * (1 - own)
            runs = self._jets(x, y) * np.maximum(wet, own) * (1 - own) + own * self.river[..., :2]
            flow += self.settings.rivers * runs
            if self.points:
                to_points = (pull * wet * (1 - own) * free).astype(np.float32)
            flow += self.painted * self.settings.painted
            packed[..., :2] = flow * free
        return Current(packed, self.cell_m, (), to_points)

    def _jets(self, x, y) -> np.ndarray:
        """What rivers drive on out at sea: velocities add up, `(rows, cols, 2)` m/s (D35)."""
        total = np.zeros((*x.shape, 2))
        for mouth in self.mouths:
            total += mouth.speed(x, y, self.cell_m)[..., None] * (mouth.east, mouth.north)
        return total

    def _shore(self) -> tuple[np.ndarray, np.ndarray]:
        """Metres to the shoreline (+ sea) `(rows, cols)`, the smoothed way there `(rows, cols, 2)`: zero on land."""
        distance = self.distance_m
        # towards the end of what the field knows the current dies out, or its rim would show
        known = np.clip((self.range_m - distance) / (FADE * self.range_m), 0, 1) * (distance > 0)
        way = decode_direction(self.way) * known[..., None]
        sigma = SMOOTH_M / self.cell_m
        way = np.stack([ndimage.gaussian_filter(way[..., i], sigma, mode="nearest") for i in (0, 1)], -1)
        share = ndimage.gaussian_filter((distance > 0).astype(np.float64), sigma, mode="nearest")
        return distance, way / np.maximum(share, 0.2)[..., None]


def _request(level: Level, field: ShoreField, points: tuple, rivers: RiverFlow | None) -> CurrentRequest:
    settings, grid = level.settings, level.grid
    stride = max(1, math.ceil((max(grid.shape) - 1) / (MOST_SIDE - 1)))
    quiet, painted = (level.layers[name].read(grid.rect)[::stride, ::stride] for name in ("quiet", "flow"))
    cell_m = stride * grid.cell_m
    at = np.ix_(*(  # the field's nearest texels
        np.clip(np.rint(np.arange(n) * cell_m / field.cell_m).astype(int), 0, most - 1)
        for n, most in zip(quiet.shape, field.distance_m.shape)
    ))  # fmt: skip
    river, ends = np.zeros((1, 1, 3), np.float32), ()
    if rivers is not None:
        river = rivers.on(quiet.shape, cell_m)
        ends = rivers.mouths
    return CurrentRequest(
        field.distance_m[at], field.packed[at][..., 1:3], field.range_m, quiet, painted, cell_m, points, settings.flow,
        settings.quiet.flow, river, ends,
    )  # fmt: skip


def _to_points(points, x, y) -> np.ndarray:
    """The sum of all flow points: B − A over its length, `(rows, cols, 2)` m/s; nothing at the point itself."""
    total = np.zeros((*x.shape, 2))
    for point in points:
        east, north = point.x - x, point.y - y
        away = np.hypot(east, north)
        fade = np.clip((point.radius_m - away) / ((1 - POINT_EDGE) * point.radius_m), 0, 1)
        speed = point.speed_mps * fade * fade * (3 - 2 * fade) / np.maximum(away, 1e-9)
        speed *= np.minimum(away / (0.05 * point.radius_m), 1)  # at the point it comes to rest
        total += np.stack([east * speed, north * speed], -1)
    return total
