"""Skies of their own for shots (Z20): when they show, what they show, how they are kept."""

import numpy as np
import pytest
from shorewright.level import BadInput, Rect
from shorewright.level.objects import Camera, Shot
from shorewright.level.shots import MOST, SHAPE, shots_at, skies_in_use, sky_name, sky_of
from shorewright.level.weather import SIDE, TILE_M, texel_metres, weather_at, weather_map
from test_weather import cloudy, map_of, paint


def even_sky(coverage=0.9, rain=0.25, kind=0.5):
    return sky_of(np.broadcast_to(np.float32([coverage, rain, kind]), SHAPE))


def waves_sky(turns=3):
    x, y = texel_metres()
    return sky_of(np.stack([0.5 + 0.5 * np.sin(2 * np.pi * turns * at / TILE_M) for at in (x, y, x + y)], -1))


def add(level, name, sky, **fields):
    held = sky_name(name, sky)
    level.put_sky(held, sky)
    level.put_object(name, Shot(id=name, map=held, **fields))


def shares(level, time_s, camera=""):
    return {seen.shot.id: seen.share for seen in shots_at(level, time_s, camera)}


def test_shot_fades_in_and_out():
    """Z20: nothing at start and end, half after half a fade, whole between; at once without a fade."""
    level = cloudy()
    add(level, "dawn", even_sky(), start_s=10.0, end_s=30.0, fade_s=4.0)
    for time_s, share in ((9.9, None), (10.0, None), (12.0, 0.5), (14.0, 1.0), (26.0, 1.0), (28.0, 0.5), (30.0, None)):
        assert shares(level, time_s).get("dawn") == (pytest.approx(share) if share else None)
    add(level, "dawn", even_sky(), start_s=10.0, end_s=30.0, fade_s=0.0)
    assert [shares(level, t) for t in (9.99, 10.0, 29.99, 30.0)] == [{}, {"dawn": 1.0}, {"dawn": 1.0}, {}]


def test_camera_has_its_own_shot():
    """Z20: others don't see it; it lies over what all cameras have."""
    level = cloudy()
    add(level, "all", even_sky(), start_s=5.0, end_s=30.0, fade_s=1.0)
    add(level, "close", even_sky(0.1), start_s=0.0, end_s=30.0, fade_s=1.0, camera="beach")
    assert list(shares(level, 10.0, "play")) == ["all"]
    assert list(shares(level, 10.0, "beach"))[-1] == "close"
    sky = weather_at(level, 10.0, np.zeros(1), np.zeros(1), None, "painted", "beach")
    assert sky[0, 0] == pytest.approx(0.1, abs=1e-3)


def test_shots_that_overlap_fade_into_each_other():
    """Z20: the simulation never shines through, and nothing jumps."""
    level = cloudy()
    add(level, "first", even_sky(1.0), start_s=0.0, end_s=30.0, fade_s=10.0)
    add(level, "second", even_sky(0.0, 0.0, 0.0), start_s=20.0, end_s=60.0, fade_s=10.0)
    at = np.zeros(1), np.zeros(1)
    assert weather_at(level, 25.0, *at, None, "painted")[0, 0] == pytest.approx(0.5, abs=1e-3)
    for time_s in (22.0, 27.0, 29.9):
        seen = shots_at(level, time_s)
        assert seen[0].share == 1.0
    rows = np.array([weather_at(level, t, *at, None, "painted")[0] for t in np.arange(0, 62, 0.1)])
    assert np.abs(np.diff(rows, axis=0)).max() < 0.02


