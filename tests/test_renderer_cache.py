"""Arrays kept on disk between starts: made once, made anew when damaged or of other code, never needed."""

import os
from pathlib import Path

import numpy as np
import pytest
from shorewright.renderer import cache
from shorewright.renderer.air import make_multiple_table, multiple_table
from shorewright.renderer.cache import KEPT, cached, folder


class Maker:
    """Counts how often it had to make its array."""

    def __init__(self) -> None:
        self.count = 0
        self.array = np.random.default_rng(3).integers(0, 255, (4, 16, 16, 4), np.uint8)

    def __call__(self) -> np.ndarray:
        self.count += 1
        return self.array


@pytest.fixture
def own(tmp_path, monkeypatch):
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path / "made"))
    return tmp_path / "made"


@pytest.fixture
def code(tmp_path):
    path = tmp_path / "code.py"
    path.write_text("first = 1\n")
    return path


def test_the_second_start_reads_what_the_first_made(own, code):
    make = Maker()
    first, again = (cached("noise", make, str(code), 7) for _ in range(2))
    assert make.count == 1
    assert np.array_equal(first, again)
    assert (again.dtype, again.shape) == (make.array.dtype, make.array.shape)
    assert [path.suffix for path in own.iterdir()] == [".npy"]


def test_other_code_and_other_arguments_make_anew(own, code):
    make = Maker()
    cached("noise", make, str(code), 7)
    cached("noise", make, str(code), 8)
    assert make.count == 2
    code.write_text("first = 2\n")
    cached("noise", make, str(code), 7)
    assert make.count == 3


@pytest.mark.parametrize("damage", ["cut", "empty", "changed", "appended", "replaced"])
def test_a_damaged_file_is_made_anew(own, code, damage):
    make = Maker()
    cached("noise", make, str(code))
    (path,) = own.iterdir()
    data = bytearray(path.read_bytes())
    data[-100] ^= 1
    rest = {"cut": data[:200], "empty": b"", "changed": data, "appended": data + b"x", "replaced": b"\0" * len(data)}
    path.write_bytes(rest[damage])
    for _ in range(2):
        assert np.array_equal(cached("noise", make, str(code)), make.array)
    assert make.count == 2


def test_a_folder_that_cannot_be_written_costs_only_the_time(tmp_path, monkeypatch, code):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path / "file" / "made"))
    make = Maker()
    for _ in range(2):
        assert np.array_equal(cached("noise", make, str(code)), make.array)
    assert make.count == 2


def test_a_full_disk_leaves_no_half_file(own, code, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    make = Maker()
    assert np.array_equal(cached("noise", make, str(code)), make.array)
    assert list(own.iterdir()) == []


def test_old_files_go(own, code):
    for number in range(KEPT + 5):
        cached("sky", Maker(), str(code), number)
    cached("noise", Maker(), str(code))
    assert len(list(own.glob("sky-*"))) == KEPT
    assert len(list(own.glob("noise-*"))) == 1


def test_the_folder_is_the_users_cache_or_the_variables(own, monkeypatch):
    assert folder() == own
    monkeypatch.setenv(cache.VARIABLE, "")
    monkeypatch.setenv("XDG_CACHE_HOME", str(own))
    assert "shorewright" in str(folder())
    assert isinstance(folder(), Path)


def test_what_is_read_is_what_is_made(own):
    """The sky's table by way of the disk and without it: the same numbers."""
    multiple_table.cache_clear()
    multiple_table(2.25)
    multiple_table.cache_clear()
    assert np.array_equal(multiple_table(2.25), make_multiple_table(2.25))
