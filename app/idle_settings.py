"""Which of a level's settings change nothing now, because another one decides (T06, T11)."""

from __future__ import annotations

from ..level import Level
from ..level.timing import period_s

BY_DEPTH = "with travel time only"


def idle(level: Level, time_s: float) -> dict[str, str]:
    """By the path of a setting, in a few words, why it counts for nothing at a time."""
    timing, found = level.settings.timing, {}
    if timing.travels:
        found["shore.interval_s"] = f"{period_s(level, time_s):.1f} s, the swell's own"
    else:
        found |= dict.fromkeys(("timing.least_depth_m", "timing.tide_step_m", "timing.current"), BY_DEPTH)
    if timing.source != "blend":
        found["timing.blend"] = "with source blend only"
    if not level.settings.tide.on:
        found["timing.tide_step_m"] = "with a tide only"
    return found