def test_any_number_at_once_fade_into_each_other():
    """Z20: of five that overlap each counts, by weights that add up to one; nothing jumps, one that is covered goes."""
    level = cloudy()
    for name, start in (("a", 0.0), ("b", 4.0), ("c", 6.0), ("d", 7.0), ("e", 7.5)):
        add(level, name, even_sky(start / 10), start_s=start, end_s=50.0 + start, fade_s=4.0)
    assert list(shares(level, 7.9)) == ["a", "b", "c", "d", "e"]
    assert list(shares(level, 30.0)) == ["e"]
    at, weights, open_share = (np.zeros(1), np.zeros(1)), {}, 1.0
    for name, share in reversed(shares(level, 7.9).items()):
        weights[name], open_share = share * open_share, open_share * (1 - share)
    assert open_share == 0
    assert all(weights.values())
    mean = sum(level.objects[name].start_s / 10 * weight for name, weight in weights.items())
    assert weather_at(level, 7.9, *at, None, "painted")[0, 0] == pytest.approx(mean, abs=1e-3)
    rows = np.array([weather_at(level, t, *at, None, "painted")[0, 0] for t in np.arange(3, 60, 0.1)])
    assert np.abs(np.diff(rows)).max() < 0.03


def test_more_than_there_is_room_for():
    """Z20: of more than MOST that are seen in part those of least weight stay away."""
    level = cloudy()
    for n in range(MOST + 2):
        add(level, f"s{n:02}", even_sky(), start_s=0.01 * n, end_s=50.0, fade_s=20.0)
    seen = shares(level, 8.0)
    assert len(seen) == MOST
    assert list(seen) == sorted(seen)


def test_shot_replaces_the_simulation_under_the_paint():
    """Z20: its sky exactly at its start, and the paint over it; the horizon's sky only where it is not whole."""
    level = cloudy()
    sky = waves_sky()
    add(level, "one", sky, start_s=100.0, end_s=300.0, fade_s=0.0, whole=True)
    corner = np.arange(SIDE) / SIDE * TILE_M - TILE_M / 2
    x, y = np.meshgrid(corner, corner)
    made = weather_at(level, 100.0, x, y, None, "painted")
    np.testing.assert_allclose(made[..., :3], sky.astype(np.float32), atol=1e-6)
    np.testing.assert_allclose(
        weather_map(level, 100.0, (0.0, 0.0), "horizon")[3, 3],
        weather_at(level, 100.0, *(np.float64(v[3, 3]) for v in texel_metres()), None, "painted"),
        atol=1e-6,
    )
    level.put_object("one", level.objects["one"].model_copy(update={"whole": False}))
    np.testing.assert_allclose(weather_map(level, 100.0, (0.0, 0.0), "horizon")[3, 3, :3], [0.5, 0, 1], atol=1e-6)
    paint(level, Rect(0, 0, 512, 512), 0.125, 0.25, 0.75, 1.0)
    level.put_object("one", level.objects["one"].model_copy(update={"painted": False}))
    np.testing.assert_allclose(weather_at(level, 100.0, x, y, None, "painted")[..., :3], made[..., :3])
    level.put_object("one", level.objects["one"].model_copy(update={"painted": True}))
    np.testing.assert_allclose(weather_map(level, 200.0, (0.0, 0.0), "painted")[..., 0], 0.125)


def test_shot_drifts_from_its_start():
    """Z20 Z07: what stands over a place then is downwind of it later; or stays, as asked."""
    level = cloudy()
    level.set("weather.wind_mps", 10.0)
    level.set("weather.heading_deg", 90.0)
    add(level, "one", waves_sky(), start_s=50.0, end_s=3000.0, fade_s=0.0)
    x, y = np.array([1234.0]), np.array([-777.0])
    then = weather_at(level, 50.0, x, y, None, "painted")
    np.testing.assert_allclose(weather_at(level, 250.0, x + 2000.0, y, None, "painted"), then, atol=1e-5)
    level.put_object("one", level.objects["one"].model_copy(update={"drifts": False}))
    np.testing.assert_allclose(weather_at(level, 250.0, x, y, None, "painted"), then, atol=1e-6)


