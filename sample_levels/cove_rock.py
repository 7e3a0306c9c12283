"""The rock of `cove.shore`: hills cut by streams, and where stacks, ledges and boulders stand."""

from __future__ import annotations

import numpy as np
from noise_ops import fbm, ridged, smooth_max, smoothstep, warp
from rock_ops import boulders
from terrain_ops import crumble, cut_valleys, points, upsample

# Sea stacks and skerries: x, y, radius, height.
STACKS = points(
    """
    732,176,11,29 712,156,6,17 802,128,13,26 828,96,7,13 719,236,5,10 762,118,5,9 119,244,8,9 89,226,6,6 920,268,9,16
    """
)
# Ledges in the sand: x, y, half length, half width, height, the way they run (east, north).
LEDGES = points("508,432,15,11,1.6,0.75,-0.66 352,438,20,14,1.7,0.8,-0.6 690,372,20,13,1.9,0.96,-0.28")
# Boulders placed by hand: x, y, radius, height.
BOULDERS = points(
    """
    496,413,3.4,2.5 491,416,1.9,1.3 500,407,2.4,1.2 483,406,1.7,1 570,425,2,1.2 575,421,3,1.9 462,428,1.6,0.9
    554,404,3.2,2.2 548,398,2,1.2  684,371,4.2,2.9 690,378,2.4,1.6 696,364,3,1.7
    700,380,1.7,1.1
    """
)


def hills(maps: dict[str, np.ndarray], ground: np.ndarray, seed: int) -> np.ndarray:
    """Rock before cliffs: hills and headland, cut by streams on a grid of 2 m; below `ground` where plain covers it."""
    x, y, inland, coast = (maps[name] for name in ("x", "y", "inland", "coast"))
    wx, wy = warp(x, y, 170, 52, seed + 20, 4)
    far = inland + 60 * fbm(x, y, 170, 3, seed + 21)
    rise = smoothstep(60, 370, far) * (0.6 + 0.4 * smoothstep(-0.5, 0.6, fbm(x, y, 260, 2, seed + 26)))
    crest = ridged(wx, wy, 310, 5, seed + 22, 0.42)
    top = 3 + rise * (24 + 125 * crest + 13 * fbm(wx, wy, 60, 4, seed + 27))
    head = smoothstep(604, 809, x + 30 * fbm(x, y, 90, 2, seed + 28)) * smoothstep(680, 400, y)
    tilt = 0.08 * (x - 834) + 0.04 * (y - 250) + 10 * fbm(wx, wy, 85, 5, seed + 23)
    top = smooth_max(top, 2 + head * (35 + 15 * smoothstep(8, 70, coast) + tilt), 9)
    point = smoothstep(254, 144, x) * smoothstep(520, 360, y)
    top = smooth_max(top, 2 + point * (9 + 8 * smoothstep(0, 50, coast) + 6 * fbm(wx, wy, 70, 5, seed + 24)), 6)
    valley = smoothstep(16, 150, np.abs(maps["river_m"]) + 18 * fbm(x, y, 80, 3, seed + 25))
    low = ground - 2.5
    top = low + (top - low) * valley
    rough = np.maximum(top, ground)[::2, ::2]
    fixed = (top < ground)[::2, ::2] | (inland[::2, ::2] < 0) & (coast[::2, ::2] < 0)
    cut = cut_valleys(rough, fixed, 2.0, 200, 0.042, 0.095)
    slipped, soil = crumble(cut, np.zeros_like(cut), 0.85, 0.62, 2.0, 40)
    turf = 0.6 * fbm(x, y, 22, 4, seed + 29)
    return top + (upsample(slipped + soil, x.shape) + turf - top) * smoothstep(0, 2.5, top - ground)


def rocks(maps: dict[str, np.ndarray], height: np.ndarray, seed: int) -> np.ndarray:
    """Boulders: many under the cliffs, fewer on the platform and the beach beside it, some by hand in the surf."""
    x, y, coast = (maps[name] for name in ("x", "y", "coast"))
    rng = np.random.default_rng(seed + 50)
    chance = smoothstep(-34, -4, coast) * smoothstep(14, 2, coast) * (height < 3) * (height > -3.5)
    chance = chance * (smoothstep(724, 762, x) + smoothstep(224, 174, x))
    chance = chance * smoothstep(-0.2, 0.5, fbm(x, y, 40, 3, seed + 51))
    picks = np.flatnonzero(rng.random(chance.size) < chance.ravel() * 0.03)
    size = 0.9 / np.sqrt(0.035 + rng.random(picks.size))
    tall = size * (0.5 + 0.5 * rng.random(picks.size))
    near = np.stack([picks % x.shape[1], picks // x.shape[1], size, tall], axis=-1)
    return boulders(height, np.concatenate([BOULDERS, near]), seed + 52)
