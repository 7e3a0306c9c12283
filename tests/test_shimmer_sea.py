"""The far sea stands still: no sparkle between frames whose cameras are a millimetre apart (L04)."""

import numpy as np
import pytest
from shorewright.level import Grid, Level
from shorewright.level.objects import Camera
from shorewright.renderer import render

pytestmark = pytest.mark.gl
MOVES = ((0.001, 0, 0), (0, 0.001, 0), (0, 0, 0.001))


# low draws half the sides and its sharpening filter makes two of a single step
@pytest.mark.parametrize(("quality", "limit"), [("low", 3), ("medium", 2)])
@pytest.mark.parametrize(("height_m", "pitch_deg"), [(20.0, -2.0), (200.0, -7.0)])
@pytest.mark.parametrize(("elevation_deg", "exposure_ev"), [(38.0, 13.8), (8.0, 12.9)])
def test_far_sea_does_not_shimmer(renderer, quality, limit, height_m, pitch_deg, elevation_deg, exposure_ev):
    """L04: at 2 km every pixel changes by under 2/255 when the camera moves 1 mm, into the glitter too."""
    level = Level(Grid(129, 129), np.full((129, 129), -60.0, np.float32))
    level.set("light.sun_elevation_deg", elevation_deg)
    level.set("light.exposure_ev", exposure_ev)
    place = Camera(id="c", x=64, y=64, z=height_m, yaw_deg=235.0, pitch_deg=pitch_deg, fov_deg=40)
    shoot = {"size": (480, 270), "time_s": 5.0, "quality": quality, "renderer": renderer}
    at = render(level, place, view="position", **{**shoot, "linear": True})
    away = np.hypot(at[..., 0] - 64, at[..., 1] - 64)
    far = (away > 1700) & (away < 2500)
    assert far.sum() > 400
    first = render(level, place, **shoot).astype(int)
    assert np.ptp(first[far]) > 20  # the sun's path is in it
    for x, y, z in MOVES:
        moved = place.model_copy(update={"x": place.x + x, "y": place.y + y, "z": place.z + z})
        assert np.abs(render(level, moved, **shoot).astype(int) - first)[far].max() < limit
