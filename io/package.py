"""A level as a folder: `name.shore/level.json`, `layers/NAME.rR.cC.exr` by sector, `layers/hashes.json`.

Only sectors that hold written tiles exist, except `height_base`, the imported ground, which is always whole; `height`
holds what was sculpted on it. R and C count 1024-cell sectors from the south-west. Saving rewrites dirty sectors only,
as one transaction (`transaction.py`); editing takes a lock, reading takes none.
"""

from __future__ import annotations

import json
import os
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from weakref import WeakKeyDictionary

import numpy as np

from ..level import BadInput, Grid, Level
from . import level_json
from .images import disk_reason
from .level_json import BASE, Manifest
from .level_sectors import (
    check_sector,
    decode,
    file_hash,
    put_tiles,
    refuse_nan,
    revision_of,
    sector_names,
    write_checked,
)
from .lock import check_folder, make_folder, remove_empty, take
from .transaction import RECORD, STAGE, Hook, Transaction, finish, pending, where

HASHES = "layers/hashes.json"
THREADS = min(8, os.cpu_count() or 2)


@dataclass
class Saved:
    """What the disk holds of a level: the revision it was saved at, and each sector file's hash and signature."""

    folder: Path
    revision: int
    base: np.ndarray
    hashes: dict[str, str] = field(default_factory=dict)
    signatures: dict[str, tuple | None] = field(default_factory=dict)

    def is_stale(self, level: Level, name: str, path: Path) -> bool:
        """True when a sector changed in memory or its file on disk since."""
        if self.signatures.get(name) is None or self.signatures[name] != signature(path):
            return True
        if name.startswith(BASE + "."):  # a base is replaced, never changed in place
            return level.layers["height"].base is not self.base
        return revision_of(level, name) > self.revision


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
        if self._created and not (self.path / level_json.NAME).exists() and not (self.path / STAGE / RECORD).exists():
            remove_empty(self.path)
        lock.release()

    # Reading

    def read(self) -> Level:
        """The level as last committed; while another program saves it, reading starts over."""
        check_folder(self.path)
        for _ in range(20):
            before = self._fingerprint()
            try:
                level = self._read()
            except BadInput:
                if before == self._fingerprint() and before[-1] is None:
                    raise
            else:
                if before == self._fingerprint():
                    return level
            time.sleep(0.05)
        return self._read()

    def _fingerprint(self) -> tuple:
        names = (level_json.NAME, HASHES, f"{STAGE}/{RECORD}")
        return tuple(signature(self.path / name) for name in names)

    def _read(self) -> Level:
        self.notes.clear()
        record = pending(self.path)
        manifest = self._manifest(record)
        grid = Grid(manifest.grid.rows, manifest.grid.cols, manifest.grid.cell_m)
        paths = {name: self._inside(f"layers/{name}.exr", record) for name in manifest.layers}
        with ThreadPoolExecutor(THREADS) as pool:
            list(pool.map(lambda name: check_sector(paths[name], grid, name), paths))  # before memory is taken
            level = _fill(manifest, grid, paths, pool)
            hashes = dict(zip(paths, pool.map(file_hash, paths.values())))
        self._compare(paths, read_hashes(self._inside(HASHES, record)), hashes)
        signatures = {name: signature(path) for name, path in paths.items()}
        base = level.layers["height"].base
        _saved[level] = Saved(self.path.resolve(), level.revision, base, hashes, signatures)
        return level

    def _compare(self, paths: dict[str, Path], known: dict[str, str], found: dict[str, str]) -> None:
        """A sector may decode and yet be damaged (incompressible parts lie bare in the file): its hash tells."""
        for name, path in paths.items():
            if known.get(name, found[name]) != found[name]:
                raise BadInput(
                    f"{path} was damaged or changed since it was saved, its hash differs: restore it from a copy, or "
                    f"delete its line in {self.path / HASHES} to use it as it is"
                )
        unknown = [str(path) for name, path in paths.items() if name not in known]
        if unknown:
            more = f" and {len(unknown) - 1} more" if len(unknown) > 1 else ""
            self.notes.append(f"{unknown[0]}{more} has no hash in {HASHES}; used as it is")

    def _manifest(self, record: dict | None) -> Manifest:
        path = self._inside(level_json.NAME, record)
        if not path.is_file():
            raise BadInput(f"{self.path} is not a level: its {level_json.NAME} is no file")
        try:
            if path.stat().st_size > level_json.MAX_BYTES:
                raise BadInput(f"{path} is larger than {level_json.MAX_BYTES >> 20} MB, so it is no level description")
            return level_json.parse(path, path.read_bytes())
        except OSError as error:
            raise BadInput(f"{path} cannot be read: {error.strerror}") from None

    def _inside(self, name: str, record: dict | None) -> Path:
        """The path of one of the level's files; BadInput when a link leads it out of the folder."""
        path = where(self.path, name, record)
        if not path.resolve().is_relative_to(self.path.resolve()):
            raise BadInput(f"{path} is a link that leads out of the level, so it is not followed")
        return path

    # Writing

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
            self._inside("layers/any", None)
            names = sector_names(level)
            dirty = [n for n in names if known is None or known.is_stale(level, n, self.path / f"layers/{n}.exr")]
            refuse_nan(level, dirty)
            hashes = {name: known.hashes[name] for name in names if name not in dirty} if known else {}
            revision, base = level.revision, level.layers["height"].base
            written = self._commit(level, save, names, dirty, hashes)
        except OSError as error:
            raise self._failed(save, error) from None
        except Exception:
            save.discard()
            raise
        signatures = {name: signature(self.path / f"layers/{name}.exr") for name in names}
        _saved[level] = Saved(self.path.resolve(), revision, base, hashes, signatures)
        return written

    def _commit(self, level: Level, save: Transaction, names: list[str], dirty: list[str], hashes: dict) -> list[str]:
        def stage(name: str) -> tuple[str, str]:
            save.hook(f"write layers/{name}.exr")
            return name, write_checked(level, name, save.path(f"layers/{name}.exr"))

        save.begin()
        with ThreadPoolExecutor(THREADS) as pool:
            for name, digest in pool.map(stage, dirty):
                save.add(f"layers/{name}.exr")
                hashes[name] = digest
        lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(hashes[name])}" for name in sorted(hashes))
        for name, data in ((HASHES, f"{{\n{lines}\n}}\n".encode()), (level_json.NAME, level_json.dump(level, names))):
            if not _same(self.path / name, data):
                save.write(name, data)
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


