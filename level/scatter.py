"""Where scattered things stand (L09): fixed to the world, from the level's seed, tile by tile.

Each kind has a jittered grid of places over the world; a place is taken when its own random number is below what rule,
settings and paint make of the ground there. So a place depends on nothing but itself and the ground round it: a stroke
elsewhere, a neighbouring tile or another kind never moves it. Tiles are kept in `level.derived` and made again where
height, cover or the scatter layer changed.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .errors import BadInput
from .grid import Rect
from .level import Level
from .noise import lattice
from .params import get
from .pick import ground_at
from .scatter_kinds import SCATTER, Kind, Place
from .scatter_lie import stand
from .scatter_meshes import variants

TILE_M = 32.0
FOOT_M = (3.0, 8.0)  # rings on which the ground round a place is looked at
LOOK_M = 10.0  # so far a change of the ground is felt
TURNS = tuple((np.cos(a), np.sin(a)) for a in np.arange(8) * np.pi / 4)
LAYERS_READ = {"height": LOOK_M, "cover": 0.0, "scatter": 0.0}
SETTINGS_READ = ("level.seed", "level.sea_level_m", "ground.sand_top_m", "ground.rock_slope_deg",
                 "ground.grass_slope_deg", "ground.shingle", "shore.range_m", "shore.runup", "scatter.rocks",
                 "scatter.driftwood", "scatter.grass", "scatter.size")  # fmt: skip
FIELDS = ("x", "y", "z", "scale", "yaw", "normal_x", "normal_y", "tint", "open", "rank", "variant")
INSTANCE = np.dtype([(name, np.float32) for name in FIELDS])
EMPTY = np.empty(0, INSTANCE)


@dataclass
class Tiles:
    """Instances by kind and tile, what they were made of, and a count of the changes."""

    key: tuple = ()
    revision: int = 0
    changes: int = 0
    held: dict[tuple[str, int, int], np.ndarray] = field(default_factory=dict)
    ranges: dict[tuple[int, int], tuple[float, float]] = field(default_factory=dict)  # lowest and highest ground


def scatter_instances(level: Level, kind: str, rect: Rect | None = None) -> np.ndarray:
    """Everything of a kind on the level, or on the samples of `rect`: structured array INSTANCE.

    x, y, z metres (the foot); scale metres for the mesh's unit; yaw radians counter-clockwise from east; normal_x and
    normal_y of what it stands on, the third is what makes it unit length; tint, open (share of the sky that the land
    leaves), rank 0 … 1 (the lower, the later it is thinned out); variant, the number of its mesh.
    """
    if kind not in SCATTER:
        raise BadInput(f"nothing scattered is called {kind!r}; there are: {', '.join(SCATTER)}")
    east, north = level.grid.extent_m
    low, high = (0.0, 0.0), (east, north)
    if rect is not None:
        low, high = ((v * level.grid.cell_m for v in pair) for pair in ((rect.col0, rect.row0), (rect.col1, rect.row1)))
        low, high = tuple(low), tuple(high)
    found = np.concatenate([EMPTY, *scatter_tiles(level, kind, tiles_within(level, *low, *high)).values()])
    inside = (found["x"] >= low[0]) & (found["y"] >= low[1]) & (found["x"] <= high[0]) & (found["y"] <= high[1])
    return found[inside]


def tiles_within(level: Level, west: float, south: float, east: float, north: float) -> list[tuple[int, int]]:
    """Tiles (column, row) that touch an area in metres, held to the level."""
    last = [int(extent // TILE_M) for extent in level.grid.extent_m]
    cols, rows = (
        range(max(int(np.floor(low / TILE_M)), 0), min(int(np.floor(high / TILE_M)), most) + 1)
        for low, high, most in ((west, east, last[0]), (south, north, last[1]))
    )
    return [(col, row) for row in rows for col in cols]


def scatter_tiles(level: Level, kind: str, tiles: list[tuple[int, int]]) -> dict[tuple[int, int], np.ndarray]:
    """Instances of a kind by tile; those not made yet are made together."""
    held = sync(level).held
    missing = [tile for tile in tiles if (kind, *tile) not in held]
    if missing:
        for tile, found in zip(missing, _make(level, SCATTER[kind], missing), strict=True):
            held[kind, *tile] = found
    return {tile: held[kind, *tile] for tile in tiles}


def sync(level: Level) -> Tiles:
    """The level's tiles, without those that a change has touched."""
    s = level.settings
    key = tuple(get(s, path) for path in SETTINGS_READ)
    tiles: Tiles = level.derived.setdefault("scatter", Tiles())
    if tiles.key != key:
        tiles.held.clear()
        tiles.ranges.clear()
        tiles.key, tiles.changes = key, tiles.changes + 1
    elif tiles.revision != level.revision:
        longest = max(kind.size_m[1] for kind in SCATTER.values() if kind.along_contour) * s.scatter.size
        for layer, reach_m in LAYERS_READ.items():
            reach_m = max(reach_m, longest / 2) if layer == "height" else reach_m
            for rect in level.changed_since(layer, tiles.revision):
                _drop(level, tiles, rect, reach_m)
    tiles.revision = level.revision
    return tiles


