"""How far the wind has moved the air: what clouds, weather map, paint and storm are carried by (Z07)."""

from __future__ import annotations

import math

import numpy as np

from .level import Level
from .settings import Settings
from .weather_keys import run_m


def wind_way(settings: Settings) -> np.ndarray:
    """Unit vector to where the wind blows, east and north, float64 `(2,)`."""
    heading = math.radians(settings.weather.heading_deg)
    return np.array([math.sin(heading), math.cos(heading)])


def moved_m(level: Level, time_s: float) -> np.ndarray:
    """Metres east and north that the air has moved since time zero, not wrapped, float64 `(2,)`."""
    return wind_way(level.settings) * run_m(level, time_s, "weather.wind_mps")
