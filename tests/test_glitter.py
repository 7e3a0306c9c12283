"""The sun's glitter: as wide as Cox & Munk (1954) measured, shared by waves, ripples and roughness (L07)."""

import numpy as np
import pytest
from scipy import ndimage, special
from shorewright.level import Grid, Level
from shorewright.level.objects import Camera
from shorewright.level.settings import Sea
from shorewright.renderer import render
from shorewright.renderer.look import ripple_slopes, sun_direction, wave_slopes
from shorewright.renderer.sky_light import sky_light

pytestmark = pytest.mark.gl
AZIMUTH, ELEVATION = 235.0, 38.0
WATER_F0 = 0.02


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
    """L07: width within 20 % at 5 and 10 m/s, from near and far, mesh waves and all; longer along the wind."""
    times = np.arange(6) * 2.7 if height_m < 100 else (0.0,)
    slopes, density = facet_density(open_sea(wind_mps), height_m, quality, renderer, times)
    along, across = fitted_variance(slopes, density, 70.0)
    expected = cox_munk(wind_mps)
    assert np.sqrt(along + across) == pytest.approx(np.sqrt(sum(expected)), rel=0.12)
    assert np.sqrt(along) == pytest.approx(np.sqrt(expected[0]), rel=0.2)
    assert np.sqrt(across) == pytest.approx(np.sqrt(expected[1]), rel=0.2)


def test_a_steep_swell_takes_from_the_ripples(renderer):
    """L07: more of the wind's slope in the mesh, less in the ripples, the same glitter."""
    level = open_sea(10.0, swell_m=1.6, swell_length_m=40.0)
    slopes, density = facet_density(level, 200.0, "medium", renderer, np.arange(4) * 3.1)
    assert np.sqrt(sum(fitted_variance(slopes, density, 70.0))) == pytest.approx(np.sqrt(sum(cox_munk(10.0))), rel=0.2)


@pytest.mark.parametrize("wind_mps", [2.0, 5.0, 10.0, 20.0])
@pytest.mark.parametrize("swell_m", [0.0, 0.45, 1.0])
def test_ripples_and_waves_share_what_the_wind_makes(wind_mps, swell_m):
    """L07: mean square slopes along and across the wind add up to Cox & Munk's, whatever the waves carry of it."""
    sea = Sea(wind_mps=wind_mps, swell_m=swell_m, swell_heading_deg=123.0)
    waves = wave_slopes(sea, 7, np.radians(123.0)).sum(axis=0)
    ripples = ripple_slopes(sea, 7)
    both, expected = waves + ripples, np.array(cox_munk(wind_mps))
    room = waves < expected - 2e-4
    assert room.any()
    assert both[room] == pytest.approx(expected[room])
    assert (ripples >= 2e-4).all()


def test_the_texture_has_the_spread_that_the_wind_is_fitted_to():
    """L07: RIPPLE_SPREAD is what the ripple texture really has, and its slopes are Gaussian as the glitter's are."""
    from shorewright.level.textures import ripple_texture
    from shorewright.renderer.look import RIPPLE_SPREAD

    texture = ripple_texture()
    variance = (texture[..., :2] ** 2).mean(axis=(0, 1))
    assert variance == pytest.approx(RIPPLE_SPREAD, abs=1e-3)
    assert (texture[..., :2] ** 4).mean(axis=(0, 1)) / variance**2 == pytest.approx([3, 3], abs=0.5)


def test_the_picture_has_the_glint_of_its_view(renderer):
    """L07: what the light pass adds at the sun's place is the view's glint: nothing of its shape is left without it."""
    level = open_sea(5.0, swell_m=0.0, chop_m=0.0)
    place = Camera(id="c", x=128, y=128, z=400.0, yaw_deg=AZIMUTH, pitch_deg=-ELEVATION, fov_deg=60)
    shoot = {"size": (96, 72), "linear": True, "renderer": renderer}
    whole, glint = (render(level, place, view=view, **shoot)[..., 1].ravel() for view in ("hdr", "glint"))
    assert glint.max() > 5 * (whole - glint).max()
    share, _ = np.polyfit(glint, whole, 1)
    # what mirrors the sky is brighter towards the sun too
    assert share == pytest.approx(1, abs=0.08)


MIRROR = """
// at.x elevation of the view 1 … 10°, at.y mean square slope 0.01 … 0.06: slope of the facet that water mirrors from
vec4 value(vec2 at) {
    float elevation = radians(mix(1.0, 10.0, at.x)), alpha2 = mix(0.01, 0.06, at.y);
    vec3 v = vec3(cos(elevation), 0.0, sin(elevation));
    vec3 facet = normalize(water_mirror(vec3(0.0, 0.0, 1.0), v, sqrt(sqrt(alpha2))) + v);
    return vec4(facet.x / facet.z, facet.y, 0.0, 1.0);
}
"""


def test_rough_water_mirrors_from_the_slopes_one_sees(ctx):
    """L07: at a low angle the mean facet leans to the eye as an integral over Gaussian slopes says."""
    from test_light import evaluate

    lean = evaluate(ctx, "brdf", MIRROR, (6, 6))
    assert np.abs(lean[..., 1]).max() < 1e-5
    slope = np.linspace(-1.2, 1.2, 4001)
    for row, variance in enumerate(np.linspace(0.01, 0.06, 6) / 2):  # along the view: half of both
        for column, elevation in enumerate(np.radians(np.linspace(1, 10, 6))):
            cosine = np.maximum((np.sin(elevation) + slope * np.cos(elevation)) / np.sqrt(1 + slope**2), 0)
            shown = np.exp(-(slope**2) / (2 * variance)) * cosine * np.sqrt(1 + slope**2)
            weight = shown * (WATER_F0 + (1 - WATER_F0) * (1 - cosine) ** 5)
            expected = (slope * weight).sum() / weight.sum()
            assert lean[row, column, 0] == pytest.approx(expected, rel=0.3, abs=0.012)


