"""The weather map: twin against GPU, order of its stages, its wrap (Z04 to Z06)."""

from itertools import pairwise

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level import Rect
from shorewright.level.objects import Camera
from shorewright.level.weather import SIDE, STAGES, TILE_M, paint_place, pulled, weather_at, weather_map


def cloudy():
    level = make_beach()
    level.set("clouds.on", True)
    level.set("weather.precipitation", 0.2)
    level.set("weather.heading_deg", 123.0)
    return level


def paint(level, rect, coverage, rain, kind, weight):
    level.write("weather", rect, np.array([coverage, rain, kind, weight, weight, weight], np.float32))


def map_of(renderer, level, time_s, camera, stage):
    """The map that the GPU makes, `(512, 512, 4)`."""
    from shorewright.renderer.passes import weather
    from shorewright.renderer.views import find_view

    frame = renderer.prepare(level, camera, (64, 36), time_s, find_view("final"), None, "low", None)
    made = weather.weather_kept(frame, "test")
    weather.make_map(frame, made, stage)
    return np.frombuffer(made.texture.read(), np.float16).reshape(SIDE, SIDE, 4).astype(np.float32)


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize("time_s", [0.0, 1900.0, 7 * 86400.0])
def test_gpu_makes_the_map_of_the_twin(renderer, stage, time_s):
    """Z04 Z05 Z06: within what half floats and the texture unit's fractions leave."""
    level = cloudy()
    paint(level, Rect(200, 230, 300, 290), 0.9, 0.6, 0.3, 0.8)
    level.set("storm.chance", 0.7)
    camera = Camera(id="there", x=21_000.0, y=-33_500.0, z=60.0)
    made = map_of(renderer, level, time_s, camera, stage)
    twin = weather_map(level, time_s, (camera.x, camera.y), stage)
    assert np.abs(made - twin).mean() < 1e-3
    assert np.quantile(np.abs(made - twin), 0.9999) < 0.02


def test_paint_is_the_map_where_it_is_whole():
    """Z05: weight 1 is the paint exactly, weight 0 the simulation."""
    level = cloudy()
    bare = weather_map(level, 0.0, (0.0, 0.0), "painted")
    paint(level, Rect(200, 200, 300, 300), 0.25, 0.5, 0.75, 1.0)
    made = weather_map(level, 0.0, (0.0, 0.0), "painted")
    np.testing.assert_array_equal(made[210:290, 210:290, :3], np.float32([0.25, 0.5, 0.75]) + np.zeros((80, 80, 1)))
    np.testing.assert_array_equal(made[:190], bare[:190])


def test_horizon_leaves_paint_alone():
    """Z06: from 35 km on there is only the horizon's sky, but not where the paint is whole."""
    level = cloudy()
    paint(level, Rect(0, 0, 40, 40), 0.125, 0.0, 0.25, 1.0)
    made = weather_map(level, 0.0, (0.0, 0.0), "horizon")
    np.testing.assert_allclose(made[5:30, 5:30, 0], 0.125, atol=1e-6)
    np.testing.assert_allclose(made[-20:-1, :19, :3], np.float32([0.5, 0.0, 1.0]) + np.zeros((19, 19, 1)), atol=1e-6)


def test_precipitation_pulls_to_thunderheads():
    """Z04: whatever is there goes to coverage 0.7 or more, gradient 1, monotonically."""
    rain = np.linspace(0, 1, 9)
    for coverage, kind in ((0.1, 0.0), (0.9, 1.0)):
        sky = pulled(np.stack([np.full(9, coverage), rain, np.full(9, kind)], -1))
        assert (np.diff(sky[:, 0]) >= 0).all()
        assert (np.diff(sky[:, 2]) > 0).all()
        assert sky[-1, 2] == 1
        assert sky[-1, 0] == pytest.approx(max(coverage, 0.7))
        assert sky[0, 2] == 0.5 * kind


def test_paint_goes_with_the_wind_and_comes_round():
    """Z07: what is painted at a place is downwind of it later; after one torus it is there again."""
    level = cloudy()
    level.set("weather.wind_mps", 10.0)
    level.set("weather.heading_deg", 90.0)
    x, y = paint_place(level, 100.0, 1500.0, 200.0)
    assert (float(x), float(y)) == pytest.approx((500.0, 200.0))
    x, y = paint_place(level, TILE_M / 10.0, 1500.0, 200.0)
    assert (float(x), float(y)) == pytest.approx((1500.0, 200.0))


def test_mean_of_the_simulation_is_the_bias():
    """Z05: coverage over the torus is what the knob says, whatever the time."""
    level = cloudy()
    for bias in (0.2, 0.5, 0.8):
        level.set("weather.coverage", bias)
        for time_s in (0.0, 333.0):
            assert weather_map(level, time_s, (0.0, 0.0), "simulated")[..., 0].mean() == pytest.approx(bias, abs=0.03)


