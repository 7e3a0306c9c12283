"""The folder an export lands in: whole or not at all, and never at the cost of anything else (T10)."""

import errno
import json
import os
import shutil
from pathlib import Path

import pytest
from exports import GROUND, read_manifest, rough_level, slope_level, snapshot
from shorewright.io.export import check, export, heights
from shorewright.level import BadInput

PROJECT = ["project", "height"]


def test_export_replaces_its_own_and_only_its_own(tmp_path):
    out = tmp_path / "out"
    export(rough_level(20), "unreal", out, name="bay")
    (out / ".DS_Store").write_bytes(b"finder")
    first = (out / "bay_height.r16").read_bytes()
    (out / "bay_height.r16").write_bytes(first[:-7])  # damaged since: exporting again repairs it
    export(rough_level(20, seed=2), "unreal", out, name="bay")
    assert (out / "bay_height.r16").read_bytes() not in (first, first[:-7])
    assert check(out) == []
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_what_an_engine_lays_beside_our_files_stays(tmp_path):
    """T09: an export inside an opened project is exported again: sidecars and caches are no strangers, and survive."""
    out = tmp_path / "out"
    export(rough_level(20), "godot", out, "height", name="bay")
    (out / ".godot").mkdir()
    theirs = {"bay_height.exr.import": b"uid", "bay_height.exr.meta": b"guid", "gone.gd.uid": b"uid"}
    theirs |= {"export_presets.cfg": b"[preset.0]", ".gitignore": b".godot/", ".gitattributes": b"* text=auto eol=lf"}
    theirs |= {".editorconfig": b"root = true"}
    for name, data in theirs.items():
        (out / name).write_bytes(data)
    export(rough_level(20, seed=2), "godot", out, "height", name="bay")
    assert {name: (out / name).read_bytes() for name in theirs} == theirs
    assert (out / ".godot").is_dir()
    assert check(out) == []


def test_what_somebody_wrote_into_the_project_is_never_lost(tmp_path):
    """T09: its texts are there to be edited; project.godot, which Godot saves anew, and pictures are written again."""
    out, edited = tmp_path / "out", ["main.tscn", "sea.gdshader"]
    export(slope_level(20, 20), "godot-project", out, PROJECT, name="bay")
    for number, name in enumerate(edited, 1):
        (out / name).write_text((out / name).read_text("utf-8") + "\n// mine", "utf-8")
        before = snapshot(out)
        with pytest.raises(BadInput) as refused:
            export(slope_level(21, 20), "godot-project", out, PROJECT, name="bay")
        verb, it = [("was", "it"), ("were", "them")][number - 1]
        wanted = f"{', '.join(edited[:number])} {verb} changed since the export: move {it} away or name another folder"
        assert str(refused.value) == wanted
        with pytest.raises(BadInput, match="changed since"):
            export(slope_level(20, 20), "godot-project", out, "height", name="bay")
        assert snapshot(out) == before
    for name in edited:
        (out / name).rename(tmp_path / name)
    (out / "project.godot").write_text("saved by Godot", "utf-8")
    (out / "bay_height.r16").write_bytes(b"damaged")
    export(slope_level(21, 20), "godot-project", out, PROJECT, name="bay")
    assert check(out) == []


def test_an_export_never_goes_into_a_level(tmp_path):
    """T10: a level's folder holds the level alone."""
    home = tmp_path / "bay.shore"
    home.mkdir()
    for out in (home, home / "build" / "deep"):
        with pytest.raises(BadInput, match=r"bay\.shore: name a folder beside it"):
            export(rough_level(8), "raw", out, "height", name="bay")
    assert snapshot(home) == {}


