"""The folder of a level as a thing to own: is it one, make it, lock it, put it away again."""

from __future__ import annotations

import contextlib
from pathlib import Path

from ..level import BadInput
from .level_json import NAME
from .transaction import FOLDERS, RECORD, STAGE, flush

LOCK = ".lock"  # there only while an editor has the level; one that a killed editor left locks nobody out
OURS = {LOCK, STAGE, *FOLDERS, NAME}


def check_folder(path: Path) -> None:
    """BadInput unless the path is the folder of a level (one whose save was committed but not yet tidied up counts)."""
    try:
        if not path.exists():
            raise BadInput(f"{path} does not exist")
        if not path.is_dir():
            raise BadInput(f"{path} is not a level: a level is a folder with a {NAME} in it")
        if is_husk(path) and (path / STAGE).exists():
            raise BadInput(f"{path} holds no level: its first save never finished; make it again under the same name")
        if not ((path / NAME).exists() or (path / STAGE / RECORD).exists()):
            raise BadInput(f"{path} is not a level: it has no {NAME}")
    except OSError as error:
        raise BadInput(f"{path} cannot be read: {error.strerror}") from None


def make_folder(path: Path) -> bool:
    """Make the folder of a new level where there is none; True when it was made. BadInput when that cannot be."""
    try:
        if not path.exists():
            path.mkdir()
            flush(path.parent)
            return True
        if not path.is_dir():
            raise BadInput(f"{path} is a file, so no level can be saved there")
        foreign = sorted(entry.name for entry in path.iterdir() if entry.name not in OURS)
    except FileNotFoundError:
        raise BadInput(f"{path} cannot be made: the folder {path.parent} does not exist") from None
    except OSError as error:
        raise BadInput(f"{path} cannot be made: {error.strerror}") from None
    if foreign and not (path / NAME).exists():
        raise BadInput(f"{path} holds other things ({foreign[0]}) and no level: choose a new name")
    return False


def take(path: Path):
    """The lock of a level's folder, held; BadInput when another editor has it or the folder is read-only."""
    import filelock

    lock = filelock.FileLock(str(path / LOCK), timeout=0, thread_local=False)
    try:
        if (path / LOCK).is_symlink():
            raise BadInput(f"{path / LOCK} is a link, so the level cannot be locked: remove it")
        lock.acquire()
    except filelock.Timeout:
        raise BadInput(f"{path} is open in another Shorewright: close it there first") from None
    except OSError as error:
        reason = error.strerror or error
        raise BadInput(f"{path} cannot be written to ({reason}): copy it to open it for editing") from None
    return lock


def let_go(path: Path, lock) -> None:
    """Give the lock of a level's folder back and leave no trace of it."""
    with contextlib.suppress(OSError):
        (path / LOCK).unlink(missing_ok=True)  # while it is held; filelock refuses a file without a name
    lock.release()


def is_husk(path: Path) -> bool:
    """Whether a folder is what a first save left that was killed: nothing of a level, and nothing of anybody else."""
    try:
        if path.is_symlink() or not path.is_dir() or (path / NAME).exists() or (path / STAGE / RECORD).exists():
            return False
        ours = all(entry.name in OURS for entry in path.iterdir())
        folders = [path / name for name in FOLDERS if (path / name).exists()]
        return ours and not any(folder.is_symlink() or any(folder.iterdir()) for folder in folders)
    except OSError:
        return False


def remove_empty(path: Path, whole: bool) -> None:
    """Put away what a first save that failed made, and the folder if `whole`; anything that isn't ours keeps it."""
    with contextlib.suppress(OSError):
        for name in FOLDERS:
            (path / name).rmdir() if (path / name).is_dir() else None
        if whole:
            (path / LOCK).unlink(missing_ok=True)
            path.rmdir()
