"""The ground of `cove.shore`: a hooked sand beach between a cliffed headland and a low point, a river, dunes, hills.

Two surfaces are built and the higher one shows: **sediment** (sea bed, beach, dunes, river plain) by distance to the
shore line, **rock** (hills, cliffs, ledges, wave-cut platform, stacks, reefs) by distance to the rocky coast.
"""

from __future__ import annotations

import numpy as np
from noise_ops import fbm, ridged, smooth_max, smooth_min, smoothstep, warp, worley
from scipy import ndimage
from scipy.interpolate import PchipInterpolator
from terrain_ops import Curve, beds, boulders, crumble, cut_valleys, points, upsample

ROWS, COLS = 769, 1025

# x,y metres. The shore line west to east (land on its left), the rocky coast round it, the river down to the sea.
SHORE = points(
    """
    -80,520 40,497 125,452 200,352 258,346 300,370 360,399 440,425 540,442 640,445 740,431 815,402 885,352 960,352
    1110,395
    """
)
ROCK = points(
    """
    -100,560 58,532 102,480 136,424 110,376 84,332 106,288 148,258 128,218 146,174 192,148 234,158 258,196 290,226
    270,262 236,290 256,324 258,372 318,466 450,548 590,575 710,556 800,500 838,432 848,380 868,338 850,306 884,282
    930,296 968,278 990,330 1004,392 1130,430 1130,900 -100,900
    """
)
RIVER = points(
    """
    800,800 772,722 704,668 694,604 636,556 652,506 614,470 600,436 588,392 584,330
    """
)
# Sea stacks and skerries: x, y, radius, height.
STACKS = points(
    """
    292,176,11,21 312,158,6,12 222,128,13,26 196,96,7,13 303,238,5,7 262,118,5,9 905,244,8,9 935,226,6,6 104,268,9,16
    """
)

# Height by metres inland of the water line: shelf, bar, foreshore of about 1:14, berm, dune foot, plain. Offshore it
# follows Dean's profile d = 0.16 x^(2/3) to 5 m of depth and then drops faster than nature, to fit the level.
PROFILE = points(
    """
    -900,-36 -500,-33 -400,-28 -300,-18.5 -215,-10.2 -150,-6.0 -112,-4.35 -88,-3.4 -72,-2.86 -58,-2.74 -42,-2.3
    -26,-1.62 -13,-0.92 0,0 9,0.66 17,1.24 24,1.68 30,1.7 42,1.62 54,2.0 66,3.1 100,4.2 160,5.4 260,7.5 500,12
    """
)
# Bed and surface of the river by metres downstream of the shore line: pools and riffles, sea level at the mouth.
BED = points("-600,9.0 -320,5.0 -200,3.0 -120,1.55 -60,0.35 -25,-0.35 0,-0.75 30,-1.5 70,-3.2")
SURFACE = points("-600,9.9 -320,5.8 -200,3.75 -150,2.75 -120,2.2 -90,1.55 -60,0.98 -35,0.4 -12,0.08 5,0.0 80,0.0")
# Boulders placed by hand: x, y, radius, height.
BOULDERS = points(
    """
    566,421,3.4,2.5 561,424,1.9,1.3 570,415,2.4,1.2 553,414,1.7,1.0 640,433,2.0,1.2 645,429,3.0,1.9 532,436,1.6,0.9
    470,404,3.2,2.2 476,398,2.0,1.2 385,392,3.6,2.4 380,397,2.1,1.4 340,371,4.2,2.9 334,378,2.4,1.6 328,364,3.0,1.7
    724,420,2.6,1.7
    """
)


def grids() -> tuple[np.ndarray, np.ndarray]:
    """World x and y of every sample, `(rows, cols)`."""
    return tuple(np.meshgrid(np.arange(COLS, dtype=float), np.arange(ROWS, dtype=float)))


def sediment(x, y, inland, along, river_m, down_m, mouth_m, seed: int) -> np.ndarray:
    """Sea bed, beach with cusps, dunes and plain, with the river's channel and its delta."""
    cusp = np.abs(fbm(along, along * 0, 23, 2, seed + 1)) * 2.6 - 1.0  # horns about 20 m apart
    cusp = cusp * smoothstep(-4, 5, inland) * smoothstep(26, 14, inland)
    wander = 2 * fbm(x, y, 60, 3, seed + 2) + 7 * fbm(along, along * 0, 170, 2, seed + 14)
    place = inland + cusp + wander * smoothstep(260, 90, np.abs(inland))
    height = PchipInterpolator(*PROFILE.T)(np.clip(place, -900, 500))
    bar = np.square(np.maximum(1 - np.square((inland + 78 + 9 * fbm(along, along * 0, 160, 2, seed + 3)) / 22), 0))
    height += bar * (0.55 + 0.3 * fbm(along, along * 0, 110, 2, seed + 4))
    near_river = smoothstep(70, 22, np.abs(river_m))
    wx, wy = warp(x, y, 60, 14, seed + 5)
    crest = ridged(wx * 0.55 + wy * 0.15, wy, 46, 4, seed + 6)
    belt = smoothstep(50, 72, inland) * smoothstep(190, 100, inland) * (1 - near_river)
    height += belt * (0.3 + 6.2 * crest * (0.55 + 0.45 * fbm(along, along * 0, 120, 2, seed + 7)))
    height += smoothstep(60, 140, inland) * 0.5 * fbm(x, y, 34, 4, seed + 8)
    height += smoothstep(-20, -60, inland) * (0.25 * fbm(x, y, 55, 3, seed + 9) + 0.9 * fbm(x, y, 210, 2, seed + 10))
    height = height - 5 * smoothstep(130, 0, y)
    return channel(height, x, y, inland, river_m, down_m - mouth_m, seed)


