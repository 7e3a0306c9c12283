"""The ground of `island.shore`: a breached volcano with sea cliffs to the west, a lagoon behind a reef, a sandy spit.

The highest of these surfaces shows: the deep floor, the lagoon's floor, the reef, sand by distance to the beach, rock.
"""

from __future__ import annotations

import numpy as np
from noise_ops import fbm, ridged, smooth_max, smoothstep, warp, worley
from rock_ops import bare_rock, boulders, cliffs, ribs, stacks
from scipy import ndimage
from scipy.interpolate import PchipInterpolator
from terrain_ops import Curve, crumble, cut_valleys, points, upsample

ROWS, COLS = 833, 1025
SUMMIT = (366.0, 486.0)

# x,y metres, all with land, lagoon or reef flat on the left: rocky coast, beaches and spit, lagoon, crest of the reef.
ROCK = points(
    """
    322,306 366,266 420,262 462,292 512,338 548,430 546,520 520,600 470,662 396,700 318,676 246,612 206,520 214,424
    268,362
    """
)
SAND = points(
    """
    436,322 476,276 528,240 590,212 648,192 694,186 722,198 712,218 676,226 634,242 602,272 590,318 602,372 634,430
    640,500 614,566 562,618 480,640 400,600 360,500 390,380
    """
)
LAGOON = points(
    """
    440,300 560,236 700,204 748,190 806,206 868,262 908,352 908,462 862,572 776,660 664,724 548,752 430,730 380,600
    """
)
REEF = points("826,214 874,266 908,352 908,462 862,572 776,660 664,724 548,752 440,734 360,712")
CAYS = points("880,446,30,1.9 878,396,17,1.2 690,716,24,1.6 560,730,18,1.3")
PASSES = ((455.0, 17.0, 6.5),)  # metres along the reef, half width, depth
STACKS = points("186,560,10,19 170,578,5,9 196,404,9,15 300,276,8,12 286,262,4,6 240,652,7,11")
LEDGES = points("452,270,26,14,1.6,0.9,-0.42 604,268,12,8,1.1,0.7,0.7 690,187,19,8,1.3,0.99,0.14")
BOULDERS = points(
    "706,184,2.6,1.6 678,181,2.0,1.3 712,186,1.6,0.8 484,262,3.2,2.1 494,252,2.1,1.4 "
    "600,300,2.6,1.7 606,309,1.8,1 618,398,3,1.8 640,470,2.4,1.5"
)

# Height by metres inland of the beach: in the lagoon, and on the open side of the spit.
QUIET = points("-900,-5.5 -220,-4.6 -90,-3.6 -44,-2.7 -22,-1.9 -9,-0.9 0,0 8,0.78 15,1.3 22,1.5 36,1.9 80,3.2 300,6")
OPEN = points(
    "-900,-44 -420,-41 -300,-34 -210,-20 -150,-10 -108,-5.4 -76,-3.7 -50,-2.9 -28,-1.85 -12,-0.9 0,0 10,0.8 19,1.5 "
    "28,1.9 40,1.95 80,3.2 300,6"
)


def survey(seed: int) -> dict[str, np.ndarray]:
    """Maps that everything is placed by: metres inside the rocky coast, the beach, the lagoon; place on the reef."""
    x, y = np.meshgrid(np.arange(COLS, dtype=float), np.arange(ROWS, dtype=float))
    maps = {"x": x, "y": y, "coast": Curve(ROCK, closed=True).nearest(*warp(x, y, 90, 16, seed + 1, 5))[0]}
    maps["inland"], maps["along"] = Curve(SAND, closed=True).nearest(x, y)
    maps["lagoon"] = Curve(LAGOON, closed=True).nearest(x, y)[0]
    maps["reef_m"], maps["reef_along"] = Curve(REEF).nearest(*warp(x, y, 70, 9, seed + 2, 3))
    return maps


