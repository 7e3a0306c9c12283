"""Rain and snow as they are drawn: streaks, flakes, curtains (Z18, Z24)."""

import numpy as np
import pytest
from scenes import camera, coast

pytestmark = pytest.mark.gl
SIZE = (160, 90)


def rainy(rate=14.0, *values):
    """Rain everywhere, under a sky that is one cloud; no curtains."""
    level = coast(slope=0.0)
    for path, value in (("clouds.on", True), ("weather.coverage", 0.9), ("weather.variety", 0.0),
                        ("weather.precipitation", 1.0), ("weather.rain_mm_h", rate), ("weather.evolve", False),
                        ("cloud_terms.evolve", False), ("weather.wind_mps", 0.0), ("rain.shafts", 0.0),
                        ("sea.on", False), ("shore.on", False), *values):  # fmt: skip
        level.set(path, value)
    return level


def drops(renderer, level, time_s=3.0, pitch=-10.0):
    """What rain near the camera adds to the picture, its brightness."""
    pictures = []
    streaks = level.settings.rain.streaks
    for amount in (streaks, 0.0):
        level.set("rain.streaks", amount)
        renderer.draw(level, camera(z=20.0, pitch=pitch), SIZE, time_s=time_s, quality="medium")
        pictures.append(renderer.read(linear=True).mean(-1).astype(np.float64))
    level.set("rain.streaks", streaks)
    return np.abs(pictures[0] - pictures[1])


def test_more_rain_has_more_drops(renderer):
    """Z18: none without, and the more falls, the more there are."""
    counts = [(drops(renderer, rainy(rate)) > 0.02).mean() for rate in (0.0, 2.0, 14.0, 60.0)]
    assert counts[0] == 0
    assert 0.001 < counts[1] < counts[2] < counts[3] < 0.5


def test_a_dry_sky_is_the_same_bytes_whatever_rain_is_set_to(renderer):
    """Z18: without precipitation nothing of rain is drawn."""
    level, pictures = rainy(14.0, ("weather.precipitation", 0.0), ("rain.shafts", 1.0)), []
    for mm_h in (0.0, 100.0):
        level.set("weather.rain_mm_h", mm_h)
        renderer.draw(level, camera(), SIZE, time_s=3.0)
        pictures.append(renderer.read())
        assert "rain" not in renderer.stats
    assert np.array_equal(*pictures)


def test_it_snows_in_the_cold(renderer):
    """Z24: drops leave upright traces, flakes are round."""
    upright = {}
    for degrees_c in (14.0, -6.0):
        seen = drops(renderer, rainy(40.0, ("weather.temperature_c", degrees_c)))
        along, across = np.abs(np.diff(seen, axis=0)).mean(), np.abs(np.diff(seen, axis=1)).mean()
        assert seen.max() > 0.02
        upright[degrees_c] = across / along
    assert upright[14.0] > 1.8
    assert upright[-6.0] < 1.4


def test_drops_fall_and_come_again(renderer):
    """Z18: a moment later each trace is further down; the same moment has the same drops."""
    level = rainy(40.0, ("rain.shutter_s", 0.01))
    first = drops(renderer, level, 3.0, pitch=0.0)
    assert np.array_equal(first, drops(renderer, level, 3.0, pitch=0.0))
    later = drops(renderer, level, 3.01, pitch=0.0)
    match = [(first[: 90 - n] * later[n:]).mean() for n in range(12)]
    lift = [(later[: 90 - n] * first[n:]).mean() for n in range(12)]
    assert max(match[1:]) > 1.3 * max(lift[1:])


def test_curtains_hang_under_rain_alone(renderer):
    """Z18: far off the sky below the base is other than without rain, and the same with a dry cloud."""
    changed = []
    for rain in (1.0, 0.0):
        level = rainy(20.0, ("weather.precipitation", rain), ("rain.streaks", 0.0))
        pictures = []
        for shafts in (1.0, 0.0):
            level.set("rain.shafts", shafts)
            renderer.draw(level, camera(z=60.0, pitch=6.0), (48, 27), time_s=3.0, quality="low")
            pictures.append(renderer.read(linear=True))
        changed.append(np.abs(pictures[0] - pictures[1]).max())
    assert changed[0] > 0.05
    assert changed[1] == 0.0
