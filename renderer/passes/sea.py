"""The sea into the same G-buffer as the land (D01): the wave function on world-fixed vertices.

The mesh is made of hectares (level/patches.py): those that the circle round all view circles touches, or a square of
them round the camera. `sea.mesh` says how it gets fine near by: from grids, or tessellated from cells of 10 m (H02).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...level.breaking import overhang_m
from ...level.flow import current
from ...level.patches import BASE_M, PATCH_M, Circle, extents, in_mesh
from ...level.shore import shore_map
from ...level.waves import largest_height_m
from ...level.weather_keys import points_change
from ..frame import Frame
from ..mesh import Lod, View, mesh_uniforms, select
from ..uniforms import set_uniforms
from .terrain import chunk_mesh

CHUNK = 10  # cells a side: a hectare is one chunk of cells of 10 m
NEAR_M = 120.0  # what the tiers' reach stands for
HULL_REACH = 4.0  # chunks of cells of 10 m before the hull that is tessellated gets coarser
FLAT, FADE = 0.9, 0.4  # of the distance to the mesh's edge: where waves lie flat, how long they take
SOFTWARE = ("llvmpipe", "softpipe", "swiftshader", "software", "basic render")
RIVER_MARGIN_M = 6.0  # how far waves may carry the water of a chunk into a river
MOST_SOFTWARE_PARTS = 8  # finer, software tessellates pathologically slowly


@dataclass(frozen=True)
class Extent:
    """Where the mesh is: hectares from (col0, row0) to before (col1, row1) that have a part in `circle`, if any."""

    col0: int
    row0: int
    col1: int
    row1: int
    circle: Circle | None

    @property
    def box_m(self) -> tuple[float, float, float, float]:
        """World west, south, east, north."""
        return tuple(PATCH_M * side for side in (self.col0, self.row0, self.col1, self.row1))


def sea_extent(frame: Frame) -> Extent:
    """The circle's hectares; without view circles whole hectares round the camera's."""
    circle = extents(frame.level)
    if circle is None:
        around = math.ceil(frame.tier.sea_distance_m / PATCH_M)
        col, row = (math.floor(v / PATCH_M) for v in frame.matrices.position[:2])
        return Extent(col - around, row - around, col + around + 1, row + around + 1, None)
    low = [math.floor((v - circle.radius_m) / PATCH_M) for v in (circle.x, circle.y)]
    high = [math.floor((v + circle.radius_m) / PATCH_M) + 1 for v in (circle.x, circle.y)]
    return Extent(*low, *high, circle)


def extent_uniforms(frame: Frame, extent: Extent) -> dict:
    """Where mesh and horizon meet, and where waves lie down before that (H31)."""
    x, y = frame.matrices.position[:2]
    circle = extent.circle
    if circle is None:
        distance_m = frame.tier.sea_distance_m
        edge = (0.0, 0.0, FLAT * distance_m, FADE * distance_m)
    else:
        edge = (circle.x - x, circle.y - y, circle.radius_m, FADE * circle.radius_m)
    return {
        "u_mesh_box": extent.box_m,
        "u_mesh_circle": (circle.x, circle.y, circle.radius_m) if circle else (x, y, 1e9),
        "u_sea_edge": tuple(float(v) for v in edge),
    }


def tessellated(frame: Frame) -> bool:
    """Whether the surface is tessellated: as `sea.mesh` says; auto, on graphics hardware."""
    chosen = frame.level.settings.sea.mesh
    return chosen == "tessellated" or (chosen == "auto" and not software(frame.renderer.ctx))


def software(ctx) -> bool:
    """Whether OpenGL is drawn by the processor."""
    return any(name in ctx.info["GL_RENDERER"].lower() for name in SOFTWARE)


def sea_chunks(frame: Frame, extent: Extent) -> tuple[Lod, View, np.ndarray]:
    """What of the sea is drawn: rule, view and chunks; none outside the extent or where only high land is."""
    sea, hull = frame.level.settings.sea, tessellated(frame)
    cell_m = BASE_M if hull else frame.tier.sea_cell_m
    near = (HULL_REACH if hull else frame.tier.sea_reach) * sea.near_m / NEAR_M
    area = tuple(round(side / cell_m) for side in extent.box_m)
    lod = Lod(cell_m, CHUNK, max(near, HULL_REACH), area, falloff=sea.falloff)
    top = 2 * largest_height_m(frame.level)
    above = abs(frame.matrices.position[2] - frame.level.sea_level_m)
    planes = frame.matrices.planes + np.array([0.0, 0.0, 0.0, _sideways_m(frame)])
    view = View(frame.matrices.position, planes, max(above - top, 0.0))
    return lod, view, select(lod, view, _heights(frame, extent, cell_m, top))


def _sideways_m(frame: Frame) -> float:
    """How far breaking waves leave their chunk."""
    return overhang_m(frame.level.settings.shore)


def _heights(frame: Frame, extent: Extent, cell_m: float, top: float):
    """Bounds of the sea over rectangles of cells for `select`: lowest above highest where nothing is to be drawn."""
    level, bounds, rivers = frame.level, frame.renderer.uploader.bounds, frame.renderer.uploader.river_bounds
    stride = shore_map(level).stride
    cells = cell_m / level.grid.cell_m

    def heights(col0, row0, col1, row1):
        first, last = level.grid.cols - 1, level.grid.rows - 1
        c0, r0, c1, r1 = (np.floor(v * cells + margin).astype(np.int64)
                          for v, margin in ((col0, -2), (row0, -2), (col1, 3), (row1, 3)))  # fmt: skip
        lowest, _ = bounds.query(r0, c0, r1, c1)
        none = (c0 > 0) & (r0 > 0) & (c1 < first) & (r1 < last) & (lowest > level.sea_level_m + top)
        low, high = np.full(len(none), level.sea_level_m - top), np.full(len(none), level.sea_level_m + top)
        if rivers is not None:  # their water may stand anywhere (D13)
            _, water = rivers.query(*(v // stride for v in (r0, c0, r1, c1)))
            water += level.mean_sea_m
            none &= water < lowest
            high = np.maximum(high, water + top)
        none |= _outside(extent, *(v * cell_m for v in (col0, row0, col1, row1)))
        return (
            np.where(none, high + top, low),
            high,
        )

    return heights


def _outside(extent: Extent, west, south, east, north) -> np.ndarray:
    """Which rectangles, or the hectare round one, have no part in the circle."""
    if extent.circle is None:
        return np.zeros(len(west), bool)
    wide = east - west > PATCH_M
    x = np.clip(extent.circle.x, west, east) - extent.circle.x
    y = np.clip(extent.circle.y, south, north) - extent.circle.y
    within = in_mesh(extent.circle, np.floor(west / PATCH_M + 1e-6), np.floor(south / PATCH_M + 1e-6))
    return np.where(wide, np.hypot(x, y) >= extent.circle.radius_m, ~within)


def water_shown(frame: Frame) -> bool:
    return frame.level.settings.water.on


def bind_water(frame: Frame) -> None:
    """What the sea's shaders read of painted layers and of the current."""
    uploader = frame.renderer.uploader
    frame.textures["u_layer_foam"] = uploader.foam(frame.level)
    frame.textures["u_current"] = uploader.current(frame.level, points_change(frame.level, frame.time_s))
    frame.uniforms["u_current_cell_m"] = current(frame.level).cell_m


