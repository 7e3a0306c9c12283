"""The command line does what the session does: levels, scripts, exports, tables, the whole way round (T10)."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import shorewright
from coasts import make_beach
from shorewright.app.cli import VERBS, main
from shorewright.app.session import Session
from shorewright.brushes import BRUSHES
from shorewright.io import read_level, write_level
from shorewright.level import LAYERS

SCRIPT = {
    "version": 1,
    "actions": [
        {"do": "stroke", "brush": "ramp", "params": {"size_m": 8}, "points": [[40, 50], [60, 90]]},
        {"do": "stroke", "brush": "raise", "points": [[60, 60], [90, 70, 0.5]], "invert": True},
        {"do": "stroke", "brush": "smooth", "points": [[60, 60]]},
        {"do": "undo"},
        {"do": "set", "name": "sea.swell_m", "value": 1.25},
    ],
}


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "script.json").write_text(json.dumps(SCRIPT))
    write_level(make_beach(), tmp_path / "beach.shore")
    return tmp_path


def run(capsys, *argv):
    """Exit code 0, and what was said on stdout."""
    code = main([str(part) for part in argv])
    said = capsys.readouterr()
    assert code == 0, said.err
    return said.out


def test_a_new_beach(place, capsys):
    """`new` without terrain: a beach that slopes into the sea, cameras saved in it."""
    assert run(capsys, "new", "a.shore", "--size", "129", "--cell-m", "2") == "a.shore\n"
    level = read_level("a.shore")
    assert (level.grid.rows, level.grid.cols, level.grid.cell_m) == (129, 129, 2)
    assert {"play", "beach", "survey"} <= set(level.objects)
    told = json.loads(run(capsys, "info", "a.shore", "--json"))
    assert (told["name"], told["rows"], told["cell_m"]) == ("a.shore", 129, 2)
    assert told["cameras"] == ["beach", "play", "survey"]
    assert "129 × 129" in run(capsys, "info", "a.shore")


def test_a_new_level_from_terrain(place, capsys):
    """Flags reach the import; what the file leaves open is told on stderr."""
    height = make_beach(rows=60, cols=80).height
    np.savez("coast.npz", height=-np.flipud(height))
    code = main(["new", "a.shore", "--from", "coast.npz", "--depth-down", "--cell-m", "1", "--sea-level", "-0.5"])
    said = capsys.readouterr()
    assert (code, said.out) == (0, "a.shore\n")
    assert "north" in said.err
    level = read_level("a.shore")
    assert np.allclose(level.height, height)
    assert level.sea_level_m == -0.5


def test_the_real_coast(place, capsys, data_dir):
    """T10: Pyramid Rock, whose cells are 2 m × 1 m."""
    source = data_dir / "coasts" / "pyramidrock_hi.celeris.txt"
    run(capsys, "new", "rock.shore", "--from", source, "--cell-m", "2x1", "--rows", "north-first")
    told = json.loads(run(capsys, "info", "rock.shore", "--json"))
    assert (told["rows"], told["cols"], told["cell_m"]) == (601, 801, 1.0)
    assert told["lowest_m"] == pytest.approx(-13.32, abs=0.01)
    assert told["highest_m"] == pytest.approx(21.65, abs=0.01)


def test_resize_and_crop(place, capsys):
    before = read_level("beach.shore")
    run(capsys, "resize", "beach.shore", "--cell-m", "0.5", "--sea-level", "-1")
    level = read_level("beach.shore")
    assert np.array_equal(level.height[::2, ::2], before.height)
    assert level.sea_level_m == -1
    run(capsys, "crop", "beach.shore", "10,20,60,70")
    cropped = read_level("beach.shore")
    assert np.array_equal(cropped.height, level.height[40:141, 20:121])


def test_a_script_gives_the_bytes_of_the_session(place, capsys):
    """`stroke` is the window's engine: same files, byte for byte."""
    shutil.copytree("beach.shore", "twin.shore")
    out = run(capsys, "stroke", "beach.shore", "script.json")
    assert "5 actions" in out
    with Session.open("twin.shore", spill_root=place) as session:
        session.drag("ramp", (40, 50), (60, 90), size_m=8)
        session.pick_brush("raise")
        session.stroke_begin(60, 60, invert=True)
        session.stroke_move(90, 70, 0.5)
        session.stroke_end()
        session.set("sea.swell_m", 1.25)
        session.save()
    files = [path.relative_to(place / "beach.shore") for path in sorted((place / "beach.shore").rglob("*.exr"))]
    assert files
    for name in [*files, "level.json"]:
        assert (place / "beach.shore" / name).read_bytes() == (place / "twin.shore" / name).read_bytes()


