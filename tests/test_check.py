"""`check`: damage of every kind to an export or a level gives a finding, an untouched one none (T10)."""

import json

import numpy as np
import pytest
from exports import GROUND, MANIFEST, one, slope_level
from shorewright import io
from shorewright.app.cli import main
from shorewright.io import write_level
from shorewright.io.export import EXPORTERS, check, export
from shorewright.io.images import write_image
from shorewright.level import BadInput, Rect


@pytest.fixture
def unreal(tmp_path):
    export(slope_level(), "unreal", tmp_path / "out", GROUND, name="bay")
    return tmp_path / "out"


@pytest.fixture
def raw(tmp_path):
    export(slope_level(), "raw", tmp_path / "out", [*GROUND, "mesh", "layers"], name="bay")
    return tmp_path / "out"


@pytest.mark.parametrize("target", EXPORTERS)
def test_untouched_export_is_fine(tmp_path, target):
    level = slope_level()
    level.write("cover", Rect(0, 0, 9, 9), 0.5)
    *_, manifest = export(level, target, tmp_path / "out", name="bay")
    assert check(tmp_path / "out") == []
    assert check(str(manifest)) == []


def test_reformatted_manifest_is_fine(unreal):
    """Another layout of the same JSON is no damage (a formatter, git's line ends)."""
    data = json.loads((unreal / MANIFEST).read_text("utf-8"))
    (unreal / MANIFEST).write_text(json.dumps(data, indent=7, sort_keys=True), "utf-8", newline="\r\n")
    assert check(unreal) == []


def test_nothing_there_is_bad_input(tmp_path, capsys):
    with pytest.raises(BadInput, match="does not exist"):
        check(tmp_path / "nowhere")
    (tmp_path / "picture.png").write_bytes(b"")
    with pytest.raises(BadInput, match="neither"):
        check(tmp_path / "picture.png")
    (tmp_path / "empty").mkdir()
    assert main(["check", str(tmp_path / "empty")]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    with pytest.raises(BadInput, match="no manifest"):
        check(tmp_path / "empty")


# Bytes


@pytest.mark.parametrize("ending", [".r16", "height.exr", ".glb", ".vti"])
@pytest.mark.parametrize("place", [0, 0.5, -1])
def test_one_damaged_byte_is_found(raw, ending, place):
    (path,) = raw.glob(f"*{ending}")
    data = bytearray(path.read_bytes())
    data[place if place in (0, -1) else len(data) // 2] ^= 1
    path.write_bytes(data)
    one(check(raw), path.name)


@pytest.mark.parametrize("ending", [".r16", "height.exr", ".glb", ".vti"])
@pytest.mark.parametrize("damage", ["missing", "truncated", "longer", "a folder"])
def test_missing_and_cut_files_are_found(raw, ending, damage):
    (path,) = raw.glob(f"*{ending}")
    data = path.read_bytes()
    path.unlink()
    if damage == "a folder":
        path.mkdir()
    elif damage != "missing":
        path.write_bytes(data[:-2] if damage == "truncated" else data + b"\0\0")
    one(check(raw), path.name)


def test_renamed_height_map_is_found(unreal):
    (unreal / "bay_height.r16").rename(unreal / "terrain.r16")
    findings = check(unreal)
    assert any("bay_height.r16 is missing" in finding for finding in findings)
    assert any("terrain.r16" in finding and "does not list" in finding for finding in findings)


def test_sidecar_that_unreal_would_read_is_found(unreal):
    """Unreal takes `<same basename>.json` for size and bit depth, whatever wrote it."""
    (unreal / "bay_height.json").write_text("{}", "utf-8")
    one(check(unreal), "bay_height.json")


# Manifest


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("", "JSON"),
        ("[1, 2]", "schema"),
        ('{"schema": "other"}', "schema"),
        ('{"schema": "shorewright.export", "schema_version": 3}', "version 3"),
        ("[" * 100_000, "JSON"),
        ('{"a": NaN}', "JSON"),
        ("\x00\xff", "JSON"),
    ],
    ids=["empty", "list", "other", "newer", "deep", "nan", "binary"],
)
def test_unreadable_manifest_is_found(unreal, text, word):
    (unreal / MANIFEST).write_bytes(text.encode("latin-1"))
    one(check(unreal), word)


def test_missing_and_second_manifest_are_found(unreal):
    (unreal / "other.shorewright.json").write_bytes((unreal / MANIFEST).read_bytes())
    one(check(unreal), "2 manifests")
    for path in unreal.glob("*.json"):
        path.unlink()
    with pytest.raises(BadInput, match="no manifest"):
        check(unreal)


@pytest.mark.parametrize("field", [("waves", "seed"), ("engine", "scale_z"), ("world", "sea_level_m")])
def test_edited_manifest_is_found(unreal, field):
    data = json.loads((unreal / MANIFEST).read_text("utf-8"))
    data[field[0]][field[1]] += 1
    (unreal / MANIFEST).write_text(json.dumps(data), "utf-8")
    assert any("edited" in finding for finding in check(unreal))


# Levels


def test_level_folders_are_checked(tmp_path):
    """A saved level is fine; a damaged, missing or exchanged sector is a finding, a broken description too."""
    folder = tmp_path / "cove.shore"
    level = slope_level()
    level.write("foam", Rect(0, 0, 9, 9), 0.5)
    write_level(level, folder)
    assert check(folder) == check(folder / "level.json") == io.check(folder) == []
    base = folder / "layers" / "height_base.r0.c0.exr"
    data = base.read_bytes()
    for damaged in (data[: len(data) // 2], b"", b"no picture"):
        base.write_bytes(damaged)
        one(check(folder), base.name)
    write_image(base, np.zeros((30, 41, 1), np.float32))
    assert any(base.name in finding for finding in check(folder))
    base.write_bytes(data)
    assert check(folder) == []
    base.unlink()
    one(check(folder), base.name)
    base.write_bytes(data)
    (folder / "level.json").write_text("{}", "utf-8")
    one(check(folder), "level.json")
    (folder / "level.json").unlink()
    assert len(check(folder)) == 1
