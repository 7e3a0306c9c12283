"""Reading a level's folder: everything checked before memory is taken, sectors decoded side by side."""

from __future__ import annotations

import json
import os
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..level import BadInput, Grid, Level
from ..level.wave_lists import left_out
from . import level_json
from .level_json import BASE, Manifest
from .level_sectors import check_sector, decode, file_hash, is_old, put_tiles, revision_of
from .mesh_files import file_of, read_meshes, wanted
from .sky_files import read_skies, sky_file_of, wanted_skies
from .transaction import RECORD, STAGE, pending, where

HASHES = "layers/hashes.json"
THREADS = min(8, os.cpu_count() or 2)
ATTEMPTS = 5  # another program may be saving the level while it is read


@dataclass
class Saved:
    """What the disk holds of a level: the revision it was saved at, and each sector file's hash and signature."""

    folder: Path
    revision: int
    base: np.ndarray
    hashes: dict[str, str] = field(default_factory=dict)
    signatures: dict[str, tuple | None] = field(default_factory=dict)
    meshes: dict[str, tuple | None] = field(default_factory=dict)  # signatures of their files
    skies: dict[str, tuple | None] = field(default_factory=dict)

    def is_stale(self, level: Level, name: str, path: Path) -> bool:
        """True when a sector changed in memory or its file on disk since."""
        if self.signatures.get(name) is None or self.signatures[name] != signature(path):
            return True
        if name.startswith(BASE + "."):  # a base is replaced, never changed in place
            return level.layers["height"].base is not self.base
        return revision_of(level, name) > self.revision


def read_committed(folder: Path, notes: list[str]) -> tuple[Level, Saved]:
    """The level as last committed, without a lock; while another program saves it, reading starts over."""
    for attempt in range(1, ATTEMPTS + 1):
        before = _fingerprint(folder)
        notes.clear()
        try:
            found = _read(folder, notes)
        except (BadInput, OSError) as error:
            if attempt == ATTEMPTS or (before == _fingerprint(folder) and before[-1] is None):
                if isinstance(error, BadInput):
                    raise
                raise BadInput(f"{folder} cannot be read: {error.strerror or error}") from None
        else:
            if before == _fingerprint(folder):
                return found
        time.sleep(0.05)
    raise BadInput(f"{folder} is being saved by another program over and over: try again later")


def _fingerprint(folder: Path) -> tuple:
    """What a save changes, whatever else it does."""
    return tuple(signature(folder / name) for name in (level_json.NAME, HASHES, f"{STAGE}/{RECORD}"))


def _read(folder: Path, notes: list[str]) -> tuple[Level, Saved]:
    record = pending(folder)
    manifest = _manifest(folder, record)
    grid = Grid(manifest.grid.rows, manifest.grid.cols, manifest.grid.cell_m)
    paths = {name: inside(folder, f"layers/{name}.exr", record) for name in manifest.layers}
    with ThreadPoolExecutor(THREADS) as pool:
        list(pool.map(lambda name: check_sector(paths[name], grid, name), paths))  # before memory is taken
        level = _fill(manifest, grid, paths, pool)
        hashes = dict(zip(paths, pool.map(file_hash, paths.values())))
    _compare(folder, paths, read_hashes(inside(folder, HASHES, record)), hashes, notes)
    signatures = {name: None if is_old(path, name) else signature(path) for name, path in paths.items()}
    files = {name: inside(folder, file_of(name), record) for name in wanted(level)}
    read_meshes(level, files, notes)
    meshes = {name: signature(files[name]) for name in files if name in level.meshes}
    files = {name: inside(folder, sky_file_of(name), record) for name in wanted_skies(level)}
    read_skies(level, files, notes)
    notes += left_out(level.objects.values())
    skies = {name: signature(files[name]) for name in files if name in level.skies}
    base = level.layers["height"].base
    return level, Saved(folder.resolve(), level.revision, base, hashes, signatures, meshes, skies)


def _compare(folder: Path, paths: dict[str, Path], known: dict[str, str], found: dict[str, str], notes: list) -> None:
    """A sector may decode and yet be damaged (incompressible parts lie bare in the file): its hash tells."""
    for name, path in paths.items():
        if known.get(name, found[name]) != found[name]:
            raise BadInput(
                f"{path} was damaged or changed since it was saved, its hash differs: restore it from a copy, or "
                f"delete its line in {folder / HASHES} to use it as it is"
            )
    unknown = [str(path) for name, path in paths.items() if name not in known]
    if unknown:
        more = f" and {len(unknown) - 1} more" if len(unknown) > 1 else ""
        notes.append(f"{unknown[0]}{more} has no hash in {HASHES}; used as it is")


def _manifest(folder: Path, record: dict | None) -> Manifest:
    path = inside(folder, level_json.NAME, record)
    if not path.is_file():
        raise BadInput(f"{folder} is not a level: its {level_json.NAME} is no file")
    try:
        if path.stat().st_size > level_json.MAX_BYTES:
            raise BadInput(f"{path} is larger than {level_json.MAX_BYTES >> 20} MB, so it is no level description")
        return level_json.parse(path, path.read_bytes())
    except OSError as error:
        raise BadInput(f"{path} cannot be read: {error.strerror}") from None


def inside(folder: Path, name: str, record: dict | None) -> Path:
    """The path of one of the level's files; BadInput when a link leads it out of the folder."""
    path = where(folder, name, record)
    if not path.resolve().is_relative_to(folder.resolve()):
        raise BadInput(f"{path} is a link that leads out of the level, so it is not followed")
    return path


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
