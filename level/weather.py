"""The weather map: coverage, precipitation and type of the sky round a camera at a time; twin of shaders/weather.glsl.

Order at every sample: simulation with bias (Z05) → skies of shots (Z20) → paint by its weights → the horizon's own sky
(Z06) → what rains becomes cumulonimbus (Z04). Everything is a function of time, so that the clock may be scrubbed both
ways. The map is a torus of 70 km, asked at the place nearest to the camera; paint and simulation lie in the moving air.
"""

from __future__ import annotations

import functools
import math

import numpy as np
from scipy.ndimage import map_coordinates

from .layers import WEATHER_GRID
from .level import Level
from .settings import Settings
from .shots import MOST, Seen, shots_at
from .storm import CLOUDS, HIDDEN_M, KIND, step, storm_share, storm_uniforms
from .textures import spectral_noise
from .weather_keys import MOST_AREAS, level_at, sky_areas
from .wind import moved_m

SIDE = WEATHER_GRID.rows
TILE_M = WEATHER_GRID.extent_m[0]
NOISE_SIDE = 256
STAGES = ("simulated", "painted", "horizon", "final")
RAINY = 0.7  # coverage that precipitation pulls to (Z04)
SOFT = 0.15  # of the rain noise's range: from no rain to full rain
FINE = 0.5  # amplitude of the small pattern against the broad one
BEND = 3.6  # of NOISE_SIDE, about a kilometre: how far turbulence bends both
SHIFTS = ((0.0, 0.0), (0.371, 0.613), (0.729, 0.237), (0.171, 0.871))  # coverage, type, rain, storm on it, in tiles
GAPS, REGIONS = 0.45, 0.3  # how softly coverage and type go from little to much, of the noise's range
FINE_RATE = 1.618034  # how much faster the fine pattern turns: the two are never again as they were


@functools.lru_cache(maxsize=4)
def weather_noise(seed: int) -> np.ndarray:
    """float32 `(256, 256, 4)` tiling Gaussian noise: a broad pattern and its quarter turn, a fine one and its own.

    `cos a · first + sin a · second` keeps its statistics whatever a is: it grows and decays as a turns. Both are bent
    by one broad turbulence, which draws clumps out into streaks.
    """
    bend = [BEND * spectral_noise(NOISE_SIDE, 7919 * seed + n, 1.8, 2, 8) for n in (11, 12)]
    at = [axis + off for axis, off in zip(np.mgrid[0:NOISE_SIDE, 0:NOISE_SIDE], bend, strict=True)]
    made = [spectral_noise(NOISE_SIDE, 7919 * seed + n, 1.0, 3, 10) for n in (1, 2)]
    made += [spectral_noise(NOISE_SIDE, 7919 * seed + n, 1.3, 10, 36) for n in (3, 4)]
    bent = [map_coordinates(noise, at, order=1, mode="grid-wrap") for noise in made]
    return np.stack([(n - n.mean()) / n.std() for n in bent], -1).astype(np.float16).astype(np.float32)


def drift_m(level: Level, time_s: float) -> np.ndarray:
    """Metres east and north that the air has moved since time zero, within one torus, float64 `(2,)`."""
    return np.mod(moved_m(level, time_s), TILE_M)


def middle_m(settings: Settings) -> np.ndarray:
    """World metres of the map's middle at time zero, float64 `(2,)`."""
    return np.array([settings.weather.east_m, settings.weather.north_m], np.float64)


def paint_place(level: Level, time_s: float, x, y):
    """Metres on the painted map, −35 000 … 35 000, of world points at a time; works on arrays."""
    weather = level.settings.weather
    moved = middle_m(level.settings) + (drift_m(level, time_s) if weather.paint_drifts else 0.0)
    half = TILE_M / 2
    return tuple((np.asarray(at, np.float64) - off + half) % TILE_M - half for at, off in zip((x, y), moved))


def shot_place(level: Level, seen: Seen, time_s: float) -> tuple[float, float, float]:
    """Metres east and north that a shot's sky has moved, and its share."""
    moved = middle_m(level.settings)
    if seen.shot.drifts:
        moved = moved + drift_m(level, time_s) - drift_m(level, seen.shot.start_s)
    return (*(float(v) for v in moved), seen.share)