def below_defines(frame: Frame) -> dict[str, str]:
    """How the sea's shader sees what lies below: through plates, or its colour (D02)."""
    from .plate import in_use

    return {"PLATE": ""} if in_use(frame) else {}


def _defines(frame: Frame, hull: bool) -> dict[str, str]:
    wanted = {"COARSE": not frame.tier.sea_exact, "TESSELLATED": hull, "MEASURED": frame.view.name == "triangle_area"}
    return {"MESH": "", **{name: "" for name, on in wanted.items() if on}, **below_defines(frame)}


def _tess_uniforms(frame: Frame) -> dict:
    parts = BASE_M / frame.tier.sea_cell_m
    return {
        "u_planes": np.array(frame.matrices.planes, np.float32),
        "u_tess": (parts / BASE_M, min(parts, MOST_SOFTWARE_PARTS) if software(frame.renderer.ctx) else parts),
        "u_sea_top_m": 2 * largest_height_m(frame.level) + _sideways_m(frame),
    }


def draw(frame: Frame) -> None:
    if not water_shown(frame):
        return
    ctx, hull, extent = frame.renderer.ctx, tessellated(frame), sea_extent(frame)
    frame.targets.gbuffer.use()
    bind_water(frame)
    frame.uniforms |= extent_uniforms(frame, extent)
    lod, view, chunks = sea_chunks(frame, extent)
    uniforms = mesh_uniforms(lod, view) | (_tess_uniforms(frame) if hull else {})
    ctx.enable(ctx.DEPTH_TEST)
    frame.stats["sea_triangles"] = 0
    beside = _beside_rivers(frame, lod, chunks)
    for some, without in ((chunks[~beside], ("RIVERS",)), (chunks[beside], ())):
        if len(some):
            shader = frame.shader("sea.glsl", without, **_defines(frame, hull))
            set_uniforms(shader.program, uniforms)
            frame.stats["sea_triangles"] += chunk_mesh(frame, lod.chunk).draw(shader, some, patches=hull)
    frame.stats["river_chunks"] = int(beside.sum())
    ctx.disable(ctx.DEPTH_TEST)


def _beside_rivers(frame: Frame, lod: Lod, chunks: np.ndarray) -> np.ndarray:
    """Which chunks feel a river: the others are drawn without any, for less."""
    felt = frame.renderer.uploader.felt_bounds
    if felt is None:
        return np.zeros(len(chunks), bool)
    cell_m, size = shore_map(frame.level).cell_m, lod.chunk << chunks[:, 2]
    low = np.floor((chunks[:, :2] * lod.cell_m - RIVER_MARGIN_M) / cell_m).astype(np.int64)
    high = np.ceil(((chunks[:, :2] + size[:, None]) * lod.cell_m + RIVER_MARGIN_M) / cell_m).astype(np.int64)
    inside = (high >= 0).all(axis=1) & (low[:, 0] < felt.cols) & (low[:, 1] < felt.rows)
    return inside & (felt.query(low[:, 1], low[:, 0], high[:, 1], high[:, 0])[1] > 0)
