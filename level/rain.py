"""How much rain and snow falls at a place (Z18, Z24): what streaks, ripples, wetness, puddles and snow cover follow.

    rain_at(level, time_s, x, y)  # mm/h of rain and of snow, melted, arrays

It falls straight down from the weather map. The twin is shaders/rain.glsl.
"""

from __future__ import annotations

import numpy as np

from .level import Level
from .pick import ground_at
from .settings import Weather
from .weather import RAINY, weather_at

LAPSE_C_KM = 6.5  # the mean lapse of the troposphere (ISO 2533)
SLEET_C = 1.0  # so far to both sides of weather.snow_below_c it is partly both


def rain_at(level: Level, time_s: float, x, y, camera=None, seen_by: str = "") -> tuple[np.ndarray, np.ndarray]:
    """Rain and snow in mm/h of water at world points; none without clouds. `camera` and `seen_by` are weather_at's."""
    x, y = np.broadcast_arrays(np.asarray(x, np.float64), np.asarray(y, np.float64))
    if not level.settings.clouds.on:
        return np.zeros(x.shape), np.zeros(x.shape)
    sky = weather_at(level, time_s, x, y, camera, seen_by=seen_by).astype(np.float64)
    over_sea = np.maximum(ground_at(level, x, y) - level.mean_sea_m, 0.0)
    return rain_rate(level.settings.weather, sky[..., 0], sky[..., 1], over_sea)


def rain_rate(weather: Weather, coverage, precipitation, over_sea_m) -> tuple[np.ndarray, np.ndarray]:
    """Rain and snow in mm/h of water under a sky of the weather map, on ground so high over the sea."""
    falls = weather.rain_mm_h * precipitation * np.minimum(np.asarray(coverage) / RAINY, 1.0)
    celsius = weather.temperature_c - LAPSE_C_KM / 1000 * np.asarray(over_sea_m)
    t = np.clip((celsius - weather.snow_below_c + SLEET_C) / (2 * SLEET_C), 0, 1)
    rain = t * t * (3 - 2 * t)
    return falls * rain, falls * (1 - rain)
