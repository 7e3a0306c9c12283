"""Point lights (D01)."""

import numpy as np
import pytest
from coasts import make_beach
from scenes import camera
from shorewright.level import Grid, Level
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


NIGHT = {
    "light.body": "moon", "sea.on": False, "shore.on": False, "foam.shore": 0.0, "water.foam": 0.0, "fog.on": False,
    "caustics.on": False, "scatter.on": False, "water.blur": 0.0, "sea.wind_mps": 0.0, "water.bend": 0.0,
    "water.reflections": 0.0,
}  # fmt: skip


def bay(depth_m, **lamp):
    level = Level(Grid(129, 129), np.full((129, 129), -depth_m, np.float32))
    for name, value in NIGHT.items():
        level.set(name, value)
    light = {"x": 64, "y": 64, "z": 4.0, "power_kcd": 5.0, "radius_m": 60.0, "red": 1, "green": 1, "blue": 1}
    level.put_object("lamp", PointLight(id="lamp", **{**light, **lamp}))
    return level


@pytest.mark.gl
def test_lamps_light_the_bed_through_the_water(renderer):
    """D01, H12: a lamp over clear water shows the bed as bright as a dry one but for the water's way there and back."""
    level, look = bay(2.0), camera(x=64.0, y=64.0, z=12.0, yaw=0.0, pitch=-90.0)
    shoot = {"size": SIZE, "time_s": 0.0, "linear": True, "renderer": renderer, "quality": "medium"}
    wet = render(level, look, view="emissive", **shoot).astype(float)
    level.set("water.on", False)
    dry = render(level, look, view="hdr", **shoot).astype(float)
    level.set("water.on", True)
    level.put_object("lamp", None)
    dark = render(level, look, view="emissive", **shoot).astype(float)
    seen = (wet - dark)[20:-20, 30:-30] / dry[20:-20, 30:-30]
    from shorewright.level.water_optics import absorption, backscatter

    water = level.settings.water
    through = np.exp(-(absorption(water) + backscatter(water)) * 2 * 2.0)
    # straight down and up; the surface takes some per cent each way and gives back what the bed throws up again
    assert np.median(seen, axis=(0, 1)) == pytest.approx(through, rel=0.2)
    assert wet.max() > 50 * dark.max()


@pytest.mark.gl
def test_a_long_way_through_water_dims_a_lamp(renderer):
    """D01, H12: the same lamp over deeper water shines less, red the most."""
    look = camera(x=64.0, y=64.0, z=12.0, yaw=0.0, pitch=-90.0)
    shoot = {"size": SIZE, "time_s": 0.0, "linear": True, "renderer": renderer, "quality": "medium"}
    shallow, deep = (
        render(bay(depth, z=6.0 - depth), look, view="emissive", **shoot).astype(float).max(axis=(0, 1))
        for depth in (1.0, 5.0)
    )
    assert deep[0] / shallow[0] < 0.5 * deep[2] / shallow[2]
    assert (deep < shallow).all()
    assert np.isfinite(deep).all()