@pytest.mark.parametrize("target", ["raw", "unreal"])
def test_export_prints_each_path_and_check_finds_nothing(place, capsys, target):
    """Paths one a line, never wrapped; then damage is found with exit code 1."""
    out = place / ("a long name " * 12) / target
    out.parent.mkdir()
    paths = run(capsys, "export", "beach.shore", "--target", target, "-o", out).splitlines()
    assert len(paths) >= 2
    assert sorted(paths) == sorted(str(path) for path in out.rglob("*") if path.is_file())
    assert "nothing wrong" in run(capsys, "check", out)
    damaged = next(out.rglob("*.r16"))
    damaged.write_bytes(bytes(damaged.stat().st_size))
    assert main(["check", str(out)]) == 1
    said = capsys.readouterr()
    assert damaged.name in said.out
    assert said.err == ""


def test_check_of_a_level(place, capsys):
    assert "nothing wrong" in run(capsys, "check", "beach.shore")
    victim = next((place / "beach.shore" / "layers").glob("*.exr"))
    victim.write_bytes(victim.read_bytes()[:-100])
    assert main(["check", "beach.shore"]) == 1
    assert victim.name in capsys.readouterr().out


def test_only_some_maps(place, capsys):
    paths = run(capsys, "export", "beach.shore", "--target", "raw", "-o", "out", "--only", "height").splitlines()
    everything = run(capsys, "export", "beach.shore", "--target", "raw", "-o", "all").splitlines()
    assert len(paths) < len(everything)


TABLES = {"brushes": BRUSHES, "layers": LAYERS}


@pytest.mark.parametrize("verb", ["views", "brushes", "layers", "settings"])
def test_tables(capsys, verb):
    """`--json`: a list of objects, each with a name; the plain table has a line for each."""
    rows = json.loads(run(capsys, verb, "--json"))
    names = [row["name"] for row in rows]
    assert len(names) == len(set(names)) > 3
    plain = run(capsys, verb)
    assert all(re.search(rf"^\s*{re.escape(name)}\s", plain, re.MULTILINE) for name in names)
    if verb in TABLES:
        assert names == list(TABLES[verb])


def test_brushes_tell_their_parameters(capsys):
    """Default, range, unit and sentence of each parameter, from its one declaration."""
    rows = {row["name"]: row for row in json.loads(run(capsys, "brushes", "--json"))}
    for name, brush in BRUSHES.items():
        params = {param["name"]: param for param in rows[name]["params"]}
        assert list(params) == list(brush.params.model_fields)
        assert params["size_m"]["unit"] == "m"
        assert params["size_m"]["default"] == brush.params().size_m


def test_help_of_every_verb(capsys):
    """Each page opens with a sentence; the list has every verb and no other."""
    page = run(capsys, "--help")
    for verb in VERBS:
        assert re.search(rf"^\s*{verb}: \w+", page, re.MULTILINE), verb
        assert len(run(capsys, verb, "--help").splitlines()) > 3
    assert set(re.findall(r"^\s*([a-z]+): \w+", page, re.MULTILINE)) == set(VERBS)
    assert run(capsys, "--version").strip() == shorewright.__version__


def subprocess_run(*argv, **options):
    command = [sys.executable, "-m", "shorewright.app.cli", *map(str, argv)]
    return subprocess.run(command, capture_output=True, text=True, timeout=300, **options)


