"""The sea's mesh on the GPU: extents, patches, horizon, tessellation, no crack, nothing undefined (H01, H02, H21)."""

import numpy as np
import pytest
from scenes import SIZE, camera, coast, is_sea
from shorewright.level import Grid, Level
from shorewright.level.objects import SeaPatch, ViewCircle
from shorewright.level.patches import extents, in_mesh
from shorewright.level.waves import surface_at
from shorewright.renderer import camera_matrices, render

pytestmark = pytest.mark.gl
MESHES = ("grid", "tessellated")


def open_sea(mesh="grid", radius_m=0.0, x=128.0, y=128.0):
    """Nothing but deep water; with a radius, authored extents about a point."""
    level = Level(Grid(257, 257), np.full((257, 257), -60, np.float32))
    level.set("sea.mesh", mesh)
    if radius_m:
        level.put_object("seen", ViewCircle(id="seen", x=x, y=y, radius_m=radius_m))
    return level


def shot(renderer, level, place, view, size=SIZE, time_s=3.0, quality="medium"):
    options = {"view": view, "size": size, "time_s": time_s, "quality": quality, "linear": True}
    return render(level, place, renderer=renderer, **options).astype(np.float64)


@pytest.mark.parametrize("mesh", MESHES)
@pytest.mark.parametrize("height", [1.7, 30.0, 200.0])
@pytest.mark.parametrize("radius_m", [0.0, 140.0])
def test_no_unwritten_pixel_below_the_horizon(renderer, mesh, height, radius_m):
    """H01, H02, H21: mesh and plane leave no hole, with the mesh round the camera or authored."""
    if mesh == "tessellated" and not radius_m:
        pytest.skip("software tessellates whole square kilometres slowly")
    level, place = open_sea(mesh, radius_m, 150.0, 170.0), camera(z=height, pitch=-14.0, fov=60.0)
    sea = is_sea(shot(renderer, level, place, "material"))
    matrices = camera_matrices(place, SIZE)
    ups = np.array([matrices.ray(SIZE[0] / 2, row + 0.5, SIZE)[2] for row in range(SIZE[1])])
    assert (ups < -0.02).sum() > 20
    assert sea[ups < -0.02].all()


def test_the_mesh_is_the_hectares_that_the_circle_touches(renderer):
    """H01: triangles there, the horizon's plane everywhere else."""
    level, place = open_sea("grid", 120.0, 150.0, 170.0), camera(x=150.0, y=170.0, z=600.0, pitch=-90.0, fov=50.0)
    area, before = (shot(renderer, level, place, view, (160, 120)) for view in ("triangle_area", "before"))
    plane = np.abs(area - [0.03, 0.06, 0.15]).max(axis=-1) < 1e-3
    col, row = np.floor(before[..., 0] / 100), np.floor(before[..., 1] / 100)
    rest = np.minimum(before[..., :2] % 100, 100 - before[..., :2] % 100).min(axis=-1)
    sure = rest > 8.0  # a pixel beside a hectare's border may be either
    expected = ~in_mesh(extents(level), col, row)
    assert plane.any()
    assert (~plane).sum() > 500
    assert np.array_equal(plane[sure], expected[sure])


