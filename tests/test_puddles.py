"""Where rain stays: hollows filled as by a flood from the lowest rims, with the sea, rivers and paint taken off."""

import heapq

import numpy as np
import pytest
from shorewright.level import Grid, Level, Rect
from shorewright.level.objects import River
from shorewright.level.puddles import filled_m, puddles_m


def flooded(ground: np.ndarray, leaves: np.ndarray) -> np.ndarray:
    """Cell by cell from the lowest place that water leaves by (Barnes, Lehman and Mulla 2014, algorithm 1)."""
    full, open_cells = np.where(leaves, ground, np.inf), []
    for row, col in np.argwhere(leaves):
        heapq.heappush(open_cells, (float(ground[row, col]), int(row), int(col)))
    while open_cells:
        level, row, col = heapq.heappop(open_cells)
        for r in range(max(row - 1, 0), min(row + 2, ground.shape[0])):
            for c in range(max(col - 1, 0), min(col + 2, ground.shape[1])):
                if full[r, c] == np.inf:
                    full[r, c] = max(level, float(ground[r, c]))
                    heapq.heappush(open_cells, (full[r, c], r, c))
    return full


@pytest.mark.parametrize("seed", range(4))
def test_hollows_are_filled_as_by_a_flood(seed):
    rng = np.random.default_rng(seed)
    ground = rng.normal(0, 1, (41, 57)).astype(np.float32)
    water = np.where(rng.random(ground.shape) < 0.01, ground, np.float32(np.nan))
    leaves = np.isfinite(water)
    leaves[[0, -1]] = leaves[:, [0, -1]] = True
    full = filled_m(ground, water)
    assert np.array_equal(full, flooded(ground, leaves).astype(np.float32))
    assert (full > ground).mean() > 0.2


def test_a_long_winding_way_out_is_found():
    """A spiral of walls: water runs round it as often as it has to."""
    side = 61
    ground, row, col, way = np.full((side, side), 9.0, np.float32), 0, 1, 0
    ground[row, col] = 0
    ways = ((1, 0), (0, 1), (-1, 0), (0, -1))
    while True:
        for _ in range(4):
            r, c = row + 2 * ways[way][0], col + 2 * ways[way][1]
            if 0 < r < side - 1 and 0 < c < side - 1 and ground[r, c] == 9:
                ground[row + ways[way][0], col + ways[way][1]] = ground[r, c] = 0
                row, col = r, c
                break
            way = (way + 1) % 4
        else:
            break
    assert (ground == 0).sum() > 1000
    assert np.array_equal(filled_m(ground, np.full_like(ground, np.nan)), ground)


def basin() -> Level:
    """A plain 5 m over the sea with a hollow of 2 m, and a pit that lies below the sea."""
    height = np.full((40, 60), 5.0, np.float32)
    height[10:20, 10:20] = 3.0
    height[25:35, 30:40] = -1.0
    return Level(Grid(40, 60), height)


def test_the_sea_is_no_puddle():
    depth = puddles_m(basin())
    assert depth[10:20, 10:20] == pytest.approx(2.0)
    assert (depth > 0).sum() == 100


def test_paint_keeps_puddles_out():
    level = basin()
    level.write("puddle_keepout", Rect(0, 0, 40, 15), np.float32(0.25))
    depth = puddles_m(level)
    assert depth[12, 12] == pytest.approx(1.5)
    assert depth[12, 17] == pytest.approx(2.0)


def test_a_river_carries_rain_away():
    level = basin()
    level.put_object("r", River(id="r", points=((0.0, 15.0, 4.0, 4.0, 1.0), (58.0, 15.0, 4.0, 3.5, 1.0))))
    depth = puddles_m(level)
    assert depth[15, 15] == 0
    assert depth[10:20, 10:20].max() < 1.0


def test_every_other_sample():
    assert np.array_equal(puddles_m(basin(), 2) > 0, puddles_m(basin())[::2, ::2] > 0)
