"""Painted skies of older levels, and of levels whose corner moves: the same sky over the same coast (Z04, T08)."""

import io
import json

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app import recovery_record
from shorewright.app.recovery_offer import changes_of
from shorewright.app.session import Session
from shorewright.io import read_level, write_level
from shorewright.io.level_sectors import channels_of
from shorewright.io.sectors import read_sector, write_sector
from shorewright.level import Grid, Rect
from shorewright.level.layers import WEATHER_GRID
from shorewright.level.weather import paint_place, sample_wrapped, weather_at

NAME = "weather.r0.c0"


def old_sky():
    """A sky as it was painted up to version 2: four channels, cell (0, 0) at the level's corner, two tiles written."""
    rng = np.random.default_rng(4)
    samples, written = np.zeros((512, 512, 4), np.float32), np.zeros((4, 4), bool)
    for row, col in ((0, 0), (1, 3)):
        rect = WEATHER_GRID.tile_rect((row, col))
        samples[rect.slices] = rng.integers(0, 256, (128, 128, 4)) / 256
        written[row, col] = True
    return samples, written


def old_at(samples, x_m, y_m):
    """The old reading, nearest cell: column x / cell, row y / cell, wrapping."""
    cell = WEATHER_GRID.cell_m
    return samples[np.round(y_m / cell).astype(int) % 512, np.round(x_m / cell).astype(int) % 512]


@pytest.fixture
def old(tmp_path):
    """The folder of an old level, and its sky."""
    level = make_beach()
    level.write("weather", Rect(0, 0, 4, 4), 0.5)
    folder = tmp_path / "old.shore"
    write_level(level, folder)
    samples, written = old_sky()
    write_sector(folder / f"layers/{NAME}.exr", samples, True, written)
    (folder / "layers/hashes.json").unlink()
    description = json.loads((folder / "level.json").read_text())
    description["shorewright_level"] = 2
    (folder / "level.json").write_text(json.dumps(description))
    return folder, samples


def test_an_old_sky_is_the_same_sky(old):
    """Z04: each sample stands over the place it stood over, and its one weight is the weight of each channel."""
    folder, samples = old
    level = read_level(folder)
    cells = np.random.default_rng(1).integers(-200, 200, (4000, 2))
    x, y = (cells * WEATHER_GRID.cell_m).T
    found = sample_wrapped(level.layers["weather"].array, *paint_place(level, 0.0, x, y))
    wanted = old_at(samples, x, y)
    np.testing.assert_allclose(found[:, :4], wanted, atol=1e-9)
    np.testing.assert_allclose(found[:, 4:], wanted[:, [3, 3]], atol=1e-9)
    assert level.layers["weather"].written.sum() == 2


def test_the_next_save_writes_it_anew(old):
    """The old file is replaced by the first save, changed or not, and reads the same."""
    folder, _ = old
    before = read_level(folder).layers["weather"].array.copy()
    with Session.open(folder) as session:
        session.save()
    again, _ = read_sector(folder / f"layers/{NAME}.exr", (512, 512), channels_of("weather"))
    np.testing.assert_array_equal(again, before)
    assert json.loads((folder / "level.json").read_text())["shorewright_level"] == 3


def test_old_recovery_logs_hold_old_tiles(tmp_path):
    """T08: the tiles of a killed editor of that time come back where the folder's do."""
    samples, written = old_sky()
    change = recovery_record.Change("Paint")
    change.tiles["weather"] = {
        (row, col): samples[WEATHER_GRID.tile_rect((row, col)).slices] if written[row, col] else None
        for row, col in ((0, 0), (1, 3), (2, 2))
    }
    log = tmp_path / "log"
    start = recovery_record.framed({"kind": "start", "version": 2, "folder": None, "fingerprint": None})
    log.write_bytes(start + recovery_record.encode(change))
    with open(log, "rb") as file:
        (again,) = changes_of(file)
    tiles = again.tiles["weather"]
    assert set(tiles) == {(2, 2), (3, 1), (0, 0)}
    assert tiles[0, 0] is None
    np.testing.assert_array_equal(tiles[2, 2][..., :4], samples[:128, :128])
    np.testing.assert_array_equal(tiles[3, 1][..., 3:], samples[128:256, 384:, [3, 3, 3]])


def test_new_recovery_logs_stay_as_they_are(tmp_path):
    level = make_beach()
    level.write("weather", Rect(100, 100, 200, 200), 0.5)
    packed = recovery_record.encode(recovery_record.everything(level, "all"))
    start = recovery_record.framed({"kind": "start", "version": 3, "folder": None, "fingerprint": None})
    (again,) = changes_of(io.BytesIO(start + packed))
    assert set(again.tiles["weather"]) == {(0, 0), (0, 1), (1, 0), (1, 1)}


@pytest.mark.parametrize("time_s", [0.0, 5000.0])
def test_a_crop_leaves_the_sky_over_its_coast(time_s):
    """Z04: coverage, rain and type over a place on the ground are what they were; undo brings all back in one step."""
    session = Session.new(Grid(129, 161, 8.0))
    with session:
        level = session.level
        level.set("weather.precipitation", 0.4)
        level.set("weather.east_m", 300.0)
        rect = Rect(250, 250, 264, 264)
        level.write("weather", rect, np.random.default_rng(2).random((14, 14, 6)).astype(np.float32))
        x, y = np.random.default_rng(3).uniform(0, 1200, (2, 500))
        before, settings = weather_at(level, time_s, x, y), level.settings
        session.crop(160, 240, 960, 880)
        assert (level.settings.weather.east_m, level.settings.weather.north_m) == (140.0, -240.0)
        np.testing.assert_allclose(weather_at(level, time_s, x - 160, y - 240), before, atol=1e-6)
        assert session.undo() == "Crop"
        assert level.settings == settings
        session.redo()
        assert level.settings.weather.north_m == -240.0


def test_a_crop_far_away_keeps_the_settings_in_range():
    """Z04: the map wraps, so its middle is taken as near as it is."""
    session = Session.new(Grid(65, 65, 8.0))
    with session:
        session.level.set("weather.east_m", -1e6)
        x, y = np.full(50, 400.0), np.linspace(100, 500, 50)
        before = weather_at(session.level, 0.0, x, y)
        session.crop(160, 80, 504, 504)
        assert abs(session.level.settings.weather.east_m) <= 35_000
        np.testing.assert_allclose(weather_at(session.level, 0.0, x - 160, y - 80), before, atol=1e-6)


def test_a_resize_and_another_ground_leave_the_sky_where_it_is(tmp_path):
    """T08: the corner stays, so does the sky over it, paint and all."""
    np.savez(tmp_path / "ground.npz", height=make_beach().height)
    with Session.new(Grid(65, 65, 8.0)) as session:
        level = session.level
        level.write("weather", Rect(250, 250, 262, 262), np.random.default_rng(1).random((12, 12, 6)))
        x, y = np.random.default_rng(2).uniform(0, 500, (2, 200))
        before = weather_at(level, 30.0, x, y)
        assert before[:, 3].any()
        session.resize(samples=100)
        session.import_height(tmp_path / "ground.npz", cell_m=2.0, rows="south-first")
        np.testing.assert_array_equal(weather_at(level, 30.0, x, y), before)