def bring_storm(chance=1.0, wind=40.0, heading=55.0):
    level = make_beach()
    for path, value in (("storm.chance", chance), ("storm.start_s", 100.0), ("storm.ragged_m", 1500.0),
                        ("weather.wind_mps", wind), ("weather.heading_deg", heading)):  # fmt: skip
        level.set(path, value)
    return level


@pytest.mark.parametrize(("wind", "heading"), [(8.0, 0.0), (20.0, 123.0), (40.0, 300.0), (90.0, 55.0)])
def test_storm_arrives_at_distance_by_speed(wind, heading):
    """Z23: rain begins at the middle of the map when the wind has brought the front, and ends when it has passed."""
    level = bring_storm(wind=wind, heading=heading)
    due = level.settings.storm.distance_m / wind
    times = 100.0 + np.linspace(0, 3 * due, 301)
    near = np.linspace(-500.0, 500.0, 5)
    x, y = np.meshgrid(near, near)
    rain = np.array([weather_at(level, t, x, y, (0.0, 0.0))[..., 1].mean() for t in times])
    wet = np.nonzero(rain > 0.5)[0]
    assert times[wet[0]] - 100.0 == pytest.approx(due, rel=0.2)
    assert times[wet[-1]] - 100.0 == pytest.approx((level.settings.storm.distance_m + 16_000) / wind, rel=0.2)
    assert rain[0] == rain[-1] == 0
    assert np.abs(np.diff(rain)).max() < 0.35


def test_no_chance_of_a_storm_changes_nothing():
    """Z23: bit for bit."""
    level = bring_storm(chance=0.0)
    plain = make_beach()
    for name in ("wind_mps", "heading_deg"):
        plain.set(f"weather.{name}", getattr(level.settings.weather, name))
    assert np.array_equal(weather_map(level, 700.0, (0.0, 0.0)), weather_map(plain, 700.0, (0.0, 0.0)))


def test_more_chance_rains_on_more():
    """Z23: the area that rains grows with the chance, and so does every place's rain."""
    maps = [weather_map(bring_storm(chance), 700.0, (0.0, 0.0), "simulated")[..., 1] for chance in (0, 0.3, 0.6, 1)]
    areas = [np.mean(rain > 0.5) for rain in maps]
    assert areas[0] == 0
    assert (np.diff(areas) > 0.01).all()
    assert all((b >= a).all() for a, b in pairwise(maps))


def test_paint_keeps_the_storm_off():
    """Z05 Z23: where clear sky is painted whole, it stays clear."""
    level = bring_storm()
    level.set("weather.paint_drifts", False)
    paint(level, Rect(250, 250, 262, 262), 0.1, 0.0, 0.5, 1.0)
    assert weather_at(level, 900.0, 0.0, 0.0, (0.0, 0.0))[1] == 0
    assert weather_at(level, 900.0, 4000.0, 0.0, (0.0, 0.0))[1] > 0.9


def test_storm_has_no_edge_within_34_km():
    """Z23: it is one storm in the world; where the torus turns round it is hidden by the horizon's sky."""
    level = bring_storm()
    made = weather_map(level, 700.0, (0.0, 0.0), "horizon")
    np.testing.assert_allclose(made[:, 0], made[:, -1], atol=0.02)
    np.testing.assert_allclose(made[0], made[-1], atol=0.02)
    assert made[256, :, 1].max() > 0.9


def test_clouds_grow_and_decay_without_a_pulse():
    """Z05 Z22: the sky as a whole stays as it is while every place changes, without jumps; frozen, it drifts."""
    level = cloudy()
    level.set("weather.wind_mps", 0.0)
    skies = np.array([weather_map(level, t, (0.0, 0.0), "simulated")[..., 0] for t in np.arange(0.0, 1500.0, 100.0)])
    assert np.ptp(skies.mean(axis=(1, 2))) < 0.04
    assert np.ptp(skies.std(axis=(1, 2))) < 0.04
    assert np.median(np.ptp(skies, axis=0)) > 0.3
    steps = [weather_map(level, t, (0.0, 0.0), "simulated")[..., 0] for t in (500.0, 501.0)]
    assert np.abs(steps[1] - steps[0]).max() < 0.02
    level.set("weather.evolve", False)
    level.set("weather.wind_mps", TILE_M / 5120)
    level.set("weather.heading_deg", 90.0)
    still = [weather_map(level, t, (0.0, 0.0), "simulated")[..., :3] for t in (0.0, 70.0)]
    np.testing.assert_allclose(still[1], np.roll(still[0], 7, axis=1), atol=1e-5)
