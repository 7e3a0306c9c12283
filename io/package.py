"""A level as a folder: `name.shore/level.json`, `layers/NAME.rR.cC.exr` by sector with `layers/hashes.json`, and
`meshes/` and `skies/` where there are any.

Only sectors that hold written tiles exist, except `height_base`, the imported ground, which is always whole; `height`
holds what was sculpted on it. R and C count 1024-cell sectors from the south-west. Saving rewrites dirty sectors only,
as one transaction (`transaction.py`); editing takes a lock, reading takes none.
"""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from weakref import WeakKeyDictionary

import numpy as np

from ..level import BadInput, Level
from ..level.meshes import NAME
from . import level_json
from .level_sectors import refuse_nan, sector_names, write_checked
from .lock import check_folder, let_go, make_folder, remove_empty, take
from .mesh_files import FOLDER, file_of, packed, wanted
from .package_read import HASHES, THREADS, Saved, inside, read_committed, signature
from .sky_files import FOLDER as SKIES
from .sky_files import sky_file_of, wanted_skies, write_checked_sky
from .transaction import FOLDERS, RECORD, STAGE, Hook, Transaction, disk_reason, finish

_saved: WeakKeyDictionary[Level, Saved] = WeakKeyDictionary()


def read_level(path: Path | str, notes: list[str] | None = None) -> Level:
    """The level in a folder, read without a lock and without touching it; `notes` takes what is worth telling.

    BadInput when it is missing, damaged, newer than this version or reaches out of its folder.
    """
    folder = LevelFolder(path)
    level = folder.read()
    if notes is not None:
        notes += folder.notes
    return level


def write_level(level: Level, path: Path | str) -> list[str]:
    """Save a level to a folder, new or its own: dirty sectors only, whole or not at all; returns the files written.

    BadInput when the disk refuses, another editor has the level, or a map holds NaN.
    """
    with LevelFolder(path) as folder:
        return folder.save(level)


