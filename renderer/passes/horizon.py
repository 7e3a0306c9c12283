"""The sea wherever the mesh isn't, as a plane to infinity with the mesh's coordinates and shading (H21)."""

from __future__ import annotations

from ..frame import Frame
from .sea import Extent, below_defines, sea_extent, water_shown

UNDER_M = 30.0  # so far the plane goes on under the mesh, where that lies flat: no row of background between them


def _hole(frame: Frame, extent: Extent) -> tuple[float, float, float, float]:
    """Camera-relative rectangle that needs no plane; of no size where the camera may be outside the mesh."""
    if extent.circle is not None:
        return 0.0, 0.0, 0.0, 0.0
    x, y = frame.matrices.position[:2]
    west, south, east, north = extent.box_m
    return west - x + UNDER_M, south - y + UNDER_M, east - x - UNDER_M, north - y - UNDER_M


def draw(frame: Frame) -> None:
    if not water_shown(frame):
        return
    ctx = frame.renderer.ctx
    frame.targets.gbuffer.use()
    measured = {"UNMEASURED": ""} if frame.view.name == "triangle_area" else {}
    shader = frame.shader("sea.glsl", HORIZON="", **measured, **below_defines(frame))
    shader.program["u_horizon_hole"].value = tuple(float(v) for v in _hole(frame, sea_extent(frame)))
    vertices = frame.renderer.kept.get("horizon")
    if vertices is None or vertices[0] != (id(shader), shader.generation):
        vertices = (id(shader), shader.generation), ctx.vertex_array(shader.program, [])
        frame.renderer.kept["horizon"] = vertices
    ctx.enable(ctx.DEPTH_TEST)
    vertices[1].render(vertices=24)
    ctx.disable(ctx.DEPTH_TEST)
