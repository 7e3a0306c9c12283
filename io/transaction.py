"""A save that happens whole or not at all.

New files are written and flushed under `.save/`; then the commit record `.save/commit.json`, itself renamed into place,
says which of them to move where and what to remove; then they are moved, and the record is removed last. Found on
opening: no record = the save never happened, `.save/` is discarded; a record = the save is finished. A reader who may
not write sees through the record (`where`): it takes a file from `.save/` while it still stands there.
"""

from __future__ import annotations

import contextlib
import errno
import json
import os
import re
import shutil
from collections.abc import Callable
from pathlib import Path

from ..level import BadInput

STAGE = ".save"
RECORD = "commit.json"
FOLDERS = ("layers", "meshes", "skies")  # in a level's folder
NAME = re.compile(r"((layers|meshes|skies)/)?[A-Za-z0-9_]+(\.[A-Za-z0-9_]+)*")  # all that a record may name
MAX_RECORD = 16 << 20
SPARE_BYTES = 1 << 20  # a disk with less left is full

Hook = Callable[[str], None]


class Transaction:
    """Files to be put in place and removed together; `hook` is told each step before it is taken."""

    def __init__(self, folder: Path, hook: Hook | None = None) -> None:
        self.folder = folder
        self.stage = folder / STAGE
        self.hook = hook or (lambda step: None)
        self.moves: list[str] = []
        self.removals: list[str] = []

    def begin(self, folders: tuple[str, ...] = ("layers",)) -> None:
        """Make the stage; `folders` are those of the level that this save writes to or removes from."""
        self.hook("begin")
        for name in folders:
            (self.folder / name).mkdir(exist_ok=True)
            if not os.access(self.folder / name, os.W_OK | os.X_OK):  # now, not when the record already stands
                raise PermissionError(errno.EACCES, f"its folder {name} is read-only")
        self.stage.mkdir()
        for name in folders:
            (self.stage / name).mkdir()

    def path(self, name: str) -> Path:
        """Where to write the new content of a file; `add` it afterwards."""
        return self.stage / name

    def add(self, name: str) -> None:
        """A staged file is complete: flush it to the disk."""
        self.hook(f"flush {name}")
        flush(self.stage / name)
        self.moves.append(name)

    def write(self, name: str, data: bytes) -> None:
        self.hook(f"write {name}")
        (self.stage / name).write_bytes(data)
        self.add(name)

    def remove(self, name: str) -> None:
        self.removals.append(name)

    def commit(self) -> None:
        """The record makes it so; what follows only tidies up and may be done by whoever opens the level next."""
        record = json.dumps({"move": sorted(self.moves), "remove": sorted(self.removals)}).encode()
        self.hook("write record")
        part = self.stage / (RECORD + ".part")
        part.write_bytes(record)
        flush(part)
        for name in FOLDERS:
            if (self.stage / name).is_dir():
                flush(self.stage / name)
        self.hook("commit")
        os.replace(part, self.stage / RECORD)
        flush(self.stage)
        finish(self.folder, self.hook)

    def discard(self) -> None:
        """Leave no trace of a save that did not come to its commit record."""
        if not (self.stage / RECORD).exists():
            _clear(self.stage)


def pending(folder: Path) -> dict[str, list[str]] | None:
    """The commit record of an interrupted save, checked; None when there is none. BadInput when it makes no sense."""
    path = folder / STAGE / RECORD
    if (folder / STAGE).is_symlink() or path.is_symlink():
        raise BadInput(f"{folder / STAGE} is a link that leads out of the level, so the level is not opened")
    try:
        if path.stat().st_size > MAX_RECORD:
            raise ValueError("too long")
        record = json.loads(path.read_bytes())
        names = [*record["move"], *record["remove"]]
        if not all(isinstance(name, str) and NAME.fullmatch(name) for name in names):
            raise ValueError("a name leads out of the level")
    except FileNotFoundError:
        return None
    except (ValueError, TypeError, KeyError, RecursionError) as error:
        raise BadInput(f"{path} is no commit record of a save ({error}): move it away to open the level") from None
    return record


def finish(folder: Path, hook: Hook | None = None) -> None:
    """Complete a save whose record stands; discard one that has none. The caller holds the lock."""
    hook = hook or (lambda step: None)
    stage = folder / STAGE
    record = pending(folder)
    if record is None:
        _clear(stage)
        return
    (folder / "layers").mkdir(exist_ok=True)
    for name in record["move"]:
        hook(f"move {name}")
        (folder / name).parent.mkdir(exist_ok=True)
        with contextlib.suppress(FileNotFoundError):  # moved before the interruption
            os.replace(stage / name, folder / name)
    for name in record["remove"]:
        hook(f"remove {name}")
        (folder / name).unlink(missing_ok=True)
    for name in FOLDERS[1:]:
        with contextlib.suppress(OSError):
            (folder / name).rmdir()  # when nothing is left in it
    for name in FOLDERS:
        if (folder / name).is_dir():
            flush(folder / name)
    flush(folder)
    hook("forget record")
    (stage / RECORD).unlink()
    _clear(stage)
    hook("done")


def where(folder: Path, name: str, record: dict[str, list[str]] | None) -> Path:
    """The path at which the committed content of a file stands now."""
    if record and name in record["move"] and (folder / STAGE / name).exists():
        return folder / STAGE / name
    return folder / name


def _clear(stage: Path) -> None:
    """Remove what a save staged; nothing outside it is touched, whatever a link says."""
    if stage.is_symlink() or not stage.is_dir():
        return
    for place in (*(stage / name for name in FOLDERS), stage):
        if place.is_symlink() or not place.is_dir():
            continue
        for entry in place.iterdir():
            if entry.is_symlink() or entry.is_file():
                entry.unlink()
    for place in (*(stage / name for name in FOLDERS), stage):
        with contextlib.suppress(OSError):
            place.rmdir()


def flush(path: Path) -> None:
    """fsync a file or a folder, so that what follows cannot reach the disk before it."""
    if path.is_dir() and os.name == "nt":
        return  # folders cannot be opened there
    handle = os.open(path, os.O_RDONLY if path.is_dir() else os.O_RDWR)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def disk_reason(error: OSError, folder: Path) -> str:
    """Why a file could not be written; an image writer only says that it failed, so the disk is asked."""
    full = error.errno in (errno.ENOSPC, errno.EDQUOT)
    if not error.errno:
        with contextlib.suppress(OSError):
            full = shutil.disk_usage(folder).free < SPARE_BYTES
    return "the disk is full" if full else error.strerror or str(error)
