"""What smooth and rough things mirror of the sky: six octahedral maps, made anew when the sky changes (L02).

Live pictures make them for a moment ahead (slow_map.py); as a day goes on, their light goes on with the sky's.

Maps of the sphere in one plain texture take the place of a cube with mip levels: every driver can draw into it.
"""

from __future__ import annotations

import numpy as np

from ..frame import Frame
from ..high_layers import bind_high
from ..kept_map import kept_map
from ..slow_map import Making, Step, in_strips
from ..uniforms import set_uniforms
from .clouds import AROUND_EYE_M, shown

SIZES = (192, 64, 32, 32, 16, 16)  # lib/lobes.glsl has the same
GROUND_ALBEDO = 0.13  # of what lies below the horizon: half sea, half land
STRIPS = 1 / 4, 3 / 4, 1 / 4, 1 / 4, 1 / 8, 1 / 8  # of a map's strips: each is about as dear as the others


def draw(frame: Frame) -> None:
    """Where clouds are shown, their pass has made them."""
    if not shown(frame):
        making = lobes_making(frame)
        if making.made.key != making.key:
            for step in making.steps:
                step.draw()
            making.made.key = making.key
    lobes = frame.renderer.kept["lobes"]
    frame.textures["u_lobes"] = lobes.texture
    frame.uniforms["u_lobes_gone_on"] = tuple(float(v) for v in _sky_up(frame.sky.light) / lobes.seen)


def lobes_making(frame: Frame, dome: tuple | None = None, ending: str = "", strips: int = 1) -> Making:
    """What makes the maps; `dome` is what the clouds that they mirror, if any, are made for."""
    sky, defines = frame.sky, {}
    lobes = kept_map(frame, "lobes" + ending, (max(SIZES), sum(SIZES)))
    cirrus = float("clouds" in frame.show and not sky.light.even and not frame.level.settings.clouds.on)
    if dome:
        defines = {"CLOUDS": "", **bind_high(frame)}
        frame.uniforms["u_eye_m"] = AROUND_EYE_M
    shader = frame.shader("lobes.glsl", **defines)
    fog = frame.uniforms["u_fog_density"], frame.uniforms["u_fog_height_m"]
    sun = tuple(float(v) for v in frame.uniforms["u_sun_direction"])
    clouds = frame.level.settings.clouds
    high = (clouds.cirrus, clouds.alto, clouds.high_m, clouds.high_mps) if dome else ()
    key = sky.light, sun, cirrus, fog, frame.textures["u_noise"], dome, high, shader.generation
    return Making(lobes, key, _steps(frame, lobes, defines, cirrus, strips), "lobes")


def _sky_up(light) -> np.ndarray:
    """Light of the sky from above, `(3,)`, times the unit in use."""
    c = light.harmonics
    return c[0] * 0.282095 + c[2] * 0.488603 + c[6] * 0.630784 + 1e-12


def _steps(frame: Frame, lobes, defines: dict, cirrus: float, strips: int) -> list[Step]:
    light, direction = frame.sky.light, frame.uniforms["u_sun_direction"]
    down = light.on_level(max(float(direction[2]), 0.0))
    ground = np.ones(3) if light.even else down * GROUND_ALBEDO / np.pi
    values = {"u_ground_radiance": tuple(float(v) for v in ground), "u_cirrus": cirrus}
    steps, top = [], 0
    for level, size in enumerate(SIZES):

        def draw(level: int = level) -> None:
            shader = frame.shader("lobes.glsl", **defines)
            set_uniforms(shader.program, {**values, "u_level": level})
            shader.fullscreen()
            lobes.seen = _sky_up(light)

        steps += in_strips(lobes, draw, max(int(strips * STRIPS[level]), 1), (0, top, size, size))
        top += size
    return steps
