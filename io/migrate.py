"""Old level descriptions made new: one function a version, applied in turn to the raw JSON before it is checked."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ..level import BadInput

VERSION = 1
MIGRATIONS: dict[int, Callable[[dict], dict]] = {}  # MIGRATIONS[n] turns version n into n + 1


def migrate(raw: dict, path: Path) -> dict:
    """`raw` in the current version; BadInput when it is newer, or older than any migration reaches."""
    version = raw.get("shorewright_level")
    if not isinstance(version, int) or isinstance(version, bool) or version < 1:
        raise BadInput(f"{path} has the version {version!r}, which is not a number from 1 to {VERSION}")
    if version > VERSION:
        raise BadInput(
            f"{path} was saved by a newer Shorewright (level version {version}, this one reads up to {VERSION}): update"
        )
    while version < VERSION:
        if version not in MIGRATIONS:
            raise BadInput(f"{path} has level version {version}, which this Shorewright can no longer read")
        raw = MIGRATIONS[version](dict(raw))
        version += 1
        raw["shorewright_level"] = version
    return raw
