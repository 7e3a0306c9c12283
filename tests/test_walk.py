"""Wading depth over a period: asked only where waves decide, the same as asking everywhere (T09)."""

import numpy as np
import pytest
from exports import slope_level
from shorewright.level import walk
from shorewright.level.objects import River
from shorewright.level.timing import period_s
from shorewright.level.waves import sea_at

MOST_M = 4.0


def asked_everywhere(level, x, y):
    """Held to 0 … MOST_M."""
    times = np.arange(walk.MOMENTS) / walk.MOMENTS * period_s(level, 0.0)
    depth = np.array([sea_at(level, float(t), x, y).height_m for t in times]) - level.height
    return np.clip(depth.min(0), 0, MOST_M), np.clip(depth.max(0), 0, MOST_M)


@pytest.mark.parametrize("source", ["depth", "travel_time"])
def test_wading_depth_is_that_of_the_sea(source):
    level = slope_level(60, 50, cell_m=2.0)
    level.set("timing.source", source)
    x, y = np.meshgrid(np.arange(50) * 2.0, np.arange(60) * 2.0)
    found, wanted = walk.wading_m(level, level.height, x, y, MOST_M), asked_everywhere(level, x, y)
    for mine, theirs in zip(found, wanted, strict=True):
        assert mine == pytest.approx(theirs, abs=1e-5)
    assert (found[1] - found[0]).max() > 0.2  # waves count
    assert {0.0, MOST_M} < set(found[0].ravel())


def test_one_wades_through_rivers_high_over_the_sea():
    level = slope_level(60, 50)
    river = River(id="r", x=5, y=55, points=((0, 0, 8, 14.0, 1), (30, 0, 8, 13.8, 1)), reach_m=0)
    level.put_object("r", river)
    x, y = np.meshgrid(np.arange(50.0), np.arange(60.0))
    least, most = walk.wading_m(level, level.height, x, y, MOST_M)
    deep = 13.9 - level.height[55, 20]
    assert deep > 0.5
    assert least[55, 20] <= deep <= most[55, 20] + 0.2
    assert most[45, 20] == 0
