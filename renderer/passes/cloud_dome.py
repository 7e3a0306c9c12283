"""Clouds as the sea mirrors them: the sky over the camera, seen from the sea's level, in a small map (Z17, L02)."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from ..frame import Frame
from ..uniforms import set_uniforms
from .clouds import air_uniforms, bind_cloud_textures, cloud_uniforms, shown
from .weather import WeatherMap, make_map

EVERY_S = 2.0  # the map is that of whole multiples of this time
EVERY_M = 200.0  # and of places so far apart
EYE_M = 2.0


class CloudDome:
    """The texture, hemispherical octahedral premultiplied radiance and transmittance, and what it was made for."""

    def __init__(self, ctx, side: int) -> None:
        self.side = side
        self.texture = ctx.texture((side, side), 4, dtype="f2")
        self.texture.filter = ctx.LINEAR, ctx.LINEAR
        self.texture.repeat_x = self.texture.repeat_y = False
        self.framebuffer = ctx.framebuffer([self.texture])
        self.key: tuple = ()

    def release(self) -> None:
        self.framebuffer.release()
        self.texture.release()


def draw(frame: Frame) -> None:
    if not shown(frame):
        return
    made, side = frame.renderer.kept.get("cloud_dome"), frame.tier.cloud_dome
    if made is None or made.side != side:
        if made is not None:
            made.release()
        made = frame.renderer.kept["cloud_dome"] = CloudDome(frame.renderer.ctx, side)
    frame.textures["u_cloud_dome"] = made.texture
    _make(frame, made)


def at_whole(frame: Frame, every_s: float, every_m: float) -> Frame:
    """The frame as it is at a whole multiple of a time and of a distance: what is made for it stays for a while."""
    position = np.array(frame.matrices.position, np.float64)
    position[:2] = np.round(position[:2] / every_m) * every_m
    return dataclasses.replace(
        frame, time_s=math.floor(frame.time_s / every_s) * every_s, textures=dict(frame.textures),
        uniforms={**frame.uniforms, "u_camera": tuple(position)},
        matrices=dataclasses.replace(frame.matrices, position=position),
    )  # fmt: skip


def bind_weather_of(frame: Frame, name: str) -> tuple:
    """Bind the weather map of a frame of `at_whole`, kept under a name; returns its key."""
    held = frame.renderer.kept
    made = held.get(name) or held.setdefault(name, WeatherMap(frame.renderer.ctx))
    make_map(frame, made, "final")
    frame.textures["u_weather"] = made.texture
    return made.key


def _make(frame: Frame, made: CloudDome) -> None:
    whole = at_whole(frame, EVERY_S, EVERY_M)
    bind_cloud_textures(whole)
    weather = bind_weather_of(whole, "weather_dome")
    shader = whole.shader("cloud_dome.glsl")
    values = {
        **cloud_uniforms(whole), "u_eye_m": EYE_M, "u_dome_side": float(made.side),
        "u_cloud_steps": tuple(0.5 * steps for steps in frame.tier.cloud_steps),
    }  # fmt: skip
    settings, sun = frame.level.settings, tuple(float(v) for v in frame.uniforms["u_sun_direction"])
    key = (weather, *air_uniforms(whole.level, whole.time_s).values(), values["u_cloud_camera"], settings.clouds,
           settings.cloud_terms, settings.fog, "air" in frame.show, frame.renderer.sky.light, sun,
           whole.textures["u_cloud_shape"], shader.generation)  # fmt: skip
    if made.key == key:
        return
    made.framebuffer.use()
    set_uniforms(shader.program, values)
    shader.fullscreen()
    made.key = key
    frame.stats["cloud_dome"] = made.side**2
