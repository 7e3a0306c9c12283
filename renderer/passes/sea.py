"""The sea into the same G-buffer as the land (D01): the wave function on the morphing mesh, world-fixed vertices."""

from __future__ import annotations

import math

import numpy as np

from ...level.flow import current
from ...level.waves import largest_height_m
from ..frame import Frame
from ..mesh import Lod, View, mesh_uniforms, select
from ..uniforms import set_uniforms
from .terrain import chunk_mesh


def sea_chunks(frame: Frame) -> tuple[Lod, View, np.ndarray]:
    """What of the sea is drawn: rule, view and chunks; none where only high land is."""
    cell_m = frame.tier.sea_cell_m
    position = frame.matrices.position
    level, bounds = frame.level, frame.renderer.uploader.bounds
    top = 2 * largest_height_m(level)
    above = abs(position[2] - level.sea_level_m)
    half = math.ceil(frame.tier.sea_distance_m / cell_m)
    col, row = (math.floor(v / cell_m) for v in position[:2])
    lod = Lod(cell_m, frame.tier.sea_chunk, frame.tier.sea_reach, (col - half, row - half, col + half, row + half))
    view = View(position, frame.matrices.planes, max(above - top, 0.0))
    cells = cell_m / level.grid.cell_m

    def heights(col0, row0, col1, row1):
        first, last = level.grid.cols - 1, level.grid.rows - 1
        c0, r0, c1, r1 = (np.floor(v * cells + margin).astype(np.int64)
                          for v, margin in ((col0, -2), (row0, -2), (col1, 3), (row1, 3)))  # fmt: skip
        lowest, _ = bounds.query(r0, c0, r1, c1)
        dry = (c0 > 0) & (r0 > 0) & (c1 < first) & (r1 < last) & (lowest > level.sea_level_m + top)
        return (
            np.where(dry, level.sea_level_m + 2 * top, level.sea_level_m - top),
            np.full(len(dry), level.sea_level_m + top),
        )

    return lod, view, select(lod, view, heights)


def water_shown(frame: Frame) -> bool:
    return frame.level.settings.water.on


def bind_water(frame: Frame) -> None:
    """What the sea's shaders read of painted layers and of the current."""
    uploader = frame.renderer.uploader
    frame.textures["u_layer_foam"] = uploader.layer(frame.level, "foam")
    frame.textures["u_current"] = uploader.current(frame.level)
    frame.uniforms["u_current_cell_m"] = current(frame.level).cell_m


def below_defines(frame: Frame) -> dict[str, str]:
    """How the sea's shader sees what lies below: through plates, or its colour (D02)."""
    from .plate import in_use

    return {"PLATE": ""} if in_use(frame) else {}


def draw(frame: Frame) -> None:
    if not water_shown(frame):
        return
    ctx = frame.renderer.ctx
    frame.targets.gbuffer.use()
    bind_water(frame)
    lod, view, chunks = sea_chunks(frame)
    shader = frame.shader(
        "sea.glsl", MESH="", **({} if frame.tier.sea_exact else {"COARSE": ""}), **below_defines(frame)
    )
    set_uniforms(shader.program, mesh_uniforms(lod, view))
    ctx.enable(ctx.DEPTH_TEST)
    frame.stats["sea_triangles"] = chunk_mesh(frame, lod.chunk).draw(shader, chunks)
    ctx.disable(ctx.DEPTH_TEST)