class LevelFolder:
    """A level's folder in use: `open` locks and reads it, `save`, `close` lets go. `hook` sees each step of a save."""

    def __init__(self, path: Path | str, hook: Hook | None = None) -> None:
        self.path = Path(path)
        self.notes: list[str] = []
        self._hook = hook
        self._lock = None
        self._created = False

    def __enter__(self) -> LevelFolder:
        return self

    def __exit__(self, *exc) -> None:
        self.close()

    def open(self) -> Level:
        """Lock the level for editing, finish or discard an interrupted save, and read it."""
        check_folder(self.path)
        self.lock()
        try:
            finish(self.path)
            return self.read()
        except OSError as error:
            self.close()
            raise BadInput(f"{self.path} cannot be opened for editing: {error.strerror or error}") from None
        except BadInput:
            self.close()
            raise

    def lock(self) -> None:
        """Take the lock, making the folder when it is new; BadInput when somebody else edits the level."""
        if self._lock is None:
            self._created = make_folder(self.path)
            self._lock = take(self.path)

    def close(self) -> None:
        """Let go of the lock; a folder made for a save that failed goes away again."""
        lock, self._lock = self._lock, None
        if lock is None:
            return
        if not (self.path / level_json.NAME).exists() and not (self.path / STAGE / RECORD).exists():
            remove_empty(self.path, self._created)
        let_go(self.path, lock)

    def read(self) -> Level:
        """The level as last committed; needs no lock."""
        check_folder(self.path)
        level, saved = read_committed(self.path, self.notes)
        _saved[level] = saved
        return level

    def save(self, level: Level) -> list[str]:
        """Write what changed since this level was read or saved here; returns the names of the files written.

        BadInput when the disk refuses or a map holds NaN; the level on disk is then as it was.
        """
        self.lock()
        known = _saved.get(level)
        if known and known.folder != self.path.resolve():
            known = None
        save = Transaction(self.path, self._hook)
        try:
            finish(self.path)
            for folder in FOLDERS:
                inside(self.path, f"{folder}/any", None)
            names = sector_names(level)
            dirty = [n for n in names if known is None or known.is_stale(level, n, self.path / f"layers/{n}.exr")]
            refuse_nan(level, dirty)
            hashes = {name: known.hashes[name] for name in names if name not in dirty} if known else {}
            revision, base = level.revision, level.layers["height"].base
            own = self._mesh_files(level, known), self._sky_files(level, known)
            written = self._commit(level, save, names, dirty, hashes, *own)
        except OSError as error:
            raise self._failed(save, error) from None
        except Exception:
            save.discard()
            raise
        signatures = {name: signature(self.path / f"layers/{name}.exr") for name in names}
        meshes = {name: signature(self.path / file_of(name)) for name in wanted(level) if name in level.meshes}
        skies = {name: signature(self.path / sky_file_of(name)) for name in wanted_skies(level) if name in level.skies}
        _saved[level] = Saved(self.path.resolve(), revision, base, hashes, signatures, meshes, skies)
        return written

    def _mesh_files(self, level: Level, known: Saved | None) -> dict[str, bytes | None]:
        """Files of meshes to write, and (None) those to remove, which no prop names any more."""
        kept, files = wanted(level), {}
        for name in kept:
            there = signature(self.path / file_of(name))
            if name in level.meshes and (there is None or known is None or known.meshes.get(name) != there):
                data = packed(level.meshes[name])
                if not _same(self.path / file_of(name), data):
                    files[file_of(name)] = data
        stale = (path for path in sorted((self.path / FOLDER).glob("*.ply")) if path.stem not in kept)
        return files | {f"{FOLDER}/{path.name}": None for path in stale if NAME.fullmatch(path.stem)}

    def _sky_files(self, level: Level, known: Saved | None) -> dict[str, np.ndarray | None]:
        """Files of skies to write, and (None) those to remove, which no shot names any more."""
        kept, files = wanted_skies(level), {}
        for name in kept:
            there = signature(self.path / sky_file_of(name))
            if name in level.skies and (there is None or known is None or known.skies.get(name) != there):
                files[sky_file_of(name)] = level.skies[name]
        stale = (path for path in sorted((self.path / SKIES).glob("*.exr")) if path.stem not in kept)
        return files | {f"{SKIES}/{path.name}": None for path in stale if NAME.fullmatch(path.stem)}

    def _commit(
        self, level: Level, save: Transaction, names: list[str], dirty: list[str], hashes: dict,
        meshes: dict[str, bytes | None], skies: dict[str, np.ndarray | None],
    ) -> list[str]:  # fmt: skip
        def stage(name: str) -> tuple[str, str]:
            save.hook(f"write layers/{name}.exr")
            return name, write_checked(level, name, save.path(f"layers/{name}.exr"))

        save.begin(tuple(name for name, used in zip(FOLDERS, (True, meshes, skies)) if used))
        with ThreadPoolExecutor(THREADS) as pool:
            for name, digest in pool.map(stage, dirty):
                save.add(f"layers/{name}.exr")
                hashes[name] = digest
        lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(hashes[name])}" for name in sorted(hashes))
        for name, data in ((HASHES, f"{{\n{lines}\n}}\n".encode()), (level_json.NAME, level_json.dump(level, names))):
            if not _same(self.path / name, data):
                save.write(name, data)
        for name, data in meshes.items():
            save.remove(name) if data is None else save.write(name, data)
        for name, sky in skies.items():
            if sky is None:
                save.remove(name)
                continue
            save.hook(f"write {name}")
            write_checked_sky(sky, save.path(name))
            save.add(name)
        for path in sorted((self.path / "layers").glob("*.exr")):
            if path.stem not in hashes and level_json.is_sector(path.stem):
                save.remove(f"layers/{path.name}")
        save.commit()
        return list(save.moves)

    def _failed(self, save: Transaction, error: OSError) -> BadInput:
        """The sentence for a save the disk refused; what was staged goes away unless it was already committed."""
        if (save.stage / RECORD).exists():
            return BadInput(f"{self.path} was saved, but tidying up failed ({error.strerror or error}): open it again")
        reason = disk_reason(error, self.path)
        save.discard()
        return BadInput(f"{self.path} cannot be saved: {reason}; what was saved before is untouched")


def _same(path: Path, data: bytes) -> bool:
    try:
        return path.stat().st_size == len(data) and path.read_bytes() == data
    except OSError:
        return False
