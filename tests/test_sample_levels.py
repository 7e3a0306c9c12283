"""The sample levels: they open, show what each built row needs, and come out of their generator again (D40 D41)."""

import importlib
from pathlib import Path

import numpy as np
import pytest
from scipy import ndimage
from shorewright.app.script import Script
from shorewright.io import read_level
from shorewright.level import LAYERS
from shorewright.level.objects import Camera, Disturbance, River
from shorewright.level.river_line import centre_line, wrong_with
from shorewright.level.river_map import river_map
from shorewright.level.shore import shore_map
from shorewright.level.waves import sea_at

FOLDER = Path(__file__).parents[1] / "sample_levels"
NAMES = ("cove", "island", "delta")


@pytest.fixture(scope="module", params=NAMES)
def sample(request):
    """(name, level) of each sample level as committed."""
    return request.param, read_level(FOLDER / f"{request.param}.shore")


@pytest.fixture(scope="module")
def cove():
    return read_level(FOLDER / "cove.shore")


def on_screen(camera: Camera, points: np.ndarray, aspect: float = 16 / 9) -> np.ndarray:
    """True where world points `(n, 3)` lie inside the picture of a camera."""
    yaw, pitch = np.radians(camera.yaw_deg), np.radians(camera.pitch_deg)
    ahead = np.array([np.sin(yaw) * np.cos(pitch), np.cos(yaw) * np.cos(pitch), np.sin(pitch)])
    right = np.array([np.cos(yaw), -np.sin(yaw), 0.0])
    away = points - np.array([camera.x, camera.y, camera.z])
    depth, x, y = away @ ahead, away @ right, away @ np.cross(right, ahead)
    high = depth * np.tan(np.radians(camera.fov_deg) / 2)
    return (depth > 0) & (np.abs(x) < high * aspect) & (np.abs(y) < high)


def ground_points(level, where: np.ndarray) -> np.ndarray:
    rows, cols = np.nonzero(where)
    x, y = level.grid.to_metres(rows, cols)
    return np.stack([x, y, level.height[rows, cols]], axis=-1)


def seen_ground(level, camera: Camera) -> np.ndarray:
    """Mask `(rows, cols)` of the samples inside the picture."""
    everywhere = np.ones(level.grid.shape, bool)
    return on_screen(camera, ground_points(level, everywhere)).reshape(level.grid.shape)


def test_is_small_and_finite(sample):
    name, level = sample
    size = sum(path.stat().st_size for path in (FOLDER / f"{name}.shore").rglob("*") if path.is_file())
    assert size < 10_000_000
    assert np.isfinite(level.height).all()
    assert level.height.min() < -25
    assert level.height.max() > 50


@pytest.mark.parametrize("camera", ["play", "beach", "survey"])
def test_has_the_cameras_above_ground(sample, camera):
    """D40: the three cameras, none under the ground or the highest water of half a minute."""
    _, level = sample
    eye = level.camera(camera)
    col, row = np.clip([eye.x, eye.y], 0, np.array(level.grid.extent_m)).astype(int)
    assert eye.z > level.height[row, col] + 1
    water = [float(sea_at(level, float(t), eye.x, eye.y).height_m) for t in range(30)]
    assert eye.z > max(water) + 0.3


def test_play_looks_at_water_and_sand(sample):
    """D40: steep and high; sea and beach both take a good part of the picture; the sun is ahead, behind the player."""
    _, level = sample
    play = level.camera("play")
    assert play.pitch_deg == -55
    assert 40 <= play.z <= 62
    turn = (play.yaw_deg - level.settings.light.sun_azimuth_deg + 180) % 360 - 180
    assert abs(turn) < 45
    seen = seen_ground(level, play)
    assert seen.sum() > 3000
    assert 0.2 < (level.height[seen] < 0).mean() < 0.8
    fronts = seen & (shore_map(level).packed[..., 2] > 0.5) & (level.height > -level.settings.shore.range_m)
    assert fronts.sum() > 1000


def test_swash_has_the_slope_of_a_beach(cove):
    """D03 D10: between 1:25 and 1:12 through the swash before `play`, so that the water runs up visibly."""
    reach = cove.settings.shore.range_m * cove.settings.shore.runup
    north, east = np.gradient(cove.height.astype(float))
    swash = seen_ground(cove, cove.camera("play")) & (np.abs(cove.height) < reach)
    assert 1 / 25 < np.median(np.hypot(north, east)[swash]) < 1 / 11


def test_fronts_cross_the_surf_at_a_plausible_speed(sample):
    """D03: ground speed = range · (1 + runup) / (interval · count · slope)."""
    _, level = sample
    shore = level.settings.shore
    bed = shore_map(level).packed[..., 0].astype(float)
    north, east = np.gradient(bed)
    surf = seen_ground(level, level.camera("play")) & (bed > 0.5) & (bed < 0.8 * shore.range_m)
    slope = np.median(np.hypot(north, east)[surf])
    speed = shore.range_m * (1 + shore.runup) / (shore.interval_s * shore.count * slope)
    assert 1.5 < speed < 10


@pytest.mark.parametrize("layer", [name for name, row in LAYERS.items() if row.grid == "level"])
def test_cove_has_paint_before_play(cove, layer):
    """A patch in each layer, in the picture of `play`, so that no view of a built row is blank there."""
    data = cove.layers[layer]
    assert not data.neutral
    painted = np.abs(data.sculpt if layer == "height" else data.array) > 0.05
    painted = painted.any(axis=-1) if painted.ndim == 3 else painted
    assert on_screen(cove.camera("play"), ground_points(cove, painted)).sum() > 40
    if layer not in ("flow", "height", "river_surface"):
        assert data.array.min() >= 0
        assert data.array.max() <= 1


