"""The ground of `delta.shore`: a river from its spring over a fall, through a lake, rapids and meanders to two mouths.

Its line comes first. Hills, a valley with bluffs and flood plain, terraces, and beach are shaped about it; then the bed
is cut: deep under the outer bank of a bend, with a point bar inside. The higher of sediment and rock shows, as in cove.
"""

from __future__ import annotations

import numpy as np
from delta_rock import bed_stones, hills, rocks
from noise_ops import fbm, ridged, smooth_max, smoothstep, warp
from rock_ops import bare_rock, cliffs, ribs
from scipy import ndimage
from scipy.interpolate import PchipInterpolator
from scipy.spatial import cKDTree
from shorewright.level.objects import River, WaveObject
from shorewright.level.river_line import Line, centre_line
from terrain_ops import Curve, crumble, points

ROWS, COLS = 641, 513

# x, y, width, level of the water, speed, depth in the middle, half width of the valley's floor: spring, fall and plunge
# pool, lake, rapids with a step, meanders, the western mouth; then the eastern arm.
MAIN = points(
    """
    400,604,6,24,0.5,0.7,7 394,586,6,23.2,1.2,0.6,9 375,571,7,22.3,1.4,0.7,10 352,563,9,21.7,1.3,0.9,12
    338,557,11,21.5,1.8,1.3,9 334.4,555.2,12,15.7,4.5,2.2,10 325,550,21,15.5,0.8,2.9,15 311,542,9,15.42,0.9,1.0,14
    295,531,13,15.3,0.5,1.4,20 268,519,24,15.3,0.25,3.0,40 240,507,13,15.3,0.5,1.6,26 226,498,9,15.2,1.2,0.9,12
    205,480,10,14.4,2.1,0.8,7 186,453,10,13.2,2.3,0.8,6 179,424,10,12.0,2.4,0.9,6 179.6,420.6,10,10.4,3.5,1.4,7
    184,407,13,10.1,1.1,1.8,11 200,386,10,9.3,2.1,0.8,7 230,368,11,8.2,2.3,0.8,8 265,354,11,6.9,2.2,0.8,10
    300,338,11,5.6,2.1,0.8,18 328,318,11,4.4,1.5,1.0,38 358,304,13,3.6,1.0,1.5,62 374,282,13,3.2,0.9,1.7,74
    360,260,13,2.9,0.9,1.7,84 330,258,12,2.6,0.9,1.5,88 302,272,12,2.4,0.9,1.5,92 272,280,13,2.2,0.9,1.6,92
    247,266,13,2.0,0.9,1.8,92 246,240,13,1.8,0.9,1.7,92 268,224,13,1.6,0.9,1.5,92 286,208,14,1.4,0.9,1.5,92
    284,188,15,1.0,1.0,1.3,92 266,172,16,0.6,1.0,1.1,92 258,154,18,0.2,0.9,0.9,92 255,132,26,0.0,0.7,0.8,92
    """
)
ARM = points(
    """
    286,206,8,1.37,0.9,1.1,92 304,203,9,1.22,0.9,1.2,92 324,192,9,0.95,0.9,1.1,92 338,176,10,0.6,0.9,1.0,92
    358,160,13,0.2,0.8,0.8,92 364,139,20,0.0,0.6,0.7,92
    """
)
# Shore line west to east, land on its left: a bay whose middle the river has filled. Rocky coast, counterclockwise.
SHORE = points("-90,205 20,205 70,190 120,176 170,160 215,140 258,128 305,134 358,136 400,156 440,178 500,196 600,210")
ROCK = points(
    "640,760 -120,760 -120,140 -40,112 18,92 52,96 66,118 62,150 84,176 96,214 118,262 160,310 230,332 300,330 372,336"
    " 420,300 436,262 446,226 452,190 470,158 500,138 560,120 640,130"
)
PROFILE = points(
    """
    -420,-60 -240,-40 -150,-23 -112,-11.5 -86,-5.8 -66,-3.7 -50,-2.75 -36,-2.1 -24,-1.5 -12,-0.85 0,0 9,0.66 17,1.2
    24,1.6 30,1.62 42,1.5 54,1.7 70,2.2 100,2.7 160,3.1 300,3.4
    """
)
OXBOW = points("222,290 200,294 180,280 172,258 180,236 200,224 220,226")  # an old loop, cut off
OXBOW_M = 1.75  # level of its water
LAKE = (266.0, 519.0, 32.0, 21.0, 15.3)  # x, y, radii along and across (0.9, 0.4), level
SPRING = (402.0, 609.0, 6.0, 6.0, 24.0)
LEDGES = points("452,156,16,8,1.4,0.8,0.6 84,150,14,9,1.5,0.7,-0.7 409,621,11,6,2.2,0.92,0.39")


