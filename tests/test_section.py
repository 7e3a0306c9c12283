"""The cut through the shore that the Waves panel plots (D03)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level.section import section


def test_the_cut_runs_from_sea_to_land_across_the_contours():
    """D03: on a beach that rises to the north the cut runs north, A − B is the line at this moment."""
    level = make_beach(rows=257, slope=0.05)
    cut = section(level, 2.0, 80.0, 128.0, length_m=160.0, samples=161)
    assert np.allclose(cut.ground_m, cut.along_m * 0.05, atol=1e-3)
    assert cut.surface_m.min() >= cut.ground_m.min()
    assert np.all(cut.surface_m >= cut.ground_m)
    line = cut.a - cut.b
    assert line.max() == pytest.approx(1.0, abs=0.05)
    later = section(level, 3.0, 80.0, 128.0, length_m=160.0, samples=161)
    assert not np.array_equal(line, later.a - later.b)


def test_a_cut_on_flat_ground_is_defined():
    level = make_beach(slope=0.0)
    level.write("height", level.grid.rect, -3.0)
    assert np.isfinite(section(level, 0.0, 60.0, 60.0).surface_m).all()
