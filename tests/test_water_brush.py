"""Water painted by a brush at any height (D13)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.brushes import BRUSHES, Stroke
from shorewright.level import Journal
from shorewright.level.river_flow import river_flow
from shorewright.level.river_map import river_map
from test_strokes import play, play_again, state


def valley():
    """A bowl 2 m deep about (60, 110) and a ditch that falls 1 in 30 to the south along x 90, in ground at 8 m."""
    level = make_beach(rows=161, cols=121)
    y, x = np.mgrid[:161, :121].astype(float)
    bowl = 8 - 2 * np.maximum(1 - (np.square(x - 60) + np.square(y - 110)) / 400, 0)
    ditch = np.where(np.abs(x - 90) < 5, 4 + (y - 80) / 30 + np.square(x - 90) / 25, 8.0)
    level.write("height", level.grid.rect, np.where(y > 75, np.minimum(bowl, ditch), level.height))
    return level


def paint(level, *points, invert=False, journal=None, **params):
    stroke = Stroke(level, journal or Journal(level), BRUSHES["water"], BRUSHES["water"].with_params(params), invert)
    play(stroke, points)
    return stroke


def water(level):
    """(mask, surface) of the level."""
    return level.layers["river_mask"].array, level.layers["river_surface"].array


def test_a_lake_is_level_and_stays_under_its_shore():
    level = valley()
    paint(level, (60, 110), (66, 112), (54, 106), size_m=30, depth_m=1.0)
    mask, surface = water(level)
    wet = mask > 0
    level_m = float(level.height[110, 60]) + 1.0
    assert wet.sum() > 400
    assert np.unique(mask).tolist() == [0.0, 1.0]
    assert surface[wet] == pytest.approx(level_m)
    assert (level.height[wet] < level_m).all()
    assert river_map(level).packed[110, 60, 0] + level.mean_sea_m == pytest.approx(level_m, abs=1e-3)


def test_a_stream_goes_down_with_its_bed_and_runs():
    """Each place has the level of its own part of the stroke; the water then runs by itself."""
    level = valley()
    paint(level, (90, 150), (90, 120), (90, 90), size_m=5, depth_m=0.5, mode="follow")
    mask, surface = water(level)
    rows = np.arange(95, 146)
    assert (mask[rows, 90] == 1).all()
    assert surface[rows, 90] == pytest.approx(level.height[rows, 90] + 0.5, abs=0.05)
    assert (np.diff(surface[rows, 90]) > -1e-6).all()
    south = river_flow(level).velocity[..., 1]
    assert south[south != 0].mean() < -0.2


def test_a_stream_never_runs_uphill():
    level = valley()
    paint(level, (90, 100), (90, 140), size_m=5, depth_m=0.5, mode="follow")
    mask, surface = water(level)
    assert np.ptp(surface[mask > 0]) < 1e-6


def test_other_water_keeps_its_level_and_the_press_takes_it():
    level = valley()
    paint(level, (60, 110), size_m=8, depth_m=1.0)
    found = level.layers["river_surface"].array[110, 60]
    paint(level, (60, 110), (60, 118), size_m=8, depth_m=3.0)  # begun in the lake
    mask, surface = water(level)
    assert surface[mask > 0] == pytest.approx(found)
    paint(level, (60, 132), (60, 100), size_m=8, depth_m=3.0)  # across it, from higher ground
    assert level.layers["river_surface"].array[112, 60] == found


def test_ctrl_dries_it_out():
    level = valley()
    paint(level, (60, 110), size_m=12, depth_m=1.0)
    paint(level, (60, 110), size_m=40, invert=True)
    assert not water(level)[0].any()


@pytest.mark.parametrize("invert", [False, True])
def test_a_stroke_is_one_step_and_replays(invert):
    level = valley()
    paint(level, (60, 110), size_m=6, depth_m=1.0)
    journal, before = Journal(level), state(level)
    stroke = paint(level, (60, 100), (60, 120), journal=journal, size_m=9, depth_m=0.7, mode="follow", invert=invert)
    after = state(level)
    assert after != before
    assert len(journal.done) == 1
    journal.undo()
    assert state(level) == before
    play_again(level, Journal(level), stroke)
    assert state(level) == after
