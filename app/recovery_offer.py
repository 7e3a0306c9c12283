"""What killed editors left behind: finding their logs, reading what is in them, offering it (T08).

A log whose lock nobody holds belongs to an editor that died.
"""

from __future__ import annotations

import contextlib
import hashlib
import logging
import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ..io.migrate import VERSION, migrate_settings, new_tiles
from . import recovery_record as record

log = logging.getLogger(__name__)
SUFFIX = ".recovery"


def default_root() -> Path:
    import platformdirs

    return platformdirs.user_state_path("shorewright", appauthor=False) / "recovery"


@dataclass
class Offer:
    """What a killed editor left; `folder` is None for a level that was never saved."""

    path: Path
    folder: Path | None
    labels: list[str]
    time: float
    changed_since: bool
    good_bytes: int

    @property
    def sentence(self) -> str:
        """What the editor asks, on one line."""
        name = self.folder.name if self.folder else "a level that was never saved"
        count = len(self.labels)
        told = f"{name} was not closed: {count} step{'s' if count != 1 else ''} not in its folder"
        return told + ("; the folder was changed since by something else" if self.changed_since else "")

    def change(self) -> record.Change:
        """All of it as one change, to be applied to the level as its folder holds it."""
        with open(self.path, "rb") as file:
            return record.fold(changes_of(file))

    def discard(self) -> None:
        """Forget it; nothing happens when another editor took it up meanwhile."""
        lock = try_lock(self.path)
        if lock is not None:
            with contextlib.suppress(OSError):
                self.path.unlink()
            release(lock)


def offers(root: Path | None = None) -> list[Offer]:
    """What killed editors left behind, newest first; logs that hold nothing are removed on the way."""
    found = []
    for path in sorted((root or default_root()).glob(f"*{SUFFIX}")):
        lock = try_lock(path)
        if lock is None:
            continue  # its editor lives
        try:
            offer = read_offer(path)
            if offer is None:
                path.unlink(missing_ok=True)
            else:
                found.append(offer)
        except OSError as error:
            log.warning("%s cannot be read: %s", path, error)
        finally:
            release(lock)
    return sorted(found, key=lambda offer: -offer.time)


def read_offer(path: Path) -> Offer | None:
    """The offer in a log; None when everything in it was saved, or it never got as far as a step."""
    head, labels, good, saving = {}, [], 0, False
    with open(path, "rb") as file:
        for good_bytes, header, _ in rows_of(file):
            good = good_bytes
            head = head or header
            saving = header["kind"] == "saving"
            if header["kind"] == "step":
                labels += header.get("labels") or [header["label"]]
    if head.get("kind") != "start" or not 1 <= head["version"] <= VERSION:
        return None
    folder = Path(head["folder"]) if head["folder"] else None
    if folder is None:
        labels = labels[1:]  # the level itself
    changed = folder is not None and fingerprint(folder) != head["fingerprint"]
    if not labels or (saving and changed):
        return None
    return Offer(path, folder, labels, os.path.getmtime(path), changed, good)


def rows_of(file) -> Iterator[tuple[int, dict, bytes]]:
    """(offset past it, header, payload) of each whole record of a log."""
    while (row := record.read(file)) is not None:
        yield file.tell(), *row


def changes_of(file) -> Iterator[record.Change]:
    """The steps in a log, oldest first; what older versions wrote is brought forward."""
    version = VERSION
    for _, header, payload in rows_of(file):
        version = header["version"] if header["kind"] == "start" else version
        if header["kind"] == "step":
            if "settings" in header:
                header["settings"] = migrate_settings(header["settings"], version)
            change = record.decode(header, payload)
            change.tiles = {layer: new_tiles(layer, tiles) for layer, tiles in change.tiles.items()}
            yield change


def fingerprint(folder: Path) -> str | None:
    """What tells one saved state of a level's folder from another; None when there is no level."""
    digest = hashlib.sha256()
    try:
        digest.update((folder / "level.json").read_bytes())
    except OSError:
        return None
    with contextlib.suppress(OSError):
        digest.update((folder / "layers" / "hashes.json").read_bytes())
    return digest.hexdigest()


def try_lock(path: Path):
    from filelock import FileLock, Timeout

    lock = FileLock(path.with_suffix(".lock"))
    try:
        lock.acquire(timeout=0)
    except (Timeout, OSError):
        return None
    return lock


def release(lock) -> None:
    with contextlib.suppress(OSError):
        os.unlink(lock.lock_file)  # while it is held: nobody waits for it
    lock.release()
