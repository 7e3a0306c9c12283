"""Sun by date and place, moon, clouds and the six environments (L01 L02 L08)."""

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.level import BadInput, Settings
from shorewright.level.environments import ENVIRONMENTS, TOUCHED, environment_of, environment_settings
from shorewright.level.params import get, replace
from shorewright.level.sun import light_angles, stand_at, sun_angles
from shorewright.renderer import Show, camera_matrices, render, sky_light, sky_table
from shorewright.renderer.look import sun_direction, white_balance
from shorewright.renderer.passes.lookdev import patch_albedo

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
SMALL = (96, 54)


def angle_between(a, b) -> float:
    """Degrees between two (azimuth, elevation)."""
    az, el = np.radians([a[0], b[0]]), np.radians([a[1], b[1]])
    cosine = np.sin(el).prod() + np.cos(el).prod() * np.cos(az[0] - az[1])
    return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))))


# Azimuth and elevation without refraction. The first is the example of NREL's SPA report (Reda & Andreas 2003); the
# others follow from spherical trigonometry: at local noon of a solstice or equinox the sun stands 90° − |φ − δ| high.
PLACES = [
    ((10, 17, 12 + 30.5 / 60, -7.0, 39.742476, -105.1786, 2003), (194.34024, 90 - 50.12799)),
    ((6, 21, 12.0 + 1.9 / 60, 0.0, 51.48, 0.0, 2025), (180.0, 90 - 51.48 + 23.437)),
    ((12, 21, 12.0 - 1.9 / 60, 0.0, -33.9, 0.0, 2025), (0.0, 90 - (33.9 - 23.437))),
]


@pytest.mark.parametrize(("when", "where"), PLACES)
def test_sun_stands_where_almanacs_put_it(when, where):
    """L02: sun by date and place, within a tenth of a degree of published and closed-form positions."""
    assert angle_between(sun_angles(*when), where) < 0.1


def test_sun_rises_in_the_east_and_turns_the_other_way_in_the_south():
    """L02: on the equator at an equinox the sun passes from due east over the zenith to due west."""
    morning, evening = sun_angles(3, 20, 8, 0, 0, 0), sun_angles(3, 20, 16, 0, 0, 0)
    assert morning[0] == pytest.approx(90, abs=1)
    assert evening[0] == pytest.approx(270, abs=1)
    north, south = sun_angles(6, 21, 12, 0, 50, 0), sun_angles(6, 21, 12, 0, -50, 0)
    assert abs(north[0] - 180) < 5
    assert min(south[0], 360 - south[0]) < 5
    assert sun_angles(2, 31, 12, 0, 50, 0) == sun_angles(2, 29, 12, 0, 50, 0)


def test_the_clock_or_two_angles():
    """L02: `light.sun_from` chooses, and the knobs that it leaves out count for nothing."""
    settings = replace(Settings(), "light.hour", 9.0)
    assert light_angles(settings.light) == (settings.light.sun_azimuth_deg, settings.light.sun_elevation_deg)
    by_date = replace(settings, "light.sun_from", "date")
    assert light_angles(by_date.light) == light_angles(replace(by_date, "light.sun_elevation_deg", 3.0).light)
    assert light_angles(by_date.light) != light_angles(replace(by_date, "light.hour", 10.0).light)


def test_a_georeference_places_the_sun():
    """L02: what an import knows of its place on Earth is where the sun by date stands; what it doesn't know stays."""
    settings = stand_at(Settings(), {"latitude": 21.4, "longitude": -157.8})
    assert (settings.light.latitude_deg, settings.light.longitude_deg) == (21.4, pytest.approx(-157.8))
    assert settings.light.utc_offset_h == -11
    assert stand_at(Settings(), {"easting": 3.0}) == Settings()
    assert stand_at(Settings(), {"latitude": 210.0, "longitude": 3.0}) == Settings()


@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_environments_set_all_they_touch(name):
    """L02: from whatever was set before, an environment gives the same light; it shapes no wave."""
    row = ENVIRONMENTS[name]
    assert tuple(row.values) == TOUCHED
    start = Settings()
    for other in ENVIRONMENTS:
        start = environment_settings(start, other)
    settings = environment_settings(start, name)
    assert environment_of(settings) == name
    assert settings.shore == Settings().shore
    for path, value in row.values.items():
        assert get(settings, path) == value
    assert environment_of(replace(settings, "light.exposure_ev", row.values["light.exposure_ev"] + 0.5)) == ""


def test_an_unknown_environment_is_told():
    with pytest.raises(BadInput, match="noon"):
        environment_settings(Settings(), "dusk")


