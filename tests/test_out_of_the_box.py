"""A coast with nothing painted shows waves, current, foam and wet sand by itself (D41)."""

import numpy as np
import pytest
from shorewright.level import Grid, Level
from shorewright.level.objects import Camera
from shorewright.renderer.offscreen import render

pytestmark = pytest.mark.gl
ABOVE = Camera(id="above", x=128, y=70, z=110, yaw_deg=0, pitch_deg=-70, fov_deg=60)

# share of the sea's pixels where a mask is over its threshold: view, threshold, least, most
BOUNDS = (
    ("wave_line", 0.2, 0.005, 0.5),
    ("foam", 0.3, 0.01, 0.6),
    ("flow_speed", 0.05, 0.1, 1.0),
)
SHORE_M = {"sand": 140, "cove": 200, "flat": 140}  # north, where x is 128


def coast(kind: str) -> Level:
    """Bare ground: a sand beach, a rocky cove, a shallow flat."""
    y, x = np.mgrid[0:257, 0:257].astype(np.float64)
    height = (y - 140) * 0.05
    if kind == "cove":
        height = (y - 150 - 50 * np.cos((x - 128) / 45)) * 0.09
        for at_x, at_y in ((100, 90), (150, 110), (170, 80)):
            height += 9 * np.exp(-((x - at_x) ** 2 + (y - at_y) ** 2) / 60)
    if kind == "flat":
        height = np.where(y < 60, (y - 60) * 0.1 - 1.2, (y - 140) * 0.015)
    return Level(Grid(257, 257), height.astype(np.float32))


@pytest.mark.parametrize("kind", ["sand", "cove", "flat"])
def test_every_mask_covers_its_share(kind, renderer):
    level = coast(kind)

    def seen(view, t):
        return render(level, ABOVE, (160, 120), t, view, quality="low", linear=True, renderer=renderer)[..., 0]

    sea = seen("material", 4.0) == np.float32(0.1)
    assert 0.2 < sea.mean() < 0.95
    for view, threshold, least, most in BOUNDS:
        shares = [(seen(view, t)[sea] > threshold).mean() for t in (4.0, 7.0)]
        assert least < np.mean(shares) < most, (view, shares)
    close = ABOVE.model_copy(update={"y": SHORE_M[kind] - 28, "z": 9, "pitch_deg": -40})
    lines = render(level, close, (160, 120), 4.0, "caustics", quality="low", linear=True, renderer=renderer)[..., 0]
    bed = lines > 0
    assert 0.02 < (lines[bed] > 0.36).mean() < 0.6  # the mean is 0.3
    sand = ~sea
    wet = seen("wetness", 4.0)[sand]
    assert 0.005 < (wet > 0.5).mean() < 0.85  # the swash crosses a flat nearly all the way
