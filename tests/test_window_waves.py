"""The real window: a wave object dropped, moved, turned, sized, bent and aimed by the mouse (H08 H09)."""

import pytest

pytestmark = pytest.mark.window


def test_a_wave_object_is_worked_by_the_mouse(drive):
    """H08, H09: each drag changes its own field and is one step; the fit is one more."""
    found = drive("wave_object", by="window_waves.py")
    assert found["bad"] == []
    assert found["dropped"] == "wave-1"
    assert found["steps"] == ["Place wave-1"]
    assert found["moved"] == [["x", "y"], 1]
    assert found["turned"] == [["yaw_deg"], 1]
    assert found["size"] == [["radius_m"], 1]
    assert found["bend"] == [["curvature"], 1]
    assert found["aim"] == [["yaw_deg"], 1]
    assert abs(found["fitted"]) < 0.1  # before a straight beach
    assert found["fit_steps"] == 1
