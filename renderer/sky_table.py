"""Sky radiance as a small table, worked out on the CPU: Rayleigh, haze and ozone with multiple scattering.

Single scattering is integrated along each view ray; light scattered more than once follows the closed form of
Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique" (EGSR 2020), section 5.5. Constants
are Bruneton's ("Precomputed Atmospheric Scattering: a New Implementation", 2017), lengths in km. One fetch a pixel
then gives the sky in `shaders/lib/sky.glsl`.

Unit: kilo-candela per square metre for radiance, kilolux for illuminance, per linear Rec. 709 channel, so that the sun
on white sand stays far below the largest half float.
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
SUN_KLUX = np.array(
    [124.0, 128.0, 134.0]
)  # above the air, linear Rec. 709, balanced for daylight of 5600 K as a camera is
SUN_RADIUS = 0.00465  # rad
GROUND_ALBEDO = 0.18
ROWS, COLUMNS = 96, 64
EYE_KM = 0.02


def _medium(altitude: np.ndarray, turbidity: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Scattering by air, scattering by haze, extinction, 1/km, with a last axis of 3."""
    h = np.maximum(altitude, 0.0)[..., None]
    air = RAYLEIGH * np.exp(-h / 8.0)
    haze = HAZE_TINT * (HAZE_OPTICAL_DEPTH * (turbidity - 1 + 0.1) / HAZE_HEIGHT_KM) * np.exp(-h / HAZE_HEIGHT_KM)
    ozone = OZONE * np.maximum(1 - np.abs(h - 25.0) / 15.0, 0)
    return air, haze * HAZE_ALBEDO, air + haze + ozone


def _far(radius: np.ndarray, cosine: np.ndarray, shell: float) -> np.ndarray:
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
def _transmittance_table(turbidity: float) -> np.ndarray:
    """Transmittance to the top of the air, `(altitudes, cosines, 3)`; 0 where the ground is in the way."""
    radius = GROUND_KM + np.maximum(_ALTITUDES, 1e-3)[:, None]
    cosine = _COSINES[None, :]
    steps = 64
    far = _far(radius, cosine, TOP_KM)
    depth = 0.0
    for i in range(steps):
        # samples crowd where the air is thick
        at = ((i + 0.5) / steps) ** 2 * far
        weight = (((i + 1) / steps) ** 2 - (i / steps) ** 2) * far
        altitude = np.sqrt(radius**2 + at**2 + 2 * radius * cosine * at) - GROUND_KM
        depth = depth + _medium(altitude, turbidity)[2] * weight[..., None]
    blocked = _hits_ground(radius, cosine)
    return np.where(blocked[..., None], 0.0, np.exp(-depth))


def _look_up(table: np.ndarray, altitude: np.ndarray, cosine: np.ndarray) -> np.ndarray:
    """Bilinear value of an `(altitudes, cosines, 3)` table."""
    rows, columns = table.shape[:2]
    v = np.sqrt(np.clip(altitude / (TOP_KM - GROUND_KM), 0, 1)) * (rows - 1)
    u = (np.sign(cosine) * np.sqrt(np.abs(np.clip(cosine, -1, 1))) * 0.5 + 0.5) * (columns - 1)
    r, c = np.minimum(v.astype(int), rows - 2), np.minimum(u.astype(int), columns - 2)
    fr, fc = (v - r)[..., None], (u - c)[..., None]
    low = table[r, c] * (1 - fc) + table[r, c + 1] * fc
    high = table[r + 1, c] * (1 - fc) + table[r + 1, c + 1] * fc
    return low * (1 - fr) + high * fr


def _march(altitude, cosine, sun_cosine_at, turbidity, steps, source):
    """Integrate `source(altitude, sun cosine, air, haze, sunlight) -> (…, 3)` along rays; also the transmittance left.

    `sun_cosine_at(distance, radius)` is the cosine of the sun's zenith distance at a sample.
    """
    sun_table = _transmittance_table(turbidity)
    radius = GROUND_KM + altitude
    ground = _hits_ground(radius, cosine)
    far = np.where(ground, _ground_distance(radius, cosine), _far(radius, cosine, TOP_KM))
    total, through = 0.0, 1.0
    for i in range(steps):
        at = ((i + 0.5) / steps) ** 2 * far
        length = (((i + 1) / steps) ** 2 - (i / steps) ** 2) * far
        here = np.sqrt(radius**2 + at**2 + 2 * radius * cosine * at)
        sun_cosine = sun_cosine_at(at, here)
        air, haze, extinction = _medium(here - GROUND_KM, turbidity)
        part = np.exp(-extinction * length[..., None])
        light = source(here - GROUND_KM, sun_cosine, air, haze, _look_up(sun_table, here - GROUND_KM, sun_cosine))
        # exact for a constant source over the step (Hillaire 2015): no energy gained with few steps
        total = total + through * light * (1 - part) / np.maximum(extinction, 1e-9)
        through = through * part
    return total, through, ground, far


