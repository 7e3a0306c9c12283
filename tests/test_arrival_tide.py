"""Times of travel at any tide (T06): maps of some sea levels, a straight line in between."""

import time
from dataclasses import replace

import numpy as np
import pytest
from coasts import make_beach
from points import feedback
from shorewright.app.arrival_lender import ArrivalLender
from shorewright.level.arrival import arrival, asked_of, period_s, swell
from shorewright.level.arrival_map import ArrivalMap
from shorewright.level.arrival_tide import TideMaps, all_levels_m, joined, levels_m
from shorewright.level.pick import ground_at
from shorewright.level.shaping import shape_front
from shorewright.level.shaping_lines import crest_near, dragged, phase_at
from shorewright.level.timing import passage
from shorewright.level.waves import sea_at, surface_at


def tidal(rows=161, cols=81, cell_m=4.0, slope=0.04, **settings):
    level = make_beach(rows=rows, cols=cols, cell_m=cell_m, slope=slope)
    values = {"timing.source": "travel_time", "tide.on": True, "tide.range_m": 1.6, "tide.period_s": 600.0}
    for path, value in {**values, **settings}.items():
        level.set(path.replace("__", "."), value)
    return level


def moment_of(level, tide_m: float) -> float:
    """Seconds at which the falling tide stands there."""
    tide = level.settings.tide
    return tide.period_s * float(np.arccos(2 * tide_m / tide.range_m)) / (2 * np.pi)


def test_levels_are_steps_of_the_tide_and_its_ends():
    """T06: mean water is always one, so a tide at rest there is the map without a tide."""
    settings = tidal(timing__tide_step_m=0.5).settings
    assert all_levels_m(settings).tolist() == [-0.8, -0.5, 0.0, 0.5, 0.8]
    assert levels_m(settings, 0.0) == (0.0,)
    assert levels_m(settings, 0.2) == (0.0, 0.5)
    assert levels_m(settings, -0.8) == (-0.8,)
    assert levels_m(settings, np.array([-0.6, 0.1])) == (-0.8, -0.5, 0.0, 0.5)


def test_mean_water_is_the_map_without_a_tide():
    """T06: to the bit, and a still picture there solves one map."""
    level = tidal()
    high = level.settings.tide.period_s / 4
    made = arrival(level, high)
    assert len(level.derived["arrivals"]) == 1
    level.set("tide.on", False)
    assert arrival(level, high).packed.tobytes() == made.packed.tobytes() == made.texture.tobytes()


def test_between_levels_times_are_those_of_a_map_solved_there():
    """T06: within 0.1 s in water that isn't the swash; by mean water half a second off."""
    level = tidal()
    for tide_m in (-0.65, -0.1, 0.3, 0.7):
        t = moment_of(level, tide_m)
        blended, direct = arrival(level, t), asked_of(level, t).answered()
        assert len(blended.above) == 1
        x, y = np.meshgrid(np.linspace(10, 310, 30), np.linspace(10, 630, 300))
        got, want = blended.at(x, y), direct.at(x, y)
        wet = tide_m - ground_at(level, x, y) > 0.3
        off = np.abs(got.swells[0].v - want.swells[0].v)[wet] * blended.period_s[0]
        assert wet.sum() > 1000
        assert off.max() < 0.1
        assert np.abs(got.lead_height.v - want.lead_height.v)[wet].max() < 0.2
    mean = arrival(level, moment_of(level, 0.0)).at(x, y)
    assert np.abs(mean.swells[0].v - want.swells[0].v)[wet].max() * blended.period_s[0] > 0.5


def test_crests_come_later_at_low_water():
    """T06: what the timing tells is that of the tide at the moment."""
    level = tidal(sea__phase_noise=0.0)
    x, y = np.full(40, 150.0), np.linspace(200, 420, 40)
    low, high = (passage(level, moment_of(level, tide), x, y) for tide in (-0.7, 0.7))
    both = low.stands & high.stands
    assert both.sum() > 10
    assert (low.arrival_s - high.arrival_s)[both].min() > 0.2


@pytest.mark.gl
@pytest.mark.parametrize("source", ["travel_time", "blend"])
def test_shader_and_twin_agree_between_two_levels(ctx, source):
    """T06, H23: within a millimetre, where waves plunge too."""
    level = tidal(timing__source=source, shore__plunge=1.0, shore__runup_by_slope=0.5)
    t = moment_of(level, 0.27)
    at = np.random.default_rng(3).uniform(-20, 660, (6000, 2)).astype(np.float32)
    got, want = feedback(ctx, level, t, at), surface_at(level, t, *at.astype(np.float64).T)
    assert len(arrival(level, t).above) == 1
    assert np.abs(got[:, 2] - want.height_m).max() < 1e-3
    assert np.abs(got[:, 4] - want.shore.line).max() < 5e-3


