"""Every verb with bad arguments: exit code 2, one line on stderr, no traceback, nothing written (T10)."""

import json
import shutil
import sys

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app.cli import VERBS, main
from shorewright.io import LevelFolder, write_level

GOOD = {"version": 1, "actions": [{"do": "stroke", "brush": "raise", "points": [[60, 60]]}]}


def then(action):
    """A script whose second action is this."""
    return json.dumps({"version": 1, "actions": [*GOOD["actions"], action]})


SCRIPTS = {
    "good.json": json.dumps(GOOD),
    "cut.json": "{",
    "list.json": "[]",
    "newer.json": json.dumps({**GOOD, "version": 99}),
    "brush.json": then({"do": "stroke", "brush": "x", "points": [[1, 1]]}),
    "crop.json": then({"do": "crop", "west_m": 0, "south_m": 0, "east_m": 1e6, "north_m": 1}),
    "import.json": then({"do": "import", "path": "coast.npz", "flags": {"wet": 1}}),
    "kind.json": then({"do": "import", "path": "coast.npz", "flags": {"height_range": 5}}),
}

BAD = {
    "": [["paint"], ["--paint"], ["new", "--help-me"]],
    "shot": [
        ["bogus"],
        ["add"],
        ["add", "beach.shore"],
        ["add", "beach.shore", "--start", "1"],
        ["add", "beach.shore", "--start", "9", "--end", "2"],
        ["add", "beach.shore", "--start", "1", "--end", "inf"],
        ["add", "beach.shore", "--start", "1", "--end", "9", "--fade", "-1"],
        ["add", "beach.shore", "--start", "1", "--end", "9", "--name", "a b"],
        ["add", "beach.shore", "--start", "1", "--end", "9", "--from", "nowhere.png"],
        ["add", "beach.shore", "--start", "1", "--end", "9", "--from", "broken.png"],
        ["add", "taken.shore", "--start", "1", "--end", "9"],
        ["add", "nowhere.shore", "--start", "1", "--end", "9"],
        ["list", "nowhere.shore"],
        ["list", "beach.shore", "--start"],
        ["remove", "beach.shore"],
        ["remove", "beach.shore", "none"],
    ],
    "lint": [
        [],
        ["nowhere.shore"],
        ["text.txt"],
        ["beach.shore", "--range", "0"],
        ["beach.shore", "--range", "nan"],
        ["beach.shore", "--range", "fast"],
        ["beach.shore", "--bogus"],
    ],
    "new": [
        [],
        ["beach.shore"],
        ["text.txt"],
        ["a.shore", "b.shore"],
        ["nowhere/a.shore"],
        ["a.shore", "--size", "1"],
        ["a.shore", "--size", "wide"],
        ["a.shore", "--size", "999999"],
        ["a.shore", "--size", "40000x40000"],
        ["a.shore", "--cell-m", "0"],
        ["a.shore", "--cell-m", "nan"],
        ["a.shore", "--cell-m", "big"],
        ["a.shore", "--sea-level", "1e9"],
        ["a.shore", "--sea-level", "nan"],
        ["a.shore", "--rows", "north-first"],
        ["a.shore", "--rows", "sideways"],
        ["a.shore", "--resample", "1"],
        ["a.shore", "--from"],
        ["a.shore", "--from", "nowhere.png"],
        ["a.shore", "--from", "text.txt"],
        ["a.shore", "--from", "broken.png"],
        ["a.shore", "--from", "beach.shore"],
        ["a.shore", "--from", "coast.npz", "--array", "depth"],
        ["a.shore", "--from", "coast.npz", "--cell-m", "1x2x3"],
        ["a.shore", "--from", "coast.npz", "--size", "12"],
        ["a.shore", "--from", "coast.npz", "--height-range", "1"],
        ["a.shore", "--from", "coast.npz", "--sea-level", "1e9"],
        ["a.shore", "--from", "coast.npz", "--resample", "99999"],
        ["a.shore", "--from", "nan.npz"],
    ],
    "info": [[], ["nowhere.shore"], ["text.txt"], ["empty"], ["beach.shore", "more"], ["beach.shore", "--yaml"]],
    "resize": [
        [],
        ["beach.shore"],
        ["nowhere.shore", "--size", "100"],
        ["beach.shore", "--size", "1"],
        ["beach.shore", "--size", "1e5"],
        ["beach.shore", "--size", "99999"],
        ["beach.shore", "--cell-m", "-1"],
        ["beach.shore", "--cell-m", "inf"],
        ["beach.shore", "--cell-m", "1", "--size", "9"],
        ["beach.shore", "--sea-level", "1e9"],
        ["beach.shore", "--sea-level", "1", "--size", "1"],
        ["taken.shore", "--size", "100"],
    ],
    "crop": [
        [],
        ["beach.shore"],
        ["beach.shore", "1,2,3"],
        ["beach.shore", "a,b,c,d"],
        ["beach.shore", "0,0,nan,9"],
        ["beach.shore", "-1,0,9,9"],
        ["beach.shore", "9,9,0,0"],
        ["beach.shore", "0,0,1e7,9"],
        ["taken.shore", "0,0,9,9"],
        ["nowhere.shore", "0,0,9,9"],
    ],
    "place": [
        [],
        ["beach.shore"],
        ["beach.shore", "text.txt", "--at", "1,1"],
        ["beach.shore", "nowhere.glb", "--at", "1,1"],
        ["beach.shore", "cut.glb", "--at", "1,1"],
        ["beach.shore", "wedge.obj"],
        ["beach.shore", "wedge.obj", "--at", "1"],
        ["beach.shore", "wedge.obj", "--at", "1,nan"],
        ["beach.shore", "wedge.obj", "--at", "1,1", "--scale", "0"],
        ["beach.shore", "wedge.obj", "--at", "1,1", "--density", "9"],
        ["beach.shore", "wedge.obj", "--at", "1,1", "--up", "x"],
        ["beach.shore", "wedge.obj", "--at", "1,1", "--name", "a/b"],
        ["nowhere.shore", "wedge.obj", "--at", "1,1"],
        ["taken.shore", "wedge.obj", "--at", "1,1"],
    ],
    "timing": [
        ["beach.shore"],
        ["nowhere.shore", "-o", "out"],
        ["beach.shore", "-o", "out", "--time", "soon"],
        ["beach.shore", "-o", "out", "--source", "tea"],
        ["beach.shore", "-o", "out", "--swell", "9"],
        ["beach.shore", "-o", "out", "--swell", "900,20"],
        ["beach.shore", "-o", "out", "--every", "-1"],
        ["beach.shore", "-o", "beach.shore"],
    ],
    "weather": [
        ["bogus"],
        ["import"],
        ["import", "beach.shore"],
        ["import", "beach.shore", "nowhere.png"],
        ["import", "beach.shore", "text.txt"],
        ["import", "beach.shore", "broken.png"],
        ["import", "taken.shore", "broken.png"],
        ["import", "beach.shore", "broken.png", "--opacity", "big"],
        ["export", "beach.shore"],
        ["export", "nowhere.shore", "-o", "a.png"],
        ["export", "beach.shore", "-o", "folder.png"],
        ["export", "beach.shore", "-o", "a.png", "--size", "1"],
        ["export", "beach.shore", "-o", "a.png", "--layout", "takram"],
        ["export", "beach.shore", "-o", "a.png", "--time", "nan"],
    ],
    "render": [
        ["beach.shore"],
        ["nowhere.shore", "-o", "a.png"],
        ["beach.shore", "-o", "a.gif"],
        ["beach.shore", "-o", "a"],
        ["beach.shore", "-o", "nowhere/a.png"],
        ["beach.shore", "-o", "folder.png"],
        ["beach.shore", "-o", "a.png", "--camera", "nobody"],
        ["beach.shore", "-o", "a.png", "--camera", "1,2,3"],
        ["beach.shore", "-o", "a.png", "--camera", "1,2,3,4,nan"],
        ["beach.shore", "-o", "a.png", "--camera", "1,2,3,4,500"],
        ["beach.shore", "-o", "a.png", "--size", "wide"],
        ["beach.shore", "-o", "a.png", "--size", "0x9"],
        ["beach.shore", "-o", "a.png", "--size", "99999x9"],
        ["beach.shore", "-o", "a.png", "--time", "nan"],
        ["beach.shore", "-o", "a.png", "--time", "-1"],
        ["beach.shore", "-o", "a.png", "--time", "soon"],
        ["beach.shore", "-o", "a.png", "--view", "x-ray"],
        ["beach.shore", "-o", "a.png", "--set", "sea.swell_m"],
        ["beach.shore", "-o", "a.png", "--set", "sea.swel=1"],
        ["beach.shore", "-o", "a.png", "--set", "sea.swell_m=1", "--set", "sea.swell_m=1e9"],
        ["beach.shore", "-o", "a.png", "--hide", "water,ghosts"],
        ["beach.shore", "-o", "a.png", "--quality", "best"],
        ["beach.shore", "-o", "a.png", "--weather", "mild"],
        ["beach.shore", "-o", "a.png", "--samples", "0"],
        ["beach.shore", "-o", "a.png", "--frames", "0"],
        ["beach.shore", "-o", "a.png", "--frames", "2", "--fps", "0"],
    ],
    "sheet": [
        [],
        ["beach.shore"],
        ["-o", "a.png"],
        ["nowhere.shore", "-o", "a.png"],
        ["beach.shore", "-o", "a.exr"],
        ["beach.shore", "-o", "folder.png"],
        ["beach.shore", "-o", "a.png", "--cameras", "nobody"],
        ["beach.shore", "-o", "a.png", "--environments", "blizzard"],
        ["beach.shore", "-o", "a.png", "--size", "9000x9000"],
        ["beach.shore", "-o", "a.png", "--set", "sea.swel=1"],
    ],
    "stroke": [
        [],
        ["beach.shore"],
        ["nowhere.shore", "good.json"],
        ["taken.shore", "good.json"],
        ["beach.shore", "nowhere.json"],
        ["beach.shore", "cut.json"],
        ["beach.shore", "list.json"],
        ["beach.shore", "newer.json"],
        ["beach.shore", "brush.json"],
        ["beach.shore", "crop.json"],
        ["beach.shore", "import.json"],
        ["beach.shore", "kind.json"],
        ["beach.shore", "beach.shore"],
    ],
    "export": [
        ["beach.shore", "-o", "out"],
        ["beach.shore", "--target", "raw"],
        ["beach.shore", "--target", "quake", "-o", "out"],
        ["beach.shore", "--target", "raw", "--only", "smell", "-o", "out"],
        ["beach.shore", "--target", "raw", "-o", "text.txt"],
        ["beach.shore", "--target", "raw", "-o", "beach.shore"],
        ["nowhere.shore", "--target", "raw", "-o", "out"],
    ],
    "check": [[], ["nowhere"], ["text.txt"]],
    "views": [["more"], ["--yaml"]],
    "brushes": [["more"], ["--yaml"]],
    "layers": [["more"], ["--yaml"]],
    "settings": [["more"], ["--yaml"]],
    "environments": [["more"], ["--yaml"]],
    "weathers": [["more"], ["--yaml"]],
    "edit": [[], ["beach.shore"], ["nowhere.shore"], ["--yaml"]],
    "bench": [["no such bench"], ["--yaml"]],
}
ROWS = [[verb, *rest] if verb else rest for verb, rows in BAD.items() for rest in rows]


