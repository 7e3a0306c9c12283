"""The day that runs (Z25): the sun's way with the clock, light without jumps, the moon at night."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level import Settings
from shorewright.level.framing import cameras
from shorewright.level.params import replace
from shorewright.level.sun import MOON_BELOW_DEG, day_hours, day_moment, light_angles, sun_place
from shorewright.renderer.day_light import amount, exposure_ev, white_k
from shorewright.renderer.look import look_uniforms
from shorewright.renderer.sky_light import LUMINANCE, made, sky_light

HOUR_S = 6.0  # at a rate of 600


def running(**values) -> Settings:
    settings = Settings()
    for name, value in {"sun_from": "date", "hour": 12.0, "day_rate": 600.0, **values}.items():
        settings = replace(settings, f"light.{name}", value)
    return settings


def test_day_that_stands_is_as_it_was():
    """Z25: without a rate, or with the sun placed by angles, no time changes the light, to the bit."""
    by_date = running(day_rate=0.0)
    for settings in (Settings(), by_date, running(sun_from="angles")):
        assert sky_light(settings, 777.0) is sky_light(settings)
        assert light_angles(settings.light, 777.0) == light_angles(settings.light)
        assert exposure_ev(settings, 777.0) == settings.light.exposure_ev
        assert white_k(settings, 777.0) == settings.light.white_k
    light = by_date.light
    elevation = round(light_angles(light)[1], 4)
    depth = by_date.fog.density * by_date.fog.height_m
    exact = made(elevation, light.turbidity, light.body, light.cloud_cover, light.cloud_depth, depth, False)
    assert sky_light(by_date, 777.0) is exact


def test_clock_turns_the_sun():
    """Z25: six hours in 36 s at 600 times, half of that with a day of 48 h; days go over into the next month."""
    settings = running()
    by_hand = replace(running(day_rate=0.0), "light.hour", 18.0)
    assert light_angles(settings.light, 6 * HOUR_S) == pytest.approx(light_angles(by_hand.light), abs=1e-6)
    assert day_hours(running(day_h=48.0).light, 6 * HOUR_S) == pytest.approx(15.0)
    moment = day_moment(running(day=30).light, 13 * HOUR_S)
    assert (moment.month, moment.day, moment.hour) == (7, 1, 1)
    years = 1461 * 24 * HOUR_S
    assert sun_place(settings.light, years) == pytest.approx(sun_place(settings.light, 0.0), abs=1e-6)
    assert np.isfinite(sun_place(settings.light, 1e9)).all()


def test_sun_is_due_south_at_noon_and_as_high_as_its_latitude_says():
    """Z25: at the solstice its highest place over a day is 90° less latitude plus the tilt of the Earth's axis."""
    for latitude in (0.0, 30.0, 50.0, 65.0):
        light = running(latitude_deg=latitude, day=21, hour=0.0).light
        highest = max(sun_place(light, HOUR_S * at)[1] for at in np.arange(10, 14, 0.05))
        assert highest == pytest.approx(90 - abs(latitude - 23.44), abs=0.1)


def seen(settings, time_s):
    """What a picture gets of the sky: table, harmonics, sun, times its exposure, in the frame of the sun's azimuth."""
    light, uniforms = sky_light(settings, time_s), look_uniforms(settings, time_s)
    sky = np.concatenate([light.table[:, [0, -1]].reshape(-1, 3), light.harmonics[[0, 2]], [light.sun]])
    return sky * uniforms["u_exposure"]


def test_light_has_no_jumps():
    """Z25: from one moment to the next the whole sky as shown changes a little, through dusk, night and dawn."""
    settings = running(month=3, day=21)
    times = HOUR_S * np.arange(17.8, 19.4, 0.002) - 12 * HOUR_S
    before, flips = None, 0
    for time_s in times:
        here = seen(settings, time_s)
        flipped = sun_place(settings.light, time_s)[1] < MOON_BELOW_DEG
        if before is not None and flipped != before[1]:
            here[:-3] = here[:-3].reshape(-1, 2, 3)[:, ::-1].reshape(-1, 3)  # by the azimuth from the other body
            flips += 1
        if before is not None:
            assert np.abs(here - before[0]).max() < 0.022 * max(before[0].max(), 1.0)
        before = seen(settings, time_s), flipped
    assert flips == 1


def test_blended_light_is_close_to_the_exact_one():
    """Z25: within some percent of what is worked out for the very elevation, from high noon to deep dusk."""
    settings = running(moonlit=False)
    sky = 2.6, "sun", 0.0, 12.0, settings.fog.density * settings.fog.height_m
    for hour in (12.3, 17.77, 20.0, 20.25, 20.6, 21.1, 21.9):
        time_s = (hour - 12) * HOUR_S
        light = sky_light(settings, time_s)
        exact = made(round(sun_place(settings.light, time_s)[1], 4), *sky)
        assert amount(light) == pytest.approx(amount(exact), rel=0.04)
        tables = [part.table.astype(np.float64) @ LUMINANCE / part.unit for part in (light, exact)]
        assert np.abs(tables[0] - tables[1]).max() < 0.06 * tables[1].max()


