"""Named weather: what it sets, by name, by menu, by command line (D36, Z23)."""

import pytest
from shorewright.app.actions import ACTIONS
from shorewright.app.session import Session
from shorewright.level import BadInput, Grid, Settings
from shorewright.level.params import get, replace
from shorewright.level.weather_presets import TOUCHED, WEATHERS, weather_of, weather_settings


@pytest.mark.parametrize("name", WEATHERS)
def test_weathers_set_all_they_touch(name):
    """D36: from whatever was set before, a weather gives the same; nothing else moves."""
    row = WEATHERS[name]
    assert tuple(row.values) == TOUCHED
    start = replace(Settings(), "weather.heading_deg", 123.0)
    for other in WEATHERS:
        start = weather_settings(start, other)
    settings = weather_settings(start, name)
    assert weather_of(settings) == name
    for path in TOUCHED:
        settings = replace(settings, path, get(Settings(), path))
    assert settings == replace(Settings(), "weather.heading_deg", 123.0)


def test_unknown_weather_is_refused_and_listed():
    with pytest.raises(BadInput, match=r"'mild'.*calm, breeze"):
        weather_settings(Settings(), "mild")


def test_weathers_are_ordered():
    """D36: the storm has the highest sea, the hardest wind and the most rain, calm the least."""
    for path in ("sea.swell_m", "sea.swell_length_m", "sea.chop_m", "sea.wind_mps", "weather.wind_mps"):
        values = {name: row.values[path] for name, row in WEATHERS.items()}
        assert min(values, key=values.get) == "calm"
        assert max(values, key=values.get) == "storm"
    assert [name for name, row in WEATHERS.items() if row.values["weather.temperature_c"] < 0] == ["snow"]


def test_menu_is_one_step(tmp_path):
    """D36 Z23: a weather and a storm are one undo step each; the storm sets out at the clock's time."""
    with Session.new(Grid(40, 40), spill_root=tmp_path) as session:
        before = session.level.settings
        session.clock.scrub(77.0)
        ACTIONS["weather.gale"].run(session)
        assert weather_of(session.level.settings) == "gale"
        ACTIONS["storm"].run(session)
        storm = session.level.settings.storm
        assert (storm.chance, storm.start_s, session.level.settings.clouds.on) == (1.0, 77.0, True)
        assert len(session.journal.done) == 2
        session.undo()
        session.undo()
        assert session.level.settings == before
