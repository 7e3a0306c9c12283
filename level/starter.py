"""The ground of a level made from nothing: a sandy beach that slopes into the sea, with a dune line behind it."""

from __future__ import annotations

import numpy as np

from .grid import Grid
from .noise import lattice  # the same seeded lattice as the waves'

SLOPE = 1 / 22  # a medium-sand beach face
DEEPEST_M = 24.0


def sloping_beach(grid: Grid, seed: int = 7) -> np.ndarray:
    """Height float32 `(rows, cols)` m about a sea at 0: deep water in the south, dunes in the north, gentle cusps.

    Dean's equilibrium profile, depth = A·x^(2/3), below the water (Dean 1977), an even beach face above it.
    """
    east_m, north_m = grid.extent_m
    x = np.linspace(0, east_m, grid.cols)
    y = np.linspace(0, north_m, grid.rows)
    scale = max(max(east_m, north_m) / 512, 1e-3)
    bend = _bumps(x / (90 * scale), seed) * 14 * scale + _bumps(x / (21 * scale), seed + 1) * 2.5 * scale
    inland = (y - 0.62 * north_m)[:, None] + bend[None, :]
    sea = -np.minimum(0.22 * np.maximum(-inland, 0) ** (2 / 3), DEEPEST_M)
    face = np.maximum(inland, 0) * SLOPE
    dune = 2.4 * np.clip((inland - 55 * scale) / (40 * scale), 0, 1) * (1 + 0.6 * _bumps(x / (34 * scale), seed + 2))
    return np.where(inland < 0, sea, np.minimum(face, 4.0) + dune).astype(np.float32)


def _bumps(place: np.ndarray, seed: int) -> np.ndarray:
    """Smooth noise of one coordinate, -1 … 1, from one row of the seeded lattice."""
    row = lattice(seed)[seed % len(lattice(seed))].astype(np.float64)
    row = (row - row.mean()) / max(np.abs(row - row.mean()).max(), 1e-9)
    cell = np.floor(place).astype(np.int64)
    part = place - cell
    part = part * part * (3 - 2 * part)
    return row[cell % len(row)] * (1 - part) + row[(cell + 1) % len(row)] * part