@lru_cache(maxsize=4)
def _multiple_table(turbidity: float) -> np.ndarray:
    """Radiance of light scattered twice or more for a unit sun, over 1/(4π) phase, `(altitudes, cosines, 3)`."""
    return cached("sky_multiple", lambda: _make_multiple_table(turbidity), __file__, turbidity)


def _make_multiple_table(turbidity: float) -> np.ndarray:
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
            light, through, ground, far = _march(altitude, ray, sun_at, turbidity, 16, lit)
            here = np.full_like(sun, GROUND_KM)
            below = sun_at(far, here)
            bounce = _look_up(_transmittance_table(turbidity), np.zeros_like(sun), below)
            bounce = bounce * (np.maximum(below, 0) * ground * GROUND_ALBEDO / np.pi)[..., None]
            first = first + light + through * bounce
            factor = factor + _march(altitude, ray, sun_at, turbidity, 16, glow)[0]
    count = len(cosines) * len(azimuths)
    table = (first / count) / (1 - np.minimum(factor / count, 0.98))
    grid = np.linspace(0, table.shape[0] - 1, len(_ALTITUDES)), np.linspace(0, table.shape[1] - 1, len(_COSINES))
    return _resample(table, *grid)


def _resample(table: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    r, c = np.minimum(rows.astype(int), table.shape[0] - 2), np.minimum(columns.astype(int), table.shape[1] - 2)
    fr, fc = (rows - r)[:, None, None], (columns - c)[None, :, None]
    low = table[r][:, c] * (1 - fc) + table[r][:, c + 1] * fc
    return low * (1 - fr) + (table[r + 1][:, c] * (1 - fc) + table[r + 1][:, c + 1] * fc) * fr


def _phases(cosine: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rayleigh and Cornette-Shanks phase functions, with a last axis of 1."""
    g = HAZE_G
    rayleigh = 3 / (16 * np.pi) * (1 + cosine**2)
    haze = 3 / (8 * np.pi) * (1 - g * g) / (2 + g * g) * (1 + cosine**2) / (1 + g * g - 2 * g * cosine) ** 1.5
    return rayleigh[..., None], haze[..., None]


@lru_cache(maxsize=8)
def sky_table(sun_elevation_deg: float, turbidity: float) -> np.ndarray:
    """Sky radiance, float32 `(96, 64, 3)` kcd/m²; rows from horizon to zenith by the square root of the elevation,
    columns from the sun's azimuth to the opposite one."""
    sun = np.radians(float(sun_elevation_deg))
    coarse = _Rays(_grid(ROWS // 2, COLUMNS // 4), sun, float(turbidity))
    # without their phase functions the parts are smooth: few rays do, and the aureole stays sharp
    at = np.linspace(0, ROWS // 2 - 1, ROWS), np.linspace(0, COLUMNS // 4 - 1, COLUMNS)
    fine = _Rays(_grid(ROWS, COLUMNS), sun, float(turbidity))
    light = fine.phased([_resample(part, *at) for part in coarse.parts()])
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
    through = _look_up(_transmittance_table(float(turbidity)), np.array([0.001]), lifted)[0]
    shown = np.clip((sine + SUN_RADIUS + 0.01) / (2 * SUN_RADIUS + 0.01), 0, 1)
    return SUN_KLUX * through * shown


AERIAL = (16, 16, 32)  # distances, elevations, azimuths
AERIAL_FIRST_KM, AERIAL_RATIO = 0.1, 2.0**0.75  # the last distance but one is 145 km


@lru_cache(maxsize=8)
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
        self.far = _far(self.radius, self.cosine, TOP_KM)

    def phased(self, parts: list[np.ndarray]) -> np.ndarray:
        """The parts put together, `(rows, columns, 3)`."""
        rayleigh, haze = _phases(self.along)
        return parts[0] * rayleigh + parts[1] * haze + parts[2]

    def add(self, total: list, through, at, length) -> tuple[list, np.ndarray]:
        """Add what a piece of the rays `length` km long about `at` scatters; also the transmittance behind it."""
        here = np.sqrt(self.radius**2 + at**2 + 2 * self.radius * self.cosine * at)
        c = np.clip((self.radius * self.sun_cosine + at * self.along) / here, -1, 1)
        air, haze, extinction = _medium(here - GROUND_KM, self.turbidity)
        sunlight = _look_up(_transmittance_table(self.turbidity), here - GROUND_KM, c)
        multiple = _look_up(_multiple_table(self.turbidity), here - GROUND_KM, c)
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


def air_extinction(turbidity: float) -> tuple[np.ndarray, np.ndarray]:
    """Extinction at sea level of the air and of its haze, 1/m, `(3,)` each."""
    _, haze, both = (value[0] / 1000 for value in _medium(np.zeros(1), float(turbidity)))
    return both - haze / HAZE_ALBEDO, haze / HAZE_ALBEDO
