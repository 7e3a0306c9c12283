"""When waves come (T06): the map that shader and twin read, its joint with the open sea, and who works it out."""

import time

import numpy as np
import pytest
from coasts import make_beach
from points import feedback
from shorewright.app.arrival_lender import ArrivalLender
from shorewright.level.arrival import arrival, asked_of, offshore_height_m, period_s, shore_at, swell
from shorewright.level.arrival_map import BEYOND_M, BREAKS, HEIGHTS, TIMES, ArrivalMap
from shorewright.level.dispersion import group_speed
from shorewright.level.dual import Dual
from shorewright.level.objects import OBJECT_KINDS
from shorewright.level.shore import shore_map
from shorewright.level.shore_waves import Travel, lead_arrival, s_cycles
from shorewright.level.waves import surface_at


def travelling(**settings):
    level = make_beach(rows=161, cols=121, cell_m=4.0, slope=0.04)
    for path, value in {"timing.source": "travel_time", **settings}.items():
        level.set(path.replace("__", "."), value)
    return level


def waited_for(lender, level, patience_s=60.0):
    end = time.monotonic() + patience_s
    while time.monotonic() < end:
        lender.look()
        made = arrival(level, 0.0)
        if made is not None and made.settled:
            return made
        time.sleep(0.01)
    raise AssertionError("no map came")


def test_depth_needs_no_map():
    level = make_beach()
    assert arrival(level, 3.0) is None
    assert shore_at(level, 3.0) is level.settings.shore


def test_shore_waves_keep_the_periods_of_the_leading_swell():
    """T06: one wave from the open sea to the swash."""
    level = travelling()
    assert shore_at(level, 0.0).interval_s == pytest.approx(period_s(swell(level, 0.0))[0])
    assert arrival(level, 0.0) is arrival(level, 5.0)


def test_maps_read_back_a_plane_in_place_and_slope():
    """The spline gives back values that grow evenly, and their gradient, to the map's very border and beyond it."""
    rows, cols, cell = 21, 33, 3.0
    y, x = np.mgrid[0:rows, 0:cols] * cell
    times = np.stack([0.3 * x + 0.1 * y, -0.2 * x, 0.05 * y, 0.1 * x], -1)
    plane = np.array([[0.3, 0.1], [-0.2, 0.0], [0.0, 0.05]])
    packed = np.concatenate([times, np.ones_like(times), 2.0 * times]).astype(np.float32)
    made = ArrivalMap(packed, cell, (2.0, 4.0, 8.0), plane)
    at = np.random.default_rng(2).uniform(-30, 120, (2, 400))
    found = made.at(*at)
    for i, period in enumerate(made.period_s):
        east, north = plane[i] / period
        assert found.swells[i].v == pytest.approx(east * at[0] + north * at[1], abs=1e-4)
        assert found.swells[i].dx == pytest.approx(east, abs=1e-6)
        assert found.swells[i].dy == pytest.approx(north, abs=1e-6)
        assert found.gains[i].v == pytest.approx(1.0, abs=1e-6)


def test_the_map_becomes_the_plane_wave_beyond_the_border():
    """No seam: times and heights join those of the open sea over BEYOND_M."""
    level = travelling()
    made, width = arrival(level, 0.0), level.grid.extent_m[0]
    y = np.full(400, 40.0)
    x = np.linspace(width, width + 1.5 * BEYOND_M, 400)
    found = made.at(x, y)
    for i in range(3):
        east, north = made.plane[i] / made.period_s[i]
        assert found.swells[i].v[-1] == pytest.approx(east * x[-1] + north * y[-1], abs=1e-9)
        assert np.abs(np.diff(found.swells[i].v)).max() < 0.2
        assert found.gains[i].v[-1] == 1.0


def test_gradients_are_those_of_the_map():
    """H29: times and gains with their gradients, against differences."""
    made = arrival(travelling(), 0.0)
    at, h = np.random.default_rng(4).uniform(10, 460, (2, 500)), 1e-4
    found, east, north = made.at(*at), made.at(at[0] + h, at[1]), made.at(at[0], at[1] + h)
    for here, e, n in zip(
        found.swells + found.gains, east.swells + east.gains, north.swells + north.gains, strict=True
    ):
        assert (e.v - here.v) / h == pytest.approx(here.dx, abs=2e-3)
        assert (n.v - here.v) / h == pytest.approx(here.dy, abs=2e-3)