def test_many_moments_at_once_are_each_of_their_tide():
    """T06: a probe's moments go through several levels of the sea."""
    level = tidal(shore__plunge=1.0)
    times = np.linspace(0.0, 300.0, 13)
    x, y = np.full(13, 150.0), np.linspace(220, 400, 13)
    together = sea_at(level, times, x, y).height_m
    alone = [float(sea_at(level, float(t), a, b).height_m) for t, a, b in zip(times, x, y)]
    assert together == pytest.approx(alone, abs=2e-3)


def test_a_loop_ends_as_it_began():
    """T06: the first and the last moment of a loop have one map, to the byte."""
    level = tidal(time__loop_s=600.0)
    first, last = arrival(level, 130.0), arrival(level, 730.0)
    assert first.sources == last.sources or all(a is b for a, b in zip(first.sources, last.sources, strict=True))
    assert first.rise == last.rise > 0


def test_where_land_becomes_sea_times_go_on_from_the_nearest_water():
    """T06: no step at a water line that lies between two levels."""
    rows, cols = 3, 12
    packed = np.zeros((9, cols, 4), np.float32)
    reached = np.zeros((rows, cols, 3), bool)
    high = ArrivalMap(packed.copy(), 1.0, (8.0, 6.0, 5.0), np.zeros((3, 2)), reached=reached.copy())
    low = replace(high, packed=packed.copy(), reached=reached.copy())
    high.packed[:3, :, :] = np.arange(cols)[None, :, None]
    high.reached[:, :9] = True
    low.packed[:3, :, :] = np.arange(cols)[None, :, None] * 1.25
    low.reached[:, :6] = True
    low.packed[:3, 6:, :] = -70.0  # of the plane wave: no time of any wave there
    made = replace(joined([low, high]), rise=0.5)
    assert made.block(0)[1, 6:, 0] == pytest.approx(np.arange(6, 12) + 0.5 * 5 * 0.25)
    assert np.diff(made.block(0)[1, :, 0]).min() > 0.9


def test_an_editor_gets_the_very_maps_that_a_picture_has():
    """T06, T14: the two levels of the sea come from the process beside; until then the last good pair goes on."""
    level = tidal()
    t = moment_of(level, 0.27)
    wanted = arrival(level, t)
    level.derived.clear()
    lender = level.solver = ArrivalLender()
    try:
        end = time.monotonic() + 60
        while (made := arrival(level, t)) is None or not made.settled:
            assert time.monotonic() < end
            lender.look()
            time.sleep(0.01)
        assert made.texture.tobytes() == wanted.texture.tobytes()
        assert made.rise == wanted.rise
        later = arrival(level, moment_of(level, -0.6))
        assert not later.settled
        assert later.rise == 0.0
        assert lender.busy
    finally:
        lender.close()


@pytest.mark.parametrize("source", ["depth", "travel_time"])
def test_a_front_is_shaped_as_it_stands_at_the_tide(source):
    """T07, T06: at high water the crest comes to the line at high water."""
    level = tidal(timing__source=source, cell_m=2.0, rows=321, cols=161, shore__range_m=8.0)
    t = moment_of(level, 0.7)
    wave, crest = crest_near(level, t, (160.0, 300.0), 70.0)
    line = dragged(crest, crest[np.hypot(*(crest - (160.0, 300.0)).T).argmin()], (0.0, -6.0), 70.0)
    was, _ = phase_at(level, t, *line.T)
    shaped = shape_front(level, t, line, 70.0, wave=wave)
    level.write("height", shaped.rect, level.height[shaped.rect.slices] + shaped.change)
    now, _ = phase_at(level, t, *shaped.line.T)
    assert np.abs(was.v - wave).max() > 0.05
    assert np.quantile(np.abs(now.v - wave), 0.95) * period_s(swell(level, t))[0] < 0.25


def test_nothing_is_asked_for_many_tides_at_once():
    """T06: crests of a whole minute must not make a process solve for ever."""
    assert TideMaps().latest(0.3) is None


def test_under_the_brush_both_levels_follow_and_heights_stay():
    """T14, T06: coarse times of the two seas come, with the heights of the last whole maps."""
    level = tidal()
    t = moment_of(level, 0.27)
    lender = level.solver = ArrivalLender()

    def waited(until):
        end = time.monotonic() + 60
        while (made := arrival(level, t)) is None or not until(made):
            assert time.monotonic() < end
            lender.look()
            time.sleep(0.01)
        return made

    try:
        whole = waited(lambda made: made.settled)
        level.live = True
        level.set("timing.least_depth_m", 1.0)
        made = waited(lambda made: not np.array_equal(made.block(0), whole.block(0)))
        assert not made.settled
        assert len(made.above) == 1
        assert made.rise == whole.rise
        for which in (1, 2):
            assert made.block(which) == pytest.approx(whole.block(which), abs=1e-5)
    finally:
        lender.close()
