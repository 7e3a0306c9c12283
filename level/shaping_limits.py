"""What a bent bed may not do, and what keeps a clock from its depth: slopes and sills (T07)."""

from __future__ import annotations

import math

import numpy as np
from scipy import ndimage

SLOPE_DEG = 35.0  # that a bed gets no steeper than, if nothing else is asked
CALMER = 12  # passes in which slopes are brought down bit by bit; then all of the change is made less
SILL_M = 0.03  # how far below the crest's depth a sill on its way is brought


class SlopeLimit:
    """Of a bed of `depth` (rows, cols), without pebbles of `smooth_m`: no steeper than `slope_deg`, or than it was."""

    def __init__(self, depth: np.ndarray, cell_m: float, smooth_m: float, slope_deg: float) -> None:
        self.depth, self.cell_m, self.sigma = depth, cell_m, smooth_m / cell_m
        self.steepest = math.tan(math.radians(slope_deg))
        self.was = self._slope(depth)

    def _slope(self, depth: np.ndarray) -> np.ndarray:
        """Rise over run."""
        if self.sigma > 0.05:
            depth = ndimage.gaussian_filter(depth, self.sigma, mode="nearest", truncate=3)
        return np.hypot(*np.gradient(depth, self.cell_m))

    def _over(self, field: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        slope = self._slope((self.depth * np.exp(field)).astype(np.float32))
        return slope, (slope > self.steepest) & (slope > 1.02 * self.was + 0.005) & (field != 0)

    def calm(self, field: np.ndarray) -> np.ndarray:
        """Factor of g, 1 but where slopes would pass the limit; smooth, so that it makes no steps of its own."""
        calm, sigma = np.ones(field.shape), max(2.0, 3.0 / self.cell_m)
        for _ in range(CALMER):
            slope, over = self._over(field * calm)
            if not over.any():
                return calm
            factor = np.where(over, np.clip(self.steepest / np.maximum(slope, 1e-6), 0.7, 0.95), 1.0)
            factor = ndimage.minimum_filter(factor, size=2 * math.ceil(2 * sigma) + 1)
            calm = calm * ndimage.gaussian_filter(factor, sigma, mode="nearest", truncate=2)
        low, high = 0.0, 1.0
        for _ in range(6):
            middle = 0.5 * (low + high)
            if self._over(field * calm * middle)[1].any():
                high = middle
            else:
                low = middle
        return calm * low


def sills(depth: np.ndarray, least: np.ndarray, row: np.ndarray, col: np.ndarray, wanted_m: np.ndarray):
    """(rows, columns, missing g) of places on the way from the deep to points that keep the clock's depth too small.

    `least` is the bottleneck depth over `depth`; at the points it shall be `wanted_m`.
    """
    deep = least > float(wanted_m.max(initial=0.0)) + SILL_M
    found: list[tuple[float, float, float]] = []
    if len(row) and deep.any():
        nearest = ndimage.distance_transform_edt(~deep, return_distances=False, return_indices=True)
        for r, c, asked_m in zip(row, col, wanted_m):
            end = nearest[:, int(r), int(c)]
            part = np.linspace(0, 1, max(int(np.hypot(end[0] - r, end[1] - c)) + 1, 2))
            way = r + (end[0] - r) * part, c + (end[1] - c) * part
            along = ndimage.map_coordinates(depth, way, order=1, mode="nearest")
            shallow = int(np.argmin(along))
            if 0.02 < along[shallow] < asked_m + SILL_M:
                found.append((way[0][shallow], way[1][shallow], np.log((asked_m + SILL_M) / along[shallow])))
    return tuple(np.array(found, np.float64).reshape(-1, 3).T)
