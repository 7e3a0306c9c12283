"""One of sixteen: a still camera gets the full march, a moving one comes near it (Z16)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level import Rect
from shorewright.level.objects import Camera
from shorewright.renderer.passes import cloud_history, clouds, weather
from shorewright.renderer.views import find_view

SIZE = (480, 270)
PART = 60 * 34  # a quarter of the image's 240 × 135, rounded up
SKY = np.array([3.0, 5.0, 9.0])


@pytest.fixture
def sky():
    level = make_beach()
    values = {"clouds.on": True, "weather.coverage": 0.75, "weather.type": 0.9, "weather.variety": 0.5}
    for path, value in values.items():
        level.set(path, value)
    return level


def camera(x=0.0, yaw=60.0):
    return Camera(id="c", x=x, y=0, z=60, yaw_deg=yaw, pitch_deg=15, fov_deg=60)


def step(renderer, level, place, time_s=0.0, live=True, size=SIZE, quality="low"):
    """The passes of one picture's clouds; what they counted."""
    frame = renderer.prepare(level, place, size, time_s, find_view("final"), None, quality, None)
    frame.live = live
    weather.draw(frame)
    clouds.draw(frame)
    return frame.stats


def image(renderer):
    """Light and transmittance, and the clouds' distance, as bits."""
    made = renderer.kept["clouds"].image
    light = np.frombuffer(made.textures[0].read(), np.float16).reshape(*made.size[::-1], 4)
    return light, np.frombuffer(made.textures[1].read(), np.float32)


def likeness_db(renderer, level, way, frames=32):
    """Peak signal to noise of the composite over an even sky after live frames along a way, against the full march."""
    renderer.kept.pop("clouds", None)
    for number in range(frames):
        live = composite(renderer, level, camera(*way(number)))
    renderer.kept.pop("clouds", None)
    full = composite(renderer, level, camera(*way(frames - 1)), live=False)
    white = np.percentile(full, 99.5)
    live, full = (np.clip(part / white, 0, 1) ** (1 / 2.2) for part in (live, full))  # about as on a display
    return -10 * np.log10(np.square(live - full).mean())


def composite(renderer, level, place, live=True):
    frame = renderer.prepare(level, place, SIZE, 0.0, find_view("final"), None, "medium", None)
    frame.live = live
    frame.targets.gbuffer.clear()
    weather.draw(frame)
    frame.targets.picture.clear(*SKY, 1.0)
    clouds.draw(frame)
    return np.frombuffer(frame.targets.picture.read(components=3, dtype="f4"), np.float32)


def test_a_still_camera_gets_the_full_march_bit_for_bit(renderer, sky):
    """Z16: after sixteen frames, whatever was there before; each marches exactly the quarter-size target."""
    renderer.kept.pop("clouds", None)
    step(renderer, sky, camera(900.0))
    counted = [step(renderer, sky, camera())["clouds_marched"] for _ in range(17)]
    assert counted[1:] == [PART] * 16
    live = image(renderer)
    step(renderer, sky, camera(), live=False)
    for ours, full in zip(live, image(renderer), strict=True):
        np.testing.assert_array_equal(ours, full)


@pytest.mark.parametrize(("step_m", "turn_deg", "least_db"), [(20.0, 0.0, 34.0), (0.0, 1.0, 35.0), (0.0, 4.0, 35.0)])
def test_moving_and_turning_come_near_the_full_march(renderer, sky, step_m, turn_deg, least_db):
    """Z16: at least 31 dB at 20 m a frame sideways and 35 dB at 1° a frame (the best open peer: 27.8 and 31.3)."""
    assert likeness_db(renderer, sky, lambda k: (step_m * k, 60.0 + turn_deg * k)) >= least_db


@pytest.mark.parametrize("jump_s", [500.0, -5.0, 0.03])
def test_a_scrub_forgets_and_small_steps_do_not(renderer, sky, jump_s):
    """Z16: far in time, either way, the image is that of a first frame."""
    images = []
    for forgotten in (False, True):
        renderer.kept.pop("clouds", None)
        for _ in range(5):
            step(renderer, sky, camera(), 10.0)
        if forgotten:
            renderer.kept["clouds"].seen = None
        step(renderer, sky, camera(), 10.0 + jump_s)
        images.append(image(renderer)[0])
    assert np.array_equal(*images) == (abs(jump_s) > 1.0)


