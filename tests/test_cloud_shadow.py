"""Shadows of clouds in volume, and the light of a sky that they hide part of (Z17, Z19)."""

import math

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.level.weather import drift_m
from shorewright.renderer import Show, render
from shorewright.renderer.overcast import overcast
from shorewright.renderer.passes.cloud_shadow import REACH_M
from shorewright.renderer.sky_light import LUMINANCE, sky_light

pytestmark = pytest.mark.gl
SIZE = (48, 27)
SLAB = (("clouds.on", True), ("cloud_terms.height", False), ("cloud_terms.erode", False), ("clouds.thin", 0.0),
        ("weather.coverage", 1.0), ("weather.variety", 0.0), ("clouds.extinction", 0.001), ("clouds.base_m", 1000.0),
        ("clouds.top_m", 2000.0))  # fmt: skip


def clouded(*values):
    level = coast(slope=0.0)
    for path, value in (("clouds.on", True), *values):
        level.set(path, value)
    return level


def shadow_map(renderer, level, time_s=0.0, **options):
    renderer.draw(level, camera(), SIZE, time_s=time_s, quality="low", **options)
    made = renderer.kept["cloud_shadow"]
    return np.frombuffer(made.texture.read(alignment=1), np.float16).reshape(*made.size).astype(np.float64)


def test_a_closed_layer_lets_through_what_beer_says(renderer):
    """Z19: exp(−σ L / sin elevation) through a layer that is dense everywhere."""
    for elevation in (90.0, 35.0):
        level = clouded(*SLAB, ("light.sun_elevation_deg", elevation))
        through = shadow_map(renderer, level)
        expected = math.exp(-0.001 * 1000.0 / math.sin(math.radians(elevation)))
        assert abs(np.median(through) - expected) < 0.02


def test_shadows_move_with_the_wind(renderer):
    """Z19, Z07: after a while the map is the old one, moved by as much as the air has."""
    still = (("weather.evolve", False), ("cloud_terms.evolve", False), ("weather.horizon_start_m", 34_000.0))
    level = clouded(*still, ("weather.coverage", 0.6), ("weather.heading_deg", 90.0), ("weather.wind_mps", 10.0))
    before = shadow_map(renderer, level)
    texel = 2 * REACH_M / len(before)
    after = shadow_map(renderer, level, time_s=8 * texel / 10.0)
    assert np.allclose(drift_m(level, 8 * texel / 10.0), (8 * texel, 0), atol=1e-6)
    assert before.std() > 0.1
    assert np.abs(after[:, 8:] - before[:, :-8]).mean() < 0.2 * np.abs(after - before).mean()


def test_shadows_fall_where_the_sun_says(renderer):
    """Z19: with a lower sun in the south the shadows are the same clouds', further north."""
    level = clouded(("weather.coverage", 0.5), ("light.sun_azimuth_deg", 180.0), ("clouds.top_m", 1800.0),
                    ("clouds.shear_m", 0.0))  # fmt: skip
    maps = []
    for elevation in (70.0, 50.0):
        level.set("light.sun_elevation_deg", elevation)
        maps.append(shadow_map(renderer, level))
    texel = 2 * REACH_M / len(maps[0])
    cots = [1 / math.tan(math.radians(e)) for e in (70.0, 50.0)]
    moved = round(1600.0 * (cots[1] - cots[0]) / texel)
    errors = [np.abs(maps[1][12:] - maps[0][12 - n : len(maps[0]) - n]).mean() for n in range(12)]
    assert abs(int(np.argmin(errors)) - moved) <= 1


def test_land_and_sea_are_darker_under_a_cloud(renderer):
    """Z19: the sun is gone from both, and comes back with `clouds.shadows` 0."""
    level = clouded(("weather.coverage", 1.0), ("weather.variety", 0.0), ("cloud_terms.height", False))
    pictures = []
    for shadows in (1.0, 0.0):
        level.set("clouds.shadows", shadows)
        renderer.draw(level, camera(), SIZE, quality="medium")
        pictures.append(renderer.read(linear=True) @ LUMINANCE)
    assert np.median(pictures[0] / pictures[1]) < 0.6


def test_nothing_changes_where_there_are_no_clouds(renderer):
    """Z19: a level without them is the same bytes before and after one with them."""
    plain = coast()
    renderer.draw(plain, camera(), SIZE)
    before = renderer.read()
    shadow_map(renderer, clouded(("weather.coverage", 0.9)))
    renderer.draw(plain, camera(), SIZE)
    assert np.array_equal(before, renderer.read())


