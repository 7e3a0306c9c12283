"""Outlines of regions of swell: a distance from a polygon that is smooth everywhere but at its corners (D32).

The plain distance has a crease wherever two edges are as near, and the water would show it. This one is 2 / W with
W = Σ tan(α / 2) · (1 / r + 1 / r') over the edges, α the angle under which an edge is seen and r, r' how far its ends
are: the signed Lp-distance of Belyaev, Fayolle and Pasko (2013) for p = 1. By an edge it is the distance; inside it is
above 0 and grows slower than that, outside it is at least as far below 0 as the hull is away. Its twin in GLSL is
shaders/wave_regions.glsl.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from .dual import Dual, step
from .objects import SwellRegion
from .shaping_lines import contours
from .wave_objects import LEAST_FALLOFF, circle_weight, inner_m

LEAST_M = 1e-4  # nearer to a corner nobody looks
NET = 33  # samples a side in which the deepest place is looked for
LARGEST = 0.97  # of the way in at which the line is drawn: all of it may be a point


def points_of(outline: tuple[float, ...]) -> np.ndarray:
    """`(n, 2)`, m from the region's place, in the order in which they were drawn."""
    return np.array(outline, np.float64).reshape(-1, 2)


@lru_cache(maxsize=64)
def edges_of(outline: tuple[float, ...]) -> np.ndarray:
    """`(n, 4)` from, to in metres, anticlockwise."""
    points = points_of(outline)
    after = np.roll(points, -1, axis=0)
    if np.sum(points[:, 0] * after[:, 1] - points[:, 1] * after[:, 0]) < 0:
        points = points[::-1]
        after = np.roll(points, -1, axis=0)
    return np.hstack([points, after])


def inside_m(edges: np.ndarray, x, y) -> Dual:
    """How far within an outline points are, below 0 outside; with its gradient."""
    total = Dual(0.0)
    for from_x, from_y, to_x, to_y in edges:
        total = total + _seen(Dual(from_x - x, -1.0), Dual(from_y - y, 0.0, -1.0), to_x - from_x, to_y - from_y)
    over = np.where(total.v < 0, -1.0, 1.0) / np.maximum(np.abs(total.v), 1e-9)
    return Dual(2 * over, -2 * over * over * total.dx, -2 * over * over * total.dy)


def _seen(ax: Dual, ay: Dual, along_x: float, along_y: float) -> Dual:
    """tan(α / 2) · (1 / r + 1 / r') of one edge; of the two ways to write the tangent the one that loses nothing."""
    bx, by = ax + along_x, ay + along_y
    over_a, over_b = _over(ax, ay), _over(bx, by)
    cross, dot = ax * along_y - ay * along_x, ax * bx + ay * by
    cosine = dot * over_a * over_b
    sine = cross * over_a * over_b
    behind = cosine.v < 0
    top, bottom = _either(behind, 1.0 - cosine, sine), _either(behind, sine, 1.0 + cosine)
    least = np.where(np.abs(bottom.v) < 1e-9, np.where(bottom.v < 0, -1e-9, 1e-9), bottom.v)
    return top * Dual(1 / least, -bottom.dx / least**2, -bottom.dy / least**2) * (over_a + over_b)


def _over(x: Dual, y: Dual) -> Dual:
    """1 / length."""
    over = 1 / np.maximum(np.hypot(x.v, y.v), LEAST_M)
    return Dual(over, -(x.v * x.dx + y.v * y.dx) * over**3, -(x.v * x.dy + y.v * y.dy) * over**3)


def _either(first: np.ndarray, a: Dual, b: Dual) -> Dual:
    return Dual(np.where(first, a.v, b.v), np.where(first, a.dx, b.dx), np.where(first, a.dy, b.dy))


@lru_cache(maxsize=64)
def deepest_m(outline: tuple[float, ...]) -> float:
    """`inside_m` where it is largest."""
    edges = edges_of(outline)
    low, high = edges[:, :2].min(axis=0), edges[:, :2].max(axis=0)
    x, y = np.meshgrid(*(np.linspace(a, b, NET) for a, b in zip(low, high, strict=True)))
    corner_m = np.hypot(x[..., None] - edges[:, 0], y[..., None] - edges[:, 1]).min(axis=-1)
    return max(float(np.where(corner_m > 10 * LEAST_M, inside_m(edges, x, y).v, 0.0).max()), 1e-3)


def band_m(region: SwellRegion) -> tuple[float, float]:
    """How far outside its outline a region begins, and how far inside it is whole."""
    wide = max(region.falloff, LEAST_FALLOFF) * (deepest_m(region.outline) if region.outline else region.radius_m)
    return region.outside * wide, (1 - region.outside) * wide


def reach_m(region: SwellRegion) -> float:
    """From its place a region ends within this."""
    if not region.outline:
        return region.radius_m + band_m(region)[0]
    return float(np.hypot(*edges_of(region.outline)[:, :2].T).max()) + band_m(region)[0]


def whole_m(region: SwellRegion) -> float:
    """Up to here from its place a circle has all its weight."""
    return inner_m(region) + band_m(region)[0]


def region_weight(region: SwellRegion, x, y) -> Dual:
    """1 within, falling smoothly to 0 beyond, at undeformed points."""
    if not region.outline:
        return circle_weight(region, x, y, whole_m(region), reach_m(region))
    beyond, within = band_m(region)
    return step(-beyond, within, inside_m(edges_of(region.outline), x - region.x, y - region.y))


def outline_line(region: SwellRegion, spacing_m: float = 8.0) -> np.ndarray:
    """Its outline as a closed line (n, 2) of world points, close enough together to lie on the ground."""
    parts = []
    for edge in edges_of(region.outline):
        count = max(int(np.hypot(*(edge[2:] - edge[:2])) / spacing_m), 1)
        parts.append(edge[:2] + np.linspace(0, 1, count, endpoint=False)[:, None] * (edge[2:] - edge[:2]))
    return np.concatenate([*parts, parts[0][:1]]) + np.array([region.x, region.y])


def whole_line(region: SwellRegion) -> list[np.ndarray]:
    """Lines (n, 2) of world points within which a region with an outline has all its weight."""
    place = np.array([region.x, region.y])
    return [line + place for line in _level_lines(region.outline, LARGEST * band_m(region)[1])]


@lru_cache(maxsize=64)
def _level_lines(outline: tuple[float, ...], inside: float) -> list[np.ndarray]:
    edges = edges_of(outline)
    low, high = edges[:, :2].min(axis=0), edges[:, :2].max(axis=0)
    x, y = (np.linspace(a, b, NET) for a, b in zip(low, high, strict=True))
    return contours(inside_m(edges, *np.meshgrid(x, y)).v, x, y, inside)


def ring(count: int, radius_m: float) -> tuple[float, ...]:
    """An outline of so many points on a circle."""
    turn = 2 * np.pi * np.arange(count) / count
    return tuple(np.round(np.column_stack([np.sin(-turn), np.cos(turn)]) * radius_m, 2).ravel().tolist())


def with_point(
    outline: tuple[float, ...], number: int, at: tuple[float, float], new: bool = False
) -> tuple[float, ...]:
    """The outline with a point moved, or with a new one after it."""
    points = [outline[i : i + 2] for i in range(0, len(outline), 2)]
    points[number + new : number + 1] = [(round(at[0], 2), round(at[1], 2))]
    return tuple(value for point in points for value in point)


def without_point(outline: tuple[float, ...], number: int) -> tuple[float, ...]:
    return outline[: 2 * number] + outline[2 * number + 2 :]
