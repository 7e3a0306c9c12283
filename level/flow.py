"""The current that carries foam and floating things (D05, D06): what follows from the coast, flow points, and paint.

current(level).at(x, y) -> east, north in m/s

Worked out on the CPU and sent to the GPU as it is, so that both know the same current. While a stroke is open the last
one stays; it settles when the stroke ends.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from .level import Level
from .objects import FlowPoint
from .shore_field import decode_direction, shore_field

MOST_SIDE = 513  # samples a side: a current is broad
SMOOTH_M = 6.0  # the way to the shore turns over this length, or it would show the rays of its distance field
CALM_M = 2.0  # beside the shoreline the current dies out over this
FADE = 0.5  # share of the shore field's range over which the current to the shore dies out
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
    field = shore_field(level)
    points = tuple(sorted((o for o in level.objects.values() if isinstance(o, FlowPoint)), key=lambda o: o.id))
    flow, quiet = (level.layer_revision(name) for name in ("flow", "quiet"))
    settings = level.settings
    key = (id(field), field.revision, flow, quiet, points, settings.flow, settings.quiet.flow)
    if have is None or have.key != key:
        have = level.derived["current"] = _make(level, field, points, key)
    return have


def _make(level: Level, field, points, key: tuple) -> Current:
    settings, grid = level.settings, level.grid
    stride = max(1, math.ceil((max(grid.shape) - 1) / (MOST_SIDE - 1)))
    cell_m = stride * grid.cell_m
    rows, cols = ((n - 1) // stride + 1 for n in grid.shape)
    y, x = np.mgrid[0:rows, 0:cols] * cell_m
    distance, to_shore = _shore(field, x, y, cell_m)
    quiet = level.layers["quiet"].read(grid.rect)[::stride, ::stride]
    packed = np.zeros((rows, cols, 4), np.float32)
    packed[..., 2], packed[..., 3] = quiet, distance
    to_points = None
    if settings.flow.on:
        wet = np.clip(distance / CALM_M, 0, 1)
        wet = (wet * wet * (3 - 2 * wet))[..., None]
        flow, pull = to_shore * settings.flow.shore_mps, _to_points(points, x, y)
        flow += pull * settings.flow.points
        flow *= wet
        if points:
            to_points = (pull * wet * (1 - settings.quiet.flow * quiet)[..., None]).astype(np.float32)
        flow += level.layers["flow"].read(grid.rect)[::stride, ::stride] * settings.flow.painted
        packed[..., :2] = flow * (1 - settings.quiet.flow * quiet)[..., None]
    return Current(packed, cell_m, key, to_points)


def _shore(field, x, y, cell_m: float) -> tuple[np.ndarray, np.ndarray]:
    """Metres to the shoreline (+ sea) and the smoothed way there, zero on land: `(rows, cols)`, `(rows, cols, 2)`."""
    rows, cols = field.packed.shape[:2]
    row, col = (np.clip(np.rint(v / field.cell_m).astype(int), 0, n - 1) for v, n in ((y, rows), (x, cols)))
    distance = field.distance_m[row, col]
    # towards the end of what the field knows the current dies out, or its rim would show
    known = np.clip((field.range_m - distance) / (FADE * field.range_m), 0, 1) * (distance > 0)
    way = decode_direction(field.packed[row, col, 1:3]) * known[..., None]
    sigma = SMOOTH_M / cell_m
    way = np.stack([ndimage.gaussian_filter(way[..., i], sigma, mode="nearest") for i in (0, 1)], -1)
    share = ndimage.gaussian_filter((distance > 0).astype(np.float64), sigma, mode="nearest")
    return distance, way / np.maximum(share, 0.2)[..., None]


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
