"""The sun's glitter: as wide as Cox & Munk (1954) measured, its energy kept between waves, ripples and roughness (L07)."""

import numpy as np
import pytest
from shorewright.level import Grid, Level
from shorewright.level.objects import Camera
from shorewright.level.settings import Sea
from shorewright.renderer import Renderer, render
from shorewright.renderer.look import ripple_slopes, sun_direction, wave_slopes

pytestmark = pytest.mark.gl
AZIMUTH, ELEVATION = 235.0, 38.0
WATER_F0 = 0.02


@pytest.fixture(scope="module")
def renderer(ctx):
    made = Renderer(ctx)
    yield made
    made.release()


def open_sea(wind_mps, heading_deg=70.0, **sea):
    """Water 60 m deep and nothing else."""
    level = Level(Grid(257, 257), np.full((257, 257), -60.0, np.float32))
    settings = {"wind_mps": wind_mps, "swell_heading_deg": heading_deg, **sea}
    for name, value in settings.items():
        level.set(f"sea.{name}", value)
    level.set("light.sun_azimuth_deg", AZIMUTH)
    level.set("light.sun_elevation_deg", ELEVATION)
    level.set("fog.on", False)
    return level


def facet_density(level, height_m, quality, renderer, times):
    """Slope east and north of the facet that shows the sun, and how many there are by the picture, to a factor.

    Radiance of the glint is E · F(ω) · p(slope) / (4 cos θ_eye cos⁴ θ_facet) (Cox & Munk 1954): solved for p.
    """
    place = Camera(id="c", x=128, y=128, z=height_m, yaw_deg=AZIMUTH, pitch_deg=-ELEVATION, fov_deg=75)
    shoot = {"size": (160, 120), "quality": quality, "linear": True, "renderer": renderer}
    slopes, density = [], []
    sun = sun_direction(AZIMUTH, ELEVATION)
    for t in times:
        glint = render(level, place, time_s=t, view="glint", **shoot)[..., 1].astype(np.float64)
        at = render(level, place, time_s=t, view="position", **shoot).astype(np.float64)
        to_eye = np.array([place.x, place.y, place.z]) - at
        to_eye /= np.linalg.norm(to_eye, axis=-1, keepdims=True)
        half = to_eye + sun
        half /= np.linalg.norm(half, axis=-1, keepdims=True)
        fresnel = WATER_F0 + (1 - WATER_F0) * (1 - (half * to_eye).sum(-1)) ** 5
        p = glint * 4 * to_eye[..., 2] * half[..., 2] ** 4 / fresnel
        seen = to_eye[..., 2] > 0.25
        slopes.append(-half[seen][:, :2] / half[seen][:, 2:])
        density.append(p[seen])
    return np.concatenate(slopes), np.concatenate(density)


def fitted_variance(slopes, density, heading_deg):
    """Mean square slope along and across the wind: a Gaussian laid through the glint by its half height and above."""
    way = np.radians(heading_deg)
    turned = slopes @ np.array([[np.sin(way), -np.cos(way)], [np.cos(way), np.sin(way)]])
    edges = np.linspace(-0.34, 0.34, 18)
    count, _, _ = np.histogram2d(*turned.T, bins=(edges, edges))
    total, _, _ = np.histogram2d(*turned.T, bins=(edges, edges), weights=density)
    mean = total / np.maximum(count, 1)
    middle = 0.5 * (edges[1:] + edges[:-1])
    along, across = np.meshgrid(middle, middle, indexing="ij")
    used = (count > 20) & (mean > 0.4 * np.sort(mean[count > 20])[-5:].mean())
    terms = np.stack([np.ones(used.sum()), along[used] ** 2, across[used] ** 2], -1)
    weight = (mean * np.sqrt(count))[used]
    _, a, c = np.linalg.lstsq(terms * weight[:, None], np.log(mean[used]) * weight, rcond=None)[0]
    return -0.5 / a, -0.5 / c


def cox_munk(wind_mps):
    return 0.00316 * wind_mps, 0.003 + 0.00192 * wind_mps


@pytest.mark.parametrize("quality", ["low", "medium"])
@pytest.mark.parametrize("height_m", [20.0, 200.0])
@pytest.mark.parametrize("wind_mps", [5.0, 10.0])
def test_glitter_is_as_wide_as_cox_and_munk_measured(renderer, wind_mps, height_m, quality):
    """L07: width within 20 % at 5 and 10 m/s, from near and from far, waves of mesh and all."""
    times = np.arange(12) * 2.7 if height_m < 100 else (0.0, 3.1)
    slopes, density = facet_density(open_sea(wind_mps), height_m, quality, renderer, times)
    along, across = fitted_variance(slopes, density, 70.0)
    expected = cox_munk(wind_mps)
    print(wind_mps, height_m, quality, np.sqrt((along + across) / sum(expected)), np.sqrt(along / expected[0]), np.sqrt(across / expected[1]))
    assert np.sqrt(along + across) == pytest.approx(np.sqrt(sum(expected)), rel=0.2)
