"""Where undo steps past the byte budget go: a folder of files that dies with the editor (T08).

The level's journal knows only `put`, `get`, `drop`. When the disk refuses, the bytes stay in memory: over budget is
better than lost. Folders of editors that were killed are swept when the next one starts.
"""

from __future__ import annotations

import contextlib
import logging
import shutil
import uuid
from pathlib import Path

log = logging.getLogger(__name__)


class FileStore:
    """Bytes by key under a folder of its own in `root`; `close` removes it."""

    def __init__(self, root: Path | None = None) -> None:
        self.root = root or default_root()
        self.folder: Path | None = None
        self._lock = None
        self._kept: dict[str, bytes] = {}

    def put(self, key: str, data: bytes) -> None:
        """Keep bytes under a key (letters and digits)."""
        try:
            self._open()
            path = self.folder / key
            path.write_bytes(data)
        except OSError as error:
            log.warning("undo stays in memory, the disk refused it: %s", error)
            self._kept[key] = data

    def get(self, key: str) -> bytes:
        return self._kept[key] if key in self._kept else (self.folder / key).read_bytes()

    def drop(self, key: str) -> None:
        if self._kept.pop(key, None) is None and self.folder:
            with contextlib.suppress(OSError):
                (self.folder / key).unlink()

    def close(self) -> None:
        """Forget everything."""
        self._kept.clear()
        if self.folder:
            shutil.rmtree(self.folder, ignore_errors=True)
            self._lock.release()
            self.folder = self._lock = None

    def _open(self) -> None:
        if self.folder is None:
            from filelock import FileLock

            sweep(self.root)
            folder = self.root / f"undo-{uuid.uuid4().hex}"
            folder.mkdir(parents=True)
            self._lock = FileLock(folder / ".lock")
            self._lock.acquire(timeout=0)
            self.folder = folder


def default_root() -> Path:
    import platformdirs

    return platformdirs.user_cache_path("shorewright", appauthor=False)


def sweep(root: Path) -> None:
    """Remove the folders whose editor is gone."""
    from filelock import FileLock, Timeout

    for folder in root.glob("undo-*"):
        lock = FileLock(folder / ".lock")
        try:
            lock.acquire(timeout=0)
        except (Timeout, OSError):
            continue
        shutil.rmtree(folder, ignore_errors=True)
        lock.release()
