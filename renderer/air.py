"""The air: what it scatters and takes away by height, how much sun is left, light scattered more than once.

Light scattered more than once follows the closed form of Hillaire, "A Scalable and Production Ready Sky and Atmosphere
Rendering Technique" (EGSR 2020), section 5.5. Constants are Bruneton's ("Precomputed Atmospheric Scattering: a New
Implementation", 2017). Lengths in km, altitudes over the sea, cosines of the zenith distance.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from .cache import cached

GROUND_KM, TOP_KM = 6360.0, 6440.0
# 1/km at 640, 550 and 453 nm, near the Rec. 709 primaries: with the often published 680 and 440 nm dusk is magenta.
# Rayleigh by λ^-4 from 13.558e-3 at 550 nm, ozone by the Chappuis band from 1.881e-3 there.
RAYLEIGH = np.array([7.40e-3, 13.56e-3, 29.5e-3])
OZONE = np.array([1.45e-3, 1.88e-3, 0.16e-3])
HAZE_TINT = np.array([0.84, 1.0, 1.22])  # Ångström exponent about 0.9
HAZE_OPTICAL_DEPTH = 0.036  # at 550 nm for each step of turbidity above 1: clean sea air has 0.06
HAZE_HEIGHT_KM, HAZE_ALBEDO, HAZE_G = 1.2, 0.94, 0.78
GROUND_ALBEDO = 0.18


def medium(altitude: np.ndarray, turbidity: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Scattering by air, scattering by haze, extinction, 1/km, with a last axis of 3."""
    h = np.maximum(altitude, 0.0)[..., None]
    air = RAYLEIGH * np.exp(-h / 8.0)
    haze = HAZE_TINT * (HAZE_OPTICAL_DEPTH * (turbidity - 1 + 0.1) / HAZE_HEIGHT_KM) * np.exp(-h / HAZE_HEIGHT_KM)
    ozone = OZONE * np.maximum(1 - np.abs(h - 25.0) / 15.0, 0)
    return air, haze * HAZE_ALBEDO, air + haze + ozone


def far_distance(radius: np.ndarray, cosine: np.ndarray, shell: float) -> np.ndarray:
    """Distance along a ray to where it leaves a shell it is inside of."""
    inside = radius**2 * (cosine**2 - 1) + shell**2
    return np.maximum(-radius * cosine + np.sqrt(np.maximum(inside, 0)), 0)


def _hits_ground(radius: np.ndarray, cosine: np.ndarray) -> np.ndarray:
    return (cosine < 0) & (radius**2 * (cosine**2 - 1) + GROUND_KM**2 >= 0)


def _ground_distance(radius, cosine):
    return -radius * cosine - np.sqrt(np.maximum(radius**2 * (cosine**2 - 1) + GROUND_KM**2, 0))


_ALTITUDES = np.linspace(0, 1, 48) ** 2 * (TOP_KM - GROUND_KM)
_COSINES = np.sign(np.linspace(-1, 1, 97)) * np.linspace(-1, 1, 97) ** 2


@lru_cache(maxsize=4)
def transmittance_table(turbidity: float) -> np.ndarray:
    """Transmittance to the top of the air, `(altitudes, cosines, 3)`; 0 where the ground is in the way."""
    radius = GROUND_KM + np.maximum(_ALTITUDES, 1e-3)[:, None]
    cosine = _COSINES[None, :]
    steps = 64
    far = far_distance(radius, cosine, TOP_KM)
    depth = 0.0
    for i in range(steps):
        # samples crowd where the air is thick
        at = ((i + 0.5) / steps) ** 2 * far
        weight = (((i + 1) / steps) ** 2 - (i / steps) ** 2) * far
        altitude = np.sqrt(radius**2 + at**2 + 2 * radius * cosine * at) - GROUND_KM
        depth = depth + medium(altitude, turbidity)[2] * weight[..., None]
    blocked = _hits_ground(radius, cosine)
    return np.where(blocked[..., None], 0.0, np.exp(-depth))


def look_up(table: np.ndarray, altitude: np.ndarray, cosine: np.ndarray) -> np.ndarray:
    """Bilinear value of an `(altitudes, cosines, 3)` table."""
    rows, columns = table.shape[:2]
    v = np.sqrt(np.clip(altitude / (TOP_KM - GROUND_KM), 0, 1)) * (rows - 1)
    u = (np.sign(cosine) * np.sqrt(np.abs(np.clip(cosine, -1, 1))) * 0.5 + 0.5) * (columns - 1)
    r, c = np.minimum(v.astype(int), rows - 2), np.minimum(u.astype(int), columns - 2)
    fr, fc = (v - r)[..., None], (u - c)[..., None]
    low = table[r, c] * (1 - fc) + table[r, c + 1] * fc
    high = table[r + 1, c] * (1 - fc) + table[r + 1, c + 1] * fc
    return low * (1 - fr) + high * fr


