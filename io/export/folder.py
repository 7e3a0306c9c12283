"""The folder an export lands in: written beside it under a temporary name, then moved there whole.

A folder is only ever replaced when everything in it was written by an earlier export of the same level to the same
target, as its manifest says; anything else in it means that the person chose the wrong folder.
"""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ...level import BadInput
from .manifest import inside, load

JUNK = frozenset({".DS_Store", "Thumbs.db", "desktop.ini"})  # file browsers leave these everywhere


@contextmanager
def staged(out: Path, manifest_name: str, target: str) -> Iterator[Path]:
    """A new empty folder that takes the place of `out` when the block ends well, and vanishes when it doesn't.

    BadInput when `out` holds other things or the disk refuses.
    """
    out = out.resolve()
    refuse_foreign(out, manifest_name, target)
    part = out.with_name(f".{out.name}.part-{os.getpid()}-{secrets.token_hex(4)}")
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        part.mkdir()
        yield part
        refuse_foreign(out, manifest_name, target)  # a long export: somebody may have put something there since
        _swap(part, out)
    except OSError as error:
        raise BadInput(f"cannot write the export to {out}: {error.strerror or error}") from None
    finally:
        shutil.rmtree(part, ignore_errors=True)


def refuse_foreign(out: Path, manifest_name: str, target: str) -> None:
    """BadInput unless `out` is missing, empty, or holds only what an earlier export of this kind wrote."""
    if not out.exists():
        return
    if not out.is_dir():
        raise BadInput(f"{out} is a file; name a folder for the export")
    try:
        found = {entry.name for entry in out.iterdir()} - JUNK
    except OSError as error:
        raise BadInput(f"cannot look into {out}: {error.strerror or error}") from None
    foreign = sorted(found - _owned(out / manifest_name, target)) if found else []
    if foreign:
        shown = ", ".join(foreign[:3]) + (f" and {len(foreign) - 3} more" if len(foreign) > 3 else "")
        raise BadInput(f"{out} holds things this export did not write ({shown}); name a new or empty folder")


def _owned(manifest: Path, target: str) -> set[str]:
    """Names that the manifest of an earlier export of this level to this target lists, and its own; else none."""
    if not manifest.is_file():
        return set()
    data, _ = load(manifest)
    if not isinstance(data, dict) or data.get("target") != target or not isinstance(data.get("files"), list):
        return set()
    names = {file.get("name") for file in data["files"] if isinstance(file, dict)}
    return {name for name in names if isinstance(name, str) and inside(name)} | {manifest.name}


def _swap(part: Path, out: Path) -> None:
    """Put `part` where `out` is. Two renames: killed between them, the old export stands beside, whole, with `.old`."""
    if not out.exists():
        part.rename(out)
        return
    old = out.with_name(f".{out.name}.old-{part.name.rpartition('-')[2]}")
    shutil.copymode(out, part)
    out.rename(old)
    try:
        part.rename(out)
    except OSError:
        old.rename(out)
        raise
    shutil.rmtree(old, ignore_errors=True)
