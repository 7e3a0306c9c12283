"""Hectare patches: the circle round all view circles, kinds of sea, what overriding one does to the twin (H01, H27)."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scenes import coast
from shorewright.level.objects import SeaPatch, ViewCircle
from shorewright.level.patches import (
    BEACH,
    COASTAL,
    KINDS,
    OPEN,
    REMOVED,
    Circle,
    beach_contact,
    extents,
    in_mesh,
    patch_kinds,
    patch_rects,
    patch_shore,
    removed,
    shore_reach_m,
    smallest_circle,
)
from shorewright.level.waves import surface_at

METRES = st.integers(-2000, 2000).map(float)
CIRCLES = st.lists(st.builds(Circle, METRES, METRES, st.integers(1, 900).map(float)), min_size=1, max_size=9)


def room(circles, x, y):
    """Radius that a circle about (x, y) needs to hold all of them."""
    return max(np.hypot(c.x - x, c.y - y) + c.radius_m for c in circles)


@given(CIRCLES)
def test_the_circle_holds_all_and_none_smaller_does(circles):
    """H01: the room needed is convex in the middle, so a middle that no step improves is the best one."""
    made = smallest_circle(circles)
    assert room(circles, made.x, made.y) <= made.radius_m * (1 + 1e-7) + 1e-6
    for turn in np.linspace(0, 2 * np.pi, 24, endpoint=False):
        for step in (0.1, 10.0):
            assert room(circles, made.x + step * np.cos(turn), made.y + step * np.sin(turn)) >= made.radius_m - 1e-6


def test_circles_that_hold_or_equal_each_other_and_those_in_a_row():
    one = Circle(5.0, 6.0, 100.0)
    assert smallest_circle([one]) == one
    assert smallest_circle([Circle(10.0, 6.0, 20.0), one, one]) == one
    row = [Circle(x, 0.0, 10.0) for x in (0.0, 50.0, 100.0)]
    made = smallest_circle(row)
    assert (made.x, made.y, made.radius_m) == pytest.approx((50.0, 0.0, 60.0))


def test_extents_follow_the_view_circles_of_a_level():
    level = coast()
    assert extents(level) is None
    level.put_object("a", ViewCircle(id="a", x=0.0, y=0.0, radius_m=100.0))
    assert extents(level) == Circle(0.0, 0.0, 100.0)
    level.put_object("b", ViewCircle(id="b", x=300.0, y=0.0, radius_m=100.0))
    assert extents(level).radius_m == pytest.approx(250.0)
    level.put_object("a", None)
    assert extents(level) == Circle(300.0, 0.0, 100.0)


def test_hectares_of_the_mesh_are_those_that_the_circle_touches():
    rng = np.random.default_rng(1)
    circle = Circle(130.0, -20.0, 210.0)
    col, row = (a.ravel() for a in np.meshgrid(np.arange(-5, 6), np.arange(-5, 6)))
    inside = in_mesh(circle, col, row)
    points = rng.uniform(-500, 600, (20_000, 2))
    covered = np.hypot(*(points - [circle.x, circle.y]).T) < circle.radius_m
    at = {(c, r): yes for c, r, yes in zip(col, row, inside, strict=True)}
    assert all(at[int(x // 100), int(y // 100)] for x, y in points[covered])
    assert 15 < inside.sum() < 40


def large_coast():
    """Land in the north up to 30 m, sea in the south down to 45 m."""
    return coast(slope=0.1, side=801)


def kind_at(level, x, y):
    made = patch_kinds(level)
    return int(made.kinds[int(y // 100) - made.row0, int(x // 100) - made.col0])


def test_kinds_follow_the_shore():
    level = large_coast()  # shoreline at y = 440
    assert [kind_at(level, 350, y) for y in (50, 430, 470)] == [OPEN, BEACH, BEACH]
    assert kind_at(level, 350, 650) == REMOVED
    level.set("shore.range_m", 0.5)
    assert kind_at(level, 350, 350) in (COASTAL, OPEN)
    level.set("sea.beach_m", 50.0)
    assert kind_at(level, 350, 350) == BEACH


def test_no_shore_wave_ever_reaches_an_open_patch():
    """H27, safely: whatever the settings, every mask and the lift are nothing there."""
    rng, level = np.random.default_rng(2), coast(slope=0.07, side=801, rock=20.0)
    for range_m, back in ((2.0, 0.3), (5.0, 0.9), (9.0, 0.05)):
        level.set("shore.range_m", range_m)
        level.set("shore.back", back)
        made = patch_kinds(level)
        rows, cols = np.nonzero(made.kinds == OPEN)
        assert len(rows) > 4
        x = (cols[:, None] + made.col0 + rng.uniform(0, 1, (len(cols), 60))) * 100.0
        y = (rows[:, None] + made.row0 + rng.uniform(0, 1, (len(rows), 60))) * 100.0
        for t in (0.0, 3.7, 11.0):
            shore = surface_at(level, t, x, y).shore
            for mask in (shore.line, shore.back, shore.fall, shore.lift.v, shore.lift.dx, shore.lift.dy):
                assert np.abs(mask).max() == 0.0


def test_reach_is_where_masks_end():
    """Just nearer than the reach something is left at some moment; from there on nothing at any."""
    level = coast(slope=0.03, side=801)
    y = (440.55 - shore_reach_m(level) / 0.03) + np.array([-8.0, 40.0])
    found = [surface_at(level, t, np.full(2, 300.0), y, skip_chop=True).shore for t in np.linspace(0, 27, 40)]
    level.set("sea.on", False)
    lift = np.abs([m.lift.v for m in found]).max(axis=0)
    back = np.abs([m.back for m in found]).max(axis=0)
    assert lift[0] == 0.0
    assert back[0] == 0.0
    assert lift[1] > 0.0


def test_overridden_patches_lose_their_waves_and_get_them_back_beside():
    """H27: none in the hectare, all from 20 m beside it on, smooth between; contact with the beach likewise."""
    level = coast(side=401)
    t, x = 4.0, np.linspace(60.0, 340.0, 1401)
    y = np.full_like(x, 205.0)
    before = surface_at(level, t, x, y)
    level.put_object("p", SeaPatch(id="p", x=150.0, y=250.0, sea="open"))
    after = surface_at(level, t, x, y)
    inside = (after.x > 100.5) & (after.x < 199.5)
    beside = (after.x < 79.5) | (after.x > 220.5)
    assert np.abs(before.shore.lift.v[inside]).max() > 0.1
    assert np.abs(after.shore.lift.v[inside]).max() == 0.0
    np.testing.assert_array_equal(after.height_m[beside], before.height_m[beside])
    assert np.abs(np.diff(after.height_m)).max() < np.abs(np.diff(before.height_m)).max() + 0.02
    assert beach_contact(level, x, y).v.min() == 0.0
    level.put_object("p", SeaPatch(id="p", x=150.0, y=250.0, sea="coastal"))
    np.testing.assert_array_equal(surface_at(level, t, x, y).height_m, before.height_m)
    contact = beach_contact(level, x, y)
    assert contact.v[(x > 100) & (x < 200)].max() == 0.0
    assert contact.v[(x < 80) | (x > 220)].min() == 1.0
    step = 1e-4
    slope = (beach_contact(level, x + step, y).v - beach_contact(level, x - step, y).v) / (2 * step)
    assert np.abs(slope - contact.dx).max() < 1e-3


def test_patches_side_by_side_leave_no_stripe_between_them():
    level = coast(side=401)
    for n in range(3):
        level.put_object(f"p{n}", SeaPatch(id=f"p{n}", x=50.0 + 100 * n, y=250.0, sea="open"))
    x = np.linspace(1, 299, 300)
    assert np.abs(patch_shore(level, x, np.full_like(x, 250.0)).v).max() == 0.0
    rects, ends = patch_rects(level)
    assert rects.tolist() == [[0.0, 200.0, 300.0, 300.0]]
    assert ends == (1, 1, 1)


def test_an_override_shows_in_the_kinds():
    level = coast(side=401)
    for n, name in enumerate(KINDS):
        level.put_object(name, SeaPatch(id=name, x=50.0 + 100 * n, y=-650.0, sea=name))
    assert [kind_at(level, 50.0 + 100 * n, -650.0) for n in range(4)] == [OPEN, COASTAL, BEACH, REMOVED]


def test_circles_that_all_but_coincide_end():
    """H01: where rounding leaves nothing to gain the search stops, and everything still lies within."""
    circles = [Circle(0.01 * n * n, 0.02 * (n % 3), 20_000.0) for n in range(6)]
    for some in (circles, [Circle(0.0, 0.0, 400.0), Circle(5e-6, 0.0, 400.0)]):
        found = smallest_circle(some)
        assert all(found.holds(one, 1e-3) for one in some)


def test_removed_hectares_hold_no_water():
    """H01, D12: what floats finds none there."""
    level = coast()
    level.put_object("p", SeaPatch(id="p", x=50.0, y=50.0, sea="removed"))
    assert list(removed(level, np.array([50.0, 150.0, 99.9]), np.array([50.0, 50.0, 100.1]))) == [True, False, False]
