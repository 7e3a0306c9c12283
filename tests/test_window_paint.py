"""The real window: what is painted, how, in which shape and where is chosen in the brush's panel (T03)."""

import pytest

pytestmark = pytest.mark.window


def test_layer_mode_shape_and_limit_are_chosen_by_hand(drive):
    """T03: the stroke lands on the layer, within the limit, as one step."""
    found = drive("paint", by="window_paint.py")
    assert found["bad"] == []
    assert (found["brush"], found["onto"], found["mode"]) == ("paint", "shelter", "set")
    assert found["added"] == "height_m 0..10 ~1"
    assert found["limit"] == "height_m -0.2.."
    assert found["alpha"] == "ring"
    assert found["steps"] == ["Set shelter"]
    assert found["painted"] > 20
    assert found["lowest"] >= -0.201
