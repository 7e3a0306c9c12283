"""Where a level lies on Earth: its gravity, degrees and metres, what a new origin does to a georeference."""

from __future__ import annotations

import math

GRAVITY = 9.81  # m/s²


def degrees_to_metres(step_deg: tuple[float, float], latitude: float) -> tuple[float, float]:
    """Metres of an (east, north) step in degrees; WGS 84 series of Snyder, Map Projections (USGS PP 1395, 1987)."""
    phi = math.radians(latitude)
    north = 111132.92 - 559.82 * math.cos(2 * phi) + 1.175 * math.cos(4 * phi)
    east = 111412.84 * math.cos(phi) - 93.5 * math.cos(3 * phi) + 0.118 * math.cos(5 * phi)
    return step_deg[0] * east, step_deg[1] * north


def moved(georeference: dict, east_m: float, north_m: float) -> dict:
    """The georeference of an origin that many metres further; what it doesn't state it doesn't gain."""
    there = dict(georeference)
    latitude = there.get("latitude", 0.0)
    degree_m = degrees_to_metres((1.0, 1.0), latitude if isinstance(latitude, int | float) else 0.0)
    steps = {"easting": east_m, "northing": north_m}
    steps |= {"longitude": east_m / max(degree_m[0], 1.0), "latitude": north_m / degree_m[1]}
    for key, step in steps.items():
        if isinstance(there.get(key), int | float):
            there[key] = there[key] + step
    return there
