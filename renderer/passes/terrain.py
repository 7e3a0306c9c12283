"""The land into the G-buffer: chunks that are seen, none finer than their distance asks."""

from __future__ import annotations

import math

import numpy as np

from ...level import Level
from ..bounds import HeightBounds
from ..camera import Matrices
from ..frame import Frame
from ..mesh import ChunkMesh, Lod, View, mesh_uniforms, select
from ..quality import APRON_DEPTH_M, APRON_M, Tier
from ..uniforms import set_uniforms


def chunk_mesh(frame: Frame, chunk: int) -> ChunkMesh:
    """The grid for chunks of that many cells, one a renderer."""
    meshes = frame.renderer.meshes
    if chunk not in meshes:
        meshes[chunk] = ChunkMesh(frame.renderer.ctx, chunk)
    return meshes[chunk]


def terrain_view(level: Level, bounds: HeightBounds, tier: Tier, matrices: Matrices):
    """What `select` needs for the land: rule, view and bounds of heights."""
    grid = level.grid
    apron = math.ceil(APRON_M / grid.cell_m)
    area = (-apron, -apron, grid.cols - 1 + apron, grid.rows - 1 + apron)
    low, high = bounds.range
    floor = level.sea_level_m - APRON_DEPTH_M
    eye_m = matrices.position[2]
    view = View(matrices.position, matrices.planes, max(low - eye_m, eye_m - high, 0.0))

    def heights(col0, row0, col1, row1):
        lowest, highest = bounds.query(row0, col0, row1, col1)
        beyond = (col0 < 0) | (row0 < 0) | (col1 > grid.cols - 1) | (row1 > grid.rows - 1)
        return np.where(beyond, np.minimum(lowest, floor), lowest), highest

    return Lod(grid.cell_m, tier.terrain_chunk, tier.terrain_reach, area), view, heights


def draw(frame: Frame) -> None:
    ctx = frame.renderer.ctx
    frame.targets.gbuffer.use()
    frame.targets.gbuffer.clear(0.0, 0.0, 0.0, 0.0, depth=1.0)
    frame.textures["u_layer_cover"] = frame.renderer.uploader.layer(frame.level, "cover")
    lod, view, heights = terrain_view(frame.level, frame.renderer.uploader.bounds, frame.tier, frame.matrices)
    shader = frame.shader("terrain.glsl")
    set_uniforms(shader.program, mesh_uniforms(lod, view))
    ctx.enable(ctx.DEPTH_TEST)
    frame.stats["terrain_triangles"] = chunk_mesh(frame, lod.chunk).draw(shader, select(lod, view, heights))
    ctx.disable(ctx.DEPTH_TEST)
