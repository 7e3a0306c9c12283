"""Lids inside hulls (D12): depth only, after what lies under the water was copied, so that no sea is in a boat."""

from __future__ import annotations

from ...level.hull_lid import lid
from ..frame import Frame
from ..props import Buffers, Placed, buffers, placed, seen
from .scatter import eye


def lidded(things: list[Placed]) -> list[Placed]:
    """The lids of those that float and stay dry, as things in their places."""
    found = []
    for thing in things:
        if thing.prop.floats and thing.prop.dry:
            line_m = float(thing.mesh.box[0, 2]) + thing.pose.draft_m / thing.prop.scale
            mesh = lid(thing.mesh, round(line_m, 6))
            found += [Placed(thing.prop, mesh, thing.pose)] if mesh else []
    return found


def draw(frame: Frame) -> None:
    if not frame.level.settings.water.on:
        return
    things = lidded(placed(frame))
    ctx, target = frame.renderer.ctx, frame.targets.gbuffer
    held: Buffers = buffers(frame, "lids")
    frame.renderer.uploader.sent["props"] += held.keep(things, shaded=False)
    if not things:
        return
    seen_from = eye(frame)
    things = seen(things, seen_from.position, seen_from.planes, seen_from.pixel)
    shader = frame.shader("lids.glsl")
    target.use()
    shown = target.color_mask
    target.color_mask = tuple((False,) * 4 for _ in target.color_attachments)
    ctx.enable(ctx.DEPTH_TEST)
    try:
        held.draw("lids", shader, things, frame.matrices.position)
    finally:
        ctx.disable(ctx.DEPTH_TEST)
        target.color_mask = shown
