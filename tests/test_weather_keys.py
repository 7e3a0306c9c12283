"""Weather keyed on the clock: cross-fades, drift, waves; continuous, stateless, equal on CPU and GPU (D36)."""

import numpy as np
import pytest
from coasts import make_beach
from points import feedback
from shorewright.level.drift import drifted
from shorewright.level.flow import current
from shorewright.level.meshes import block
from shorewright.level.objects import Camera, FlowPoint, Prop, WeatherKey
from shorewright.level.params import get
from shorewright.level.sea_keys import fronts_at
from shorewright.level.wave_uniforms import wave_uniforms
from shorewright.level.waves import largest_height_m, sea_at, surface_at
from shorewright.level.weather import weather_at, weather_map
from shorewright.level.weather_keys import KEYED, level_at, points_change, run_m, sky_areas
from shorewright.level.weather_presets import SKY, WEATHERS
from shorewright.level.wind import moved_m
from shorewright.renderer import render

GALE = WeatherKey(id="gale", time_s=100.0, fade_s=60.0, weather="gale")
CALM = WeatherKey(id="calm", time_s=140.0, fade_s=90.0, weather="calm")  # while the gale is still coming
STORM = WeatherKey(id="storm", time_s=400.0, fade_s=120.0, weather="storm")
KEYS = (GALE, CALM, STORM)


def keyed(*keys, **beach):
    level = make_beach(**beach)
    level.set("clouds.on", True)
    for key in keys:
        level.put_object(key.id, key)
    return level


def test_the_choices_are_the_table():
    """D36: a key takes every weather there is."""
    assert WeatherKey.model_fields["weather"].annotation.__args__ == tuple(WEATHERS)


def test_without_keys_and_before_them_nothing_changes():
    """D36: the same object without, the same bits before the first."""
    plain, level = keyed(), keyed(*KEYS)
    assert level_at(plain, 50.0) is plain
    assert level_at(level, 50.0) is level
    assert np.array_equal(moved_m(plain, 77.0), moved_m(level, 77.0))
    for t in (0.0, 99.0):
        a, b = wave_uniforms(plain, t), wave_uniforms(level, t)
        assert all(np.array_equal(a[name], b[name]) for name in a if name != "u_wave_height_m")
        assert np.array_equal(weather_map(plain, t, (0.0, 0.0)), weather_map(level, t, (0.0, 0.0)))


def test_settings_reach_every_preset_without_a_jump():
    """D36: whole at the end of a fade, half way in the middle of a lone one, and never quicker than a smoothstep."""
    level = keyed(*KEYS)
    for key, until in ((CALM, 390.0), (STORM, 520.0)):
        now = level_at(level, until).settings
        assert all(get(now, path) == WEATHERS[key.weather].values[path] for path in KEYED)
    half = level_at(level, 460.0).settings
    assert get(half, "sea.swell_m") == pytest.approx((WEATHERS["calm"].values["sea.swell_m"] + 2.2) / 2)
    times = np.arange(90.0, 530.0, 0.5)
    winds = np.array([level_at(level, t).settings.weather.wind_mps for t in times])
    assert np.abs(np.diff(winds)).max() < 0.5 * 1.5 * 30 / 60 * 1.01
    assert level.settings.weather.wind_mps == 11.0  # the level keeps its own


def test_air_moves_by_the_integral_of_the_wind():
    """D36 Z07: the closed form is the sum of small steps; scrubbing gives the same bits."""
    level = keyed(*KEYS)
    times = np.arange(0.0, 600.0, 0.05)
    winds = np.array([level_at(level, t + 0.025).settings.weather.wind_mps for t in times])
    summed = np.concatenate([[0.0], np.cumsum(winds * 0.05)])
    asked = [0.0, 100.0, 131.0, 150.0, 222.0, 300.0, 470.0, 599.95]
    found = [run_m(level, t, "weather.wind_mps") for t in asked]
    np.testing.assert_allclose(found, np.interp(asked, np.append(times, 600.0), summed), rtol=1e-7, atol=1e-5)
    assert found == [run_m(level, t, "weather.wind_mps") for t in asked[::-1]][::-1]
    assert np.array_equal(moved_m(level_at(level, 470.0), 470.0), moved_m(level, 470.0))


def test_the_sky_does_not_jump():
    """D36: over begin, middle and end of the fades the map changes as little in a tenth of a second as else."""
    level = keyed(*KEYS)
    rng = np.random.default_rng(3)
    x, y = rng.uniform(-15_000, 15_000, (2, 400))
    for t in (100.0, 140.0, 160.0, 230.0, 400.0, 460.0, 520.0):
        skies = [weather_at(level, t + dt, x, y, (0.0, 0.0)) for dt in (-0.05, 0.05)]
        assert np.abs(skies[1] - skies[0]).max() < 0.05
    again = weather_at(level, 460.0, x, y, (0.0, 0.0))
    weather_at(level, 9000.0, x, y, (0.0, 0.0))
    assert np.array_equal(again, weather_at(level, 460.0, x, y, (0.0, 0.0)))


