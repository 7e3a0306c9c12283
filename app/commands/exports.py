"""`export` and `check`: files for engines, and whether they hold what they promise."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from .common import LevelPath, progress, put, put_notes, words

STEPS = 1000  # of a whole export, for the bar


def export(
    level: LevelPath,
    *,
    target: Annotated[str, Parameter(help="unreal, unity, godot, godot-hterrain, godot-project or raw.")],
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="Folder to write; new, empty or an older export.")],
    only: Annotated[
        list[str] | None, Parameter(negative="", help="Maps to write, by comma, or maps, meshes, data; all without it.")
    ] = None,
    resample: Annotated[
        bool, Parameter(negative="", help="Bring the longer side to a size the engine takes; the error is told.")
    ] = False,
    tile: Annotated[int | None, Parameter(help="Samples a side of each height map; tiles share their edges.")] = None,
) -> int:
    """Write a level as files an engine reads.

    Prints their paths; the manifest comes last. Files that would come out the same again are kept.
    """
    from ...io import export as run
    from ...io import read_level

    notes: list[str] = []
    found = read_level(level, notes)
    put_notes(notes)
    with progress("export") as bar:
        paths = run(
            found,
            target,
            output,
            words(only),
            level.resolve().name,
            resample=resample,
            tile=tile,
            progress=lambda share, sentence: bar(round(share * STEPS), STEPS, sentence),
        )
    for path in paths:
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
