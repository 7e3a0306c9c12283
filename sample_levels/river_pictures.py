"""What docs/rivers.md shows: a river from source to sea, layer by layer, made in steps, foam that is cut and grows."""

from __future__ import annotations

import contextlib
import json
import sys
from io import StringIO
from pathlib import Path

from pictures import LAYER, PICTURES, SMALL, Shot
from shorewright.renderer import VIEWS

CREEK = "392,404,24,22,-20"
RAPIDS = "222,495,18.6,229,-16"
OXBOW = "160,214,13,50,-22"
COURSE = ("survey", "coast", "spring", "fall", "lake", "rapids", "oxbow", "mouth", "play", "beach")
# The talk's break-down of one river, in its order; a view that isn't built is told and left out
BREAKDOWN = (
    "river_raw_flow", "river_curl", "river_flow_sum", "river_stagnant", "river_turbulent", "river_masked", "flow_speed",
    "river_normal_foam", "normal", "final",
)  # fmt: skip
STRIP_S = (6.0, 12.0, 24.0, 48.0)
RIVERS = (
    *(Shot(f"rivers/{camera}", "delta", camera, size=SMALL) for camera in COURSE),
    *(Shot(f"rivers/{view}", "delta", RAPIDS, view=view, size=LAYER) for view in BREAKDOWN if view in VIEWS),
    *(
        Shot(f"rivers/{name}", level, CREEK, size=LAYER)
        for name, level in (("ground", "cove"), ("placed", "cove+creek"), ("carved", "cove+creek_carved"))
    ),
    *(
        Shot(f"rivers/cut-{n}", "delta+wade", OXBOW, time_s, size=LAYER, settings={"time.warm_up_s": 60.0})
        for n, time_s in enumerate(STRIP_S, 1)
    ),
)
# Points that no river can run through: east, north, width, level, speed
WRONG = {
    "one point": [(0, 0, 6, 2, 1)],
    "no width": [(0, 0, 6, 2, 1), (40, 0, 0, 1, 1)],
    "uphill": [(0, 0, 6, 2, 1), (40, 0, 6, 3.5, 1)],
    "one place": [(0, 0, 6, 2, 1), (0, 0, 6, 1, 1)],
    "a loop": [(0, 0, 6, 3, 1), (60, 0, 6, 2, 1), (60, 50, 6, 2, 1), (20, -30, 6, 1, 1)],
    "too fast": [(0, 0, 6, 2, 99), (40, 0, 6, 1, 1)],
}


def tell_wrong(level: Path, folder: Path) -> None:
    """What the command line says to each of WRONG, into docs/pictures/rivers/wrong.txt."""
    from shorewright.app.cli import main as shorewright

    said = []
    for name, points in WRONG.items():
        script, answer = folder / "wrong.json", StringIO()
        thing = {"kind": "river", "id": "wrong", "points": points}
        script.write_text(json.dumps({"version": 1, "actions": [{"do": "place", "object": thing}]}), "utf-8")
        with contextlib.redirect_stderr(answer):
            code = shorewright(["stroke", str(level), str(script)])
        if code != 2:
            raise SystemExit(f"a river with {name} was taken")
        said.append(f"{name}: {answer.getvalue().strip().replace(str(folder), '').lstrip('/')}\n")
    (PICTURES / "rivers").mkdir(parents=True, exist_ok=True)
    (PICTURES / "rivers" / "wrong.txt").write_text("".join(said), "utf-8")


def missing() -> list[str]:
    """Views of the break-down that this build hasn't; also told."""
    names = [view for view in BREAKDOWN if view not in VIEWS]
    if names:
        sys.stdout.write(f"no picture of {', '.join(names)}: no such view\n")
    return names
