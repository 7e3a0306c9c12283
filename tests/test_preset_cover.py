"""What is told when a preset acts on a sky that paint or a shot makes (D36, T04, Z20)."""

import numpy as np
import pytest
from shorewright import io
from shorewright.app.actions import ACTIONS
from shorewright.app.commands import pictures
from shorewright.app.session import Session
from shorewright.level import Rect
from shorewright.level.preset_cover import covered, painted_share
from shorewright.level.weather_presets import SKY, WEATHERS
from test_weather import cloudy, paint


@pytest.fixture
def session():
    with Session(cloudy()) as made:
        yield made


def test_share_is_that_of_the_weights():
    """T04: a quarter of the sky at half weight is an eighth; nothing where paint does not count."""
    level = cloudy()
    assert painted_share(level) == 0
    paint(level, Rect(0, 0, 256, 256), 0.5, 0.5, 0.5, 0.5)
    assert painted_share(level) == pytest.approx(0.125, abs=1e-3)
    level.set("weather.painted", False)
    assert painted_share(level) == 0


def test_a_preset_over_paint_is_told(session):
    """D36: menu and script alike, weather and light alike; a little paint and other settings say nothing."""
    level = session.level
    paint(level, Rect(0, 0, 20, 20), 0.5, 0.5, 0.5, 1.0)
    ACTIONS["weather.calm"].run(session)
    assert session.notes == []
    paint(level, Rect(0, 0, 256, 512), 0.5, 0.5, 0.5, 1.0)
    ACTIONS["weather.snow"].run(session)
    assert session.notes == ["50 % of the sky is painted; the preset shows only where it isn't"]
    session.notes.clear()
    session.run({"version": 1, "actions": [{"do": "set_all", "label": "Gale", "values": WEATHERS["gale"].values}]})
    ACTIONS["light.storm"].run(session)
    assert len(session.notes) == 2
    session.notes.clear()
    session.set_all("Two", {"weather.coverage": 0.1, "sea.swell_m": 0.2})
    session.undo()
    assert session.notes == []
    paint(level, Rect(0, 0, 512, 512), 0.5, 0.5, 0.5, 1.0)
    assert covered(level, SKY) == ["all of the sky is painted; the preset shows only once paint is erased"]


def test_a_shot_that_is_the_sky_is_told(session):
    """Z20: while it is whole, for the camera that has it."""
    session.shot_add("dawn", 10.0, 30.0, 5.0, camera="there")
    assert covered(session.level, SKY, 12.0, "there") == []
    assert covered(session.level, SKY, 20.0, "elsewhere") == []
    (told,) = covered(session.level, SKY, 20.0, "there")
    assert "shot dawn is all of the sky" in told


def test_the_command_line_tells_it(tmp_path, capsys):
    """D36: a note on stderr when --weather meets paint."""
    level = cloudy()
    paint(level, Rect(0, 0, 512, 512), 0.5, 0.5, 0.5, 1.0)
    io.write_level(level, tmp_path / "a.shore")
    pictures._level(tmp_path / "a.shore", None, "snow", None)
    assert "all of the sky is painted" in capsys.readouterr().err
    pictures._level(tmp_path / "a.shore", None, None, ["sea.swell_m=0.3"])
    assert capsys.readouterr().err == ""


def test_what_is_covered_changes_little():
    """D36 T04: the sentence is true: under whole paint a preset leaves the map as it was."""
    from shorewright.level.weather import weather_map
    from shorewright.level.weather_presets import weather_settings

    level = cloudy()
    paint(level, Rect(0, 0, 512, 512), 0.5, 0.25, 0.75, 1.0)
    before = weather_map(level, 3.0, (0.0, 0.0))
    level.set_settings(weather_settings(level.settings, "gale"))
    np.testing.assert_array_equal(weather_map(level, 3.0, (0.0, 0.0)), before)
