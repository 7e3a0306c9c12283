"""The rock of `delta.shore`: hills cut by streams, the step of the fall, and boulders in the bed of the rapids."""

from __future__ import annotations

import numpy as np
from noise_ops import fbm, ridged, smooth_max, smooth_min, smoothstep, warp
from rock_ops import beds, boulders
from terrain_ops import crumble, cut_valleys, points, upsample

# Stretches of rapids: from, to in metres of level of the water.
RAPIDS = ((12.2, 15.0), (5.4, 9.9))
# Boulders placed by hand: x, y, radius, height. At the fall's foot and lip, beside pools, on the beach.
BOULDERS = points(
    """
    330,562,2.6,2.2 334,548,2.2,1.8 326,560,1.6,1.2 340,562,1.8,1.3 341,551,1.6,1.2 187,416,2.4,1.9 173,418,2.2,1.8
    393,613,2.2,1.6 410,602,1.8,1.1 399,619,2.8,2.2 407,617,2.0,1.5 444,172,2.8,1.9 436,178,1.8,1.1 104,178,3,2
    112,171,1.9,1.2
    """
)


def hills(maps: dict[str, np.ndarray], ground: np.ndarray, seed: int) -> np.ndarray:
    """Rock before cliffs: high to the north, two headlands, a valley about the river, cut by streams on a 2 m grid."""
    x, y, coast = (maps[name] for name in ("x", "y", "coast"))
    wx, wy = warp(x, y, 130, 34, seed + 20, 4)
    far = np.sqrt(np.square((x - 285) / 150) + np.square((y - 215) / 118)) + 0.3 * fbm(x, y, 120, 3, seed + 21)
    rise = smoothstep(0.72, 2.1, far) * (1 - 0.5 * smoothstep(95, 20, np.sqrt(np.square(x - 255) + np.square(y - 440))))
    crest = ridged(wx, wy, 230, 5, seed + 22, 0.42)
    top = 3 + rise * (24 + 84 * crest + 10 * fbm(wx, wy, 50, 4, seed + 27))
    head = smoothstep(170, 70, x + 18 * fbm(x, y, 70, 2, seed + 28)) * smoothstep(330, 190, y)
    head = np.maximum(head, smoothstep(400, 470, x + 18 * fbm(x, y, 70, 2, seed + 29)) * smoothstep(330, 200, y))
    top = smooth_max(top, 2 + head * (15 + 10 * smoothstep(4, 50, coast) + 7 * fbm(wx, wy, 60, 5, seed + 23)), 5)
    side = np.maximum(maps["off"] - maps["floor_half"] * (1 + 0.25 * fbm(x, y, 60, 3, seed + 25)), 0)
    steep = 0.6 + 0.45 * fbm(x, y, 75, 3, seed + 34)  # of the valley's sides: gentle here, bluffs there
    walls = maps["floor_m"] + 0.4 + 0.014 * maps["off"] + np.maximum(steep, 0.22) * side + 0.006 * np.square(side)
    stepped = beds(walls, x, y, seed + 35)
    walls += (stepped - walls) * smoothstep(1, 5, side) * smoothstep(0.42, 0.7, steep)
    walls = np.maximum(walls, maps["floor_m"] + 0.4 + 0.014 * maps["off"] + 0.12 * side)
    walls += smoothstep(0, 25, side) * 4 * fbm(wx, wy, 45, 4, seed + 24)
    plain = smoothstep(6.0, 3.5, maps["floor_m"]) * smoothstep(0, 6, ground)  # sediment covers the rock there
    top = smooth_min(top, walls - 3.0 * plain * smoothstep(12, 0, side), 4)
    top = np.maximum(top, np.where(maps["inland"] > 0, maps["floor_m"] - 2 + 0 * top, -9.0))
    rough = np.maximum(top, ground)[::2, ::2]
    fixed = (side <= 0)[::2, ::2] | (top < ground)[::2, ::2] | (coast < 0)[::2, ::2]
    cut = cut_valleys(rough, fixed, 2.0, 70, 0.034, 0.07)
    slipped, soil = crumble(cut, np.zeros_like(cut), 0.95, 0.62, 2.0, 30)
    turf = 0.5 * fbm(x, y, 20, 4, seed + 33)
    free = smoothstep(0, 2.5, top - ground) * smoothstep(0, 4, side)
    return top + (upsample(slipped + soil, x.shape) + turf - top) * free


def bed_stones(maps: dict[str, np.ndarray], height: np.ndarray, seed: int) -> np.ndarray:
    """Boulders that stand out of the rapids, so that the water has to go round them."""
    rng = np.random.default_rng(seed + 55)
    level, part = maps["level"], maps["off"] / maps["half"]
    there = sum(((level > low) & (level < high)).astype(float) for low, high in RAPIDS)
    chance = (
        there
        * smoothstep(1.15, 0.9, part)
        * (0.35 + smoothstep(-0.1, 0.5, fbm(maps["x"], maps["y"], 22, 2, seed + 56)))
    )
    picks = np.flatnonzero(rng.random(chance.size) < chance.ravel() * 0.09)
    size = 0.7 + 0.9 * np.square(rng.random(picks.size))
    row, col = picks // height.shape[1], picks % height.shape[1]
    over = 0.3 + 0.6 * rng.random(picks.size)
    tall = 1.2 * (level[row, col] + over * size - height[row, col])
    return boulders(height, np.stack([col, row, size, np.maximum(tall, 0.4)], -1), seed + 57)


def rocks(maps: dict[str, np.ndarray], height: np.ndarray, seed: int) -> np.ndarray:
    """Boulders under the sea cliffs, and some fallen from the sides of the upper valley."""
    x, y, coast = (maps[name] for name in ("x", "y", "coast"))
    rng = np.random.default_rng(seed + 50)
    sea = smoothstep(-30, -4, coast) * smoothstep(12, 2, coast) * (height < 3) * (height > -4)
    sea = sea * smoothstep(-0.2, 0.5, fbm(x, y, 40, 3, seed + 51)) * 0.03
    bank = maps["off"] - maps["half"]
    upper = smoothstep(-1, 1, bank) * smoothstep(16, 4, bank) * smoothstep(7, 9, maps["level"])
    upper = upper * smoothstep(0.0, 0.6, fbm(x, y, 26, 3, seed + 53)) * 0.03
    picks = np.flatnonzero(rng.random(x.size) < np.maximum(sea, upper).ravel())
    size = 0.75 / np.sqrt(0.05 + rng.random(picks.size))
    near = np.stack([picks % x.shape[1], picks // x.shape[1], size, size * (0.5 + 0.5 * rng.random(picks.size))], -1)
    return boulders(height, np.concatenate([BOULDERS, near]), seed + 52)
