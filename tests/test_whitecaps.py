"""Whitecaps on the open sea: as much as the wind makes (L07, D04)."""

import numpy as np
import pytest
from shorewright.level.objects import Camera
from shorewright.renderer import render
from shorewright.renderer.show import Show
from test_glitter import open_sea

pytestmark = pytest.mark.gl


def cover(wind_mps, renderer, height_m=160.0, times=(3.0,), **how):
    level = open_sea(wind_mps)
    level.set("foam.height", 0.0)  # lace on high water comes on top
    place = Camera(id="c", x=128, y=128, z=height_m, yaw_deg=20, pitch_deg=-90, fov_deg=70)
    shoot = {"size": (240, 240), "view": "foam", "linear": True, "renderer": renderer, **how}
    return np.mean([render(level, place, time_s=t, **shoot)[..., 0] for t in times])


@pytest.mark.parametrize("height_m", [160.0, 6000.0])
@pytest.mark.parametrize("wind_mps", [8.0, 16.0])
def test_as_much_is_white_as_was_measured(renderer, wind_mps, height_m):
    """D04: cover within a factor of 1.6 of 3.84e-6 U^3.41 (Monahan & O'Muircheartaigh 1980), from near and far."""
    share = cover(wind_mps, renderer, height_m, times=(3.0, 8.3, 14.1) if height_m < 1000 else (3.0,))
    expected = 3.84e-6 * wind_mps**3.41
    assert expected / 1.6 < share < expected * 1.6


def test_a_light_wind_leaves_the_sea_clean(renderer):
    """D04: no whitecaps up to 3 m/s, none without procedural foam."""
    assert cover(3.0, renderer) == 0
    level = open_sea(3.0)
    place = Camera(id="c", x=128, y=128, z=160.0, yaw_deg=20, pitch_deg=-90, fov_deg=70)
    assert render(level, place, (240, 240), 3.0, "foam", linear=True, renderer=renderer).max() == 0  # nor lace (H18)
    assert cover(16.0, renderer, show=Show.hide("procedural_foam")) == 0
