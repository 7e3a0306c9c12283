"""Clouds in volume: an image of half the picture's sides, laid over sky and land (Z12 to Z17)."""

from __future__ import annotations

from ...level.cloud_air import air_uniforms
from ...level.cloud_profile import profile_table
from ..cloud_image import ORDER, CloudHistory, CloudImage
from ..cloud_light import light_uniforms
from ..frame import Frame
from ..uniforms import set_uniforms
from .cloud_history import advance, seen_now

REACH_M = 60_000.0
AROUND_S, AROUND_M = 2.0, 200.0  # clouds all round are those of whole multiples of this time, of places so far apart
AROUND_EYE_M = 2.0


def shown(frame: Frame) -> bool:
    """Whether the picture has clouds in volume."""
    return frame.level.settings.clouds.on and "clouds" in frame.show and "sky" in frame.show


def half(size: tuple[int, int]) -> tuple[int, int]:
    """Sides of the clouds' own image."""
    return (size[0] + 1) // 2, (size[1] + 1) // 2


def draw(frame: Frame) -> None:
    if not shown(frame):
        return
    make_image(frame)
    _composite(frame)


def make_image(frame: Frame) -> None:
    """The clouds' image of this frame, marched as a whole or a sixteenth and the rest remembered."""
    history = _history(frame)
    values = cloud_uniforms(frame)
    values["u_ray_centre"] = tuple(float(v) for v in -frame.matrices.view[2])  # samples of a picture share one image

    def march(image: CloudImage, pixel: tuple[float, float, float]) -> None:
        """March the pixels that `pixel` says (shaders/clouds.glsl) into an image."""
        at = {"u_cloud_size": tuple(map(float, history.size)), "u_cloud_pixel": pixel}
        image.framebuffer.use()
        march_met(frame, values | at)

    if frame.live:
        advance(frame, history, march)
    elif frame.index == 0 or history.seen is None:
        march(history.image, (0.0, 0.0, 1.0))
        history.seen, history.painted = seen_now(frame), frame.level.layer_revision("weather")
        history.settled = len(ORDER)
        frame.stats["clouds_marched"] = history.size[0] * history.size[1]
    frame.textures |= dict(zip(("u_clouds", "u_clouds_depth"), history.image.textures, strict=True))


def march_met(frame: Frame, values: dict) -> None:
    """Cheap steps for all pixels of the target in use, full ones by the depth test for those that meet cloud (Z14)."""
    ctx = frame.renderer.ctx
    ctx.enable(ctx.DEPTH_TEST)
    for defines, passes in (({"CHEAP_STEPS": ""}, "1"), ({}, ">")):
        ctx.depth_func = passes
        shader = frame.shader("clouds.glsl", **defines)
        set_uniforms(shader.program, values)
        shader.fullscreen()
    ctx.depth_func = "<"
    ctx.disable(ctx.DEPTH_TEST)


def _history(frame: Frame) -> CloudHistory:
    held, size = frame.renderer.kept, half(frame.size)
    history = held.get("clouds")
    if history is None or history.size != size:
        if history is not None:
            history.release()
        history = held["clouds"] = CloudHistory(frame.renderer.ctx, size)
    return history


def _composite(frame: Frame) -> None:
    ctx = frame.renderer.ctx
    frame.targets.picture.use()
    ctx.enable(ctx.BLEND)
    ctx.blend_func = ctx.ONE, ctx.SRC_ALPHA
    frame.shader("cloud_composite.glsl").fullscreen()
    ctx.disable(ctx.BLEND)


def cloud_uniforms(frame: Frame) -> dict:
    """Values of clouds.glsl, cloud_light.glsl and cloud_march.glsl that are no settings; binds textures."""
    level, clouds = frame.level, frame.level.settings.clouds
    bind_cloud_textures(frame)
    camera = frame.matrices.position
    return {
        **air_uniforms(level, frame.time_s),
        **light_uniforms(frame.sky.light),
        "u_planet_m": clouds.planet_km * 1000.0,
        "u_eye_m": float(camera[2] - level.mean_sea_m),
        "u_cloud_camera": tuple(float(v) for v in camera[:2]),
        "u_cloud_reach_m": REACH_M,
        "u_cloud_steps": frame.tier.cloud_steps,
    }


def bind_cloud_textures(frame: Frame) -> None:
    """Noises and height curves of level/clouds.glsl."""
    frame.textures |= frame.renderer.clouds.textures(profile_table(frame.level.settings))
