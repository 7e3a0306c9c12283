"""Make the sample levels from a seed: `python sample_levels/make.py [cove] [island] [delta] [--out DIR]`."""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import boats
import cove
import cove_paint
import delta
import delta_paint
import island
import numpy as np
from shorewright.level import Grid, Level, Settings
from shorewright.level.objects import Camera, Disturbance

HERE = Path(__file__).resolve().parent
SEED = 7
STEP_M = 1 / 1024  # heights are whole multiples of it: the same on every machine, and half the bytes

COVE_CAMERAS = [
    Camera(id="play", x=589, y=449, z=60, yaw_deg=260, pitch_deg=-55, fov_deg=48),
    Camera(id="beach", x=661, y=404, z=2.1, yaw_deg=129, pitch_deg=5, fov_deg=42),
    Camera(id="survey", x=440, y=836, z=300, yaw_deg=174, pitch_deg=-22, fov_deg=50),
]
COVE_SETTINGS = {
    "level.seed": SEED,
    "shore.interval_s": 8.0,
    "shore.plunge": 1.0,
    "shore.height_m": 1.2,
    "shore.variety": 0.6,
    "shore.runup_variety": 0.45,
    "shore.stagger": 0.3,
    "timing.source": "travel_time",
    "river.silt": 4.0,
    "river.humus": 0.1,
    "sea.swell_length_m": 80.0,
    "sea.swell_heading_deg": 12.0,
    "clouds.on": True,
    "weather.coverage": 0.38,
    "weather.type": 0.9,
    "weather.north_m": 4800.0,
    "ground.rock_slope_deg": 40.0,
    "ground.grass_slope_deg": 35.0,
}
ISLAND_CAMERAS = [
    Camera(id="play", x=750, y=238, z=60, yaw_deg=248, pitch_deg=-55, fov_deg=45),
    Camera(id="beach", x=647, y=232, z=2.3, yaw_deg=304, pitch_deg=7, fov_deg=46),
    Camera(id="survey", x=860, y=-140, z=300, yaw_deg=333, pitch_deg=-20.5, fov_deg=46),
]
ISLAND_SETTINGS = {
    "level.seed": SEED + 4,
    "shore.range_m": 4.0,
    "shore.interval_s": 7.0,
    "shore.plunge": 1.0,
    "shore.height_m": 0.9,
    "shore.variety": 0.6,
    "shore.runup_variety": 0.45,
    "shore.stagger": 0.3,
    "sea.swell_heading_deg": 40.0,
    "water.plankton": 0.1,
    "water.silt": 0.3,
    "water.scatter": 0.015,
    "clouds.on": True,
    "weather.coverage": 0.32,
    "weather.type": 1.0,
    "weather.heading_deg": 300.0,
    "weather.east_m": 4800.0,
    "weather.north_m": 2400.0,
    "ground.rock_slope_deg": 54.0,
    "ground.grass_slope_deg": 50.0,
    "ground.sand_top_m": 3.0,
}
DELTA_CAMERAS = [
    Camera(id="play", x=304, y=128, z=58, yaw_deg=306, pitch_deg=-55, fov_deg=48),
    Camera(id="beach", x=238, y=121, z=2.2, yaw_deg=28, pitch_deg=3, fov_deg=50),
    Camera(id="survey", x=470, y=690, z=150, yaw_deg=208, pitch_deg=-20, fov_deg=52),
    Camera(id="coast", x=400, y=-60, z=120, yaw_deg=345, pitch_deg=-18, fov_deg=50),
    Camera(id="spring", x=390, y=588, z=28, yaw_deg=33, pitch_deg=-15, fov_deg=48),
    Camera(id="fall", x=308, y=538, z=23.5, yaw_deg=58, pitch_deg=-11, fov_deg=48),
    Camera(id="lake", x=232, y=485, z=25, yaw_deg=40, pitch_deg=-12, fov_deg=55),
    Camera(id="rapids", x=300, y=338, z=9.6, yaw_deg=297, pitch_deg=-9, fov_deg=45),
    Camera(id="oxbow", x=165, y=205, z=26, yaw_deg=42, pitch_deg=-20, fov_deg=55),
    Camera(id="mouth", x=300, y=196, z=16, yaw_deg=205, pitch_deg=-12, fov_deg=55),
]
DELTA_SETTINGS = {
    "level.seed": SEED + 9,
    "shore.interval_s": 8.0,
    "shore.plunge": 1.0,
    "timing.source": "travel_time",
    "river.silt": 4.0,
    "river.humus": 0.1,
    "shore.height_m": 0.7,
    "shore.range_m": 3.0,
    "shore.variety": 0.6,
    "shore.runup_variety": 0.45,
    "shore.stagger": 0.3,
    "sea.swell_heading_deg": 8.0,
    "light.sun_azimuth_deg": 262.0,
    "light.sun_elevation_deg": 40.0,
    "light.exposure_ev": 13.8,
    "clouds.on": True,
    "weather.coverage": 0.28,
    "weather.north_m": 2500.0,
    "weather.type": 1.0,
    "ground.rock_slope_deg": 40.0,
    "ground.grass_slope_deg": 36.0,
    "ground.sand_top_m": 2.3,
}