def test_cloud_takes_the_sun_and_evens_the_sky():
    """L02: under a closed layer no sun is left, the sky is a third as bright at the horizon as above, and it is darker
    the deeper the layer."""
    settings = environment_settings(Settings(), "noon")
    clear = sky_light.sky_light(settings)
    thin, deep = (
        sky_light.sky_light(replace(replace(settings, "light.cloud_cover", 1.0), "light.cloud_depth", depth))
        for depth in (12.0, 80.0)
    )
    assert clear.sun @ LUMINANCE > 80
    assert thin.sun @ LUMINANCE < 0.1
    table = sky_light.deck_table(thin.deck)
    assert table[-1] == pytest.approx(3 * table[0], rel=1e-6)
    assert thin.deck @ LUMINANCE > 2 * (deep.deck @ LUMINANCE)
    # as much light reaches the ground as the layer lets through: below what came in, above nothing
    down = clear.sun * np.sin(np.radians(56)) + sky_light.up_irradiance(clear.table)
    under = sky_light.up_irradiance(sky_light.deck_table(thin.deck))
    assert 0.2 < (under @ LUMINANCE) / (down @ LUMINANCE) < 0.9


def test_moonlight_is_four_hundred_thousandth_of_sunlight():
    """L02: V −26.74 against −12.74 is a factor of 398 000; `unit` lifts it for half floats and is told."""
    settings = environment_settings(Settings(), "moonlit")
    moon = sky_light.sky_light(settings)
    sun = sky_light.sky_light(replace(settings, "light.body", "sun"))
    assert moon.unit > 1000
    assert np.log2(moon.unit) % 1 == 0
    ratio = (sun.sun @ LUMINANCE) / (moon.sun @ LUMINANCE / moon.unit)
    assert ratio == pytest.approx(398_000, rel=0.05)


def test_air_adds_up_to_the_sky():
    """L02: the light that air adds grows with distance, and over the whole way it is the sky behind it."""
    aerial, sky = sky_table.aerial_table(25.0, 2.6), sky_table.sky_table(25.0, 2.6)
    assert (np.diff(aerial, axis=0) >= -1e-6).all()
    rows = np.arange(16) / 15 * 95
    for elevation, row in enumerate(rows):
        low = min(int(row), 94)
        there = sky[low] + (sky[low + 1] - sky[low]) * (row - low)
        assert aerial[-1, elevation, [0, -1]] == pytest.approx(there[[0, -1]], rel=0.03)
    # close by it is proportional to distance: one kilometre of ten of them
    near = aerial[[0, 4], 0, 16] @ LUMINANCE
    assert near[1] / near[0] == pytest.approx(8.0, rel=0.1)


def test_white_balance_turns_warm_light_white():
    assert white_balance(5600) == pytest.approx([1, 1, 1])
    assert white_balance(3200)[2] > 1.5 > 1 > white_balance(3200)[0]
    assert white_balance(9000)[2] < 1 < white_balance(9000)[0]


@pytest.mark.gl
@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_environments_give_a_picture(renderer, name):
    """L02: no black frame, none burnt out: the middle of the picture's range is in use."""
    level = coast()
    level.set_settings(environment_settings(level.settings, name))
    seen = render(level, camera(pitch=-12.0), SMALL, 12.0, renderer=renderer) @ LUMINANCE
    assert 35 < seen.mean() < 225
    assert seen.std() > 4
    linear = render(level, camera(pitch=-12.0), SMALL, 12.0, linear=True, renderer=renderer)
    assert np.isfinite(linear).all()


@pytest.mark.gl
@pytest.mark.parametrize("quality", ["low", "medium", "high"])
@pytest.mark.parametrize("name", ["", *ENVIRONMENTS])
def test_white_world_is_white(renderer, name, quality):
    """L01: white land under even light is flat 1 within a hundredth, in every tier, from near and far, whatever light
    the level has."""
    level = coast(slope=0.4, rock=9.0, side=129)
    if name:
        level.set_settings(environment_settings(level.settings, name))
    for place in (camera(x=64.0), camera(x=64.0, z=140.0, pitch=-60.0)):
        seen = render(level, place, SMALL, 3.0, "furnace", quality=quality, linear=True, renderer=renderer)
        land = seen.max(axis=-1) > 0
        assert land.mean() > 0.3
        assert seen[land] == pytest.approx(1, abs=0.01)


