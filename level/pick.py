"""Where a ray meets the ground: the pointer's way into the level, without OpenGL."""

from __future__ import annotations

import math

import numpy as np

from .level import Level

REFINEMENTS = 40  # bisections of the step in which the ray goes under
MOST_SAMPLES = 60_000


def ground_at(level: Level, x, y) -> np.ndarray:
    """Bilinear ground height in metres at world points (arrays); the border's height outside the level."""
    rows, cols = level.grid.shape
    v, u = level.grid.to_cells(np.asarray(x, np.float64), np.asarray(y, np.float64))
    u, v = np.clip(u, 0, cols - 1), np.clip(v, 0, rows - 1)
    col, row = np.minimum(u.astype(np.int64), cols - 2), np.minimum(v.astype(np.int64), rows - 2)
    fu, fv = u - col, v - row
    height = level.height
    south = height[row, col] * (1 - fu) + height[row, col + 1] * fu
    north = height[row + 1, col] * (1 - fu) + height[row + 1, col + 1] * fu
    return south * (1 - fv) + north * fv


def pick_ray(level: Level, origin, direction) -> tuple[float, float, float] | None:
    """First point (x, y, z) where a ray from `origin` (3,) along `direction` (3,) goes under the ground, or None."""
    origin, direction = np.asarray(origin, np.float64), np.asarray(direction, np.float64)
    length = np.linalg.norm(direction)
    if not (np.isfinite(origin).all() and np.isfinite(length) and length > 0):
        return None
    direction = direction / length
    span = _inside(level, origin, direction)
    if span is None:
        return None
    step = level.grid.cell_m / 2 / max(math.hypot(direction[0], direction[1]), 1e-3)
    count = min(math.ceil((span[1] - span[0]) / step) + 2, MOST_SAMPLES)
    t = np.linspace(span[0], span[1], count)
    under = _clearance(level, origin, direction, t) < 0
    hits = np.flatnonzero(under)
    if not len(hits) or hits[0] == 0:
        return None  # misses, or starts under the ground
    low, high = t[hits[0] - 1], t[hits[0]]
    for _ in range(REFINEMENTS):
        middle = (low + high) / 2
        if _clearance(level, origin, direction, middle) < 0:
            high = middle
        else:
            low = middle
    x, y, _ = origin + high * direction
    return float(x), float(y), float(ground_at(level, x, y))


def _clearance(level: Level, origin, direction, t) -> np.ndarray:
    return origin[2] + t * direction[2] - ground_at(level, origin[0] + t * direction[0], origin[1] + t * direction[1])


def _inside(level: Level, origin, direction) -> tuple[float, float] | None:
    """The part of the ray inside the level's box, or None."""
    floor, top = _height_range(level)
    low, high = 0.0, math.inf
    for start, way, first, last in zip(origin, direction, (0.0, 0.0, floor), (*level.grid.extent_m, top), strict=True):
        if abs(way) < 1e-12:
            if not first <= start <= last:
                return None
            continue
        near, far = sorted(((first - start) / way, (last - start) / way))
        low, high = max(low, near), min(high, far)
    return (low, high) if low < high < math.inf else None


def _height_range(level: Level) -> tuple[float, float]:
    """Heights the ground stays between, with a metre to spare; widened by what changed, never searched again."""
    at, low, high = level.derived.get("pick_range", (-1, math.inf, -math.inf))
    if at != level.layer_revision("height"):
        for rect in level.changed_since("height", at) if at >= 0 else [level.grid.rect]:
            part = level.layers["height"].read(rect)
            low, high = min(low, float(part.min())), max(high, float(part.max()))
        level.derived["pick_range"] = level.layer_revision("height"), low, high
    return low - 1.0, high + 1.0
