"""`export` and `check`: files for engines, and whether they hold what they promise."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from .common import LevelPath, put, put_notes, words


def export(
    level: LevelPath,
    *,
    target: Annotated[str, Parameter(help="unreal or raw.")],
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="Folder to write; new, empty or an older export.")],
    only: Annotated[list[str] | None, Parameter(negative="", help="Maps to write, by comma; all without it.")] = None,
) -> int:
    """Write a level as files an engine reads.

    Prints their paths; the manifest comes last.
    """
    from ...io import export as run
    from ...io import read_level

    notes: list[str] = []
    found = read_level(level, notes)
    put_notes(notes)
    for path in run(found, target, output, only=words(only), name=level.resolve().name):
        put(str(path))
    return 0


def check(path: Annotated[Path, Parameter(help="The folder of a level or an export.")]) -> int:
    """Check a level or an export, down to every height.

    Hashes, ranges, heights as the engine decodes them; exit code 1 and a list if something is wrong.
    """
    from ...io import check as run

    findings = run(path)
    for finding in findings:
        put(" ".join(finding.split()))
    if not findings:
        put(f"{path}: nothing wrong")
    return 1 if findings else 0
