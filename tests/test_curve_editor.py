"""Points of a height curve as the editor moves them (Z03)."""

from itertools import pairwise

import numpy as np
import pytest
from shorewright.app.panels.curve_editor import GAP, MOST, cloud_picture, inserted, moved, removed
from shorewright.level import Settings
from shorewright.level.cloud_profile import KINDS, curve_samples
from shorewright.level.params import replace
from shorewright.level.sky_settings import curve_points

CURVES = tuple(getattr(Settings().clouds, name) for name in KINDS)


def check(curve):
    """What the settings take."""
    return replace(Settings(), "clouds.cumulus", curve).clouds.cumulus


@pytest.mark.parametrize("place", [(-3.0, 7.0), (0.5, 0.5), (2.0, -1.0), (0.1, 0.99)])
def test_a_point_stays_between_its_neighbours(place):
    for number in range(len(curve_points(CURVES[1]))):
        made = curve_points(check(moved(CURVES[1], number, *place)))
        assert len(made) == 5
        assert all(b[0] - a[0] >= GAP - 1e-9 for a, b in pairwise(made))
    assert moved(CURVES[1], 2, 0.2, 0.9)[4:6] == (0.2, 0.9)


def test_a_new_point_lies_on_the_line_and_goes_again():
    made, number = inserted(CURVES[1], 0.5)
    check(made)
    assert curve_points(made)[number][0] == 0.5
    on_line = np.interp(0.5, np.linspace(0, 1, 1001), curve_samples(CURVES[1], 1001))
    assert curve_points(made)[number][1] == pytest.approx(on_line, abs=1e-3)
    assert np.abs(curve_samples(made, 200) - curve_samples(CURVES[1], 200)).max() < 0.08
    assert removed(made, number) == CURVES[1]


def test_there_are_two_points_at_least_and_sixteen_at_most():
    curve = (0.0, 0.0, 1.0, 1.0)
    assert removed(curve, 0) == curve
    for height in np.linspace(0.02, 0.98, 40):
        curve, _ = inserted(curve, float(height))
        check(curve)
    assert len(curve_points(curve)) == MOST
    assert inserted(curve, 0.505) == (curve, -1)
    assert inserted(CURVES[1], CURVES[1][2] + 0.001) == (CURVES[1], -1)


def test_the_picture_shows_each_kind_where_it_is():
    """Stratus lies low and flat, a thunderhead fills the shell; both lighter on top."""
    whiteness = [cloud_picture(CURVES, kind, 90, 28)[..., 0].mean(axis=1) for kind in (0.0, 0.5, 1.0)]
    tops = [int(np.flatnonzero(rows > 0.3).min()) for rows in whiteness]
    assert tops[0] > tops[1] > tops[2]
    assert all(np.isfinite(rows).all() for rows in whiteness)
