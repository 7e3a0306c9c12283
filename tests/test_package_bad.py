"""Damaged, foreign and hostile level folders: one sentence that names the file, nothing followed out of the folder."""

import json
import shutil

import numpy as np
import pytest
from shorewright.io import LevelFolder, check, read_level, write_level
from shorewright.io.images import write_image
from shorewright.level import BadInput, Grid, Level, Rect
from shorewright.level.objects import Camera

SECTOR = "layers/height_base.r0.c0.exr"


@pytest.fixture
def path(tmp_path):
    level = Level(Grid(200, 150), np.random.default_rng(0).normal(0, 5, (200, 150)).astype(np.float32))
    level.write("foam", Rect(0, 0, 5, 5), 0.5)
    level.put_object("play", Camera(id="play"))
    write_level(level, tmp_path / "a.shore")
    return tmp_path / "a.shore"


def edit(**changes):
    def change(path):
        file = path / "level.json"
        values = json.loads(file.read_text())
        for key, value in changes.items():
            values[key] = value(values[key]) if callable(value) else value
        file.write_text(json.dumps(values))

    return change


def text(content):
    return lambda path: (path / "level.json").write_bytes(content)


def sector(array, **options):
    return lambda path: write_image(path / SECTOR, array, **options)


def cut(count):
    return lambda path: (path / SECTOR).write_bytes((path / SECTOR).read_bytes()[:count])


def garble(path):
    data = bytearray((path / SECTOR).read_bytes())
    data[len(data) // 2 : len(data) // 2 + 200] = bytes(200)
    (path / SECTOR).write_bytes(data)


def link_out(name):
    def change(path):
        outside = path.parent / "outside"
        if (path / name).is_dir():
            shutil.copytree(path / name, outside)
            shutil.rmtree(path / name)
        else:
            shutil.copy(path / name, outside)
            (path / name).unlink()
        (path / name).symlink_to(outside)

    return change


def claim_huge(path):
    """An EXR header that declares a billion samples a side."""
    data = (path / SECTOR).read_bytes()
    at = data.index(b"dataWindow\0box2i\0") + len(b"dataWindow\0box2i\0") + 4
    (path / SECTOR).write_bytes(data[: at + 8] + np.array([10**9, 10**9], "<i4").tobytes() + data[at + 16 :])


def nan_sector(path):
    array = np.zeros((200, 150), np.float32)
    array[5, 5] = np.nan
    write_image(path / SECTOR, array)


def fake_record(name):
    def change(path):
        (path / ".save/layers").mkdir(parents=True)
        (path / ".save/commit.json").write_text(json.dumps({"move": [name], "remove": []}))

    return change


BAD = {
    "newer version": (edit(shorewright_level=999), "newer Shorewright"),
    "version of another kind": (edit(shorewright_level="two"), "version"),
    "version too old": (edit(shorewright_level=0), "version"),
    "not JSON": (text(b"{ nonsense"), "not valid JSON"),
    "empty": (text(b""), "not valid JSON"),
    "binary": (text(b"\xff\xfe\x00"), "not UTF-8"),
    "other JSON": (text(b'{"name": "package"}'), "not the description"),
    "a list": (text(b"[1, 2]"), "not the description"),
    "very deep": (text(b"[" * 100_000), "not valid JSON"),
    "merge conflict": (text(b"{\n<<<<<<< ours\n"), "merge conflict at line 2"),
    "NaN setting": (text(b'{"shorewright_level": 1, "grid": {"rows": 9, "cols": 9, "cell_m": NaN}}'), "cell_m"),
    "huge grid": (edit(grid={"rows": 10**9, "cols": 10**9, "cell_m": 1}), "outside 2 to"),
    "large grid without its files": (edit(grid={"rows": 16385, "cols": 16385, "cell_m": 1}), "incomplete"),
    "no grid": (edit(grid={}), "rows"),
    "zero cell": (edit(grid={"rows": 200, "cols": 150, "cell_m": 0}), "cell"),
    "setting out of range": (edit(settings={"sea": {"swell_m": -3}}), "swell_m"),
    "unknown setting": (edit(settings={"sea": {"colour": 3}}), "colour"),
    "object out of range": (edit(objects=[{"id": "a", "kind": "camera", "fov_deg": 900}]), "fov_deg"),
    "object of no kind": (edit(objects=[{"id": "a", "kind": "dragon"}]), "dragon"),
    "object with a path for an id": (edit(objects=[{"id": "../a", "kind": "camera"}]), "id"),
    "objects of one id": (edit(objects=lambda rows: rows * 2), "two objects"),
    "name leads up": (edit(layers=lambda names: [*names, "../../etc/passwd"]), "not the name of a sector"),
    "absolute name": (edit(layers=lambda names: [*names, "/etc/passwd"]), "not the name of a sector"),
    "name with a newline": (edit(layers=lambda names: [*names, "foam.r0.c0\n"]), "not the name of a sector"),
    "unknown layer": (edit(layers=lambda names: [*names, "lava.r0.c0"]), "lava"),
    "sector outside the grid": (edit(layers=lambda names: [*names, "foam.r7.c0"]), "sectors"),
    "no ground": (edit(layers=[]), "incomplete"),
    "listed file missing": (lambda path: (path / "layers/foam.r0.c0.exr").unlink(), "missing"),
    "layers missing": (lambda path: shutil.rmtree(path / "layers"), "missing"),
    "truncated sector": (cut(5000), "height_base.r0.c0.exr"),
    "cut in its header": (cut(50), "height_base.r0.c0.exr"),
    "empty sector": (cut(0), "empty"),
    "garbled sector": (garble, "height_base.r0.c0.exr"),
    "sector that is text": (lambda path: (path / SECTOR).write_text("hello"), "height_base.r0.c0.exr"),
    "sector that is a folder": (lambda path: ((path / SECTOR).unlink(), (path / SECTOR).mkdir()), "not a file"),
    "wrong size": (sector(np.zeros((100, 150), np.float32)), "150 × 100"),
    "wrong channels": (sector(np.zeros((200, 150, 3), np.float32)), "3 channels"),
    "NaN in a sector": (nan_sector, "not numbers"),
    "sector that claims a billion": (claim_huge, "height_base.r0.c0.exr"),
    "sector linked out": (link_out(SECTOR), "link"),
    "layers linked out": (link_out("layers"), "link"),
    "level.json linked out": (link_out("level.json"), "link"),
    "record that leads out": (fake_record("../../victim"), "leads out"),
    "record of something else": (fake_record(7), "commit record"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_level_folder(path, name):
    """Reading and opening refuse it in one sentence; an editor that was refused leaves the lock free and no litter."""
    damage, told = BAD[name]
    (path.parent / "victim").write_text("mine")
    damage(path)
    before = sorted(str(f) for f in path.parent.rglob("*"))
    for action in (read_level, lambda p: LevelFolder(p).open()):
        with pytest.raises(BadInput) as caught:
            action(path)
        sentence = str(caught.value)
        assert told in sentence
        assert "\n" not in sentence
        assert len(sentence) < 500
    assert sorted(str(f) for f in path.parent.rglob("*")) == before
    assert (path.parent / "victim").read_text() == "mine"
    assert check(path)
    from shorewright.io.lock import take

    take(path).release()


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda path: None, "does not exist"),
        (lambda path: path.mkdir(), "no level.json"),
        (lambda path: path.write_text("hello"), "not a level"),
        (lambda path: (path / "level.json").mkdir(parents=True), "no file"),
    ],
)
def test_no_level(tmp_path, make, told):
    """Paths that are no level at all; looking leaves nothing behind."""
    path = tmp_path / "b.shore"
    make(path)
    before = sorted(tmp_path.rglob("*"))
    for action in (read_level, lambda p: LevelFolder(p).open()):
        with pytest.raises(BadInput, match=told):
            action(path)
    assert sorted(tmp_path.rglob("*")) == before


