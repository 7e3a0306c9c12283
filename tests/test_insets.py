"""Views in the corners of the picture (T12)."""

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.level import BadInput
from shorewright.level.objects import Mover
from shorewright.renderer import VIEWS, Overlays, render
from shorewright.renderer.show import CORNERS, Inset

SIZE = (160, 90)
pytestmark = pytest.mark.gl


@pytest.fixture(scope="module")
def level():
    made = coast()
    made.put_object("m", Mover(id="m", x=128.0, y=70.0, circle_m=6.0, radius_m=2.0, speed_mps=4.0))
    return made


def picture(level, renderer, *insets, yaw=0.0, size=SIZE):
    shot = camera(x=128.0, y=60.0, z=30.0, yaw=yaw, pitch=-40.0)
    return render(level, shot, size, 4.0, overlays=Overlays(insets=insets), renderer=renderer).astype(int)


@pytest.mark.parametrize("corner", CORNERS)
def test_an_inset_covers_its_corner_and_nothing_else(level, renderer, corner):
    plain, seen = picture(level, renderer), picture(level, renderer, Inset("height", corner, 0.3))
    changed = (plain != seen).any(axis=2)
    rows, cols = np.flatnonzero(changed.any(axis=1)), np.flatnonzero(changed.any(axis=0))
    assert (rows.max() < 45) == corner.startswith("upper")
    assert (cols.max() < 80) == corner.endswith("left")
    assert 25 <= np.ptp(rows) + 1 <= 27
    assert np.ptp(cols) <= 27


def test_north_is_up_and_turning_turns(level, renderer):
    """The land lies north: red above, blue below; turned by 180° the other way round."""
    box = np.s_[4:26, 4:26]
    north = picture(level, renderer, Inset("height", "upper-left", 0.3))[box]
    south = picture(level, renderer, Inset("height", "upper-left", 0.3, turn_deg=180.0))[box]
    for seen, top in ((north, 0), (south, 2)):
        warm = seen[..., 0] - seen[..., 2]
        assert (warm[:4].mean() > 20) == (top == 0)
        assert (warm[-4:].mean() > 20) == (top == 2)


def test_ahead_is_up_whichever_way_one_looks(level, renderer):
    """A map that follows the heading is the map turned by the heading."""
    for yaw in (90.0, 180.0, 215.0):
        ahead = picture(level, renderer, Inset("height", "lower-left", 0.4, heading=True), yaw=yaw)
        turned = picture(level, renderer, Inset("height", "lower-left", 0.4, turn_deg=yaw), yaw=yaw)
        assert np.array_equal(ahead, turned)


def test_the_force_field_shows_its_mover(level, renderer):
    """D18: its window is the whole field; grey where nothing is pushed."""
    seen = picture(level, renderer, Inset("force", "upper-left", 0.6))[4:52, 4:52]
    pushed = np.abs(seen[..., :2] - 128).max(axis=2) > 20
    assert 0.002 < pushed.mean() < 0.5


@pytest.mark.parametrize("name", [name for name, view in VIEWS.items() if view.inset])
def test_every_view_that_can_be_one_draws(level, renderer, name):
    seen = picture(level, renderer, Inset(name, "upper-left", 0.5), size=(64, 36))
    assert (seen[1, 1:19] == 235).all()  # its frame


def test_what_is_written_in_words():
    assert Inset.parse("force") == Inset("force")
    assert Inset.parse("flow:lower-right:0.4:heading:200") == Inset("flow", "lower-right", 0.4, 0.0, True, 200.0)
    assert Inset.parse("depth::0.2:-45").turn_deg == -45.0
    for text, told in (
        ("nothing", "no view is called"), ("force:middle", "no inset"), ("force::big", "numbers"),
        ("force::7", "0.05 to 1"), ("final", "cannot be an inset"), ("furnace", "cannot be an inset"),
        ("force:upper-left:0.2:0:0:0", "no inset"),
    ):  # fmt: skip
        with pytest.raises(BadInput, match=told):
            Inset.parse(text)
