"""`lint`: faults of the current, painted and exported, with their places (T02)."""

from __future__ import annotations

from dataclasses import asdict
from typing import Annotated

from cyclopts import Parameter

from .common import LevelPath, finite, put, put_json, put_notes, put_table


def lint(
    level: LevelPath,
    *,
    range_mps: Annotated[
        float | None,
        Parameter(name="--range", help="Metres a second that an 8-bit map holds either way; else as it is exported."),
    ] = None,
    as_json: Annotated[bool, Parameter(name="--json", negative="", help="A list of objects.")] = False,
) -> int:
    """List faults of a level's current: drift, paint that runs into land or diverges, speeds the export clips.

    Each with its place in metres, its number and how many cells share it. Exit code 1 when there are any.
    """
    from ...io import read_level
    from ...level.flow_lint import flow_faults

    if range_mps is not None:
        finite(range_mps, "--range", 1e-3, 1000)
    notes: list[str] = []
    faults = flow_faults(read_level(level, notes), range_mps)
    put_notes(notes)
    if as_json:
        put_json([asdict(fault) for fault in faults])
    elif faults:
        put_table([(f.kind, f"{f.x:.1f}, {f.y:.1f} m", f"{f.cells} cells", f.sentence) for f in faults])
    else:
        put("the current has no faults")
    return 1 if faults else 0
