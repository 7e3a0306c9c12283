"""Rocky coasts: cliffs in beds with ledges, wave-cut platforms, reefs, sea stacks, ribs of tilted rock, boulders.

`coast` is metres inside the line of the rocky coast (negative at sea), already warped by noise.
"""

from __future__ import annotations

import numpy as np
from noise_ops import fbm, ridged, smooth_min, smoothstep, warp, worley
from scipy import ndimage

BED_M = 7.0  # thickness of a bed of rock: ledges of two or three metres at 1 m cells
DIP = (0.045, -0.03)


def beds(z, x, y, seed: int) -> np.ndarray:
    """Height remapped to a stair of tilted beds: hard ones stand as faces, soft ones weather to sloping ledges."""
    tilt = DIP[0] * x + DIP[1] * y + 0.6 * BED_M * fbm(x, y, 140, 2, seed)
    u = (z - tilt) / BED_M
    whole = np.floor(u)
    hardness = np.random.default_rng(seed).random(4096)[whole.astype(np.int64) & 4095]
    part = u - whole
    ledge, rise = 0.35 + 0.3 * hardness, 0.1  # parts of the bed's width and height that are its ledge
    face = smoothstep(0, 1, (part - ledge) / (1 - ledge))
    step = np.where(part < ledge, rise * part / ledge, rise + (1 - rise) * face)
    return (whole + step) * BED_M + tilt


def cliffs(x, y, coast, top, seed: int, steep: float = 0.72) -> np.ndarray:
    """`top` broken off at the coast: faces in beds, clefts along joints, a platform at the foot, reefs before it.

    `steep` is the cliff's width over its height.
    """
    first, second, _ = worley(*warp(x * 0.9 + y * 0.4, y * 0.9 - x * 0.4, 30, 5, seed), 23, seed + 1)
    cleft = smoothstep(0.2, 0.0, second - first)
    buttress = 11 * ridged(x, y, 62, 5, seed + 2) - 5 + 2.0 * fbm(x, y, 11, 3, seed + 3)
    coast = coast + buttress - 4.5 * cleft
    toe = 0.15 + 0.75 * fbm(x, y, 26, 4, seed + 4) - 0.7 * cleft
    width = np.maximum(4 + steep * top * (1 + 0.5 * fbm(x, y, 64, 3, seed + 5)), 3)
    u = 1 - np.clip(coast / width, 0, 1)
    face = toe + (top - toe) * (1 - u * np.sqrt(u))
    stepped = beds(face, x, y, seed + 6)
    face = face + (stepped - face) * 0.9 * smoothstep(0.05, 0.3, u) * smoothstep(2, 6, top)
    out = np.maximum(-coast, 0)
    wide = 7 + 9 * (1 + fbm(x, y, 70, 2, seed + 7))
    shelf = toe - 0.02 * out - 0.33 * np.maximum(out - wide, 0)
    shelf += 3.4 * (ridged(x, y, 31, 5, seed + 8) - 0.42) * smoothstep(wide, wide + 14, out) * smoothstep(110, 40, out)
    return np.where(coast > 0, face, shelf)


def window(row: float, col: float, reach: int) -> tuple[slice, slice]:
    """The square of samples about a place, cut at the border of the level."""
    return tuple(slice(max(int(middle) - reach, 0), int(middle) + reach + 1) for middle in (row, col))


def stacks(x, y, rock, table: np.ndarray, seed: int, bed_seed: int) -> np.ndarray:
    """Sea stacks and skerries raised in `rock`: `table` rows are x, y, radius, height."""
    for index, (east, north, radius, tall) in enumerate(table):
        near = window(north, east, 45)
        px, py = x[near], y[near]
        wx, wy = warp(px, py, 16, 3.2, seed + index, 4)
        stretch = 0.7 + 0.12 * (index % 5)
        coast = radius - np.sqrt(np.square((wx - east) * stretch) + np.square((wy - north) / stretch))
        lean = tall * (1 + 0.018 * (px - east) - 0.014 * (py - north)) + 1.6 * fbm(px, py, 9, 3, seed + 50)
        u = 1 - np.clip(coast / (0.6 * radius), 0, 1)
        column = -1.5 + (lean + 1.5) * (1 - u * u * np.sqrt(u))
        column = column + (beds(column, px, py, bed_seed) - column) * 0.85
        apron = -1.5 + coast * 0.55 + 1.1 * fbm(px, py, 7, 3, seed + 51)
        rock[near] = np.maximum(rock[near], np.where(coast > 0, column, apron))
    return rock


