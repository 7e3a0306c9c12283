"""`make pictures`: the pictures of README and docs, drawn by the tool from the sample levels."""

from __future__ import annotations

import shutil
import sys
import tempfile
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


def main() -> int:
    """Draw every shot into docs/pictures and print the path of each, one a line."""
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
    return 0


if __name__ == "__main__":
    sys.exit(main())
