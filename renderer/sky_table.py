"""Sky radiance as a small table, worked out on the CPU from the air (air.py), and the light that air adds on its way.

Single scattering is integrated along each view ray. One fetch a pixel then gives the sky in `shaders/lib/sky.glsl`.

Unit: kilo-candela per square metre for radiance, kilolux for illuminance, per linear Rec. 709 channel, so that the sun
on white sand stays far below the largest half float.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from .air import GROUND_KM, TOP_KM, far_distance, look_up, medium, multiple_table, phases, resample, transmittance_table

# above the air, linear Rec. 709, balanced for daylight of 5600 K as a camera is
SUN_KLUX = np.array([124.0, 128.0, 134.0])
SUN_RADIUS = 0.00465  # rad
ROWS, COLUMNS = 96, 64
EYE_KM = 0.02
TABLES = 48  # kept: those of the elevations of some seconds of a day that runs (day_light.py)


@lru_cache(maxsize=TABLES)
def sky_table(sun_elevation_deg: float, turbidity: float) -> np.ndarray:
    """Sky radiance, float32 `(96, 64, 3)` kcd/m²; rows from horizon to zenith by the square root of the elevation,
    columns from the sun's azimuth to the opposite one."""
    sun = np.radians(float(sun_elevation_deg))
    coarse = _Rays(_grid(ROWS // 2, COLUMNS // 4), sun, float(turbidity))
    # without their phase functions the parts are smooth: few rays do, and the aureole stays sharp
    at = np.linspace(0, ROWS // 2 - 1, ROWS), np.linspace(0, COLUMNS // 4 - 1, COLUMNS)
    fine = _Rays(_grid(ROWS, COLUMNS), sun, float(turbidity))
    light = fine.phased([resample(part, *at) for part in coarse.parts()])
    return (light * SUN_KLUX).astype(np.float32)


def _grid(rows: int, columns: int) -> tuple[np.ndarray, np.ndarray]:
    """Elevation and azimuth from the sun of a table's texels, radians."""
    elevation = (np.arange(rows) / (rows - 1)) ** 2 * np.pi / 2
    return tuple(np.meshgrid(elevation, np.arange(columns) / (columns - 1) * np.pi, indexing="ij"))


def sun_illuminance(sun_elevation_deg: float, turbidity: float) -> np.ndarray:
    """Light of the sun on a plane facing it at sea level, float64 `(3,)` kilolux; the disc sets over half a degree."""
    sine = np.sin(np.radians(float(sun_elevation_deg)))
    # the disc's upper part shines a little longer than its middle; refraction lifts it too
    lifted = np.array([max(sine, 0.0) + 0.004])
    through = look_up(transmittance_table(float(turbidity)), np.array([0.001]), lifted)[0]
    shown = np.clip((sine + SUN_RADIUS + 0.01) / (2 * SUN_RADIUS + 0.01), 0, 1)
    return SUN_KLUX * through * shown


AERIAL = (16, 16, 32)  # distances, elevations, azimuths
AERIAL_FIRST_KM, AERIAL_RATIO = 0.1, 2.0**0.75  # the last distance but one is 145 km


@lru_cache(maxsize=TABLES)
def aerial_table(sun_elevation_deg: float, turbidity: float) -> np.ndarray:
    """Light that the air adds up to a distance, float32 `(16, 16, 32, 3)` kcd/m² by distance, elevation and azimuth.

    The integral of `sky_table` cut off on its way; the last distance is all of it, so sea and sky meet without a seam.
    """
    rays = _Rays(_grid(*AERIAL[1:]), np.radians(float(sun_elevation_deg)), float(turbidity))
    far = AERIAL_FIRST_KM * AERIAL_RATIO ** np.arange(AERIAL[0] - 1)
    total, through, start, parts = [0.0] * 3, 1.0, 0.0, []
    for end in far:
        for i in range(2):
            at, length = start + (i + 0.5) / 2 * (end - start), (end - start) / 2
            total, through = rays.add(total, through, at, length)
        start = end
        parts.append(rays.phased(total))
    parts.append(rays.phased(rays.parts()))
    # what is left of the atmosphere beyond the last cut can only add
    return (np.minimum(np.stack(parts), parts[-1]) * SUN_KLUX).astype(np.float32)


class _Rays:
    """View rays from the shore, and the light along them in three parts: scattered once by air, once by haze, and more
    than once, the first two without their phase functions."""

    def __init__(self, angles: tuple[np.ndarray, np.ndarray], sun: float, turbidity: float) -> None:
        elevation, azimuth = angles
        # Rays just over the sea are kept off the ground so that the horizon row holds the whole path
        self.cosine = np.maximum(np.sin(elevation), 0.0)
        self.sun_cosine = np.sin(sun)
        self.along = np.cos(elevation) * np.cos(sun) * np.cos(azimuth) + self.cosine * self.sun_cosine
        self.turbidity = turbidity
        self.radius = GROUND_KM + EYE_KM
        self.far = far_distance(self.radius, self.cosine, TOP_KM)

    def phased(self, parts: list[np.ndarray]) -> np.ndarray:
        """The parts put together, `(rows, columns, 3)`."""
        rayleigh, haze = phases(self.along)
        return parts[0] * rayleigh + parts[1] * haze + parts[2]

    def add(self, total: list, through, at, length) -> tuple[list, np.ndarray]:
        """Add what a piece of the rays `length` km long about `at` scatters; also the transmittance behind it."""
        here = np.sqrt(self.radius**2 + at**2 + 2 * self.radius * self.cosine * at)
        c = np.clip((self.radius * self.sun_cosine + at * self.along) / here, -1, 1)
        air, haze, extinction = medium(here - GROUND_KM, self.turbidity)
        sunlight = look_up(transmittance_table(self.turbidity), here - GROUND_KM, c)
        multiple = look_up(multiple_table(self.turbidity), here - GROUND_KM, c)
        part = np.exp(-extinction * np.asarray(length)[..., None])
        # exact for a constant source over the step (Hillaire 2015): no energy gained with few steps
        share = through * (1 - part) / np.maximum(extinction, 1e-9)
        sources = air * sunlight, haze * sunlight, (air + haze) * multiple
        return [sum_ + share * source for sum_, source in zip(total, sources, strict=True)], through * part

    def parts(self, steps: int = 40) -> list[np.ndarray]:
        """The three parts along all of the rays, for a sun of unit illuminance."""
        total, through = [0.0] * 3, 1.0
        for i in range(steps):
            low, high = (i / steps) ** 2, ((i + 1) / steps) ** 2
            total, through = self.add(total, through, ((i + 0.5) / steps) ** 2 * self.far, (high - low) * self.far)
        return total
