"""What an artist does to a river's points; every function returns new `points` for the object (D13)."""

from __future__ import annotations

import numpy as np

from .errors import BadInput
from .level import Level
from .objects import River
from .params import Section, param
from .pick import ground_at
from .river_join import own_line
from .river_line import FASTEST_MPS, NARROWEST_M, WIDEST_M

Points = tuple[tuple[float, ...], ...]
FIELDS = ("east", "north", "width_m", "level_m", "speed_mps")


class RiverPoint(Section):
    """What a point of a river says besides where it is."""

    width_m: float = param(8.0, NARROWEST_M, WIDEST_M, "m", "Width of the river.", soft=(1, 60))
    level_m: float = param(
        0.0, -12_000, 12_000, "m", "Level of its water; never above the point before.", soft=(-2, 60)
    )
    speed_mps: float = param(1.0, 0, FASTEST_MPS, "m/s", "How fast it runs.", soft=(0, 5))


def places(river: River) -> np.ndarray:
    """World x, y of its points `(n, 2)`."""
    return np.array(river.points)[:, :2] + (river.x, river.y)


def moved_point(river: River, n: int, x: float, y: float) -> Points:
    """Point n at a world place."""
    return _with(river, n, east=round(x - river.x, 2), north=round(y - river.y, 2))


def set_point(river: River, n: int, **values: float) -> Points:
    """Point n with another width_m, level_m or speed_mps; a level stays between those of its neighbours."""
    if "level_m" in values:
        above = river.points[n - 1][3] if n else np.inf
        below = river.points[n + 1][3] if n + 1 < len(river.points) else -np.inf
        values["level_m"] = float(min(max(values["level_m"], below), above))
    if "width_m" in values:
        values["width_m"] = float(np.clip(values["width_m"], NARROWEST_M, WIDEST_M))
    return _with(river, n, **{name: round(value, 3) for name, value in values.items()})


def inserted(river: River, x: float, y: float) -> tuple[Points, int]:
    """With a point more where the line comes nearest to a world place, and its number; width and level stay."""
    line = own_line(river)
    i = int(np.hypot(line.x - x, line.y - y).argmin())
    own = places(river)
    starts = [int(np.hypot(line.x - px, line.y - py).argmin()) for px, py in own]
    n = int(np.clip(np.searchsorted(starts, i), 1, len(own) - 1))
    new = (line.x[i] - river.x, line.y[i] - river.y, 2 * line.half_m[i], line.level_m[i], line.speed_mps[i])
    return (*river.points[:n], tuple(round(float(v), 3) for v in new), *river.points[n:]), n


def extended(level: Level, river: River, x: float, y: float) -> Points:
    """With a point more at its end; its level is the ground's there, no higher than the last."""
    *_, width_m, level_m, speed_mps = river.points[-1]
    ground_m = max(float(ground_at(level, x, y)), level.mean_sea_m)
    end = (round(x - river.x, 2), round(y - river.y, 2), width_m, round(min(level_m, ground_m), 3), speed_mps)
    return (*river.points, end)


def deleted(river: River, n: int) -> Points:
    """Without point n; BadInput where only two are left."""
    if len(river.points) <= 2:
        raise BadInput("a river needs two points: delete the whole river instead")
    return (*river.points[:n], *river.points[n + 1 :])


def snapped(level: Level, river: River) -> Points:
    """Levels brought down to the lowest ground that the line has crossed so far, so that it lies in its valley."""
    line = own_line(river)
    ground = np.maximum(ground_at(level, line.x, line.y), level.mean_sea_m)
    lowest = np.minimum.accumulate(ground)
    found = [float(lowest[int(np.hypot(line.x - x, line.y - y).argmin())]) for x, y in places(river)]
    found = np.minimum.accumulate(found)
    return tuple((*point[:3], round(float(m), 3), point[4]) for point, m in zip(river.points, found, strict=True))


def _with(river: River, n: int, **values: float) -> Points:
    if not 0 <= n < len(river.points):
        raise BadInput(f"river {river.id} has no point {n + 1}; it has {len(river.points)}")
    point = tuple(values.get(name, old) for name, old in zip(FIELDS, river.points[n], strict=True))
    return (*river.points[:n], point, *river.points[n + 1 :])
