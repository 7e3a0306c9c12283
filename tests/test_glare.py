"""The sun's highlight turned out of the middle of the picture (D20)."""

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.renderer.offscreen import render

SIZE = (192, 108)
MOVED = {"glare.specular": 0.7, "glare.yaw_deg": 18.0, "glare.pitch_deg": 12.0}


@pytest.fixture
def against_the_sun():
    """Open water with the sun's mirror image in the middle of the picture."""
    level = coast(slope=0.0)
    level.write("height", level.grid.rect, -30.0)
    level.set("light.sun_azimuth_deg", 10.0)
    level.set("light.sun_elevation_deg", 50.0)
    return level


def glint(level, renderer):
    seen = camera(pitch=-50.0, yaw=10.0)
    return render(level, seen, SIZE, 3.0, "glint", linear=True, renderer=renderer).mean(axis=2)


def middle(light):
    rows, cols = light.shape
    return light[rows // 3 : -rows // 3, cols // 3 : -cols // 3].sum()


@pytest.mark.gl
def test_the_highlight_leaves_the_middle_and_does_not_vanish(against_the_sun, renderer):
    """D20: its energy in the middle third falls by 80 % and more, elsewhere some of it stays, right of and below it."""
    before = glint(against_the_sun, renderer)
    for name, value in MOVED.items():
        against_the_sun.set(name, value)
    after = glint(against_the_sun, renderer)
    assert middle(before) > 0.2 * before.sum()
    assert middle(after) < 0.2 * middle(before)
    assert after.sum() > 0.05 * before.sum()
    rows, cols = np.indices(after.shape)
    place = [np.average(axis, weights=after) - np.average(axis, weights=before) for axis in (rows, cols)]
    assert place[0] > 5  # row 0 is on top
    assert place[1] > 5


@pytest.mark.gl
def test_reflections_keep_the_true_surface(against_the_sun, renderer):
    """D20: only the highlight moves: with the sun behind the land's edge of the sky nothing changes."""
    against_the_sun.set("light.body", "even")
    seen = camera(pitch=-50.0, yaw=10.0)
    pictures = []
    for moved in ({}, MOVED):
        for name, value in moved.items():
            against_the_sun.set(name, value)
        pictures.append(render(against_the_sun, seen, SIZE, 3.0, linear=True, renderer=renderer))
    assert np.array_equal(*pictures)


@pytest.mark.gl
def test_the_quiet_middle_holds_the_highlight_down(against_the_sun, renderer):
    """D39: by place on the screen, only there."""
    before = glint(against_the_sun, renderer)
    against_the_sun.set("quiet.centre", 1.0)
    against_the_sun.set("quiet.highlight", 1.0)
    after = glint(against_the_sun, renderer)
    assert middle(after) < 0.3 * middle(before)
    assert np.allclose(before[:8], after[:8])
