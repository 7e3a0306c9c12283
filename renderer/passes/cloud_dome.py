"""Clouds as the sea mirrors them: the sky over the camera, seen from the sea's level, in a small map (Z17, L02)."""

from __future__ import annotations

from ..frame import Frame
from ..kept_map import KeptMap, at_whole, kept_map
from ..uniforms import set_uniforms
from .clouds import air_uniforms, bind_cloud_textures, cloud_uniforms, shown
from .weather import make_map, weather_kept

EVERY_S = 2.0  # the map is that of whole multiples of this time
EVERY_M = 200.0  # and of places so far apart
EYE_M = 2.0


def draw(frame: Frame) -> None:
    if not shown(frame):
        return
    side = frame.tier.cloud_dome
    made = kept_map(frame, "cloud_dome", (side, side))  # hemispherical octahedral: premultiplied light, transmittance
    frame.textures["u_cloud_dome"] = made.texture
    _make(frame, made)


def bind_weather_of(frame: Frame, name: str) -> tuple:
    """Bind the weather map of a frame of `at_whole`, kept under a name; returns its key."""
    made = weather_kept(frame, name)
    make_map(frame, made, "final")
    frame.textures["u_weather"] = made.texture
    return made.key


def _make(frame: Frame, made: KeptMap) -> None:
    whole = at_whole(frame, EVERY_S, EVERY_M)
    bind_cloud_textures(whole)
    weather = bind_weather_of(whole, "weather_dome")
    shader = whole.shader("cloud_dome.glsl")
    values = {
        **cloud_uniforms(whole), "u_eye_m": EYE_M, "u_dome_side": float(made.size[0]),
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
    frame.stats["cloud_dome"] = made.size[0] ** 2
