"""`export` and `check`: files for engines, and whether they hold what they promise."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from ...level.errors import BadInput
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

    names = words(only)
    if only is not None and names is None:
        raise BadInput("--only names no map: leave it out to export all of them")
    notes: list[str] = []
    found = read_level(level, notes)
    put_notes(notes)
    with progress("export") as bar:
        paths = run(
            found,
            target,
            output,
            names,
            level.resolve().name,
            resample=resample,
            tile=tile,
            progress=lambda share, sentence: bar(round(share * STEPS), STEPS, sentence),
        )
    for path in paths:
        put(str(path))
    if names:
        put_notes(_nothing_for(level.resolve().stem, target, names, paths[-1]))
    return 0


def _nothing_for(name: str, target: str, names: list[str], manifest: Path) -> list[str]:
    """A line on the maps that were asked for by name and that the level has nothing of."""
    from ...io import EXPORTERS

    empty = sorted(EXPORTERS[target].choose(names) & json.loads(manifest.read_text("utf-8"))["empty"].keys())
    return [f"{name} has nothing for: {', '.join(empty)}"] if empty else []


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