def ribs(x, y, ground, table: np.ndarray, seed: int) -> np.ndarray:
    """Ledges of tilted beds that come through the sand, in parallel ribs with one steep side.

    `table` rows are x, y, half length, half width, height, direction (east, north parts of the way they run).
    """
    for index, (east, north, length, width, tall, along_east, along_north) in enumerate(table):
        near = window(north, east, 2 * int(max(length, width)))
        px, py, base = x[near], y[near], ground[near]
        dx, dy = warp(px - east, py - north, 24, 2.2, seed + index)
        along, across = dx * along_east + dy * along_north, dx * along_north - dy * along_east
        inside = (
            1 - np.sqrt(np.square(along / length) + np.square(across / width)) + 0.35 * fbm(px, py, 9, 3, seed + 20)
        )
        u = across / 5.2 + 0.5 * fbm(along, across * 0.4, 26, 3, seed + 21)
        part = u - np.floor(u)
        saw = np.where(part < 0.72, part / 0.72, (1 - part) / 0.28)
        worn = 0.7 + 0.7 * fbm(px, py, 7, 3, seed + 22)
        rib = base - 0.35 + tall * smoothstep(0, 0.45, inside) * (0.25 + 0.75 * saw) * worn
        ground[near] = np.where(inside > 0, np.maximum(base, rib), base)
    return ground


def bare_rock(ground, sand) -> np.ndarray:
    """0 … 1 where rock that is washed by the sea comes through the sand: platforms, ledges, boulders, reefs."""
    return smoothstep(0.06, 0.35, ground - sand) * smoothstep(7, 3, ground)


def boulders(height, places: np.ndarray, seed: int) -> np.ndarray:
    """Rocks half sunk where they lie: `places` rows are (x, y, radius, height) metres on a 1 m grid."""
    height = height.copy()
    rng = np.random.default_rng(seed)
    for x, y, radius, tall in places:
        angle, cuts, flat = rng.random(7) * 0.6, rng.random(7), rng.random(2)
        reach = int(radius * 1.6) + 2
        row, col = int(y), int(x)
        if not (reach < row < height.shape[0] - reach and reach < col < height.shape[1] - reach):
            continue
        patch = height[window(row, col, reach)]
        side = np.arange(-reach, reach + 1.0)
        dx, dy = (side[None, :] + (col - x)) / radius, (side[:, None] + (row - y)) / radius
        top = 1 + 0.5 * (flat[0] - 0.5) * dx + 0.5 * (flat[1] - 0.5) * dy  # broken off flat, a little aslant
        for face in range(7):  # and split along planes all round
            east, north = _heading((face + angle[face]) / 7)
            top = smooth_min(top, (1.05 - (east * dx + north * dy)) * (1.0 + 2.2 * cuts[face]), 0.12)
        foot = ndimage.minimum(patch) * 0.35 + float(patch[reach, reach]) * 0.65
        np.maximum(patch, np.where(top > -0.4, foot + tall * top, patch), out=patch)
    return height


def _heading(part: float) -> tuple[float, float]:
    """(east, north) of a part 0 … 1 of a turn, without sine: a point on a diamond, brought to unit length."""
    quarter, along = divmod(part * 4, 1)
    east, north = ((1 - along, along), (-along, 1 - along), (along - 1, -along), (along, along - 1))[int(quarter) % 4]
    length = np.sqrt(east * east + north * north)
    return east / length, north / length
