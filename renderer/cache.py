"""Arrays that take long to make, kept on disk between starts, keyed by the code that makes them.

The folder is the user's cache folder, or what SHOREWRIGHT_CACHE names. Nothing in it is needed: a file that is missing,
damaged or of other code is made anew, and a folder that can't be written costs only the time.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import logging
import os
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

log = logging.getLogger(__name__)
VARIABLE = "SHOREWRIGHT_CACHE"
KEPT = 12  # newest files of one name: one for each value of what it depends on, and those of older versions
_DIGEST = hashlib.sha256().digest_size


def folder() -> Path:
    """Where the files are."""
    if os.environ.get(VARIABLE):
        return Path(os.environ[VARIABLE])
    import platformdirs

    return platformdirs.user_cache_path("shorewright", appauthor=False) / "made"


def cached(name: str, make: Callable[[], np.ndarray], code: str, *arguments: object) -> np.ndarray:
    """What `make()` returns, from disk when the same `code` (a module's file) made it of the same arguments before."""
    key = hashlib.sha256(Path(code).read_bytes())
    key.update(repr((np.__version__, arguments)).encode())
    path = folder() / f"{name}-{key.hexdigest()[:20]}.npy"
    found = _load(path)
    if found is None:
        found = make()
        _save(path, found)
        _prune(path.parent, name)
    return found


def _load(path: Path) -> np.ndarray | None:
    """The array of a file; None when it is missing or isn't what was written."""
    try:
        data = path.read_bytes()
        if hashlib.sha256(data[_DIGEST:]).digest() != data[:_DIGEST]:
            raise ValueError("its bytes are not those that were written")
        return np.load(io.BytesIO(data[_DIGEST:]), allow_pickle=False)
    except FileNotFoundError:
        return None
    except (OSError, ValueError, EOFError) as error:
        log.info("%s is made anew: %s", path.name, error)
        return None


def _save(path: Path, array: np.ndarray) -> None:
    """Write beside and rename, so that no one ever reads half a file."""
    buffer = io.BytesIO()
    np.save(buffer, array, allow_pickle=False)
    data, beside = buffer.getvalue(), None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, beside = tempfile.mkstemp(prefix=path.stem, suffix=".part", dir=path.parent)
        with os.fdopen(handle, "wb") as file:
            file.write(hashlib.sha256(data).digest() + data)
        os.replace(beside, path)
    except OSError as error:
        log.info("%s is not kept: %s", path.name, error)
        if beside is not None:
            with contextlib.suppress(OSError):
                os.unlink(beside)


def _prune(where: Path, name: str) -> None:
    """Drop all but the newest files of a name."""
    with contextlib.suppress(OSError):
        files = sorted(where.glob(f"{name}-*.npy"), key=lambda path: path.stat().st_mtime_ns)
        for path in files[:-KEPT]:
            path.unlink(missing_ok=True)
