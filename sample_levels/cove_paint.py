"""The paint of `cove.shore`: a modest patch in every layer of LAYERS, placed where the camera `play` looks."""

from __future__ import annotations

import numpy as np
from cove import RIVER, SHORE, SURFACE
from noise_ops import fbm, smoothstep, warp, worley
from scipy import ndimage
from scipy.interpolate import PchipInterpolator
from shorewright.level import Level, Rect
from shorewright.level.layers import WEATHER_GRID
from shorewright.level.objects import River
from shorewright.level.projection import divergence_free
from terrain_ops import Curve

MOUTH = Rect(360, 470, 508, 640)  # beach and river mouth: what `play` shows, and a margin
VALLEY = Rect(360, 460, 769, 770)  # the river from the edge of the level to the sea


def disc(x, y, east: float, north: float, radius: float, seed: int) -> np.ndarray:
    """1 inside a blot of about that radius, 0 outside, with a soft and uneven edge."""
    away = np.sqrt(np.square(x - east) + np.square(y - north)) + 0.3 * radius * fbm(x, y, radius, 3, seed)
    return smoothstep(radius, 0.6 * radius, away)


def bowl(x, y, east: float, north: float, radius: float) -> np.ndarray:
    """1 in the middle, 0 with no slope at the rim."""
    away = (np.square(x - east) + np.square(y - north)) / (radius * radius)
    return np.square(np.maximum(1 - away, 0))


def lay_stone(level: Level, stone: np.ndarray) -> None:
    """Paint bare rock as rock, in the tiles that have any: the rules take flat rock by the sea for sand."""
    for tile in level.grid.tiles(level.grid.rect):
        rect = level.grid.tile_rect(tile)
        if stone[rect.slices].max() > 0.02:
            cover = np.zeros((*rect.shape, 4))
            cover[..., 1] = 0.95 * stone[rect.slices]
            level.write("cover", rect, cover)


def paint(level: Level, maps: dict[str, np.ndarray], seed: int) -> None:
    """Write a patch to each layer; `maps` are those that `cove.height` returns."""
    rows, cols = level.grid.shape
    x, y = np.meshgrid(np.arange(cols, dtype=float), np.arange(rows, dtype=float))
    hollow = bowl(*at(MOUTH, x, y), 557, 450, 8) - 0.45 * bowl(*at(MOUTH, x, y), 565, 443, 7)
    level.write("height", MOUTH, level.height[MOUTH.slices] - 0.5 * hollow)
    river(level, {name: values[VALLEY.slices] for name, values in maps.items()}, *at(VALLEY, x, y), seed)
    lay_stone(level, maps["stone"])
    near = {name: values[MOUTH.slices] for name, values in maps.items()}
    beach(level, near, *at(MOUTH, x, y), seed)
    blots(level, near, *at(MOUTH, x, y), seed)
    sky(level, seed)


def creek() -> River:
    """The river as an object: its flow, and how it meets the sea; where its water stands is painted."""
    line = Curve(RIVER)
    mouth_m = float(line.arc[np.argmin(np.abs(Curve(SHORE).nearest(*line.points.T)[0]))])
    along = np.linspace(mouth_m - 330, mouth_m + 6, 9)
    places = np.stack([np.interp(along, line.arc, line.points[:, axis]) for axis in (0, 1)], axis=-1)
    past = along - mouth_m
    level_m = np.minimum.accumulate(np.maximum(PchipInterpolator(*SURFACE.T)(past), 0.0))
    width_m = 2 * (5.5 + 4.5 * smoothstep(-70, 0, past))
    first = np.round(places[0], 1)
    numbers = np.round(np.column_stack([places - first, width_m, level_m, np.ones(len(along))]), 2)
    points = tuple(tuple(float(v) for v in row) for row in numbers)
    return River(id="creek", x=float(first[0]), y=float(first[1]), points=points, depth_m=0.8)


def at(rect: Rect, *arrays: np.ndarray) -> list[np.ndarray]:
    return [array[rect.slices] for array in arrays]


def river(level: Level, near: dict, x, y, seed: int) -> None:
    """Surface, mask, current and foam of the river, from the edge of the level into the first metres of the sea."""
    past, aside = near["past_m"], near["river_m"]
    ground = level.height[VALLEY.slices]
    surface = PchipInterpolator(*SURFACE.T)(np.clip(past, -600, 80))
    depth = surface - ground
    mask = smoothstep(-0.02, 0.06, depth) * smoothstep(14, 9, np.abs(aside)) * smoothstep(24, -14, past)
    level.write("river_surface", VALLEY, surface)
    level.write("river_mask", VALLEY, mask)
    fall = np.clip(-np.gradient(surface, axis=0), 0, 1) + 0.02 * smoothstep(0.9, 0.2, depth)
    speed = mask * np.minimum(0.55 + 16 * fall, 1.9) * smoothstep(0.0, 0.5, depth)
    jet = smoothstep(16, 3, np.abs(aside)) * smoothstep(-20, 0, past) * smoothstep(58, 15, past)
    along = np.stack([near["river_east"], near["river_north"]], axis=-1)
    flow = along * (0.3 * speed + 0.2 * jet * (1 - mask))[..., None] + shore_drift(near, past)
    level.write("flow", VALLEY, coherent(flow, (depth > 0) & (mask >= 0.5) | (ground < 0)))
    calm = mask * smoothstep(0.55, 0.1, depth) * smoothstep(-0.1, 0.4, fbm(x, y, 13, 3, seed + 1))
    rough = mask * smoothstep(0.012, 0.035, fall) * (0.6 + 0.4 * fbm(x, y, 5, 3, seed + 2))
    level.write("river_foam", VALLEY, np.clip(np.stack([0.8 * calm, rough], axis=-1), 0, 1))


