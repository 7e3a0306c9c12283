"""The sun's highlight turned out of the middle of the picture (D20)."""

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.level import Rect
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


@pytest.mark.gl
def test_the_painted_quiet_area_holds_the_highlight_down(against_the_sun, renderer):
    """D39: on the paint by its strength, beside it not at all; in the picture as in the view."""
    level, seen = against_the_sun, camera(pitch=-50.0, yaw=10.0)
    for name in ("foam.shore", "quiet.foam", "quiet.flow"):
        level.set(name, 0.0)

    def lit():
        return render(level, seen, SIZE, 3.0, "hdr", linear=True, renderer=renderer).mean(axis=2)

    before, lit_before = glint(level, renderer), lit()
    place = render(level, seen, SIZE, 3.0, "position", linear=True, renderer=renderer)
    border_m = float(np.median(place[before > 0.3 * before.max()][:, 0]))
    level.write("quiet", Rect(0, 0, level.grid.rows, round(border_m)), 1.0)
    level.set("quiet.highlight", 0.75)
    after = glint(level, renderer)
    painted, free = place[..., 0] < border_m - 2, place[..., 0] > border_m + 2
    shining = before > 0.05 * before.max()
    assert (shining & painted).sum() > 50
    assert np.median(after[shining & painted] / before[shining & painted]) == pytest.approx(0.25, abs=0.02)
    assert np.allclose(after[free], before[free])
    lost = lit_before - lit()
    assert lost[shining & painted].sum() == pytest.approx((before - after)[shining & painted].sum(), rel=0.1)
    assert np.abs(lost[free]).max() < 1e-3 * lit_before.max()
    level.set("quiet.highlight", 0.0)
    assert np.array_equal(glint(level, renderer), before)