@pytest.mark.parametrize("swell_m", [0.0, 0.45])
def test_the_sea_from_above_is_no_lattice(renderer, swell_m):
    """L07: from 900 m neither tiles of ripples nor rows of swell repeat in the glitter."""
    level = open_sea(5.0, swell_m=swell_m, chop_m=0.09 if swell_m else 0.0)
    place = Camera(id="c", x=128, y=128, z=900.0, yaw_deg=AZIMUTH, pitch_deg=-50.0, fov_deg=60)
    # gusts show in the light alone
    view, channel = ("hdr", 1) if swell_m else ("normal", 0)
    shoot = {"size": (480, 270), "linear": True, "quality": "medium", "renderer": renderer}
    seen = render(level, place, view=view, **shoot)[..., channel].astype(np.float64)
    broad = ndimage.gaussian_filter(seen, 4)  # without what varies slowly
    fine = ((seen - broad) / (broad if swell_m else 1))[120:250, 120:360]
    if fine.std() < 1e-3:
        return  # nothing is seen
    power = np.abs(np.fft.fft2(fine - fine.mean(), (2 * fine.shape[0], 2 * fine.shape[1]))) ** 2
    repeats = np.fft.fftshift(np.fft.ifft2(power).real)
    repeats /= repeats.max()
    row, col = np.indices(repeats.shape)
    lag = np.hypot(row - fine.shape[0], col - fine.shape[1])
    # waves are alike over a wavelength or two
    assert repeats[(lag > (40 if swell_m else 10)) & (lag < 110)].max() < 0.2


@pytest.mark.parametrize("wind_mps", [3.0, 8.0])
def test_gusts_keep_the_mean(renderer, wind_mps):
    """L07: from afar patches of wind are seen, and on the whole the slopes are Cox & Munk's."""
    level = open_sea(wind_mps, swell_m=0.0, chop_m=0.0)
    place = Camera(id="c", x=128, y=128, z=4000.0, yaw_deg=0, pitch_deg=-90, fov_deg=60)
    shoot = {"size": (96, 96), "quality": "medium", "linear": True, "renderer": renderer}
    variance = render(level, place, view="roughness", **shoot)[..., 0].astype(np.float64) ** 4
    assert variance.mean() == pytest.approx(sum(cox_munk(wind_mps)), rel=0.1)
    assert 0.1 < variance.std() / variance.mean() < 0.5


def smith(cosine, sigma):
    """Share of a Gaussian sea's facets that is hidden against what is seen: Λ of Smith (1967), in closed form."""
    nu = cosine / np.sqrt(1 - cosine**2) / (np.sqrt(2) * sigma)
    return (np.exp(-(nu**2)) / (nu * np.sqrt(np.pi)) - special.erfc(nu)) / 2


@pytest.mark.parametrize(("view_deg", "sun_deg"), [(1, 12), (30, 25), (60, 50), (80, 66), (60, 30)])
@pytest.mark.parametrize("wind_mps", [3.0, 5.0])
def test_the_glint_is_as_bright_as_cox_and_munk_say(renderer, wind_mps, view_deg, sun_deg):
    """L07: E · F · p(slope) / (4 cos θ_eye cos⁴ β), less what facets hide of each other; angles from straight down."""
    level = open_sea(wind_mps, swell_m=0.0, chop_m=0.0)
    level.set("light.sun_elevation_deg", 90.0 - sun_deg)
    place = Camera(id="c", x=128, y=128, z=1500.0, yaw_deg=AZIMUTH, pitch_deg=view_deg - 90.0, fov_deg=20)
    shoot = {"size": (33, 33), "quality": "medium", "linear": True, "renderer": renderer, "time_s": 3.0}
    glint = render(level, place, view="glint", **shoot)[16, 16, 1]
    # gusts give and take, by place: what stands there is the variance that counts
    there = render(level, place, view="roughness", **shoot)[16, 16, 0].astype(np.float64) ** 4
    at = render(level, place, view="position", **shoot)[16, 16].astype(np.float64)
    to_eye = np.array([place.x, place.y, place.z]) - at
    to_eye /= np.linalg.norm(to_eye)
    sun = sun_direction(AZIMUTH, 90.0 - sun_deg)
    half = (to_eye + sun) / np.linalg.norm(to_eye + sun)
    way = np.radians(70.0)
    variance = np.array(cox_munk(wind_mps)) * there / sum(cox_munk(wind_mps))
    assert 0.4 < there / sum(cox_munk(wind_mps)) < 1.8
    axes = np.array([[np.sin(way), np.cos(way)], [-np.cos(way), np.sin(way)]])
    slope = axes @ (half[:2] / half[2])
    p = np.exp(-0.5 * np.sum(slope**2 / variance)) / (2 * np.pi * np.sqrt(variance.prod()))
    fresnel = WATER_F0 + (1 - WATER_F0) * (1 - half @ to_eye) ** 5
    hidden = sum(
        smith(d[2], np.sqrt(np.sum((axes @ d[:2]) ** 2 * variance) / np.sum(d[:2] ** 2))) for d in (to_eye, sun)
    )
    expected = sky_light(level.settings).sun[1] * fresnel * p / (4 * to_eye[2] * half[2] ** 4) / (1 + hidden)
    assert glint == pytest.approx(expected, rel=0.1)
