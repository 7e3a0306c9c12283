"""Where the sky of a shot comes from, and its way back into the paint (Z20)."""

from __future__ import annotations

import numpy as np

from .layers import WEATHER_GRID
from .level import Level
from .shots import SHAPE, sky_of
from .weather import SIDE, TILE_M, drift_m, middle_m, weather_at


def sky_at(level: Level, time_s: float, seen_by: str = "", stage: str = "painted") -> np.ndarray:
    """The sky round the middle of the map at a time, as a shot that starts then holds it."""
    axis = np.arange(SIDE) * (TILE_M / SIDE) - TILE_M / 2
    east, north = middle_m(level.settings)
    x, y = np.meshgrid(axis + east, axis + north)
    return sky_of(weather_at(level, time_s, x, y, None, stage, seen_by)[..., :3])


def sky_of_paint(level: Level, start_s: float, seen_by: str = "") -> np.ndarray:
    """The painted sky as it lies when a shot starts, over the simulation of that moment; whole cells, so exact."""
    paint = np.array(level.layers["weather"].read(WEATHER_GRID.rect))
    return laid_on(level, np.roll(paint, drifted_cells(level, start_s), (0, 1)), start_s, seen_by)


def laid_on(level: Level, paint: np.ndarray, start_s: float, seen_by: str = "") -> np.ndarray:
    """Paint `(512, 512, 6)`, in the metres of a shot that starts then, over the simulation of that moment."""
    under = sky_at(level, start_s, seen_by, "simulated").astype(np.float32)
    return sky_of(under + (paint[..., :3] - under) * paint[..., 3:])


def paint_of(level: Level, sky: np.ndarray, start_s: float) -> np.ndarray:
    """The sky of a shot as the layer `weather` holds it, float32 `(512, 512, 6)`, wholly painted."""
    rows, cols = drifted_cells(level, start_s)
    sky = np.roll(sky.astype(np.float32), (-rows, -cols), (0, 1))
    return np.concatenate([sky, np.ones(SHAPE, np.float32)], -1)


def drifted_cells(level: Level, time_s: float) -> tuple[int, int]:
    """Rows and columns by which the painted sky has drifted."""
    if not level.settings.weather.paint_drifts:
        return 0, 0
    east, north = np.rint(drift_m(level, time_s) / WEATHER_GRID.cell_m)
    return int(north), int(east)
