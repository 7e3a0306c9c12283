"""Rings that raindrops leave on the water (D17): how many, how wide, and their slope; twin of lib/rain_rings.glsl.

    drops = rain_drops(level, time_s, x, y)     # None where no rain falls
    slope = ring_slope(drops, ripples, xs, ys)  # (…, 2), as sharp as they are

The water is laid out in four turned layers of cells. Into each a drop falls once a cycle, at a place of its own, and a
few crests run outwards from it and die: at the speed of the slowest waves on water, 0.23 m/s where gravity and surface
tension are equally strong (Lamb 1932, art. 267). The more it rains the more cells get one.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np

from .level import Level
from .loop import looped, moment, turns
from .rain import rain_at

SPEED_MPS = 0.23
HALF, LEAST, MOST = 0.10, 0.12, 0.34  # in sides of a cell: half the waves' width, how far their middle runs
PHASE, SLOPE, ROW_SHIFT = 7.5, 1.0, 0.618034
CELLS = (0.5, 0.62, 0.8, 1.0)  # of the large layer's
TURNS = ((0.6, 0.8), (-0.28, 0.96), (0.96, -0.28), (0.8, 0.6))  # sine, cosine
MANY_MM_H = 8.0  # rain at which 63 % of the cells have a drop
REPEATS = 4096  # cycles after which the same drops come again


@dataclass(frozen=True)
class Drops:
    """Share of the cells that get one; a row a layer: side of a cell m, part of a cycle, whole ones, repeats after."""

    share: float
    layers: tuple[tuple[float, float, float, float], ...]


def cell_sides_m(ring_m: float) -> list[float]:
    """Sides of the layers' cells for rings of at most this diameter."""
    return [part * ring_m / (2 * (MOST + HALF)) for part in CELLS]


def cycle_s(cell_m: float) -> float:
    """Time that the widest ring takes to run out."""
    return MOST * cell_m / SPEED_MPS


def rain_drops(level: Level, time_s: float, x: float, y: float, seen_by: str = "") -> Drops | None:
    """What falls on the water round a place; None without rain."""
    rain_mm_h = float(rain_at(level, time_s, x, y, seen_by=seen_by)[0])
    share, knobs, loop_s = share_hit(rain_mm_h), level.settings.rain, level.settings.time.loop_s
    if share <= 0 or knobs.ripples <= 0:
        return None
    rows = []
    for cell_m in cell_sides_m(knobs.ring_m):
        cycles = moment(time_s, loop_s) / looped(cycle_s(cell_m), loop_s)
        again = turns(cycle_s(cell_m), loop_s) or REPEATS
        rows.append((cell_m, cycles - math.floor(cycles), float(math.floor(cycles) % again), float(again)))
    return Drops(share, tuple(rows))


def share_hit(rain_mm_h: float) -> float:
    """Share of the cells that get a drop."""
    return -math.expm1(-max(rain_mm_h, 0.0) / MANY_MM_H)


def drop_slope(r, age, reach):
    """Slope outwards at r (sides of a cell) of the waves of a drop of this age, 0 … 1."""
    u = (r - reach * age) / HALF
    window = np.maximum(1 - u * u, 0) ** 2
    left = np.minimum(12 * age, 1) * (1 - age * age) / np.sqrt(1 + 2 * reach * age / HALF)
    return SLOPE * left * window * np.sin(PHASE * u) * np.minimum(4 * r / HALF, 1)


@functools.cache
def mean_slope2() -> float:
    """Mean of slope² over a layer all of whose cells have drops: the integral over place, age and size."""
    middles = (np.arange(200) + 0.5) / 200
    r, age, size = np.meshgrid(0.5 * middles, middles, middles[::8], indexing="ij", sparse=True)
    slope = (0.6 + 0.4 * size) * drop_slope(r, age, LEAST + (MOST - LEAST) * size)
    return float((2 * np.pi * r * slope**2).mean() * 0.5)


def ring_slope(drops: Drops, ripples: float, x, y) -> np.ndarray:
    """Slope `(…, 2)` east and north that they add at world points."""
    total = np.zeros((*np.shape(x), 2))
    for index, (row, (sine, cosine)) in enumerate(zip(drops.layers, TURNS, strict=True)):
        a = (cosine * np.asarray(x) - sine * np.asarray(y)) / row[0]
        b = (sine * np.asarray(x) + cosine * np.asarray(y)) / row[0]
        east, north = np.moveaxis(_layer(drops.share, row, index, a, b), -1, 0)
        total += np.stack([cosine * east + sine * north, cosine * north - sine * east], -1)
    return ripples * total


def _layer(share: float, row: tuple, index: int, a, b) -> np.ndarray:
    """Slope of one layer at places in sides of its cells, in its own directions."""
    _, part, whole, again = row
    a = a + np.mod(ROW_SHIFT * np.floor(b), 1.0)
    cols, rows = np.floor(a), np.floor(b)
    cycles = part + _hash(cols, rows, index)[..., 0]
    chance = _hash(cols, rows, 4 * np.mod(np.floor(cycles) + whole, again) + index + 4)
    size = chance[..., 0] / share
    reach = LEAST + (MOST - LEAST) * size
    room = 1 - 2 * (reach + HALF)
    off = np.stack([a - cols, b - rows], -1) - 0.5 - room[..., None] * (chance[..., 1:] - 0.5)
    r = np.maximum(np.hypot(off[..., 0], off[..., 1]), 1e-4)
    slope = np.where(size < 1, (0.6 + 0.4 * size) * drop_slope(r, np.mod(cycles, 1.0), reach), 0.0)
    return off / r[..., None] * slope[..., None]


def _hash(x, y, z) -> np.ndarray:
    """Three numbers `(…, 3)`, 0 to below 1, of whole ones: pcg3d (Jarzynski & Olano 2020)."""
    whole = np.broadcast_arrays(*(np.asarray(v).astype(np.int64).astype(np.uint32) for v in (x, y, z)))
    x, y, z = (v * np.uint32(1664525) + np.uint32(1013904223) for v in whole)
    for last in (False, True):
        x = x + y * z
        y = y + z * x
        z = z + x * y
        if not last:
            x, y, z = (v ^ (v >> np.uint32(16)) for v in (x, y, z))
    return np.stack([x, y, z], -1).astype(np.uint32).astype(np.int64) // 256 / 16777216.0
