"""What the editor lays over the picture: brush ring on the ground, walkable depth, outline, lines (D31, D40)."""

from __future__ import annotations

import numpy as np

from ...level.flow_arrows import flow_arrows
from ..frame import Frame


def draw(frame: Frame) -> None:
    overlays, ctx = frame.overlays, frame.renderer.ctx
    on_ground = overlays.ring or overlays.walkable or overlays.outline or overlays.centre
    if not (on_ground or overlays.lines or overlays.arrows):
        return
    frame.targets.display.use()
    width, height = frame.full_size
    frame.uniforms["u_size"] = float(width), float(height)
    frame.uniforms["u_pixel_angle"] *= frame.size[1] / height
    ctx.enable(ctx.BLEND)
    ctx.blend_func = ctx.SRC_ALPHA, ctx.ONE_MINUS_SRC_ALPHA
    if on_ground:
        _ground(frame)
    lines = list(overlays.lines)
    if overlays.arrows:
        lines += flow_arrows(frame.level, *frame.matrices.position)
    if lines:
        _lines(frame, lines)
    ctx.disable(ctx.BLEND)


def _ground(frame: Frame) -> None:
    overlays, ring = frame.overlays, frame.overlays.ring
    defines = {}
    if overlays.walkable:
        defines["WALKABLE"] = ""
        frame.textures["u_walkable"] = frame.renderer.uploader.walkable(frame.level)
    frame.uniforms["u_ring"] = (ring.x, ring.y, ring.radius_m, ring.falloff) if ring else (0.0, 0.0, 0.0, 0.0)
    frame.uniforms["u_outline"], frame.uniforms["u_centre"] = overlays.outline, overlays.centre
    frame.shader("overlay.glsl", **defines).fullscreen()


def _lines(frame: Frame, lines: list) -> None:
    segments = []
    for line in lines:
        points = np.asarray(line, np.float64).reshape(-1, 3) - frame.matrices.position
        segments.append(np.concatenate([points[:-1], points[1:]], axis=1))
    data = np.concatenate(segments).astype(np.float32)
    if not len(data):
        return
    ctx, shader = frame.renderer.ctx, frame.shader("lines.glsl")
    buffer = ctx.buffer(data.tobytes())
    array = ctx.vertex_array(shader.program, [(buffer, "3f 3f/i", "in_start", "in_end")])
    array.render(ctx.TRIANGLE_STRIP, vertices=4, instances=len(data))
    array.release()
    buffer.release()
