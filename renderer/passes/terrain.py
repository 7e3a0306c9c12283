"""The land into the G-buffer: chunks that are seen, none finer than their distance asks."""

from __future__ import annotations

import math

import numpy as np

from ...level import Level
from ...level.ground_materials import MATERIALS
from ..bounds import HeightBounds
from ..camera import Matrices
from ..frame import Frame
from ..mesh import MORPH, ChunkMesh, Lod, View, mesh_uniforms, select
from ..quality import APRON_DEPTH_M, APRON_M, Tier

NEAR_REACH = 4.0  # chunks: how far levels finer than the level's cells reach
OVERSHOOT = 0.3  # share of its samples' range by which a cubic may leave it


def chunk_mesh(frame: Frame, chunk: int) -> ChunkMesh:
    """The grid for chunks of that many cells, one a renderer."""
    meshes = frame.renderer.meshes
    if chunk not in meshes:
        meshes[chunk] = ChunkMesh(frame.renderer.ctx, chunk)
    return meshes[chunk]


def terrain_view(level: Level, bounds: HeightBounds, tier: Tier, matrices: Matrices):
    """What `select` needs for the land: rule, view and bounds of heights."""
    grid, fine = level.grid, tier.ground_levels
    apron = math.ceil(APRON_M / grid.cell_m)
    area = (-apron, -apron, grid.cols - 1 + apron, grid.rows - 1 + apron)
    low, high = bounds.range
    floor = level.mean_sea_m - APRON_DEPTH_M
    eye_m = matrices.position[2]
    view = View(matrices.position, matrices.planes, max(low - eye_m, eye_m - high, 0.0))
    relief_m = max(row.relief_m for row in MATERIALS) * level.settings.ground.relief

    def heights(col0, row0, col1, row1):
        between = len(col0) and col1[0] - col0[0] < tier.terrain_chunk << fine  # its vertices leave the samples
        col0, row0 = (col0 >> fine) - between, (row0 >> fine) - between
        col1, row1 = (-(-col1 >> fine)) + between, (-(-row1 >> fine)) + between
        lowest, highest = bounds.query(row0, col0, row1, col1)
        if between:
            spare = OVERSHOOT * (highest - lowest) + 0.5 * relief_m
            lowest, highest = lowest - spare, highest + spare
        beyond = (col0 < 0) | (row0 < 0) | (col1 > grid.cols - 1) | (row1 > grid.rows - 1)
        return np.where(beyond, min(low, floor), lowest), np.where(beyond, high, highest)

    lod = Lod(
        grid.cell_m / 2**fine,
        tier.terrain_chunk,
        tier.terrain_reach,
        tuple(side << fine for side in area),
        fine,
        NEAR_REACH,
    )
    return lod, view, heights


def relief_uniforms(lod: Lod) -> dict:
    """What lib/relief.glsl asks for: relief has sunk before the last near level gives way."""
    end = lod.range_cells(max(lod.near - 1, 0)) * lod.cell_m * MORPH
    return {
        "u_relief_fine": lod.near,
        "u_relief_fade_m": (0.4 * end, end),
        "u_relief_cell_m": 2.0 / (lod.near_reach * lod.chunk),
    }


def draw(frame: Frame) -> None:
    ctx = frame.renderer.ctx
    frame.targets.gbuffer.use()
    frame.targets.gbuffer.clear(0.0, 0.0, 0.0, 0.0, depth=1.0)
    frame.textures["u_layer_cover"] = frame.renderer.uploader.layer(frame.level, "cover")
    lod, view, heights = terrain_view(frame.level, frame.renderer.uploader.bounds, frame.tier, frame.matrices)
    frame.uniforms |= ground_uniforms() | mesh_uniforms(lod, view) | relief_uniforms(lod)
    chunks = select(lod, view, heights)
    near = chunks[:, 2] < lod.near  # a program of their own: software runs all of a vertex shader for every vertex
    ctx.enable(ctx.DEPTH_TEST)
    frame.stats["terrain_triangles"] = 0
    for part, relief in ((chunks[near], True), (chunks[~near], False)):
        if len(part):
            shader = frame.shader("terrain.glsl", **_defines(frame, relief))
            frame.stats["terrain_triangles"] += chunk_mesh(frame, lod.chunk).draw(shader, part)
    ctx.disable(ctx.DEPTH_TEST)


def ground_uniforms() -> dict:
    """The rows of MATERIALS as lib/ground_layers.glsl reads them."""
    rows = [(row.tile_m, row.amplitude_m, row.steepest, row.relief_m) for row in MATERIALS]
    colours = [row.colour for row in MATERIALS]
    return {"u_ground_layers": np.array(rows, np.float32), "u_ground_colours": np.array(colours, np.float32)}


def _defines(frame: Frame, relief: bool) -> dict[str, str]:
    wanted = {
        "GROUND_CHEAP": frame.tier.ground_cheap,
        "SMOOTH_NEAR": not frame.tier.ground_cheap,
        "RELIEF": relief,
        "SHOW_GROUND": frame.view.name == "ground",
    }
    return {name: "" for name, on in wanted.items() if on} | {"MOST_LAYERS": str(frame.tier.ground_layers)}