def test_without_view_circles_the_mesh_moves_in_whole_hectares(renderer):
    """H01: about the camera, and no vertex ever leaves its place in the world."""
    from shorewright.renderer.passes.sea import sea_chunks, sea_extent
    from shorewright.renderer.views import VIEWS

    boxes, grids = [], []
    for x in (110.0, 150.0, 199.0, 201.0):
        frame = renderer.prepare(open_sea(), camera(x=x), SIZE, 0.0, VIEWS["final"], None, "medium", None)
        extent = sea_extent(frame)
        lod, _, chunks = sea_chunks(frame, extent)
        boxes.append(extent.box_m)
        grids.append((chunks[:, :2] * lod.cell_m, (lod.chunk << chunks[:, 2]) * lod.cell_m))
        west, south, east, north = extent.box_m
        assert min(x - west, east - x, 60.0 - south, north - 60.0) >= frame.tier.sea_distance_m
    assert boxes[0] == boxes[1] == boxes[2]
    assert boxes[3][0] == boxes[0][0] + 100.0
    for corners, sizes in grids:
        assert np.array_equal(corners % sizes[:, None], np.zeros_like(corners))
        small = sizes <= 100.0
        assert np.array_equal(corners[small] // 100.0, (corners[small] + sizes[small, None] - 0.01) // 100.0)


def test_software_draws_grids_and_the_setting_is_obeyed(renderer):
    """H02: one switch; auto goes by who draws."""
    from shorewright.renderer.passes.sea import software, tessellated
    from shorewright.renderer.views import VIEWS

    def chosen(mesh):
        level = open_sea(mesh)
        return tessellated(renderer.prepare(level, camera(), SIZE, 0.0, VIEWS["final"], None, "low", None))

    assert [chosen(mesh) for mesh in MESHES] == [False, True]
    assert chosen("auto") == (not software(renderer.ctx))


def test_waves_die_out_with_the_distance_by_two_knobs(renderer):
    """H31: a nearer or steeper fall leaves less of the swell."""
    place, highest = camera(y=-400.0, z=60.0, yaw=0.0, pitch=-8.0), []
    for near_m, falloff in ((120.0, 1.6), (40.0, 1.6), (120.0, 3.0)):
        level = open_sea()
        level.set("sea.near_m", near_m)
        level.set("sea.falloff", falloff)
        position = shot(renderer, level, place, "position")
        away = np.hypot(position[..., 0] - place.x, position[..., 1] - place.y)
        highest.append(np.abs(position[(away > 400) & (away < 600)][:, 2]).max())
    assert highest[0] > 0.1
    assert highest[1] < 0.5 * highest[0]
    assert highest[2] < 0.5 * highest[0]


@pytest.mark.parametrize("mesh", MESHES)
def test_waves_lie_flat_where_the_mesh_ends(renderer, mesh):
    """H31: at the circle's rim the surface is the plane of the horizon; in its middle it isn't."""
    level, place = open_sea(mesh, 150.0), camera(x=128.0, y=128.0, z=330.0, pitch=-90.0, fov=60.0)
    position = shot(renderer, level, place, "position")
    away = np.hypot(position[..., 0] - 128, position[..., 1] - 128)
    assert np.abs(position[away > 170][:, 2]).max() < 1e-3  # a cell of the hull farther out
    assert np.abs(position[away < 80][:, 2]).max() > 0.1


@pytest.mark.parametrize("height", [2.0, 200.0])
def test_authored_mesh_and_horizon_look_alike_where_they_join(renderer, height):
    """H21: the same pixels as mesh and as plane differ by at most 2 of 255."""
    place = camera(x=64, y=64, z=height, pitch=-max(1.0, height / 20), fov=max(5.0, height / 8))
    shots = []
    for radius_m in (450.0, 3000.0):
        level = open_sea("grid", radius_m, 64.0, 64.0)
        level.set("sea.swell_length_m", 6.0)  # lies down before either mesh ends
        shots.append(render(level, place, (256, 144), 2.0, renderer=renderer).astype(int))
        position = shot(renderer, level, place, "position", (256, 144), 2.0)
    away = np.hypot(position[..., 0] - 64, position[..., 1] - 64)
    joined = (away > 600) & (away < 2800)
    assert joined.sum() > 100
    assert np.abs(shots[0] - shots[1])[joined].max() <= 2


def test_the_plane_is_where_a_ray_meets_it(renderer):
    """H21: p = c - (d / d.z) (c.z - sea) with either sign of d, against a ray traced in float64."""
    level = open_sea("grid", 20.0, -500.0, -500.0)
    level.set("level.sea_level_m", 1.5)
    place = camera(x=90.0, y=40.0, z=12.0, yaw=70.0, pitch=-9.0)
    before = shot(renderer, level, place, "before")
    matrices = camera_matrices(place, SIZE)
    for px, py in ((10, 50), (100, 60), (64, 71), (127, 47)):
        ray = matrices.ray(px + 0.5, py + 0.5, SIZE)
        traced = np.array([place.x, place.y, place.z]) + ray * ((1.5 - place.z) / ray[2])
        formula = [c - d / ray[2] * (place.z - 1.5) for c, d in zip((place.x, place.y), ray[:2], strict=True)]
        assert formula == pytest.approx(traced[:2])
        assert before[py, px, :2] == pytest.approx(traced[:2], abs=2e-3 + 1e-5 * np.abs(traced).max())


def bay():
    level = coast(side=401)
    level.put_object("seen", ViewCircle(id="seen", x=200.0, y=180.0, radius_m=150.0))
    return level


@pytest.mark.parametrize("place", [camera(x=200.0, y=120.0, z=30.0), camera(x=200.0, y=150.0, z=3.0, pitch=-12.0)])
def test_grid_and_tessellation_draw_one_surface(renderer, place):
    """H02: found along each pixel's ray, the surface is the same whatever triangles led there.

    Few pixels, low over the water, leave triangles of metres: there some crests stand as the mesh has them.
    """
    level, found = bay(), []
    for mesh in MESHES:
        level.set("sea.mesh", mesh)
        found.append([shot(renderer, level, place, view) for view in ("position", "material")])
    (grid, one), (fine, two) = found
    both = is_sea(one) & is_sea(two)
    away = np.hypot(grid[..., 0] - place.x, grid[..., 1] - place.y)
    both &= away < 100
    assert both.sum() > 1500
    assert (is_sea(one) != is_sea(two)).mean() < 0.005
    off = np.linalg.norm(grid - fine, axis=-1)[both] / np.maximum(away[both], 10.0)
    assert np.quantile(off, 0.95) < 0.01


@pytest.mark.parametrize("height", [1.7, 100.0])
def test_tessellation_makes_no_triangle_under_16_pixels(renderer, height):
    """H02: on a calm sea; what is smaller is the undivided mesh of 10 m, far off at a low angle."""
    level = open_sea("tessellated", 200.0)
    level.set("sea.on", False)
    place = camera(x=128.0, y=40.0, z=height, pitch=-12.0, fov=50.0)
    red = shot(renderer, level, place, "triangle_area", (320, 180))[..., 0] > 0.85
    small = red & (shot(renderer, level, place, "triangle_area", (320, 180))[..., 1] < 0.1)
    position = shot(renderer, level, place, "position", (320, 180))
    away = np.hypot(position[..., 0] - place.x, position[..., 1] - place.y)
    pixel_angle = 2 * np.tan(np.radians(25)) / 180
    undivided = height * 100 / (2 * np.maximum(away, 1) ** 3 * pixel_angle**2) < 40
    assert not (small & ~undivided).any()
    assert (~small).sum() > 5000


def test_removed_patches_draw_nothing_and_their_neighbours_all(renderer):
    """H01, H27: neither mesh nor horizon."""
    level, place = open_sea("grid", 150.0), camera(x=150.0, y=150.0, z=500.0, pitch=-90.0, fov=60.0)
    level.set("sea.on", False)
    level.put_object("in", SeaPatch(id="in", x=150.0, y=150.0, sea="removed"))
    level.put_object("out", SeaPatch(id="out", x=350.0, y=150.0, sea="removed"))
    sea = is_sea(shot(renderer, level, place, "material", (160, 120)))
    matrices = camera_matrices(place, (160, 120))
    rays = np.array([[matrices.ray(x + 0.5, y + 0.5, (160, 120)) for x in range(160)] for y in range(120)])
    x, y = (at - rays[..., i] / rays[..., 2] * 500 for i, at in enumerate((place.x, place.y)))
    removed = np.isin(np.floor(x / 100), (1, 3)) & (np.floor(y / 100) == 1)
    rest = np.minimum(np.minimum(x % 100, 100 - x % 100), np.minimum(y % 100, 100 - y % 100))
    assert removed.sum() > 300
    assert np.array_equal(sea[rest > 4], ~removed[rest > 4])


@pytest.mark.parametrize("mesh", MESHES)
def test_an_overridden_patch_is_the_twins_within_1_mm(renderer, mesh):
    """H27: shader and CPU agree on the shore waves in an open hectare and where they come back beside it."""
    level, place = bay(), camera(x=150.0, y=140.0, z=25.0, yaw=20.0, pitch=-25.0)
    level.set("sea.mesh", mesh)
    level.put_object("calm", SeaPatch(id="calm", x=150.0, y=150.0, sea="open"))
    before, lift, material = (shot(renderer, level, place, view) for view in ("before", "shore_lift", "material"))
    sea = is_sea(material)
    twin = surface_at(level, 3.0, before[sea][:, 0], before[sea][:, 1]).shore.lift.v
    assert np.abs(twin).max() > 0.1
    assert np.abs(lift[sea][:, 0] - twin).max() < 1e-3
    calm = (before[..., 0] > 104) & (before[..., 0] < 196) & (before[..., 1] > 104) & (before[..., 1] < 196) & sea
    assert calm.sum() > 300
    assert np.abs(lift[calm]).max() == 0.0


@pytest.mark.parametrize("mesh", MESHES)
@pytest.mark.parametrize("height", [0.0, 0.4, 6.0, -3.0])
def test_no_target_holds_anything_undefined(renderer, mesh, height):
    """On, above and below the surface every float of every target is a number."""
    level = bay()
    level.set("sea.mesh", mesh)
    renderer.draw(level, camera(x=200.0, y=170.0, z=height, pitch=-4.0, yaw=5.0), (64, 36), 3.0)
    targets = next(iter(renderer.targets.values()))
    kinds = {"f2": np.float16, "f4": np.float32}
    read = 0
    for name, texture in targets.textures.items():
        if texture.dtype in kinds and name not in ("total",):
            values = np.frombuffer(texture.read(), kinds[texture.dtype])
            assert np.isfinite(values).all(), name
            read += 1
    assert read >= 6