def test_cove_has_painted_clouds_over_the_sea(cove):
    weather = cove.layers["weather"]
    rows, _ = np.nonzero(weather.array[..., 0] > 0.3)
    assert len(rows) > 200
    assert np.median(rows) < 256  # south of the middle, which is the level's corner


def test_cove_river_runs_down_into_the_sea(cove):
    """D13 D35: the painted surface lies on the bed, never rises on its way, and meets the sea level."""
    mask = cove.layers["river_mask"].array > 0.5
    depth = (cove.layers["river_surface"].array - cove.height)[mask]
    assert 0 <= np.median(depth) < 2
    rows = np.nonzero(mask.any(axis=1))[0]
    surface = [np.median(cove.layers["river_surface"].array[row][mask[row]]) for row in rows]
    assert abs(surface[0] - cove.sea_level_m) < 0.05
    assert surface[-1] > 5
    assert np.min(np.diff(surface)) > -0.05


def test_cove_has_disturbances_in_the_water_before_play(cove):
    pushes = [thing for thing in cove.objects.values() if isinstance(thing, Disturbance)]
    assert pushes
    for push in pushes:
        assert cove.height[round(push.y), round(push.x)] < 0
    points = np.array([[push.x, push.y, cove.sea_level_m] for push in pushes])
    assert on_screen(cove.camera("play"), points).all()


def test_island_has_a_lagoon_that_the_sea_reaches():
    island = read_level(FOLDER / "island.shore")
    height, sea = island.height, shore_map(island).packed[..., 2]
    border = np.concatenate([height[0], height[-1], height[:, 0], height[:, -1]])
    assert border.max() < -10
    assert height[400, 760] < -2  # inside the reef
    assert sea[400, 760] > 0.9
    crossing = height[400, 760:]  # eastwards, over the reef to the open sea
    assert crossing.max() > -1.5
    assert crossing[-1] < -20


@pytest.fixture(scope="module")
def delta():
    return read_level(FOLDER / "delta.shore")


def test_delta_has_two_rivers_from_a_spring_over_a_fall_to_the_sea(delta):
    """D13 D35: some 25 m down, 4 to 6 m of it within a few metres of way; both mouths at the sea's level."""
    lines = [centre_line(thing, delta.mean_sea_m) for thing in delta.objects.values() if isinstance(thing, River)]
    assert len(lines) == 2
    main = max(lines, key=lambda line: line.along_m[line.mouth - 1])
    assert 20 < main.level_m[0] < 30
    five_m = np.searchsorted(main.along_m, main.along_m + 5).clip(max=len(main.x) - 1)
    assert 4 < (main.level_m - main.level_m[five_m])[: main.mouth].max() < 6.5
    for line in lines:
        assert abs(line.level_m[line.mouth - 1] - delta.mean_sea_m) < 0.05
        assert delta.height[int(line.y[-1]), int(line.x[-1])] < -1
        depth = line.level_m - delta.height[np.rint(line.y).astype(int), np.rint(line.x).astype(int)]
        assert (depth[: line.mouth] > 0.1).mean() > 0.95  # but for boulders


def test_deltas_banks_hold_its_water(delta):
    """D13: past the edge of the water the ground is higher, all along."""
    made = river_map(delta).packed
    inland = shore_map(delta).packed[..., 2] < 0.01
    rim = (made[..., 1] > 0) & (made[..., 1] < 0.5) & inland & (made[..., 0] > 0.3)
    assert rim.sum() > 2000
    assert (made[..., 0] - delta.height)[rim].max() < 0.05


def test_delta_has_water_at_four_levels(delta):
    """H32: spring, lake, pool and ocean in one level; what stands is level and joins no other water."""
    mask, surface = (delta.layers[name].array for name in ("river_mask", "river_surface"))
    bodies, count = ndimage.label(mask > 0.5)
    levels = [surface[bodies == body] for body in range(1, count + 1) if (bodies == body).sum() > 50]
    assert len(levels) == 3
    assert all(np.ptp(part) < 0.02 for part in levels)
    assert sorted(round(float(part.mean()), 1) for part in levels) == pytest.approx([1.8, 15.3, 24.0], abs=0.1)


def test_scripts_of_the_river_pictures_run_and_wrong_rivers_are_refused(monkeypatch):
    """D13: what docs/rivers.md shows can be done, and what it says can't be is told."""
    monkeypatch.syspath_prepend(str(FOLDER))
    pictures = importlib.import_module("river_pictures")
    assert all(wrong_with(points) for points in pictures.WRONG.values())
    asked = {shot.level.partition("+") for shot in pictures.RIVERS}
    for name, plus, session in asked:
        assert (FOLDER / f"{name}.shore").is_dir()
        if plus:
            assert Script.model_validate_json((FOLDER / f"{session}.json").read_text("utf-8")).actions


def test_generator_gives_the_committed_levels(sample, monkeypatch):
    """Made again from the seed: the same settings and objects, and the same maps to a rounding step."""
    name, level = sample
    monkeypatch.syspath_prepend(str(FOLDER))
    again = importlib.import_module("make").LEVELS[name]()
    assert again.settings == level.settings
    assert again.objects == level.objects
    assert np.abs(again.height - level.height).max() <= 1 / 512
    for layer, data in again.layers.items():
        assert (data.written == level.layers[layer].written).all(), layer
        assert np.allclose(data.array, level.layers[layer].array, atol=2e-3), layer
