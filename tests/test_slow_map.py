"""Maps that live pictures make ahead of the clock: bounded work a picture, the bits of a still one, no jumps."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level.objects import Camera
from shorewright.level.weather import drift_m
from shorewright.renderer.passes import cloud_dome, cloud_shadow, lobes, weather
from shorewright.renderer.quality import tier
from shorewright.renderer.slow_map import MOST_SHARE, STRIPS
from shorewright.renderer.views import find_view

pytestmark = pytest.mark.gl
MAPS = ("weather", "cloud_dome", "lobes", "cloud_shadow")
WHOLE = {"weather_texels": 3 * 512**2, "cloud_dome": tier("low").cloud_dome ** 2,
         "cloud_shadows": tier("low").cloud_shadow[0] ** 2}  # fmt: skip


@pytest.fixture
def sky():
    level = make_beach()
    for path, value in {"clouds.on": True, "weather.coverage": 0.6, "weather.wind_mps": 15.0}.items():
        level.set(path, value)
    return level


def step(renderer, level, time_s, live=True, x=0.0):
    """The passes of one picture that keep maps; its frame."""
    place = Camera(id="c", x=x, y=0, z=60, yaw_deg=60, pitch_deg=15, fov_deg=60)
    frame = renderer.prepare(level, place, (64, 36), time_s, find_view("final"), None, "low", None)
    frame.live = live
    for one in (weather, cloud_dome, cloud_shadow):
        one.draw(frame)
    return frame


def bits(renderer, names=MAPS):
    return {name: renderer.kept[name].texture.read(alignment=1) for name in names}


def start(renderer, level, time_s=20.0):
    """One still picture and one live, as if the clock began to run."""
    step(renderer, level, time_s, live=False)
    step(renderer, level, time_s)


@pytest.mark.parametrize("rate", [8, 30])
def test_no_picture_makes_more_than_a_share(renderer, sky, rate):
    """Z16, Z17, Z19: texels counted in each of two seconds of live pictures; after them the maps are new ones."""
    start(renderer, sky)
    before, counted = bits(renderer), []
    for number in range(1, 2 * rate + 1):
        counted.append(step(renderer, sky, 20.0 + number / rate).stats)
    strips = 5 * STRIPS + sum(int(part * STRIPS) for part in lobes.STRIPS)  # weather thrice, dome, shadow, lobes
    share = MOST_SHARE if rate == 8 else 1 / 10
    assert max(stats["map_strips"] for stats in counted) <= share * strips
    for name, whole in WHOLE.items():
        made = [stats.get(name, 0) for stats in counted]
        assert max(made) <= 0.5 * whole
        assert sum(made) > 0.6 * whole
    after = bits(renderer)
    assert all(after[name] != before[name] for name in MAPS)


@pytest.mark.parametrize("values", [{}, {"light.sun_from": "date", "light.day_rate": 300.0, "light.hour": 17.0}])
def test_when_its_moment_comes_a_map_has_the_bits_of_a_still_picture(renderer, sky, values):
    """Z16, Z17, Z19, Z25: after a whole period of live pictures, whether the sun stands or goes."""
    for path, value in values.items():
        sky.set(path, value)
    start(renderer, sky)
    for number in range(1, 33):
        step(renderer, sky, 20.0 + number / 16)
    live = bits(renderer)
    renderer.kept.clear()
    step(renderer, sky, 22.0, live=False)
    assert all(now == live[name] for name, now in bits(renderer).items())


def test_what_an_artist_does_shows_at_once(renderer, sky):
    """Z17, Z19: settings, a scrub, a way that jumps and still pictures do not wait."""

    def change():
        sky.set("weather.coverage", 0.8)
        return {}

    ways = (lambda: {}, change, lambda: {"time_s": 90.0}, lambda: {"time_s": 3.0}, lambda: {"x": 900.0})
    for number, way in enumerate(ways):
        start(renderer, sky)
        for part in (1, 2, 3):
            step(renderer, sky, 20.0 + part / 10)
        asked = {"time_s": 20.4} | way() | ({} if number else {"live": False})
        step(renderer, sky, **asked)
        shown = bits(renderer)
        renderer.kept.clear()
        step(renderer, sky, **{**asked, "live": False})
        assert all(now == shown[name] for name, now in bits(renderer).items())


def test_shadows_go_on_where_maps_take_turns(renderer, sky):
    """Z19, Z25: the place of the map, less the way to its own middle, moves with the wind as steadily as before."""
    sky.set("light.sun_from", "date")
    sky.set("light.day_rate", 300.0)
    start(renderer, sky)
    clouds, seen = sky.settings.clouds, []
    high = clouds.base_m + cloud_shadow.MIDDLE * (clouds.top_m - clouds.base_m)
    turns = 0
    for number in range(1, 25):
        time_s = 20.0 + number / 10
        place = np.array(step(renderer, sky, time_s).uniforms["u_cloud_shadow_place"][:2])
        middle, then_s, slant = renderer.kept["cloud_shadow"].seen
        turns += bool(seen) and then_s != seen[-1][0]
        # foot of the shadow of what stood over the map's middle at the height where most cloud lies
        frame_slant = np.array(step(renderer, sky, time_s).uniforms["u_cloud_shadow_slant"])
        expected = middle + drift_m(sky, time_s) - drift_m(sky, then_s) - (frame_slant - slant) * high
        np.testing.assert_allclose(place, expected, atol=1e-6)
        seen.append((then_s, place))
    assert turns == 2


@pytest.mark.parametrize("hour", [20.2, 21.2])
def test_what_is_mirrored_goes_on_with_a_fast_day(renderer, sky, hour):
    """Z25, L02: a day in two minutes, at sunset and through dusk: from picture to picture the mirrored sky's mean, as
    the sea is given it, keeps within a fifth of a still picture's (left alone it is off by half), whatever unit the
    light has."""
    for path, value in {"light.sun_from": "date", "light.day_rate": 720.0, "light.hour": hour}.items():
        sky.set(path, value)

    def mirrored(time_s, live):
        frame = step(renderer, sky, time_s, live)
        lobes.draw(frame)
        atlas = renderer.kept["lobes"].texture
        texels = np.frombuffer(atlas.read(alignment=1), np.float16).reshape(*atlas.size[::-1], 4)
        return texels[336:, :16, 1].mean(dtype=np.float64) * frame.uniforms["u_lobes_gone_on"][1] / frame.sky.light.unit

    mirrored(0.0, False)
    live = [mirrored(number / 16, True) for number in range(24)]
    still = [mirrored(number / 16, False) for number in range(24)]
    np.testing.assert_allclose(live, still, rtol=0.2)
