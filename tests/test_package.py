"""Level folders: what is saved comes back the same, and only what changed is written (T08, T10)."""

import json

import numpy as np
import pytest
from shorewright.io import LevelFolder, check, read_level, write_level
from shorewright.io.images import load_image
from shorewright.level import LAYERS, BadInput, Grid, Journal, Level, Rect, Settings
from shorewright.level.objects import Camera, Disturbance, SeaSeed


def ground(rows, cols, seed=0):
    return np.random.default_rng(seed).normal(0, 5, (rows, cols)).astype(np.float32)


def make(rows=1100, cols=2100, cell_m=2.0):
    return Level(Grid(rows, cols, cell_m), ground(rows, cols))


def files(path):
    return {file.name: file.stat().st_ino for file in path.rglob("*") if file.is_file()}


def same(one, two):
    assert (one.grid, one.settings, one.objects, one.georeference) == (
        two.grid,
        two.settings,
        two.objects,
        two.georeference,
    )
    assert np.array_equal(one.layers["height"].base, two.layers["height"].base)
    for name, data in one.layers.items():
        other = two.layers[name]
        assert np.array_equal(data.written, other.written), name
        if not data.neutral or name == "height":
            assert np.array_equal(data.array, other.array), name
    assert np.array_equal(one.layers["height"].sculpt, two.layers["height"].sculpt)


@pytest.mark.parametrize("name", LAYERS)
def test_every_layer_comes_back(tmp_path, name):
    """Each row of LAYERS, painted across a sector's edge with fractions and negatives, comes back the same."""
    level = make(300, 1300) if LAYERS[name].grid == "level" else make(40, 40)
    data = level.layers[name]
    rect = Rect(100, 1000, 230, 1100) if LAYERS[name].grid == "level" else Rect(100, 100, 300, 260)
    values = np.random.default_rng(1).normal(0, 1, rect.shape + data.shape[2:])
    level.write(name, rect, values)
    write_level(level, tmp_path / "a.shore")
    same(level, read_level(tmp_path / "a.shore"))


def test_settings_objects_and_place_come_back(tmp_path):
    """All that is no map: settings out of their defaults, one object of each kind, a georeference."""
    level = make(20, 30)
    level.set("sea.swell_m", 1.25)
    level.set("light.display", "neutral")
    for thing in (Camera(id="play", x=3.5, yaw_deg=-20), SeaSeed(id="b.seed"), Disturbance(id="push", time_s=1 / 3)):
        level.put_object(thing.id, thing)
    level.georeference = {"crs": "EPSG:32604", "easting": 626000.25, "northing": 2373000.0}
    write_level(level, tmp_path / "a.shore")
    same(level, read_level(tmp_path / "a.shore"))