def test_foreign_things_are_never_touched(tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    (out / "notes.txt").write_text("mine", "utf-8")
    with pytest.raises(BadInput, match=r"notes\.txt"):
        export(rough_level(8), "unreal", out)
    assert snapshot(out) == {"notes.txt": b"mine"}
    (out / "notes.txt").unlink()
    export(rough_level(8), "unreal", out, name="bay")
    before = snapshot(out)
    for target, name, thing in (("raw", "bay", "target"), ("unreal", "cove", "level"), ("raw", "cove", "level")):
        with pytest.raises(BadInput) as refused:
            export(rough_level(8), target, out, name=name)
        assert str(refused.value) == f"{out} holds the unreal export of bay: give each {thing} a folder of its own"
    (out / "mine.psd").write_bytes(b"1")
    for target, name in (("unreal", "bay"), ("raw", "bay"), ("unreal", "cove")):
        with pytest.raises(BadInput, match=r"did not write .*mine\.psd|did not write .* more"):
            export(rough_level(8), target, out, name=name)
    assert snapshot(out) == before | {"mine.psd": b"1"}
    with pytest.raises(BadInput, match="is a file"):
        export(rough_level(8), "unreal", out / "mine.psd")


@pytest.mark.parametrize(
    "fault", [OSError(errno.ENOSPC, os.strerror(errno.ENOSPC)), KeyboardInterrupt(), ValueError("bug")]
)
@pytest.mark.parametrize("earlier", [False, True])
def test_broken_off_export_leaves_what_was_there(tmp_path, monkeypatch, fault, earlier):
    """A full disk, Ctrl+C or a bug in mid-export: no new folder, or the old one byte for byte."""
    out = tmp_path / "out"
    if earlier:
        export(rough_level(20), "unreal", out, name="bay")
    before = snapshot(out) if earlier else None

    def fail(path, *_):
        path.write_bytes(b"half")
        raise fault

    monkeypatch.setattr(heights.maps, "write_u16", fail)
    wanted = BadInput if isinstance(fault, OSError) else type(fault)
    with pytest.raises(wanted, match="No space left" if isinstance(fault, OSError) else None):
        export(rough_level(20, seed=2), "unreal", out, name="bay")
    assert (snapshot(out) if out.exists() else None) == before
    assert [path.name for path in tmp_path.iterdir()] == (["out"] if earlier else [])


@pytest.mark.parametrize("failing", range(4))
def test_failed_move_puts_the_old_export_back(tmp_path, monkeypatch, failing):
    """Two files leave and two come; whichever of the four moves the disk refuses, the old export stands."""
    out, rename, moves = tmp_path / "out", Path.rename, []
    export(rough_level(20), "unreal", out, name="bay")
    before = snapshot(out)

    def refuse(self, target):
        moves.append(target)
        if len(moves) == failing + 1:
            raise OSError(errno.EIO, "I/O error")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", refuse)
    with pytest.raises(BadInput, match="I/O error"):
        export(rough_level(20, seed=2), "unreal", out, name="bay")
    assert snapshot(out) == before


@pytest.mark.parametrize("killed_after", range(7))
def test_killed_while_replacing_is_found_and_repaired(tmp_path, monkeypatch, killed_after):
    """What a killed program leaves is never taken for a whole export, and the next export puts it right."""
    out, rename, moves = tmp_path / "out", Path.rename, []
    export(rough_level(20), "unreal", out, GROUND, name="bay")

    def until_killed(self, target):
        moves.append(target)
        if len(moves) <= killed_after:
            rename(self, target)

    with monkeypatch.context() as patch:  # the moves after the kill don't happen, and nobody tidies up
        patch.setattr(Path, "rename", until_killed)
        patch.setattr(shutil, "rmtree", lambda *_, **__: None)
        export(rough_level(20, seed=2), "unreal", out, GROUND, name="bay")
    if killed_after == 3:  # the old manifest is gone, the new one not there yet
        with pytest.raises(BadInput, match="no manifest"):
            check(out)
    else:
        assert (check(out) == []) == (killed_after in (0, 6))
    export(rough_level(20, seed=3), "unreal", out, name="bay")
    assert check(out) == []


def test_working_directory_stays_the_same_folder(tmp_path, monkeypatch):
    """`-o .` and mount points: an existing folder is filled, not exchanged."""
    monkeypatch.chdir(tmp_path)
    for seed in (1, 2):
        inode = tmp_path.stat().st_ino
        export(rough_level(8, seed=seed), "unreal", ".", GROUND, name="bay")
        assert tmp_path.stat().st_ino == inode
        assert sorted(os.listdir()) == ["bay.shorewright.json", "bay_flow.png", "bay_height.r16"]


def test_folder_that_fills_up_meanwhile_is_not_replaced(tmp_path, monkeypatch):
    out, write = tmp_path / "out", heights.maps.write_u16

    def somebody_comes(path, *rest):
        write(path, *rest)
        out.mkdir()
        (out / "notes.txt").write_text("mine", "utf-8")

    monkeypatch.setattr(heights.maps, "write_u16", somebody_comes)
    with pytest.raises(BadInput, match=r"notes\.txt"):
        export(rough_level(8), "unreal", out)
    assert snapshot(out) == {"notes.txt": b"mine"}


def test_manifest_cannot_claim_files_outside_its_folder(tmp_path):
    """Replacing an export deletes what its manifest lists, so a doctored list must not reach out."""
    out = tmp_path / "out"
    (tmp_path / "precious.txt").write_text("keep", "utf-8")
    export(rough_level(8), "unreal", out, name="bay")
    manifest = read_manifest(out)
    manifest["files"][0]["name"] = "../precious.txt"
    (out / "bay.shorewright.json").write_text(json.dumps(manifest), "utf-8")
    with pytest.raises(BadInput, match=r"bay_height\.r16"):
        export(rough_level(8), "unreal", out, name="bay")
    assert (tmp_path / "precious.txt").read_text("utf-8") == "keep"