def test_a_sky_full_of_clouds_is_soft_and_grey():
    """Z17: the more cloud, the less sun on the whole and the less blue the light from above; the sun itself stays."""
    level = coast()
    level.set("clouds.on", True)
    level.set("weather.variety", 0.0)
    lights = []
    for coverage, rain in ((0.0, 0.0), (0.5, 0.0), (0.95, 0.0), (0.95, 1.0)):
        level.set("weather.coverage", coverage)
        level.set("weather.precipitation", rain)
        lights.append(sky_light(level.settings, 0.0, overcast(level, 0.0, (100.0, 100.0))))
    mean = [light.mean_sun @ LUMINANCE for light in lights]
    assert mean[0] > mean[1] > mean[2]
    assert all(np.array_equal(light.sun, lights[0].sun) for light in lights)
    blue = [light.harmonics[0, 2] / light.harmonics[0, 0] for light in lights]
    assert blue[0] > blue[1] > blue[2]
    assert lights[3].harmonics[0] @ LUMINANCE < lights[2].harmonics[0] @ LUMINANCE


def test_clouds_of_white_light_cannot_be_seen(renderer):
    """Z17: the furnace: with light of 1 from all sides clouds are as bright as the sky."""
    level = clouded(("light.body", "even"), ("weather.coverage", 0.8), ("fog.on", False))
    renderer.draw(level, camera(z=100.0, pitch=40.0), SIZE, quality="low", show=Show.hide("air"))
    image = renderer.kept["clouds"].textures[0]
    light = np.frombuffer(image.read(alignment=1), np.float16).reshape(-1, 4).astype(np.float64)
    assert light[:, 3].min() < 0.1
    assert np.abs(light[:, :3] + light[:, 3:] - 1.0).max() < 1 / 255


def test_the_finished_sky_of_white_light_is_white(renderer):
    """Z17: the furnace, of the picture itself: with its clouds it is the sky without them, to 1/255 of it."""
    level = clouded(("light.body", "even"), ("weather.coverage", 0.7), ("clouds.cirrus", 0.0), ("clouds.alto", 0.0),
                    ("weather.precipitation", 0.0))  # fmt: skip
    shown = {show: render(level, camera(z=100.0, pitch=40.0), SIZE, quality="medium", linear=True, renderer=renderer,
                          show=Show.hide(",".join(("air", "fog", *show)))) for show in ((), ("clouds",))}  # fmt: skip
    assert np.abs(shown[()] / shown[("clouds",)] - 1.0).max() < 1 / 255
    image = renderer.kept["clouds"].textures[0]
    assert np.frombuffer(image.read(alignment=1), np.float16).reshape(-1, 4)[:, 3].min() < 0.1


def test_clouds_end_at_the_horizon_without_a_line(renderer):
    """Z06, Z12: a closed layer's cover falls to nothing before it ends: on and on, by no step over 2/255 a hundredth of
    a degree."""
    high = ("clouds.base_m", 1500.0), ("clouds.top_m", 2500.0), ("clouds.extinction", 0.1)
    level = clouded(*SLAB, *high, ("weather.horizon_start_m", 34_000.0), ("weather.horizon_coverage", 1.0))
    renderer.draw(level, camera(z=30.0, pitch=2.0, fov=5.0), (16, 1000), quality="medium")
    made = renderer.kept["clouds"].textures[0]
    image = np.frombuffer(made.read(alignment=1), np.float16).reshape(made.height, made.width, 4)
    cover = 1.0 - image[..., 3].astype(np.float64).mean(axis=1)
    assert cover[0] < 0.02 < 0.98 < cover[-1]
    assert np.diff(cover).min() > -2e-3
    assert np.abs(np.diff(cover)).max() < 2 / 255


def test_a_calm_sea_mirrors_clouds(renderer):
    """Z17, L02: what the dome holds in a direction, the mirror lobe shows there."""
    level = clouded(("weather.coverage", 0.6), ("fog.on", False), ("clouds.cirrus", 0.0), ("clouds.alto", 0.0))
    renderer.draw(level, camera(), SIZE, quality="low")
    atlas, dome = renderer.kept["lobes"].texture, renderer.kept["cloud_dome"]
    clouds = np.frombuffer(dome.texture.read(alignment=1), np.float16).reshape(dome.size[0], dome.size[0], 4)
    assert clouds[..., 3].min() < 0.1 < 0.9 < clouds[..., 3].max()
    with_clouds = atlas.read(alignment=1)
    up = np.frombuffer(with_clouds, np.float16).reshape(*atlas.size[::-1], 4)[95:97, 95:97, :3].mean((0, 1))
    middle = slice(dome.size[0] // 2 - 1, dome.size[0] // 2 + 1)
    overhead = clouds[middle, middle].astype(np.float64).mean((0, 1))
    clear = renderer.sky.light.table[-1].mean(0)
    np.testing.assert_allclose(up, clear * overhead[3] + overhead[:3], rtol=0.1)
    renderer.draw(level, camera(), SIZE, quality="low", show=Show.hide("clouds"))
    assert atlas.read(alignment=1) != with_clouds
    renderer.draw(level, camera(), SIZE, quality="low")
    assert atlas.read(alignment=1) == with_clouds
