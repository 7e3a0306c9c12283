"""Absorb and scatter tables: what metres of water do to light, as an artist's gradient (Hitman talk, H15).

The axis is linear metres, half of the light's way down and back: with the sun overhead that is the depth, and a shoal
keeps its colour while the sun sinks. What is left of the light from below is multiplied, what the water adds is an
albedo; that scattering goes by the way alone is a simplification that the talk admits.
"""

from __future__ import annotations

import numpy as np

from .errors import BadInput
from .level import Level
from .objects import WaterTable
from .settings import Water
from .water_optics import absorption, backscatter

LENGTH_M = 200.0  # hardly any light is left beyond
TEXELS = 1024
NEAR = 0.004  # how far a table of the optics may be from their closed form


def table_in_use(level: Level) -> WaterTable | None:
    """The table that `water.table` names; None where it is empty or no table has that name."""
    thing = level.objects.get(level.settings.water.table)
    return thing if isinstance(thing, WaterTable) else None


def check_table(level: Level) -> None:
    """BadInput where `water.table` names no table."""
    name = level.settings.water.table
    if name and table_in_use(level) is None:
        known = ", ".join(sorted(o.id for o in level.objects.values() if isinstance(o, WaterTable))) or "none"
        raise BadInput(f"water.table: this level has no water table {name!r}; it has: {known}")


def water_table(table: WaterTable) -> np.ndarray:
    """float32 `(2, TEXELS, 4)`: what is left of red, green, blue, and what is added, every LENGTH_M / (TEXELS − 1)."""
    stops = np.array(table.stops)
    metres = np.linspace(0, LENGTH_M, TEXELS)
    rows = np.zeros((2, TEXELS, 4), np.float32)
    for i in range(6):
        rows[i // 3, :, i % 3] = np.interp(metres, stops[:, 0], stops[:, 1 + i])
    return rows


def optics_table(name: str, water: Water) -> WaterTable:
    """A table of what the section `water` says, to start from, with as few stops as look the same."""
    lost = 2 * (absorption(water) + backscatter(water))
    deep = 0.33 * backscatter(water) / (absorption(water) + backscatter(water))  # Gordon 1975, as lib/water.glsl has it
    metres = np.concatenate([[0.0], np.geomspace(0.02, LENGTH_M, 255)])
    left = np.exp(-metres[:, None] * lost)
    rows = np.concatenate([metres[:, None], left, deep * (1 - left)], axis=1)
    return WaterTable(id=name, stops=tuple(tuple(float(v) for v in rows[n]) for n in _enough(rows)))


def _enough(rows: np.ndarray) -> list[int]:
    """Numbers of the rows `(n, 7)` that say all the others to NEAR, found by adding the one that is farthest off."""
    kept = [0, len(rows) - 1]
    scale = np.array([1.0] * 3 + [max(row, 1e-4) for row in rows[-1, 4:]])
    while len(kept) < len(rows):
        metres = rows[kept, 0]
        said = np.stack([np.interp(rows[:, 0], metres, rows[kept, i]) for i in range(1, 7)], axis=1)
        off = (np.abs(said - rows[:, 1:]) / scale).max(axis=1)
        if off.max() < NEAR:
            break
        kept = sorted([*kept, int(off.argmax())])
    return kept
