"""What is at a point of the level, for the status bar and the texts beside the brush."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..level import Level
from ..level.pick import ground_at
from ..level.shore import shore_map
from ..level.timing import speed_on
from ..level.weather_keys import level_at


@dataclass(frozen=True)
class Probe:
    """Metres and degrees; `front_mps` is the ground speed of shore waves there, None where they don't run (D31)."""

    x: float
    y: float
    ground_m: float
    depth_m: float
    slope_deg: float
    front_mps: float | None


def probe(level: Level, x: float, y: float, time_s: float = 0.0) -> Probe:
    """What is at a world point at a time; outside the level, what is at its border."""
    level = level_at(level, time_s)
    cell = level.grid.cell_m
    west, east, south, north, here = (
        float(v) for v in ground_at(level, [x - cell, x + cell, x, x, x], [y, y, y - cell, y + cell, y])
    )
    slope = math.hypot(east - west, north - south) / (2 * cell)
    return Probe(x, y, here, level.sea_level_m - here, math.degrees(math.atan(slope)), _front(level, time_s, x, y))


def _front(level: Level, time_s: float, x: float, y: float) -> float | None:
    """D03: from the outer edge to the run-up limit, on the sea; a swell that travels comes from farther out (T06)."""
    shore, travels = level.settings.shore, level.settings.timing.share == 1
    bed = shore_map(level).at([x], [y], level.tide_m)
    clock, sea = bed["clock"], float(bed["sea"].v[0])
    s = 1 - float(clock.v[0]) / shore.range_m
    if not shore.on or sea < 0.5 or s > 1 + shore.runup or (s < 0 and not travels):
        return None
    return speed_on(level, time_s, float(clock.v[0]), math.hypot(float(clock.dx[0]), float(clock.dy[0])))


def sentence(probe: Probe) -> str:
    """One line for the status bar."""
    water = f"depth {probe.depth_m:.2f} m" if probe.depth_m > 0 else f"{-probe.depth_m:.2f} m over the sea"
    front = f"   front {speed(probe.front_mps)}" if probe.front_mps is not None else ""
    ground = f"ground {probe.ground_m:.2f} m   {water}   slope {probe.slope_deg:.1f}°"
    return f"{probe.x:.1f} east, {probe.y:.1f} north   {ground}{front}"


def speed(mps: float) -> str:
    """A speed as people read it; flat ground makes it endless."""
    return f"{mps:.1f} m/s" if mps < 100 else "over 100 m/s"