def river(name: str, knots: np.ndarray) -> River:
    """The object of a table above."""
    x, y = (float(v) for v in knots[0, :2])
    rows = np.concatenate([knots[:, :2] - (x, y), knots[:, 2:5]], axis=1).round(3)
    return River(id=name, x=x, y=y, points=tuple(tuple(float(v) for v in row) for row in rows), reach_m=60.0)


def rivers() -> list[River]:
    return [river("river", MAIN), river("river-arm", ARM)]


def wave_objects() -> list[WaveObject]:
    """Any water, any size (H32): rings that run out from the fall's foot, and a spring that bubbles up."""
    fall = WaveObject(
        id="fall-rings", x=330.5, y=553.0, radius_m=11, amplitude_m=0.09, length_m=1.7, ring=True, falloff=0.9
    )
    spring = WaveObject(
        id="spring-boil", x=402.0, y=607.5, radius_m=5, amplitude_m=0.07, length_m=1.3, ring=True, inverted=True
    )
    return [fall, spring]


def by_line(knots: np.ndarray, line: Line, column: int) -> np.ndarray:
    """A column of a table at every point of its line."""
    near = [np.argmin(np.square(line.x - x) + np.square(line.y - y)) for x, y in knots[:, :2]]
    return np.interp(line.along_m, line.along_m[near], knots[:, column])


def survey(seed: int) -> dict[str, np.ndarray]:
    """Maps that everything is placed by: metres inland and inside the rocky coast, and what the river says there."""
    x, y = np.meshgrid(np.arange(COLS, dtype=float), np.arange(ROWS, dtype=float))
    maps = {"x": x, "y": y}
    maps["inland"], maps["along"] = Curve(SHORE).nearest(x, y)
    coast = Curve(ROCK, closed=True).nearest(*warp(x, y, 80, 13, seed + 60, 5))[0]
    maps["coast"] = coast + 90 * smoothstep(250, 330, y) * smoothstep(-60, 30, coast)
    maps.update(beside(x, y, seed))
    oxbow = Curve(OXBOW)
    maps["oxbow"], maps["oxbow_along"] = oxbow.nearest(*warp(x, y, 30, 2.5, seed + 61))
    maps["oxbow"], maps["oxbow_end"] = np.abs(maps["oxbow"]), oxbow.arc[-1] - maps["oxbow_along"]
    return maps


def beside(x, y, seed: int) -> dict[str, np.ndarray]:
    """Of both rivers: metres off the line, width, level and depth at the nearest point, how far one is inside a bend;
    `floor_m`, `floor_half`: level and half width of the valley, even from one reach to the next.
    """
    lines = [centre_line(thing, 0.0) for thing in rivers()]
    parts = []
    for knots, line in zip((MAIN, ARM), lines, strict=True):
        east, north = np.gradient(line.x), np.gradient(line.y)
        long = np.sqrt(east * east + north * north)
        east, north = east / long, north / long
        turn = ndimage.gaussian_filter1d(east * np.gradient(north) - north * np.gradient(east), 9.0)  # left > 0
        tail = np.arange(len(line.x)) >= line.mouth
        sea = np.where(tail, line.along_m - line.along_m[line.mouth - 1], 0.0)
        columns = [line.x, line.y, line.half_m, line.level_m, by_line(knots, line, 5), by_line(knots, line, 6)]
        parts.append(np.stack([*columns, turn, east, north, line.along_m, sea], -1))
    table = np.concatenate(parts)

    tree = cKDTree(table[:, :2])
    off, i = (v.reshape(x.shape) for v in tree.query(np.stack([x, y], -1).reshape(-1, 2)))
    side = np.sign(table[i, 7] * (y - table[i, 1]) - table[i, 8] * (x - table[i, 0]))
    found = {name: table[i, n] for name, n in (("half", 2), ("level", 3), ("depth", 4), ("down", 9), ("out", 10))}
    floor_m, floor_half = spread(x, y, table[table[:, 10] == 0][::3])
    bend = np.clip(table[i, 6] * 30, -1, 1) * side
    return {"off": off, "bend": bend, **found, "floor_m": floor_m, "floor_half": floor_half}