@pytest.mark.parametrize("side", [2, 127, 128, 129, 1024, 1025, 1026, 2048, 2049, 2050])
def test_sizes_around_tiles_and_sectors(tmp_path, side):
    """The last sector takes the closing row: no size loses a row or a tile."""
    level = make(side, 5)
    level.write("foam", Rect(side - 1, 0, side, 5), 0.5)
    level.write("height", Rect(side - 1, 2, side, 5), 7.0)
    write_level(level, tmp_path / "a.shore")
    same(level, read_level(tmp_path / "a.shore"))
    assert len(list((tmp_path / "a.shore/layers").glob("height_base.*"))) == max((side - 2) // 1024, 0) + 1


def test_a_tile_of_plain_zero_stays_written(tmp_path):
    """Painted zero and never painted differ for undo; the file keeps the difference."""
    level = make(300, 300)
    level.write("flow", Rect(130, 130, 140, 140), 0.0)
    level.write("height", Rect(0, 0, 5, 5), level.height[0:5, 0:5].copy())
    write_level(level, tmp_path / "a.shore")
    again = read_level(tmp_path / "a.shore")
    assert np.argwhere(again.layers["flow"].written).tolist() == [[1, 1]]
    assert np.argwhere(again.layers["height"].written).tolist() == [[0, 0]]
    assert again.layers["snow"].neutral


def test_the_same_level_gives_the_same_bytes(tmp_path):
    """No date, counter or memory of its past is in a level's files."""
    level = make()
    level.write("cover", Rect(5, 5, 50, 50), 0.25)
    write_level(level, tmp_path / "a.shore")
    write_level(read_level(tmp_path / "a.shore"), tmp_path / "b.shore")
    level.write("cover", Rect(5, 5, 50, 50), 0.75)
    write_level(level, tmp_path / "a.shore")
    level.write("cover", Rect(5, 5, 50, 50), 0.25)
    write_level(level, tmp_path / "a.shore")
    one, two = ({f.name: f.read_bytes() for f in (tmp_path / n).rglob("*.*")} for n in ("a.shore", "b.shore"))
    assert one.keys() == two.keys()
    assert all(one[name] == two[name] for name in one)


def test_only_dirty_sectors_are_written(tmp_path):
    """Inodes tell: a stroke rewrites its sector and the hashes, a setting only level.json, nothing nothing."""
    path = tmp_path / "a.shore"
    level = make()
    level.write("height", Rect(0, 0, 10, 10), 3.0)
    level.write("height", Rect(0, 1500, 10, 1510), 3.0)
    write_level(level, path)
    before = files(path)
    assert write_level(level, path) == []
    assert files(path) == before
    for at in range(300):  # more changes than the level's log of rectangles holds
        level.write("height", Rect(at, 1500, at + 2, 1510), 1.0)
    assert write_level(level, path) == ["layers/height.r0.c1.exr", "layers/hashes.json"]
    after = files(path)
    assert {name for name in before if before[name] != after[name]} == {"height.r0.c1.exr", "hashes.json"}
    level.set("sea.swell_m", 2.0)
    assert write_level(level, path) == ["level.json"]
    loaded = read_level(path)
    assert write_level(loaded, path) == []
    loaded.write("foam", Rect(0, 1023, 1, 1025), 0.5)  # across the edge of two sectors
    assert write_level(loaded, path) == [
        "layers/foam.r0.c0.exr",
        "layers/foam.r0.c1.exr",
        "layers/hashes.json",
        "level.json",
    ]
    same(loaded, read_level(path))


def test_another_base_rewrites_the_base(tmp_path):
    """After an import over the same grid the base is saved again, and only the sculpted sectors stay with it."""
    path = tmp_path / "a.shore"
    level = make(200, 200)
    write_level(level, path)
    level.reset(level.grid, ground(200, 200, 9))
    assert "layers/height_base.r0.c0.exr" in write_level(level, path)
    same(level, read_level(path))


def test_undo_takes_the_sector_away_again(tmp_path):
    """A stroke undone after a save leaves no file behind (T08)."""
    path = tmp_path / "a.shore"
    level = make(200, 200)
    journal = Journal(level)
    write_level(level, path)
    before = {f.name: f.read_bytes() for f in path.rglob("*.*")}
    with journal.step("Paint") as step:
        step.save(level.layers["snow"], Rect(0, 0, 9, 9))
        level.layers["snow"].array[0:9, 0:9] = 0.5
        level.mark("snow", Rect(0, 0, 9, 9))
    write_level(level, path)
    assert (path / "layers/snow.r0.c0.exr").exists()
    journal.undo()
    write_level(level, path)
    assert {f.name: f.read_bytes() for f in path.rglob("*.*")} == before


def test_a_file_somebody_else_deleted_is_written_again(tmp_path):
    """Saving trusts the disk, not its memory of it."""
    path = tmp_path / "a.shore"
    level = make(200, 200)
    write_level(level, path)
    (path / "layers/height_base.r0.c0.exr").unlink()
    write_level(level, path)
    same(level, read_level(path))


def test_sectors_are_pictures_with_north_on_top(tmp_path):
    """Float32 ZIP `Y` for one map, half R G B for two, RGBA for four; row 0 of the file is north (design, On disk)."""
    level = make(50, 60)
    level.write("foam", Rect(0, 0, 5, 60), (0.25, 0.75))
    level.write("cover", Rect(0, 0, 5, 60), (0.25, 0.5, 0.75, 1.0))
    write_level(level, tmp_path / "a.shore")
    layers = tmp_path / "a.shore/layers"
    header, base = load_image(layers / "height_base.r0.c0.exr")
    assert (header.dtype, header.channels, header.attributes["compression"]) == ("float", ("Y",), "zip")
    assert np.array_equal(base[..., 0], level.height[::-1])
    header, foam = load_image(layers / "foam.r0.c0.exr")
    assert (header.dtype, header.channels) == ("half", ("R", "G", "B"))
    assert foam[-1, 0].tolist() == [0.25, 0.75, 0.0]
    assert foam[0].any() == np.False_
    header, cover = load_image(layers / "cover.r0.c0.exr")
    assert header.channels == ("R", "G", "B", "A")
    assert cover[-1, 0].tolist() == [0.25, 0.5, 0.75, 1.0]


def test_level_json_merges(tmp_path):
    """One setting a line, one object a line sorted by id: two people's edits touch different lines."""
    level = make(20, 20)
    for name in ("zoo", "beach", "play"):
        level.put_object(name, Camera(id=name))
    write_level(level, tmp_path / "a.shore")
    lines = (tmp_path / "a.shore/level.json").read_text().splitlines()
    objects = [json.loads(line.rstrip(",")) for line in lines if line.startswith('{"id"')]
    assert [thing["id"] for thing in objects] == ["beach", "play", "zoo"]
    assert sum('"swell_m"' in line for line in lines) == 1
    values = json.loads("\n".join(lines))
    assert Settings.model_validate(values["settings"]) == level.settings
    assert not any(word in key for key in values for word in ("hash", "date", "time", "count", "revision"))


def test_a_sector_another_tool_saved_again(tmp_path):
    """Refused for its hash; without that it is used, and every tile that isn't zero counts as written."""
    from shorewright.io.images import write_image

    path = tmp_path / "a.shore"
    level = make(300, 300)
    level.write("height", Rect(0, 0, 3, 3), 50.0)
    write_level(level, path)
    assert check(path) == []
    file = path / "layers/height.r0.c0.exr"
    sculpt = load_image(file)[1]
    sculpt[0, -1] = 1.0  # the north-east corner
    write_image(file, sculpt)
    with pytest.raises(BadInput, match=r"height\.r0\.c0\.exr was damaged or changed"):
        read_level(path)
    assert "hash differs" in check(path)[0]
    (path / "layers/hashes.json").unlink()
    notes = []
    again = read_level(path, notes)
    assert np.argwhere(again.layers["height"].written).tolist() == [[0, 0], [2, 2]]
    assert again.height[-1, -1] == level.height[-1, -1] + 1
    assert len(notes) == len(check(path)) == 1
    assert "no hash" in notes[0]
    write_level(again, path)
    assert check(path) == []
    same(again, read_level(path))


def test_python_face(tmp_path):
    """`shorewright.open` reads a level; opening for editing gives the same one."""
    import shorewright

    level = make(20, 20)
    write_level(level, tmp_path / "a.shore")
    same(level, shorewright.open(tmp_path / "a.shore"))
    with LevelFolder(tmp_path / "a.shore") as folder:
        same(level, folder.open())
