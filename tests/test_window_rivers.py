"""The real window: a river dropped, drawn about, widened, raised, carved by the mouse; a hollow filled (D13)."""

import pytest

pytestmark = pytest.mark.window


def test_a_river_is_worked_by_the_mouse(drive):
    """D13: each drag changes its own numbers of one point and is one step; a slope holds no lake and says so."""
    found = drive("river", by="window_rivers.py")
    assert found["bad"] == []
    assert found["dropped"] == "river-1"
    assert found["downhill"]
    assert found["moved"] == [[[1, 0], [1, 1]], 1]
    assert found["widened"] == [[[1, 2]], 1]
    assert found["raised"] == [[[1, 3]], 1]
    assert found["inserted"] == 1
    assert found["carved"]
    assert found["undone"]
    assert found["tool"]
    assert len(found["dry"]) == 1
