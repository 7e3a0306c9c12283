"""What the high layers' shaders ask for: their patterns and how far each has moved (Z13)."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path

import moderngl
import numpy as np

from ..level import high_clouds, textures
from .cache import cached

SEED = 11
# tile in metres (lib/high_clouds.glsl), share of the wind, turn from it in degrees
LAYERS = ((46000.0, 1.0, 0.0), (31000.0, 0.75, 11.0), (13000.0 * 17000.0, 0.5, -18.0), (61000.0, 0.35, 24.0))


def bind_high(frame) -> dict[str, str]:
    """Bind them where the picture has high layers; the defines of a program that shows them."""
    clouds, kept = frame.level.settings.clouds, frame.renderer.kept
    if not clouds.on or "clouds" not in frame.show or clouds.cirrus + clouds.alto <= 0 or frame.sky.light.even:
        return {}
    bind_patterns(frame, kept)
    return {"HIGH_CLOUDS": ""}


def bind_patterns(frame, kept: dict) -> None:
    """The texture and the uniforms of lib/high_clouds.glsl."""
    if "high_clouds" not in kept:
        kept["high_clouds"] = _texture(frame.renderer.ctx)
    frame.textures["u_high_clouds"] = kept["high_clouds"]
    frame.uniforms |= high_uniforms(frame)


def high_uniforms(frame) -> dict:
    """How far each pattern has moved, within what it repeats after."""
    level = frame.level
    clouds, heading = level.settings.clouds, level.settings.weather.heading_deg
    moved, heading = [], math.radians(heading)
    for tile_m, share, turn in LAYERS:
        turned = math.radians(turn)  # clockwise; the second number is to the left of the wind
        gone = share * clouds.high_mps * frame.time_s
        moved += [gone * math.cos(turned) % tile_m, -gone * math.sin(turned) % tile_m]
    return {
        "u_high_moved_ice": tuple(moved[:4]),
        "u_high_way": (math.sin(heading), math.cos(heading)),
        "u_high_moved_heaps": tuple(moved[4:]),
        "u_planet_m": clouds.planet_km * 1000.0,
        "u_eye_m": float(frame.matrices.position[2] - level.mean_sea_m),
    }


def patterns() -> np.ndarray:
    """The four patterns, uint8 `(512, 512, 4)`, made once and kept on disk."""
    make, others = partial(high_clouds.high_clouds, SEED), Path(textures.__file__).read_text()
    return cached("high_clouds", make, high_clouds.__file__, others)


def _texture(ctx):
    made = patterns()
    texture = ctx.texture(made.shape[1::-1], 4, np.ascontiguousarray(made).tobytes())
    texture.build_mipmaps()
    texture.filter = moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR
    return texture
