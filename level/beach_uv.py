"""Along the waterline: its curve in even steps, and u for a mesh beside it, with no jump inside a triangle (H03)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from .contours import contours
from .shore_field import ShoreField

WINDOW = 1.5  # of a triangle's radius: so far along the shore its vertices are looked for, and a step more
SHORTEST_M = 6.0  # waterlines round less are none: a stone
PER_MARK = 1 / 32  # u of one vertex that differ by less are one


@dataclass(frozen=True)
class Shoreline:
    """Points of all curves, one after the other: `xy`, unit `left` (to the sea) `(n, 2)`, `along_m`, `curve` `(n,)`.

    By curve `first`, `count`, `length_m`, `closed`.
    """

    xy: np.ndarray
    left: np.ndarray
    along_m: np.ndarray
    curve: np.ndarray
    first: np.ndarray
    count: np.ndarray
    length_m: np.ndarray
    closed: np.ndarray


def shoreline(field: ShoreField, step_m: float) -> Shoreline | None:
    """The sea's waterline, the sea on its left, in even steps of about `step_m`; None where there is none."""
    lines = contours(field.distance_m, 0.0, np.ones(field.distance_m.shape, bool))
    made = []
    for line in lines:
        xy = line * field.cell_m
        xy = xy[np.append(True, np.linalg.norm(np.diff(xy, axis=0), axis=1) > 1e-6)]
        if len(xy) < 3:
            continue
        along = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(xy, axis=0), axis=1)))
        if along[-1] < SHORTEST_M:
            continue
        closed = bool(np.allclose(line[0], line[-1]))
        steps = max(round(along[-1] / step_m), 3)
        at = np.linspace(0, along[-1], steps + 1)[: steps if closed else None]
        made.append((np.stack([np.interp(at, along, v) for v in xy.T], -1), at, along[-1], closed))
    if not made:
        return None
    count = np.array([len(at) for _, at, _, _ in made])
    lefts = [_left(xy, closed) for xy, _, _, closed in made]
    return Shoreline(
        np.concatenate([xy for xy, *_ in made]),
        np.concatenate(lefts),
        np.concatenate([at for _, at, _, _ in made]),
        np.repeat(np.arange(len(made)), count),
        np.append(0, np.cumsum(count)[:-1]),
        count,
        np.array([length for _, _, length, _ in made]),
        np.array([closed for *_, closed in made]),
    )


def _left(xy: np.ndarray, closed: bool) -> np.ndarray:
    way = np.roll(xy, -1, 0) - np.roll(xy, 1, 0) if closed else np.gradient(xy, axis=0)
    way /= np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-9)
    return np.stack([-way[:, 1], way[:, 0]], -1)


def charted(line: Shoreline, xy: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, ...]:
    """(which old vertex each new one is, its u in m, its tangent `(n, 2)`, triangles of new ones).

    A triangle belongs to the stretch of shore that its middle is nearest to, and its vertices are measured along that
    one: u is split where stretches meet, at the seam of a closed curve and half way between two shores, and nowhere
    else.
    """
    nearest = cKDTree(line.xy).query(xy[triangles].mean(axis=1))[1]
    u, tangent = _along(line, xy[triangles], nearest)
    curve = np.broadcast_to(line.curve[nearest][:, None], triangles.shape)
    marks = np.stack([triangles, curve, np.rint(u / PER_MARK).astype(np.int64)], -1).reshape(-1, 3)
    _, first, new = np.unique(marks, axis=0, return_index=True, return_inverse=True)
    return triangles.ravel()[first], u.ravel()[first], tangent.reshape(-1, 2)[first], new.reshape(-1, 3)


def _along(line: Shoreline, corners: np.ndarray, nearest: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """u and the curve's direction for corners `(m, 3, 2)`: the nearest of the segments round a point of the curve."""
    curve = line.curve[nearest]
    first, count, closed = line.first[curve], line.count[curve], line.closed[curve]
    length = line.length_m[curve]
    step = length / np.where(closed, count, count - 1)
    window_m = WINDOW * np.linalg.norm(corners - corners.mean(1, keepdims=True), axis=-1).max(1) + step
    reach = int(np.ceil((window_m / step).max()))
    best = np.full(corners.shape[:2], np.inf)
    u, left = np.zeros(best.shape), np.zeros(corners.shape)
    for k in range(-reach, reach):
        at = nearest - first + k
        there = np.where(closed, np.abs(2 * k + 1) <= count, (at >= 0) & (at + 1 < count))
        ok = there & (np.abs(k + 0.5) * step <= window_m)
        a, b = (first + np.where(ok, (at + j) % count, 0) for j in (0, 1))
        start, way = line.xy[a][:, None], (line.xy[b] - line.xy[a])[:, None]
        part = np.clip(((corners - start) * way).sum(-1) / np.maximum((way**2).sum(-1), 1e-12), 0, 1)
        away = np.where(ok[:, None], np.linalg.norm(corners - start - part[..., None] * way, axis=-1), np.inf)
        nearer = away < best
        best = np.where(nearer, away, best)
        u = np.where(nearer, (at[:, None] + part) * step[:, None], u)
        mixed = line.left[a][:, None] * (1 - part)[..., None] + line.left[b][:, None] * part[..., None]
        left = np.where(nearer[..., None], mixed, left)
    left /= np.maximum(np.linalg.norm(left, axis=-1, keepdims=True), 1e-9)
    return u, np.stack([left[..., 1], -left[..., 0]], -1)
