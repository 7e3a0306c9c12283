"""Reading the timing: arrival, speed and breaks against closed forms, and the shader against the twin (T06)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level.arrival_map import BLOCKS, ArrivalMap
from shorewright.level.crests import break_lines, crest_lines, isochrones
from shorewright.level.next_crest import next_crest
from shorewright.level.objects import Camera
from shorewright.level.shore_waves import BREAK_S
from shorewright.level.surf import TYPES, breaker_type, similarity
from shorewright.level.timing import arrival_s, front_speed_mps, passage, period_s, speed_on, swell_arrivals, timing_map
from shorewright.level.waves import sea_at
from shorewright.renderer import VIEWS, render

SLOPE = 0.05
SIZE = (160, 90)


def beach(**changes):
    """A planar beach whose fronts come at one time all along it."""
    level = make_beach(rows=193, cols=97, slope=SLOPE)
    for path, value in {"shore.stagger": 0.0, "sea.phase_noise": 0.0, "shore.variety": 0.0, **changes}.items():
        level.set(path.replace("__", "."), value)
    return level


def travelling(**changes):
    return beach(timing__source="travel_time", sea__variance=0.0, sea__swell_heading_deg=6.0, **changes)


def north_of(level, depth_m):
    """Where a plane beach has that depth."""
    return 96.0 - depth_m / SLOPE


def test_arrival_by_depth_is_a_line_of_the_depth():
    """T06: A = s · travel / (1 + runup), so a front crosses the range in that time at slope times less speed."""
    level = beach()
    shore, y = level.settings.shore, np.array([20.0, 40.0, 60.0, 80.0, 92.0])
    depth = (96.0 - y) * SLOPE
    expected = (1 - depth / shore.range_m) * shore.interval_s * shore.count / (1 + shore.runup)
    np.testing.assert_allclose(arrival_s(level, 0.0, 50.0, y), expected, atol=1e-3)
    speed = shore.range_m * (1 + shore.runup) / (shore.interval_s * shore.count * SLOPE)
    np.testing.assert_allclose(front_speed_mps(level, 0.0, 50.0, y), speed, rtol=1e-3)
    assert period_s(level, 0.0) == shore.interval_s


@pytest.mark.parametrize("make", [beach, travelling])
def test_a_crest_stands_where_its_time_says(make):
    """T06: at A + n · period the twin's front passes the point: the masks there are those of the front, u = 0."""
    level = make()
    x, y = np.full(3, 48.0), north_of(level, np.array([2.4, 1.6, 1.2]))
    times = arrival_s(level, 0.0, x, y) + 5 * period_s(level, 0.0)
    for i, t in enumerate(times):
        shore = level.settings.shore
        near = [sea_at(level, t + dt, x[i : i + 1], y[i : i + 1]).shore for dt in (-0.6, 0.0, 0.6)]
        b = [float(masks.b[0]) for masks in near]
        assert b[0] < 0.5 < b[2] or b[0] > 0.5 > b[2]
        assert b[1] == pytest.approx(0.5, abs=0.02 / shore.width)


def test_nothing_stands_on_land_in_ponds_or_where_no_wave_is():
    level = beach()
    here = passage(level, 0.0, [50.0, 50.0, 50.0], [120.0, 80.0, -500.0])
    assert here.stands.tolist() == [False, True, False]
    assert next_crest(level, 0.0, 50.0, 120.0) is None
    level.set("shore.on", False)
    assert not passage(level, 0.0, [50.0], [80.0]).stands.any()


