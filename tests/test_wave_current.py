"""Waves that travel through a current (D35): Doppler, shear, a jet at a mouth, levels without one."""

import numpy as np
import pytest
from scipy.optimize import brentq
from shorewright.level.arrival import arrival, asked_of
from shorewright.level.arrival_map import BREAKS, TIMES
from shorewright.level.blocking import SHORTEST_AT, met_wavenumber, stopping_speed
from shorewright.level.dispersion import group_speed, wavenumber
from shorewright.level.pick import ground_at
from shorewright.level.river_flow import river_flow
from shorewright.level.shaping_request import _of, shape_request
from shorewright.level.swell_request import solve_request
from shorewright.level.travel_time import solve
from shorewright.level.waves import sea_at
from test_river_mouth import fast
from test_rivers import coast

G = 9.81


def doppler(period_s, depth_m, along_mps):
    """k of (ω − k U)² = g k tanh k h by bisection: between 0 and where the waves would be stopped."""
    omega = 2 * np.pi / period_s
    most = 40 * wavenumber(period_s, depth_m)
    grid = np.linspace(1e-5, most, 20_001)
    off = np.sqrt(G * grid * np.tanh(grid * depth_m)) + grid * along_mps - omega
    first = int(np.argmax(off > 0))
    return brentq(lambda k: np.sqrt(G * k * np.tanh(k * depth_m)) + k * along_mps - omega, grid[first - 1], grid[first])


@pytest.mark.parametrize(("period_s", "depth_m"), [(4.0, 30.0), (8.0, 3.0), (8.0, 12.0)])
def test_wavenumbers_in_a_current(period_s, depth_m):
    """D35: the Doppler dispersion to 1e-6 with, and up to what stops them against, a current; no shorter beyond."""
    stops = float(stopping_speed(period_s, depth_m))
    for along in np.array([-0.95, -0.7, -0.3, 0.0, 0.5, 2.0]) * stops:
        found = float(met_wavenumber(period_s, np.array([depth_m]), np.array([along]))[0])
        assert found == pytest.approx(doppler(period_s, depth_m, along), rel=1e-4)
    at = met_wavenumber(period_s, np.full(3, depth_m), -stops * np.array([SHORTEST_AT, 1.5, 40.0]))
    assert np.ptp(at) < 1e-9
    assert at[0] > 2 * wavenumber(period_s, depth_m) if depth_m > 12 else at[0] > 1.4 * wavenumber(period_s, depth_m)


@pytest.mark.parametrize("along", [-0.8, -0.4, 0.6])
def test_an_even_current_shortens_waves_as_doppler_says(along):
    """D35: crests against −0.4 and −0.8 of what stops them, and with the current: length within 1 %."""
    depth, cell_m, period_s = np.full((90, 50), 6.0), 2.0, 6.0
    mps = along * float(stopping_speed(period_s, 6.0))
    current = np.zeros((*depth.shape, 2))
    current[30:80, :, 1] = mps
    found = solve(depth, cell_m, period_s, 0.0, current=current)
    slow = np.diff(found.seconds[40:70, 25].astype(np.float64)).mean() / cell_m
    assert 2 * np.pi / period_s * slow == pytest.approx(doppler(period_s, 6.0, mps), rel=0.01)
    still = solve(depth, cell_m, period_s, 0.0)
    np.testing.assert_allclose(found.seconds[:28], still.seconds[:28], atol=1e-3)
    assert not found.meets.any()


@pytest.mark.parametrize("mps", [-1.5, 1.5])
def test_a_shear_current_bends_waves_and_keeps_k_along_it(mps):
    """D35: over a current along x that grows with y, a swell at 30° keeps k sin θ; k by Doppler: angle within 1°."""
    rows, cols, cell_m, period_s, deep_m = 120, 160, 2.0, 7.0, 20.0
    speed = mps * np.clip((np.arange(rows) - 20) / 60, 0, 1)
    current = np.zeros((rows, cols, 2))
    current[..., 0] = speed[:, None]
    found = solve(np.full((rows, cols), deep_m), cell_m, period_s, 30.0, current=current)
    north, east = np.gradient(found.seconds.astype(np.float64), cell_m)
    col = 120  # what came over the western border hasn't got here
    along = 2 * np.pi / period_s * np.sin(np.radians(30.0)) / found.speed_ref
    for row in (40, 60, 90):
        intrinsic = 2 * np.pi / period_s - along * speed[row]
        k = brentq(lambda k, own=intrinsic: G * k * np.tanh(k * deep_m) - own**2, along, 3.0)
        wanted = np.degrees(np.arcsin(along / k))
        assert np.degrees(np.arctan2(east, north))[row, col] == pytest.approx(wanted, abs=1.0)
    turned = np.degrees(np.arcsin(along / k)) - 30
    assert abs(turned) > 3


def test_crests_come_late_and_bunch_before_a_mouth():
    """D35: in the jet later, shorter by what the current says, the same far off; nothing below what still waves are."""
    level = fast(**{"timing.source": "travel_time"})
    with_it = arrival(level, 0.0)
    level.set("timing.current", 0.0)
    without = arrival(level, 0.0)
    later = with_it.block(0)[..., 0] - without.block(0)[..., 0]
    assert np.abs(later[:4]).max() < 0.05
    x, y = np.full(40, 60.0), np.linspace(35.0, 70.0, 40)
    here, still = (np.hypot(*(part.v for part in made.steep(x, y))) for made in (with_it, without))
    assert (here / still).max() > 1.15
    assert (here / still).min() > 0.97
    assert with_it.at(60.0, 68.0).swells[0].v > without.at(60.0, 68.0).swells[0].v + 0.05
    mouth = river_flow(level).mouths[0]
    limit = met_wavenumber(with_it.period_s[0], np.array([0.3]), np.array([-40.0]))[0]
    assert mouth.speed_mps < group_speed(with_it.period_s[0], mouth.depth_m)
    assert 2 * np.pi * here.max() < limit