def test_a_thing_that_moves_in_front_leaves_no_halo(renderer, sky):
    """Z16: clouds are marched behind it too: round it the picture is no worse than elsewhere at its height."""
    size, pictures = SIZE, []
    renderer.kept.pop("clouds", None)
    for number in (*range(24), -1):
        left, place = 60 + 8 * (number % 24), camera(8.0 * (number % 24))
        frame = renderer.prepare(sky, place, size, 0.0, find_view("final"), None, "medium", None)
        frame.live = number >= 0
        frame.targets.gbuffer.clear()
        depth = np.zeros(size[::-1], np.float32)
        depth[80:180, left : left + 90] = 40.0
        frame.targets.textures["g_eye_depth"].write(depth.tobytes())
        weather.draw(frame)
        frame.targets.picture.clear(*SKY, 1.0)
        if number == -1:
            renderer.kept.pop("clouds", None)
        clouds.draw(frame)
        pictures = [*pictures[-1:], frame.targets.picture.read(components=3, dtype="f4")]
    live, full = (np.frombuffer(data, np.float32).reshape(*size[::-1], 3) for data in pictures)
    error = np.abs(live - full).mean(axis=-1)
    inside = np.s_[80:180, left : left + 90]
    ring = np.zeros(error.shape, bool)
    ring[72:188, left - 8 : left + 98] = True
    away = np.zeros(error.shape, bool)
    away[72:188] = ~ring[72:188]
    ring[inside] = False
    assert (error[inside] == 0).all()
    assert error[ring].mean() <= 2 * error[away].mean()


def test_what_is_painted_is_marched_in_the_same_frame(renderer, sky):
    """T04: pixels that look at the changed cells are those of the full march at once, the others as they were."""
    place = camera()
    for _ in range(17):
        step(renderer, sky, place)
    before = image(renderer)[0]
    grid = sky.layers["weather"].grid
    row, col = (int(v) for v in grid.to_cells(2500.0, 4500.0))
    sky.write("weather", Rect(row - 6, col - 6, row + 6, col + 6), np.float32([0.0, 0.0, 0.0, 1.0, 1.0, 1.0]))
    counted = step(renderer, sky, place)["clouds_marched"]
    assert PART < counted < PART + 240 * 135
    live = image(renderer)[0]
    step(renderer, sky, place, live=False)
    full = image(renderer)[0]
    changed = (full != before).any(axis=-1)
    assert changed.sum() > 200
    wrong = (live != full).any(axis=-1)
    assert wrong.mean() < 0.02, "only light that falls from the change on other clouds may be late"
    assert (wrong & changed).sum() < 0.2 * changed.sum()


def test_sides_that_do_not_divide_by_eight(renderer, sky):
    """Any size: the last blocks are cut, and a still camera still gets the full march."""
    for _ in range(16):
        stats = step(renderer, sky, camera(), size=(131, 75))
    assert stats["clouds_marched"] == 17 * 10
    live = image(renderer)[0]
    step(renderer, sky, camera(), live=False, size=(131, 75))
    np.testing.assert_array_equal(live, image(renderer)[0])


@pytest.mark.parametrize(("start_s", "least"), [(11.0, 2.5), (17.5, 2.5)])
def test_a_day_that_runs_fast_leaves_no_pattern(renderer, sky, monkeypatch, start_s, least):
    """Z16, Z25: a day in two minutes, at sunset and through dusk (where the unit of light changes): the sixteen parts
    have different light, and their error by the place in the block is a fraction of what it is left alone."""
    for path, value in {"light.sun_from": "date", "light.hour": 18.0, "light.day_rate": 720.0}.items():
        sky.set(path, value)

    def pattern():
        renderer.kept.pop("clouds", None)
        for number in range(20):
            step(renderer, sky, camera(), start_s + number / 20)
        live, _ = image(renderer)
        step(renderer, sky, camera(), start_s + 19 / 20, live=False)
        full, _ = image(renderer)
        off = (live[:132, :240, :3].astype(np.float64) - full[:132, :240, :3]) / full[..., :3].mean()
        return off.mean(-1).reshape(33, 4, 60, 4).mean(axis=(0, 2)).std()

    followed = pattern()
    monkeypatch.setattr(cloud_history, "on_clouds", lambda light: np.full(3, light.unit))
    assert followed < pattern() / least
    assert followed < 0.05
