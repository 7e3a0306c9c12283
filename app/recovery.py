"""The recovery log: a killed editor offers what it had (T08).

After each finished step a worker thread packs what the step left behind and appends it to a log in the user's state
folder, flushed to the disk; the next stroke waits for it, so a kill costs at most the stroke in progress. A save starts
the log anew, a proper close removes it. A log whose lock nobody holds belongs to an editor that died: an `Offer`.
"""

from __future__ import annotations

import contextlib
import hashlib
import logging
import os
import threading
import time
import uuid
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ..level import Level
from ..level.journal import Step
from . import recovery_record as record

log = logging.getLogger(__name__)
SUFFIX = ".recovery"
VERSION = 1
MOST_WAITING = 32  # steps; past it an edit waits for the disk


def default_root() -> Path:
    import platformdirs

    return platformdirs.user_state_path("shorewright", appauthor=False) / "recovery"


class RecoveryLog:
    """The log of one running editor; `failed` says why it stopped, when it did."""

    def __init__(self, root: Path | None = None, path: Path | None = None) -> None:
        self.root = root or default_root()
        self.path = path or self.root / f"{uuid.uuid4().hex}{SUFFIX}"
        self.failed = ""
        self._ready = threading.Condition()
        self._waiting: deque = deque()
        self._writing = False
        self._closed = False
        self._lock = None
        self._file = None
        self._thread: threading.Thread | None = None

    def start(self, level: Level, folder: Path | None) -> None:
        """Begin, or begin anew after a save: from here on, only steps past this state of the level count."""
        head = {"kind": "start", "version": VERSION, "folder": str(folder.resolve()) if folder else None}
        head |= {"fingerprint": fingerprint(folder) if folder else None, "time": time.time()}
        rows = [record.framed(head)]
        if folder is None:
            rows.append(record.encode(record.everything(level, "New level")))
        self.settle()
        try:
            self._take_lock()
            part = self.path.with_suffix(".part")
            with open(part, "wb") as file:
                file.writelines(rows)
                file.flush()
                os.fsync(file.fileno())
            if self._file:
                self._file.close()
            os.replace(part, self.path)
            self._file = open(self.path, "ab")  # noqa: SIM115 - open as long as the editor is
            self.failed = ""
        except OSError as error:
            self._fail(error)

    def resume(self, good_bytes: int) -> None:
        """Go on with the log of a killed editor, past its last whole record."""
        try:
            self._take_lock()
            os.truncate(self.path, good_bytes)
            self._file = open(self.path, "ab")  # noqa: SIM115
        except OSError as error:
            self._fail(error)

    def note(self, level: Level, step: Step) -> None:
        """A step was finished, undone or redone: write down what it left behind."""
        if self._file is None or self.failed:
            return
        change = record.change_of(level, step)
        with self._ready:
            last = self._waiting[-1] if self._waiting else None
            if isinstance(last, record.Change) and last.only_settings and change.only_settings:
                self._waiting[-1] = change  # a slider being dragged
            else:
                self._ready.wait_for(lambda: len(self._waiting) < MOST_WAITING or self.failed)
                self._waiting.append(change)
            self._start_thread()
            self._ready.notify_all()

    def saving(self) -> None:
        """A save begins: should the editor die after it, the folder's change is no surprise."""
        if self._file is None or self.failed:
            return
        with self._ready:
            self._waiting.append({"kind": "saving"})
            self._start_thread()
            self._ready.notify_all()
        self.settle()

    def settle(self, timeout_s: float | None = 10.0) -> bool:
        """Wait until all that was noted is on the disk."""
        with self._ready:
            return self._ready.wait_for(lambda: not (self._waiting or self._writing), timeout_s)

    def close(self, discard: bool = True) -> None:
        """End the log, and remove it unless something in it is still wanted."""
        self.settle()
        with self._ready:
            self._closed = True
            self._ready.notify_all()
        if self._thread:
            self._thread.join(timeout=10)
        if self._file:
            self._file.close()
            self._file = None
        if discard:
            with contextlib.suppress(OSError):
                self.path.unlink()
        if self._lock:
            _release(self._lock)
            self._lock = None

    def _take_lock(self) -> None:
        if self._lock is None:
            self.root.mkdir(parents=True, exist_ok=True)
            self._lock = _try_lock(self.path)
            if self._lock is None:
                raise OSError(0, f"{self.path.name} is in use")

    def _start_thread(self) -> None:
        if self._thread is None:
            self._thread = threading.Thread(target=self._loop, name="recovery", daemon=True)
            self._thread.start()

    def _loop(self) -> None:
        while True:
            with self._ready:
                self._ready.wait_for(lambda: self._closed or self._waiting)
                if not self._waiting:
                    return
                item, self._writing = self._waiting.popleft(), True
            try:
                self._file.write(record.framed(item) if isinstance(item, dict) else record.encode(item))
                self._file.flush()
                os.fsync(self._file.fileno())
            except (OSError, ValueError) as error:
                self._fail(error)
            with self._ready:
                self._writing = False
                self._ready.notify_all()

    def _fail(self, error: Exception) -> None:
        self.failed = f"the recovery log stopped: {getattr(error, 'strerror', None) or error}"
        log.warning(self.failed)
        with self._ready:
            self._waiting.clear()
            self._ready.notify_all()


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
            rows = [row for _, *row in rows_of(file) if row[0]["kind"] == "step"]
        return record.fold([record.decode(*row) for row in rows])

    def discard(self) -> None:
        """Forget it; nothing happens when another editor took it up meanwhile."""
        lock = _try_lock(self.path)
        if lock is not None:
            with contextlib.suppress(OSError):
                self.path.unlink()
            _release(lock)


def offers(root: Path | None = None) -> list[Offer]:
    """What killed editors left behind, newest first; logs that hold nothing are removed on the way."""
    found = []
    for path in sorted((root or default_root()).glob(f"*{SUFFIX}")):
        lock = _try_lock(path)
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
            _release(lock)
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
                labels.append(header["label"])
    if head.get("kind") != "start" or head["version"] != VERSION:
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


def _try_lock(path: Path):
    from filelock import FileLock, Timeout

    lock = FileLock(path.with_suffix(".lock"))
    try:
        lock.acquire(timeout=0)
    except (Timeout, OSError):
        return None
    return lock


def _release(lock) -> None:
    with contextlib.suppress(OSError):
        os.unlink(lock.lock_file)  # while it is held: nobody waits for it
    lock.release()