def test_a_key_sends_its_storm_out():
    """D36 Z23: its rain comes when the wind since the key has carried it over its distance."""
    level = keyed(STORM)
    level.set("storm.ragged_m", 500.0)
    assert level_at(level, 450.0).settings.storm.start_s == STORM.time_s
    due = next(t for t in np.arange(400.0, 3000.0, 5.0)
               if run_m(level, t, "weather.wind_mps") - run_m(level, 400.0, "weather.wind_mps") > 20_000)  # fmt: skip
    rain = [float(weather_at(level, t, 0.0, 0.0, (0.0, 0.0))[1]) for t in (400.0, 400 + 1.2 * (due - 400))]
    assert rain == [0.0, pytest.approx(1.0)]


def test_an_area_has_its_own_sky():
    """D36: within half its radius the sky's bias is the preset's, outside the level's; waves and wind stay."""
    key = WeatherKey(id="here", time_s=10.0, fade_s=20.0, weather="snow", x=2000.0, y=-3000.0, radius_m=8000.0)
    level, plain = keyed(key), keyed()
    for made in (level, plain):
        made.set("weather.variety", 0.0)
    assert level_at(level, 60.0) is level
    there = weather_at(level, 60.0, np.array([2000.0, 4000.0]), np.array([-3000.0, -2000.0]), stage="simulated")
    np.testing.assert_allclose(there[:, [0, 2]], [[WEATHERS["snow"].values[path] for path in SKY[:2]]] * 2, atol=1e-6)
    far = np.array([-9000.0, 12_000.0]), np.array([-3000.0, 9000.0])
    np.testing.assert_allclose(weather_at(level, 60.0, *far), weather_at(plain, 60.0, *far), atol=1e-6)
    level.put_object("after", WeatherKey(id="after", time_s=70.0, fade_s=10.0, weather="calm"))
    base, rows = sky_areas(level, 90.0)  # weather that came everywhere later covers it
    assert len(rows) == 0
    assert base == tuple(WEATHERS["calm"].values[path] for path in SKY)


def test_flow_points_come_and_go_with_the_weather():
    """D36 D06: the current is that of the level with the preset's strength; what drifts goes on from where it is."""
    strong = WeatherKey(id="storm", time_s=20.0, fade_s=30.0, weather="storm")
    level, always, plain = keyed(strong), keyed(), keyed()
    for made in (level, always, plain):
        made.put_object("p", FlowPoint(id="p", x=80, y=40, speed_mps=0.4, radius_m=90))
    always.set("flow.points", WEATHERS["storm"].values["flow.points"])
    x, y = np.array([60.0, 100.0]), np.array([30.0, 55.0])
    np.testing.assert_allclose(current(level).at(x, y, points_change(level, 99.0)), current(always).at(x, y), atol=1e-6)
    assert np.array_equal(current(level).at(x, y, points_change(level, 20.0)), current(level).at(x, y))
    assert current(level_at(level, 40.0)) is current(level)
    level.put_mesh("block", block())
    prop = Prop(id="raft", mesh="block", x=40, y=30, floats=True, drifts=True)
    times = np.arange(0.0, 40.0, 0.25)
    way, before = (np.array([drifted(made, prop, t, 0.3) for t in times]) for made in (level, plain))
    np.testing.assert_array_equal(way[times <= 20], before[times <= 20])
    assert np.abs(np.diff(np.hypot(*np.diff(way, axis=0).T) / 0.25)).max() < 0.12
    assert way[-1, 0] > before[-1, 0] + 1.0


@pytest.mark.parametrize("key", [GALE, STORM])
def test_fronts_change_while_flat(key):
    """D36: no front's length, speed or way changes while it stands; all are the preset's in the end."""
    level = keyed(key)
    times = np.linspace(key.time_s - 1, key.time_s + key.fade_s + 1, 4001)
    rows = [fronts_at(level, t) for t in times]
    for group in (0, 1):
        lengths, heights = (
            np.array([getattr(row[group], name) for row in rows]) for name in ("length_m", "amplitude_m")
        )
        changed = np.diff(lengths, axis=0) != 0
        assert (changed.sum(axis=0) == 1).all()
        assert heights[1:][changed].max() < 1e-3 * heights.max()
        assert np.abs(np.diff(heights, axis=0)).max() < 0.02 * heights.max()
        standing = (heights > 0.5 * np.minimum(heights[0], heights[-1])).sum(axis=1)
        assert standing.min() >= 1  # never the whole group at once
    whole = keyed()
    for path, value in WEATHERS[key.weather].values.items():
        whole.set(path, value)
    ended, asked = wave_uniforms(level, 1000.0), wave_uniforms(whole, 1000.0)
    for name in ("u_front_way", "u_front_size", "u_wave_height_m"):
        np.testing.assert_allclose(ended[name], asked[name], rtol=1e-6)
    assert largest_height_m(level) >= ended["u_wave_height_m"]


