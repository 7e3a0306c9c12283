"""Clouds as the sea mirrors them: the sky over the camera, seen from the sea's level, in a small map (Z17, L02).

What mirrors them (lobes.py) is made with them. Live pictures make both ahead of the clock (slow_map.py).
"""

from __future__ import annotations

from ...level.cloud_air import air_uniforms
from ..frame import Frame
from ..kept_map import at_whole, kept_map
from ..slow_map import Making, Slow, in_strips, keep_up
from ..uniforms import set_uniforms
from .clouds import AROUND_EYE_M, AROUND_M, AROUND_S, bind_cloud_textures, cloud_uniforms, shown
from .lobes import lobes_making
from .weather import weather_kept, weather_making


def draw(frame: Frame) -> None:
    if not shown(frame):
        return
    keep_up(frame, SLOW)
    frame.textures["u_cloud_dome"] = frame.renderer.kept["cloud_dome"].texture


def _make(frame: Frame, ending: str, strips: int) -> list[Making]:
    """The weather, the clouds under it in a hemispherical octahedron: premultiplied light and transmittance; lobes."""
    whole = at_whole(frame, AROUND_S, AROUND_M)
    bind_cloud_textures(whole)
    weather = weather_making(whole, weather_kept(whole, "weather_dome" + ending), strips=strips)
    whole.textures["u_weather"] = weather.made.texture
    dome = _dome(whole, weather.key, ending, strips)
    whole.textures["u_cloud_dome"] = dome.made.texture
    return [weather, dome, lobes_making(whole, dome.key, ending, strips)]


def _dome(whole: Frame, weather: tuple, ending: str, strips: int) -> Making:
    side = whole.tier.cloud_dome
    made = kept_map(whole, "cloud_dome" + ending, (side, side))
    shader = whole.shader("cloud_dome.glsl")
    values = {
        **cloud_uniforms(whole), "u_eye_m": AROUND_EYE_M, "u_dome_side": float(side),
        "u_cloud_steps": tuple(0.5 * steps for steps in whole.tier.cloud_steps),
    }  # fmt: skip
    settings, sun = whole.level.settings, tuple(float(v) for v in whole.uniforms["u_sun_direction"])
    key = (weather, *air_uniforms(whole.level, whole.time_s).values(), values["u_cloud_camera"], settings.clouds,
           settings.cloud_terms, settings.fog, "air" in whole.show, whole.sky.light, sun,
           whole.textures["u_cloud_shape"], shader.generation)  # fmt: skip

    def draw() -> None:
        shader = whole.shader("cloud_dome.glsl")
        set_uniforms(shader.program, values)
        shader.fullscreen()

    return Making(made, key, in_strips(made, draw, strips), "cloud_dome")


SLOW = Slow(("weather_dome", "cloud_dome", "lobes"), AROUND_S, _make)
