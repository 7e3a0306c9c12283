"""events.json: when crests come to the probes of a level, for games that time things by them (T06)."""

from __future__ import annotations

import contextlib
import json
import os
from pathlib import Path

from ..level.errors import BadInput


def write_events(path: Path | str, rows: list[dict]) -> Path:
    """Write rows of `level.probes.events`, whole or not at all; BadInput where that is impossible."""
    path = Path(path)
    if path.suffix.lower() != ".json":
        raise BadInput(f"{path.name} is no name for events: end it in .json")
    part = path.with_name(f".{path.name}.part")
    try:
        with part.open("w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1, ensure_ascii=False)
            file.write("\n")
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    except OSError as error:
        with contextlib.suppress(OSError):
            part.unlink(missing_ok=True)
        raise BadInput(f"{path} cannot be written: {error.strerror or error}") from None
    return path
