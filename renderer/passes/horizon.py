"""The sea beyond the mesh, a ring of eight triangles to infinity with the mesh's coordinates and shading (H21)."""

from __future__ import annotations

from ..frame import Frame
from .sea import below_defines, water_shown


def draw(frame: Frame) -> None:
    if not water_shown(frame):
        return
    ctx = frame.renderer.ctx
    frame.targets.gbuffer.use()
    shader = frame.shader("sea.glsl", HORIZON="", **below_defines(frame))
    # Under the mesh by a little, where that lies flat: no row of background between them.
    shader.program["u_horizon_m"].value = 0.985 * frame.tier.sea_distance_m
    vertices = frame.renderer.kept.get("horizon")
    if vertices is None or vertices[0] != (id(shader), shader.generation):
        vertices = (id(shader), shader.generation), ctx.vertex_array(shader.program, [])
        frame.renderer.kept["horizon"] = vertices
    ctx.enable(ctx.DEPTH_TEST)
    vertices[1].render(vertices=24)
    ctx.disable(ctx.DEPTH_TEST)