def channel(height, x, y, inland, river_m, past_m, seed: int) -> np.ndarray:
    """The river's bed cut into the sediment; `past_m` is metres downstream of the shore line."""
    shallow = height + (1.3 + 0.25 * fbm(x, y, 18, 3, seed + 11)) * smoothstep(95, 25, np.abs(past_m - 42)) * (
        smoothstep(75, 0, np.abs(river_m)) * smoothstep(-4, -34, inland) * smoothstep(-100, -46, inland)
    )
    bed = river_bed(past_m)
    half = 5.5 + 4.5 * smoothstep(-70, 0, past_m) + 9 * smoothstep(0, 60, past_m)
    side = np.abs(river_m + 2.2 * fbm(x, y, 36, 2, seed + 12)) / half
    walls = bed + 1.5 * side * side + 1.2 * np.maximum(side - 1, 0) ** 2
    height = np.where(past_m < -60, np.minimum(shallow, bed + 2.1 + np.maximum(side - 3, 0) * 1.1), shallow)
    return np.where(past_m < 66, smooth_min(height, walls + 6 * smoothstep(30, 66, past_m), 0.5), height)


def river_bed(past_m) -> np.ndarray:
    """Bed of the channel along the river: steps of riffle and pool in the hills, level with the sea at the mouth."""
    return PchipInterpolator(*BED.T)(np.clip(past_m, -600, 70))


def hills(x, y, inland, coast, river_m, ground, seed: int) -> np.ndarray:
    """Rock before cliffs: hills and headland, cut by streams on a grid of 2 m; below `ground` where plain covers it."""
    wx, wy = warp(x, y, 170, 52, seed + 20, 4)
    far = inland + 60 * fbm(x, y, 170, 3, seed + 21)
    rise = smoothstep(60, 370, far) * (0.55 + 0.45 * smoothstep(-0.5, 0.6, fbm(x, y, 260, 2, seed + 26)))
    top = 3 + rise * (22 + 190 * ridged(wx, wy, 310, 6, seed + 22, 0.5) + 12 * fbm(wx, wy, 60, 4, seed + 27))
    head = smoothstep(420, 215, x + 30 * fbm(x, y, 90, 2, seed + 28)) * smoothstep(680, 400, y)
    tilt = 0.08 * (190 - x) + 0.04 * (y - 250) + 10 * fbm(wx, wy, 85, 5, seed + 23)
    top = smooth_max(top, 2 + head * (28 + 13 * smoothstep(8, 70, coast) + tilt), 9)
    point = smoothstep(770, 880, x) * smoothstep(520, 360, y)
    top = smooth_max(top, 2 + point * (8 + 8 * smoothstep(0, 50, coast) + 6 * fbm(wx, wy, 70, 5, seed + 24)), 6)
    valley = smoothstep(16, 150, np.abs(river_m) + 18 * fbm(x, y, 80, 3, seed + 25))
    low = ground - 2.5
    top = low + (top - low) * valley
    rough = np.maximum(top, ground)[::2, ::2]
    fixed = (top < ground)[::2, ::2] | (inland[::2, ::2] < 0) & (coast[::2, ::2] < 0)
    cut = cut_valleys(rough, fixed, 2.0, 220, 0.034, 0.035)
    return np.where(top < ground, top, upsample(cut, x.shape))


