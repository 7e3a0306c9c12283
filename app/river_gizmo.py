"""The gizmo of a river: its banks and middle on the water, arrows downstream, a handle at each point (D13).

With the tool Select: a handle is dragged over the ground, with Shift up and down (the water's level); the one beside
the point in hand sets the width. Ctrl+click puts a point more into the line, or leads the river on beyond its end.
"""

from __future__ import annotations

import numpy as np

from ..level import Level
from ..level.objects import Camera, River
from ..level.pick import ground_at
from ..level.river_edit import moved_point, places, set_point
from ..level.river_join import own_line
from ..level.river_line import Line
from .camera_control import to_screen

REACH_PX = 11.0
ARROW_WIDTHS = 4.0  # way between two arrows, in widths
POINT, WIDTH = "point", "width"


def _across(line: Line) -> np.ndarray:
    """Unit vectors to the left of the way `(n, 2)`."""
    way = np.stack([np.gradient(line.x), np.gradient(line.y)], -1)
    way /= np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-9)
    return np.stack([-way[:, 1], way[:, 0]], -1)


def lines(level: Level, river: River) -> list[tuple[np.ndarray, float, float]]:
    """World points (n, 3), how strongly and how wide they are drawn: middle, banks, arrows."""
    line, across = own_line(river), _across(own_line(river))
    middle = np.stack([line.x, line.y], -1)
    found = [(_over(level, middle, line.level_m), 0.5, 1.2)]
    for side in (1, -1):
        bank = middle + side * across * line.half_m[:, None]
        found.append((_over(level, bank, line.level_m), 0.9, 1.8))
    every = max(int(ARROW_WIDTHS * 2 * line.half_m.mean() / max(line.along_m[1], 1e-6)), 2)
    for i in range(every // 2, len(middle), every):
        size = 0.5 * line.half_m[i]
        way = np.array([across[i, 1], -across[i, 0]])
        head = np.array(
            [middle[i] - way * size + across[i] * size, middle[i], middle[i] - way * size - across[i] * size]
        )
        found.append((_over(level, head, np.full(3, line.level_m[i])), 0.9, 2.0))
    return found


def _over(level: Level, xy: np.ndarray, level_m: np.ndarray) -> np.ndarray:
    """On the water, or on the ground where that is higher."""
    z = np.maximum(np.maximum(ground_at(level, xy[:, 0], xy[:, 1]), level_m), level.sea_level_m)
    return np.column_stack([xy, z + 0.05])


def handles(level: Level, river: River, chosen: int) -> dict[str, np.ndarray]:
    """World points (3,) by name: one for each point, and the width of the chosen one."""
    at = places(river)
    level_m = np.array(river.points)[:, 3]
    found = {f"{POINT} {n}": place for n, place in enumerate(_over(level, at, level_m))}
    if 0 <= chosen < len(at):
        line = own_line(river)
        i = int(np.hypot(line.x - at[chosen, 0], line.y - at[chosen, 1]).argmin())
        side = at[chosen] + _across(line)[i] * line.half_m[i]
        found[f"{WIDTH} {chosen}"] = _over(level, side[None], level_m[chosen : chosen + 1])[0]
    return found


def handle_at(level: Level, camera: Camera, size: tuple[int, int], river: River, chosen: int, where) -> str:
    """Which handle a pixel means, "" for none."""
    found = handles(level, river, chosen)
    pixels, ahead = to_screen(camera, size, np.array(list(found.values())))
    away = np.where(ahead, np.hypot(*(pixels - np.array(where)).T), np.inf)
    return list(found)[int(np.argmin(away))] if away.min() < REACH_PX else ""


def number(handle: str) -> int:
    """Which point a handle belongs to."""
    return int(handle.partition(" ")[2])


def dragged(river: River, handle: str, x: float, y: float) -> dict:
    """The river's fields when a handle is drawn to a world place."""
    n = number(handle)
    if handle.startswith(WIDTH):
        away = float(np.hypot(*(places(river)[n] - (x, y))))
        return {"points": set_point(river, n, width_m=2 * away)}
    return {"points": moved_point(river, n, x, y)}


def lifted(river: River, handle: str, up_m: float) -> dict:
    """The river's fields when the water at a point is raised, no higher than upstream, no lower than downstream."""
    n = number(handle)
    return {"points": set_point(river, n, level_m=river.points[n][3] + up_m)}


def beyond(river: River, x: float, y: float) -> bool:
    """Whether a place lies past the river's end and not beside its line."""
    line = own_line(river)
    i = int(np.hypot(line.x - x, line.y - y).argmin())
    return i == len(line.x) - 1 and float(np.hypot(line.x[i] - x, line.y[i] - y)) > line.half_m[i]
