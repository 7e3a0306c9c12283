"""Where a ray meets the shell of clouds: the pointer's way into the sky, without OpenGL (T04).

The planet is a sphere whose top is the sea's plane under the camera, as the march through the clouds has it. At its
radius differences of squares lose metres in single precision and millimetres here; the forms below lose nothing.
"""

from __future__ import annotations

import math

import numpy as np

from .level import Level
from .pick import pick_ray

FARTHEST_M = 34_000.0  # from the camera: what lies farther is the horizon's own sky (Z06)


def sphere_hits(rise: float, eye_m: float, altitude_m: float, radius_m: float) -> tuple[float, float] | None:
    """Both distances along a ray of unit length and vertical part `rise` to the sphere at an altitude, or None.

    With b the half way to the ray's lowest point and c the product of both distances, the larger in size of them is
    −b ∓ √(b² − c) and the other c over it.
    """
    b = (radius_m + eye_m) * rise
    c = (eye_m - altitude_m) * (2 * radius_m + eye_m + altitude_m)
    under = b * b - c
    if under < 0:
        return None
    far = -b - math.copysign(math.sqrt(under), b)
    near, far = sorted((far, c / far if far else 0.0))
    return near, far


def shell_distance(level: Level, eye_m: float, rise: float) -> float | None:
    """Metres along a ray to the shell's inner side, from within it upwards to its outer side; None where it misses.

    `rise` is the vertical part of the ray of unit length.
    """
    clouds = level.settings.clouds
    radius_m = clouds.planet_km * 1000
    base = sphere_hits(rise, eye_m, clouds.base_m, radius_m)
    if eye_m < clouds.base_m:
        ground = sphere_hits(rise, eye_m, min(0.0, eye_m - 1), radius_m)
        return None if ground is not None and ground[0] > 0 else base[1]
    if base is not None and base[0] >= 0:
        return base[0]
    top = sphere_hits(rise, eye_m, clouds.top_m, radius_m)
    return top[1] if top is not None and top[1] > 0 and eye_m < clouds.top_m else None


def pick_sky(level: Level, origin, direction) -> tuple[float, float, float] | None:
    """World point (x, y, z) where a ray meets the shell of clouds, None where land is before it or it is too far."""
    origin, direction = np.asarray(origin, np.float64), np.asarray(direction, np.float64)
    length = np.linalg.norm(direction)
    if not (np.isfinite(origin).all() and np.isfinite(length) and length > 0):
        return None
    direction = direction / length
    distance = shell_distance(level, float(origin[2]), float(direction[2]))
    if distance is None or distance * math.hypot(direction[0], direction[1]) > FARTHEST_M:
        return None
    land = pick_ray(level, origin, direction)
    if land is not None and np.linalg.norm(land - origin) < distance:
        return None
    x, y, z = origin + direction * distance
    return float(x), float(y), float(z)


def bend_m(level: Level, away_m, altitude_m: float):
    """How far the sphere at an altitude lies below its top, `away_m` metres beside it; works on arrays."""
    radius_m = level.settings.clouds.planet_km * 1000 + altitude_m
    away_m = np.minimum(np.abs(np.asarray(away_m, np.float64)), radius_m)
    return away_m**2 / (radius_m + np.sqrt(radius_m**2 - away_m**2))


def on_shell(level: Level, eye, x, y, altitude_m: float) -> np.ndarray:
    """World points (n, 3) over x and y at an altitude above the planet that curves away from under the eye (3,)."""
    x, y = np.broadcast_arrays(np.asarray(x, np.float64), np.asarray(y, np.float64))
    return np.stack([x, y, altitude_m - bend_m(level, np.hypot(x - eye[0], y - eye[1]), altitude_m)], axis=-1)