def test_a_reader_that_goes_away_is_no_error(tmp_path):
    """`shorewright settings | head -1`."""
    command = f"{sys.executable} -m shorewright.app.cli settings | head -1"
    done = subprocess.run(command, shell=True, capture_output=True, text=True)
    assert done.stderr == ""
    assert len(done.stdout.splitlines()) == 1


def test_tables_import_nothing_heavy():
    """What makes `brushes` start fast is what it leaves alone."""
    heavy = ["OpenImageIO", "trimesh", "pyvista", "scipy", "moderngl", "imgui_bundle", "skfmm", "rich.progress"]
    code = f"""if True:
        import sys
        from shorewright.app.cli import main
        for verb in ("brushes", "layers", "settings"):
            assert main([verb]) == 0
        found = [name for name in {heavy} if name in sys.modules]
        assert not found, found
    """
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.gl
def test_render(place, ctx):
    """Pictures by name and by numbers, frames, EXR; without the lock, and the level untouched."""
    files = {path: path.read_bytes() for path in (place / "beach.shore").rglob("*.*") if path.is_file()}
    small = ["--size", "96x54", "--quality", "low"]
    with Session.open("beach.shore", spill_root=place):  # somebody edits it
        done = subprocess_run("render", "beach.shore", "-o", "a.png", *small)
        assert (done.returncode, done.stdout) == (0, "a.png\n"), done.stderr
    place_text = "80,20,40,0,-40"
    frames = subprocess_run(
        "render", "beach.shore", "-o", "f.png", *small, "--camera", place_text, "--frames", "3", "--fps", "2",
        "--set", "shore.interval_s=3", "--set", "sea.swell_m=0", "--hide", "fog,shadows",
    )  # fmt: skip
    assert frames.stdout.split() == ["f_0001.png", "f_0002.png", "f_0003.png"], frames.stderr
    one = subprocess_run("render", "beach.shore", "-o", "g.png", *small, "--frames", "1", "--memory")
    told, *memory = one.stdout.splitlines()
    assert told == "g_0001.png"  # a list of one is still numbered
    assert all(any(name in line for line in memory) for name in ("g_albedo", "u_plates", "u_height", "MB in"))
    exr = subprocess_run("render", "beach.shore", "-o", "b.exr", *small, "--view", "position", "--time", "7")
    assert exr.returncode == 0, exr.stderr
    from shorewright.io.images import read_image

    first, last = read_image("f_0001.png"), read_image("f_0003.png")
    assert first.shape == (54, 96, 3)
    assert (first != last).any()
    assert np.ptp(read_image("a.png")) > 50
    numbers = read_image("b.exr")
    assert numbers.dtype == np.float32
    assert np.ptp(numbers[..., 0]) > 10  # metres across the picture
    assert {path: path.read_bytes() for path in files} == files


@pytest.mark.gl
def test_the_demo(tmp_path, ctx):
    """What `make run` does without a display: pictures before and after, exports, each path on its line."""
    samples = Path(__file__).parents[1] / "sample_levels"
    if not (samples / "cove.shore").is_dir():
        pytest.skip("the sample levels are not in this checkout")
    code = f"""if True:
        from pathlib import Path
        from shorewright.app import demo
        raise SystemExit(demo.run_demo(Path({str(tmp_path / "out")!r}), (96, 54), "low"))
    """
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout + done.stderr
    paths = [Path(line) for line in done.stdout.splitlines()]
    assert all(path.exists() for path in paths)
    assert sum(path.suffix == ".png" and path.parent.name == "out" for path in paths) == 6
    assert {path.parent.name for path in paths} == {"out", "cove_raw", "cove_unreal", "cove_unity", "cove_godot"}
    assert sum(path.name == "cove_flow.png" for path in paths) == 4
    before, after = ((tmp_path / "out" / f"{word}_play.png").read_bytes() for word in ("before", "after"))
    assert before != after
    sculpted, sample = read_level(tmp_path / "out" / "cove.shore"), read_level(samples / "cove.shore")
    assert not np.array_equal(sculpted.height, sample.height)
