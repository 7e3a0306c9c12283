"""The drawn sea against its CPU twin, to the horizon, without cracks (D01, D10, D30, H05, H21, H30)."""

from pathlib import Path

import numpy as np
import pytest
from scenes import SIZE, camera, coast, is_sea
from shorewright.io import read_level
from shorewright.level import Grid, Level
from shorewright.level.objects import Mover
from shorewright.level.waves import sea_at
from shorewright.renderer import Show, camera_matrices, frame, render
from shorewright.renderer.frame import OFF

pytestmark = pytest.mark.gl
SAMPLES = Path(__file__).parents[1] / "sample_levels"


@pytest.mark.parametrize("quality", ["medium", "high"])
@pytest.mark.parametrize("time_s", [0.0, 7 * 86400.0])
@pytest.mark.parametrize(
    "place", [camera(), camera(z=3.0, pitch=-6.0, yaw=60.0), camera(y=20.0, z=2.0, yaw=190.0, pitch=-9.0)]
)
def test_drawn_surface_is_the_twins_within_3_cm(renderer, quality, time_s, place):
    """Position view within 100 m of the camera, waves of 5 m (D30, H05, D10)."""
    level = coast(rock=9.0)
    level.set("sea.chop_length_m", 5.0)
    options = {"size": SIZE, "time_s": time_s, "quality": quality, "linear": True, "renderer": renderer}
    position = render(level, place, view="position", **options).astype(np.float64)
    material = render(level, place, view="material", **options)
    away = np.linalg.norm(position - [place.x, place.y, place.z], axis=-1)
    near_sea = (is_sea(material)) & (away < 100)
    assert near_sea.sum() > 2000
    x, y, z = position[near_sea].T
    error = np.abs(sea_at(level, time_s, x, y).height_m - z)
    assert error.max() < 0.03


@pytest.mark.parametrize("name", ["cove", "island"])
@pytest.mark.parametrize("where", ["beach", "play"])
def test_drawn_surface_of_the_sample_levels_is_the_twins_within_3_cm(renderer, name, where):
    """The same among the rocks of a real coast (D30); where waves that break carry it, 95 % within 5 cm (D34)."""
    level = read_level(SAMPLES / f"{name}.shore")
    place = level.camera(where)
    options = {"size": (256, 144), "time_s": 12.0, "linear": True, "renderer": renderer}
    position = render(level, place, view="position", **options).astype(np.float64)
    material = render(level, place, view="material", **options)
    away = np.linalg.norm(position - [place.x, place.y, place.z], axis=-1)
    near_sea = (is_sea(material)) & (away < 100)
    assert near_sea.sum() > 1000
    x, y, z = position[near_sea].T
    twin = sea_at(level, 12.0, x, y)
    error, carried_m = np.abs(twin.height_m - z), np.hypot(*(part.v for part in twin.shore.shift))
    assert error[carried_m < 0.02].max() < 0.03
    assert np.quantile(error[carried_m >= 0.02], 0.95) < 0.05


def test_before_and_after_coordinates_agree_with_the_twin(renderer):
    """H30: before is the undeformed point that the twin finds for the drawn world position."""
    level, place = coast(), camera()
    options = {"size": SIZE, "time_s": 3.0, "linear": True, "renderer": renderer}
    before, after, material = (
        render(level, place, view=name, **options).astype(np.float64) for name in ("before", "after", "material")
    )
    sea = is_sea(material)
    twin = sea_at(level, 3.0, after[sea][:, 0], after[sea][:, 1])
    off = np.hypot(twin.before_x - before[sea][:, 0], twin.before_y - before[sea][:, 1])
    assert np.quantile(off, 0.99) < 0.05
    assert np.abs(before - after)[sea].max() > 0.05


@pytest.mark.parametrize(
    ("height", "pitch"), [(25.0, -90.0), (140.0, -90.0), (700.0, -90.0), (-30.0, 24.0), (-120.0, 40.0), (-500.0, 60.0)]
)
def test_no_cracks_in_land_or_sea(renderer, height, pitch):
    """White land alone, then the sea alone, from above and aslant from below: no pixel of what lies behind (D01)."""
    place = camera(x=131.3, y=77.7, z=height, yaw=33.0, pitch=pitch, fov=40.0)
    rng = np.random.default_rng(4)
    bumps = Level(Grid(257, 257), rng.uniform(0, 6, (257, 257)).astype(np.float32))
    options = {"view": "material", "size": (320, 240), "linear": True, "renderer": renderer}
    land = render(bumps, place, show=Show.hide("water"), **options)
    assert len(np.unique(land.reshape(-1, 3), axis=0)) == 1
    assert land.max() > 0.3
    deep = Level(Grid(257, 257), np.full((257, 257), -3000, np.float32))
    deep.set("sea.chop_m", 1.5)  # coarse beside fine cells would gape
    sea = render(deep, place, **options)
    assert is_sea(sea).all()