@pytest.fixture(scope="module")
def template(tmp_path_factory):
    """A folder with a level, scripts, and things that are no levels."""
    folder = tmp_path_factory.mktemp("template")
    level = make_beach(rows=65, cols=65)
    write_level(level, folder / "beach.shore")
    write_level(level, folder / "taken.shore")
    for name, text in SCRIPTS.items():
        (folder / name).write_text(text)
    (folder / "text.txt").write_text("no grid\nof numbers\n")
    (folder / "broken.png").write_bytes(b"\x89PNG\r\n\x1a\n" + b"\0" * 40)
    (folder / "cut.glb").write_bytes(b"glTF\x02\0\0\0\xff\0\0\0")
    (folder / "wedge.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (folder / "empty").mkdir()
    (folder / "folder.png").mkdir()
    np.savez(folder / "coast.npz", height=level.height)
    np.savez(folder / "nan.npz", height=np.full((20, 20), np.nan))
    return folder


@pytest.fixture
def place(template, tmp_path, monkeypatch):
    """A copy of it to work in, without a display."""
    shutil.copytree(template, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    for name in ("XDG_STATE_HOME", "XDG_CACHE_HOME", "XDG_CONFIG_HOME"):
        monkeypatch.setenv(name, str(tmp_path / "user"))
    return tmp_path


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


@pytest.mark.parametrize("argv", ROWS, ids=" ".join)
def test_one_sentence_and_nothing_written(place, capsys, argv):
    """T10: refused, said in a sentence, and the disk is as it was."""
    folder = LevelFolder("taken.shore")
    folder.open()
    try:
        before = contents(place)
        code = main(argv)
        said = capsys.readouterr()
        after = contents(place)
    finally:
        folder.close()
    assert code == 2, said
    lines = [line for line in said.err.splitlines() if not line.startswith("note: ")]
    assert len(lines) == 1, said.err
    assert lines[0].startswith("shorewright: ")
    assert len(lines[0]) > 25
    assert "Traceback" not in said.err
    assert said.out == ""
    assert after == before


def test_every_verb_is_in_the_table():
    assert set(BAD) - {""} == set(VERBS)


def test_a_read_only_folder(place, capsys, monkeypatch):
    """A disk that refuses is bad input too, and the level stays."""
    from shorewright.io import transaction

    before = contents(place)

    def refuse(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(transaction, "flush", refuse)
    assert main(["stroke", "beach.shore", "good.json"]) == 2
    assert "full" in capsys.readouterr().err
    assert contents(place) == before


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="X is Linux's")
def test_a_display_that_does_not_answer(place, capsys, monkeypatch):
    """A stale DISPLAY is bad input, found before the level is opened."""
    monkeypatch.setenv("DISPLAY", ":987")
    before = contents(place)
    assert main(["edit", "beach.shore"]) == 2
    assert ":987" in capsys.readouterr().err
    assert contents(place) == before


def test_a_fault_of_the_program_is_not_hidden(place, monkeypatch):
    """Only bad input is a sentence: a bug keeps its traceback."""
    from shorewright.app.commands import levels

    def broken(*_):
        raise ZeroDivisionError

    monkeypatch.setattr(levels, "_told", broken)
    with pytest.raises(ZeroDivisionError):
        main(["info", "beach.shore"])
