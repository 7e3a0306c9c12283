"""Programs killed in the middle of `new`, a save or an export: the next one carries on and clears up (T08, T10)."""

import os
import signal
import subprocess
import sys
import textwrap

import pytest
from level_saves import make, state, steps_of
from shorewright.app.cli import main
from shorewright.io import LevelFolder, check, export, read_level
from shorewright.io.lock import is_husk
from shorewright.level import BadInput


def killed(code):
    """Run Python that ends itself with SIGKILL."""
    kill = f"import os; die = lambda *_: os.kill(os.getpid(), {int(signal.SIGKILL)})\n"
    path = f"import sys; sys.path.insert(0, {os.path.dirname(__file__)!r})\n"
    done = subprocess.run([sys.executable, "-c", kill + path + textwrap.dedent(code)], capture_output=True, text=True)
    assert done.returncode == -signal.SIGKILL, done.stderr


@pytest.mark.skipif(os.name == "nt", reason="SIGKILL")
@pytest.mark.parametrize("step", ["begin", "write layers/height_base.r0.c0.exr", "commit", "move level.json"])
def test_a_first_save_that_was_killed(tmp_path, capsys, step):
    """T08: before the record the name is still free, after it the level is there; nothing to clear away by hand."""
    path = tmp_path / "a.shore"
    steps = steps_of(tmp_path, True)
    killed(f"""
        from level_saves import LevelFolder, make
        LevelFolder({str(path)!r}, lambda step: die() if step == {step!r} else None).save(make())
    """)
    if steps.index(step) > steps.index("commit"):
        assert not is_husk(path)
        assert state(read_level(path)) == state(make())
        assert main(["new", str(path)]) == 2
    else:
        assert is_husk(path)
        with pytest.raises(BadInput, match="no level"):
            read_level(path)
        assert main(["new", str(path), "--size", "33"]) == 0
        assert check(path) == []
    with LevelFolder(path) as folder:
        folder.open()
    assert sorted(os.listdir(path)) == ["layers", "level.json"]
    capsys.readouterr()


@pytest.mark.parametrize("name", ["level.json", "notes.txt", "layers/foam.r0.c0.exr", ".save/commit.json"])
def test_only_a_husk_is_taken_over(tmp_path, capsys, name):
    """A folder with anything of a level, or of anybody, is not made anew."""
    path = tmp_path / "a.shore"
    (path / name).parent.mkdir(parents=True)
    (path / name).write_text("mine")
    assert not is_husk(path)
    assert main(["new", str(path)]) == 2
    assert "exists already" in capsys.readouterr().err
    assert (path / name).read_text() == "mine"
    assert sorted(os.listdir(path)) == [name.partition("/")[0]]


def test_a_failed_save_leaves_an_empty_folder_empty(tmp_path):
    """A folder made beforehand stays, as it was."""
    path = tmp_path / "a.shore"
    path.mkdir()

    def refuse(_step):
        raise OSError(28, "No space left on device")

    with LevelFolder(path, refuse) as folder, pytest.raises(BadInput, match="the disk is full"):
        folder.save(make())
    assert os.listdir(path) == []


def test_layers_that_take_no_files(tmp_path, monkeypatch):
    """A read-only `layers` is found before the save is committed, not after."""
    from shorewright.io import transaction

    path = tmp_path / "a.shore"
    with LevelFolder(path) as folder:
        folder.save(make())
    before = {f: f.read_bytes() for f in path.rglob("*.*")}
    level = read_level(path)
    level.set("level.sea_level_m", 1.0)
    monkeypatch.setattr(transaction.os, "access", lambda *_: False)
    with LevelFolder(path) as folder, pytest.raises(BadInput, match="read-only"):
        folder.save(level)
    assert {f: f.read_bytes() for f in path.rglob("*.*")} == before
    assert sorted(os.listdir(path)) == ["layers", "level.json"]


@pytest.mark.skipif(os.name == "nt", reason="SIGKILL")
@pytest.mark.parametrize("earlier", [False, True])
def test_what_a_killed_export_left_goes_with_the_next(tmp_path, earlier):
    """T10: parts of a killed export beside or inside the folder go; those of a running one stay."""
    out, level = tmp_path / "out", make()
    if earlier:
        export(level, "unreal", out, name="bay")
    killed(f"""
        from level_saves import make
        from shorewright.io.export import export, heights
        heights.maps.write_u16 = die
        level = make()
        level.set("level.sea_level_m", 0.25)  # or its ground would be kept from the export before
        export(level, "unreal", {str(out)!r}, name="bay")
    """)
    home = out if earlier else tmp_path
    assert len(list(home.glob(".shorewright-part-*"))) == 2  # what it had begun, and its lock
    from shorewright.io.export.folder import staged

    with staged(out, "bay.shorewright.json", "unreal") as running:
        assert len(list(home.glob(".shorewright-part-*"))) == 2
        export(level, "unreal", out, name="bay")
        assert running.is_dir()
    export(level, "unreal", out, name="bay")
    assert check(out) == []
    assert list(tmp_path.glob(".*")) == list(out.glob(".*")) == []
