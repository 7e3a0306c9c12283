"""What the editor lays over the picture: brush ring on the ground, walkable depth, outline, lines (D31, D40)."""

from __future__ import annotations

import numpy as np

from ...level.flow_arrows import OVER_M, flow_arrows
from ..frame import Frame


def draw(frame: Frame) -> None:
    overlays, ctx = frame.overlays, frame.renderer.ctx
    on_ground = overlays.ring or overlays.walkable or overlays.outline or overlays.centre
    if not (on_ground or overlays.lines or overlays.arrows or overlays.streamlines):
        return
    frame.targets.display.use()
    width, height = frame.full_size
    frame.uniforms["u_size"] = float(width), float(height)
    frame.uniforms["u_pixel_angle"] *= frame.size[1] / height
    ctx.enable(ctx.BLEND)
    ctx.blend_func = ctx.SRC_ALPHA, ctx.ONE_MINUS_SRC_ALPHA
    if on_ground:
        _ground(frame)
    if overlays.streamlines:
        high = np.array([0.0, 0.0, frame.level.sea_level_m + OVER_M, 0.0])
        _lines(frame, [line + high for line in overlays.streamlines.lines])
    if overlays.arrows:
        _lines(frame, flow_arrows(frame.level, *frame.matrices.position, dry=frame.view.layer == "flow"))
    _lines(frame, list(overlays.lines))
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
    """World polylines of x, y, z; those with a speed after it lie on the water, in its colour, behind land."""
    segments = []
    for line in lines:
        points = np.asarray(line, np.float64)
        eye = np.zeros(points.shape[1])
        eye[:3] = frame.matrices.position
        points = points - eye
        segments.append(np.concatenate([points[:-1], points[1:]], axis=1))
    if not segments or not sum(map(len, segments)):
        return
    data = np.concatenate(segments).astype(np.float32)
    ctx, water = frame.renderer.ctx, data.shape[1] == 8
    shader = frame.shader("lines.glsl", **({"ON_WATER": ""} if water else {}))
    buffer = ctx.buffer(data.tobytes())
    layout = "4f 4f/i" if water else "3f 3f/i"
    array = ctx.vertex_array(shader.program, [(buffer, layout, "in_start", "in_end")])
    array.render(ctx.TRIANGLE_STRIP, vertices=4, instances=len(data))
    array.release()
    buffer.release()
