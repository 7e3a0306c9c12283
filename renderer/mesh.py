"""The morphing quadtree that terrain and sea share: no cracks, no pops (CDLOD, F. Strugar, 2010).

Chunks of level l have `chunk` × `chunk` cells of 2^l base cells and stand on a grid fixed to the world. With the
distance of a point `d = max(|dx|, |dy|, h)` (h: how far the camera is above or below what is drawn), a chunk is divided
where its nearest point is closer than `r(l − 1)`, `r(l) = reach · chunk · 2^l` cells. Between MORPH · r(l) and r(l) the
vertices of level l slide onto those of level l + 1, so both sides of a border are the same points; this holds for
`reach ≥ 2 / (2 MORPH − 1)`, also where finer levels reach less far than coarser ones. Triangles without culling:
(2 reach + 1)² · 2 chunk² · (1 + 3/4 levels) at most. With a `falloff` f above 1 cells grow as d^f (H02): ranges grow by
2^(1/f) a level, or by as little as leaves no crack: what a divided chunk reaches to must not have begun to slide.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

MORPH = 0.75  # from this part of a level's range its vertices slide
SAFE = 0.998  # of that, so that float32 agrees
MOST_LEVELS = 20


@dataclass(frozen=True)
class Lod:
    """`cell_m` metres a base cell, `area` (col0, row0, col1, row1) in base cells that must be covered.

    The first `near` levels have a `near_reach` of their own, no longer than `reach`.
    """

    cell_m: float
    chunk: int
    reach: float
    area: tuple[int, int, int, int]
    near: int = 0
    near_reach: float = 4.0
    falloff: float = 1.0

    def __post_init__(self) -> None:
        least = min(self.reach, self.near_reach) if self.near else self.reach
        if self.chunk % 2 or least < 2 / (2 * MORPH - 1) or (self.near and self.near_reach > self.reach):
            raise ValueError(f"chunk {self.chunk} and reach {self.reach} would leave cracks")

    def range_cells(self, level: int) -> float:
        """The distance, in base cells, at which this level gives way to the next."""
        if level < self.near or self.falloff <= 1.0:
            return (self.near_reach if level < self.near else self.reach) * self.chunk * 2.0**level
        range_cells = self.reach * self.chunk * 2.0**self.near
        for finer in range(self.near, level):
            least = (range_cells + 2 * self.chunk * 2.0**finer) / (MORPH * SAFE)
            range_cells = max(range_cells * 2.0 ** (1 / self.falloff), least)
        return range_cells

    @property
    def levels(self) -> int:
        """The coarsest level: one chunk is as long as the area, or nearly."""
        longest = max(self.area[2] - self.area[0], self.area[3] - self.area[1])
        return max(int(np.ceil(np.log2(max(longest / self.chunk, 1)))), 0)


@dataclass
class View:
    """Where from: camera in world metres (3,), planes (5, 4) over camera-relative points, height distance in metres."""

    position: np.ndarray
    planes: np.ndarray
    above_m: float


def select(lod: Lod, view: View, bounds) -> np.ndarray:
    """Chunks to draw as int32 `(n, 3)`: first column, first row, level.

    `bounds(col0, row0, col1, row1)` gives lowest and highest world z of cell rectangles; lowest above highest: nothing.
    """
    nodes, level = _roots(lod), lod.levels
    leaves = []
    while len(nodes):
        size = lod.chunk << level
        nodes = nodes[_seen(lod, view, nodes, size, bounds)]
        divide = np.zeros(len(nodes), bool)
        if level:
            divide = _nearest(lod, view, nodes, size) < lod.range_cells(level - 1)
        leaves.append(np.column_stack([nodes[~divide], np.full((~divide).sum(), level)]))
        corners = np.array([(0, 0), (1, 0), (0, 1), (1, 1)]) * (size // 2)
        nodes = (nodes[divide][:, None] + corners).reshape(-1, 2)
        level -= 1
    chunks = np.concatenate(leaves).astype(np.int32)
    # Near ones first: what they hide isn't shaded.
    middle = (chunks[:, :2] + (lod.chunk << chunks[:, 2:]) / 2) * lod.cell_m - view.position[:2]
    return chunks[np.argsort((middle**2).sum(axis=1), kind="stable")]


def _roots(lod: Lod) -> np.ndarray:
    size = lod.chunk << lod.levels
    col0, row0, col1, row1 = lod.area
    cols, rows = (
        np.arange(first // size, max(-(-last // size), first // size + 1))
        for first, last in ((col0, col1), (row0, row1))
    )
    return np.stack(np.meshgrid(cols, rows), -1).reshape(-1, 2) * size


def _nearest(lod: Lod, view: View, nodes: np.ndarray, size: int) -> np.ndarray:
    """Least distance of each node, in base cells."""
    camera = view.position[:2] / lod.cell_m
    away = np.maximum(np.maximum(nodes - camera, camera - nodes - size), 0.0).max(axis=1)
    return np.maximum(away, view.above_m / lod.cell_m)


def _seen(lod: Lod, view: View, nodes: np.ndarray, size: int, bounds) -> np.ndarray:
    """Which nodes are in the area, have something to draw and aren't wholly outside the view, in float64."""
    col0, row0 = nodes.T
    area = lod.area
    inside = (col0 < area[2]) & (row0 < area[3]) & (col0 + size > area[0]) & (row0 + size > area[1])
    low, high = bounds(col0, row0, col0 + size, row0 + size)
    ends = np.array([nodes * lod.cell_m, (nodes + size) * lod.cell_m]) - view.position[:2]
    heights = np.array([low, high], np.float64) - view.position[2]
    inside &= low <= high
    for a, b, c, d in view.planes:
        farthest = (
            np.maximum(a * ends[0][:, 0], a * ends[1][:, 0])
            + np.maximum(b * ends[0][:, 1], b * ends[1][:, 1])
            + np.maximum(c * heights[0], c * heights[1])
        )
        inside &= farthest + d >= 0
    return inside


