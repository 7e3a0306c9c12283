"""The sky's part of the kit: weather map and cloud density, their uniforms over time, their noises and curves."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ....level import Level
from ....level.beat import beat
from ....level.cloud_air import air_uniforms
from ....level.cloud_noise import CLOUD_NOISES, SEED
from ....level.cloud_profile import profile_table
from ....level.setting_uniforms import settings_uniforms
from ....level.weather import FINE_RATE, TILE_M, middle_m, weather_at, weather_noise, weather_uniforms
from ....level.weather_keys import level_at
from ....level.wind import moved_m
from .changes import knots_of
from .data import KitData, Made
from .phases import Phase, straight

PROBE_TIMES_S = (0.0, 61.0, 3600.25, 86_400.5)
PROBES_A_TIME = 25
COLUMNS = {"u_cloud_shape": 16, "u_cloud_detail": 8, "u_cloud_detail_half": 8}  # shaders/cloud_noise.glsl has them too


def has_sky(level: Level) -> bool:
    return level.settings.clouds.on


def sky_made(level: Level) -> Made:
    """What the sky's uniforms are."""
    return Made(lambda t: sky_uniforms(level, t), lambda: sky_maps(level), [*_grown(level), *_moved(level)])


def sky_uniforms(level: Level, t: float) -> dict:
    """All that the sky's GLSL is given at a time, samplers excepted; the camera over the middle of the level."""
    dated = level_at(level, t)
    weather = weather_uniforms(dated, t)
    if weather["u_storm"][3] == 0:  # where one would be says nothing
        weather["u_storm"] = (0.0, 0.0, 0.0, 0.0)
    return {
        **settings_uniforms(dated.settings),
        **weather,
        **air_uniforms(dated, t),
        "u_cloud_camera": tuple(side / 2 for side in level.grid.extent_m),
    }


def _grown(level: Level) -> list[Phase]:
    """Of clouds that grow, decay and rise in themselves."""
    settings, found = level.settings, []
    weather, clouds = settings.weather, settings.clouds
    rate = float(weather.evolve) / weather.growth_s
    for at, hz in ((0, rate), (2, FINE_RATE * rate)):
        found += [Phase("u_weather_turn", -1, at + n, 0.0, hz, form=form) for n, form in enumerate(("cos", "sin"))]
    risen = clouds.rise_mps * float(settings.cloud_terms.evolve)
    for part, hz in enumerate((risen / clouds.detail_m, 0.7 * risen / clouds.curl_m, -0.25 * risen / clouds.scale_m)):
        found.append(Phase("u_cloud_rise", -1, part, 0.0, hz))
    return found


def _moved(level: Level) -> list[Phase]:
    """Of air that the wind carries: in straight pieces while keys change the wind."""
    settings = level.settings
    clouds, middle, found = settings.clouds, middle_m(settings), []
    knots = knots_of(level) or [0.0]
    for part in (0, 1):
        off_m = float(middle[part])

        def tiles(t: float, part: int = part) -> float:
            return float(moved_m(level_at(level, t), t)[part]) / TILE_M

        for name in ("u_weather_moved", "u_weather_paint_moved")[: 2 if settings.weather.paint_drifts else 1]:
            found += straight(name, part, tiles, knots, scale=TILE_M, offset=off_m)
        for at, side_m in ((part, clouds.scale_m), (2 + part, clouds.detail_m)):
            folds = {"form": "fold", "scale": side_m, "hop": TILE_M / side_m, "first": off_m / side_m}
            found += straight("u_cloud_drift", at, tiles, knots, **folds)
    return found


def sky_maps(level: Level) -> dict[str, np.ndarray]:
    """Maps (rows, cols, channels) by sampler, row 0 south; uint8 or float32."""
    paint = level.layers["weather"]
    painted = np.zeros((1, 1, 6)) if paint.neutral else paint.array.astype(np.float16)  # as the editor's texture has it
    noises = {name: _noise(name) for name in CLOUD_NOISES}
    detail = noises["u_cloud_detail"]
    half = detail.reshape(*(n for side in detail.shape[:3] for n in (side // 2, 2)), 4).mean((1, 3, 5))
    noises["u_cloud_detail_half"] = np.round(half).astype(np.uint8)
    found = {name: _folded(cube, COLUMNS[name]) if name in COLUMNS else cube for name, cube in noises.items()}
    floats = {
        "u_cloud_profile": profile_table(level.settings).astype(np.float16)[..., None],
        "u_weather_noise": weather_noise(level.settings.level.seed),
        "u_layer_weather": painted[..., :4],
        "u_layer_weather_more": painted[..., 4:],
    }
    return found | {name: np.ascontiguousarray(values, "<f4") for name, values in floats.items()}


def _folded(cube: np.ndarray, columns: int) -> np.ndarray:
    """Layers of a cube beside each other, then above, from the south-west on: no side longer than 2048 texels."""
    layers, rows, cols, channels = cube.shape
    blocks = cube.reshape(layers // columns, columns, rows, cols, channels)
    return np.ascontiguousarray(blocks.transpose(0, 2, 1, 3, 4).reshape(-1, columns * cols, channels))


@lru_cache(maxsize=3)
def _noise(name: str) -> np.ndarray:
    return CLOUD_NOISES[name](SEED)


def sky_probes(data: KitData) -> list[dict]:
    """The twin's weather over places, for times that the kit reaches: only 0 where something is held."""
    rng = np.random.default_rng(12)
    camera, found = tuple(data.values["u_cloud_camera"].tolist()), []
    for t in PROBE_TIMES_S[: 1 if data.held else None]:
        beat()
        at = np.float32(rng.uniform(-0.5 * TILE_M, 0.5 * TILE_M, (PROBES_A_TIME, 2)) + camera).astype(np.float64)
        sky = weather_at(data.level, t, at[:, 0], at[:, 1], camera)
        found += [
            {"time_s": t, "at": place.tolist(), "weather": own.tolist()} for place, own in zip(at, sky, strict=True)
        ]
    return found
