"""`make pictures`: the pictures of README and docs, drawn by the tool from the sample levels."""

from __future__ import annotations

import contextlib
import shutil
import sys
import tempfile
from dataclasses import dataclass, field
from io import StringIO
from pathlib import Path

ROOT = Path(__file__).parents[1]
PICTURES = ROOT / "docs" / "pictures"


@dataclass(frozen=True)
class Shot:
    """A picture: `camera` a name, or x, y, z, yaw, pitch."""

    name: str
    level: str
    camera: str
    time_s: float = 14.0
    environment: str = ""
    view: str = "final"
    size: str = "1280x720"
    settings: dict = field(default_factory=dict)
    fronts: str = ""


EVENING = {
    "light.sun_azimuth_deg": 255.0,
    "light.sun_elevation_deg": 12.0,
    "light.exposure_ev": 12.9,
    "shore.height_m": 1.4,
}
SHOTS = (
    Shot("cove", "cove", "612,420,2.4,113,0", 14.3, settings=EVENING),
    Shot("cove-play", "cove", "play"),
    Shot("cove-beach", "cove", "beach"),
    Shot("cove-plunge", "cove", "306,421,1.5,250,-3", 10.2),
    Shot("cove-survey", "cove", "survey"),
    Shot("cove-against-light", "cove", "560,432,5,250,-5", 14.3, settings=EVENING),
    Shot("cove-sculpted", "cove+session", "play"),
    Shot("cove-lines", "cove", "play", view="wave_line"),
    Shot("cove-walkable", "cove", "survey", view="walkable"),
    Shot(
        "cove-boat",
        "cove",
        "560,385,6,0,-25",
        20.0,
        settings={"sea.swell_m": 0.06, "sea.chop_m": 0.015, "shore.height_m": 0.15, "sea.wind_mps": 1.2},
    ),
    Shot("island-survey", "island", "survey"),
    Shot("island-play", "island", "play"),
)

# What docs/light.md shows of each row; the pictures beside them are of the version before
SMALL = "640x360"
ROWS = (
    Shot("light/L01", "cove", "survey", 14.0, "moonlit", size=SMALL),
    Shot("light/L02", "cove", "612,420,2.4,113,0", 14.3, "golden_hour", size=SMALL),
    Shot("light/L03", "cove", "740,385,4.5,110,8", 17.0, "noon", size=SMALL),
    Shot("light/L04", "cove", "560,300,6,200,-2", 17.0, "noon", size=SMALL),
    Shot("light/L05", "cove", "560,505,7.9,80,-10", 17.0, "noon", size=SMALL),
    Shot("light/L06", "cove", "640,412,3.2,129,-12", 18.0, "noon", size=SMALL),
    Shot("light/L07", "cove", "560,432,5,250,-5", 14.3, "golden_hour", size=SMALL),
    Shot("light/L08", "island", "beach", 14.0, "noon", "lookdev", SMALL),
    Shot("light/L09", "cove", "620,470,7.2,20,-15", 15.0, "noon", size=SMALL),
    Shot("light/H10", "cove", "play", 14.0, "noon", "beach_slice", SMALL, {"water.on": False}),
    Shot("light/H11", "cove", "survey", 14.0, "noon", "shore_distance", SMALL),
)

# docs/sea.md, one picture a layer: the same shot, view by view
SHORE = "610,345,30,30,-32"
LAYERS = (
    "final",
    "wave_line",
    "wave_back",
    "crest_fall",
    "shore_lift",
    "gerstner_weight",
    "phase_noise",
    "plate_a",
    "plate_b",
    "surface_eye_depth",
    "caustics",
    "flow",
    "foam",
    "foam_shore",
    "foam_height",
    "foam_shadow",
    "roughness",
    "normal",
    "beach_slide",
    "ripples",
    "foam_mask",
)
LAYER = "480x270"
STILL = {"sea.swell_m": 0.08, "sea.chop_m": 0.02, "shore.height_m": 0.25, "sea.wind_mps": 1.5}
SEA = (
    *(Shot(f"sea/{view}", "cove", SHORE, 14.0, "noon", view, LAYER) for view in LAYERS),
    Shot("sea/shore_phase", "cove", "play", 14.0, "noon", "shore_phase", LAYER),
    Shot("sea/patches", "cove", "survey", 14.0, "noon", "patches", LAYER),
    Shot("sea/triangle_area", "cove", SHORE, 14.0, "noon", "triangle_area", LAYER, {"sea.mesh": "tessellated"}),
    Shot("sea/reflections", "cove", "620,365,2.5,113,0", 14.0, "golden_hour", "reflections", LAYER, STILL),
    Shot("sea/mirrored", "cove", "620,365,2.5,113,0", 14.0, "golden_hour", "final", LAYER, STILL),
    Shot("sea/props", "cove", "549,398,2.6,125,-14", 24.75, "noon", "props", LAYER),
    Shot("sea/boat", "cove", "549,398,2.6,125,-14", 24.75, size=SMALL),
)