def shore_drift(near: dict, past: np.ndarray) -> np.ndarray:
    """A current along the beach towards the east, from the swash to the bar, held off by the river's mouth."""
    belt = smoothstep(6, -6, near["inland"]) * smoothstep(-62, -30, near["inland"])
    belt = belt * smoothstep(10, 32, np.abs(near["river_m"]))
    return 0.42 * belt[..., None] * np.stack([near["shore_east"], near["shore_north"]], axis=-1)


def coherent(flow: np.ndarray, wet: np.ndarray) -> np.ndarray:
    """`flow` without sources and sinks but where it fades out at sea, and none on land."""
    painted = ndimage.binary_dilation(np.abs(flow).max(-1) > 0.002, iterations=3)
    painted &= np.pad(np.ones(np.subtract(painted.shape, 4), bool), 2)  # still at the rim
    inside = ndimage.distance_transform_edt(wet & painted)
    fade = np.clip(inside / 8, 0, 1)[..., None]  # nothing starts or ends at once
    east, north = divergence_free(wet, *np.moveaxis(flow * fade, -1, 0), 1.0, painted)
    return np.round(np.stack([east, north], axis=-1) * 512) / 512


def beach(level: Level, near: dict, x, y, seed: int) -> None:
    """Painted sea foam, ground cover, and the masks that follow the beach."""
    inland, aside = near["inland"], np.abs(near["river_m"])
    streaks = smoothstep(-0.15, 0.35, fbm(x * 0.5, y, 12, 3, seed + 3))
    riding = 0.75 * streaks * smoothstep(4, -4, inland) * smoothstep(-40, -14, inland) * smoothstep(538, 552, x)
    froth = 0.85 * np.maximum(disc(x, y, 573, 422, 8, seed + 4), 0.7 * disc(x, y, 553, 403, 8, seed + 5))
    level.write("foam", MOUTH, np.stack([riding, froth], axis=-1))
    first, _, _ = worley(*warp(x, y, 12, 2.5, seed + 16), 5.0, seed + 6)
    tufts = smoothstep(0.55, 0.2, first) * smoothstep(34, 48, inland) * smoothstep(9, 15, aside)
    wet = smoothstep(11, 6, aside) * smoothstep(3, 12, inland)
    rock = 0.95 * near["stone"]
    level.write("cover", MOUTH, np.stack([np.zeros_like(x), rock, 0.9 * tufts, 0.7 * wet], axis=-1))
    level.write("yielding", MOUTH, smoothstep(2, 9, inland) * smoothstep(46, 34, inland) * smoothstep(16, 21, aside))
    level.write("quiet", MOUTH, disc(x, y, 551, 438, 13, seed + 8))
    stones = 0.8 * disc(x, y, 588, 424, 6, seed + 17) * smoothstep(1, 4, inland)
    logs = 0.7 * smoothstep(7, 10, inland) * smoothstep(17, 13, inland) * smoothstep(14, 20, aside)
    level.write("scatter", MOUTH, np.stack([stones, logs, 0.8 * tufts], axis=-1))


def blots(level: Level, near: dict, x, y, seed: int) -> None:
    """One soft blot each for the layers that no sample weather needs yet."""
    level.write("puddle_keepout", MOUTH, disc(x, y, 572, 441, 8, seed + 10))
    level.write("shelter", MOUTH, disc(x, y, 520, 452, 6, seed + 11))
    level.write("snow", MOUTH, 0.55 * disc(x, y, 557, 464, 6, seed + 12))
    level.write("ice", MOUTH, 0.8 * disc(x, y, 545, 473, 12, seed + 13) * smoothstep(12, 9, np.abs(near["river_m"])))
    level.write("mouth", MOUTH, 0.4 * disc(x, y, 533, 446, 9, seed + 15))
    level.write("corruption", MOUTH, disc(x, y, 528, 422, 12, seed + 14))


def sky(level: Level, seed: int) -> None:
    """Fair cumulus over the cove and out to sea, south-west; the grid's middle is the level's corner."""
    side, from_row, from_col = 96, 100, 104
    col, row = np.meshgrid(np.arange(side, dtype=float), np.arange(side, dtype=float))
    edge = smoothstep(
        48, 26, np.sqrt(np.square(row - 47.5) + np.square(col - 47.5)) + 9 * fbm(col, row, 40, 3, seed + 20)
    )
    clumps = smoothstep(-0.25, 0.75, fbm(col, row, 17, 4, seed + 21))
    weights = [0.9 * edge, 0.9 * edge, 0.9 * edge]
    values = np.stack([0.62 * clumps, 0 * edge, 0.7 + 0.3 * clumps, *weights], axis=-1) * (edge > 0)[..., None]
    rows, cols = WEATHER_GRID.shape
    for part_row in wrapped(from_row, side, rows):
        for part_col in wrapped(from_col, side, cols):
            (r, r0, r1), (c, c0, c1) = part_row, part_col
            level.write("weather", Rect(r, c, r + r1 - r0, c + c1 - c0), values[r0:r1, c0:c1])


def wrapped(start: int, count: int, period: int) -> list[tuple[int, int, int]]:
    """(start on the grid, first, one past last) of the pieces of a run that wraps."""
    start %= period
    first = min(count, period - start)
    return [(start, 0, first)] + ([(0, first, count)] if first < count else [])