def test_the_surface_moves_without_a_jump():
    """D36: through a whole fade no point of the open sea moves faster than its waves can carry it."""
    level = keyed(GALE, slope=0.0)
    level.write("height", level.grid.rect, -20.0)
    x, y = np.random.default_rng(5).uniform(10, 150, (2, 40))
    dt = 0.02
    for start in np.linspace(99.0, 161.0, 32):
        heights = np.array([surface_at(level, t, x, y).height_m for t in (start, start + dt, start + 2 * dt)])
        assert np.abs(np.diff(heights, axis=0)).max() < 4.0 * dt
        assert np.abs(np.diff(heights, 2, axis=0)).max() < 8.0 * dt**2 + 1e-6


@pytest.mark.gl
@pytest.mark.parametrize("time_s", [110.0, 131.7, 151.0, 200.0, 7 * 86_400.0])
def test_gpu_has_the_sea_of_the_twin_at_all_times(ctx, time_s):
    """D36 D30: within a millimetre, in the midst of fades too."""
    level = keyed(*KEYS)
    at = np.random.default_rng(1).uniform(5, 120, (300, 2))
    found = feedback(ctx, level, time_s, at)
    twin = surface_at(level, time_s, *at.astype(np.float32).T.astype(np.float64))
    for column, value in ((0, twin.x), (1, twin.y), (2, twin.height_m)):
        assert np.abs(found[:, column] - value).max() < 1e-3
    there = sea_at(level, time_s, twin.x, twin.y)
    open_sea = twin.sheet_m > 0.5
    np.testing.assert_allclose(there.height_m[open_sea], twin.height_m[open_sea], atol=1e-3)


@pytest.mark.gl
def test_gpu_has_the_sky_of_the_twin(renderer):
    """D36: with an area among the keys, in the midst of fades."""
    from test_weather import map_of

    key = WeatherKey(id="here", time_s=420.0, fade_s=100.0, weather="snow", x=2e4, y=3000.0, radius_m=18_000.0)
    level = keyed(*KEYS, key)
    camera = Camera(id="there", x=21_000.0, y=-3500.0, z=60.0)
    for time_s in (150.0, 470.0):
        made = map_of(renderer, level, time_s, camera, "final")
        twin = weather_map(level, time_s, (camera.x, camera.y))
        assert np.abs(made - twin).mean() < 1e-3
        assert np.quantile(np.abs(made - twin), 0.9999) < 0.03


@pytest.mark.gl
def test_pictures_are_the_same_however_reached(renderer):
    """D36: scrubbed forth and back; a key changes what is drawn."""
    level, plain = keyed(GALE), keyed()
    camera = Camera(id="c", x=80.0, y=-30.0, z=25.0, yaw_deg=180, pitch_deg=-5)
    draw = {"size": (64, 36), "quality": "low", "renderer": renderer}
    first = render(level, camera, time_s=130.0, **draw)
    render(level, camera, time_s=500.0, **draw)
    assert np.array_equal(first, render(level, camera, time_s=130.0, **draw))
    assert not np.array_equal(first, render(plain, camera, time_s=130.0, **draw))
    before = render(level, camera, time_s=90.0, **draw)
    assert np.array_equal(before, render(plain, camera, time_s=90.0, **draw))


@pytest.mark.parametrize(
    "keys",
    [
        (("storm", 0.0, 300.0), ("storm", 20.0, 20.0)),
        (("storm", 0.0, 100.0), ("calm", 5.0, 100.0), ("calm", 10.0, 10.0)),
    ],
)
def test_fronts_change_while_flat_where_a_short_key_overtakes_a_long_one(keys):
    """D36: what counts is the sea a front leaves, not that of the key before: two of one weather may overlap."""
    level = keyed()
    for n, (weather, time_s, fade_s) in enumerate(keys):
        level.put_object(f"key-{n}", WeatherKey(id=f"key-{n}", weather=weather, time_s=time_s, fade_s=fade_s))
    times = np.arange(0.0, 45.0, 1 / 30)
    for group in (0, 1):
        fronts = [fronts_at(level, time_s)[group] for time_s in times]
        length = np.array([f.length_m for f in fronts])
        high = np.array([f.amplitude_m for f in fronts])
        changed = np.diff(length, axis=0) != 0
        assert changed.any()
        assert np.maximum(high[:-1], high[1:])[changed].max() < 0.05 * high.max()
