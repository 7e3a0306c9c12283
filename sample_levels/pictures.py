"""`make pictures`: the pictures of README and docs, drawn by the tool from the sample levels."""

from __future__ import annotations

import contextlib
import shutil
import sys
import tempfile
from io import StringIO
from pathlib import Path

ROOT = Path(__file__).parents[1]
PICTURES = ROOT / "docs" / "pictures"
EVENING = {
    "light.sun_azimuth_deg": 255.0,
    "light.sun_elevation_deg": 12.0,
    "light.exposure_ev": 12.9,
    "shore.height_m": 1.4,
}

# name, level, camera (a name, or x, y, z, yaw, pitch), view, time, settings
SHOTS = (
    ("cove", "cove", "612,420,2.4,113,0", "final", 14.3, EVENING),
    ("cove-play", "cove", "play", "final", 14.0, {}),
    ("cove-beach", "cove", "beach", "final", 14.0, {}),
    ("cove-survey", "cove", "survey", "final", 14.0, {}),
    ("cove-against-light", "cove", "560,432,5,250,-5", "final", 14.3, EVENING),
    ("cove-sculpted", "cove+session", "play", "final", 14.0, {}),
    ("cove-lines", "cove", "play", "wave_line", 14.0, {}),
    ("cove-walkable", "cove", "survey", "walkable", 14.0, {}),
    ("island-survey", "island", "survey", "final", 14.0, {}),
    ("island-play", "island", "play", "final", 14.0, {}),
)

# level: a sheet of its cameras under every environment (L08)
SHEETS = ("cove", "island", "rock")
ROCK = ROOT.parent / "shared" / "data" / "coasts" / "pyramidrock_hi.celeris.txt"
ROCK_FLAGS = ("--cell-m", "2x1", "--rows", "south-first")


def level_of(name: str, folder: Path) -> Path:
    """A sample level; `NAME+session` is a copy in `folder` sculpted by the recorded session."""
    from shorewright.app.cli import main as shorewright

    name, _, session = name.partition("+")
    source = ROOT / "sample_levels" / f"{name}.shore"
    if not session:
        return source
    copy = folder / f"{name}-{session}.shore"
    if not copy.exists():
        shutil.copytree(source, copy)
        if shorewright(["stroke", str(copy), str(ROOT / "sample_levels" / f"{session}.json")]):
            raise SystemExit(f"{session}.json does not run on {name}")
    return copy


def rock(folder: Path) -> Path | None:
    """Pyramid Rock, Oahu, imported as the README does; None, and a line that says so, where the file isn't there."""
    from shorewright.app.cli import main as shorewright

    if not ROCK.is_file():
        sys.stdout.write(f"no sheet of Pyramid Rock: {ROCK} is not there\n")
        return None
    level = folder / "rock.shore"
    with contextlib.redirect_stdout(StringIO()):  # pictures only
        code = shorewright(["new", str(level), "--from", str(ROCK), *ROCK_FLAGS])
    if code:
        raise SystemExit(f"{ROCK} cannot be imported")
    return level


def draw_sheets(folder: Path) -> int:
    """A contact sheet of every level of SHEETS into docs/pictures."""
    from shorewright.app.cli import main as shorewright

    for name in SHEETS:
        level = rock(folder) if name == "rock" else level_of(name, folder)
        if level is not None:
            code = shorewright(
                ["sheet", str(level), "-o", str(PICTURES / f"sheet-{name}.jpg"), "--cameras", "play,beach,survey",
                 "--size", "320x180", "--time", "14", "--samples", "4"]
            )  # fmt: skip
            if code:
                return code
    return 0


def main() -> int:
    """Draw every shot and sheet into docs/pictures and print the path of each, one a line."""
    from shorewright.app.cli import main as shorewright

    PICTURES.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        for name, level, camera, view, time_s, settings in SHOTS:
            sets = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
            code = shorewright(
                ["render", str(level_of(level, Path(folder))), "-o", str(PICTURES / f"{name}.jpg"), "--camera", camera,
                 "--view", view, "--time", str(time_s), "--size", "1280x720", "--samples", "4", *sets]
            )  # fmt: skip
            if code:
                return code
        return draw_sheets(Path(folder))


if __name__ == "__main__":
    sys.exit(main())
