"""Which of a level's rivers run out to sea, and which into water that is there already (D13, D35)."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from .grid import Rect
from .level import Level
from .objects import River
from .river_line import STEP_M, Line, centre_line

NEAR_M = 10.0  # a river ends at the sea where some lies within two widths of its end, or so far


def rivers(level: Level) -> list[River]:
    """The level's rivers by id."""
    return sorted((o for o in level.objects.values() if isinstance(o, River)), key=lambda o: o.id)


@lru_cache(maxsize=64)
def own_line(river: River) -> Line:
    """The dense line of a river without a tail out to sea."""
    return centre_line(river, -np.inf)


def line_of(level: Level, river: River, step_m: float = STEP_M) -> Line:
    """The dense line of a river as it lies in a level; it runs out to sea only where it comes to it."""
    return centre_line(river, level.mean_sea_m if runs_to_sea(level, river) else -np.inf, step_m)


def runs_to_sea(level: Level, river: River) -> bool:
    """Whether its last point lies at the sea, and in no other river and no painted water."""
    key = (tuple(rivers(level)), level.layer_revision("height"), level.layer_revision("river_mask"), level.mean_sea_m)
    have = level.derived.get("river_ends")
    if have is None or have[0] != key:
        have = level.derived["river_ends"] = (key, {})
    if river not in have[1]:
        have[1][river] = _runs_to_sea(level, river)
    return have[1][river]


def _runs_to_sea(level: Level, river: River) -> bool:
    x, y = river.x + river.points[-1][0], river.y + river.points[-1][1]
    if any(other.id != river.id and level_in(other, x, y) is not None for other in rivers(level)):
        return False
    if _window(level, "river_mask", x, y, 0.0).max() > 0.5:
        return False
    if _window(level, "height", x, y, 0.0).max() <= level.mean_sea_m + river.depth_m:
        return True
    return bool((_window(level, "height", x, y, max(2 * river.points[-1][2], NEAR_M)) < level.mean_sea_m).any())


def _window(level: Level, layer: str, x: float, y: float, reach_m: float) -> np.ndarray:
    grid, reach = level.grid, int(np.ceil(reach_m / level.grid.cell_m))
    row, col = grid.nearest(x, y)
    return level.layers[layer].read(grid.clip(Rect(row - reach, col - reach, row + reach + 1, col + reach + 1)))


def level_in(river: River, x: float, y: float) -> float | None:
    """Level of a river's water at a world place, m; None beside it and at its mouth, where another may end too."""
    line = own_line(river)
    off = np.hypot(line.x - x, line.y - y)
    i = int(off.argmin())
    inside = off[i] < line.half_m[i] and line.along_m[-1] - line.along_m[i] > 2 * line.half_m[-1]
    return float(line.level_m[i]) if inside else None


def main_first(lines: tuple[River, ...]) -> list[int]:
    """The order in which rivers are laid: one that ends or begins in another comes after it."""
    into = [{n for n, other in enumerate(lines) if other.id != river.id and any(
        level_in(other, river.x + river.points[end][0], river.y + river.points[end][1]) is not None for end in (0, -1))}
        for river in lines]  # fmt: skip
    order: list[int] = []
    while len(order) < len(lines):
        rest = [n for n in range(len(lines)) if n not in order]
        order.append(next((n for n in rest if into[n] <= set(order)), rest[0]))  # in a ring: any
    return order
