"""The recovery log: a killed editor offers what it had (T08).

After each finished step a worker thread packs what the step left behind and appends it to a log in the user's state
folder, flushed to the disk; the next stroke waits for it, so a kill costs at most the stroke in progress. A save starts
the log anew, a proper close removes it. A log that outgrew FOLD_BYTES is folded: crops and resizes hold whole grids.
`recovery_offer.py` reads what a killed editor left.
"""

from __future__ import annotations

import contextlib
import logging
import os
import threading
import time
import uuid
from collections import deque
from pathlib import Path

from ..level import Level
from ..level.journal import Step
from ..level.meshes import names_in_use
from ..level.shots import skies_in_use
from . import recovery_record as record
from .recovery_offer import SUFFIX, VERSION, changes_of, default_root, fingerprint, release, rows_of, try_lock

log = logging.getLogger(__name__)
MOST_WAITING = 32  # steps; past it an edit waits for the disk
FOLD_BYTES = 128 << 20  # a log larger than this is folded into one step


class RecoveryLog:
    """The log of one running editor; `failed` says why it stopped, when it did."""

    def __init__(self, root: Path | None = None, path: Path | None = None) -> None:
        self.root = root or default_root()
        self.path = path or self.root / f"{uuid.uuid4().hex}{SUFFIX}"
        self.failed = ""
        self._held: set[str] = set()  # names of meshes and skies that the folder or the log holds
        self._ready = threading.Condition()
        self._waiting: deque = deque()
        self._writing = False
        self._folding = False  # what is noted is safe meanwhile, so that a stroke needn't wait
        self._fold_at = FOLD_BYTES
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
        self._rest()
        self._held = (names_in_use(level) & level.meshes.keys()) | (skies_in_use(level) & level.skies.keys())
        try:
            self._take_lock()
            self._rewrite(rows)
            self.failed = ""
        except OSError as error:
            self._fail(error)

    def _rewrite(self, rows: list[bytes]) -> None:
        """Put another log in the place of the present one, whole or not at all."""
        part = self.path.with_suffix(".part")
        with open(part, "wb") as file:
            file.writelines(rows)
            file.flush()
            os.fsync(file.fileno())
        if self._file:
            self._file.close()
        os.replace(part, self.path)
        self._file = open(self.path, "ab")  # noqa: SIM115 - open as long as the editor is
        self._fold_at = max(FOLD_BYTES, 2 * self._file.tell())

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
        change = record.change_of(level, step, self._held)
        self._held |= change.meshes.keys() | change.skies.keys()
        with self._ready:
            last = self._waiting[-1] if self._waiting else None
            if isinstance(last, record.Change) and last.outdone_by(change):
                change.meshes, change.skies = last.meshes | change.meshes, last.skies | change.skies
                self._waiting[-1] = change  # a slider or an object being dragged
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

    def _rest(self) -> None:
        """Wait until the worker touches the file no more."""
        with self._ready:
            self._ready.wait_for(lambda: not (self._waiting or self._writing or self._folding))

    def close(self, discard: bool = True) -> None:
        """End the log, and remove it unless something in it is still wanted."""
        self._rest()
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
            release(self._lock)
            self._lock = None

    def _take_lock(self) -> None:
        if self._lock is None:
            self.root.mkdir(parents=True, exist_ok=True)
            self._lock = try_lock(self.path)
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
                size = self._file.tell() if isinstance(item, record.Change) else 0  # the word "saving" has to stay last
            except Exception as error:  # whatever it is, edits must not wait for this thread for ever
                self._fail(error)
                size = 0
            with self._ready:
                self._writing, self._folding = False, size > self._fold_at
                self._ready.notify_all()
            if self._folding:
                self._fold()

    def _fold(self) -> None:
        """Put all steps into one."""
        try:
            with open(self.path, "rb") as file:
                _, head, _ = next(rows_of(file))
                change = record.fold(changes_of(file))
            self._rewrite([record.framed(head), record.encode(change)])
        except Exception as error:
            if self._file.closed:
                self._fail(error)
            else:  # the long log is as good
                log.warning("the recovery log could not be folded: %s", error)
                self._fold_at *= 2
        with self._ready:
            self._folding = False
            self._ready.notify_all()

    def _fail(self, error: Exception) -> None:
        self.failed = f"the recovery log stopped: {getattr(error, 'strerror', None) or error}"
        log.warning(self.failed)
        with self._ready:
            self._waiting.clear()
            self._ready.notify_all()