def march(altitude, cosine, sun_cosine_at, turbidity, steps, source):
    """Integrate `source(altitude, sun cosine, air, haze, sunlight) -> (…, 3)` along rays; also the transmittance left.

    `sun_cosine_at(distance, radius)` is the cosine of the sun's zenith distance at a sample.
    """
    sun_table = transmittance_table(turbidity)
    radius = GROUND_KM + altitude
    ground = _hits_ground(radius, cosine)
    far = np.where(ground, _ground_distance(radius, cosine), far_distance(radius, cosine, TOP_KM))
    total, through = 0.0, 1.0
    for i in range(steps):
        at = ((i + 0.5) / steps) ** 2 * far
        length = (((i + 1) / steps) ** 2 - (i / steps) ** 2) * far
        here = np.sqrt(radius**2 + at**2 + 2 * radius * cosine * at)
        sun_cosine = sun_cosine_at(at, here)
        air, haze, extinction = medium(here - GROUND_KM, turbidity)
        part = np.exp(-extinction * length[..., None])
        light = source(here - GROUND_KM, sun_cosine, air, haze, look_up(sun_table, here - GROUND_KM, sun_cosine))
        # exact for a constant source over the step (Hillaire 2015): no energy gained with few steps
        total = total + through * light * (1 - part) / np.maximum(extinction, 1e-9)
        through = through * part
    return total, through, ground, far


@lru_cache(maxsize=4)
def multiple_table(turbidity: float) -> np.ndarray:
    """Radiance of light scattered twice or more for a unit sun, over 1/(4π) phase, `(altitudes, cosines, 3)`."""
    return cached("sky_multiple", lambda: make_multiple_table(turbidity), __file__, turbidity)


def make_multiple_table(turbidity: float) -> np.ndarray:
    altitude, sun = np.meshgrid(_ALTITUDES[::4], _COSINES[::4], indexing="ij")
    cosines = np.linspace(-0.97, 0.97, 12)
    azimuths = (np.arange(4) + 0.5) * np.pi / 4
    first, factor = 0.0, 0.0
    for cosine in cosines:
        for azimuth in azimuths:
            sine = np.sqrt(1 - cosine**2)
            along = cosine * sun + sine * np.sqrt(1 - sun**2) * np.cos(azimuth)
            ray = np.full_like(sun, cosine)

            def sun_at(at, here, along=along):
                return np.clip(((GROUND_KM + altitude) * sun + at * along) / here, -1, 1)

            lit = lambda h, c, air, haze, sunlight: (air + haze) * sunlight / (4 * np.pi)  # noqa: E731
            glow = lambda h, c, air, haze, sunlight: air + haze  # noqa: E731
            light, through, ground, far = march(altitude, ray, sun_at, turbidity, 16, lit)
            here = np.full_like(sun, GROUND_KM)
            below = sun_at(far, here)
            bounce = look_up(transmittance_table(turbidity), np.zeros_like(sun), below)
            bounce = bounce * (np.maximum(below, 0) * ground * GROUND_ALBEDO / np.pi)[..., None]
            first = first + light + through * bounce
            factor = factor + march(altitude, ray, sun_at, turbidity, 16, glow)[0]
    count = len(cosines) * len(azimuths)
    table = (first / count) / (1 - np.minimum(factor / count, 0.98))
    grid = np.linspace(0, table.shape[0] - 1, len(_ALTITUDES)), np.linspace(0, table.shape[1] - 1, len(_COSINES))
    return resample(table, *grid)


def resample(table: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    r, c = np.minimum(rows.astype(int), table.shape[0] - 2), np.minimum(columns.astype(int), table.shape[1] - 2)
    fr, fc = (rows - r)[:, None, None], (columns - c)[None, :, None]
    low = table[r][:, c] * (1 - fc) + table[r][:, c + 1] * fc
    return low * (1 - fr) + (table[r + 1][:, c] * (1 - fc) + table[r + 1][:, c + 1] * fc) * fr


def phases(cosine: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rayleigh and Cornette-Shanks phase functions, with a last axis of 1."""
    g = HAZE_G
    rayleigh = 3 / (16 * np.pi) * (1 + cosine**2)
    haze = 3 / (8 * np.pi) * (1 - g * g) / (2 + g * g) * (1 + cosine**2) / (1 + g * g - 2 * g * cosine) ** 1.5
    return rayleigh[..., None], haze[..., None]


def air_extinction(turbidity: float) -> tuple[np.ndarray, np.ndarray]:
    """Extinction at sea level of the air and of its haze, 1/m, `(3,)` each."""
    _, haze, both = (value[0] / 1000 for value in medium(np.zeros(1), float(turbidity)))
    return both - haze / HAZE_ALBEDO, haze / HAZE_ALBEDO
