"""Small tables that shaders fetch by texel, in one texture, for a program has 16 at most."""

from __future__ import annotations

import numpy as np

from .level import Level
from .noise import LATTICE, lattice
from .water_table import TEXELS, table_in_use, water_table

LATTICE_ROW = 2  # the water table's rows (H15), then those of the lattice


def tables(level: Level) -> np.ndarray:
    """float32 `(6, 1024, 4)`: the water table in use, zero without one, then the noise lattice in the first channel."""
    rows = np.zeros((LATTICE_ROW + LATTICE * LATTICE // TEXELS, TEXELS, 4), np.float32)
    if (table := table_in_use(level)) is not None:
        rows[:LATTICE_ROW] = water_table(table)
    rows[LATTICE_ROW:, :, 0] = lattice(level.settings.level.seed).reshape(-1, TEXELS)
    return rows
