"""A save happens whole or not at all, at whatever step the process is killed (T08)."""

import os
import signal
import subprocess
import sys
import textwrap

import pytest
from level_saves import Killed, change, make, state, steps_of
from shorewright.io import LevelFolder, check, read_level, write_level
from shorewright.level import BadInput


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
        from level_saves import LevelFolder, change, make, write_level
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