def test_levels_without_a_current_in_the_sea_pay_nothing():
    """D35: no river and no paint: nothing is asked for; a river that is turned off leaves the same request."""
    level = coast()
    level.set("timing.source", "travel_time")
    assert asked_of(level, 0.0).request.current is not None
    level.set("flow.rivers", 0.0)
    off = asked_of(level, 0.0)
    assert off.request.current is None
    level.put_object("river", None)
    gone = asked_of(level, 0.0)
    assert gone.request.current is None
    assert gone.key == off.key


def test_painted_flow_moves_waves_when_the_stroke_has_ended():
    """D35: crests come sooner down a painted stream; under the brush the last current stays."""
    level = coast()
    level.put_object("river", None)
    level.set("timing.source", "travel_time")
    before = arrival(level, 0.0).at(40.0, 45.0).swells[0].v
    stream = np.zeros((*level.grid.shape, 2), np.float32)
    stream[10:45, 20:60, 1] = 1.5
    level.write("flow", level.grid.rect, stream)
    asked = asked_of(level, 0.0)
    assert arrival(level, 0.0).at(40.0, 45.0).swells[0].v < before - 0.02
    level.live = True
    level.write("flow", level.grid.rect, 2 * stream)
    assert asked_of(level, 0.0).request.current is asked.request.current
    level.live = False
    assert asked_of(level, 0.0).request.current.max() > 1.5 * asked.request.current.max()
    level.write("flow", level.grid.rect, stream)
    level.set("flow.shore_mps", 0.4)  # carries foam, moves no water
    assert asked_of(level, 0.0).key == asked.key


def test_no_seam_through_the_jet_as_the_tide_moves():
    """D35: two places a millimetre apart differ by less than 2 cm and 2°, at 20 moments of a tide of a metre."""
    level, rng = fast(**{"timing.source": "travel_time", "tide.on": True, "tide.range_m": 1.0, "tide.period_s": 600.0,
                         "shore.on": False}), np.random.default_rng(5)  # fmt: skip
    mouth = river_flow(level).mouths[0]
    ahead, across = rng.uniform((-2, -2.5), (10, 2.5), (150, 2)).T * mouth.half_m
    at = np.stack([mouth.x + ahead * mouth.east - across * mouth.north,
                   mouth.y + ahead * mouth.north + across * mouth.east])  # fmt: skip
    way = rng.normal(size=at.shape)
    way *= 0.0005 / np.hypot(*way)
    for t in rng.uniform(0, 600, 20):
        one, two = (sea_at(level, t, *(at + side * way)) for side in (-1, 1))
        seen = np.minimum(one.height_m, two.height_m) > ground_at(level, *at) + 0.05
        assert np.abs(one.height_m - two.height_m)[seen].max() < 0.02
        angle = np.degrees(np.arccos(np.clip((one.normal * two.normal).sum(-1), -1, 1)))
        assert np.count_nonzero(seen) > 60
        assert angle[seen].max() < 2


def test_no_lip_is_thrown_where_fronts_come_together():
    """D35, D34: behind the bulge round a jet two fronts meet: breaking doesn't show there, and does in still water."""
    level = fast(2.2, **{"timing.source": "travel_time", "sea.swell_m": 0.5, "sea.swell_length_m": 60.0})
    asked = asked_of(level, 0.0)
    meets = solve_request(asked.request)[0].time.meets
    crossing = meets > 0.9
    assert np.count_nonzero(crossing) > 3
    shows = asked.answered().block(BREAKS)[..., 1]
    assert shows[crossing].max() < 0.6
    assert shows.max() > 0.95


def test_a_front_in_the_hand_knows_the_current():
    """D35, T07: the process that shapes it, asked with the level's paint and river, solves the very same request."""
    level = coast()
    level.set("timing.source", "travel_time")
    stream = np.zeros((*level.grid.shape, 2), np.float32)
    stream[10:45, 20:60, 0] = 0.8
    level.write("flow", level.grid.rect, stream)
    there, _ = _of(shape_request(level, -35, 14.0, (60.0, 40.0), 20.0, 0, 35.0))
    mine, its = (asked_of(one, 14.0).request for one in (level, there))
    assert mine.current.any()
    np.testing.assert_array_equal(mine.current, its.current)
    np.testing.assert_array_equal(mine.depth_m, its.depth_m)
    level.set("timing.source", "depth")
    assert not shape_request(level, -36, 14.0, (60.0, 40.0), 20.0, 0, 35.0).paint


def test_banks_that_water_runs_along_set_no_time_for_the_swash():
    """D35: beside a mouth the sheet comes up with that of the beach, however late waves are up the river."""
    level = fast(2.0, **{"timing.source": "travel_time"})
    times = arrival(level, 0.0).block(TIMES)
    mouth = river_flow(level).mouths[0]
    at = round(mouth.y), round(mouth.x + 2.0 * mouth.half_m)  # on the beach, beside the mouth
    far = round(mouth.y), round(mouth.x + 6.0 * mouth.half_m)
    assert times[round(mouth.y + 12), round(mouth.x), 0] > times[far][0] + 3.0
    assert abs(times[at][3] - times[far][3]) < 1.5
