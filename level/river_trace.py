"""The way that water would take from a place to the sea, or into water that is there already: a new river (D13).

Cheapest way over a coarse grid, where going up costs much and the bottom of a valley is cheap: valleys are followed,
ridges crossed at their lowest.
"""

from __future__ import annotations

import math

import numpy as np

from .errors import BadInput
from .level import Level
from .objects import River
from .river_edit import Points, snapped
from .river_map import JOIN_M, river_map

MOST_SIDE = 193  # of the grid that is searched
UPHILL = 400.0  # metres of way that a metre up costs
VALLEY_CELLS = 6.0  # sigma of the ground that a place is compared with: lower than that is a valley (Weiss 2001)
CHEAPER = 1.5, 2.5  # power of e by which a standard deviation lower is cheaper, and the most
DEEP_M = 0.6  # the river ends where the sea is so deep
FEWEST_M = 0.35  # spacing of its points against its length, at most


def traced(level: Level, x: float, y: float, width_m: float = 8.0, speed_mps: float = 1.0) -> Points:
    """Points of a river from a world place down to the sea or other water, relative to it; from out at sea, from the
    land near by.

    BadInput where no sea is, or no land.
    """
    return begun(level, x, y, width_m, speed_mps)["points"]


def begun(level: Level, x: float, y: float, width_m: float = 8.0, speed_mps: float = 1.0) -> dict:
    """What a new River from a world place says: its points; where it runs into other water, no reach out to sea."""
    stride = max(1, math.ceil((max(level.grid.shape) - 1) / (MOST_SIDE - 1)))
    ground = level.height[::stride, ::stride].astype(np.float64) - level.mean_sea_m
    cell_m = level.grid.cell_m * stride
    row, col = (int(np.clip(round(v / cell_m), 0, n - 1)) for v, n in zip((y, x), ground.shape, strict=True))
    water = _water(level, ground, cell_m)
    inland = _inland(np.where(np.isnan(water), ground, np.maximum(ground, water)), (row, col))
    way = _cheapest(ground, cell_m, inland, water)
    at = np.stack([way[:, 1] * cell_m, way[:, 0] * cell_m], -1)
    if inland == (row, col):
        at[0] = x, y
    knots = _fewer(at, cell_m)
    points = tuple((float(px - x), float(py - y), width_m, 1e4, speed_mps) for px, py in np.round(knots, 2))
    points = snapped(level, River.model_construct(id="new", x=x, y=y, points=points, reach_m=0.0))
    joins_m = water[tuple(way[-1])] + level.mean_sea_m
    if np.isnan(joins_m):
        return {"points": points}
    joins_m = round(float(joins_m), 3)
    *before, last = ((*point[:3], max(point[3], joins_m), point[4]) for point in points)
    return {"points": (*before, (*last[:3], joins_m, last[4])), "reach_m": 0.0}


def _water(level: Level, ground: np.ndarray, cell_m: float) -> np.ndarray:
    """Level over the mean sea of the rivers and lakes that are there, m; NaN elsewhere and where the sea is over it."""
    made = river_map(level)
    if made is None:
        return np.full(ground.shape, np.nan)
    rows, cols = (np.minimum(np.rint(np.arange(n) * cell_m / made.cell_m).astype(int), most - 1)
                  for n, most in zip(ground.shape, made.owner.shape, strict=True))  # fmt: skip
    there = np.ix_(rows, cols)
    stage, wet = made.packed[..., 0][there].astype(np.float64), made.wet[there]
    return np.where(wet & (stage > JOIN_M) & (stage > ground), stage, np.nan)


def _inland(ground: np.ndarray, start: tuple[int, int]) -> tuple[int, int]:
    """The cell itself on land; else the one farthest from the sea, of those not much farther away than the shore."""
    from scipy.ndimage import distance_transform_edt

    if ground[start] >= 0:
        return start
    land = ground >= 0
    if not land.any():
        raise BadInput("this level has no land that a river could run over")
    row, col = np.indices(ground.shape)
    away = np.hypot(row - start[0], col - start[1])
    near = land & (away <= 2 * away[land].min() + 20)
    best = int(np.where(near, distance_transform_edt(land), -1).argmax())
    return tuple(int(v) for v in np.unravel_index(best, ground.shape))


def _cheapest(ground: np.ndarray, cell_m: float, start: tuple[int, int], water: np.ndarray) -> np.ndarray:
    """Cells `(n, 2)` from a start to the sea or into other water, but for that which it starts in."""
    from scipy import ndimage, sparse
    from scipy.sparse.csgraph import dijkstra

    parts, _ = ndimage.label(~np.isnan(water))
    other = (parts > 0) & (parts != parts[start])
    sea = (ground < -DEEP_M) & (parts == 0)
    if not (sea | other).any():
        raise BadInput("this level has no sea that a river could run to")
    over = ground - ndimage.gaussian_filter(ground, VALLEY_CELLS, mode="nearest")
    price = np.exp(np.clip(CHEAPER[0] * over / max(float(over[~sea].std()), 1e-9), -CHEAPER[1], CHEAPER[1]))
    number = np.arange(ground.size).reshape(ground.shape)
    rows, cols, costs = [], [], []
    for dr, dc in ((0, 1), (1, 0), (1, 1), (1, -1)):
        a = number[: ground.shape[0] - dr, max(-dc, 0) : ground.shape[1] - max(dc, 0)]
        b = number[dr:, max(dc, 0) : ground.shape[1] + min(dc, 0)]
        rise = ground.ravel()[b] - ground.ravel()[a]
        for first, second, up in ((a, b, rise), (b, a, -rise)):
            rows.append(first.ravel())
            cols.append(second.ravel())
            way_m = math.hypot(dr, dc) * cell_m * 0.5 * (price.ravel()[a] + price.ravel()[b])
            costs.append((way_m + UPHILL * np.maximum(up, 0)).ravel())
    graph = sparse.csr_matrix((np.concatenate(costs), (np.concatenate(rows), np.concatenate(cols))),
                              shape=(ground.size, ground.size))  # fmt: skip
    cost, before = dijkstra(graph, indices=int(number[start]), return_predecessors=True)
    end = int(np.where((sea | other).ravel(), cost, np.inf).argmin())
    cells = [end]
    while cells[-1] != number[start]:
        cells.append(int(before[cells[-1]]))
    return np.stack(np.unravel_index(cells[::-1], ground.shape), -1)


def _fewer(at: np.ndarray, cell_m: float) -> np.ndarray:
    """The line evened, with as few points as keep it within its valley."""
    from scipy.ndimage import gaussian_filter1d
    from shapely import LineString

    smooth = gaussian_filter1d(at, 2.5, axis=0, mode="nearest")
    smooth[0], smooth[-1] = at[0], at[-1]
    knots = np.array(LineString(smooth).simplify(0.7 * cell_m).coords)
    length = float(np.linalg.norm(np.diff(smooth, axis=0), axis=1).sum())
    most_m = max(FEWEST_M * length, 4 * cell_m)
    return np.array(LineString(knots).segmentize(most_m).coords)