def test_a_swell_is_one_wave_from_deep_water_to_the_sand():
    """T06: at a moment the lead's crest offshore and the front of the shore wave stand on one line of arrival."""
    level = travelling(shore__sway=0.0, shore__stagger=0.0, sea__phase_noise=0.0, sea__swell_heading_deg=8.0)
    made, shore = arrival(level, 0.0), shore_at(level, 0.0)
    y = np.linspace(20, 620, 6000)
    passing = made.at(np.full_like(y, 240.0), y)
    # the shore wave's own count of cycles is the swell's, up to where it lands
    s_body = 1.0 - shore_map(level).at(np.full_like(y, 240.0), y)["smoothed"] * (1 / shore.range_m)
    lead = lead_arrival(shore, s_body, Dual(0.0), Travel.of(passing, Dual(0.0), 1.0))
    wet = s_body.v < 0.85
    assert lead.v[wet] == pytest.approx(passing.swells[0].v[wet])
    assert np.abs(np.diff(lead.v)).max() < 0.05
    assert s_cycles(shore) == pytest.approx(shore.count / (1 + shore.runup))


def test_blend_lies_between_both_clocks():
    """T06: at share 0 the times are the depth's, at 1 the swell's."""
    line = np.linspace(100, 600, 400)
    shapes = {}
    for blend in (0.0, 1.0):
        level = travelling(
            timing__source="blend", timing__blend=blend, shore__sway=0.0, sea__swell_m=0.0, sea__chop_m=0.0
        )
        shapes[blend] = surface_at(level, 9.0, np.full_like(line, 200.0), line).shore.line
    level.set("timing.source", "travel_time")
    assert np.array_equal(surface_at(level, 9.0, np.full_like(line, 200.0), line).shore.line, shapes[1.0])
    assert np.abs(shapes[0.0] - shapes[1.0]).max() > 0.5


def test_the_height_offshore_is_that_which_breaks_as_high_as_asked():
    """Energy flux is kept: H0² cg = Hb² √(g Hb / γ)."""
    high = offshore_height_m(1.2, 9.0, 30.0, 0.78)
    assert high**2 * group_speed(9.0, 30.0) == pytest.approx(1.2**2 * np.sqrt(9.81 * 1.2 / 0.78))


def test_an_editor_gets_the_very_map_that_a_picture_has():
    """T06, T14: worked out beside the window, of the same bytes; nothing waits while it comes."""
    level = travelling()
    wanted = arrival(level, 0.0)
    lender = level.solver = ArrivalLender()
    try:
        assert arrival(level, 0.0) is None
        assert lender.busy
        made = waited_for(lender, level)
        assert made.packed.tobytes() == wanted.packed.tobytes()
        assert made.plane.tobytes() == wanted.plane.tobytes()
        level.set("sea.swell_heading_deg", 60.0)
        assert not arrival(level, 0.0).settled
        assert not np.array_equal(waited_for(lender, level).block(TIMES), made.block(TIMES))
    finally:
        lender.close()


def test_under_the_brush_times_change_and_heights_stay():
    """T14: while a step is open a coarse map of times comes; heights are those of the last whole one."""
    level = travelling()
    lender = level.solver = ArrivalLender()
    try:
        assert arrival(level, 0.0) is None
        whole = waited_for(lender, level)
        level.live = True
        level.set("timing.least_depth_m", 1.0)
        asked = asked_of(level, 0.0)
        assert asked.request.swells[0].height_m == 0
        arrival(level, 0.0)
        end = time.monotonic() + 60
        while not lender.look() and time.monotonic() < end:
            time.sleep(0.01)
        made = arrival(level, 0.0)
        assert not made.settled
        assert not np.array_equal(made.block(TIMES), whole.block(TIMES))
        for which in (HEIGHTS, BREAKS):
            assert made.block(which) == pytest.approx(whole.block(which), abs=1e-6)
    finally:
        lender.close()


@pytest.mark.gl
def test_objects_and_regions_ride_on_swells_that_travel(ctx):
    """H08, D32, T06: shader and twin agree where all of them meet."""
    level = travelling()
    level.put_object("w", OBJECT_KINDS["wave"](id="w", x=220.0, y=300.0, yaw_deg=20.0))
    level.put_object("r", OBJECT_KINDS["wave_region"](id="r", x=260.0, y=200.0, radius_m=150.0))
    at = np.random.default_rng(7).uniform(0, 480, (4000, 2)).astype(np.float32)
    got = feedback(ctx, level, 5.0, at)
    want = surface_at(level, 5.0, *at.astype(np.float64).T)
    assert np.abs(got[:, 2] - want.height_m).max() < 1e-3
    level.put_object("r", None)
    assert np.abs(surface_at(level, 5.0, *at.astype(np.float64).T).height_m - want.height_m).max() > 0.1
