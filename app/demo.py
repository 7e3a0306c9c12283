"""What the program does where there is no display: sculpt the cove with a recorded session, draw, export, check.

python -m shorewright.app.demo [OUT]
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from ..level import BadInput, Level
from .script import load
from .session import Session

SAMPLES = Path(__file__).parents[1] / "sample_levels"
CAMERAS = ("play", "beach", "survey")
TARGETS = ("raw", "unreal", "unity", "godot")
SHOWN = ("height", "mesh", "flow", "normals", "foam", "river", "shore")  # maps: all of them take a minute
SIZE = (1280, 720)


def run_demo(out_dir: Path, size: tuple[int, int] = SIZE, quality: str = "medium") -> int:
    """Write pictures before and after, the sculpted level and its exports into a folder, and print their paths.

    Returns 0, or 1 when a check of what was written finds something. BadInput outside a checkout.
    """
    out_dir.mkdir(parents=True, exist_ok=True)
    level_path = out_dir / "cove.shore"
    _copy(SAMPLES / "cove.shore", level_path)
    script = load(SAMPLES / "session.json")
    with Session.open(level_path) as session:
        at = next(action.t for action in script.actions if action.do == "time")
        _draw(session.level, out_dir, "before", at, size, quality)
        session.run(script, "session.json")
        session.save()
        _say(level_path)
        _draw(session.level, out_dir, "after", session.clock.time_s, size, quality)
        findings = _export(session.level, out_dir)
    for finding in findings:
        sys.stdout.write(f"{finding}\n")
    return 1 if findings else 0


def _copy(source: Path, target: Path) -> None:
    """A fresh copy of a sample level; what an earlier run left there goes."""
    if not (source / "level.json").is_file():
        raise BadInput(f"{source} is missing: the sample levels come with a checkout of Shorewright")
    if target.exists():
        if not (target / "level.json").is_file():
            raise BadInput(f"{target} is there already and is no level: choose another folder")
        shutil.rmtree(target)
    shutil.copytree(source, target, ignore=shutil.ignore_patterns(".*"))


def _draw(level: Level, out_dir: Path, word: str, time_s: float, size, quality: str) -> None:
    from ..io.images import write_image
    from ..renderer import render

    for camera in CAMERAS:
        picture = render(level, camera, size, time_s, quality=quality)
        _say(write_image(out_dir / f"{word}_{camera}.png", picture))


def _export(level: Level, out_dir: Path) -> list[str]:
    """Write every target and check it; returns what the checks found."""
    from ..io import EXPORTERS, check, export

    findings = []
    for target in TARGETS:
        folder = out_dir / f"cove_{target}"
        maps = [name for name, _ in EXPORTERS[target].maps if name in SHOWN]
        for path in export(level, target, folder, maps, name="cove"):
            _say(path)
        findings += check(folder)
    return findings


def _say(path: Path) -> None:
    """A path on a line of its own, never wrapped."""
    sys.stdout.write(f"{path}\n")
    sys.stdout.flush()


def main(argv: list[str]) -> int:
    """Run it from the shell; bad input is a sentence and exit code 2."""
    try:
        return run_demo(Path(argv[0] if argv else "out"))
    except BadInput as error:
        sys.stderr.write(f"shorewright: {error}\n")
        return 2


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
