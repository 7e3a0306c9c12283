"""The morphing quadtree: watertight, bounded, culled without loss; bounds of heights follow dirty rectangles (D01)."""

from collections import Counter

import numpy as np
import pytest
from shorewright.level import Grid, Level, Rect
from shorewright.level.objects import Camera
from shorewright.renderer import camera_matrices
from shorewright.renderer.bounds import HeightBounds
from shorewright.renderer.mesh import MORPH, Lod, View, select
from shorewright.renderer.quality import TIERS

EVERYWHERE = np.array([[0.0, 0, 0, 1]] * 5)
MOST_TERRAIN_TRIANGLES = 150_000


def flat(low, high):
    return lambda col0, *_: (np.full(len(col0), low), np.full(len(col0), high))


def slid_triangles(lod, view, chunks):
    """The triangles as lib/mesh.glsl draws them, as integer points (a morph of exactly 0 or 1) or floats between."""
    side = np.arange(lod.chunk)
    west, south = (a.ravel() for a in np.meshgrid(side, side))
    corners = [np.stack([west + dx, south + dy], 1) for dx, dy in ((0, 0), (1, 0), (0, 1), (1, 1))]
    quads = np.concatenate([np.stack([corners[i] for i in t], 1) for t in ((0, 1, 3), (0, 3, 2))])
    camera = view.position[:2] / lod.cell_m
    first, last = np.array(lod.area[:2]), np.array(lod.area[2:])
    for col, row, level in chunks:
        cells = np.clip(np.array([col, row]) + (quads << level), first, last)
        parents = np.clip(np.array([col, row]) + ((quads & ~1) << level), first, last)
        away = np.maximum(np.abs(cells - camera).max(axis=-1), view.above_m / lod.cell_m)
        reach = lod.range_cells(int(level)) * 0.999
        morph = np.clip((away / reach - MORPH) / (1 - MORPH), 0, 1)[..., None]
        yield np.where(morph >= 1, parents, cells + (parents - cells) * morph)