def shot_uniforms(level: Level, time_s: float, seen_by: str) -> dict:
    """What weather.glsl asks for of the shots that a camera sees, besides their skies."""
    shots = shots_at(level, time_s, seen_by)
    places = np.zeros((MOST, 4), np.float32)
    for at, seen in enumerate(shots):
        places[at, :3] = shot_place(level, seen, time_s)
    paint = math.prod(1.0 if seen.shot.painted else 1.0 - seen.share for seen in shots)
    horizon = math.prod(1.0 - seen.share if seen.shot.whole else 1.0 for seen in shots)
    return {
        "u_weather_shots": len(shots),
        "u_weather_shot": places,
        "u_weather_over_shots": (float(paint), float(horizon)),
    }


def weather_uniforms(level: Level, time_s: float, seen_by: str = "") -> dict:
    """What weather.glsl asks for besides its settings and textures; `seen_by` is the name of the picture's camera."""
    settings = level.settings
    weather = settings.weather
    bias, areas = sky_areas(level, time_s)
    at = time_s / weather.growth_s * float(weather.evolve)
    broad, fine = 2 * math.pi * (at % 1.0), 2 * math.pi * ((FINE_RATE * at) % 1.0)
    drift, middle = drift_m(level, time_s), middle_m(settings)
    return {
        **shot_uniforms(level, time_s, seen_by),
        "u_weather_turn": (math.cos(broad), math.sin(broad), math.cos(fine), math.sin(fine)),
        "u_weather_moved": tuple(drift + middle),
        "u_weather_paint_moved": tuple(middle + drift * float(weather.paint_drifts)),
        "u_weather_bias": (*bias, weather.variety),
        "u_weather_horizon": (
            weather.horizon_start_m, max(weather.horizon_end_m, weather.horizon_start_m + 1.0),
            weather.horizon_coverage, weather.horizon_type,
        ),
        **storm_uniforms(level, time_s),
        "u_weather_areas": len(areas),
        "u_weather_area": _padded(areas[:, 0]),
        "u_weather_area_sky": _padded(areas[:, 1]),
        "u_weather_painted": weather.painted and not level.layers["weather"].neutral,
    }  # fmt: skip


def _padded(rows: np.ndarray) -> np.ndarray:
    """As long as the shader's array."""
    return np.concatenate([rows, np.zeros((MOST_AREAS - len(rows), 4), np.float32)])


def texel_metres() -> tuple[np.ndarray, np.ndarray]:
    """x and y of the map's texels, `(512, 512)` each, −35 000 … 35 000."""
    axis = (np.arange(SIDE) + 0.5) / SIDE * TILE_M - TILE_M / 2
    return np.meshgrid(axis, axis)


def nearest_m(at: np.ndarray, centre: float) -> np.ndarray:
    """Places of a torus moved by whole tiles to where they are nearest to `centre`."""
    return at - TILE_M * np.round((at - centre) / TILE_M)


def weather_map(
    level: Level, time_s: float, camera: tuple[float, float], stage: str = "final", seen_by: str = ""
) -> np.ndarray:
    """float32 `(512, 512, 4)`: coverage, precipitation, type (final: 0 stratus, 0.5 cumulus, 1 cumulonimbus), weight.

    `camera` is east and north in world metres; texel (i, j) stands for the place nearest to it of texel_metres' torus.
    """
    x, y = texel_metres()
    x, y = nearest_m(x, camera[0]), nearest_m(y, camera[1])
    return weather_at(level, time_s, x, y, camera, stage, seen_by)


def weather_at(level: Level, time_s: float, x, y, camera=None, stage: str = "final", seen_by: str = "") -> np.ndarray:
    """float32 `(…, 4)` of the same at world points; without a camera there is no horizon."""
    level = level_at(level, time_s)
    uniforms = weather_uniforms(level, time_s, seen_by)
    sky, storm = _simulated(level, uniforms, x, y)
    sky = _with_shots(level, sky, time_s, seen_by, x, y)
    painted_over, horizon_over = uniforms["u_weather_over_shots"]
    weight = np.zeros_like(sky)
    if stage != "simulated" and uniforms["u_weather_painted"]:
        painted = sample_wrapped(level.layers["weather"].array, *paint_place(level, time_s, x, y))
        weight = painted[..., 3:] * painted_over
        sky = sky + (painted[..., :3] - sky) * weight
    if stage in ("horizon", "final") and camera is not None:
        start, end, coverage, kind = uniforms["u_weather_horizon"]
        away = np.hypot(x - camera[0], y - camera[1])
        seen = storm * (1 - step(*HIDDEN_M, away))  # a storm shows from afar
        share = (step(start, end, away) * (1 - seen))[..., None] * (1 - weight) * horizon_over
        sky = sky + (np.array([coverage, 0.0, kind]) - sky) * share
    if stage == "final":
        sky = pulled(sky)
    return np.concatenate([sky, weight.max(axis=-1, keepdims=True)], -1).astype(np.float32)