@pytest.mark.gl
def test_furnace_can_fail(renderer):
    """L01: the same view without the light that land gives back is darker where land hides the sky."""
    level = coast(slope=0.4, rock=9.0)
    level.set("light.bounce", 0.0)
    seen = render(level, camera(), SMALL, 3.0, "furnace", linear=True, renderer=renderer)
    assert seen[seen.max(axis=-1) > 0].min() < 0.97


def _grey_patch(seen: np.ndarray) -> np.ndarray:
    """The middle grey patch of the look-dev card, as it lies in shaders/lookdev.glsl: fourth row, fourth column."""
    height, width = seen.shape[:2]
    x, y = 0.46 + 0.37 * (3.5 / 6 * 2 - 1), -0.72 - 0.235 * (3.5 / 4 * 2 - 1)
    col, row = width / 2 + x * height / 2, height / 2 - y * height / 2
    return seen[int(row) - 1 : int(row) + 2, int(col) - 1 : int(col) + 2].mean((0, 1))


def _irradiance(light: sky_light.SkyLight, normal: np.ndarray, sun: np.ndarray) -> np.ndarray:
    """What falls on a plane, klx `(3,)`: sun, and the harmonics as lib/sky.glsl sums them."""
    heading = sun[:2] / np.hypot(*sun[:2])
    x, y, z = normal[:2] @ heading, heading[0] * normal[1] - heading[1] * normal[0], normal[2]
    basis = sky_light._basis(x, y, z)
    return light.harmonics.T @ np.array(basis) + light.sun * max(normal @ sun, 0)


@pytest.mark.gl
@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_grey_card_reads_the_same_in_every_tier(renderer, name):
    """L01, L08: the grey patch gives the same light in all tiers within 2 %: that of its albedo under sun and sky."""
    level, place = coast(), camera()
    level.set_settings(replace(environment_settings(level.settings, name), "fog.on", False))
    light, sun = sky_light.sky_light(level.settings), sun_direction(*light_angles(level.settings.light))
    back = -camera_matrices(place, (192, 108)).ray_centre
    normal = 0.4 * np.array([0, 0, 1]) + 0.6 * back  # lookdev.glsl CARD_TILT
    normal /= np.linalg.norm(normal)
    expected = patch_albedo()[21] * _irradiance(light, normal, sun) / np.pi / light.unit
    for quality in ("low", "medium", "high"):
        shot = render(
            level, place, (192, 108), 5.0, "lookdev", Show.hide("air,shadows"), quality, linear=True, renderer=renderer
        )  # fmt: skip
        assert _grey_patch(shot) == pytest.approx(expected, rel=0.02)


@pytest.mark.gl
@pytest.mark.parametrize("name", ["noon", "moonlit"])
def test_linear_pictures_know_no_exposure(renderer, name):
    """L01: EXR is radiance, whatever exposure, curve and white balance are; the picture on the screen is not."""
    level = coast()
    level.set_settings(environment_settings(level.settings, name))
    linear, shown = (render(level, camera(), SMALL, 5.0, linear=flag, renderer=renderer) for flag in (True, False))
    for path, value in (
        ("exposure_ev", level.settings.light.exposure_ev + 2),
        ("display", "neutral"),
        ("white_k", 8000),
    ):
        level.set(f"light.{path}", value)
    assert (render(level, camera(), SMALL, 5.0, linear=True, renderer=renderer) == linear).all()
    assert (render(level, camera(), SMALL, 5.0, renderer=renderer) != shown).any()
    sun = {"noon": 95, "moonlit": 2.4e-4}[name]
    assert linear.max() < 50 * sun
    assert 0.005 * sun < linear.mean() < 0.3 * sun


@pytest.mark.gl
def test_the_chrome_ball_shows_the_sky_and_the_grey_one_its_light(renderer):
    """L02, L08: the chrome ball's middle mirrors what stands behind the camera, the lobes are the table's radiance."""
    level = coast()
    level.set_settings(environment_settings(level.settings, "noon"))
    level.set("light.turbidity", 2.0)
    place = camera(pitch=0.0, yaw=205.0 - 90.0)
    seen = render(
        level, place, (320, 180), 5.0, "lookdev", show=Show.hide("clouds,shadows"), linear=True, renderer=renderer
    )
    # up the ball by half its radius the ray leaves 60° over the horizon
    col, row = int(160 - 0.18 * 90), int(90 + 0.72 * 90 - 0.5 * 0.17 * 90)
    table = sky_light.sky_light(level.settings).table
    at = np.sqrt(60 / 90) * 95
    mirrored = table[int(at) : int(at) + 2, 31:33].mean((0, 1))
    assert seen[row, col] == pytest.approx(mirrored, rel=0.12)