@pytest.mark.parametrize("seed", range(6))
def test_no_cracks_every_inner_edge_has_two_sides(seed):
    """A crack or a T-junction would leave an edge with one triangle."""
    rng = np.random.default_rng(seed)
    lod = Lod(1.0, 4, (4.0, 5.3, 8.0)[seed % 3], (-20, -20, 500, 430), near=2 * (seed // 3), near_reach=4.0)
    position = np.array([*rng.uniform(-100, 600, 2), 0.0])
    view = View(position, EVERYWHERE, float(rng.choice([0.0, 5.0, 70.0])))
    edges = Counter()
    for triangles in slid_triangles(lod, view, select(lod, view, flat(0, 1))):
        for triangle in triangles:
            points = [tuple(p) for p in triangle]
            if len(set(points)) == 3:
                for a, b in zip(points, points[1:] + points[:1], strict=True):
                    edges[min(a, b), max(a, b)] += 1
    low, high = (-20, -20), (500, 430)
    odd = [e for e, n in edges.items() if n != 2]
    on_border = [any(a[i] == b[i] and a[i] in (low[i], high[i]) for i in (0, 1)) for a, b in odd]
    assert len(edges) > 1000
    assert all(on_border)


def test_the_finest_cells_reach_as_far_as_promised():
    lod = Lod(0.5, 16, 8.0, (-4000, -4000, 4000, 4000))
    view = View(np.array([3.3, -7.1, 1.0]), EVERYWHERE, 0.0)
    chunks = select(lod, view, flat(0, 1))
    size = 16 << chunks[:, 2]
    away = np.maximum(chunks[:, :2] - view.position[:2] / 0.5, view.position[:2] / 0.5 - chunks[:, :2] - size[:, None])
    nearest_m = np.maximum(away, 0).max(axis=1) * 0.5
    assert nearest_m[chunks[:, 2] >= 1].min() >= 64
    assert nearest_m[chunks[:, 2] >= 2].min() >= 128


@pytest.mark.parametrize("falloff", [1.3, 1.6, 4.0])
@pytest.mark.parametrize("above_m", [0.0, 40.0])
def test_cells_that_grow_faster_than_linear_leave_no_crack(falloff, above_m):
    """H02: constant near, then ranges that grow by less than two a level, down to what is still watertight."""
    lod = Lod(1.0, 4, 9.0, (-300, -300, 500, 430), falloff=falloff)
    grown = [lod.range_cells(level + 1) / lod.range_cells(level) for level in range(6)]
    assert max(grown) < 2.0
    view = View(np.array([13.3, 7.1, 0.0]), EVERYWHERE, above_m)
    edges = Counter()
    for triangles in slid_triangles(lod, view, select(lod, view, flat(0, 1))):
        for triangle in triangles:
            points = [tuple(p) for p in triangle]
            if len(set(points)) == 3:
                for a, b in zip(points, points[1:] + points[:1], strict=True):
                    edges[min(a, b), max(a, b)] += 1
    low, high = (-300, -300), (500, 430)
    odd = [e for e, n in edges.items() if n != 2]
    assert len(edges) > 1000
    assert all(any(a[i] == b[i] and a[i] in (low[i], high[i]) for i in (0, 1)) for a, b in odd)


@pytest.mark.parametrize("rule", [(8, 3.9), (7, 8.0), (8, 8.0, 2, 3.9), (8, 8.0, 2, 9.0)])
def test_rules_that_would_leave_cracks_are_refused(rule):
    """An odd chunk, a reach too short, near levels that reach too short or farther than the others."""
    chunk, reach, *near = rule
    with pytest.raises(ValueError, match="cracks"):
        Lod(1.0, chunk, reach, (0, 0, 8, 8), *near)


@pytest.mark.parametrize("place", [(128.3, 64.9), (3.0, 250.0), (-20.0, 40.0)])
def test_bounds_of_near_chunks_hold_the_drawn_ground(place):
    """Between samples the surface leaves their range a little, and relief adds to it: culling knows both (L05)."""
    from shorewright.renderer.passes.terrain import OVERSHOOT, terrain_view

    rng = np.random.default_rng(3)
    level = Level(Grid(257, 257), rng.uniform(0, 6, (257, 257)).astype(np.float32))
    matrices = camera_matrices(Camera(id="c", x=place[0], y=place[1], z=8, yaw_deg=0, pitch_deg=-30), (64, 36))
    lod, _, heights = terrain_view(level, HeightBounds(level.height), TIERS["medium"], matrices)
    cells = np.array([[int(place[0] / lod.cell_m) // 8 * 8, int(place[1] / lod.cell_m) // 8 * 8]])
    col, row = cells.T
    low, high = heights(col, row, col + 8, row + 8)
    c, r = np.clip(np.array(place, int), 1, 254)
    part = level.height[r - 1 : r + 3, c - 1 : c + 3]
    assert low[0] < part[1:3, 1:3].min() - 0.05
    assert high[0] > part[1:3, 1:3].max() + 0.05
    assert lod.cell_m == 1.0 / 2 ** TIERS["medium"].ground_levels
    assert high[0] - low[0] <= 6 * (1 + 2 * OVERSHOOT) + 0.2 + (60 if place[0] < 0 else 0)


def test_culling_never_drops_a_chunk_that_a_point_of_the_picture_needs():
    camera = Camera(id="c", x=200, y=150, z=30, yaw_deg=37, pitch_deg=-25, fov_deg=60)
    matrices = camera_matrices(camera, (320, 180))
    lod = Lod(1.0, 8, 8.0, (0, 0, 400, 400))
    chunks = select(lod, View(matrices.position, matrices.planes, 20.0), flat(0.0, 10.0))
    rng = np.random.default_rng(1)
    points = np.column_stack([rng.uniform(0, 400, (20_000, 2)), rng.uniform(0, 10, 20_000)])
    clip = np.column_stack([points - matrices.position, np.ones(len(points))]) @ matrices.view_projection.T
    seen = points[(np.abs(clip[:, :2]) <= clip[:, 3:]).all(axis=1) & (clip[:, 2] > -clip[:, 3])]
    size = 8 << chunks[:, 2]
    for x, y, _ in seen:
        assert (
            (chunks[:, 0] <= x) & (x <= chunks[:, 0] + size) & (chunks[:, 1] <= y) & (y <= chunks[:, 1] + size)
        ).any()
    assert len(seen) > 500


@pytest.fixture(scope="module")
def large():
    """4097² with relief at every scale, as HeightBounds and a Level."""
    rng = np.random.default_rng(2)
    coarse = rng.standard_normal((65, 65)).astype(np.float32) * 40
    height = np.kron(coarse, np.ones((64, 64), np.float32))
    height = np.pad(height, ((0, 1), (0, 1)), mode="edge")[:4097, :4097]
    return Level(Grid(4097, 4097), height), HeightBounds(height)


def random_cameras(count):
    rng = np.random.default_rng(5)
    for _ in range(count):
        yield Camera(
            id="c", x=rng.uniform(-500, 4600), y=rng.uniform(-500, 4600), z=float(rng.choice([2, 30, 150, 600, 3000])),
            yaw_deg=rng.uniform(0, 360), pitch_deg=rng.uniform(-90, 20), fov_deg=float(rng.choice([30, 60, 90, 120])),
        )  # fmt: skip


def test_at_most_150k_terrain_triangles_at_medium_from_any_camera(large):
    from shorewright.renderer.passes.terrain import terrain_view

    level, bounds = large
    most = 0
    for camera in random_cameras(60):
        matrices = camera_matrices(camera, (1920, 1080))
        lod, view, heights = terrain_view(level, bounds, TIERS["medium"], matrices)
        most = max(most, len(select(lod, view, heights)) * 2 * lod.chunk**2)
    assert 10_000 < most <= MOST_TERRAIN_TRIANGLES


def exact(height, row0, col0, row1, col1):
    part = height[max(row0, 0) : row1 + 1, max(col0, 0) : col1 + 1]
    return part.min(), part.max()


@pytest.mark.parametrize("shape", [(2, 2), (9, 9), (100, 33), (257, 130), (129, 1000)])
def test_bounds_hold_every_sample_before_and_after_an_edit(shape):
    rng = np.random.default_rng(0)
    height = rng.standard_normal(shape).astype(np.float32)
    bounds = HeightBounds(height)
    for _ in range(3):
        assert bounds.range == (height.min(), height.max())
        corners = rng.integers(0, np.array(shape), (50, 2))
        ends = np.minimum(corners + rng.integers(0, 40, (50, 2)), np.array(shape) - 1)
        low, high = bounds.query(corners[:, 0], corners[:, 1], ends[:, 0], ends[:, 1])
        for i in range(50):
            least, most = exact(height, *corners[i], *ends[i])
            assert low[i] <= least
            assert high[i] >= most
        rect = Rect(*corners[0], *(ends[0] + 1))
        height[rect.slices] += rng.uniform(-9, 9)
        bounds.update(height, rect)