def pulled(sky: np.ndarray) -> np.ndarray:
    """Coverage, precipitation and gradient coordinate (Z03) of coverage, precipitation and type (Z04)."""
    coverage, rain, kind = np.moveaxis(sky, -1, 0)
    coverage = coverage + (np.maximum(coverage, RAINY) - coverage) * rain
    return np.stack([coverage, rain, 0.5 * kind + (1 - 0.5 * kind) * rain], -1)


def _with_shots(level: Level, sky: np.ndarray, time_s: float, seen_by: str, x, y) -> np.ndarray:
    """The simulated sky under those of shots (Z20)."""
    for seen in shots_at(level, time_s, seen_by):
        east, north, share = shot_place(level, seen, time_s)
        own = sample_wrapped(level.skies[seen.shot.map].astype(np.float32), x - east, y - north)
        sky = sky + (own - sky) * share
    return sky


def _simulated(level: Level, uniforms: dict, x, y) -> tuple[np.ndarray, np.ndarray]:
    """Coverage, precipitation and type by the simulation alone, and how much of the storm's clouds there is."""
    coverage, kind, rain, variety = uniforms["u_weather_bias"]
    moved, turn = uniforms["u_weather_moved"], uniforms["u_weather_turn"]
    even = [_even_noise(level.settings.level.seed, x - moved[0], y - moved[1], shift, turn) for shift in SHIFTS]
    storm = np.zeros_like(even[0])
    count = uniforms["u_weather_areas"]
    for at, own in zip(uniforms["u_weather_area"][:count], uniforms["u_weather_area_sky"][:count], strict=True):
        here = at[3] * (1 - step(0.5 * at[2], at[2], np.hypot(x - at[0], y - at[1])) if at[2] > 0 else 1.0)
        coverage, kind, rain = (
            mean + (to - mean) * here for mean, to in zip((coverage, kind, rain), own[:3], strict=True)
        )
    if uniforms["u_storm"][3] > 0:
        wet, storm = storm_share(uniforms, x, y, even[3])
        rain = np.maximum(rain, wet)
        coverage, kind = (np.maximum(mean, mean + (most - mean) * storm)
                          for mean, most in ((coverage, CLOUDS), (kind, KIND)))  # fmt: skip
    threshold = 1 - rain * (1 + SOFT)
    sky = spread(coverage, variety, even[0], GAPS), step(threshold, threshold + SOFT, even[2])
    return np.stack([*sky, spread(kind, variety, even[1], REGIONS)], -1), storm


def spread(mean, variety: float, even: np.ndarray, soft: float) -> np.ndarray:
    """Numbers in 0 … 1 of a mean from evenly spread ones: little and much of it, `soft` in between."""
    soft = np.maximum(np.minimum(soft, np.minimum(mean, 1 - np.asarray(mean))), 1e-3)
    return mean + variety * (step(1 - mean - soft, 1 - mean + soft, even) - mean)


def _even_noise(seed: int, x, y, shift: tuple[float, float], turn) -> np.ndarray:
    """The noise in its present state, evenly spread over 0 … 1."""
    noise = sample_wrapped(weather_noise(seed), x + shift[0] * TILE_M, y + shift[1] * TILE_M, 0.5)
    value = (
        noise[..., 0] * turn[0] + noise[..., 1] * turn[1] + FINE * (noise[..., 2] * turn[2] + noise[..., 3] * turn[3])
    )
    return 1 / (1 + np.exp(-1.702 * value / math.hypot(1.0, FINE)))  # close to the normal distribution's integral


def sample_wrapped(array: np.ndarray, x, y, centre: float = 0.0) -> np.ndarray:
    """Bilinear on the torus at metres from its middle; samples stand at `centre` of their cell (0: at its corner)."""
    side = array.shape[0]
    u, v = ((np.asarray(at, np.float64) / TILE_M + 0.5) * side - centre for at in (x, y))
    col, row = np.floor(u).astype(np.int64), np.floor(v).astype(np.int64)
    fu, fv = (u - col)[..., None], (v - row)[..., None]
    col0, col1, row0, row1 = col % side, (col + 1) % side, row % side, (row + 1) % side
    south = array[row0, col0] * (1 - fu) + array[row0, col1] * fu
    north = array[row1, col0] * (1 - fu) + array[row1, col1] * fu
    return south * (1 - fv) + north * fv
