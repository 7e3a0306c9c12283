"""The cut through the shore that the Waves panel plots (D03)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level.section import ghosts, reach, section, way_of_front


def test_the_cut_runs_from_sea_to_land_across_the_contours():
    """D03: on a beach that rises to the north the cut runs north, A − B is the line at this moment."""
    level = make_beach(rows=257, slope=0.05)
    cut = section(level, 2.0, 80.0, 128.0, length_m=160.0, samples=161)
    assert np.allclose(cut.ground_m, cut.along_m * 0.05, atol=1e-3)
    assert cut.surface_m.min() >= cut.ground_m.min()
    assert np.all(cut.surface_m >= cut.ground_m)
    line = cut.a - cut.b
    assert line.max() == pytest.approx(1.0, abs=0.05)
    later = section(level, 3.0, 80.0, 128.0, length_m=160.0, samples=161)
    assert not np.array_equal(line, later.a - later.b)


def test_a_cut_on_flat_ground_is_defined():
    level = make_beach(slope=0.0)
    level.write("height", level.grid.rect, -3.0)
    assert np.isfinite(section(level, 0.0, 60.0, 60.0).surface_m).all()


def elliptic():
    """A bay whose contours are ellipses, deep in the middle of its southern border."""
    level = make_beach(rows=193, cols=257)
    north, east = np.mgrid[0:193, 0:257]
    radius = np.hypot((east - 128) / 1.6, north)
    level.write("height", level.grid.rect, ((radius - 110) * 0.06).astype(np.float32))
    return level


def test_the_cut_bends_with_the_way_of_the_front():
    """T06: across the contours everywhere, on both sides of the point, and so not straight where they turn."""
    level = elliptic()
    way = way_of_front(level, 200.0, 50.0, 100.0, 101)
    ahead = np.stack([np.gradient(way.x), np.gradient(way.y)], 1)
    uphill = np.stack([(way.x - 128) / 1.6**2, way.y], 1)
    cosine = np.sum(ahead * uphill, 1) / np.linalg.norm(ahead, axis=1) / np.linalg.norm(uphill, axis=1)
    assert cosine[10:-10].min() > np.cos(np.radians(12))
    headings = np.degrees(np.unwrap(np.arctan2(ahead[:, 0], ahead[:, 1])))
    assert np.ptp(headings) > 8
    assert np.allclose(np.hypot(*ahead.T), 1.0, atol=0.05)
    assert way.x[50] == pytest.approx(200.0)


def test_surfaces_before_and_after_lie_in_the_range_of_a_wave():
    """T06: the range is that of its moments; wide in the sea, nothing on dry land; the still sea has its tide."""
    level = make_beach(rows=193, cols=129, slope=0.05)
    level.set("tide.on", True)
    level.set("sea.on", False)
    way = way_of_front(level, 60.0, 80.0)
    times = 3.0 + np.arange(20) * 9.0 / 20
    level.set("tide.period_s", 1e6)
    low, high = reach(level, 3.0, 9.0, way)
    found = ghosts(level, times, way)
    assert np.array_equal(low, found.min(axis=0))
    assert np.array_equal(high, found.max(axis=0))
    assert (high - low)[way.y < 80].max() > 0.5
    assert (high - low)[way.y > 140].max() == 0
    cut = section(level, 3.0, 60.0, 80.0, way=way)
    assert cut.still_m == pytest.approx(0.8, abs=1e-3)
    assert np.allclose(cut.surface_m, ghosts(level, [3.0], way)[0], atol=1e-9)