def test_the_next_crest_by_depth_is_a_closed_form():
    """T06: the wait, and from there the time to depth (1 − BREAK_S) · range."""
    level, t = beach(), 3.0
    shore = level.settings.shore
    y = north_of(level, 2.0)
    found = next_crest(level, t, 48.0, y)
    travel_s = shore.interval_s * shore.count / (1 + shore.runup)
    s = 1 - 2.0 / shore.range_m
    assert found.in_s == pytest.approx((s * travel_s - t) % shore.interval_s, abs=1e-3)
    assert found.breaks_after_s == pytest.approx((BREAK_S - s) * travel_s, abs=2e-3)
    assert found.height_m == pytest.approx(shore.height_m, rel=1e-3)
    assert found.at == pytest.approx((48.0, north_of(level, (1 - BREAK_S) * shore.range_m)), abs=0.02)
    words = f"next crest in {found.in_s:.1f} s, breaks {found.breaks_after_s:.1f} s later, {shore.height_m:.1f} m high"
    assert found.sentence == words
    inside = next_crest(level, t, 48.0, north_of(level, 0.5))
    assert inside.broken
    assert "already broken" in inside.sentence


def test_the_next_crest_by_travel_breaks_where_height_meets_depth():
    """T06: at the break the wave is as high as breaker · depth allows, and it comes there on time."""
    level = travelling()
    found = next_crest(level, 3.0, 20.0, 30.0)
    there = passage(level, 3.0, [found.at[0]], [found.at[1]])
    most_m = level.settings.timing.breaker * there.depth_m[0]
    assert there.height_m[0] == pytest.approx(0.95 * most_m, rel=0.03)
    late = float(arrival_s(level, 3.0, *found.at) - arrival_s(level, 3.0, 20.0, 30.0))
    assert found.breaks_after_s == pytest.approx(late, abs=0.05)
    assert found.breaks_after_s > 1.0


def test_breaker_types_by_slope():
    """T06: flat beds spill, steeper ones plunge, walls surge (Battjes 1974)."""
    found = [TYPES[int(breaker_type(slope, 1.0, 8.0))] for slope in (0.01, 0.1, 0.6)]
    assert found == ["spilling", "plunging", "surging"]
    assert similarity(0.1, 1.0, 8.0) == pytest.approx(0.1 / np.sqrt(2 * np.pi / (9.81 * 64)))


def test_lines_on_a_plane_beach_are_straight():
    """T06: crests, isochrones and the break line lie at the depths that the clock gives, to a part of a cell."""
    level, t = beach(), 4.0
    shore = level.settings.shore
    travel_s = shore.interval_s * shore.count / (1 + shore.runup)
    crests = crest_lines(level, t)
    assert len(crests) == 3
    for line in crests:
        s = (t - line.value * shore.interval_s) / travel_s
        np.testing.assert_allclose(line.points[:, 1], north_of(level, (1 - s) * shore.range_m), atol=0.02)
        assert line.length_m == pytest.approx(96.0, abs=0.01)
    for line in isochrones(level, t, 3.0):
        y = north_of(level, (1 - line.value / travel_s) * shore.range_m)
        np.testing.assert_allclose(line.points[:, 1], y, atol=0.1 if y < 16 else 0.02)  # the border is smoothed too
    (edge,) = break_lines(level, t)
    np.testing.assert_allclose(edge.points[:, 1], north_of(level, (1 - BREAK_S) * shore.range_m), atol=0.02)


class Plane:
    """A solver whose swells are plane waves of one speed."""

    def __init__(self, heading_deg, speed_mps):
        self.way = np.array([np.sin(np.radians(heading_deg)), np.cos(np.radians(heading_deg))])
        self.slow = self.way / speed_mps

    def answer(self, asked):
        rows, cols = asked.request.depth_m.shape
        cell_m, periods = asked.request.cell_m, tuple(one.period_s for one in asked.request.swells)
        x, y = np.meshgrid(np.arange(cols) * cell_m, np.arange(rows) * cell_m)
        packed = np.ones((BLOCKS * rows, cols, 4), np.float32)
        packed[:rows] = (self.slow[0] * x + self.slow[1] * y)[..., None]
        return ArrivalMap(packed, cell_m, periods, np.tile(self.slow, (3, 1)))


