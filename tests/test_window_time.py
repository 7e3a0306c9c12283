"""The real window: the clock by hand, probes, the timing read on the water (T05 T06)."""

import pytest
from shorewright import io
from shorewright.level.next_crest import next_crest

pytestmark = pytest.mark.window


def test_time_is_worked_by_hand(drive):
    """T05: a marker made, dragged, jumped to and deleted; steps by waves."""
    found = drive("time_by_hand", by="window_time.py")
    assert found["marked"] == [12.0]
    assert found["wave"] == pytest.approx(21.0)
    assert found["tenth"] == pytest.approx(12.9)
    assert found["dragged"] == pytest.approx(24.0, abs=0.5)
    assert found["drag_steps"] == 1
    assert found["jumped"] == found["dragged"]
    assert found["selected"] == "marker-1"
    assert found["deleted"]
    assert found["back"]
    assert found["bad"] == []


def test_probes_are_dropped_and_drawn(drive):
    """T06: two clicks, two lines; the form for crest times."""
    found = drive("water_probes", by="window_time.py")
    assert found["probes"] == ["probe-1", "probe-2"]
    assert found["drawn"] == 2
    assert found["moves"] > 0.1
    assert found["asked"] == "EventForm"
    assert found["bad"] == []


def test_the_timing_is_read_on_the_water(drive):
    """T06: overlays by key and box, the sentence under the pointer equals the level's, a hot spot is gone to."""
    found = drive("timing", by="window_time.py")
    assert found["bad"] == []
    assert found["on"] == ["breakers", "crests", "isochrones", "speed"]
    assert found["drawn"]
    level = io.read_level(drive.path)
    expected = next_crest(level, 14.0, *found["at"])
    assert found["said"][0].lower() == expected.sentence
    assert expected.type in found["said"][1]
    assert found["labels"] > 3
    assert found["spots"][0] == "too_fast"
    assert found["moved"]
    assert len(found["steps"]) == 1  # the setting alone