@pytest.mark.parametrize("height", [15.0, 45.0, 100.0])
def test_land_does_not_pop_where_chunks_are_divided(renderer, height):
    """At x = y = 128 m chunks of every level come and go at once; two centimetres further the land stands as it did."""
    bumps = Level(Grid(257, 257), np.random.default_rng(4).uniform(0, 0.4, (257, 257)).astype(np.float32))
    options = {"view": "position", "size": (160, 160), "linear": True, "renderer": renderer, "show": Show.hide("water")}
    shots, triangles = [], []
    for at in (127.99, 128.01):
        place = camera(x=at, y=at, z=height, yaw=30.0, pitch=-45.0, fov=80.0)
        shots.append(render(bumps, place, **options)[..., 2])
        triangles.append(renderer.stats["terrain_triangles"])
    assert triangles[0] != triangles[1]
    assert np.quantile(np.abs(shots[0] - shots[1]), 0.999) < 0.04


@pytest.mark.parametrize("height", [2.0, 40.0, 400.0])
def test_sea_reaches_the_horizon_without_a_gap(renderer, height):
    """H21: from the mesh to the plane to the sky, every pixel below the horizon is sea."""
    deep = Level(Grid(129, 129), np.full((129, 129), -40, np.float32))
    place = camera(x=64, y=64, z=height, pitch=-3.0, fov=40.0)
    material = render(deep, place, SIZE, 2.0, "material", linear=True, renderer=renderer)
    sea = is_sea(material)
    matrices = camera_matrices(place, SIZE)
    for row in range(SIZE[1]):
        up = matrices.ray(SIZE[0] / 2, row + 0.5, SIZE)[2]
        if abs(up) > 0.006:  # further from the horizon than the waves near the eye reach over it
            assert sea[row].all() == (up < 0), row


@pytest.mark.parametrize("height", [2.0, 200.0])
def test_mesh_and_horizon_plane_look_alike_where_they_join(renderer, monkeypatch, height):
    """H21: the same pixels drawn by the mesh and by the plane differ by at most 2 of 255."""
    from dataclasses import replace

    from shorewright.renderer import quality

    deep = Level(Grid(129, 129), np.full((129, 129), -40, np.float32))
    deep.set("sea.swell_length_m", 6.0)  # lies down before either mesh ends
    place = camera(x=64, y=64, z=height, pitch=-max(1.0, height / 20), fov=max(5.0, height / 8))
    shots = []
    for end in (400.0, 3000.0):
        row = replace(quality.TIERS["medium"], sea_distance_m=end)
        monkeypatch.setitem(quality.TIERS, "medium", row)
        shots.append(render(deep, place, (256, 144), 2.0, renderer=renderer).astype(int))
    position = render(deep, place, (256, 144), 2.0, "position", linear=True, renderer=renderer)
    away = np.hypot(position[..., 0] - 64, position[..., 1] - 64)
    joined = (away > 430) & (away < 2500)  # plane in the first, mesh in the second
    assert joined.sum() > 100
    assert np.abs(shots[0] - shots[1])[joined].max() <= 2


def beyond_the_border(renderer, height: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What is drawn north of a level, `(n, 3)` world points, and the height of their mirror images in it."""
    level, side = Level(Grid(*height.shape), height), height.shape[0]
    place = camera(x=128.0, y=side + 50.0, z=160.0, yaw=0.0, pitch=-90.0, fov=30.0)
    found = render(level, place, (64, 64), view="position", linear=True, show=Show.hide("water"), renderer=renderer)
    points = found.reshape(-1, 3)[found.reshape(-1, 3)[:, 1] > side + 10]
    cells = np.rint([2 * (side - 1) - points[:, 1], points[:, 0]]).astype(int)
    return points, height[cells[0], cells[1]]


def test_land_goes_on_as_its_mirror_image(renderer):
    """Beyond the border (D41, L05): bumps stand there as they do inside, no furrow runs out of one."""
    y, x = np.mgrid[0:257, 0:257]
    height = (12 + 3 * np.sin(x / 9) * np.cos(y / 11)).astype(np.float32)
    points, mirrored = beyond_the_border(renderer, height)
    assert len(points) > 1000
    assert np.abs(points[:, 2] - mirrored).max() < 0.8
    assert np.ptp(points[:, 2]) > 4


def test_no_land_rises_where_the_border_is_sea(renderer):
    """An island near the border of deep water isn't seen twice."""
    y, x = np.mgrid[0:257, 0:257]
    height = (30 * np.exp(-((x - 128) ** 2 + (y - 200) ** 2) / 300) - 12).astype(np.float32)
    points, mirrored = beyond_the_border(renderer, height)
    assert mirrored.max() > 10
    assert points[:, 2].max() < -10


@pytest.mark.parametrize("path", OFF["sea.glsl"])
def test_a_program_without_a_row_draws_what_the_switch_draws(renderer, monkeypatch, path):
    """What is switched off is compiled out: the same picture as by the uniform alone."""
    level = coast(rock=9.0)
    level.put_object("mover", Mover(id="mover", x=128.0, y=90.0, speed_mps=4.0))
    level.set(path, False)
    without = render(level, camera(), SIZE, 6.0, renderer=renderer).astype(int)
    monkeypatch.setattr(frame, "OFF", {})
    switched = render(level, camera(), SIZE, 6.0, renderer=renderer)
    assert np.abs(without - switched).max() <= 1
