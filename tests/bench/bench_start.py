"""How fast a table answers: `shorewright brushes` against `python -c "import numpy"`, both warm, best of several."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

NAMES = ("start: shorewright brushes",)
ROUNDS = 7


def run() -> list[dict]:
    """One row; the ratio of best times."""
    script = Path(sys.executable).with_name("shorewright")
    ours = [str(script)] if script.exists() else [sys.executable, "-m", "shorewright.app.cli"]
    numpy_s, brushes_s = [], []
    for _ in range(ROUNDS):  # in turns, so that another program's load falls on both
        numpy_s.append(_seconds([sys.executable, "-c", "import numpy"]))
        brushes_s.append(_seconds([*ours, "brushes"]))
    base, best = min(numpy_s), min(brushes_s)
    note = f"{best * 1000:.0f} ms against {base * 1000:.0f} ms for importing numpy"
    return [{"name": NAMES[0], "ratio": round(best / base, 3), "limit": 5.0, "note": note}]


def _seconds(command: list[str]) -> float:
    start = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - start