def test_no_shot_leaves_all_bits(renderer):
    """Z20: twin and GPU make the very same map with a shot that is over as without any."""
    level, camera = cloudy(), Camera(id="there", z=60.0)
    bare = [map_of(renderer, level, 40.0, camera, "final"), weather_map(level, 40.0, (0.0, 0.0))]
    add(level, "over", even_sky(), start_s=0.0, end_s=40.0, fade_s=0.0)
    add(level, "elsewhere", even_sky(), start_s=0.0, end_s=90.0, fade_s=0.0, camera="other")
    for made, before in zip(
        (map_of(renderer, level, 40.0, camera, "final"), weather_map(level, 40.0, (0.0, 0.0))), bare
    ):
        np.testing.assert_array_equal(made, before)


@pytest.mark.parametrize("time_s", [24.5, 26.5, 44.0, 22.0])
def test_gpu_shows_shots_as_the_twin(renderer, time_s):
    """Z20: one to four of them, faded, drifted, under paint, for the camera that has them; layers used again."""
    level = cloudy()
    camera = Camera(id="there", x=9000.0, y=-3000.0, z=60.0)
    add(level, "one", waves_sky(), start_s=0.0, end_s=30.0, fade_s=8.0)
    add(level, "two", waves_sky(2), start_s=20.0, end_s=50.0, fade_s=8.0, camera="there", whole=True, painted=False)
    add(level, "three", waves_sky(5), start_s=23.0, end_s=27.0, fade_s=2.0, camera="there")
    add(level, "four", waves_sky(1), start_s=24.0, end_s=25.5, fade_s=1.0, camera="there", drifts=False)
    paint(level, Rect(200, 230, 300, 290), 0.9, 0.6, 0.3, 0.8)
    assert len(shots_at(level, time_s, "there")) == {24.5: 4, 26.5: 3, 44.0: 1, 22.0: 2}[time_s]
    made = map_of(renderer, level, time_s, camera, "final")
    twin = weather_map(level, time_s, (camera.x, camera.y), "final", "there")
    assert np.abs(made - twin).mean() < 1e-3
    assert np.quantile(np.abs(made - twin), 0.9999) < 0.02
    assert np.abs(twin - weather_map(level, time_s, (camera.x, camera.y))).max() > 0.05


def test_sky_is_checked_and_named_by_what_it_is():
    """Z20: shape and range; equal skies have one name."""
    for wrong in (np.zeros((4, 4, 3)), np.full(SHAPE, 1.5), np.full(SHAPE, np.nan)):
        with pytest.raises(BadInput):
            sky_of(wrong)
    assert sky_name("a b!", even_sky()) == sky_name("a b", even_sky()) != sky_name("a b", even_sky(0.2))
    assert skies_in_use(cloudy()) == set()


def test_skies_are_saved_where_a_shot_names_them(tmp_path):
    """Z20: bit for bit through a save, written once, gone with the last shot; a damaged one is told."""
    from shorewright.io import read_level
    from shorewright.io.package import LevelFolder

    level, path = cloudy(), tmp_path / "a.shore"
    add(level, "one", waves_sky(), start_s=0.0, end_s=30.0, fade_s=8.0)
    level.put_sky("unused_00000000", even_sky())
    name = level.objects["one"].map
    with LevelFolder(path) as folder:
        assert f"skies/{name}.exr" in folder.save(level)
        assert not folder.save(level)
        assert [file.stem for file in (path / "skies").iterdir()] == [name]
    again = read_level(path)
    np.testing.assert_array_equal(again.skies[name], level.skies[name])
    assert again.objects["one"] == level.objects["one"]
    file = path / "skies" / f"{name}.exr"
    whole = file.read_bytes()
    for damaged, told in ((whole[:900], "shows the simulation"), (None, "is missing")):
        file.write_bytes(damaged) if damaged else file.unlink()
        notes = []
        assert not read_level(path, notes).skies
        assert told in notes[0]
    with LevelFolder(path) as folder:
        level.put_object("one", None)
        folder.save(level)
    assert not (path / "skies").exists()
