"""Fronts shaped on real coasts, recorded: the cove and Pyramid Rock (T07)."""

from pathlib import Path

import numpy as np
import pytest
from shorewright import io
from shorewright.app.session import Session
from shorewright.level.arrival import shore_at
from shorewright.level.shaping import FRAME_S
from shorewright.level.shaping_lines import crest_near, dragged, phase_at

COVE = Path(__file__).parents[1] / "sample_levels" / "cove.shore"


def drag(level, t, at, by, radius_m):
    """Shape through a session; (seconds, metres) that the crest is off on 95 % of the line, by the real sea."""
    wave, crest = crest_near(level, t, at, radius_m)
    grabbed = crest[np.hypot(*(crest - at).T).argmin()]
    line = dragged(crest, grabbed, by, radius_m)
    with Session(level) as session:
        shaped = session.shape_front(line, radius_m, t=t, at=grabbed, wave=wave)
        phase, _ = phase_at(level, t, *shaped.line.T)
        interval_s = shore_at(level, t).interval_s
    late_s = np.abs(phase.v - wave) * interval_s
    speed_mps = 1 / np.maximum(np.hypot(phase.dx, phase.dy) * interval_s, 1e-3)
    return np.quantile(late_s, 0.95), np.quantile(np.maximum(late_s - FRAME_S, 0) * speed_mps, 0.95)


@pytest.mark.parametrize(("at", "by", "radius_m"), [((600, 380), (0, -4), 20), ((500, 360), (0, -25), 80)])
def test_the_cove(at, by, radius_m):
    """T07: half a cell among rocks, a river's mouth and noise."""
    level = io.read_level(COVE)
    assert drag(level, 14.0, at, by, radius_m)[1] < 0.5 * level.grid.cell_m


def test_the_cove_by_travel_time():
    """T07: a quarter of a second."""
    level = io.read_level(COVE)
    level.set("timing.source", "travel_time")
    assert drag(level, 14.0, (560, 330), (0, -14), 80)[0] < 0.25


def test_pyramid_rock(data_dir):
    """T07: a coast as it was measured."""
    source = data_dir / "coasts" / "pyramidrock_hi.celeris.txt"
    with Session.imported(source, cell_m=(2, 1), rows="north-first") as session:
        level = session.level
        assert drag(level, 14.0, (550, 300), (3, -8), 40)[1] < 0.5 * level.grid.cell_m