def cliffs(x, y, coast, top, seed: int) -> np.ndarray:
    """`top` broken off at the coast: faces in beds of rock, clefts along joints, a platform at the foot, reefs."""
    first, second, _ = worley(*warp(x * 0.9 + y * 0.4, y * 0.9 - x * 0.4, 30, 5, seed + 30), 21, seed + 31)
    cleft = smoothstep(0.22, 0.0, second - first)
    buttress = 9 * ridged(x, y, 58, 5, seed + 32) - 4 + 2.2 * fbm(x, y, 11, 3, seed + 33)
    coast = coast + buttress - 5.5 * cleft
    toe = 0.15 + 0.75 * fbm(x, y, 26, 4, seed + 34) - 0.7 * cleft
    width = np.maximum(4 + 0.42 * top * (1 + 0.45 * fbm(x, y, 64, 3, seed + 35)), 3)
    u = 1 - np.clip(coast / width, 0, 1)
    face = toe + (top - toe) * (1 - u * u * np.sqrt(u))
    stepped = beds(face, x, y, (0.05, -0.035), 3.1, seed + 36)
    face = face + (stepped - face) * 0.85 * smoothstep(1.0, 0.7, 1 - u) * smoothstep(2, 6, top)
    out = np.maximum(-coast, 0)
    wide = 7 + 9 * (1 + fbm(x, y, 70, 2, seed + 37))
    shelf = toe - 0.02 * out - 0.33 * np.maximum(out - wide, 0)
    shelf += 3.4 * (ridged(x, y, 31, 5, seed + 38) - 0.42) * smoothstep(wide, wide + 14, out) * smoothstep(110, 40, out)
    return np.where(coast > 0, face, shelf)


def stacks(x, y, rock, seed: int) -> np.ndarray:
    """Sea stacks and skerries before the headland and the point."""
    for index, (east, north, radius, tall) in enumerate(STACKS):
        near = (slice(max(int(north) - 45, 0), int(north) + 46), slice(max(int(east) - 45, 0), int(east) + 46))
        px, py = x[near], y[near]
        wx, wy = warp(px, py, 16, 3.2, seed + 40 + index, 4)
        stretch = 0.7 + 0.12 * (index % 5)
        coast = radius - np.sqrt(np.square((wx - east) * stretch) + np.square((wy - north) / stretch))
        lean = tall * (1 + 0.018 * (px - east) - 0.014 * (py - north)) + 1.6 * fbm(px, py, 9, 3, seed + 41)
        u = 1 - np.clip(coast / (0.55 * radius), 0, 1)
        column = -1.5 + (lean + 1.5) * (1 - u * u * u)
        column = column + (beds(column, px, py, (0.05, -0.035), 3.1, seed + 36) - column) * 0.8
        apron = -1.5 + coast * 0.55 + 1.1 * fbm(px, py, 7, 3, seed + 42)
        rock[near] = np.maximum(rock[near], np.where(coast > 0, column, apron))
    return rock


def rocks(x, y, coast, height, seed: int) -> np.ndarray:
    """Boulders: many under the cliffs, fewer on the platform and the beach beside it, some in the surf."""
    rng = np.random.default_rng(seed + 50)
    chance = smoothstep(-34, -4, coast) * smoothstep(14, 2, coast) * (height < 3) * (height > -3.5)
    chance = (
        chance
        * (smoothstep(300, 262, x) + smoothstep(800, 850, x))
        * smoothstep(-0.2, 0.5, fbm(x, y, 40, 3, seed + 51))
    )
    picks = np.flatnonzero(rng.random(chance.size) < chance.ravel() * 0.03)
    size = 0.9 / np.sqrt(0.035 + rng.random(picks.size))
    near = np.stack([picks % COLS, picks // COLS, size, size * (0.5 + 0.5 * rng.random(picks.size))], axis=-1)
    return boulders(height, np.concatenate([BOULDERS, near]), seed + 52)


def height(seed: int) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Ground in metres, float64 `(rows, cols)`, row 0 south, and the maps that paint is placed by."""
    x, y = grids()
    shore, river = Curve(SHORE), Curve(RIVER)
    inland, along = shore.nearest(x, y)
    river_m, down_m = river.nearest(x, y)
    mouth_m = float(river.arc[np.argmin(np.abs(shore.nearest(river.points[:, 0], river.points[:, 1])[0]))])
    coast = Curve(ROCK, closed=True).nearest(*warp(x, y, 95, 17, seed + 60, 5))[0]
    sand = sediment(x, y, inland, along, river_m, down_m, mouth_m, seed)
    top = hills(x, y, inland, coast, river_m, sand, seed)
    rock = stacks(x, y, cliffs(x, y, coast, top, seed), seed)
    bare = np.where(rock > sand, rock - 0.02 * np.abs(ridged(x, y, 6, 3, seed + 61)), rock)
    bare, scree = crumble(bare, np.zeros_like(bare), 2.6, 0.68, 1.0, 30)
    ground = smooth_max(bare + ndimage.gaussian_filter(scree, 0.7), sand, 0.5)
    ground = rocks(x, y, coast, ground, seed)
    maps = {"inland": inland, "along": along, "river_m": river_m, "past_m": down_m - mouth_m, "coast": coast}
    for name, curve, place in (("shore", shore, along), ("river", river, down_m)):
        maps[f"{name}_east"], maps[f"{name}_north"] = curve.heading(place)
    return ground, maps
