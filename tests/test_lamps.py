"""Point lights (D01)."""

import numpy as np
import pytest
from coasts import make_beach
from scenes import camera
from shorewright.level.objects import PointLight
from shorewright.renderer.offscreen import render

SIZE = (96, 54)
LOOK = camera(x=80.0, y=200.0, z=22.0, yaw=0.0, pitch=-60.0)


def lit(level, renderer, view="point_lights"):
    return render(level, LOOK, SIZE, 0.0, view, linear=True, renderer=renderer)


@pytest.mark.gl
def test_a_lamp_falls_off_with_the_square_of_the_way(renderer):
    """D01: radiance = power · window / d² · cos / π · albedo, less what a rough surface mirrors."""
    level = make_beach(rows=257, slope=0.05)
    lamp = PointLight(id="lamp", x=80, y=208, z=9.0, red=1, green=1, blue=1, power_kcd=5.0, radius_m=40.0)
    level.put_object("lamp", lamp)
    seen = lit(level, renderer)
    albedo, place, normal = (lit(level, renderer, view) for view in ("albedo", "position", "normal"))
    way = np.array([lamp.x, lamp.y, lamp.z]) - place
    away = np.linalg.norm(way, axis=2, keepdims=True)
    cosine = np.clip((way / away * normal).sum(axis=2, keepdims=True), 0, None)
    expected = 5.0 * (1 - (away / 40.0) ** 4) ** 2 / away**2 * cosine / np.pi * albedo
    near = (away[..., 0] < 12) & (cosine[..., 0] > 0.4)
    assert near.sum() > 100
    assert np.median(seen[near] / expected[near]) == pytest.approx(1.0, abs=0.06)
    assert np.percentile(np.abs(seen[near] / expected[near] - 1), 80) < 0.1


@pytest.mark.gl
def test_its_light_ends_at_its_radius_and_none_is_none(renderer):
    """D01: nothing beyond the radius; without lamps the picture is what it was."""
    level = make_beach(rows=257, slope=0.05)
    assert lit(level, renderer).max() == 0
    level.put_object("lamp", PointLight(id="lamp", x=80, y=208, z=6.0, power_kcd=5.0, radius_m=5.0))
    seen, place = lit(level, renderer), lit(level, renderer, "position")
    away = np.linalg.norm(np.array([80, 208, 6.0]) - place, axis=2)
    assert seen[away > 5.05].max() == 0
    assert seen[away < 4].min() > 0


@pytest.mark.gl
def test_sixty_four_lamps_light_land_and_sea(renderer):
    """D01: they move with the clock, statelessly, and count."""
    level = make_beach(rows=257, slope=0.05)
    for n in range(64):
        place = {"x": 20.0 + 15 * (n % 8), "y": 90.0 + 10 * (n // 8), "z": 6.0}
        level.put_object(f"l{n}", PointLight(id=f"l{n}", **place, orbit_m=3.0, radius_m=20.0))
    high = camera(x=80.0, y=60.0, z=60.0, yaw=0.0, pitch=-50.0)
    lamp = level.objects["l0"]
    assert np.allclose(lamp.place(1.0), lamp.place(9.0))  # one turn
    pictures = [render(level, high, SIZE, t, "point_lights", linear=True, renderer=renderer) for t in (0.0, 2.0)]
    assert renderer.stats["lamps"] == 64
    assert not np.array_equal(pictures[0], pictures[1])
    assert all(np.isfinite(picture).all() for picture in pictures)
    sea = render(level, high, SIZE, 0.0, "sea_mask", linear=True, renderer=renderer)[..., 0] > 0.5
    assert pictures[0][sea].max() > 0
