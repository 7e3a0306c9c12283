"""Contact sheets: the composing, and the verb that draws one (L08)."""

import numpy as np
import pytest
from coasts import make_beach
from hypothesis import given
from hypothesis import settings as how
from hypothesis import strategies as st
from shorewright.app.cli import main
from shorewright.app.contact_sheet import GUTTER_PX, PAPER, compose, sheet_size, text_px
from shorewright.io import read_level, write_level
from shorewright.io.images import read_image
from shorewright.io.labels import text_mask
from shorewright.level.environments import ENVIRONMENTS, environment_settings
from shorewright.level.framing import cameras
from shorewright.level.objects import Camera

NAMES = st.lists(st.text("abcgjy_ é", min_size=0, max_size=14), min_size=1, max_size=3)


@given(NAMES, NAMES, st.integers(1, 60), st.integers(1, 40))
@how(max_examples=30)
def test_every_picture_stands_whole_in_its_place(rows, columns, width, height):
    """L08: cells from the lower right corner in equal steps; between and round them paper or text."""
    rng = np.random.default_rng(4)
    cells = [[rng.integers(230, 256, (height, width, 3), np.uint8) for _ in columns] for _ in rows]
    sheet = compose(cells, rows, columns)
    assert sheet.shape[1::-1] == sheet_size((width, height), rows, columns)
    left = sheet.shape[1] - len(columns) * (width + GUTTER_PX)
    top = sheet.shape[0] - len(rows) * (height + GUTTER_PX)
    for row in range(len(rows)):
        for column in range(len(columns)):
            y, x = top + row * (height + GUTTER_PX), left + column * (width + GUTTER_PX)
            assert np.array_equal(sheet[y : y + height, x : x + width], cells[row][column])
            assert (sheet[y : y + height, x + width : x + width + GUTTER_PX] == PAPER).all()
    assert (sheet[-GUTTER_PX:, left:] == PAPER).all()
    assert sheet[:top].max() < 230
    assert sheet[:, :left].max() < 230


def test_names_are_written_beside_the_pictures():
    """L08: over each column, before each row on two lines, in text that can be read."""
    cells = [[np.zeros((90, 160, 3), np.uint8)] * 2] * 2
    sheet = compose(cells, ["cove\nplay", "cove\nbeach"], ["Noon", ""])
    left, top = sheet.shape[1] - 2 * 164, sheet.shape[0] - 2 * 94
    ink = (sheet.astype(int) - PAPER).max(axis=2) > 100
    assert ink[:top, left : left + 160].sum() > 30
    assert not ink[:top, left + 164 :].any()
    size = text_px((160, 90))
    for row in range(2):
        before = ink[top + row * 94 : top + row * 94 + 90, :left]
        assert before[: round(1.4 * size)].sum() > 20
        assert before[round(1.4 * size) : 3 * size].sum() > 20
        assert not before[3 * size :].any()
    assert np.array_equal(ink[top : top + size, :left], ink[top + 94 : top + 94 + size, :left])  # both say cove


def test_text_is_one_height_and_as_wide_as_it_is_long():
    masks = [text_mask(text, 13) for text in ("i", "gay", "golden hour", "")]
    assert {mask.shape[0] for mask in masks} == {17}
    assert masks[0].shape[1] < masks[1].shape[1] < masks[2].shape[1]
    assert all(0.8 < mask.max() <= 1 for mask in masks[:3])
    assert masks[3].max() == 0


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    level = make_beach(rows=65, cols=65, slope=0.1)
    write_level(level, "plain.shore")
    for number, name in enumerate(("west", "play")):
        level.put_object(name, Camera(id=name, x=20 + 20 * number, y=5, z=12, yaw_deg=0, pitch_deg=-20))
    write_level(level, "beach.shore")
    return tmp_path


def run(capsys, *argv):
    code = main([str(part) for part in argv])
    said = capsys.readouterr()
    assert code == 0, said.err
    return said.out


