"""A crest dragged by a real mouse in the real window (T07)."""

import pytest

pytestmark = pytest.mark.window


def test_drag_a_crest(drive):
    """T07, T01: pauses, grabs a crest, the bed follows live; one step; time runs on; undo; Esc."""
    found = drive("shape", by="window_fronts.py")
    assert found["tool"] == "front"
    assert found["ran"]
    assert found["highlighted"]
    assert found["paused"]
    assert found["held"]
    assert found["line"]
    assert found["during"] not in (found["start"], found["after"])
    assert found["after"] != found["start"]
    assert found["steps"] == ["Shape front"]
    assert found["left_m"] < 0.5
    assert found["runs"]
    assert found["later_s"] > 0
    assert found["undone"] == found["start"]
    assert found["left_steps"] == 0
    assert found["before_escape"] != found["start"]
    assert found["escaped"] == found["start"]
    assert found["tool_after"] == "front"
    assert found["steps_after"] == 0
    assert found["larger"] > 30


def test_draw_a_crest(drive):
    """T07: Shift draws the line anew; one step."""
    found = drive("anew", by="window_fronts.py")
    assert found["drawing"]
    assert len(found["line"]) >= 3
    assert found["drawn"] == ["Shape front"]
    assert found["drawn_ground"] != found["start"]


def test_what_limits_forbid_is_told(drive):
    """T07: a slope limit leaves the crest short by so many metres."""
    (told, *_) = drive("held", by="window_fronts.py")["forbidden"]
    assert "m short: slope limit" in told