def _drop(level: Level, tiles: Tiles, rect: Rect, reach_m: float) -> None:
    cell_m = level.grid.cell_m
    reach_m += 2 * cell_m  # gradients look at the neighbours
    touched = set(tiles_within(level, rect.col0 * cell_m - reach_m, rect.row0 * cell_m - reach_m,
                               rect.col1 * cell_m + reach_m, rect.row1 * cell_m + reach_m))  # fmt: skip
    for tile in touched & tiles.ranges.keys():  # what was out of sight may come into it
        del tiles.ranges[tile]
        tiles.changes += 1
    for known in [known for known in tiles.held if known[1:] in touched]:
        del tiles.held[known]
        tiles.changes += 1


def tile_ranges(level: Level, tiles: list[tuple[int, int]]) -> np.ndarray:
    """Lowest and highest ground of tiles, `(n, 2)` metres."""
    known, cells = sync(level).ranges, TILE_M / level.grid.cell_m
    for col, row in tiles:
        if (col, row) not in known:
            ground = level.height[int(row * cells) : int((row + 1) * cells) + 2,
                                  int(col * cells) : int((col + 1) * cells) + 2]  # fmt: skip
            known[col, row] = (float(ground.min()), float(ground.max())) if ground.size else (np.inf, -np.inf)
    return np.array([known[tile] for tile in tiles]).reshape(-1, 2)


def chance(col: np.ndarray, row: np.ndarray, salt: int) -> np.ndarray:
    """A random number 0 … 1 of each place of a grid (the finaliser of MurmurHash3, A. Appleby)."""
    h = col.astype(np.uint32) * np.uint32(0x9E3779B1) ^ row.astype(np.uint32) * np.uint32(0x85EBCA77)
    h ^= np.uint32(salt & 0xFFFFFFFF)
    for shift, factor in ((16, 0x85EBCA6B), (13, 0xC2B2AE35)):
        h ^= h >> np.uint32(shift)
        h *= np.uint32(factor)
    h ^= h >> np.uint32(16)
    return (h >> np.uint32(8)).astype(np.float64) / 2.0**24


def _make(level: Level, kind: Kind, tiles: list[tuple[int, int]]) -> list[np.ndarray]:
    """Instances of a kind, one array a tile."""
    side = max(round(TILE_M / kind.spacing_m), 1)
    spacing = TILE_M / side
    corner = np.array(tiles, np.int64) * side
    step = np.arange(side)
    col = np.broadcast_to(corner[:, 0, None, None] + step, (len(tiles), side, side)).ravel()
    row = np.broadcast_to(corner[:, 1, None, None] + step[:, None], (len(tiles), side, side)).ravel()
    salt = kind.salt + 7919 * level.settings.level.seed

    def drawn(number: int) -> np.ndarray:
        return chance(col, row, salt + 0x51ED270B * number)

    x, y = (col + drawn(0)) * spacing, (row + drawn(1)) * spacing
    place, gradient = _look(level, x, y, kind)
    east, north = level.grid.extent_m
    taken = (drawn(2) < density(kind, place)) & (x <= east) & (y <= north)
    col, row = col[taken], row[taken]
    found = np.zeros(len(col), INSTANCE)
    low, high = kind.size_m
    # large ones are rare: sizes grow with a power of an even random number
    share = np.float64(drawn(3)) ** kind.skew
    found["x"], found["y"], found["tint"], found["rank"] = x[taken], y[taken], drawn(6), drawn(7)
    found["variant"] = np.floor(drawn(8) * variants(kind.mesh))
    found["open"] = _open(level, x[taken], y[taken], gradient[:, taken])
    size = level.settings.scatter.size
    stand(level, kind, found, (low + (high - low) * share) * size, gradient[:, taken], drawn(4), drawn(5))
    ends = np.searchsorted(np.flatnonzero(taken), np.arange(1, len(tiles)) * side * side)
    return [part[part["scale"] > 0] for part in np.split(found, ends)]


