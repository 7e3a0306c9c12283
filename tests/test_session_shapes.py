"""Grids under the same coast, and where cameras stand: pure geometry (T08, D40)."""

import math

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app.session import Session
from shorewright.level import Grid, Level, Rect
from shorewright.level.framing import cameras, find_shore, frame
from shorewright.level.objects import Camera
from shorewright.level.reshape import crop, crop_rect, resample, resize, resized_grid
from shorewright.level.starter import sloping_beach


@pytest.mark.parametrize("step", [0.25, 0.5, 1.0, 1.7, 3.0])
def test_resampling_keeps_constants_and_slopes(step):
    """An even slope stays the same slope, a plain stays a plain."""
    rows, cols = 60, 80
    slope = (np.arange(rows)[:, None] * 0.3 + np.arange(cols) * -0.2).astype(np.float32)
    shape = (math.floor((rows - 1) / step) + 1, math.floor((cols - 1) / step) + 1)
    expected = np.arange(shape[0])[:, None] * step * 0.3 + np.arange(shape[1]) * step * -0.2
    assert np.allclose(resample(slope, shape, (step, step)), expected, atol=1e-4)
    assert np.allclose(resample(np.full((rows, cols), 7, np.float32), shape, (step, step)), 7)


def test_resampling_at_the_same_spacing_copies():
    values = np.random.default_rng(1).normal(size=(30, 40, 2)).astype(np.float32)
    assert np.array_equal(resample(values, (30, 40), (1, 1)), values)


def test_shrinking_averages_detail_away():
    """A checkerboard too fine for the new cells becomes its mean, not a false pattern."""
    board = (np.indices((101, 101)).sum(0) % 2).astype(np.float32)
    small = resample(board, (26, 26), (4, 4))
    assert np.ptp(small[2:-2, 2:-2]) < 0.02


def test_resizing_there_and_back_is_exact_on_the_samples():
    level = make_beach(rough_m=0.3)
    level.write("foam", Rect(10, 10, 40, 50), 0.5)
    height, foam = level.height.copy(), level.layers["foam"].array.copy()
    resize(level, resized_grid(level.grid, cell_m=0.5))
    assert level.grid == Grid(257, 321, 0.5)
    assert np.array_equal(level.height[::2, ::2], height)
    assert np.array_equal(level.layers["foam"].array[::2, ::2], foam)


def test_cropping_moves_the_place_on_earth():
    level = make_beach()
    level.georeference = {"easting": 1000.0, "northing": 5000.0, "crs": "EPSG:32604"}
    assert crop(level, crop_rect(level.grid, 10.2, 20.7, 90, 80)) == (10, 20)
    assert level.georeference == {"easting": 1010.0, "northing": 5020.0, "crs": "EPSG:32604"}
    assert level.grid == Grid(61, 81, 1.0)


def test_cropping_moves_latitude_and_longitude():
    """Kilometres north of Perth: a minute of arc is 1848 m north and 1565 m east there."""
    level = Level(Grid(100, 100, 100.0), np.zeros((100, 100), np.float32))
    level.georeference = {"latitude": -32.0, "longitude": 115.5}
    crop(level, crop_rect(level.grid, 1600, 1800, 5000, 5000))
    assert level.georeference["latitude"] == pytest.approx(-32 + 1800 / 1848 / 60, abs=1e-5)
    assert level.georeference["longitude"] == pytest.approx(115.5 + 1600 / 1575 / 60, abs=1e-4)


@pytest.mark.parametrize("side", [33, 257, 513])
def test_a_new_beach_has_sea_and_land(side):
    grid = Grid(side, side, 512 / (side - 1))
    base = sloping_beach(grid)
    wet = float((base < 0).mean())
    assert 0.4 < wet < 0.8
    assert base[0].max() < 0 < base[-1].min()
    assert np.array_equal(base, sloping_beach(grid))
    assert not np.array_equal(base, sloping_beach(grid, seed=8))


@pytest.mark.parametrize("turn", range(4))
def test_the_shore_is_found_whichever_way_it_faces(turn):
    """A straight beach: a point on its water line, and the way out to sea."""
    height = np.ascontiguousarray(np.rot90(make_beach(rows=129, cols=129).height, turn))
    shore = find_shore(Level(Grid(129, 129), height))
    level = Level(Grid(129, 129), height)
    assert abs(level.height[round(shore.y), round(shore.x)]) < 0.2
    expected = {0: 180, 1: 270, 2: 0, 3: 90}[turn]  # rot90 brings row 0, the south, to the west
    assert abs((shore.seaward_deg - expected + 180) % 360 - 180) < 3


def project(camera, point):
    """Tangents (right, up) of a point as a camera sees it; None behind it."""
    yaw, pitch = math.radians(camera.yaw_deg), math.radians(camera.pitch_deg)
    ahead = np.array([math.sin(yaw) * math.cos(pitch), math.cos(yaw) * math.cos(pitch), math.sin(pitch)])
    right = np.array([math.cos(yaw), -math.sin(yaw), 0])
    way = np.array(point) - (camera.x, camera.y, camera.z)
    depth = way @ ahead
    return None if depth <= 0 else (way @ right / depth, way @ np.cross(right, ahead) / depth)


def test_cameras_look_at_the_shore_from_above_and_from_the_sand():
    """D40: play at 55° from above with the water line in it, beach at eye height, survey over the whole level."""
    level = Level(Grid(513, 513), sloping_beach(Grid(513, 513)))
    shore = find_shore(level)
    play, beach, survey = cameras(level)
    assert [camera.id for camera in (play, beach, survey)] == ["play", "beach", "survey"]
    assert play.pitch_deg == -55
    right, up = project(play, (shore.x, shore.y, 0))
    assert abs(right) < 0.3
    assert abs(up) < 0.3
    ground = level.height[round(beach.y), round(beach.x)]
    assert beach.z - max(ground, 0) == pytest.approx(1.7, abs=0.3)
    assert ground < 1.5  # at the swash
    assert survey.z > 200
    corners = [project(survey, (x, y, 0)) for x in (0, 512) for y in (0, 512)]
    assert all(corner is not None for corner in corners)


@pytest.mark.parametrize("height", [-5.0, 5.0], ids=["sea", "land"])
def test_levels_without_a_shore_have_cameras_too(height):
    level = Level(Grid(65, 65), np.full((65, 65), height, np.float32))
    assert find_shore(level) is None
    for camera in cameras(level):
        assert camera.z > max(height, 0)


def test_framing_puts_a_point_into_the_middle():
    level = make_beach()
    camera = cameras(level)[0]
    framed = frame(level, camera, (40.0, 90.0, 2.0))
    assert project(framed, (40.0, 90.0, 2.0)) == pytest.approx((0, 0), abs=1e-3)
    assert framed.yaw_deg == camera.yaw_deg


def test_a_crop_tells_what_it_leaves_outside(tmp_path):
    """A camera that saw the beach may see nothing now; one that stood outside before is as it was."""
    with Session(make_beach(), spill_root=tmp_path) as session:
        for name, x, y in (("in", 30, 30), ("out", 120, 90), ("far", 500, 500)):
            session.place(Camera(id=name, x=x, y=y))
        session.crop(20, 20, 80, 80)
        assert session.notes == ["outside the level now, where they stood: out"]
        assert (session.level.objects["in"].x, session.level.objects["out"].x) == (10, 100)
