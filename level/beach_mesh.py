"""The beach mesh (H03): one topology along the waterline for water and for sand, its border on the sea's 10 m grid.

beach_mesh(level) -> BeachMeshes or None

It fills whole cells of the base mesh. Inside stand rows of vertices that follow the waterline, between them a Delaunay
triangulation. An edge whose circle is empty is part of every one (Gabriel and Sokal 1969): rows keep out of the circles
round the border's edges, so that the border is there edge for edge and nothing has to be cut.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import Delaunay, cKDTree

from .beach_even import evened
from .beach_fit import fitted
from .beach_uv import Shoreline, charted, shoreline
from .level import Level
from .patches import BASE_M, BEACH, PATCH_M, beach_contact, patch_kinds
from .pick import ground_at
from .shore_field import shore_field

EAST, NORTH = np.array([1.0, 0.0]), np.array([0.0, 1.0])
FULL_M2 = 50.0  # area of a triangle of the base mesh, whose bias is 1
CLEAR_M = 0.5 * BASE_M * 1.02  # of the middle of a border's edge, where no other vertex may stand
APART = 0.4  # share of the rows' distance that two vertices keep at least
OFF_ROW = 0.3  # share of that distance by which a vertex may miss its row's distance from the shore


@dataclass(frozen=True)
class BeachMeshes:
    """One topology, world metres: `xy` `(n, 2)`, `uv` `(n, 2)` metres along the shore and share across it, `tangent`
    `(n, 2)` along it with the sea on the left, `colours` `(n, 4)` 0 … 1 (`MASKS`), `triangles` `(m, 3)` anticlockwise.

    Where two shores meet a place has a vertex for each, as their u differ. `border` `(n,)`: on the 10 m grid's cut.
    """

    xy: np.ndarray
    uv: np.ndarray
    tangent: np.ndarray
    colours: np.ndarray
    triangles: np.ndarray
    border: np.ndarray
    water_m: np.ndarray  # height of the still sea
    ground_m: np.ndarray
    key: tuple = ()

    @property
    def area_m2(self) -> np.ndarray:
        """Of each triangle, from above."""
        return areas_m2(self.xy, self.triangles)


MASKS = (
    "tessellation bias: area of its triangles / 50 m2, at most 1; 1 on the border, as the base mesh has it",
    "nearness of the waterline: 1 on it, 0 at the farthest row of either side",
    "painted foam",
    "share of the sea's contact with the beach: 0 where a patch beside it is set to open or coastal",
)


def areas_m2(xy: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Signed areas `(m,)`, anticlockwise positive."""
    a, b, c = (xy[triangles[:, i]] for i in range(3))
    return 0.5 * ((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0]))


def beach_mesh(level: Level) -> BeachMeshes | None:
    """The level's beach mesh, kept until anything changes; None where no patch marked beach has a shore."""
    key = level.revision, level.settings
    have = level.derived.get("beach_mesh", (None, None))
    if have[0] != key:
        have = level.derived["beach_mesh"] = key, _made(level, key)
    return have[1]


def _made(level: Level, key: tuple) -> BeachMeshes | None:
    field, settings = shore_field(level, now=True), level.settings.beach_mesh
    cells = beach_cells(level)
    line = shoreline(field, settings.along_m)
    if line is None or not cells.any():
        return None
    edges, nodes = _border(cells)
    xy, border = _points(level, line, cells, edges, nodes)
    clear = cKDTree(edges)
    xy = fitted(level, xy, lambda at: _triangles(at, cells), lambda at: clear.query(at)[0] > CLEAR_M, _apart)
    border = np.arange(len(xy)) < border.sum()
    triangles = _triangles(xy, cells)
    used, triangles = np.unique(triangles, return_inverse=True)
    xy, border, triangles = xy[used], border[used], triangles.reshape(-1, 3)
    bias = _bias(xy, triangles, border)
    where, u, tangent, triangles = charted(line, xy, triangles)
    xy, border, bias = xy[where], border[where], bias[where]
    off_m = _signed_m(field, xy)
    u = evened(xy, triangles, u, off_m)
    across = settings.seaward_m + settings.landward_m
    uv = np.stack([u, (settings.seaward_m - off_m) / across], -1)
    colours = np.stack([bias, _near(settings, off_m), _foam(level, xy), _contact(level, xy)], -1)
    sea = np.full(len(xy), level.mean_sea_m)
    return BeachMeshes(xy, uv, tangent, colours, triangles, border, sea, ground_at(level, *xy.T), key)


