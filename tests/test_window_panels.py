"""The real window: its panels worked by the mouse (T05 T08 L02 D01 H15 D03 H28)."""

import pytest

pytestmark = pytest.mark.window


def test_panels_and_broken_code(drive):
    """T05, T08: a slider drag is one step; history and timeline go where clicked; a broken panel is outlived."""
    found = drive("panels")
    assert found["steps"] == ["Set shore.range_m"]
    assert found["range_m"] != 5.0
    assert found["steps_after_second"] == 2
    assert found["went_to"] == 1
    assert found["redoable"] == 1
    assert 29 < found["scrubbed_s"] < 31
    assert "the history broke" in found["told"]
    assert found["failures"] == {"History": "RuntimeError: the history broke"}
    assert found["healed"]
    assert "ZeroDivisionError" in found["picture_failed"]
    assert found["picture_healed"]


def test_environments_by_button_and_menu(drive):
    """L02: all of a named light and air is one click and one step."""
    found = drive("light")
    assert found["button"] == "storm"
    assert found["steps"] == ["Storm light"]
    assert found["menu"] == "moonlit"
    assert found["steps_then"] == 2
    assert found["picture"] == ""
    assert found["undone"]
    assert found["sun"][0] > found["sun_before"]
    assert found["sun"][1] > found["sun_lower"]
    assert found["sun_steps"] == ["Turn the sun"]
    assert found["samples"] == 16  # L04: a picture that stands still gathers samples


def test_objects_are_dropped_dragged_renamed_and_deleted(drive):
    """D01, H15: a click drops, a drag is one step, the panel renames, a gradient's stop follows the mouse."""
    found = drive("objects")
    assert found["bad"] == []
    assert found["dropped"] == "lamp-1"
    assert found["tool"] == "lamp"
    assert found["steps"] == ["Place lamp-1"]
    assert abs(found["moved"]) > 1.0
    assert found["steps_moved"] == 2
    assert found["back"]
    assert found["renamed"]
    assert found["in_use"]
    assert found["stop"][0] != found["stop"][1]
    assert found["stop_steps"] == 1
    assert found["deleted"]
    assert found["tool_at_last"] == "brush"
    assert found["same_ground"]


def test_waves_panel_cuts_through_the_pointer(drive):
    """D03, H28: A, B and A − B at this moment along a cut, without a fault in the log."""
    found = drive("waves")
    assert found["samples"] > 100
    assert found["line"] > 0.9
    assert found["ghosts"] == 6
    assert found["band"] > 0.3
    assert found["bad"] == []
