"""Shadows of the clouds in volume: how much of the sun comes through them to the sea's level (Z19).

A map round the camera in whole texels, so that it doesn't crawl; higher places read it slid along the sun.
"""

from __future__ import annotations

import numpy as np

from ..frame import Frame
from ..uniforms import set_uniforms
from .clouds import air_uniforms, bind_cloud_textures, shown

REACH_M = 8000.0  # half the map's side
LOWEST_SUN = 0.08  # sine of the elevation below which shadows grow no longer


class CloudShadow:
    """The texture, R16F transmittance, and what it was made for."""

    def __init__(self, ctx, side: int) -> None:
        self.side = side
        self.texture = ctx.texture((side, side), 1, dtype="f2")
        self.texture.filter = ctx.LINEAR, ctx.LINEAR
        self.texture.repeat_x = self.texture.repeat_y = False
        self.framebuffer = ctx.framebuffer([self.texture])
        self.key: tuple = ()

    def release(self) -> None:
        self.framebuffer.release()
        self.texture.release()


def falls(frame: Frame) -> bool:
    """Whether clouds throw shadows in this picture."""
    settings = frame.level.settings
    return (
        shown(frame) and settings.clouds.shadows > 0 and settings.light.shadows and frame.renderer.sky.light.sun.any()
    )


def draw(frame: Frame) -> None:
    if not falls(frame):
        return
    made, side = frame.renderer.kept.get("cloud_shadow"), frame.tier.cloud_shadow[0]
    if made is None or made.side != side:
        if made is not None:
            made.release()
        made = frame.renderer.kept["cloud_shadow"] = CloudShadow(frame.renderer.ctx, side)
    texel = 2 * REACH_M / side
    middle = np.round(frame.matrices.position[:2] / texel) * texel
    sun = frame.uniforms["u_sun_direction"].astype(np.float64)
    sine = max(float(sun[2]), LOWEST_SUN)
    clouds = frame.level.settings.clouds
    frame.uniforms |= {
        "u_cloud_shadow_place": (*(float(v) for v in middle), REACH_M, clouds.shadows),
        "u_cloud_shadow_far": 1.0 - frame.renderer.sky.light.cover,
        "u_cloud_shadow_slant": tuple(float(v) for v in sun[:2] / sine),
    }
    frame.textures["u_cloud_shadow"] = made.texture
    frame.defines["CLOUD_SHADOW"] = ""
    _make(frame, made, sine)


def _make(frame: Frame, made: CloudShadow, sine: float) -> None:
    bind_cloud_textures(frame)
    level, place = frame.level, frame.uniforms["u_cloud_shadow_place"]
    shader = frame.shader("cloud_shadow.glsl")
    values = {
        **air_uniforms(level, frame.time_s),
        "u_planet_m": level.settings.clouds.planet_km * 1000.0,
        "u_eye_m": 0.0,
        "u_cloud_camera": place[:2],
        "u_shadow_steps": frame.tier.cloud_shadow[1],
        "u_shadow_sine": sine,
        "u_shadow_texels": float(made.side),
    }
    settings = level.settings
    weather = frame.renderer.kept["weather"].key
    key = (*values.values(), place, frame.uniforms["u_cloud_shadow_slant"], weather, settings.clouds,
           settings.cloud_terms, frame.textures["u_cloud_shape"], shader.generation)  # fmt: skip
    if made.key == key:
        return
    made.framebuffer.use()
    set_uniforms(shader.program, values)
    shader.fullscreen()
    made.key = key
    frame.stats["cloud_shadows"] = made.side**2
