"""Meshes from files into the G-buffer (D12), before what lies under the water is copied: what is in it shows."""

from __future__ import annotations

from ..frame import Frame
from ..props import buffers, placed, seen
from .scatter import eye


def draw(frame: Frame) -> None:
    things = placed(frame)
    seen_from, ctx = eye(frame), frame.renderer.ctx
    held = buffers(frame)
    frame.renderer.uploader.sent["props"] += held.keep(things)
    if not things:
        return
    things = seen(things, seen_from.position, seen_from.planes, seen_from.pixel)
    frame.targets.gbuffer.use()
    shader = frame.shader("props.glsl", **({"MARK": ""} if frame.view.name == "props" else {}))
    ctx.enable(ctx.DEPTH_TEST)
    triangles, instances = held.draw("picture", shader, things, frame.matrices.position)
    ctx.disable(ctx.DEPTH_TEST)
    frame.stats["prop_triangles"], frame.stats["props"] = triangles, instances
