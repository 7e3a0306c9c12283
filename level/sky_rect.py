"""Which part of a picture looks at some cells of the weather map, so that it can be marched anew at once (T04, Z16)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import product
from typing import Protocol

import numpy as np

from .grid import Rect
from .layers import WEATHER_GRID
from .level import Level
from .pick_sky import bend_m
from .weather import TILE_M, paint_place

CELLS = 2  # that a change reaches past its cells: painted samples and the map's texels are both interpolated

# The corners of a box and its edges, as pairs of corners that differ in one axis
CORNERS = np.array(list(product((0, 1), repeat=3)))
EDGES = [(a, b) for a in range(8) for b in range(a + 1, 8) if np.abs(CORNERS[a] - CORNERS[b]).sum() == 1]


class Sight(Protocol):
    """How a camera sees, as the renderer's matrices tell: it stands at `position` and never looks past `near_m`."""

    view: np.ndarray
    projection: np.ndarray
    position: np.ndarray
    near_m: float


Box = tuple[float, float, float, float]


def sky_rect(level: Level, sight: Sight, rects: Iterable[Rect], time_s: float) -> Box | None:
    """(left, bottom, right, top) in 0 … 1 of the picture that holds all rays through the clouds over cells of the map.

    `rects` as `level.changed_since("weather", …)` tells them; None when no ray goes there. Never smaller than that.
    """
    found: Box | None = None
    for low, high in _boxes(level, sight, rects, time_s):
        seen = _seen(sight, low, high)
        if seen is not None:
            found = seen if found is None else (*map(min, found[:2], seen[:2]), *map(max, found[2:], seen[2:]))
    if found is None or found[0] >= 1 or found[1] >= 1 or found[2] <= 0 or found[3] <= 0:
        return None
    return tuple(min(max(side, 0.0), 1.0) for side in found)


def _boxes(level: Level, sight: Sight, rects: Iterable[Rect], time_s: float) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Corners of the boxes about those clouds, metres from the camera, in the map's copies round the camera."""
    clouds = level.settings.clouds
    offsets = paint_place(level, time_s, 0.0, 0.0)
    reach_m = CELLS * WEATHER_GRID.cell_m + abs(clouds.shear_m)
    for rect in rects:
        if rect.empty:
            continue
        first = WEATHER_GRID.to_metres(rect.row0, rect.col0)
        last = WEATHER_GRID.to_metres(rect.row1 - 1, rect.col1 - 1)
        spans = [
            list(_copies(a - off - eye - reach_m, b - off - eye + reach_m))
            for a, b, off, eye in zip(first, last, offsets, sight.position)
        ]
        for (west, east), (south, north) in product(*spans):
            away = [np.hypot(max(0.0, west, -east), max(0.0, south, -north)),
                    np.hypot(max(abs(west), abs(east)), max(abs(south), abs(north)))]  # fmt: skip
            low = clouds.base_m - float(bend_m(level, away[1], clouds.base_m)) - sight.position[2]
            high = max(clouds.top_m, clouds.base_m) - float(bend_m(level, away[0], clouds.top_m)) - sight.position[2]
            yield np.array([west, south, low]), np.array([east, north, high])


def _copies(low: float, high: float) -> Iterator[tuple[float, float]]:
    """The parts of a span, repeated every torus, within half a torus of zero."""
    if high - low >= TILE_M:
        yield -TILE_M / 2, TILE_M / 2
        return
    first = int(np.floor((-TILE_M / 2 - low) / TILE_M))
    for lap in (first, first + 1, first + 2):
        a, b = max(low + lap * TILE_M, -TILE_M / 2), min(high + lap * TILE_M, TILE_M / 2)
        if a < b:
            yield a, b


def _seen(sight: Sight, low: np.ndarray, high: np.ndarray) -> Box | None:
    """Bounds in the picture of a box, cut where it comes nearer than the near plane; None when all of it does."""
    corners = (low + (high - low) * CORNERS) @ sight.view.T  # x right, y up, z back
    depth = -corners[:, 2]
    points = [corners[depth >= sight.near_m]]
    for a, b in EDGES:
        if (depth[a] < sight.near_m) != (depth[b] < sight.near_m):
            part = (sight.near_m - depth[a]) / (depth[b] - depth[a])
            points.append((corners[a] + (corners[b] - corners[a]) * part)[None])
    points = np.concatenate(points)
    if not len(points):
        return None
    clip = points @ sight.projection[:2, :3].T / -points[:, 2:]
    left, bottom = clip.min(axis=0) * 0.5 + 0.5
    right, top = clip.max(axis=0) * 0.5 + 0.5
    return float(left), float(bottom), float(right), float(top)