@pytest.mark.gl
def test_a_sheet_of_cameras_and_environments(place, capsys, ctx):
    """L08: each picture is the one `render` draws of that level, camera and environment; nothing is changed on disk."""
    from shorewright.renderer import render

    flags = ["--environments", "storm,noon", "--size", "48x27", "--quality", "low", "--time", "3"]
    before = sorted((p, p.stat().st_mtime_ns) for p in place.rglob("*"))
    said = run(capsys, "sheet", "beach.shore", "plain.shore", "-o", "a.png", *flags, "--set", "fog.density=0.01")
    assert said == "a.png\n"
    assert sorted((p, p.stat().st_mtime_ns) for p in place.rglob("*") if p.name != "a.png") == before
    sheet = read_image("a.png")
    shots = []
    for name in ("beach.shore", "plain.shore"):
        level = read_level(name)
        own = [level.objects["play"], level.objects["west"]] if name == "beach.shore" else cameras(level)
        shots += [(level, camera) for camera in own]
    assert len(shots) == 5
    names = ["beach\nplay", "beach\nwest", "plain\nplay", "plain\nbeach", "plain\nsurvey"]
    columns = [ENVIRONMENTS[name].label for name in ("storm", "noon")]
    cells = []
    for level, camera in shots:
        own, row = level.settings, []
        for name in ("storm", "noon"):
            level.set_settings(environment_settings(own, name))
            level.set("fog.density", 0.01)
            row.append(render(level, camera, (48, 27), 3.0, quality="low"))
        level.set_settings(own)
        cells.append(row)
    assert np.array_equal(sheet, compose(cells, names, columns))


@pytest.mark.gl
def test_cameras_by_name_and_all_environments(place, capsys, ctx):
    """L08: names in the order given, by comma or flag; a level without that camera has the three every level has."""
    run(capsys, "sheet", "beach.shore", "-o", "a.png", "--cameras", "west,survey", "--cameras", "west",
        "--size", "32x18", "--quality", "low", "--view", "height")  # fmt: skip
    rows, columns = ["beach\nwest", "beach\nsurvey"], list(ENVIRONMENTS)
    assert read_image("a.png").shape[1::-1] == sheet_size((32, 18), rows, columns)


BAD = [
    (["beach.shore"], "--output"),
    (["-o", "a.png"], "LEVELS"),
    (["beach.shore", "-o", "a.exr"], ".png or .jpg"),
    (["beach.shore", "-o", "a"], ".png or .jpg"),
    (["beach.shore", "-o", "nowhere/a.png"], "nowhere"),
    (["nowhere.shore", "-o", "a.png"], "nowhere.shore"),
    (["beach.shore", "nowhere.shore", "-o", "a.png"], "nowhere.shore"),
    (["beach.shore", "-o", "a.png", "--cameras", "play,nobody"], "nobody"),
    (["plain.shore", "-o", "a.png", "--cameras", "west"], "west"),
    (["beach.shore", "-o", "a.png", "--environments", "noon,blizzard"], "blizzard"),
    (["beach.shore", "-o", "a.png", "--size", "wide"], "wide"),
    (["beach.shore", "-o", "a.png", "--size", "9000x9000"], "million"),
    (["beach.shore", "-o", "a.png", "--time", "-1"], "--time"),
    (["beach.shore", "-o", "a.png", "--view", "x-ray"], "x-ray"),
    (["beach.shore", "-o", "a.png", "--set", "sea.swell_m=1e9"], "sea.swell_m"),
    (["beach.shore", "-o", "a.png", "--hide", "ghosts"], "ghosts"),
    (["beach.shore", "-o", "a.png", "--quality", "best"], "best"),
    (["beach.shore", "-o", "a.png", "--samples", "0"], "--samples"),
]


@pytest.mark.parametrize(("argv", "word"), BAD, ids=lambda v: " ".join(v) if isinstance(v, list) else v)
def test_bad_input_gets_one_sentence(place, capsys, argv, word):
    """Refused before anything is drawn or written (T10)."""
    before = sorted(place.rglob("*"))
    assert main(["sheet", *argv]) == 2
    said = capsys.readouterr()
    assert said.err.count("\n") == 1
    assert word in said.err
    assert sorted(place.rglob("*")) == before
