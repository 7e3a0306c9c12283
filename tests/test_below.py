"""Rows that can show water are drawn, the others left alone, and no pixel of water is missed (H12, H17)."""

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.level.waves import largest_height_m
from shorewright.renderer.below import HIGHEST_M, low_m, water_rows
from shorewright.renderer.views import find_view

SIZE = (96, 54)


def frame_of(renderer, level, look):
    return renderer.prepare(level, look, SIZE, 3.0, find_view("final"), None, "medium", None)


@pytest.mark.gl
def test_rows_end_at_the_horizon_unless_waves_may_top_the_camera(renderer):
    """H12: half of a level look, all of a look down, all from a camera among the waves."""
    level = coast()
    looks = [(20.0, 0.0), (20.0, -89.0), (20.0, 40.0), (0.5 * largest_height_m(level), 0.0)]
    rows = [water_rows(frame_of(renderer, level, camera(z=z, pitch=pitch)), SIZE[1]) for z, pitch in looks]
    assert 27 <= rows[0] <= 31
    assert rows[1] == SIZE[1]
    assert rows[2] <= 2
    assert rows[3] == SIZE[1]
    assert low_m(frame_of(renderer, level, camera(z=2.5))) < 2.5
    assert low_m(frame_of(renderer, level, camera(z=0.2))) == HIGHEST_M


@pytest.mark.gl
@pytest.mark.parametrize("pitch", [-30.0, -8.0, 5.0])
@pytest.mark.parametrize("z", [2.2, 8.0, 60.0])
def test_the_picture_is_that_of_all_rows(renderer, monkeypatch, z, pitch):
    """H12, H17: what is left out would have changed nothing."""
    level, look = coast(rock=8.0), camera(z=z, pitch=pitch, y=40.0)
    renderer.draw(level, look, SIZE, 3.0, "hdr", quality="medium")
    some = renderer.read(linear=True)
    monkeypatch.setattr("shorewright.renderer.passes.plate.water_rows", lambda frame, rows: rows)
    monkeypatch.setattr("shorewright.renderer.passes.light.water_rows", lambda frame, rows: rows)
    monkeypatch.setattr("shorewright.renderer.passes.reflections.water_rows", lambda frame, rows: rows)
    renderer.draw(level, look, SIZE, 3.0, "hdr", quality="medium")
    whole = renderer.read(linear=True)
    difference = np.abs(some - whole).max(axis=2)
    assert (difference > 0.02 * whole.max()).mean() < 0.002