def density(kind: Kind, place: Place) -> np.ndarray:
    """Share of places that are taken: the rule times the setting, then paint from none (−1) to full (1).

    Where a rule already takes every place, more can only stand in the gaps: rules widen their clumps by the amount.
    """
    amount = place.amount
    channels = ("rocks", "driftwood", "grass")
    paint = place.paint[:, channels.index(kind.channel)]
    ruled = np.clip(kind.rule(place) * amount, 0.0, 1.0)
    more = np.maximum(paint, 0.0) * kind.allowed(place)
    return (ruled + (np.maximum(kind.full, ruled) - ruled) * more) * (1 + np.minimum(paint, 0.0))


def _look(level: Level, x: np.ndarray, y: np.ndarray, kind: Kind) -> tuple[Place, np.ndarray]:
    """What a rule knows of some places; their gradient `(2, n)`."""
    cell_m = level.grid.cell_m
    z = ground_at(level, x, y)
    gradient = np.stack([ground_at(level, x + cell_m, y) - ground_at(level, x - cell_m, y),
                         ground_at(level, x, y + cell_m) - ground_at(level, x, y - cell_m)]) / (2 * cell_m)  # fmt: skip
    slope = np.sqrt(gradient[0] ** 2 + gradient[1] ** 2)
    foot = np.zeros(len(x))
    if kind.channel == "rocks":
        for radius in FOOT_M:
            for east, north in TURNS:
                foot = np.maximum(foot, (_nearest(level, x + radius * east, y + radius * north) - z) / radius)
    paint, cover = (_layer(level, name, x, y) for name in ("scatter", "cover"))
    place = Place(x, y, z - level.mean_sea_m, slope, np.maximum(foot - slope, 0.0), cover, paint, level.settings,
                  lattice(level.settings.level.seed), getattr(level.settings.scatter, kind.channel))  # fmt: skip
    return place, gradient


def _open(level: Level, x: np.ndarray, y: np.ndarray, gradient: np.ndarray) -> np.ndarray:
    """Share of the sky that the land leaves open: what passes/openness.py maps, roughly, from two near rings."""
    z, hidden = _nearest(level, x, y), np.zeros(len(x))
    for radius in FOOT_M:
        for east, north in TURNS[::2]:
            there = _nearest(level, x + radius * east, y + radius * north)
            rise = np.maximum((there - z) / radius - gradient[0] * east - gradient[1] * north, 0.0)
            hidden += rise * rise / (1 + rise * rise)
    return np.clip(1 - 0.2 * hidden, 0.3, 1.0)


def _nearest(level: Level, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    rows, cols = level.grid.shape
    col = np.clip(np.floor(x / level.grid.cell_m + 0.5), 0, cols - 1).astype(np.int64)
    row = np.clip(np.floor(y / level.grid.cell_m + 0.5), 0, rows - 1).astype(np.int64)
    return level.height[row, col].astype(np.float64)


def _layer(level: Level, name: str, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """A painted layer at world points, bilinear, `(n, channels)`."""
    data = level.layers[name]
    if data.neutral and not level.live:
        return np.zeros((len(x), len(data.row.channels)))
    rows, cols = data.grid.shape
    u, v = np.clip(x / data.grid.cell_m, 0, cols - 1), np.clip(y / data.grid.cell_m, 0, rows - 1)
    col, row = np.minimum(u.astype(np.int64), cols - 2), np.minimum(v.astype(np.int64), rows - 2)
    fu, fv = (u - col)[:, None], (v - row)[:, None]
    values = data.read(data.grid.rect)
    south = values[row, col] * (1 - fu) + values[row, col + 1] * fu
    north = values[row + 1, col] * (1 - fu) + values[row + 1, col + 1] * fu
    return south * (1 - fv) + north * fv
