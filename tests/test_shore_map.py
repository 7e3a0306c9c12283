"""The derived bed map: strides, live windows, seeds, and that a settled map depends on the level alone (D03, T05)."""

import heapq

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level import Grid, Journal, Level, Rect
from shorewright.level.bottleneck import bottleneck
from shorewright.level.objects import SeaSeed
from shorewright.level.shore import MOST_SIDE, shore_map


def sculpt(level, journal, rect, by, commit=True):
    step = journal.begin("Raise")
    data = level.layers["height"]
    step.save(data, rect)
    data.array[rect.slices] += by
    level.mark("height", rect)
    if commit:
        journal.commit()


def test_the_map_is_cached_until_something_changes():
    level = make_beach()
    assert shore_map(level) is shore_map(level)
    first = shore_map(level)
    level.set("light.exposure_ev", 12.0)
    assert shore_map(level) is first
    level.set("shore.smooth_m", 5.0)
    assert shore_map(level) is not first
    level.set("shore.runup", 0.0)
    first = shore_map(level)
    level.set("shore.range_m", 3.0)  # it decides which part of the border is deep, run-up or not
    assert shore_map(level) is not first


@pytest.mark.parametrize("seed", range(4))
def test_the_bottleneck_is_the_best_of_all_ways(seed):
    """D03: against a search from the sea outward, the deepest first, on ground as rough as it can be."""
    depth = np.random.default_rng(seed).normal(0, 5, (23, 31)).astype(np.float32)
    marker = np.full(depth.shape, -np.inf, np.float32)
    marker[0] = depth[0]
    expected = np.full(depth.shape, -np.inf, np.float32)
    waiting = [(-value, 0, col) for col, value in enumerate(depth[0])]
    heapq.heapify(waiting)
    while waiting:
        value, row, col = heapq.heappop(waiting)
        if -value <= expected[row, col]:
            continue
        expected[row, col] = -value
        for r in range(max(row - 1, 0), min(row + 2, 23)):
            for c in range(max(col - 1, 0), min(col + 2, 31)):
                heapq.heappush(waiting, (max(value, -depth[r, c]), r, c))
    assert np.array_equal(bottleneck(marker, depth), expected)


def test_live_window_matches_the_whole_map_where_it_was_worked_out():
    """T14 in small: during a stroke only the window is made again, and where the change stays local it is right."""
    level = make_beach(rows=401, cols=401, slope=0.04)
    journal = Journal(level)
    before = shore_map(level)
    at = before.revision
    sculpt(level, journal, Rect(150, 190, 160, 205), 0.2, commit=False)
    live = shore_map(level)
    assert not live.whole
    rects = live.changed_since(at)
    assert len(rects) == 1
    assert rects[0].cells < 401 * 401 / 8
    patch = live.packed.copy()
    journal.commit()
    settled = shore_map(level)
    assert settled.whole
    assert np.abs(patch[..., 1] - settled.packed[..., 1]).max() == 0
    assert np.abs(patch[..., 0] - settled.packed[..., 0]).max() < 0.05


def test_undo_brings_back_the_same_map():
    """T05: a settled picture depends on the level alone, however it was reached."""
    level = make_beach(rows=300, cols=200, slope=0.04, rough_m=0.1)
    journal = Journal(level)
    before = shore_map(level).packed.copy()
    sculpt(level, journal, Rect(100, 50, 140, 90), 1.5)
    assert not np.array_equal(shore_map(level).packed, before)
    journal.undo()
    assert np.array_equal(shore_map(level).packed, before)


def test_a_large_level_is_read_with_a_stride():
    level = Level(Grid(2100, 1100), np.full((2100, 1100), -5, np.float32))
    packed = shore_map(level).packed
    assert max(packed.shape[:2]) <= MOST_SIDE
    assert shore_map(level).cell_m == 3.0
    assert np.all(packed[..., 2] == 1)


def test_a_seed_makes_a_lagoon_sea():
    """A point the artist marks counts as sea (design: seed point)."""
    level = make_beach(rows=257, slope=0.05)
    rows, cols = np.mgrid[0:257, 0:161]
    level.write("height", level.grid.rect, np.where(np.hypot(rows - 190, cols - 80) < 20, -2.0, level.height))
    assert shore_map(level).at(80.0, 190.0)["sea"].v == 0
    level.put_object("lagoon", SeaSeed(id="lagoon", x=80, y=190))
    assert shore_map(level).at(80.0, 190.0)["sea"].v == 1


@pytest.mark.parametrize("height", [-30.0, 30.0])
def test_all_sea_and_all_land_are_fine(height):
    level = make_beach(slope=0.0)
    level.write("height", level.grid.rect, height)
    packed = shore_map(level).packed
    assert np.isfinite(packed).all()
    assert np.all(packed[..., 2] == (1.0 if height < 0 else 0.0))


def test_outside_the_level_the_bed_is_continued():
    level = make_beach()
    inside, outside = shore_map(level).at(80.0, 0.0), shore_map(level).at(80.0, -500.0)
    assert outside["depth"].v == inside["depth"].v
    assert outside["depth"].dy == 0


def test_a_steep_bank_wears_no_teeth():
    """D03: wherever the swash can come on a bank of 50°, between the cells too, it is sea; a hollow stays dry."""
    y, x = np.mgrid[0:65, 0:97].astype(np.float32)
    slope = 1.2 * (0.8 * (x - 30) + 0.6 * (y - 30))
    height = np.minimum(slope, 6.0)
    height[20:40, 70:90] = -1.0
    level = Level(Grid(65, 97), height.astype(np.float32))
    rng = np.random.default_rng(3)
    px, py = rng.uniform(5, 60, 20_000), rng.uniform(5, 60, 20_000)
    bed = shore_map(level).at(px, py)
    top = level.settings.shore.range_m * level.settings.shore.runup
    touched = (bed["depth"].v > -top) & (px < 60)
    assert touched.sum() > 1000
    assert (bed["sea"].v[touched] == 1).all()
    assert (shore_map(level).packed[19:41, 69:91, 2] == 0).all()
