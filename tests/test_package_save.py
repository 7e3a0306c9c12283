"""A save happens whole or not at all: killed at every step, on a full disk, read-only, beside another editor (T08)."""

import errno
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
from pathlib import Path

import numpy as np
import pytest
from shorewright.io import LevelFolder, check, read_level, write_level
from shorewright.level import BadInput, Grid, Level, Rect
from shorewright.level.objects import Camera


class Killed(BaseException):
    """Stands for the end of the process: nothing in the program catches it."""


def make():
    level = Level(Grid(40, 1200), np.random.default_rng(0).normal(0, 5, (40, 1200)).astype(np.float32))
    level.write("foam", Rect(0, 0, 5, 5), 0.5)
    return level


def change(level):
    """Rewrite a sector, add one, empty one, place an object."""
    level.write("height", Rect(0, 1000, 9, 1100), 9.0)
    level.layers["foam"].put_tile((0, 0), None)
    level.mark("foam", Rect(0, 0, 9, 9))
    level.put_object("play", Camera(id="play"))


def state(level):
    layers = {n: d.array[d.written.repeat(128, 0).repeat(128, 1)[: d.array.shape[0], : d.array.shape[1]]].tobytes()
              for n, d in level.layers.items() if not d.neutral}  # fmt: skip
    return level.height.tobytes(), layers, sorted(level.objects)


def steps_of(tmp_path, first):
    """What a save reports, in order."""
    level = make()
    path = tmp_path / "count.shore"
    if not first:
        write_level(level, path)
        change(level)
    seen = []
    with LevelFolder(path, seen.append) as folder:
        folder.save(level)
    shutil.rmtree(path)
    return seen


@pytest.mark.parametrize("first", [False, True], ids=["second save", "first save"])
def test_killed_at_every_step(tmp_path, first):
    """Whatever the step, the level is then the old or the new one, for readers and editors alike, and saves again."""
    steps = steps_of(tmp_path, first)
    assert {"begin", "write record", "commit", "forget record", "done"} <= set(steps)
    assert any(step.startswith("remove ") for step in steps) is not first
    outcomes = set()
    for at in range(len(steps)):
        path = tmp_path / f"{at}.shore"
        level = make()
        old = None if first else state(level)
        if not first:
            write_level(level, path)
            change(level)
        new, left = state(level), [at]

        def kill(step, left=left):
            left[0] -= 1
            if left[0] < 0:
                raise Killed(step)

        folder = LevelFolder(path, kill)
        with pytest.raises(Killed):
            folder.save(level)
        folder._lock.release()  # what the system does for a dead process
        outcomes.add(_check_after(path, level, old, new, steps[at]))
    assert outcomes == {"old", "new"}


def _check_after(path, level, old, new, step):
    try:
        found = state(read_level(path))
    except BadInput:
        found = None  # a first save that did not happen
    assert found in (old, new), step
    if found is not None:
        with LevelFolder(path) as folder:
            assert state(folder.open()) == found, step
        assert not (path / ".save").exists()
        assert check(path) == []
    write_level(level, path)
    assert state(read_level(path)) == new
    assert not (path / ".save").exists()
    return "new" if found == new else "old"


MOMENTS = ("flush layers/height.r0.c0.exr", "commit", "move layers/height.r0.c1.exr", "forget record")


@pytest.mark.parametrize("step", MOMENTS)
def test_killed_for_real(tmp_path, step):
    """SIGKILL in mid-save: old before the commit, new after it."""
    path = tmp_path / "a.shore"
    code = f"""
        import os, signal, sys
        sys.path.insert(0, {str(os.path.dirname(__file__))!r})
        from test_package_save import LevelFolder, change, make, write_level
        level = make()
        write_level(level, {str(path)!r})
        change(level)
        def kill(step):
            if step == {step!r}:
                os.kill(os.getpid(), signal.SIGKILL)
        LevelFolder({str(path)!r}, kill).save(level)
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True)
    assert done.returncode == -signal.SIGKILL, done.stderr
    level = make()
    old = state(level)
    change(level)
    expected = state(level) if step.startswith(("move", "forget")) else old
    assert state(read_level(path)) == expected
    with LevelFolder(path) as folder:
        assert state(folder.open()) == expected


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
        from test_package_save import BadInput, make, write_level
        import numpy as np
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


def test_reading_while_it_is_saved_gives_old_or_new(tmp_path):
    """A reader takes no lock and never sees a mixture."""
    path = tmp_path / "a.shore"
    level = make()
    write_level(level, path)
    old = state(level)
    change(level)
    new, seen = state(level), []

    with LevelFolder(path, lambda step: seen.append(state(read_level(path)))) as folder:
        folder.save(level)
    assert set(map(str, seen)) == {str(old), str(new)}
    assert seen.index(new) == len(seen) - seen[::-1].index(old)


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


def test_an_interrupted_save_is_read_where_nobody_may_write(tmp_path):
    """Reading sees through a commit record without finishing it."""
    path = tmp_path / "a.shore"
    level = make()
    write_level(level, path)
    change(level)

    def kill(step):
        if step == "move layers/height.r0.c1.exr":
            raise Killed(step)

    folder = LevelFolder(path, kill)
    with pytest.raises(Killed):
        folder.save(level)
    folder._lock.release()
    before = sorted(f.name for f in path.rglob("*"))
    assert state(read_level(path)) == state(level)
    assert sorted(f.name for f in path.rglob("*")) == before
    assert "interrupted" in check(path)[0]


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
