"""The weather map: twin against GPU, order of its stages, its wrap (Z04 to Z06)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level import Rect
from shorewright.level.objects import Camera
from shorewright.level.weather import SIDE, STAGES, TILE_M, paint_place, pulled, weather_map


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
    made = renderer.kept.get("test") or renderer.kept.setdefault("test", weather.WeatherMap(renderer.ctx))
    weather.make_map(frame, made, stage)
    return np.frombuffer(made.texture.read(), np.float16).reshape(SIDE, SIDE, 4).astype(np.float32)


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize("time_s", [0.0, 7 * 86400.0])
def test_gpu_makes_the_map_of_the_twin(renderer, stage, time_s):
    """Z04 Z05 Z06: within what half floats and the texture unit's fractions leave."""
    level = cloudy()
    paint(level, Rect(200, 230, 300, 290), 0.9, 0.6, 0.3, 0.8)
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