def sand(maps: dict[str, np.ndarray], seed: int) -> np.ndarray:
    """Beaches, spit, lagoon floor with coral heads, and the slope to the deep floor."""
    x, y, inland, along = (maps[name] for name in ("x", "y", "inland", "along"))
    line = along * 0
    turn = along / 19 + 0.8 * fbm(along, line, 120, 2, seed + 10)
    turn = turn - np.floor(turn)
    open_side = smoothstep(30, -30, maps["lagoon"] + 12 * fbm(x, y, 60, 2, seed + 11))
    cusp = (1.0 - 8.0 * turn * (1 - turn)) * smoothstep(-14, 2, inland) * smoothstep(22, 12, inland) * open_side
    place = inland + cusp + 2 * fbm(x, y, 50, 3, seed + 12) + 5 * fbm(along, line, 140, 2, seed + 13)
    quiet, exposed = (PchipInterpolator(*table.T)(np.clip(place, -900, 300)) for table in (QUIET, OPEN))
    height = quiet + (exposed - quiet) * open_side
    height += smoothstep(18, 40, inland) * (0.5 + 1.3 * ridged(x, y, 30, 4, seed + 14)) * smoothstep(120, 70, inland)
    floor = smoothstep(-25, -90, inland)
    height += floor * (0.35 * fbm(x, y, 45, 3, seed + 15) + 1.5 * open_side * fbm(x, y, 200, 3, seed + 16))
    nearest, _, chance = worley(*warp(x, y, 30, 6, seed + 17), 34, seed + 18)
    heads = smoothstep(0.34, 0.12, nearest) * (chance > 0.45) * floor * (1 - open_side)
    return height + heads * (2.2 + 0.8 * fbm(x, y, 7, 3, seed + 19))


def reef(maps: dict[str, np.ndarray], seed: int) -> np.ndarray:
    """Flat and crest a little under water, spurs and grooves on the sea side, cut by two passes."""
    x, y, along = (maps[name] for name in ("x", "y", "reef_along"))
    inside = maps["reef_m"] + 5 * fbm(x, y, 40, 4, seed + 20)
    out = np.maximum(-inside, 0)
    flat = -0.75 + 0.5 * smoothstep(26, 4, inside) + 0.45 * fbm(x, y, 12, 4, seed + 21)
    flat = flat - 0.055 * np.maximum(inside - 34, 0) - 0.0016 * np.square(np.maximum(inside - 34, 0))
    spur = along / 15 + 0.6 * fbm(x, y, 45, 2, seed + 22)
    spur = spur - np.floor(spur)
    groove = 2.6 * smoothstep(0.3, 0.1, np.abs(spur - 0.5)) * smoothstep(4, 16, out) * smoothstep(80, 40, out)
    slope = flat - 0.13 * out - 0.0035 * np.square(out) - groove + 1.2 * fbm(x, y, 20, 4, seed + 23)
    height = np.where(inside > 0, flat, slope)
    for middle, half, deep in PASSES:
        cut = smoothstep(half + 14, half - 4, np.abs(along - middle) + 5 * fbm(x, y, 30, 2, seed + 24))
        height = height + (np.minimum(height, -deep - 0.03 * out) - height) * cut
    ends = smoothstep(0, 30, along) * smoothstep(0, 60, along[0, 0] * 0 + along.max() - along)
    return -50 + (height + 50) * ends


def cays(maps: dict[str, np.ndarray], ground: np.ndarray, seed: int) -> np.ndarray:
    """Islets of coral sand on the reef flat: `CAYS` rows are x, y, radius, height."""
    x, y = warp(maps["x"], maps["y"], 45, 9, seed + 25)
    for east, north, radius, tall in CAYS:
        away = np.sqrt(np.square(x - east) + np.square(y - north)) / radius
        ground = smooth_max(ground, tall + 0.9 - 5.0 * np.square(away), 0.8)
    return ground


