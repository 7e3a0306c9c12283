"""Old level descriptions made new: one function a version, applied in turn to the raw JSON before it is checked."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ..level import BadInput
from ..level.water_optics import PURE_ABSORPTION

VERSION = 2


def _added_absorption(raw: dict) -> dict:
    """1 to 2: `water.absorb_…` were totals, now they are added to what pure water takes.

    Water keeps its colour; what was clearer than pure water becomes pure.
    """
    settings = raw.get("settings")
    water = settings.get("water") if isinstance(settings, dict) else None
    if not isinstance(water, dict):
        return raw
    water = {**water, "plankton": 0.0, "silt": 0.0}
    for name, pure in zip(("absorb_red", "absorb_green", "absorb_blue"), PURE_ABSORPTION.tolist()):
        if isinstance(water.get(name), int | float):
            water[name] = max(water[name] - pure, 0.0)
    return {**raw, "settings": {**settings, "water": water}}


MIGRATIONS: dict[int, Callable[[dict], dict]] = {1: _added_absorption}  # MIGRATIONS[n] turns version n into n + 1


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


def migrate_settings(settings: dict, version: int) -> dict:
    """A level's settings alone, in the current version: recovery logs hold them."""
    return migrate({"shorewright_level": version, "settings": settings}, Path("settings"))["settings"]
