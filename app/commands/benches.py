"""`bench`: the measured promises of a checkout, as ratios to something measured in the same run."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from ...level.errors import BadInput
from .common import progress, put, put_json, put_table
from .tables import Json

FOLDER = Path(__file__).parents[2] / "tests" / "bench"
REGRESSION = 1.5  # times the last committed ratio


def bench(
    *names: str,
    as_json: Json = False,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"], help="Write the rows here as JSON.")] = None,
) -> int:
    """Measure what a checkout promises, as ratios.

    All rows of tests/bench, or those with one of NAMES in their file or name; exit code 1 past a limit.
    """
    files = sorted(FOLDER.glob("bench_*.py"))
    if not files:
        raise BadInput("the benches come with a checkout of Shorewright, not with an installed package")
    rows = _measure(files, names)
    if not rows:
        known = ", ".join(path.stem.removeprefix("bench_") for path in files)
        raise BadInput(f"no bench has {' or '.join(names)} in its name; there are: {known}")
    before = _before(output or FOLDER.parents[1] / "bench.json")
    for row in rows:
        row["over"] = row.get("limit") is not None and row["ratio"] > row["limit"]
        row["worse"] = row["name"] in before and row["ratio"] > REGRESSION * before[row["name"]]
    if output:
        output.write_text(json.dumps(rows, indent=1, ensure_ascii=False) + "\n", "utf-8")
    if as_json:
        put_json(rows)
    else:
        put_table([_line(row) for row in rows])
        put("")
        put(f"{sum(row['over'] for row in rows)} of {len(rows)} rows over their limit")
    return 1 if any(row["over"] for row in rows) else 0


def _measure(files: list[Path], names: tuple[str, ...]) -> list[dict]:
    """The rows of all files, or of those that `names` pick by file or row."""
    rows: list[dict] = []
    with progress("Measuring") as tell:
        for number, path in enumerate(files, 1):
            stem = path.stem.removeprefix("bench_")
            whole = not names or any(name in stem for name in names)
            module = _load(path)
            declared = getattr(module, "NAMES", ())  # row names, so that one row can be asked for
            if whole or any(name in row for name in names for row in declared):
                found = module.run()
                rows += [row for row in found if whole or any(name in row["name"] for name in names)]
            tell(number, len(files))
    return rows


def _load(path: Path):
    spec = importlib.util.spec_from_file_location(f"shorewright_bench_{path.stem}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _before(path: Path) -> dict[str, float]:
    try:
        return {row["name"]: row["ratio"] for row in json.loads(path.read_text("utf-8"))}
    except (OSError, ValueError, KeyError, TypeError):
        return {}


def _line(row: dict) -> tuple[str, ...]:
    limit = "" if row.get("limit") is None else f"at most {row['limit']:g}"
    mark = "OVER" if row["over"] else "worse" if row["worse"] else ""
    return row["name"], f"{row['ratio']:.2f}", limit, mark, row.get("note", "")