def build(base: np.ndarray, settings: dict[str, object], cameras: list[Camera]) -> Level:
    """A level of 1 m cells with heights rounded to STEP_M."""
    rounded = (np.round(base / STEP_M) * STEP_M).astype(np.float32)
    level = Level(Grid(*base.shape), rounded, Settings())
    for path, value in settings.items():
        level.set(path, value)
    for camera in cameras:
        level.put_object(camera.id, camera)
    return level


def make_cove(seed: int = SEED) -> Level:
    """The bay: headland, beach, river mouth, a patch of paint in each layer, disturbances before `play`."""
    ground, maps = cove.height(seed)
    level = build(ground, COVE_SETTINGS, COVE_CAMERAS)
    cove_paint.paint(level, maps, seed + 100)
    pushes = [(0.5, 548, 410, 4.0, 3.5), (2.0, 540, 416, 2.5, 2.0)]
    pushes += [(1.0 + 0.75 * k, 566 - 1.4 * k, 426 - 2.4 * k, 1.6, 1.2) for k in range(8)]  # somebody wades out
    for index, (time_s, x, y, radius_m, strength) in enumerate(pushes):
        name = f"push-{index:02d}"
        level.put_object(name, Disturbance(id=name, x=x, y=y, time_s=time_s, radius_m=radius_m, strength=strength))
    level.put_object("creek", cove_paint.creek())
    boats.place(level)
    return level


def make_island(seed: int = SEED + 4) -> Level:
    """The volcano, its lagoon, reef and spit; only bare rock is painted, every other layer is neutral."""
    ground, maps = island.height(seed)
    level = build(ground, ISLAND_SETTINGS, ISLAND_CAMERAS)
    cove_paint.lay_stone(level, maps["stone"])
    return level


def make_delta(seed: int = SEED + 9) -> Level:
    """Rivers from source to sea: spring, fall, lake, rapids, meanders, an oxbow and two mouths on a beach."""
    ground, maps = delta.height(seed)
    level = build(ground, DELTA_SETTINGS, DELTA_CAMERAS)
    delta_paint.paint(level, maps, seed + 100)
    for thing in [*delta.rivers(), *delta.wave_objects()]:
        level.put_object(thing.id, thing)
    return level


LEVELS = {"cove": make_cove, "island": make_island, "delta": make_delta}


def main() -> None:
    from shorewright.io import write_level

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="cove, island, delta; all when none is named")
    parser.add_argument("--out", type=Path, default=HERE, help="folder that takes the levels")
    arguments = parser.parse_args()
    if unknown := set(arguments.names) - set(LEVELS):
        parser.error(f"no sample level is called {', '.join(sorted(unknown))}; there are: {', '.join(LEVELS)}")
    for name in arguments.names or LEVELS:
        start = time.perf_counter()
        level = LEVELS[name]()
        write_level(level, arguments.out / f"{name}.shore")
        low, high = level.height.min(), level.height.max()
        print(f"{name}.shore: {low:.1f} to {high:.1f} m, {time.perf_counter() - start:.0f} s")


if __name__ == "__main__":
    main()
