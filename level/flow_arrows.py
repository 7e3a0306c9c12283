"""The current as arrows that lie on the water (T02): short streamlines with a head, denser near the eye."""

from __future__ import annotations

import math

import numpy as np

from .flow import Current, current
from .level import Level
from .river_water import river_at

RINGS = ((60.0, 4.0), (180.0, 12.0), (600.0, 40.0))  # metres from the eye, metres between two arrows
LOW_M = 20.0  # eye over the sea up to which the rings are these; twice as high all is twice as wide
STEPS = 6  # of a streamline
LONGEST = 0.9  # of the way between two arrows
FULL_MPS = 1.0  # speed at which an arrow is that long
LEAST_MPS = 0.01
HEAD = 0.3  # of the arrow's length
HEAD_DEG = 28.0
OVER_M = 0.05  # the still sea


def flow_arrows(level: Level, x: float, y: float, z: float, dry: bool = False) -> list[list[tuple[float, ...]]]:
    """World polylines about an eye at (x, y, z): each runs down the water, then draws its head; x, y, z, m/s.

    `dry`: also where land lies, as paint does.
    """
    high_m = max(z - level.sea_level_m, LOW_M)
    scale = 2.0 ** math.floor(math.log2(high_m / LOW_M))
    found, inner_m = [], 0.0
    for reach_m, apart_m in RINGS:
        found += _ring(level, x, y, inner_m * scale, reach_m * scale, apart_m * scale, dry)
        inner_m = reach_m
    return found


def _ring(level: Level, x: float, y: float, inner_m: float, reach_m: float, apart_m: float, dry: bool) -> list:
    east_m, north_m = level.grid.extent_m
    # on a lattice of the world: an eye that moves makes no arrow swim
    ends = [
        (max(c - reach_m, 0) / apart_m, min(c + reach_m, side) / apart_m) for c, side in ((x, east_m), (y, north_m))
    ]
    at = [np.arange(math.ceil(low), math.floor(high) + 1) * apart_m for low, high in ends]
    px, py = (part.ravel() for part in np.meshgrid(*at))
    away = np.hypot(px - x, py - y)
    px, py = (part[(away >= inner_m) & (away < reach_m)] for part in (px, py))
    water = current(level)
    speed = np.hypot(*water.at(px, py))
    shown = (speed > LEAST_MPS) & (dry | on_water(water, px, py))
    px, py, speed = (part[shown] for part in (px, py, speed))
    if not len(px):
        return []
    step_m = np.clip(speed / FULL_MPS, 0.25, 1) * LONGEST * apart_m / STEPS
    line = [np.stack([px, py], -1)]
    for _ in range(STEPS):  # by the midpoint
        way = _unit(water, line[-1])
        way = _unit(water, line[-1] + 0.5 * step_m[:, None] * way)
        line.append(line[-1] + step_m[:, None] * way)
    tip, way = line[-1], _unit(water, line[-1])
    back = -HEAD * STEPS * step_m[:, None]
    sides = [tip + back * _turned(way, sign * math.radians(HEAD_DEG)) for sign in (1, -1)]
    points = np.stack([*line, sides[0], tip, sides[1]], 1)
    high = level.sea_level_m + OVER_M + still_over_sea(level, points[..., 0], points[..., 1])
    fast = np.broadcast_to(speed[:, None], high.shape)
    return np.concatenate([points, high[..., None], fast[..., None]], -1).tolist()


def still_over_sea(level: Level, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Metres that the water without its waves stands over the sea at places: rivers and lakes."""
    river = river_at(level, 0.0, x, y)
    return np.zeros(np.shape(x)) if river is None else river.still.v


def with_heads(line: np.ndarray, water: Current, head_m: float, every: int) -> np.ndarray:
    """A line `(n, 2)` with heads at its end and every so many points before, as one of x, y, m/s."""
    speed = np.hypot(*water.at(line[:, 0], line[:, 1]))
    found = np.column_stack([line, speed])
    for tip in range(len(line) - 1, 0, -every):
        way = line[tip] - line[tip - 1]
        way = way / max(float(np.hypot(*way)), 1e-9)
        left, right = (line[tip] - head_m * _turned(way[None], sign * math.radians(HEAD_DEG))[0] for sign in (1, -1))
        head = np.array([left, line[tip], right, line[tip]])
        found = np.insert(found, tip + 1, np.column_stack([head, np.full(4, speed[tip])]), axis=0)
    return found


def on_water(water: Current, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Whether the nearest sample is water."""
    rows, cols = water.packed.shape[:2]
    at = [np.clip(np.rint(p / water.cell_m).astype(int), 0, n - 1) for p, n in ((y, rows), (x, cols))]
    return water.packed[at[0], at[1], 3] > 0


def _unit(water, place: np.ndarray) -> np.ndarray:
    way = np.stack(water.at(place[:, 0], place[:, 1]), -1)
    return way / np.maximum(np.hypot(way[:, 0], way[:, 1]), 1e-9)[:, None]


def _turned(way: np.ndarray, angle: float) -> np.ndarray:
    cos, sin = math.cos(angle), math.sin(angle)
    return np.stack([way[:, 0] * cos - way[:, 1] * sin, way[:, 0] * sin + way[:, 1] * cos], -1)
