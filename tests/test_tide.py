"""The tide (D31): the still sea as a function of the clock, known to all that knows depth."""

import numpy as np
import pytest
from coasts import make_beach
from points import feedback
from shorewright.level import BadInput, Settings
from shorewright.level.params import replace
from shorewright.level.shore import shore_map
from shorewright.level.tide import band_m, curve_at, left_s, sea_level_at, tide_m
from shorewright.level.walk import highest_sea_m, walkable
from shorewright.level.waves import sea_at, surface_at
from shorewright.level.weather_keys import level_at


def tidal(slope=0.05, **values):
    level = make_beach(rows=193, cols=129, slope=slope)
    for name, value in {"on": True, "range_m": 2.0, "period_s": 200.0, **values}.items():
        level.set(f"tide.{name}", value)
    return level


def test_two_points_make_a_cosine():
    """D31: high water at the start of the curve, low water half a period later, the mean between."""
    t = np.linspace(-300, 500, 401)
    assert np.allclose(tide_m(tidal().settings, t), np.cos(2 * np.pi * t / 200), atol=1e-12)
    assert tide_m(tidal(high_s=30.0).settings, 30.0) == pytest.approx(1.0)
    level = tidal()
    level.set("level.sea_level_m", 3.0)
    assert sea_level_at(level, 100.0) == pytest.approx(2.0)


def test_a_curve_passes_its_points_and_stays_between_them():
    """D31: any periodic curve; the band is that of its points."""
    curve = (0.1, 0.9, 0.3, 0.2, 0.6, 0.7)
    assert np.allclose(curve_at(curve, np.array(curve[::2])), curve[1::2])
    level = tidal(curve=curve)
    found = tide_m(level.settings, np.linspace(0, 200, 1001))
    assert np.allclose((found.min(), found.max()), band_m(level.settings), atol=1e-3)
    assert np.allclose(curve_at(curve, np.array([0.0, 1.0, -2.0])), curve_at(curve, 0.0))


@pytest.mark.parametrize("curve", [(0.0, 1.0), (0.5, 1.0, 0.2, 0.0), (0.0, 1.0, 1.0, 0.0), (0.0, 2.0, 0.5, 0.0)])
def test_what_is_no_curve_is_refused(curve):
    with pytest.raises(BadInput):
        replace(Settings(), "tide.curve", curve)


def test_a_moment_of_the_tide_is_the_sea_at_that_level():
    """D31: on open ground the surface with a tide is that of a level whose sea stands there; at mean level too."""
    level = tidal()
    x, y = np.meshgrid(np.linspace(4, 124, 13), np.linspace(4, 188, 24))
    for t in (0.0, 50.0, 130.0):
        still = make_beach(rows=193, cols=129, slope=0.05)
        still.set("level.sea_level_m", sea_level_at(level, t))
        for thing in (level, still):
            thing.set("shore.slide", False)
            thing.set("shore.sway", 0.0)  # by the distance to the mean shoreline
        with_tide, with_level = sea_at(level, t, x, y), sea_at(still, t, x, y)
        assert np.allclose(with_tide.depth_m, with_level.depth_m, atol=1e-5)
        assert np.allclose(with_tide.height_m, with_level.height_m, atol=2e-3)
    off = make_beach(rows=193, cols=129, slope=0.05)
    assert not np.array_equal(sea_at(level, 0.0, x, y).height_m, sea_at(off, 0.0, x, y).height_m)


