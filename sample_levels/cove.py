"""The ground of `cove.shore`: a hooked sand beach between a cliffed headland and a low point, a river, dunes, hills.

Two surfaces are built and the higher one shows: **sediment** (sea bed, beach, dunes, river plain) by distance to the
shore line, **rock** (hills, cliffs, ledges, wave-cut platform, stacks, reefs) by distance to the rocky coast.
"""

from __future__ import annotations

import numpy as np
from cove_rock import LEDGES, STACKS, hills, rocks
from noise_ops import fbm, ridged, smooth_max, smooth_min, smoothstep, warp
from rock_ops import bare_rock, cliffs, ribs, stacks
from scipy import ndimage
from scipy.interpolate import PchipInterpolator
from terrain_ops import Curve, crumble, points

ROWS, COLS = 769, 1025

# x,y metres. The shore line west to east (land on its left), the rocky coast round it, the river down to the sea.
SHORE = points(
    """
    -86,395 64,352 139,352 209,402 284,431 384,445 484,442 584,425 664,399 724,370 766,346 824,352 899,452 984,497
    1104,520
    """
)
ROCK = points(
    """
    1124,900 -106,900 -106,430 20,392 34,330 56,278 94,296 140,282 174,306 156,338 176,380 186,432 224,500 314,556
    434,575 574,548 706,466 766,372 768,324 788,290 754,262 734,226 766,196 790,158 832,148 878,174 896,218 876,258
    918,288 940,332 914,376 888,424 922,480 966,532 1124,560
    """
)
RIVER = points(
    """
    730,800 702,722 634,668 624,604 566,556 582,506 544,470 530,436 518,392 514,330
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


def grids() -> tuple[np.ndarray, np.ndarray]:
    """World x and y of every sample, `(rows, cols)`."""
    return tuple(np.meshgrid(np.arange(COLS, dtype=float), np.arange(ROWS, dtype=float)))


def survey(seed: int) -> dict[str, np.ndarray]:
    """Maps that everything is placed by: metres inland, along the shore, left of and past the mouth of the river, …"""
    x, y = grids()
    shore, river = Curve(SHORE), Curve(RIVER)
    inland, along = shore.nearest(x, y)
    river_m, down_m = river.nearest(x, y)
    mouth_m = float(river.arc[np.argmin(np.abs(shore.nearest(*river.points.T)[0]))])
    coast = Curve(ROCK, closed=True).nearest(*warp(x, y, 95, 17, seed + 60, 5))[0]
    maps = {"x": x, "y": y, "inland": inland, "along": along, "river_m": river_m, "past_m": down_m - mouth_m}
    maps["coast"] = coast
    for name, curve, place in (("shore", shore, along), ("river", river, down_m)):
        maps[f"{name}_east"], maps[f"{name}_north"] = curve.heading(place)
    return maps


def sediment(maps: dict[str, np.ndarray], seed: int) -> np.ndarray:
    """Sea bed with a bar, beach with cusps, dunes, plain."""
    x, y, inland, along = (maps[name] for name in ("x", "y", "inland", "along"))
    line = along * 0  # noise along the shore only
    turn = along / 21 + 0.8 * fbm(along, line, 130, 2, seed + 1)
    turn = turn - np.floor(turn)
    cusp = 1.1 - 8.8 * turn * (1 - turn)  # horns 21 m apart, a bay 2.2 m deep between two
    cusp = (
        cusp
        * smoothstep(-14, 2, inland)
        * smoothstep(24, 13, inland)
        * (0.7 + 0.6 * fbm(along, line, 90, 2, seed + 13))
    )
    wander = 2 * fbm(x, y, 60, 3, seed + 2) + 8 * fbm(along, line, 170, 2, seed + 14)
    place = inland + cusp + wander * smoothstep(260, 90, np.abs(inland))
    height = PchipInterpolator(*PROFILE.T)(np.clip(place, -900, 500))
    bar = np.square(np.maximum(1 - np.square((inland + 78 + 9 * fbm(along, line, 160, 2, seed + 3)) / 22), 0))
    height += bar * (0.55 + 0.3 * fbm(along, line, 110, 2, seed + 4))
    wx, wy = warp(x, y, 60, 14, seed + 5)
    crest = ridged(wx * 0.55 + wy * 0.15, wy, 46, 4, seed + 6)
    belt = smoothstep(42, 66, inland) * smoothstep(190, 100, inland) * smoothstep(20, 60, np.abs(maps["river_m"]))
    height += belt * (0.3 + 7.0 * crest * (0.55 + 0.45 * fbm(along, line, 120, 2, seed + 7)))
    height += smoothstep(60, 140, inland) * 0.5 * fbm(x, y, 34, 4, seed + 8)
    height += smoothstep(14, 34, inland) * 0.1 * fbm(x, y, 14, 3, seed + 15)
    height += smoothstep(-20, -60, inland) * (0.25 * fbm(x, y, 55, 3, seed + 9) + 0.9 * fbm(x, y, 210, 2, seed + 10))
    return height - 5 * smoothstep(130, 0, y)


def channel(height: np.ndarray, maps: dict[str, np.ndarray], seed: int) -> np.ndarray:
    """The river cut into the sediment, its flood plain, and the shoal it drops before its mouth."""
    x, y, inland, past_m = (maps[name] for name in ("x", "y", "inland", "past_m"))
    aside = np.abs(maps["river_m"])
    shoal = smoothstep(75, 0, aside) * smoothstep(-4, -34, inland) * smoothstep(-100, -46, inland)
    height = height + (1.3 + 0.25 * fbm(x, y, 18, 3, seed + 11)) * shoal * smoothstep(95, 25, np.abs(past_m - 42))
    bed = PchipInterpolator(*BED.T)(np.clip(past_m, -600, 70))
    half = 5.5 + 4.5 * smoothstep(-70, 0, past_m) + 9 * smoothstep(0, 60, past_m)
    side = np.abs(maps["river_m"] + 2.2 * fbm(x, y, 36, 2, seed + 12)) / half
    plain = np.minimum(height, bed + 2.1 + np.maximum(side - 3, 0) * 1.1)
    height = height + (plain - height) * smoothstep(-50, -100, past_m)
    walls = bed + 1.5 * side * side + 1.2 * np.square(np.maximum(side - 1, 0)) + 6 * smoothstep(30, 66, past_m)
    return np.where(past_m < 66, smooth_min(height, walls, 0.5), height)


def height(seed: int) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Ground in metres, float64 `(rows, cols)`, row 0 south, and the maps that paint is placed by."""
    maps = survey(seed)
    x, y, coast = maps["x"], maps["y"], maps["coast"]
    sand = channel(sediment(maps, seed), maps, seed)
    rock = cliffs(x, y, coast, hills(maps, sand, seed), seed + 30)
    rock = stacks(x, y, rock, STACKS, seed + 40, seed + 36)
    rock, scree = crumble(rock, np.zeros_like(rock), 2.6, 0.68, 1.0, 30)
    ground = smooth_max(rock + ndimage.gaussian_filter(scree, 0.7), sand, 0.5)
    ground = rocks(maps, ribs(x, y, ground, LEDGES, seed + 70), seed)
    maps["stone"] = bare_rock(ground, sand) * smoothstep(70, 40, maps["inland"])
    return ground, maps
