"""Exporting again, being told of it, stopping it: only what changed is written, and the bytes are the same (T09)."""

import errno
import os

import numpy as np
import pytest
from exports import GROUND, MANIFEST, die, look_at, read_manifest, slope_level, snapshot, wait_until_stopped
from shorewright.app.background import Background
from shorewright.app.cli import main
from shorewright.io import check, export, image_rows, images, write_level
from shorewright.io.export import EXPORTERS, Cancelled, follows, maps
from shorewright.io.export.godot_project import TEXTS
from shorewright.level import BadInput, Rect
from shorewright.level.layers import LayerData

SOME = [*GROUND, "normals", "foam", "snow", "weather_map", "river_foam"]


LEAST_WORDS = {"walkable": 12, "arrival": 4, "puddles": 4, "cover_weights": 3, "kit": 30}


def level_with_paint():
    level = slope_level()
    level.write("foam", Rect(2, 3, 9, 12), 0.5)
    level.write("snow", Rect(0, 0, 5, 5), 0.25)
    return level


def level_with_all(value):
    level = level_with_paint()
    for name in ("foam", "snow", "flow", "height", "weather"):
        level.write(name, Rect(1, 1, 6, 7), value)
    return level


def files(folder):
    """What each map's files are on the disk: a file that was kept has the number it had."""
    return {f["map"]: os.stat(folder / f["name"]).st_ino for f in read_manifest(folder)["files"]}


@pytest.mark.parametrize("target", EXPORTERS)
def test_a_second_run_writes_nothing_anew(tmp_path, target, monkeypatch):
    """T09: same bytes, no map made again, those of which there is nothing included; a fresh level says the same."""
    level, out = level_with_paint(), tmp_path / "out"
    export(level, target, out, SOME, name="bay")
    before, bytes_before = files(out), snapshot(out)
    assert "river_foam" in read_manifest(out)["empty"]

    def refuse(*_, **__):
        raise AssertionError("a map was made again")

    with monkeypatch.context() as patch:
        patch.setattr(images, "write_image", refuse)
        patch.setattr(image_rows, "write_rows", refuse)
        patch.setattr(maps, "write_u16", refuse)
        patch.setattr(LayerData, "neutral", property(refuse))
        export(level_with_paint(), target, out, SOME, name="bay")
    assert files(out) == before
    assert snapshot(out) == bytes_before
    export(level_with_paint(), target, tmp_path / "new", SOME, name="bay")
    assert snapshot(tmp_path / "new") == bytes_before
    assert check(out) == []


def test_paint_makes_its_own_map_anew(tmp_path):
    """Ground and other paint stay; what follows from the whole level is made again."""
    level, out = level_with_paint(), tmp_path / "out"
    export(level, "raw", out, SOME, name="bay")
    before = files(out)
    level.write("foam", Rect(20, 20, 25, 25), 0.75)
    export(level, "raw", out, SOME, name="bay")
    changed = {name for name, number in files(out).items() if before[name] != number}
    assert {"foam", "flow"} <= changed
    assert not changed & {"height", "normals", "snow"}
    export(level, "raw", tmp_path / "new", SOME, name="bay")
    assert snapshot(out) == snapshot(tmp_path / "new")


@pytest.mark.parametrize("change", ["sea", "code", "damage", "manifest", "options"])
def test_what_may_not_be_kept_is_made_anew(tmp_path, monkeypatch, change):
    level, out, options = level_with_paint(), tmp_path / "out", {}
    export(level, "unreal", out, ["height", "snow"], name="bay")
    before = files(out)
    path = out / "bay_height.r16"
    if change == "sea":
        level.set("level.sea_level_m", 0.5)
    elif change == "code":
        monkeypatch.setattr(follows, "code_sha256", lambda: "another")
    elif change == "damage":
        path.write_bytes(path.read_bytes()[:-1] + b"\1")
    elif change == "manifest":
        (out / MANIFEST).write_text((out / MANIFEST).read_text("utf-8").replace("ground", "Ground"), "utf-8")
    else:
        options = {"resample": True}
    export(level, "unreal", out, ["height", "snow"], name="bay", **options)
    assert files(out)["height"] != before["height"]
    assert check(out) == []


def test_the_code_hash_covers_every_text_of_the_project():
    """T09: a changed scene or shader is exported anew."""
    texts = {path for path in TEXTS.iterdir() if path.is_file()}
    assert {"main.tscn", "project.godot", "sea.gdshader"} <= {path.name for path in texts}
    assert texts <= set(follows.code_files())


# Progress, cancelling, faults


def test_progress_tells_every_map_and_rises(tmp_path):
    told = []
    export(level_with_paint(), "unity", tmp_path / "out", SOME, progress=lambda *said: told.append(said))
    shares = [share for share, _ in told]
    assert shares == sorted(shares)
    assert shares[0] == 0
    assert 0.8 < shares[-1] <= 1
    assert {name for _, name in told} == set(SOME)


@pytest.mark.parametrize("earlier", [False, True])
@pytest.mark.parametrize("after", [0, 3, 6])
def test_cancelling_leaves_what_was_there(tmp_path, earlier, after):
    level, out, told = level_with_paint(), tmp_path / "out", []
    if earlier:
        export(level, "godot", out, SOME, name="bay")
    before = snapshot(out) if earlier else None
    level.write("height", Rect(0, 0, 4, 4), 3.0)

    def stop(share, name):
        told.append(name)
        return len(told) <= after

    with pytest.raises(Cancelled):
        export(level, "godot", out, SOME, name="bay", progress=stop)
    assert (snapshot(out) if out.exists() else None) == before
    assert [path.name for path in tmp_path.iterdir()] == (["out"] if earlier else [])


