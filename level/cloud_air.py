"""How the air in clouds has moved and turned at a time: what shaders/clouds.glsl is given besides settings."""

from __future__ import annotations

import math

import numpy as np

from .level import Level
from .weather import drift_m, middle_m


def air_uniforms(level: Level, time_s: float) -> dict:
    """How the air has moved, each within the tile of what it moves (Z07, Z22)."""
    settings = level.settings
    clouds, weather = settings.clouds, settings.weather
    moved = drift_m(level, time_s) + middle_m(settings)
    ways = [math.radians(weather.heading_deg + turn) for turn in (0.0, clouds.turn_deg)]
    evolved = time_s * float(settings.cloud_terms.evolve)
    risen = clouds.rise_mps * evolved
    return {
        "u_cloud_drift": (*np.mod(moved, clouds.scale_m), *np.mod(moved, clouds.detail_m)),
        "u_cloud_way": tuple(part for way in ways for part in (math.sin(way), math.cos(way))),
        "u_cloud_rise": (
            risen / clouds.detail_m % 1.0,
            0.7 * risen / clouds.curl_m % 1.0,
            -0.25 * risen / clouds.scale_m % 1.0,
        ),
    }
