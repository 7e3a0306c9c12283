"""Settings that another one overrides say so in the panel (T06); what they say is true."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app.idle_settings import idle
from shorewright.level import Settings
from shorewright.level.params import describe
from shorewright.level.timing import period_s
from shorewright.level.waves import surface_at

OTHERS = {"shore.interval_s": 17.0, "timing.blend": 0.9, "timing.least_depth_m": 1.5, "timing.tide_step_m": 0.1}


@pytest.mark.parametrize("source", ["depth", "travel_time", "blend"])
@pytest.mark.parametrize("tide", [False, True])
def test_an_idle_setting_changes_nothing_and_the_others_do(source, tide):
    """T06: by the twin, over a beach."""
    level = make_beach(rows=121, cols=31, cell_m=4.0, slope=0.03)
    level.set("timing.source", source)
    level.set("tide.on", tide)
    x, y = np.full(400, 60.0), np.linspace(20, 460, 400)
    found = idle(level, 140.0)
    assert set(found) <= {row.name for row in describe(Settings)}
    before = surface_at(level, 140.0, x, y).height_m
    for path, value in OTHERS.items():
        section, name = path.split(".")
        was = getattr(getattr(level.settings, section), name)
        level.set(path, value)
        changed = not np.array_equal(surface_at(level, 140.0, x, y).height_m, before)
        assert changed == (path not in found), path
        level.set(path, was)


def test_the_interval_tells_the_period_in_its_place():
    """T06: what stands in the panel is the time between two crests."""
    level = make_beach()
    assert "shore.interval_s" not in idle(level, 0.0)
    level.set("timing.source", "travel_time")
    assert idle(level, 0.0)["shore.interval_s"] == f"{period_s(level, 0.0):.1f} s, the swell's own"