def _fill(manifest: Manifest, grid: Grid, paths: dict[str, Path], pool: ThreadPoolExecutor) -> Level:
    base = np.empty(grid.shape, np.float32)

    def put_base(name: str) -> None:
        base[grid.sector_rect(level_json.split(name)[1]).slices] = decode(paths[name], grid, name)[0]

    list(pool.map(put_base, [name for name in paths if name.startswith(BASE + ".")]))
    level = Level(grid, base, manifest.settings, dict(manifest.georeference))
    level.objects = {thing.id: thing for thing in manifest.objects}
    others = [name for name in paths if not name.startswith(BASE + ".")]
    for name, (samples, written) in zip(others, pool.map(lambda n: decode(paths[n], grid, n), others)):
        put_tiles(level, name, samples, written)
    return level


def read_hashes(path: Path) -> dict[str, str]:
    """The hashes of the last save; empty when they are gone or unreadable, which is told like any other change."""
    try:
        found = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def signature(path: Path) -> tuple | None:
    """What changes when a file is replaced or rewritten; None when it isn't there."""
    try:
        stat = path.stat()
    except OSError:
        return None
    return stat.st_ino, stat.st_mtime_ns, stat.st_size


def _same(path: Path, data: bytes) -> bool:
    try:
        return path.stat().st_size == len(data) and path.read_bytes() == data
    except OSError:
        return False