def spread(x, y, table: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Level and valley's half width about the line, weighted by distance to the power of −4 (Shepard 1968)."""
    total, level, half = np.zeros(x.shape), np.zeros(x.shape), np.zeros(x.shape)
    for row in table:
        weight = 1 / np.square(np.square(x - row[0]) + np.square(y - row[1]) + 6)
        total += weight
        level += weight * row[3]
        half += weight * row[5]
    return level / total, half / total


def sediment(maps: dict[str, np.ndarray], seed: int) -> np.ndarray:
    """Sea bed with a bar, beach with cusps, low dunes, and the flood plain up the valley."""
    x, y, inland, along = (maps[name] for name in ("x", "y", "inland", "along"))
    line = along * 0
    turn = along / 19 + 0.8 * fbm(along, line, 120, 2, seed + 1)
    turn = turn - np.floor(turn)
    cusp = (1.0 - 8.0 * turn * (1 - turn)) * smoothstep(-14, 2, inland) * smoothstep(22, 12, inland)
    place = inland + cusp + 2 * fbm(x, y, 50, 3, seed + 2) + 5 * fbm(along, line, 140, 2, seed + 3)
    height = PchipInterpolator(*PROFILE.T)(np.clip(place, -420, 300))
    bar = np.square(np.maximum(1 - np.square((inland + 62 + 8 * fbm(along, line, 120, 2, seed + 4)) / 19), 0))
    height += bar * (0.6 + 0.3 * fbm(along, line, 90, 2, seed + 5))
    away = smoothstep(14, 40, maps["off"] - maps["half"])
    belt = smoothstep(30, 46, inland) * smoothstep(105, 70, inland) * away
    height += belt * (0.2 + 2.6 * ridged(x * 0.6 + y * 0.2, y, 34, 4, seed + 6))
    plain = maps["floor_m"] + 0.55 + 0.5 * smoothstep(6, 3.5, maps["floor_m"]) + 0.014 * maps["off"]
    plain += 0.45 * fbm(x, y, 42, 4, seed + 7) * smoothstep(6, 30, maps["off"])
    rise = smoothstep(45, 95, inland)
    height = height + (np.maximum(height, plain) - height) * rise
    return height - 4 * smoothstep(90, 0, y) + smoothstep(10, 40, inland) * 0.12 * fbm(x, y, 9, 3, seed + 8)


def shoals(height: np.ndarray, maps: dict[str, np.ndarray], seed: int) -> np.ndarray:
    """The bar that each arm drops where its jet slows down, lobed, with a deeper way beside it."""
    x, y = maps["x"], maps["y"]
    out = maps["out"] + 6 * fbm(x, y, 30, 3, seed + 9)
    lobe = smoothstep(10, 26, out) * smoothstep(56, 34, out) * smoothstep(30, 8, maps["off"])
    return height + lobe * (1.05 + 0.4 * fbm(x, y, 16, 3, seed + 10))


def channel(height: np.ndarray, maps: dict[str, np.ndarray], seed: int) -> np.ndarray:
    """The bed: pools under outer banks, point bars inside, gravel bars at the mouths, banks that hold the water."""
    x, y, off, level, bend, out = (maps[name] for name in ("x", "y", "off", "level", "bend", "out"))
    half = maps["half"] - np.minimum(0.26 * maps["half"], 1.6) * (
        0.7 + 1.3 * fbm(x, y, 10, 3, seed + 12)
    )  # uneven banks
    half = np.maximum(half, 0.5 * maps["half"])
    part, beyond = off / half, np.maximum(off - half, 0)
    inner, outer = np.maximum(bend, 0), np.maximum(-bend, 0)
    deep = maps["depth"] * (1 + 0.35 * outer - 0.45 * inner * smoothstep(0.2, 1, part))
    bed = level - deep * (1 - np.square(np.minimum(part, 1)))
    bed += (0.15 * fbm(x, y, 4, 3, seed + 11)) * smoothstep(0, 0.5, 1 - part)
    braids = smoothstep(1.5, 0.7, level) * smoothstep(0.05, 0.55, fbm(x, y, 17, 3, seed + 13))
    braids *= smoothstep(0.15, 0.5, part) * smoothstep(0, 0.25, 1 - part) * (out <= 0)
    bed += (np.minimum(bed + 1.1 * braids, level + 0.1) - bed) * (braids > 0)
    bar = 0.06 + 0.07 * beyond  # a point bar rises slowly, a cut bank stands
    bank = 0.10 + 0.16 * beyond + 0.045 * np.square(beyond)
    cut = 0.25 + 0.9 * beyond
    high = (
        level + bank + (bar - bank) * inner * smoothstep(26, 9, beyond) + (cut - bank) * outer * smoothstep(9, 4, level)
    )
    shaped = np.minimum(height, high)
    above = ndimage.maximum_filter(level, 9)
    low = np.where(above - level > 0.6, above + 0.3, level) + np.minimum(0.12 + 0.2 * beyond, 0.5)  # beside a fall
    holds = (beyond < 7) & (maps["inland"] > 14) & (maps["lake"] > 1.3) & (maps["spring"] > 1.5)
    shaped = np.where(holds, np.maximum(shaped, low - 5 * smoothstep(4.5, 7, beyond)), shaped)
    deeper = (height < bed) & ((maps["inland"] < 8) | (maps["lake"] < 1.3) | (maps["spring"] < 1.3))
    shaped = np.where(part < 1, np.where(deeper, height, bed), shaped)
    gap = np.minimum(height, bed + 0.06 * out + 0.4 * np.square(part))  # on through the beach's foot
    return np.where(out > 0, height + (gap - height) * smoothstep(20, 4, out), shaped)


def basin(height: np.ndarray, maps: dict[str, np.ndarray], name: str, place, deep: float) -> np.ndarray:
    """A hollow for standing water with a shore that holds it, open where the river passes."""
    radius, level, size = maps[name], place[4], 0.5 * (place[2] + place[3])
    shore = level + np.where(radius < 1, -deep * (1 - radius * radius), 0.16 * size * (radius - 1))
    rim = (radius >= 1) & (radius < 1 + 4 / size) & (maps["off"] > maps["half"] + 1)
    held = np.where(rim, np.maximum(height, level + 0.15 + 0.1 * size * (radius - 1)), height)
    return np.where(radius < 2.2, np.minimum(held, np.maximum(shore, level - deep)), held)


def around(maps: dict[str, np.ndarray], place, seed: int) -> np.ndarray:
    """Distance from the middle of a pool in its radii, uneven."""
    x, y, along, across, _ = place
    dx, dy = maps["x"] - x, maps["y"] - y
    u, v = (0.914 * dx + 0.406 * dy) / along, (0.406 * dx - 0.914 * dy) / across
    return np.sqrt(u * u + v * v) * (1 + 0.16 * fbm(maps["x"], maps["y"], 0.9 * along, 3, seed))


def oxbow(height: np.ndarray, maps: dict[str, np.ndarray], seed: int) -> np.ndarray:
    """The cut-off loop: its old bed, silted up at both ends."""
    ends = smoothstep(0, 22, np.minimum(maps["oxbow_along"], maps["oxbow_end"]))
    part = maps["oxbow"] / (2.5 + 4.5 * ends)
    bank = np.maximum(part - 1, 0)
    bed = OXBOW_M - 1.2 * ends * (1 - np.minimum(part * part, 1)) + bank + 0.5 * bank * bank + 0.12 * (1 - ends)
    dug = np.minimum(height, bed)
    ring = (part >= 1) & (part < 2.2)
    return np.where(ring, np.maximum(dug, OXBOW_M + 0.1 + 0.2 * (part - 1)), dug)


def height(seed: int) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Ground in metres, float64 `(rows, cols)`, row 0 south, and the maps that paint is placed by."""
    maps = survey(seed)
    x, y = maps["x"], maps["y"]
    sand = shoals(sediment(maps, seed), maps, seed)
    rock = cliffs(x, y, maps["coast"], hills(maps, sand, seed), seed + 30)
    rock, scree = crumble(rock, np.zeros_like(rock), 2.6, 0.68, 1.0, 30)
    ground = smooth_max(rock + ndimage.gaussian_filter(scree, 0.7), sand, 0.5)
    ground = ribs(x, y, ground, LEDGES, seed + 70)
    maps["lake"], maps["spring"] = around(maps, LAKE, seed + 80), around(maps, SPRING, seed + 81)
    ground = basin(basin(ground, maps, "lake", LAKE, 3.0), maps, "spring", SPRING, 1.1)
    ground = channel(oxbow(ground, maps, seed), maps, seed)
    before = ground
    ground = bed_stones(maps, rocks(maps, ground, seed), seed)
    maps["stone"] = np.maximum(
        bare_rock(ground, sand) * smoothstep(40, 15, maps["inland"]), smoothstep(0.1, 0.4, ground - before)
    )
    return ground, maps
