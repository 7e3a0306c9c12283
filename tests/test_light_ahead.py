"""A day that runs fast: the light of the next seconds is worked out beside the pictures and is the same light (Z25)."""

import numpy as np
import pytest
from shorewright.level import Settings
from shorewright.level.params import replace
from shorewright.renderer import light_ahead as ahead
from shorewright.renderer.day_light import day_light
from shorewright.renderer.overcast import Overcast
from shorewright.renderer.sky_light import made, sky_light


@pytest.fixture
def evening(monkeypatch):
    """A minute of it is an hour and more; nothing is known of its light."""
    monkeypatch.setattr(ahead, "_steps", ahead.OrderedDict())
    day_light.cache_clear()
    settings = Settings()
    for name, value in {"sun_from": "date", "hour": 19.0, "day_rate": 600.0}.items():
        settings = replace(settings, f"light.{name}", value)
    return settings


@pytest.mark.parametrize("time_s", [2.0, 14.0])
def test_what_was_asked_for_is_there_before_the_sun(evening, monkeypatch, time_s):
    """Z25: by sun and by moon, once the thread is through no picture of the next seconds works out a step."""
    over = Overcast(0.5, 16.0)
    ahead.light_ahead(evening, time_s, over)
    for future in list(ahead._steps.values()):
        future.result()
    monkeypatch.setattr(ahead, "made", None)
    for moment in np.linspace(time_s, time_s + ahead.AHEAD_S, 40):
        assert sky_light(evening, moment, over).unit
        assert sky_light(evening, moment).unit


def test_light_is_the_same_whoever_works_it_out(evening):
    """Z25: bit for bit, and what waits in the thread's queue is not waited for."""
    sky = ahead.sky_of(evening, None)
    ahead.light_ahead(evening, 2.0, None)
    (step, _), *_ = list(ahead._steps)
    light, here = ahead.step_light(step, sky), made(step, *sky)
    for name in ("sun", "table", "harmonics", "aerial", "above"):
        np.testing.assert_array_equal(getattr(light, name), getattr(here, name))
    late = list(ahead._steps)[-1]
    assert ahead.step_light(*late).elevation_deg == late[0]


def test_a_day_that_stands_asks_for_nothing(evening):
    """Z25: nor does even light."""
    for settings in (replace(evening, "light.day_rate", 0.0), replace(evening, "light.body", "even")):
        ahead.light_ahead(settings, 2.0, None)
    assert not ahead._steps
