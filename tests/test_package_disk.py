"""Saving on a full disk, into read-only folders, beside another editor: a sentence, and the old level stays (T08)."""

import errno
import os
import subprocess
import sys
import tempfile
import textwrap
from pathlib import Path

import numpy as np
import pytest
from level_saves import change, make, state, steps_of
from shorewright.io import LevelFolder, check, read_level, write_level
from shorewright.level import BadInput, Rect


def test_a_full_disk_leaves_the_level_as_it_was(tmp_path):
    """ENOSPC at any step before the commit: one sentence, the old level, no litter."""
    path = tmp_path / "a.shore"
    level = make()
    write_level(level, path)
    before = {f.name: f.read_bytes() for f in path.rglob("*.*")}
    change(level)
    steps = steps_of(tmp_path, False)
    for at in range(steps.index("commit") + 1):
        left = [at]

        def refuse(step, left=left):
            left[0] -= 1
            if left[0] < 0:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        with LevelFolder(path, refuse) as folder, pytest.raises(BadInput, match="the disk is full"):
            folder.save(level)
        assert {f.name: f.read_bytes() for f in path.rglob("*.*")} == before, steps[at]
        assert not (path / ".save").exists()
    with LevelFolder(tmp_path / "new.shore", refuse) as folder, pytest.raises(BadInput, match="the disk is full"):
        folder.save(level)
    assert not (tmp_path / "new.shore").exists()
    assert write_level(level, path)


def test_a_writer_that_is_cut_off_is_noticed(tmp_path):
    """A real limit on file size: the image library's failed write is a sentence, the old level stays."""
    path = tmp_path / "a.shore"
    write_level(make(), path)
    code = f"""
        import resource, sys
        sys.path.insert(0, {str(os.path.dirname(__file__))!r})
        from level_saves import make, write_level
        from shorewright.level import BadInput
        level = make()
        resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))
        try:
            write_level(level, {str(path)!r})
        except BadInput as error:
            print(error)
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True)
    assert done.stderr == ""
    assert "cannot be saved" in done.stdout
    assert done.stdout.count("\n") == 1
    assert state(read_level(path)) == state(make())
    assert check(path) == []


def test_two_editors_are_kept_apart(tmp_path):
    """The second opener, in this process or another, gets a sentence with the level's name; readers get in."""
    path = tmp_path / "a.shore"
    write_level(make(), path)
    code = f"""
        from shorewright.io import LevelFolder, read_level
        from shorewright.level import BadInput
        read_level({str(path)!r})
        try:
            LevelFolder({str(path)!r}).open()
        except BadInput as error:
            print(error)
    """
    with LevelFolder(path) as folder:
        level = folder.open()
        done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True)
        assert done.stdout.startswith(f"{path} is open in another Shorewright"), done.stderr
        with pytest.raises(BadInput, match="open in another"):
            write_level(level, path)
        assert read_level(path).grid == level.grid
        level.write("snow", Rect(0, 0, 5, 5), 1.0)
        assert folder.save(level)
    with LevelFolder(path) as folder:
        assert not folder.open().layers["snow"].neutral


@pytest.fixture
def open_folder():
    """A temporary folder that other users can look into, unlike pytest's."""
    with tempfile.TemporaryDirectory() as name:
        Path(name).chmod(0o755)
        yield Path(name)


def test_a_read_only_folder_can_be_read_and_not_edited(open_folder):
    """As a user who may not write: rendering works, editing and saving are refused in a sentence each."""
    path = open_folder / "a.shore"
    write_level(make(), path)
    folders = (open_folder, path, path / "layers")
    for folder in folders:
        folder.chmod(0o555)
    code = f"""
        import os
        import OpenImageIO, filelock, concurrent.futures.thread, shorewright.io.lock
        from shorewright.io import LevelFolder, read_level, write_level
        from shorewright.level import BadInput
        if os.getuid() == 0:  # root may write anywhere
            os.setgid(65534), os.setuid(65534)
        level = read_level({str(path)!r})
        for action in (lambda: LevelFolder({str(path)!r}).open(), lambda: write_level(level, {str(path)!r}),
                       lambda: write_level(level, {str(path.parent / "new.shore")!r})):
            try:
                action()
            except BadInput as error:
                print(error)
    """
    try:
        done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True)
    finally:
        for folder in folders:
            folder.chmod(0o755)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert len(lines) == 3, done.stdout
    assert "cannot be written to" in lines[0]
    assert all("a.shore" in line for line in lines[:2])
    assert "new.shore cannot be made" in lines[2]


@pytest.mark.parametrize("name", ["layers/height_base.r0.c0.exr", "level.json", "layers"])
def test_files_that_may_not_be_read(open_folder, name):
    """One sentence, whatever it is that the user has no right to."""
    path = open_folder / "a.shore"
    write_level(make(), path)
    (path / name).chmod(0)
    code = f"""
        import os
        import OpenImageIO, concurrent.futures.thread
        from shorewright.io import read_level
        from shorewright.level import BadInput
        if os.getuid() == 0:  # root may read anything
            os.setgid(65534), os.setuid(65534)
        try:
            read_level({str(path)!r})
        except BadInput as error:
            print(error)
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True)
    (path / name).chmod(0o755)
    assert done.returncode == 0, done.stderr
    assert "cannot be read: Permission denied" in done.stdout
    assert done.stdout.count("\n") == 1


def test_nan_is_not_saved(tmp_path):
    """A map with NaN would make the level unreadable: refused before anything is touched."""
    path = tmp_path / "a.shore"
    level = make()
    write_level(level, path)
    level.write("height", Rect(0, 0, 2, 2), np.nan)
    with pytest.raises(BadInput, match="not numbers"):
        write_level(level, path)
    assert state(read_level(path)) == state(make())


def test_saving_over_other_things_is_refused(tmp_path):
    """A level is not saved into a folder that holds something else, nor onto a file, nor under a missing folder."""
    (tmp_path / "photos").mkdir()
    (tmp_path / "photos/one.jpg").write_bytes(b"x")
    (tmp_path / "file").write_bytes(b"x")
    for name, told in (("photos", "holds other things"), ("file", "is a file"), ("no/where", "does not exist")):
        with pytest.raises(BadInput, match=told):
            write_level(make(), tmp_path / name)
    assert sorted(f.name for f in tmp_path.rglob("*")) == ["file", "one.jpg", "photos"]
