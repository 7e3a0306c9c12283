"""The baked small waves as they reach the normal (H16)."""

import numpy as np
import pytest
from shorewright.level import Grid, Level
from shorewright.level.objects import Camera
from shorewright.renderer.look import ripple_slopes

SIZE = (128, 128)


def open_sea(wind_mps, **sea):
    level = Level(Grid(513, 513), np.full((513, 513), -60.0, np.float32))
    for name, value in {"wind_mps": wind_mps, **sea}.items():
        level.set(f"sea.{name}", value)
    return level


def slopes(renderer, level, x, y, t=3.0, view="ripples", z=5.0):
    """Slope east and north seen from z m straight above a place, `(rows, cols, 2)`."""
    look = Camera(id="c", x=x, y=y, z=z, yaw_deg=0, pitch_deg=-90, fov_deg=60)
    renderer.draw(level, look, SIZE, t, view, quality="medium")
    normal = renderer.read(linear=True).astype(np.float64)
    return -normal[..., :2] / normal[..., 2:]


@pytest.mark.gl
def test_ripples_have_the_mean_square_slope_of_the_wind(renderer):
    """H16: close up they carry what Cox & Munk (1954) leave to them, along the wind and across."""
    level = open_sea(6.0, on=False)
    places = [(40.0 + 29.3 * n, 60.0 + 53.7 * (n % 5)) for n in range(15)]
    seen = np.concatenate([slopes(renderer, level, *place, z=2.0) for place in places])
    heading = np.radians(level.settings.sea.swell_heading_deg)
    along = seen @ [np.sin(heading), np.cos(heading)]
    across = seen @ [np.cos(heading), -np.sin(heading)]
    expected = ripple_slopes(level.settings.sea, level.settings.level.seed)
    assert [np.mean(along**2), np.mean(across**2)] == pytest.approx(expected, rel=0.15)


@pytest.mark.gl
def test_they_lie_on_the_water_before_it_is_deformed(renderer):
    """H16: mapped by undeformed xy: on the flat sea the same slopes stand where the waves came from."""
    flat, waves = open_sea(5.0, on=False), open_sea(5.0, swell_m=1.2, swell_steepness=0.9)
    seen = slopes(renderer, waves, 256.0, 256.0)
    look = Camera(id="c", x=256.0, y=256.0, z=5.0, yaw_deg=0, pitch_deg=-90, fov_deg=60)
    renderer.draw(waves, look, SIZE, 3.0, "before", quality="medium")
    before = renderer.read(linear=True)[..., :2].astype(np.float64)
    renderer.draw(waves, look, SIZE, 3.0, "after", quality="medium")
    moved = before - renderer.read(linear=True)[..., :2]
    assert np.hypot(*np.moveaxis(moved, -1, 0)).mean() > 0.2
    # the flat sea under a camera that sees the same undeformed middle
    middle = before[SIZE[1] // 2, SIZE[0] // 2]
    still = slopes(renderer, flat, *middle)
    rows = slice(SIZE[1] // 2 - 3, SIZE[1] // 2 + 3)
    gain = np.sqrt(
        ripple_slopes(waves.settings.sea, 7).sum() / ripple_slopes(flat.settings.sea, 7).sum()
    )  # waves carry part of the wind's slope
    a, b = seen[rows, rows].mean(axis=(0, 1)), still[rows, rows].mean(axis=(0, 1)) * gain
    other = slopes(renderer, flat, 256.0, 256.0)[rows, rows].mean(axis=(0, 1)) * gain
    assert np.hypot(*(a - b)) < 0.5 * np.hypot(*(a - other))
