"""The pointer in the sky (T04): where rays meet the shell of clouds, and what part of a picture sees a stroke."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shorewright.level import Grid, Level, Rect
from shorewright.level.layers import WEATHER_GRID
from shorewright.level.objects import Camera
from shorewright.level.pick_sky import FARTHEST_M, bend_m, on_shell, pick_sky, shell_distance, sphere_hits
from shorewright.level.sky_rect import sky_rect
from shorewright.level.weather import paint_place
from shorewright.renderer.camera import camera_matrices

BASE, TOP, RADIUS = 1500.0, 4000.0, 6_371_000.0


@pytest.fixture(scope="module")
def level():
    height = np.zeros((65, 65), np.float32)
    height[40:, :] = 60.0  # a plateau to the north
    return Level(Grid(65, 65, 4.0), height)


def root(value: Fraction) -> Fraction:
    """A square root to thirty digits."""
    scale = 10**60
    return Fraction(math.isqrt(int(value * scale)), 10**30)


@pytest.mark.parametrize("eye_m", [0.3, 200.0, 1499.9, 1500.1, 3999.0, 9000.0])
@pytest.mark.parametrize("pitch_deg", [90.0, 45.0, 5.0, 0.5, 0.0, -0.5, -30.0, -90.0])
def test_distances_hold_against_exact_numbers(eye_m, pitch_deg):
    """Check 4 of the research: no metres are lost at the planet's radius; here against rationals of any length."""
    rise = math.sin(math.radians(pitch_deg))
    for altitude_m in (BASE, TOP):
        b = (Fraction(RADIUS) + Fraction(eye_m)) * Fraction(rise)
        c = (Fraction(RADIUS) + Fraction(eye_m)) ** 2 - (Fraction(RADIUS) + Fraction(altitude_m)) ** 2
        hits = sphere_hits(rise, eye_m, altitude_m, RADIUS)
        if b * b - c < 0:
            assert hits is None
            continue
        exact = [float(-b - root(b * b - c)), float(-b + root(b * b - c))]
        np.testing.assert_allclose(hits, exact, rtol=1e-9, atol=1e-4)


def test_a_shell_is_seen_where_geometry_puts_it(level):
    """Check 5: at 35 km a base of 1500 m stands at 2.3 degrees; straight up it is as high as it is."""
    assert shell_distance(level, 0.0, 1.0) == pytest.approx(1500.0)
    assert shell_distance(level, 200.0, 1.0) == pytest.approx(1300.0)
    distance = shell_distance(level, 0.0, math.sin(math.radians(2.3)))
    assert distance == pytest.approx(35_000, rel=0.02)
    assert shell_distance(level, 2.0, math.sin(math.radians(0.0))) == pytest.approx(138_000, rel=0.01)
    assert shell_distance(level, 50.0, math.sin(math.radians(-3.0))) is None


@pytest.mark.parametrize(
    ("eye_m", "rise", "expected"),
    [(2000.0, -1.0, 500.0), (2000.0, 1.0, 2000.0), (6000.0, -1.0, 4500.0), (6000.0, 1.0, None), (6000.0, 0.0, None)],
)
def test_it_is_met_from_within_and_from_above(level, eye_m, rise, expected):
    """Downwards its inner side, from within upwards its outer side, from above upwards nothing."""
    distance = shell_distance(level, eye_m, rise)
    assert distance is None if expected is None else distance == pytest.approx(expected)


@settings(max_examples=200, deadline=None)
@given(st.floats(-100, 300), st.floats(-100, 300), st.floats(61, 12_000), st.floats(0, 360), st.floats(-89, 89))
def test_a_point_that_is_picked_lies_on_the_shell_and_not_too_far(x, y, z, yaw, pitch):
    coast = Level(Grid(9, 9, 20.0), np.zeros((9, 9), np.float32))
    yaw, pitch = math.radians(yaw), math.radians(pitch)
    ray = (math.sin(yaw) * math.cos(pitch), math.cos(yaw) * math.cos(pitch), math.sin(pitch))
    point = pick_sky(coast, (x, y, z), ray)
    if point is None:
        return
    away = math.hypot(point[0] - x, point[1] - y)
    assert away <= FARTHEST_M + 1
    altitude = point[2] + float(bend_m(coast, away, point[2]))
    assert min(abs(altitude - BASE), abs(altitude - TOP)) < 0.05


