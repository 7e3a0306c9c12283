"""The real window: weather painted, imported, bent, chosen; storms and shots (T04 Z03 D36)."""

import numpy as np
import pytest
from shorewright.io.images import write_image

pytestmark = pytest.mark.window


def test_weather_is_painted_on_the_sky_and_on_the_map(drive):
    """T04: strokes begin where the pointer meets the shell of clouds, or on the panel's map; both are undone."""
    found = drive("weather", by="window_weather.py")
    assert found["bad"] == []
    assert found["brush"] == "weather"
    assert found["over_land"] == found["start"]
    assert found["pointed"] is None
    assert found["targets"] == [0.9, 1.0, 1.0]
    assert 1300 < found["ring"][2] < 1600
    assert len({found["start"], found["during"], found["after"], found["on_map"]}) == 4
    assert found["steps"] == ["Paint weather"]
    assert found["undone"] == found["undone_at_last"] == found["start"]
    assert found["redone"] == found["after"]
    assert found["map_steps"] == ["Paint weather", "Paint weather"]
    assert found["map_pointer"] is not None
    assert found["taken"] == pytest.approx(0.9, abs=0.02)
    assert found["took_steps"] == 2
    assert 20_000 < found["zoomed_m"] < 60_000


def test_skies_by_dialog_and_curves_by_mouse(drive):
    """Z03, T04: what is wrong with a map is told in the dialog; each import, drag, point is one step."""
    values = np.random.default_rng(1).integers(0, 256, (64, 96, 3)).astype(np.uint8)
    values[:, 48:] = 255
    write_image(drive.path.parent / "cut.png", values, data=True)
    found = drive("skies", by="window_weather.py")
    assert "'q'" in found["error"]
    assert any("stretched" in line for line in found["told"])
    assert found["steps"] == ["Weather map cut.png"]
    assert found["painted"] == 16
    assert found["written"]
    assert found["drag_steps"] == 1
    before, dragged = found["before"], found["dragged"]
    assert dragged[4] == pytest.approx(before[4] + 0.08, abs=0.02)
    assert dragged[5] == pytest.approx(before[5] - 0.3, abs=0.03)
    assert dragged[:4] + dragged[6:] == before[:4] + before[6:]
    assert len(found["added"]) == len(before) + 2
    assert found["add_steps"] == 2
    assert found["removed"] == dragged
    assert found["remove_steps"] == 3
    assert found["undone"]
    assert found["above"] == found["sky_above"]


def test_weather_storms_and_shots_by_mouse_and_menu(drive):
    """D36 Z23 Z20 Z25: each is a step to undo; marks on the timeline are dragged; what is covered is told."""
    found = drive("story", by="window_weather.py")
    assert found["bad"] == []
    assert found["menu"] == "gale"
    assert found["menu_steps"] == ["Gale weather"]
    assert found["menu_undone"]
    assert found["filled"] == 1.0
    assert found["panel"] == "calm"
    assert found["panel_steps"] == ["Paint weather", "Calm weather"]
    assert "all of the sky is painted; the preset shows only once paint is erased" in found["told"]
    assert found["panel_undone"]
    assert found["storm"] == [True, 1.0, 12.0]
    assert found["storm_ended"][1] == 0.0
    assert found["storm_steps"] == ["Bring a storm", "End the storm"]
    assert found["storm_undone"]
    assert found["made"] == [found["made_at"], found["made_at"] + 20] == [12.0, 32.0]
    assert found["taken"] == "shot-1"
    assert found["skies"] == 1
    assert found["end"] == [12.0, pytest.approx(42, abs=0.5)]
    assert found["start"] == [pytest.approx(6, abs=0.5), found["end"][1]]
    assert found["moved"] == pytest.approx([at + 5 for at in found["start"]], abs=0.5)
    assert found["moved"][1] - found["moved"][0] == pytest.approx(found["start"][1] - found["start"][0], abs=0.011)
    assert found["end_steps"] == found["start_steps"] == found["moved_steps"] == 1
    assert found["clock"] == 12.0
    assert found["clicked"] == pytest.approx(20, abs=0.3)
    assert found["clicked_steps"] == 1
    assert found["back"] == [found["start"], found["end"], found["made"]]
    assert found["renamed"] == found["unremoved"] == found["unrenamed"] == found["made"]
    assert found["in_hand"] == "dawn"
    assert found["shown"] == ["dawn"]
    assert found["button"]
    assert found["removed"] == found["unmade"] == []
    assert found["steps_left"] == 0
    assert found["hour"] == "21 June, 18:20"
