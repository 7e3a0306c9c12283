"""How much of the sky the ground sees and how broken it is: the twin of the renderer's map of the open sky (L02, L03).

The same horizons as `shaders/openness.glsl` of the renderer, sample by sample, in the steps of its 8 bits.
"""

from __future__ import annotations

import numpy as np

REACH_M = 80.0  # along the longer axis
LEAST_CELLS = 4
STEPS = 11
WAYS = 16  # horizons a sample, as in the best quality
QUARTER = np.pi / 2


def steps(cell_m: float) -> np.ndarray:
    """Whole cells after which heights are looked up: from one to REACH_M (or a few cells), each a share farther."""
    return np.round(np.geomspace(1, max(REACH_M / cell_m, LEAST_CELLS), STEPS)).astype(np.float32)


def open_sky(height: np.ndarray, cell_m: float, rows: np.ndarray, cols: np.ndarray, ways: int = WAYS):
    """(open, rough) float64 at those samples of `height`, 0 … 1 and 0 … 0.5; beyond the border it goes on level."""
    at = _Around(height, rows, cols)
    middle = at(0, 0)
    east, north = (at(0, 1) - at(0, -1)) / (2 * cell_m), (at(1, 0) - at(-1, 0)) / (2 * cell_m)
    up = 1 / np.sqrt(1 + east * east + north * north)
    seen, every = np.zeros_like(middle), np.zeros_like(middle)
    for angle in (np.arange(ways) + 0.25) * 2 * np.pi / ways:
        way_x, way_y = np.cos(angle), np.sin(angle)
        longer = max(abs(way_x), abs(way_y))
        falls = east * way_x + north * way_y
        rise = np.zeros_like(middle)
        for cells in steps(cell_m):
            off_x, off_y = way_x / longer * cells, way_y / longer * cells
            away_m = np.hypot(off_x, off_y) * cell_m
            np.maximum(rise, (at.across(off_x, off_y) - middle) / away_m - falls, out=rise)
        plane, along = np.maximum(falls, 0.0), -falls * up
        seen += _slice(QUARTER - np.arctan(np.maximum(plane, falls + rise)), up, along)
        every += _slice(QUARTER - np.arctan(plane), up, along)
    # over three times the way broken rock bends a good half as much a metre
    near, far = at.bend(middle, (1.0, 0.0), 2.5 / cell_m) / 2.5, at.bend(middle, (0.7071, 0.7071), 8.0 / cell_m) / 8.0
    rough = np.minimum(near, 1.6 * far)
    return _in_bytes(seen / np.maximum(every, 1e-4)), 0.5 * _in_bytes(2.0 * rough)


def _slice(down: np.ndarray, up: np.ndarray, along: np.ndarray) -> np.ndarray:
    """What one way's slice of the sky down to a horizon sends, `down` radians below the zenith."""
    sine = np.sin(down)
    return 0.5 * (up * sine * sine + along * (down - sine * np.cos(down)))


def _in_bytes(values: np.ndarray) -> np.ndarray:
    return np.rint(np.clip(values, 0.0, 1.0) * 255) / 255


class _Around:
    """Heights some cells away from samples."""

    def __init__(self, height: np.ndarray, rows: np.ndarray, cols: np.ndarray) -> None:
        self.height, self.rows, self.cols = height, rows, cols

    def __call__(self, north: int, east: int) -> np.ndarray:
        rows, cols = (
            np.clip(at + by, 0, n - 1)
            for at, by, n in zip((self.rows, self.cols), (int(north), int(east)), self.height.shape, strict=True)
        )
        return self.height[np.ix_(rows, cols)].astype(np.float64)

    def across(self, east: float, north: float) -> np.ndarray:
        """Where a way crosses a line of samples: between two of them."""
        low = np.floor((north + 1e-4, east + 1e-4))
        part = np.maximum((north, east) - low, 0.0)
        one, share = self(*low), float(part.max())
        if share == 0.0:
            return one
        return one + (self(*(low + (part >= 1e-3))) - one) * share

    def bend(self, middle: np.ndarray, way: tuple[float, float], cells: float) -> np.ndarray:
        """Change of slope over two crossing ways: the lesser."""
        found = []
        for east, north in (way, (-way[1], way[0])):
            to = round(north * cells), round(east * cells)
            found.append(np.abs(self(*to) + self(-to[0], -to[1]) - 2 * middle))
        return np.minimum(*found)
