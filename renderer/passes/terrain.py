"""The land into the G-buffer: chunks that are seen, none finer than their distance asks."""

from __future__ import annotations

import math

import numpy as np

from ..frame import Frame
from ..mesh import ChunkMesh, Lod, View, mesh_uniforms, select
from ..uniforms import set_uniforms

APRON_M = 900.0  # land goes on beyond the level and sinks (lib/height.glsl)
APRON_DEPTH_M = 9.0


def chunk_mesh(frame: Frame, chunk: int) -> ChunkMesh:
    """The grid for chunks of that many cells, one a renderer."""
    meshes = frame.renderer.meshes
    if chunk not in meshes:
        meshes[chunk] = ChunkMesh(frame.renderer.ctx, chunk)
    return meshes[chunk]


def terrain_chunks(frame: Frame) -> tuple[Lod, View, np.ndarray]:
    """What of the land is drawn: rule, view and chunks."""
    grid, bounds = frame.level.grid, frame.renderer.uploader.bounds
    apron = math.ceil(APRON_M / grid.cell_m)
    area = (-apron, -apron, grid.cols - 1 + apron, grid.rows - 1 + apron)
    lod = Lod(grid.cell_m, frame.tier.terrain_chunk, frame.tier.terrain_reach, area)
    low, high = bounds.range
    position = frame.matrices.position
    view = View(position, frame.matrices.planes, max(low - position[2], position[2] - high, 0.0))
    floor = frame.level.sea_level_m - APRON_DEPTH_M

    def heights(col0, row0, col1, row1):
        lowest, highest = bounds.query(row0, col0, row1, col1)
        beyond = (col0 < 0) | (row0 < 0) | (col1 > grid.cols - 1) | (row1 > grid.rows - 1)
        return np.where(beyond, np.minimum(lowest, floor), lowest), highest

    return lod, view, select(lod, view, heights)


def draw(frame: Frame) -> None:
    ctx = frame.renderer.ctx
    frame.targets.gbuffer.use()
    frame.targets.gbuffer.clear(0.0, 0.0, 0.0, 0.0, depth=1.0)
    frame.textures["u_layer_cover"] = frame.renderer.uploader.layer(frame.level, "cover")
    lod, view, chunks = terrain_chunks(frame)
    shader = frame.shader("terrain.glsl")
    set_uniforms(shader.program, mesh_uniforms(lod, view))
    ctx.enable(ctx.DEPTH_TEST)
    frame.stats["terrain_triangles"] = chunk_mesh(frame, lod.chunk).draw(shader, chunks)
    ctx.disable(ctx.DEPTH_TEST)