def test_saving_does_not_follow_links_out(path):
    """A `layers` that is a link out of the folder is not written through."""
    level = read_level(path)
    link_out("layers")(path)
    outside = {f.name: f.read_bytes() for f in (path.parent / "outside").iterdir()}
    level.write("snow", Rect(0, 0, 5, 5), 1.0)
    with pytest.raises(BadInput, match="link"):
        write_level(level, path)
    assert {f.name: f.read_bytes() for f in (path.parent / "outside").iterdir()} == outside


def test_older_water_keeps_its_colour(path):
    """Version 1 had absorption as totals; read again, pure water and what is added give the same totals (L07)."""
    from shorewright.level.water_optics import absorption

    raw = json.loads((path / "level.json").read_text())
    raw["shorewright_level"] = 1
    raw["settings"]["water"] = {"absorb_red": 0.40, "absorb_green": 0.075, "absorb_blue": 0.045, "scatter": 0.055}
    (path / "level.json").write_text(json.dumps(raw))
    water = read_level(path).settings.water
    assert absorption(water) == pytest.approx([0.40, 0.075, 0.045])
    assert water.scatter == 0.055


def test_migrations_run_in_turn(path, monkeypatch):
    """An older version is brought forward one step at a time before it is checked."""
    from shorewright.io import level_json, migrate

    def rename(raw):
        raw["objects"] = raw.pop("things")
        return raw

    monkeypatch.setattr(migrate, "VERSION", 5)
    monkeypatch.setattr(level_json, "VERSION", 5)
    monkeypatch.setattr(migrate, "MIGRATIONS", {3: rename, 4: lambda raw: raw | {"georeference": {"crs": "new"}}})
    values = json.loads((path / "level.json").read_text())
    values["things"] = values.pop("objects")
    (path / "level.json").write_text(json.dumps(values))
    level = read_level(path)
    assert list(level.objects) == ["play"]
    assert level.georeference == {"crs": "new"}
    write_level(level, path)
    assert json.loads((path / "level.json").read_text())["shorewright_level"] == 5