def mesh_uniforms(lod: Lod, view: View) -> dict:
    """What lib/mesh.glsl asks for: the camera as whole cells and a rest, so that float32 loses nothing."""
    cell = np.floor(view.position[:2] / lod.cell_m)
    rest = view.position[:2] - cell * lod.cell_m
    return {
        "u_mesh_cell_m": lod.cell_m,
        "u_mesh_camera_cell": tuple(int(v) for v in cell),
        "u_mesh_camera_rest": tuple(float(v) for v in rest),
        "u_mesh_above_m": view.above_m,
        "u_mesh_range_m": np.array([lod.range_cells(level) * lod.cell_m for level in range(MOST_LEVELS)], np.float32),
        "u_mesh_morph": MORPH,
        "u_mesh_area": lod.area,
    }


class ChunkMesh:
    """The one grid on the GPU, drawn once per chunk; every quad's diagonal runs from south-west to north-east."""

    def __init__(self, ctx, chunk: int) -> None:
        self.ctx = ctx
        self.chunk = chunk
        side = np.arange(chunk + 1, dtype=np.int32)
        cells = np.stack(np.meshgrid(side, side), -1).reshape(-1, 2)
        quad = (np.arange(chunk)[:, None] * (chunk + 1) + np.arange(chunk)).reshape(-1, 1)
        south, north = quad + np.array([0, 1]), quad + chunk + 1 + np.array([0, 1])
        triangles = np.concatenate([south[:, [0, 1]], north[:, [1]], south[:, [0]], north[:, [1, 0]]], axis=1)
        self.vertices = ctx.buffer(cells.astype("i4").tobytes())
        self.indices = ctx.buffer(triangles.astype("i4").tobytes())
        cells = np.concatenate([south, north[:, ::-1]], axis=1)  # south-west, south-east, north-east, north-west
        self.quads = ctx.buffer(cells.astype("i4").tobytes())
        self.instances = ctx.buffer(reserve=12)
        self.arrays: dict[tuple, object] = {}

    def draw(self, shader, chunks: np.ndarray, patches: bool = False) -> int:
        """Draw `chunks` (n, 3) with a shader; returns the triangles sent. `patches`: each cell as one to tessellate."""
        if not len(chunks):
            return 0
        self.instances.orphan(max(chunks.nbytes, 12))
        self.instances.write(np.ascontiguousarray(chunks, np.int32).tobytes())
        key = (id(shader), shader.generation)
        if key not in self.arrays:
            content = [(self.vertices, "2i4", "in_cell"), (self.instances, "3i4/i", "in_chunk")]
            indices = self.quads if patches else self.indices
            self.arrays[key] = self.ctx.vertex_array(shader.program, content, indices, index_element_size=4)
        if patches:
            self.ctx.patch_vertices = 4
        self.arrays[key].render(self.ctx.PATCHES if patches else self.ctx.TRIANGLES, instances=len(chunks))
        return len(chunks) * 2 * self.chunk**2

    def release(self) -> None:
        for thing in (*self.arrays.values(), self.vertices, self.indices, self.quads, self.instances):
            thing.release()