def test_crests_of_a_swell_lie_a_wavelength_apart_in_deep_water():
    """T06: over an even bed lines are straight, speed times period apart, across the way that the swell goes."""
    level = make_beach(rows=129, cols=129, slope=0.0)
    for path, value in {"level.sea_level_m": 12.0, "timing.source": "travel_time", "sea.phase_noise": 0.0}.items():
        level.set(path, value)
    solver = level.solver = Plane(30.0, 8.0)
    apart = {}
    for line in crest_lines(level, 5.0):
        inner = line.points[((line.points > 3) & (line.points < 125)).all(1)]
        along = inner @ solver.way
        assert np.ptp(along) < 1e-3
        apart[line.value] = along.mean()
        assert along.mean() == pytest.approx((5.0 - line.value * period_s(level, 5.0)) * 8.0, abs=1e-3)
    assert len(apart) >= 3
    assert float(front_speed_mps(level, 5.0, 60.0, 60.0)) == pytest.approx(8.0, rel=1e-5)


def test_maps_are_kept_until_something_changes():
    level = beach()
    one = timing_map(level, 0.0)
    assert timing_map(level, 9.0) is one
    level.set("shore.interval_s", 7.0)
    assert timing_map(level, 9.0) is not one


def test_swells_have_names():
    level = travelling()
    assert list(swell_arrivals(beach(), 0.0, 50.0, 50.0)) == ["shore"]
    found = swell_arrivals(level, 0.0, 50.0, 50.0)
    assert list(found) == ["swell1", "swell2", "swell3"]
    assert found["swell1"] == pytest.approx(float(arrival_s(level, 0.0, 50.0, 50.0)))


@pytest.mark.gl
@pytest.mark.parametrize("source", ["depth", "travel_time", "blend"])
def test_the_shader_reads_what_the_twin_reads(renderer, source):
    """T06: the views arrival and front_speed are `arrival_s` and `front_speed_mps` at the pixels' places."""
    level = make_beach(rows=129, cols=161, rough_m=0.05)
    level.set("timing.source", source)
    camera = Camera(id="down", x=80, y=30, z=60, yaw_deg=0, pitch_deg=-70, fov_deg=60)
    shot = {"size": SIZE, "time_s": 5.0, "quality": "low", "renderer": renderer, "linear": True}
    arrival, speed, place, kind = (
        render(level, camera, view=view, **shot).astype(np.float64)
        for view in ("arrival", "front_speed", "position", "breakers")
    )
    x, y = place[..., 0], place[..., 1]
    here = passage(level, 5.0, x, y)
    inside = here.stands & (arrival[..., 0] != 0) & (x > 2) & (x < 158) & (y > 2) & (y < 126)
    assert inside.sum() > 1500
    np.testing.assert_allclose(arrival[..., 0][inside], here.arrival_s[inside], atol=2e-2)
    np.testing.assert_allclose(speed[..., 0][inside], here.speed_mps[inside], rtol=2e-2, atol=2e-2)
    apart = np.abs(here.broken) > 0.02
    colourful = kind.max(-1) - kind.min(-1) > 0.02
    assert np.array_equal(colourful[inside & apart], here.broken[inside & apart] >= 0)


def test_views_of_the_timing_are_in_the_table():
    assert {"arrival", "front_speed", "breakers"} <= set(VIEWS)


def test_what_is_told_while_sculpting_is_the_speed_of_the_source():
    """D31, T06: over a plane bed the speed by depth and slope alone is that of the map, in either source."""
    for source in ("depth", "travel_time"):
        level = make_beach(rows=161, cols=121, cell_m=2.0, slope=0.05, sway=0.0)
        level.set("timing.source", source)
        level.set("sea.phase_noise", 0.0)
        level.set("sea.swell_heading_deg", 8.0)
        y = np.linspace(20.0, 300.0, 141)
        found = passage(level, 5.0, np.full_like(y, 120.0), y)
        at = int(np.abs(found.depth_m - 3.0).argmin())
        told = speed_on(level, 5.0, float(found.depth_m[at]), float(found.slope[at]))
        assert told == pytest.approx(float(found.speed_mps[at]), rel=0.06), source
