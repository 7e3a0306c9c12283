"""Loops of the clock without a seam, and scrubbing (T05)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level.framing import cameras
from shorewright.level.loop import loop_changes, looped
from shorewright.level.waves import sea_at
from shorewright.renderer.offscreen import render

SIZE = (96, 64)


@pytest.fixture
def level():
    made = make_beach(rows=129, cols=161, slope=0.05)
    for camera in cameras(made):
        made.put_object(camera.id, camera)
    return made


def test_a_period_becomes_the_nearest_divisor():
    """T05: without a loop it stays as it is, bit by bit."""
    assert looped(7.3, 0.0) == 7.3
    assert looped(7.0, 20.0) == pytest.approx(20 / 3)
    assert looped(50.0, 20.0) == 20.0
    for period in np.linspace(0.3, 40, 50):
        assert 20 / looped(period, 20.0) == pytest.approx(round(20 / looped(period, 20.0)))


def test_the_table_says_how_far_each_period_moved(level):
    """T05: one row a period; all of them divide the loop."""
    assert all(row.percent == 0 for row in loop_changes(level))
    level.set("time.loop_s", 24.0)
    rows = {row.name: row for row in loop_changes(level)}
    assert rows["shore waves"].new_s == pytest.approx(8.0)
    assert rows["shore waves"].percent == pytest.approx(100 * (8 / 9 - 1))
    assert {"chop front 5", "swell front 3", "whitecaps", "foam that moves"} <= set(rows)
    for row in rows.values():
        assert 24 / row.new_s == pytest.approx(round(24 / row.new_s))
    level.set("tide.on", True)
    assert loop_changes(level)[-1].new_s == 0.0  # a tide longer than the loop stands still


def test_the_sea_comes_round_without_a_seam(level):
    """T05: just before the end it is as just before the start; without the loop it isn't."""
    level.set("time.loop_s", 20.0)
    level.set("shore.runup_variety", 0.5)
    x, y = np.meshgrid(np.linspace(5, 150, 30), np.linspace(5, 120, 40))
    before, after = sea_at(level, 20.0 - 1e-6, x, y), sea_at(level, 20.0, x, y)
    assert np.abs(before.height_m - after.height_m).max() < 2e-3
    moved = sea_at(level, 19.5, x, y)
    assert np.abs(moved.height_m - after.height_m).max() > 0.05
    level.set("time.loop_s", 0.0)
    assert np.abs(sea_at(level, 20.0, x, y).height_m - sea_at(level, 0.0, x, y).height_m).max() > 0.05


def test_first_and_last_frame_are_the_same_bytes(level):
    """T05: at t and t + loop_s."""
    level.set("time.loop_s", 20.0)
    first, last = (render(level, "play", SIZE, t, quality="low") for t in (6.5, 26.5))
    other = render(level, "play", SIZE, 16.5, quality="low")
    assert np.array_equal(first, last)
    assert not np.array_equal(first, other)


def test_a_moment_is_the_same_from_either_side(renderer, level):
    """T05: scrubbing forth and back to a time draws the same bytes."""
    camera = level.camera("play")
    pictures = {}
    for t in (4.0, 5.0, 6.0, 5.0, 9.0, 5.0):
        renderer.draw(level, camera, SIZE, t, quality="low")
        pictures.setdefault(t, []).append(renderer.read())
    assert all(np.array_equal(picture, pictures[5.0][0]) for picture in pictures[5.0])
    assert not np.array_equal(pictures[4.0][0], pictures[6.0][0])
