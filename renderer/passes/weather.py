"""The weather map round the camera, made when anything that it follows from has changed (Z04)."""

from __future__ import annotations

from ...level.shots import shots_at
from ...level.weather import SIDE, STAGES, shot_uniforms, weather_noise, weather_uniforms
from ..frame import Frame
from ..kept_map import KeptMap, at_whole, kept_map
from ..slow_map import Making, Slow, in_strips, keep_up
from ..uniforms import set_uniforms

EVERY_S = 0.5  # the map is that of whole multiples of this time
EVERY_M = 32.0  # and, for the horizon round the camera, of places so far apart


def draw(frame: Frame) -> None:
    """For a while and a place: in that time the air goes a small part of a texel (137 m)."""
    if not frame.level.settings.clouds.on:
        return
    keep_up(frame, SLOW)
    frame.textures["u_weather"] = frame.renderer.kept[NAME].texture


def bind_map(frame: Frame, stage: str = "final") -> None:
    """Put the map as it is after one of STAGES where shaders read it, with clouds or without."""
    made = weather_kept(frame, f"weather_{stage}")
    make_map(frame, made, stage)
    frame.textures["u_weather" if stage == "final" else "u_weather_stage"] = made.texture


def weather_kept(frame: Frame, name: str) -> KeptMap:
    """A weather map kept under a name."""
    return kept_map(frame, name, (SIDE, SIDE), repeat=True)


def make_map(frame: Frame, made: KeptMap, stage: str) -> None:
    """Bring a map up to date as it is after one of STAGES."""
    making = weather_making(frame, made, stage)
    if made.key != making.key:
        frame.renderer.ctx.disable(frame.renderer.ctx.BLEND)
        making.steps[0].draw()
        made.key = making.key


def weather_making(frame: Frame, made: KeptMap, stage: str = "final", strips: int = 1) -> Making:
    """What makes a map as it is after one of STAGES at a frame's time."""
    level, uploader = frame.level, frame.renderer.uploader
    values = weather_uniforms(level, frame.time_s, frame.camera.id)
    shader = frame.shader("weather.glsl", **bind_weather(frame, values))
    camera = tuple(float(v) for v in frame.matrices.position[:2])
    key = (
        *(v.tobytes() if hasattr(v, "tobytes") else v for v in values.values()),
        stage,
        camera,
        level.settings.level.seed,
        level.layers["weather"],
        uploader.seen["layer_weather"],
        uploader.seen["u_weather_shot_skies"],
        shader.generation,
    )

    def draw() -> None:
        shader = frame.shader("weather.glsl", **bind_weather(frame, values))
        set_uniforms(shader.program, {**values, "u_stage": STAGES.index(stage), "u_map_side": float(SIDE)})
        shader.fullscreen()

    return Making(made, key, in_strips(made, draw, strips), "weather_texels")


def _make(frame: Frame, ending: str, strips: int) -> list[Making]:
    whole = at_whole(frame, EVERY_S, EVERY_M)
    return [weather_making(whole, weather_kept(whole, NAME + ending), strips=strips)]


NAME = "weather"
SLOW = Slow((NAME,), EVERY_S, _make)


def bind_weather(frame: Frame, values: dict) -> dict[str, str]:
    """Textures of level/weather.glsl; no defines."""
    uploader = frame.renderer.uploader
    frame.textures["u_layer_weather"] = uploader.layer(frame.level, "weather")
    frame.textures["u_layer_weather_more"] = uploader.textures["u_layer_weather_more"]
    shots = tuple(seen.shot.map for seen in shots_at(frame.level, frame.time_s, frame.camera.id))
    frame.textures["u_weather_shot_skies"] = uploader.shot_skies(frame.level, shots)
    frame.textures["u_weather_noise"] = uploader.weather_noise(frame.level, weather_noise)
    # whoever else draws the map may have asked without the camera
    frame.uniforms |= values | shot_uniforms(frame.level, frame.time_s, frame.camera.id)
    return {}