# Three coasts in three moods. Environments set light and air; what the sea does in them is said here.
CALM = {
    "light.sun_azimuth_deg": 95.0, "light.sun_elevation_deg": 14.0, "light.exposure_ev": 12.9, "sea.wind_mps": 2.0,
    "sea.swell_m": 0.12, "sea.chop_m": 0.025, "shore.height_m": 0.45, "shore.interval_s": 8.0, "shore.runup": 0.08,
    "foam.shore": 0.2,
}  # fmt: skip
STORM = {
    "sea.swell_m": 1.7, "sea.swell_length_m": 95.0, "sea.swell_steepness": 0.75, "sea.chop_m": 0.22,
    "sea.chop_length_m": 11.0, "shore.height_m": 2.3, "shore.interval_s": 11.0, "shore.range_m": 8.0,
    "foam.shore": 0.8, "foam.shore_far_m": 70.0, "foam.height": 0.8, "foam.height_low": 0.3, "foam.height_high": 0.8,
    "water.silt": 8.0, "water.plankton": 0.1,
}  # fmt: skip
SUNSET = {"light.sun_azimuth_deg": 262.0, "light.sun_elevation_deg": 5.0, "light.exposure_ev": 12.0}
MOODS = tuple(
    Shot(f"mood/{level}-{mood}", level, camera, 14.3, environment, size=SMALL, settings=settings)
    for level, cameras in {
        "cove": ("560,432,5,250,-5", "590,400,4,130,-3", "560,440,30,262,-18"),
        "island": ("beach", "665,222,3,320,-4", "beach"),
        "rock": ("beach", "beach", "beach"),
    }.items()
    for camera, (mood, environment, settings) in zip(
        cameras, (("calm", "", CALM), ("storm", "storm", STORM), ("sunset", "golden_hour", SUNSET)), strict=True
    )
)

# level: a sheet of its cameras under every environment (L08)
SHEETS = ("cove", "island", "delta", "rock")
ROCK = ROOT.parent / "shared" / "data" / "coasts" / "pyramidrock_hi.celeris.txt"
ROCK_FLAGS = ("--cell-m", "2x1", "--rows", "south-first")


def level_of(name: str, folder: Path) -> Path | None:
    """A sample level, or `rock`; `NAME+session` is a copy in `folder` sculpted by the recorded session."""
    from shorewright.app.cli import main as shorewright

    name, _, session = name.partition("+")
    if name == "rock":
        return rock(folder)
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
        sys.stdout.write(f"no picture of Pyramid Rock: {ROCK} is not there\n")
        return None
    level = folder / "rock.shore"
    if level.exists():
        return level
    with contextlib.redirect_stdout(StringIO()):  # pictures only
        code = shorewright(["new", str(level), "--from", str(ROCK), *ROCK_FLAGS])
    if code:
        raise SystemExit(f"{ROCK} cannot be imported")
    return level


def draw_sheets(folder: Path) -> int:
    """A contact sheet of every level of SHEETS into docs/pictures."""
    from shorewright.app.cli import main as shorewright

    for name in SHEETS:
        level = level_of(name, folder)
        if level is not None:
            code = shorewright(
                ["sheet", str(level), "-o", str(PICTURES / f"sheet-{name}.jpg"), "--cameras", "play,beach,survey",
                 "--size", "320x180", "--time", "14", "--samples", "4"]
            )  # fmt: skip
            if code:
                return code
    return 0


def draw(shot: Shot, folder: Path) -> int:
    """One shot into docs/pictures."""
    from shorewright.app.cli import main as shorewright

    level, path = level_of(shot.level, folder), PICTURES / f"{shot.name}.jpg"
    if level is None:
        return 0
    path.parent.mkdir(parents=True, exist_ok=True)
    sets = [word for key, value in shot.settings.items() for word in ("--set", f"{key}={value}")]
    light = ["--environment", shot.environment] if shot.environment else []
    fronts = ["--fronts", shot.fronts] if shot.fronts else []
    return shorewright(
        ["render", str(level), "-o", str(path), "--camera", shot.camera, "--view", shot.view,
         "--time", str(shot.time_s), "--size", shot.size, "--samples", "4", *light, *fronts, *sets]
    )  # fmt: skip


def draw_maps(maps, folder: Path) -> int:
    """The picture that `shorewright timing` makes of a level, into docs/pictures/timing."""
    from shorewright.app.cli import main as shorewright

    for name, title, flags in maps:
        level = level_of(name, folder)
        if level is None:
            continue
        made = folder / f"timing-{title}"
        code = shorewright(["timing", str(level), "-o", str(made), *flags])
        if code:
            return code
        shutil.copy(made / "timing.png", PICTURES / "timing" / f"map-{title}.png")
    return 0


def main() -> int:
    """Draw every shot and sheet into docs/pictures and print the path of each, one a line; or those named."""
    from cloud_pictures import CLOUDS  # they take Shot from here
    from river_pictures import RIVERS, missing, tell_wrong
    from timing_pictures import MAPS, TIMING

    wanted = sys.argv[1:]  # parts of names; none: all
    with tempfile.TemporaryDirectory() as folder:
        for shot in (*SHOTS, *ROWS, *SEA, *MOODS, *CLOUDS, *TIMING, *RIVERS):
            if wanted and not any(part in shot.name for part in wanted):
                continue
            code = draw(shot, Path(folder))
            if code:
                return code
        if wanted:
            return 0
        missing()
        tell_wrong(ROOT / "sample_levels" / "delta.shore", Path(folder))
        return draw_maps(MAPS, Path(folder)) or draw_sheets(Path(folder))


if __name__ == "__main__":
    sys.exit(main())
