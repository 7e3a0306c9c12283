"""The ramp (D31): first click to mouse-up sets a grade, previewed while dragging, with the front speed it will give."""

import numpy as np
import pytest
from shorewright.brushes import BRUSHES, Stroke
from shorewright.level import Grid, Journal, Level
from test_strokes import play, rough_level, start, state


def test_the_grade_is_straight_between_press_and_release():
    level = rough_level()
    ground = level.height.copy()
    play(start(level, "ramp", size_m=20), [(60, 50), (120, 200), (90, 180)])
    low, high = ground[50, 60], ground[180, 90]
    way = np.hypot(30, 130)
    rows, cols = np.mgrid[:260, :240]
    along = ((cols - 60) * 30 + (rows - 50) * 130) / way
    across = ((cols - 60) * 130 - (rows - 50) * 30) / way
    core = (np.abs(across) < 9.9) & (along > 0) & (along < way)
    np.testing.assert_allclose(level.height[core], (low + (high - low) * along / way)[core], atol=1e-4)
    assert np.array_equal(level.height[np.abs(across) > 20], ground[np.abs(across) > 20])
    assert np.array_equal(level.height[(along < -10) | (along > way + 10)], ground[(along < -10) | (along > way + 10)])


def test_each_move_shows_the_ramp_to_the_pointer_and_nothing_of_the_last():
    level = rough_level()
    stroke = start(level, "ramp")
    stroke.begin(60, 50)
    for end in [(200, 220), (30, 20), (90, 180)]:
        stroke.move(*end)
        direct = rough_level()
        other = start(direct, "ramp")
        other.begin(60, 50)
        other.move(*end)
        assert level.height.tobytes() == direct.height.tobytes()
    assert stroke.samples == [(60, 50, 1), (90, 180, 1)]


def test_a_pen_draws_the_same_ramp():
    """A pen touches down and lifts lightly; that must not blur the ends."""
    pen, mouse = rough_level(), rough_level()
    play(start(pen, "ramp"), [(60, 50, 0.02), (90, 180, 0.4)])
    play(start(mouse, "ramp"), [(60, 50), (90, 180)])
    assert pen.height.tobytes() == mouse.height.tobytes()


def test_it_is_one_step_that_keeps_only_tiles_it_changed():
    level = rough_level()
    journal = Journal(level)
    play(start(level, "ramp", journal), [(20, 20), (230, 240), (60, 30)])
    assert [step.label for step in journal.done] == ["Ramp"]
    assert level.layers["height"].written.sum() == 1
    journal.undo()
    assert state(level) == state(rough_level())


@pytest.mark.parametrize("points", [[(50, 60)], [(50, 60), (50, 60)], [(50, 60), (190, 90), (50.1, 60)]])
def test_a_ramp_of_no_length_is_nothing(points):
    level = rough_level()
    journal = Journal(level)
    stroke = start(level, "ramp", journal)
    stroke.begin(*points[0])
    for point in points[1:]:
        stroke.move(*point)
    assert stroke.preview() is None
    assert stroke.end().empty
    assert not journal.done
    assert state(level) == state(rough_level())


@pytest.mark.parametrize("cell_m", [1.0, 2.5])
def test_the_preview_tells_the_front_speed(cell_m):
    """D03: shore.range_m · (1 + runup) / (interval_s · count · slope)."""
    y, _ = np.mgrid[:200, :150]
    level = Level(Grid(200, 150, cell_m), (y * cell_m * 0.05 - 4).astype(np.float32))
    stroke = start(level, "ramp")
    stroke.begin(70 * cell_m, 40 * cell_m)
    assert stroke.preview() is None
    stroke.move(70 * cell_m, 140 * cell_m)
    told = stroke.preview()
    shore = level.settings.shore
    assert told["start"] == (70 * cell_m, 40 * cell_m)
    assert told["end"] == (70 * cell_m, 140 * cell_m)
    assert told["heights"] == pytest.approx((2 * cell_m - 4, 7 * cell_m - 4), abs=1e-5)
    assert told["length_m"] == pytest.approx(100 * cell_m)
    assert told["grade"] == pytest.approx(0.05, rel=1e-5)
    speed = shore.range_m * (1 + shore.runup) / (shore.interval_s * shore.count * 0.05)
    assert told["front_speed_mps"] == pytest.approx(speed, rel=1e-5)
    stroke.move(140 * cell_m, 40 * cell_m)
    assert stroke.preview()["grade"] == 0
    assert stroke.preview()["front_speed_mps"] is None
    stroke.abort()
    assert stroke.preview() is None


def test_a_ramp_along_a_slope_that_is_right_changes_nothing():
    """Its ends lead over to the ground: no bump beyond them."""
    y, _ = np.mgrid[:200, :150].astype(np.float32)
    slope = y * 0.0625 - 4
    level = Level(Grid(200, 150), slope)
    play(start(level, "ramp", size_m=30, falloff=0.8), [(75, 60), (75, 150)])
    np.testing.assert_allclose(level.height, slope, atol=1e-5)


@pytest.mark.parametrize(("side", "sign"), [("both", -1), ("cut", 1), ("fill", -1)])
def test_turned_round_it_works_on_one_side(side, sign):
    level = rough_level()
    before = level.height.copy()
    play(start(level, "ramp", invert=True, side=side), [(40, 60), (180, 200)])
    change = (level.height - before) * sign
    assert (change >= 0).all()
    assert (change > 0.5).any()


def test_it_may_begin_and_end_past_the_border():
    level = rough_level()
    ground = level.height.copy()
    play(start(level, "ramp", size_m=12), [(-30, 100), (270, 100)])
    expected = ground[100, 0] + (ground[100, -1] - ground[100, 0]) * (np.arange(240) + 30) / 300
    np.testing.assert_allclose(level.height[100], expected, atol=1e-4)


def test_a_long_narrow_ramp_saves_few_tiles():
    """The preview costs the corridor, not its bounding box."""
    level = Level(Grid(2100, 2100), np.zeros((2100, 2100), np.float32))
    level.write("height", level.grid.rect, np.add.outer(np.arange(2100), np.zeros(2100)) * 0.01)
    stroke = start(level, "ramp", size_m=10)
    stroke.begin(20, 20)
    stroke.move(2080, 2000)
    assert len(stroke.step.snapshots["height"]) < 60


def test_brushes_row_serves_the_line_path_too():
    """Effect × footprint × path are independent: raise along a line."""
    from dataclasses import replace

    from shorewright.brushes.footprint import Strip
    from shorewright.brushes.path import LinePath

    level = Level(Grid(120, 130), np.zeros((120, 130), np.float32))
    wall = replace(BRUSHES["raise"], name="wall", footprint=Strip, path=LinePath)
    stroke = Stroke(level, Journal(level), wall, wall.with_params({"size_m": 6, "strength": 3}))
    stroke.begin(20, 20)
    stroke.move(100, 100)
    stroke.move(100, 20)
    stroke.end()
    assert level.height[20, 30:90] == pytest.approx(3)
    assert not level.height[60:].any()