def test_land_is_before_the_sky(level):
    """A hill hides the shell behind it; over it the sky begins."""
    assert pick_sky(level, (128, 20, 2.0), (0, 1, 0.2)) is None
    x, y, z = pick_sky(level, (128, 20, 2.0), (0, 1, 1.0))
    assert z == pytest.approx(1500, abs=0.5)
    assert (x, y) == pytest.approx((128, 20 + 1498), abs=1)
    assert pick_sky(level, (128, 20, 2.0), (0, 1, 0.0)) is None
    assert pick_sky(level, (128, 20, 2.0), (0, 0, 0)) is None
    assert pick_sky(level, (128, 20, math.nan), (0, 0, 1)) is None


def test_points_on_the_shell_are_where_rays_meet_it(level):
    """The ring's circle and the pick agree."""
    eye = np.array([10.0, -40.0, 70.0])
    for x, y in ((1000, 2000), (-20_000, 9000), (10, -40)):
        point = on_shell(level, eye, x, y, BASE)
        picked = pick_sky(level, eye, point - eye)
        np.testing.assert_allclose(picked, point, atol=0.05)


# The part of the picture that sees a stroke

CAMERAS = [
    Camera(id="a", x=100, y=50, z=2, yaw_deg=20, pitch_deg=12, fov_deg=60),
    Camera(id="b", x=-900, y=700, z=80, yaw_deg=200, pitch_deg=75, fov_deg=90),
    Camera(id="c", x=0, y=0, z=2500, yaw_deg=90, pitch_deg=0, fov_deg=70),
    Camera(id="d", x=5000, y=-8000, z=9000, yaw_deg=310, pitch_deg=-50, fov_deg=50),
]
RECTS = [Rect(256, 256, 300, 290), Rect(10, 480, 30, 512), Rect(0, 0, 20, 25), Rect(200, 240, 330, 300)]


@pytest.mark.parametrize("camera", CAMERAS, ids=lambda camera: camera.id)
@pytest.mark.parametrize("rect", RECTS, ids=str)
@pytest.mark.parametrize("time_s", [0.0, 3456.7])
def test_every_ray_through_the_cells_is_inside(level, camera, rect, time_s):
    """T04: pixels whose ray goes between base and top over cells that changed lie in the rectangle."""
    size = (64, 36)
    matrices = camera_matrices(camera, size)
    box = sky_rect(level, matrices, [rect], time_s)
    crossing = 0
    for row in range(size[1]):
        for col in range(size[0]):
            if not crosses(level, matrices, matrices.ray(col + 0.5, row + 0.5, size), rect, time_s):
                continue
            crossing += 1
            assert box is not None
            assert box[0] <= (col + 0.5) / size[0] <= box[2]
            assert box[1] <= 1 - (row + 0.5) / size[1] <= box[3]
    if box is None:
        assert not crossing


def crosses(level, matrices, ray, rect, time_s) -> bool:
    """Whether a ray is between base and top anywhere over the cells, within half a torus of the camera."""
    t = np.linspace(1, 35_000, 1200)
    points = matrices.position + t[:, None] * ray
    away = np.hypot(*(points[:, :2] - matrices.position[:2]).T)
    altitude = points[:, 2] + bend_m(level, away, points[:, 2].clip(0))
    x, y = paint_place(level, time_s, points[:, 0], points[:, 1])
    rows, cols = WEATHER_GRID.to_cells(x, y)
    inside = (altitude >= BASE) & (altitude <= TOP) & (away < 35_000)
    inside &= (rows >= rect.row0) & (rows <= rect.row1 - 1) & (cols >= rect.col0) & (cols <= rect.col1 - 1)
    return bool(inside.any())


def test_the_rectangle_is_no_larger_than_it_must_be(level):
    """A small spot before the camera takes a small part of the picture, one behind it none."""
    ahead, behind = camera_matrices(CAMERAS[0], (64, 36)), camera_matrices(
        Camera(id="e", x=100, y=50, z=2, yaw_deg=200, pitch_deg=12, fov_deg=60), (64, 36)
    )  # fmt: skip
    level.set("clouds.shear_m", 0.0)
    spot = Rect(330, 281, 334, 285)  # ten kilometres off to the north, a little east
    box = sky_rect(level, ahead, [spot], 0.0)
    level.set("clouds.shear_m", 500.0)
    assert box is not None
    assert (box[2] - box[0]) * (box[3] - box[1]) < 0.1
    assert sky_rect(level, behind, [spot], 0.0) is None
    assert sky_rect(level, ahead, [], 0.0) is None
    assert sky_rect(level, ahead, [WEATHER_GRID.rect], 0.0) == (0.0, pytest.approx(0.35, abs=0.2), 1.0, 1.0)