def test_full_moon_stands_opposite_the_sun():
    """Z25: at night it shines from there, weaker by far than the sun, and not where it is switched off."""
    settings, dark = running(hour=0.0), running(hour=0.0, moonlit=False)
    sun, moon = sun_place(settings.light), light_angles(settings.light)
    assert moon[1] == -sun[1] > 0
    assert (moon[0] - sun[0]) % 360 == pytest.approx(180)
    assert light_angles(dark.light) == sun
    night, none, noon = (sky_light(s, t) for s, t in ((settings, 0.0), (dark, 0.0), (settings, 12 * HOUR_S)))
    assert not none.sun.any()
    assert 1e-7 < amount(night) / amount(noon) < 1e-5
    assert amount(none) < 0.1 * amount(night)


def test_exposure_follows_the_light():
    """Z25: the setting holds at time zero; dusk opens the lens by part of what is missing, whatever unit is in use."""
    settings = running()
    assert exposure_ev(settings, 0.0) == settings.light.exposure_ev
    stops = np.log2(amount(sky_light(settings, 9 * HOUR_S)) / amount(sky_light(settings)))
    assert exposure_ev(settings, 9 * HOUR_S) == pytest.approx(settings.light.exposure_ev + 0.82 * stops)
    assert exposure_ev(running(adapt=0.0), 9 * HOUR_S) == settings.light.exposure_ev
    assert white_k(settings, 12 * HOUR_S) < 0.8 * settings.light.white_k == 0.8 * white_k(settings, HOUR_S)


def test_pictures_through_dusk(renderer):
    """Z25: the picture's mean goes steadily where the moon takes over; noon and night differ."""
    level = make_beach()
    level.set_settings(running())
    camera = cameras(level)[1]
    low, high = 8 * HOUR_S, 10 * HOUR_S  # the sun sinks through MOON_BELOW_DEG
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if sun_place(level.settings.light, middle)[1] > MOON_BELOW_DEG else (low, middle)

    def mean(time_s):
        renderer.draw(level, camera, (96, 54), time_s, quality="low")
        return renderer.read().astype(np.float64).mean(axis=(0, 1))

    step = 0.02
    rows = np.array([mean(low + step * at) for at in (-2, -1, 0, 1, 2, 3)])
    assert np.abs(np.diff(rows, axis=0)).max() < 1.5
    assert np.abs(mean(0.0) - mean(12 * HOUR_S)).max() > 20


def test_status_bar_tells_the_hour():
    """Z25: only while the day runs."""
    from shorewright.app.editor import Editor
    from shorewright.app.session import Session
    from shorewright.app.status_bar import day_text

    with Session.new() as session:
        editor = Editor(session)
        assert day_text(editor) == ""
        session.level.set_settings(running(hour=22.5))
        session.clock.time_s = 2 * HOUR_S
        assert day_text(editor).strip() == "22 June, 00:30"


def test_moonlight_is_blue_to_the_eye_and_as_bright():
    """Z25: a low moon shines redder than the sky, as a low sun does; added to a night it turns towards blue, and what
    falls on the ground stays as much."""
    from shorewright.renderer.day_light import by_rods

    moon = made(10.0, 2.6, "moon", 0.0, 12.0, 0.03)
    seen = by_rods(moon)
    assert moon.disc[0] > 1.5 * moon.disc[2]
    assert seen.disc[2] > seen.disc[0]
    assert amount(seen) == pytest.approx(amount(moon))
    night = sky_light(running(hour=0.0))
    assert night.disc[2] > night.disc[0]
    noon = sky_light(running(moonlit=False), 0.0)
    assert sky_light(running(), 0.0).disc.tobytes() == noon.disc.tobytes()


def test_a_day_that_begins_at_night_is_exposed_for_its_noon(renderer):
    """Z25: as one that comes from there; from hour to hour of the start it changes by and by; no black picture."""
    night, noon = running(hour=1.0), running(hour=12.0, day=20)
    assert exposure_ev(night, 0.0) == pytest.approx(exposure_ev(noon, 13 * HOUR_S), abs=0.1)
    assert exposure_ev(night, 11 * HOUR_S) == pytest.approx(night.light.exposure_ev, abs=0.1)
    by_start = running(hour=1.0, adapt_from="start")
    assert exposure_ev(by_start, 0.0) == by_start.light.exposure_ev
    starts = [exposure_ev(running(hour=hour), 0.0) for hour in np.arange(19.0, 22.5, 0.02)]
    assert np.abs(np.diff(starts)).max() < 0.5
    level, means = make_beach(), []
    for settings in (night, by_start):
        level.set_settings(settings)
        renderer.draw(level, cameras(level)[1], (96, 54), quality="low")
        means.append(renderer.read().mean())
    assert means[1] < 3 < 12 < means[0]
