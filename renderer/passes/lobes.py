"""What smooth and rough things mirror of the sky: six octahedral maps, made anew when the sky changes (L02).

Maps of the sphere in one plain texture take the place of a cube with mip levels: every driver can draw into it.
"""

from __future__ import annotations

import numpy as np

from ..frame import Frame
from ..high_layers import bind_high
from ..kept_map import KeptMap, at_whole, kept_map
from ..uniforms import set_uniforms
from .cloud_dome import EVERY_M, EVERY_S, EYE_M
from .clouds import shown

SIZES = (192, 64, 32, 32, 16, 16)  # lib/lobes.glsl has the same
GROUND_ALBEDO = 0.13  # of what lies below the horizon: half sea, half land


def draw(frame: Frame) -> None:
    kept, sky = frame.renderer.kept, frame.renderer.sky
    lobes = kept_map(frame, "lobes", (max(SIZES), sum(SIZES)))
    cirrus = float("clouds" in frame.show and not sky.light.even and not frame.level.settings.clouds.on)
    dome, defines, drawn = None, {}, frame
    if shown(frame):  # as the dome is: for a while and a place
        dome, drawn = kept["cloud_dome"].key, at_whole(frame, EVERY_S, EVERY_M)
        defines = {"CLOUDS": "", **bind_high(drawn)}
        drawn.uniforms["u_eye_m"] = EYE_M
    shader = drawn.shader("lobes.glsl", **defines)
    fog = frame.uniforms["u_fog_density"], frame.uniforms["u_fog_height_m"]
    sun = tuple(float(v) for v in frame.uniforms["u_sun_direction"])
    clouds = frame.level.settings.clouds
    high = (clouds.cirrus, clouds.alto, clouds.high_m, clouds.high_mps) if dome else ()
    key = sky.light, sun, cirrus, fog, frame.textures["u_noise"], dome, high, shader.generation
    if lobes.key != key:
        _make(frame, lobes, shader, cirrus)
        lobes.key = key
    frame.textures["u_lobes"] = lobes.texture


def _make(frame: Frame, lobes: KeptMap, shader, cirrus: float) -> None:
    light, direction = frame.renderer.sky.light, frame.uniforms["u_sun_direction"]
    down = light.on_level(max(float(direction[2]), 0.0))
    ground = np.ones(3) if light.even else down * GROUND_ALBEDO / np.pi
    shader.program["u_ground_radiance"].value = tuple(float(v) for v in ground)
    set_uniforms(shader.program, {"u_cirrus": cirrus})
    top = 0
    for level, size in enumerate(SIZES):
        lobes.framebuffer.use()
        lobes.framebuffer.viewport = 0, top, size, size
        shader.program["u_level"].value = level
        shader.fullscreen()
        top += size