def beach_cells(level: Level) -> np.ndarray:
    """Cells of 10 m that it fills, bool `(rows, cols)` from the level's south-west corner on: those on patches marked
    beach, wholly on the level, with a place in reach of the waterline.
    """
    field, settings = shore_field(level, now=True), level.settings.beach_mesh
    cols, rows = (int(side / BASE_M + 1e-6) for side in level.grid.extent_m)
    near = (field.distance_m < min(settings.seaward_m, 0.99 * field.range_m)) & (
        field.distance_m > -min(settings.landward_m, 0.99 * field.range_m)
    )
    at = [np.minimum((np.arange(n) * field.cell_m / BASE_M).astype(int), most)
          for n, most in zip(near.shape, (rows, cols), strict=True)]  # fmt: skip
    found = np.zeros((rows + 1, cols + 1), bool)
    row, col = np.nonzero(near)
    found[at[0][row], at[1][col]] = True
    kinds = patch_kinds(level)
    per = int(PATCH_M / BASE_M)
    patch = [np.arange(n) // per - first for n, first in ((rows, kinds.row0), (cols, kinds.col0))]
    return found[:rows, :cols] & (kinds.kinds[np.ix_(*patch)] == BEACH)


def _border(cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Middles of the edges between a cell that it fills and one that it doesn't `(n, 2)`, and their ends, world m."""
    wide = np.pad(cells, 1)
    row, col = np.nonzero(wide[1:, 1:-1] != wide[:-1, 1:-1])  # edges to the east
    east = np.stack([col, row], -1).astype(float)
    row, col = np.nonzero(wide[1:-1, 1:] != wide[1:-1, :-1])  # to the north
    north = np.stack([col, row], -1).astype(float)
    ends = np.concatenate([east, east + EAST, north, north + NORTH])
    return np.concatenate([east + EAST / 2, north + NORTH / 2]) * BASE_M, np.unique(ends, axis=0) * BASE_M


def _points(level: Level, line: Shoreline, cells: np.ndarray, edges, nodes) -> tuple[np.ndarray, np.ndarray]:
    """All vertices `(n, 2)` and which are the border's: rows along the shore, and grid vertices where these leave room.

    Of two that stand too near each other the one nearer to the shore stays.
    """
    settings, field = level.settings.beach_mesh, shore_field(level, now=True)
    offsets = np.linspace(settings.seaward_m, -settings.landward_m, settings.rows)
    offsets[np.abs(offsets).argmin()] = 0.0
    row_m = abs(offsets[1] - offsets[0])
    kept, tree = np.zeros((0, 2)), cKDTree(edges)
    for off_m in sorted(offsets, key=abs):
        xy = line.xy + off_m * line.left
        xy = xy[_inside(cells, xy)]
        xy = xy[np.abs(_signed_m(field, xy) - off_m) <= OFF_ROW * row_m]
        xy = xy[tree.query(xy)[0] > CLEAR_M]
        kept = np.concatenate([kept, _apart(xy, kept, APART * min(row_m, settings.along_m))])
    rows, cols = cells.shape
    grid = np.stack(np.meshgrid(np.arange(cols + 1), np.arange(rows + 1)), -1).reshape(-1, 2) * BASE_M
    grid = grid[_inside(cells, grid + 1e-3) & (cKDTree(nodes).query(grid)[0] > 1e-3)]
    if len(kept) and len(grid):
        grid = grid[cKDTree(kept).query(grid)[0] > 0.5 * BASE_M]
    border = np.arange(len(nodes) + len(kept) + len(grid)) < len(nodes)
    return np.concatenate([nodes, kept, grid]), border


def _apart(xy: np.ndarray, others: np.ndarray, least_m: float) -> np.ndarray:
    if len(xy) and len(others):
        xy = xy[cKDTree(others).query(xy)[0] >= least_m]
    if len(xy) < 2:
        return xy
    pairs = cKDTree(xy).query_pairs(least_m, output_type="ndarray")
    gone = np.zeros(len(xy), bool)
    for a, b in pairs[np.lexsort(pairs.T[::-1])]:
        gone[b] |= not gone[a]
    return xy[~gone]


def _inside(cells: np.ndarray, xy: np.ndarray) -> np.ndarray:
    col, row = np.floor(xy / BASE_M).astype(int).T
    there = (row >= 0) & (col >= 0) & (row < cells.shape[0]) & (col < cells.shape[1])
    there[there] = cells[row[there], col[there]]
    return there


def _triangles(xy: np.ndarray, cells: np.ndarray) -> np.ndarray:
    found = Delaunay(xy).simplices.astype(np.int64)
    found = found[_inside(cells, xy[found].mean(axis=1))]
    back = areas_m2(xy, found) < 0
    found[back] = found[back][:, ::-1]
    return found[areas_m2(xy, found) > 1e-9]


def _bias(xy: np.ndarray, triangles: np.ndarray, border: np.ndarray) -> np.ndarray:
    """Mean area of a vertex's triangles ÷ 50 m², clamped to 1: of an edge it is one number, whoever asks, so nothing
    cracks; the border has the base mesh's 1.
    """
    area = np.repeat(areas_m2(xy, triangles), 3)
    total = np.bincount(triangles.ravel(), area, len(xy))
    mean = total / np.maximum(np.bincount(triangles.ravel(), minlength=len(xy)), 1)
    return np.where(border, 1.0, np.minimum(mean / FULL_M2, 1.0))


def _signed_m(field, xy: np.ndarray) -> np.ndarray:
    """Metres to the waterline, seaward positive."""
    from scipy import ndimage

    return ndimage.map_coordinates(field.distance_m, xy.T[::-1] / field.cell_m, order=1, mode="nearest").astype(float)


def _near(settings, off_m: np.ndarray) -> np.ndarray:
    return np.clip(1 - np.where(off_m > 0, off_m / settings.seaward_m, -off_m / settings.landward_m), 0, 1)


def _foam(level: Level, xy: np.ndarray) -> np.ndarray:
    data = level.layers["foam"]
    if data.neutral:
        return np.zeros(len(xy))
    col, row = np.rint(xy.T / level.grid.cell_m).astype(int)
    values = data.array[np.clip(row, 0, level.grid.rows - 1), np.clip(col, 0, level.grid.cols - 1)]
    return np.clip(values.reshape(len(xy), -1).max(-1), 0, 1)


def _contact(level: Level, xy: np.ndarray) -> np.ndarray:
    return np.broadcast_to(beach_contact(level, xy[:, 0], xy[:, 1]).v, len(xy))
