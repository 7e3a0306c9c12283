"""Moving the editor's camera: what stays in place stays in place, whatever the movement (D40)."""

import numpy as np
import pytest
from coasts import make_beach
from hypothesis import given
from hypothesis import strategies as st
from shorewright.app import camera_control as control
from shorewright.level.objects import Camera
from shorewright.level.pick import ground_at, pick_ray
from shorewright.renderer.camera import camera_matrices

SIZE = (800, 500)
angles = st.floats(0, 360)
pitches = st.floats(-80, -10)
moves = st.floats(-120, 120)


def camera(yaw=30.0, pitch=-35.0, x=60.0, y=20.0, z=30.0) -> Camera:
    return Camera(id="view", x=x, y=y, z=z, yaw_deg=yaw, pitch_deg=pitch)


def pixel(view: Camera, point) -> np.ndarray:
    pixels, ahead = control.to_screen(view, SIZE, np.array([point], float))
    assert ahead[0]
    return pixels[0]


def ahead(view: Camera, px: float, py: float, distance: float) -> np.ndarray:
    return control.place(view) + camera_matrices(view, SIZE).ray(px, py, SIZE) * distance


@given(angles, pitches, st.floats(50, 750), st.floats(50, 450))
def test_to_screen_inverts_the_pixel_ray(yaw, pitch, px, py):
    view = camera(yaw, pitch)
    assert pixel(view, ahead(view, px, py, 40)) == pytest.approx((px, py), abs=1e-6)


@given(angles, pitches, moves, moves)
def test_orbit_keeps_its_pivot_where_it_is(yaw, pitch, dx, dy):
    """Distance and place in the picture stay, wherever the pivot is in it."""
    view = camera(yaw, pitch)
    pivot = ahead(view, 520, 300, 45)
    turned = control.orbit(view, pivot, dx, dy)
    assert np.linalg.norm(control.place(turned) - pivot) == pytest.approx(45)
    assert pixel(turned, pivot) == pytest.approx((520, 300), abs=1e-4)


@given(angles, pitches, moves, moves)
def test_pan_drags_the_point_with_the_pointer(yaw, pitch, dx, dy):
    view = camera(yaw, pitch)
    pivot = ahead(view, 400, 250, 60)
    slid = control.pan(view, pivot, dx, dy, SIZE)
    assert pixel(slid, pivot) == pytest.approx((400 + dx, 250 + dy), abs=1e-4)
    assert (slid.yaw_deg, slid.pitch_deg) == (view.yaw_deg, view.pitch_deg)


@given(st.floats(-6, 12), st.floats(60, 740), st.floats(60, 440))
def test_zoom_goes_to_the_point_under_the_pointer(notches, px, py):
    view = camera()
    point = ahead(view, px, py, 50)
    near = control.zoom(view, point, notches)
    distance = np.linalg.norm(control.place(near) - point)
    assert distance == pytest.approx(max(50 * control.ZOOM_PER_NOTCH**notches, control.CLOSEST_M))
    assert pixel(near, point) == pytest.approx((px, py), abs=1e-4)


def test_zoom_never_goes_through_the_point():
    view = camera()
    point = ahead(view, 400, 250, 10)
    for _ in range(200):
        view = control.zoom(view, point, 3)
    assert np.linalg.norm(control.place(view) - point) == pytest.approx(control.CLOSEST_M)
    assert control.zoom(view, control.place(view), 1) == view


@given(angles, st.floats(-1e5, 1e5), st.floats(-1e5, 1e5))
def test_looking_round_stays_and_keeps_its_limits(yaw, dx, dy):
    view = camera(yaw)
    turned = control.turn(view, dx, dy)
    assert np.array_equal(control.place(turned), control.place(view))
    assert 0 <= turned.yaw_deg < 360
    assert control.PITCH_DEG[0] <= turned.pitch_deg <= control.PITCH_DEG[1]
    Camera.model_validate(turned.model_dump())


def test_flight_follows_the_view_and_the_keys():
    view = camera(yaw=90.0, pitch=0.0)
    assert control.place(control.fly(view, {"w"}, 2.0, 5.0)) == pytest.approx((70, 20, 30))
    assert control.place(control.fly(view, {"d"}, 1.0, 5.0)) == pytest.approx((60, 15, 30))
    assert control.place(control.fly(view, {"e", "w"}, 1.0, 5.0)) == pytest.approx((60 + 12.5**0.5, 20, 30 + 12.5**0.5))
    assert control.fly(view, {"w", "s"}, 1.0, 5.0) == view
    assert control.fly(view, {"x"}, 1.0, 5.0) == view
    assert control.fly(view, {"w"}, 0.0, 5.0) == view


def test_flight_is_faster_from_higher_up():
    level = make_beach()
    speeds = [control.fly_speed_mps(level, camera(z=z)) for z in (1.0, 20.0, 60.0)]
    assert speeds == sorted(speeds)
    assert speeds[0] < speeds[2]


def test_the_camera_stays_out_of_the_ground_and_near_the_world():
    level = make_beach()
    under = camera(x=80, y=100, z=-50)
    lifted = control.above_ground(level, under)
    assert lifted.z == pytest.approx(float(ground_at(level, 80, 100)) + 0.35)
    assert control.above_ground(level, camera()) == camera()
    far = control.moved(camera(), (1e12, -1e12, 0))
    assert max(map(abs, control.place(far))) <= control.FARTHEST_M


def test_pivot_is_the_picked_point_else_one_ahead_on_the_sea():
    level = make_beach()
    view = camera()
    matrices = camera_matrices(view, SIZE)
    picked = pick_ray(level, matrices.position, matrices.ray(400, 250, SIZE))
    assert control.pivot_ahead(level, view, picked) == pytest.approx(picked)
    assert control.pivot_ahead(level, view)[2] == pytest.approx(0.0)
    up = control.pivot_ahead(level, camera(pitch=20.0))
    assert 2 <= np.linalg.norm(up - control.place(view)) <= max(level.grid.extent_m)


def test_a_flight_to_another_camera_starts_and_ends_exactly():
    start, end = camera(yaw=350.0), camera(yaw=20.0, x=10, z=90)
    assert control.place(control.between(start, end, 0)) == pytest.approx(control.place(start))
    assert control.between(start, end, 1) == end
    yaw = control.between(start, end, 0.5).yaw_deg
    assert yaw > 350 or yaw < 20  # the short way round


def test_points_behind_the_camera_are_told_apart():
    view = camera(yaw=0.0, pitch=0.0)
    _, before = control.to_screen(view, SIZE, np.array([[60.0, 50.0, 30.0], [60.0, -50.0, 30.0]]))
    assert before.tolist() == [True, False]
