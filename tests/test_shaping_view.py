"""The view of what forbids to shape a front (T07)."""

import numpy as np
import pytest
from shorewright.level import Grid, Level
from shorewright.level.objects import Camera
from shorewright.level.shaping_limits import SLOPE_DEG, SlopeLimit
from shorewright.renderer import render


@pytest.mark.gl
@pytest.mark.parametrize("source", ["depth", "travel_time"])
def test_red_is_where_the_slope_limit_holds(renderer, source):
    """T07: on a beach with a steep bank under water, colours say what SlopeLimit says; the border is red, land grey."""
    y, x = np.mgrid[0:161, 0:201].astype(np.float64)
    height = (y - 120) * 0.04 + 5.0 * (np.tanh((x - 100) / 2.0) - 1.0) * (y < 90)
    level = Level(Grid(161, 201), np.minimum(height, 3.0).astype(np.float32))
    level.set("timing.source", source)
    camera = Camera(id="c", x=100.0, y=80.0, z=260.0, yaw_deg=0.0, pitch_deg=-90.0, fov_deg=34.0)
    options = {"size": (120, 90), "quality": "low", "renderer": renderer, "linear": True}
    shown = render(level, camera, view="shaping_limits", **options)
    at = render(level, camera, view="position", **options)
    red, green = shown[..., 0] > 3 * shown[..., 1], shown[..., 1] > 2 * shown[..., 0]
    col, row = (np.rint(at[..., i]).astype(int) for i in (0, 1))
    inside = (col > 8) & (col < 192) & (row > 8) & (row < 152)
    col, row = np.clip(col, 0, 200), np.clip(row, 0, 160)
    depth = -level.height.astype(np.float64)
    steep = SlopeLimit(depth, 1.0, level.settings.shore.smooth_m, SLOPE_DEG)
    used = steep.was[row, col] / steep.steepest
    wet = inside & (depth[row, col] > 0.3)
    bank, flat = wet & (used > 1.3), wet & (used < 0.15)
    assert bank.sum() > 20
    assert flat.sum() > 1000
    assert red[bank].mean() > 0.95
    assert green[flat].mean() > 0.98
    rim = (at[..., 0] > 0.5) & (at[..., 0] < 3.0) & (row < 110)
    assert rim.sum() > 20
    assert red[rim].all()
    land = inside & (depth[row, col] < -0.3)
    assert np.ptp(shown[land], axis=1).max() < 1e-3