def test_the_map_is_made_once_for_the_band_and_is_that_of_the_mean_level_at_tide_zero():
    """D31: a lagoon behind a rim is sea when the tide tops the rim; what is baked stays, and at 0 is as without."""
    level = tidal()
    north = np.arange(193)[:, None] * np.ones(129)
    rim = np.where((north > 118) & (north < 124), 1.5, np.where(north >= 124, 0.2, (north - 96.5) * 0.05))
    level.write("height", level.grid.rect, rim.astype(np.float32))
    plain = tidal(on=False)
    plain.write("height", level.grid.rect, rim.astype(np.float32))
    sea, baked = shore_map(plain).packed[..., 2], shore_map(level)
    tidal_sea = baked.packed[..., 2] < 0
    assert np.array_equal(tidal_sea, sea > 0)
    assert np.array_equal(baked.packed[tidal_sea][:, [0, 1, 3]], shore_map(plain).packed[sea > 0][:, [0, 1, 3]])
    lagoon = shore_map(level).at(64.0, 150.0, 0.0)["sea"].v, shore_map(level).at(64.0, 150.0, 1.0)["sea"].v
    assert lagoon == (0.0, 1.0)
    assert shore_map(level_at(level, 33.0)) is baked
    assert shore_map(level_at(level, 70.0)) is baked
    assert baked.at(64.0, 20.0, -1.0)["sea"].v == 1.0


def test_low_water_dries_what_it_leaves():
    """D31: the test of connection is today's, at every tide: where the sea no longer reaches is no sea."""
    level = tidal(range_m=6.0)
    limit = 1.1 * level.settings.shore.range_m * level.settings.shore.runup + 0.05
    for tide in (-3.0, -1.0, 0.0, 1.0, 3.0):
        sea = shore_map(level).packed[..., 2] < np.float32(tide)
        reached = shore_map(level).bottleneck + np.float32(tide) > -limit
        assert (sea[reached]).all()
        assert (sea & ~reached).sum() <= 3 * 129  # the bank beside it


@pytest.mark.parametrize("t", [20.0, 90.0])
def test_shader_and_twin_agree_at_any_tide(ctx, t):
    """D30, D31: within a millimetre over rough ground with pools, at half flood and near low water, in a loop too."""
    level = make_beach(rows=257, cols=257, slope=0.03, rough_m=0.15)
    for name, value in {"tide.on": True, "tide.range_m": 2.4, "tide.period_s": 200.0, "time.loop_s": 400.0}.items():
        level.set(name, value)
    at = np.random.default_rng(3).uniform(0, 1, (4000, 2)) * np.array(level.grid.extent_m)
    at = at.astype(np.float32)
    got, want = feedback(ctx, level, t, at), surface_at(level, t, *at.astype(np.float64).T)
    assert np.abs(got[:, 2] - want.height_m).max() < 1e-3
    assert np.abs(got[:, 4] - want.shore.line).max() < 5e-3
    level.set("tide.on", False)
    assert np.abs(feedback(ctx, level, t, at)[:, 2] - got[:, 2]).max() > 0.3


def test_what_the_ebb_left_is_known_by_height():
    """D31, L06: seconds since each height fell dry, by the cosine's own inverse; 0 under the sea."""
    level = tidal(period_s=200.0)
    heights = np.linspace(-1, 1, 17)
    since = 50.0 - 200 / (2 * np.pi) * np.arccos(heights)  # at t = 50 s the sea falls through the mean
    assert np.allclose(left_s(level.settings, 50.0), np.maximum(since, 0.0), atol=1.0)
    assert (left_s(level.settings, 200.0) < 1.0).all()  # high water


def test_walkable_ground_follows_the_tide_without_a_new_map():
    """D31: the height of sea up to which one walks says at every tide what the twin's test says."""
    level = tidal(range_m=3.0)
    limit = highest_sea_m(level, level.grid.rect)
    shares = []
    for t in (0.0, 60.0, 100.0):
        now = level_at(level, t)
        assert np.mean((now.sea_level_m <= limit) == walkable(now)) > 0.99  # a row of cells lies on the limit
        shares.append(walkable(now).mean())
    assert shares[0] < shares[1] < shares[2]


def test_a_moving_tide_sends_no_map_again(renderer):
    """D31, T14: frames at other tides send nothing but uniforms."""
    from shorewright.level.framing import cameras

    level = tidal()
    camera = cameras(level)[0]
    sent = []
    for t in (0.0, 25.0, 50.0, 75.0):
        renderer.draw(level, camera, (48, 32), t, view="walkable", quality="low")
        sent.append({name: renderer.uploader.sent[name] for name in ("u_bed", "u_beach", "u_height", "u_walkable")})
    assert all(counts == sent[0] for counts in sent)
