"""What keeps a preset's sky from being seen: paint and shots lie over the simulation (D36, T04, Z20)."""

from __future__ import annotations

from collections.abc import Iterable

from .level import Level
from .shots import shots_at
from .weather_presets import SKY

TOLD_SHARE = 0.1  # of the sky, from which on it is worth telling
WHOLE_SHARE = 0.995


def painted_share(level: Level) -> float:
    """How much of the sky paint makes, 0 … 1, the mean of its channels' weights; 0 where it does not count."""
    data = level.layers["weather"]
    if data.neutral or not level.settings.weather.painted:
        return 0.0
    return float(data.array[..., 3:].mean(dtype="f8"))


def covered(level: Level, paths: Iterable[str], time_s: float | None = None, seen_by: str = "") -> list[str]:
    """Sentences about what covers the sky that settings of these paths make, at a time if one is given; mostly none."""
    if not set(SKY) <= set(paths):
        return []
    told = []
    if time_s is not None and (whole := [seen.shot.id for seen in shots_at(level, time_s, seen_by) if seen.share == 1]):
        told.append(f"the shot {whole[-1]} is all of the sky now; the preset shows before it and after it")
    share = painted_share(level)
    if share >= WHOLE_SHARE:
        told.append("all of the sky is painted; the preset shows only once paint is erased")
    elif share >= TOLD_SHARE:
        told.append(f"{100 * share:.0f} % of the sky is painted; the preset shows only where it isn't")
    return told
