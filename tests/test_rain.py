"""Rain and snow at a place: closed forms, and the twin against the GPU (Z18, Z24)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level import Rect
from shorewright.level.objects import Camera
from shorewright.level.rain import rain_at, rain_rate
from shorewright.level.settings import Weather
from shorewright.renderer import render

CAMERA = Camera(id="there", x=80.0, y=-400.0, z=900.0, yaw_deg=0, pitch_deg=-35, fov_deg=70)


def rainy(temperature_c=14.0):
    level = make_beach()
    for path, value in (("clouds.on", True), ("weather.temperature_c", temperature_c), ("weather.rain_mm_h", 12.0)):
        level.set(path, value)
    level.write("weather", Rect(0, 0, 512, 512), np.array([0.8, 1, 0.5, 1, 1, 1], np.float32))
    return level


def test_rates_have_a_closed_form():
    """Z18 Z24: all of it where precipitation is 1, none in clear sky; the sum is the same whatever falls."""
    weather = Weather(rain_mm_h=10.0, temperature_c=14.0, snow_below_c=1.0)
    rain, snow = rain_rate(weather, np.array([0.7, 1.0, 0.35, 0.0]), np.array([1.0, 1.0, 1.0, 1.0]), 0.0)
    np.testing.assert_allclose(rain, [10, 10, 5, 0])
    np.testing.assert_allclose(snow, 0)
    heights = np.linspace(0, 4000, 200)
    rain, snow = rain_rate(weather, 0.9, 0.5, heights)
    np.testing.assert_allclose(rain + snow, 5.0)
    assert (np.diff(snow) >= 0).all()
    assert np.interp(2.5, snow, heights) == pytest.approx(13 / 6.5 * 1000, abs=1)  # 13 °C colder: half and half
    assert heights[np.argmax(snow > 0)] == pytest.approx(12 / 6.5 * 1000, abs=25)
    assert heights[np.argmax(rain == 0)] == pytest.approx(14 / 6.5 * 1000, abs=25)


@pytest.mark.parametrize(("temperature_c", "snows"), [(14.0, False), (-5.0, True)])
def test_it_rains_below_what_is_painted(temperature_c, snows):
    """Z18 Z24: under a whole paint of rain the whole rate falls, as rain or as snow; without clouds nothing does."""
    level = rainy(temperature_c)
    rates = rain_at(level, 60.0, np.array([20.0, 60.0]), np.array([40.0, 50.0]))
    np.testing.assert_allclose(rates[snows], 12.0, rtol=1e-6)
    np.testing.assert_allclose(rates[not snows], 0.0, atol=1e-9)
    level.set("clouds.on", False)
    assert np.max(rain_at(level, 60.0, 20.0, 40.0)) == 0


@pytest.mark.gl
@pytest.mark.parametrize("view", ["rain_rate", "snow_rate"])
def test_gpu_rains_as_the_twin(renderer, view):
    """Z18 Z24: the shader's rate over land and sea is the twin's, but for the map's texels of 137 m."""
    level = rainy(1.3)
    level.write("weather", Rect(0, 0, 512, 512), np.zeros(6, np.float32))
    level.set("weather.precipitation", 0.5)
    dry = {"size": (96, 54), "time_s": 30.0, "quality": "low", "linear": True, "renderer": renderer}
    shown = render(level, CAMERA, view=view, **dry)[..., 0]
    x, y = np.moveaxis(render(level, CAMERA, view="position", **dry).astype(np.float64), -1, 0)[:2]
    there = render(level, CAMERA, view="material", **dry).sum(axis=-1) > 0
    twin = rain_at(level, 30.0, x, y, (CAMERA.x, CAMERA.y))[view == "snow_rate"]
    assert there.mean() > 0.5
    assert np.ptp(twin[there]) > 2
    assert np.abs(shown - twin)[there].mean() < 0.1
    assert np.corrcoef(shown[there], twin[there])[0, 1] > 0.995
