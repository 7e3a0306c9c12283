"""Light in clouds, term by term, against closed forms (Z08, Z10, Z15), and the sun that all share (D29)."""

import numpy as np
import pytest
from scenes import camera
from shorewright.renderer import render
from test_cloud_rays import fan, sky_level, slab

pytestmark = pytest.mark.gl
CONE_M, FAR_M = 35.0 + 60.0 + 100.0 + 170.0 + 290.0, 1300.0  # lib/cloud_light.glsl


def test_beer_and_what_goes_besides_it(renderer):
    """Z08: e^−d, and light scattered many times that thick cloud lets through far better; switched off, all of it."""
    body = "float d = 20.0 * (gl_FragCoord.x - 0.5) / 720.0; out_value = vec4(cloud_beer(d), cloud_diffuse(d), d, 0.0);"
    found, _ = fan(renderer, sky_level(), body)
    beer, diffuse, depth = found[:, :3].astype(np.float64).T
    np.testing.assert_allclose(beer, np.exp(-depth), rtol=1e-4)
    assert (np.diff(diffuse) < 0).all()
    assert diffuse[-1] > 100 * beer[-1]
    np.testing.assert_allclose(diffuse / diffuse[0], 1 / (1 + 0.22 * depth), rtol=1e-4)
    assert (fan(renderer, sky_level(**{"cloud_terms.beer": False}), body)[0][:, 0] == 1).all()


@pytest.mark.parametrize("powder", [1.0, 0.5])
def test_powder_darkens_edges_away_from_the_sun(renderer, powder):
    """Z10: 2 (1 − e^−2d) where the view goes the way of the light, by its knob; 1 towards the sun, and switched off."""
    body = ("float d = 3.0 * (gl_FragCoord.x - 0.5) / 720.0;"
            "out_value = vec4(cloud_powder(d, -1.0), cloud_powder(d, 1.0), d, 0.0);")  # fmt: skip
    away, towards, depth = fan(renderer, sky_level(**{"clouds.powder": powder}), body)[0][:, :3].astype(np.float64).T
    np.testing.assert_allclose(away, 1 + powder * (2 * (1 - np.exp(-2 * depth)) - 1), atol=1e-4)
    assert away[0] < 1 < away[-1]
    assert (towards == 1).all()
    off = {"clouds.powder": powder, "cloud_terms.powder": False}
    assert (fan(renderer, sky_level(**off), body)[0][:, :2] == 1).all()


def test_six_samples_stand_for_their_lengths(renderer):
    """Z15: in even cloud the optical depth to the sun is σ times five pieces and a far one, each with its switch."""
    texts, sun = {"level/clouds.glsl": slab()}, {"light.sun_elevation_deg": 30.0, "clouds.extinction": 0.001}
    depth = "cloud_sun_depth(vec3(0.0), 1600.0, 0.0, {})"
    body = f"out_value = vec4({depth.format('false')}, {depth.format('true')}, 0.0, 0.0);"
    for off, expected_m in (
        ({}, CONE_M + FAR_M),
        ({"cloud_terms.far": False}, CONE_M),
        ({"cloud_terms.cone": False}, FAR_M),
        ({"cloud_terms.cone": False, "cloud_terms.far": False}, 0.0),
    ):
        found, _ = fan(renderer, sky_level(**sun, **off), body, texts=texts)
        np.testing.assert_allclose(found[:, :2], 0.001 * expected_m, rtol=1e-4, atol=1e-7)


def test_cheap_light_keeps_the_picture(renderer):
    """Z15: light without the detail noise, from 0.3 opaque on, is within 6 % of the dear one in the mean."""
    up, bright = camera(z=20.0, pitch=25.0), []
    for on in (True, False):
        level = sky_level(**{"weather.coverage": 0.8, "weather.variety": 0.3, "cloud_terms.cheap_light": on})
        seen = render(level, up, (160, 90), linear=True, renderer=renderer)
        hidden = render(level, up, (160, 90), view="cloud_alpha", linear=True, renderer=renderer)[..., 0] > 0.9
        bright.append(seen[hidden].mean())
    assert hidden.mean() > 0.3
    assert bright[0] == pytest.approx(bright[1], rel=0.06)
    assert bright[0] != bright[1]


def test_clouds_have_the_colour_of_the_sun_that_lights_the_land(renderer):
    """D29: at a low sun they are redder than at noon, as the sun's own light is, and those facing it are brighter."""
    red = {}
    for degrees in (50.0, 3.0):
        values = {"weather.coverage": 0.6, "weather.type": 1.0, "light.sun_elevation_deg": degrees}
        level = sky_level(**values, **{"clouds.cirrus": 0.0, "clouds.alto": 0.0})
        away = camera(z=20.0, pitch=20.0, yaw=level.settings.light.sun_azimuth_deg - 180.0)
        seen = render(level, away, (96, 54), linear=True, renderer=renderer, quality="low")
        hidden = render(level, away, (96, 54), view="cloud_alpha", linear=True, renderer=renderer, quality="low")
        cloud = seen[hidden[..., 0] > 0.9]
        bright = cloud[cloud.sum(-1) > np.quantile(cloud.sum(-1), 0.8)].mean(0)
        red[degrees] = bright[0] / bright[2]
    assert red[3.0] > 1.3 * red[50.0]
