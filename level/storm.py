"""A storm on demand (Z23): a band of rain across the wind that the air carries over the land; twin of storm_share.

It forms upwind of the map's middle at `storm.start_s`, moves with the air as a whole, and is asked in world metres, not
on the torus: there is one of it.
"""

from __future__ import annotations

import numpy as np

from .level import Level
from .wind import moved_m, wind_way

CLOUDS = 0.85  # coverage of its clouds
KIND = 0.9  # type they tend to
LEAD_M = 4500.0  # how far its clouds are ahead of its rain
SOFT_M = 1500.0  # half the depth of its front
FORMS_M = 4000.0  # it has formed when it has gone so far, or a quarter of its way
FARTHEST_M = 1e6  # beyond this, nobody asks, and float32 would be coarse
HIDDEN_M = 26_000.0, 34_000.0  # so far off it is lost in the horizon's sky; the torus turns round at 35 km


def storm_uniforms(level: Level, time_s: float) -> dict:
    """Way and place of the front, how much of it there is, and its size."""
    settings = level.settings
    storm, weather = settings.storm, settings.weather
    way = wind_way(settings)
    gone = moved_m(level, time_s) - moved_m(level, storm.start_s)
    far = float(np.hypot(*gone))
    t = min(far / max(min(FORMS_M, storm.distance_m / 4), 1.0), 1.0) if time_s > storm.start_s else 0.0
    front = float((np.array([weather.east_m, weather.north_m]) + gone) @ way) - storm.distance_m
    return {
        "u_storm": (*way, min(max(front, -FARTHEST_M), FARTHEST_M), storm.chance * t * t * (3 - 2 * t)),
        "u_storm_size": (storm.depth_m, storm.ragged_m),
    }


def storm_share(uniforms: dict, x, y, even: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How much of the storm's rain and of its clouds is at world points, 0 … 1; `even` noise makes its front ragged."""
    east, north, front, chance = uniforms["u_storm"]
    depth, ragged = uniforms["u_storm_size"]
    behind = front - (east * x + north * y) + ragged * (2 * even - 1)
    soft = min(SOFT_M, 0.4 * depth)
    rain, clouds = (
        chance * step(-soft, soft, at) * (1 - step(depth - soft, depth + soft, behind))
        for at in (behind, behind + LEAD_M)
    )
    return rain, clouds


def step(low: float, high: float, at: np.ndarray) -> np.ndarray:
    """GLSL's smoothstep."""
    t = np.clip((at - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)