@pytest.mark.parametrize("piece", [name for name, _ in EXPORTERS["raw"].maps])
def test_every_piece_can_be_stopped(tmp_path, piece):
    """At its first word, in its middle and at its last one; the long ones say a good many."""
    chosen, out, told = sorted({"height", piece}), tmp_path / "out", []
    export(level_with_all(0.5), "raw", out, chosen, name="bay")
    before = snapshot(out)
    other = level_with_all(0.25), "raw", tmp_path / "other", chosen, "bay"
    export(*other, progress=lambda *said: told.append(said))
    of_piece = [number for number, (_, name) in enumerate(told) if name == piece]
    assert len(of_piece) >= LEAST_WORDS.get(piece, 1)
    for last in {of_piece[0], of_piece[len(of_piece) // 2], of_piece[-1]}:
        words = iter(range(last))
        with pytest.raises(Cancelled):
            export(
                level_with_all(0.25), "raw", out, chosen, "bay",
                progress=lambda *_, left=words: next(left, None) is not None,
            )  # fmt: skip
        assert snapshot(out) == before
    assert sorted(path.name for path in tmp_path.iterdir()) == ["other", "out"]


@pytest.mark.parametrize("target", EXPORTERS)
@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EROFS])
@pytest.mark.parametrize("earlier", [False, True])
def test_a_disk_that_refuses_is_one_sentence(tmp_path, monkeypatch, target, code, earlier):
    """T09: full or read-only, in the middle of a picture; the old export is intact."""
    level, out = level_with_paint(), tmp_path / "out"
    if earlier:
        export(level, target, out, SOME, name="bay")
    before = snapshot(out) if earlier else None
    level.write("height", Rect(0, 0, 4, 4), 3.0)

    def fail(path, *_, **__):
        path.write_bytes(b"half")
        raise OSError(code, os.strerror(code))

    monkeypatch.setattr(images, "encode", fail)
    monkeypatch.setattr(image_rows, "_encode", fail)
    with pytest.raises(BadInput) as refused:
        export(level, target, out, SOME, name="bay")
    assert "\n" not in str(refused.value)
    assert "cannot write" in str(refused.value)
    assert (snapshot(out) if out.exists() else None) == before
    assert [path.name for path in tmp_path.iterdir()] == (["out"] if earlier else [])


def test_command_line_takes_targets_and_their_options(tmp_path, capsys):
    write_level(slope_level(), tmp_path / "bay.shore")
    asked = ["export", str(tmp_path / "bay.shore"), "--only", "height", "-o", str(tmp_path / "out")]
    assert main([*asked, "--target", "unity", "--tile", "33"]) == 0
    printed = capsys.readouterr().out.split()
    assert printed[0].endswith("bay_height_0_0.raw")
    assert main(["check", str(tmp_path / "out")]) == 0
    before = snapshot(tmp_path / "out")
    for wrong in (["--target", "unity", "--tile", "34"], ["--target", "godot"], ["--target", "raw", "--resample"]):
        capsys.readouterr()
        assert main([*asked, *wrong]) == 2
        assert len(capsys.readouterr().err.splitlines()) == 1
        assert snapshot(tmp_path / "out") == before


def test_command_line_says_which_maps_the_level_has_nothing_of(tmp_path, capsys):
    """T09: of those asked for, a line on stderr, and the rest is written."""
    write_level(slope_level(), tmp_path / "bay.shore")
    asked = ["export", str(tmp_path / "bay.shore"), "--target", "raw", "-o"]
    assert main([*asked, str(tmp_path / "some"), "--only", "height,snow", "--only", "foam"]) == 0
    told = capsys.readouterr()
    assert told.err == "note: bay has nothing for: foam, snow\n"
    assert "nothing for" not in told.out
    assert main([*asked, str(tmp_path / "all"), "--only", "height"]) == 0
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("only", ["", ",", " , "])
def test_command_line_takes_no_empty_choice(tmp_path, capsys, only):
    write_level(slope_level(), tmp_path / "bay.shore")
    out = tmp_path / "out"
    assert main(["export", str(tmp_path / "bay.shore"), "--target", "raw", "-o", str(out), "--only", only]) == 2
    assert "--only names no map" in capsys.readouterr().err
    assert not out.exists()


def test_help_names_every_target(capsys):
    assert main(["export", "--help"]) == 0
    told = capsys.readouterr().out
    assert all(name in told for name in EXPORTERS)


def test_work_beside_the_window_has_a_level_of_its_own():
    """What is edited meanwhile isn't exported; faults and a dead process are handed over; cancelling is heard."""
    level = slope_level()
    ground = level.height.copy()
    run, stopped, dead = (
        Background(level, look_at, "half"), Background(level, wait_until_stopped), Background(level, die),
    )  # fmt: skip
    level.write("height", level.grid.rect, 1.0)
    wanted, height = run.result()
    assert (wanted, run.done, run.share, run.sentence) == (True, True, 0.5, "half")
    np.testing.assert_array_equal(height, ground)
    stopped.cancel()
    with pytest.raises(BadInput, match="no"):
        stopped.result()
    with pytest.raises(OSError, match="before its end"):
        dead.result()