def volcano(maps: dict[str, np.ndarray], ground: np.ndarray, seed: int) -> np.ndarray:
    """The cone before cliffs: steep to the west, breached crater to the south-east, cut by streams."""
    x, y, coast = (maps[name] for name in ("x", "y", "coast"))
    wx, wy = warp(x, y, 150, 30, seed + 30, 4)
    away = np.sqrt(np.square(wx - SUMMIT[0]) + np.square(wy - SUMMIT[1]))
    east = np.clip((wx - SUMMIT[0]) / np.maximum(away, 1), 0, 1)
    part = np.clip(1 - away / (310 - 88 * east), 0, 1)
    cone = 188 * part * np.sqrt(part) * (0.8 + 0.4 * ridged(wx, wy, 190, 5, seed + 31))
    old_cliff = 1 - smoothstep(0.1, 0.75, east) * smoothstep(130, 0, coast)  # none where the beach grew in front of it
    top = 2 + old_cliff * (cone + 9 * fbm(wx, wy, 55, 5, seed + 32) * smoothstep(0, 60, cone))
    rough = np.maximum(top, ground)[::2, ::2]
    fixed = (top < ground)[::2, ::2] | (coast < 0)[::2, ::2]
    cut = cut_valleys(rough, fixed, 2.0, 200, 0.046, 0.085)
    cut = cut - crater(maps["x"][::2, ::2], maps["y"][::2, ::2], seed)
    slipped, soil = crumble(cut, np.zeros_like(cut), 0.8, 0.62, 2.0, 80)
    turf = 0.8 * fbm(x, y, 20, 4, seed + 33)
    return top + (upsample(slipped + soil, x.shape) + turf - top) * smoothstep(0, 2.5, top - ground)


def crater(x, y, seed: int) -> np.ndarray:
    """What the last eruption took away: a bowl, open to the south-east."""
    wx, wy = warp(x, y, 40, 7, seed + 34)
    east, north = wx - SUMMIT[0] - 8, wy - SUMMIT[1] + 4
    breach = smoothstep(24, 5, np.abs(east * 0.6 + north * 0.8)) * smoothstep(-6, 14, east) * smoothstep(110, 35, east)
    return np.maximum(44 * smoothstep(50, 14, np.sqrt(east * east + north * north)), 30 * breach)


def rocks(maps: dict[str, np.ndarray], height: np.ndarray, seed: int) -> np.ndarray:
    """Boulders below the cliffs and a few on the beaches."""
    coast = maps["coast"]
    rng = np.random.default_rng(seed + 50)
    chance = smoothstep(-30, -4, coast) * smoothstep(12, 2, coast) * (height < 3) * (height > -4)
    chance = chance * smoothstep(-0.2, 0.5, fbm(maps["x"], maps["y"], 40, 3, seed + 51))
    picks = np.flatnonzero(rng.random(chance.size) < chance.ravel() * 0.03)
    size = 0.9 / np.sqrt(0.035 + rng.random(picks.size))
    near = np.stack([picks % COLS, picks // COLS, size, size * (0.5 + 0.5 * rng.random(picks.size))], axis=-1)
    return boulders(height, np.concatenate([BOULDERS, near]), seed + 52)


def height(seed: int) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Ground in metres, float64 `(rows, cols)`, row 0 south, and the maps that things are placed by."""
    maps = survey(seed)
    x, y = maps["x"], maps["y"]
    ground = cays(maps, smooth_max(sand(maps, seed), reef(maps, seed), 0.8), seed)
    rock = cliffs(x, y, maps["coast"], volcano(maps, ground, seed), seed + 60)
    rock = np.where(maps["coast"] < -40, np.minimum(rock, ground), rock)
    rock = stacks(x, y, rock, STACKS, seed + 70, seed + 66)
    rock, scree = crumble(rock, np.zeros_like(rock), 2.6, 0.68, 1.0, 30)
    whole = smooth_max(rock + ndimage.gaussian_filter(scree, 0.7), ground, 0.5)
    whole = rocks(maps, ribs(x, y, whole, LEDGES, seed + 80), seed)
    maps["stone"] = bare_rock(whole, ground) * smoothstep(60, 30, maps["inland"])
    return whole, maps
