"""The frame: same time same bytes, no NaN, shadows, uploads by rectangle, samples, picking (T05, T08, D31)."""

import numpy as np
import pytest
from scenes import SIZE, camera, coast
from shorewright.level import Clock, Grid, Level, Rect
from shorewright.level.objects import Camera
from shorewright.level.shore import shore_map
from shorewright.renderer import Renderer, Show, camera_matrices, pick, render
from shorewright.renderer.camera import jitter
from shorewright.renderer.memory import gpu_memory
from shorewright.renderer.upload import Uploader

pytestmark = pytest.mark.gl


def test_same_time_same_bytes_however_it_was_reached(renderer, ctx):
    """Run and stop, scrub, a fresh renderer: one picture (T05)."""
    level, place = coast(), camera()
    run, scrubbed = Clock(), Clock()
    run.advance(3.7)
    run.step(1)
    scrubbed.scrub(run.time_s)
    first = render(level, place, SIZE, run.time_s, renderer=renderer)
    render(level, camera(yaw=90), (64, 64), 99.0, renderer=renderer)
    level.set("shore.count", 5)
    render(level, place, SIZE, 1.0, renderer=renderer)
    level.set("shore.count", 3)
    again = render(level, place, SIZE, scrubbed.time_s, renderer=renderer)
    assert np.array_equal(first, again)
    fresh = Renderer(ctx)
    assert np.array_equal(first, render(level, place, SIZE, run.time_s, renderer=fresh))
    fresh.release()


@pytest.mark.parametrize("quality", ["low", "medium"])
def test_history_leaves_no_trace_in_the_picture(renderer, ctx, quality):
    """T05: after a run, a scrub back, another level, a stroke, its undo, other tiers and sizes: the first bytes.

    On the renderer that has seen it all and on a fresh one, while the stroke's change showed in between.
    """
    from shorewright.brushes import BRUSHES, Stroke
    from shorewright.level import Journal

    level, other, place = coast(rock=9.0), coast(slope=0.2), camera()
    shoot = {"size": SIZE, "quality": quality, "renderer": renderer}
    clock, journal, brush = Clock(), Journal(level), BRUSHES["raise"]
    clock.scrub(6.4)
    first = render(level, place, time_s=clock.time_s, **shoot)
    for _ in range(3):
        clock.advance(0.31)
        render(level, camera(yaw=40.0), time_s=clock.time_s, **shoot)
    render(other, place, (64, 36), 2.0, quality="high", renderer=renderer)
    stroke = Stroke(level, journal, brush, brush.with_params({"size_m": 14.0, "strength": 3.0}))
    stroke.begin(110.0, 90.0)
    for step in range(4):
        stroke.move(114.0 + 6 * step, 92.0 + 5 * step)
        moving = render(level, place, time_s=6.4, **shoot)  # the live window of the shore map, strips of shadow
    stroke.end()
    settled = render(level, place, time_s=6.4, **shoot)
    assert not np.array_equal(first, moving)
    clock.scrub(6.4)
    fresh = Renderer(ctx)
    assert np.array_equal(settled, render(level, place, time_s=clock.time_s, **{**shoot, "renderer": fresh}))
    journal.undo()
    assert np.array_equal(first, render(level, place, time_s=clock.time_s, **shoot))
    assert np.array_equal(first, render(level, place, time_s=clock.time_s, **{**shoot, "renderer": fresh}))
    fresh.release()
    journal.redo()
    assert np.array_equal(settled, render(level, place, time_s=clock.time_s, **shoot))


@pytest.mark.parametrize("quality", ["low", "medium", "high"])
@pytest.mark.parametrize("z", [60.0, 0.35, 0.0, -1.5, -30.0])
def test_no_nan_above_on_and_below_the_surface(renderer, z, quality):
    level = coast()
    for pitch in (-90.0, -20.0, 0.0, 35.0):
        shot = render(level, camera(y=70, z=z, pitch=pitch), (64, 36), 2.0, quality=quality, linear=True,
                      renderer=renderer)  # fmt: skip
        assert np.isfinite(shot).all()


@pytest.mark.parametrize("elevation", [-10.0, 0.0, 0.4, 90.0])
def test_no_nan_at_any_height_of_the_sun(renderer, elevation):
    level = coast(rock=9.0)
    level.set("light.sun_elevation_deg", elevation)
    for view in ("final", "shadow"):
        assert np.isfinite(render(level, camera(), SIZE, 2.0, view, linear=True, renderer=renderer)).all()


def test_shadow_of_a_rock_falls_away_from_the_sun(renderer):
    """Sun in the west, a post of 20 m: its shadow on flat ground is 20 m / tan(45°) long, to the east."""
    height = np.full((129, 129), 1.0, np.float32)
    height[62:67, 40:43] = 21.0
    level = Level(Grid(129, 129), height)
    level.set("scatter.on", False)  # what lies at its foot has shadows too
    level.set("light.sun_azimuth_deg", 270.0)
    level.set("light.sun_elevation_deg", 45.0)
    place = Camera(id="c", x=64, y=64, z=150, yaw_deg=0, pitch_deg=-90, fov_deg=46)
    options = {"size": (129, 129), "linear": True, "renderer": renderer}
    shadow = render(level, place, view="shadow", **options)[..., 0]
    position = render(level, place, view="position", **options)
    row = np.argmin(np.abs(position[:, 64, 1] - 64))
    x = position[row, :, 0]
    assert shadow[row, (x > 46) & (x < 60)].max() < 0.05
    assert shadow[row, (x > 65) & (x < 120)].min() > 0.95
    assert shadow[row, (x > 5) & (x < 38)].min() > 0.95


def test_uploads_are_the_rectangles_that_changed(ctx):
    """A dab sends its own cells of height, not the level (bytes counted)."""
    level = coast(side=513)
    uploader = Uploader(ctx)
    uploader.sync(level)
    assert uploader.sent["u_height"] == 513 * 513 * 4
    sent = uploader.bytes
    uploader.sync(level)
    assert uploader.bytes == sent
    rect = Rect(100, 200, 140, 260)
    level.live = True  # as while a stroke is open
    level.layers["height"].array[rect.slices] += 1
    level.mark("height", rect)
    uploader.sync(level)
    assert uploader.sent["u_height"] == 513 * 513 * 4 + rect.cells * 4
    assert uploader.bytes - sent < 0.25 * 513 * 513 * 16
    held = np.frombuffer(uploader.textures["u_height"].read(), np.float32).reshape(513, 513)
    assert np.array_equal(held, level.height)
    assert uploader.bounds.range == (level.height.min(), level.height.max())
    level.live = False  # the stroke ends: the shore map is made anew, what differs is sent
    sent = uploader.bytes
    uploader.sync(level)
    assert uploader.bytes - sent < 0.25 * 513 * 513 * 16
    held = np.frombuffer(uploader.textures["u_bed"].read(), np.float32).reshape(513, 513, 4)
    assert np.array_equal(held, shore_map(level).packed)
    uploader.release()


def test_layers_are_one_texel_until_painted_and_follow_rectangles(ctx):
    level = coast(side=257)
    uploader = Uploader(ctx)
    assert uploader.layer(level, "cover").size == (1, 1)
    level.write("cover", Rect(10, 20, 30, 50), np.array([0.5, 0.25, 0, 1], np.float32))
    assert uploader.layer(level, "cover").size == (257, 257)
    sent = uploader.bytes
    level.write("cover", Rect(40, 20, 44, 30), 1.0)
    texture = uploader.layer(level, "cover")
    assert uploader.bytes - sent == 4 * 10 * 4 * 2
    held = np.frombuffer(texture.read(alignment=1), np.float16).reshape(257, 257, 4)
    assert np.array_equal(held.astype(np.float32), level.layers["cover"].array)
    uploader.release()


def test_an_edit_shows_and_its_undo_takes_it_back(renderer):
    from shorewright.level import Journal

    level, place = coast(), camera()
    journal = Journal(level)
    before = render(level, place, SIZE, 1.0, renderer=renderer)
    with journal.step("Raise") as step:
        rect = Rect(90, 100, 160, 170)
        step.save(level.layers["height"], rect)
        level.layers["height"].array[rect.slices] += 5
        level.mark("height", rect)
    assert not np.array_equal(before, render(level, place, SIZE, 1.0, renderer=renderer))
    journal.undo()
    assert np.array_equal(before, render(level, place, SIZE, 1.0, renderer=renderer))


def test_two_levels_and_a_reset_share_one_renderer(renderer):
    first, second = coast(), coast(slope=0.2, side=129)
    place = camera()
    a = render(first, place, SIZE, renderer=renderer)
    b = render(second, place, SIZE, renderer=renderer)
    assert not np.array_equal(a, b)
    assert np.array_equal(a, render(first, place, SIZE, renderer=renderer))
    second.reset(first.grid, first.layers["height"].base)
    assert np.array_equal(a, render(second, place, SIZE, renderer=renderer))


def test_samples_smooth_edges_and_keep_the_light(renderer):
    """The mean of jittered frames: about the same light, fewer steps at edges; sums are linear."""
    level, place = coast(rock=9.0), camera()
    one = render(level, place, SIZE, 1.0, linear=True, renderer=renderer)
    many = render(level, place, SIZE, 1.0, linear=True, samples=8, renderer=renderer)
    assert abs(many.mean() / one.mean() - 1) < 0.03
    assert np.abs(np.diff(many, axis=0)).mean() < np.abs(np.diff(one, axis=0)).mean()
    offsets = np.array([jitter(i, 16) for i in range(16)])
    assert np.abs(offsets).max() < 0.6
    assert np.abs(offsets.mean(axis=0)).max() < 1e-12


def test_picking_hits_the_ground_that_is_drawn(renderer):
    """CPU ray against the position view with the water off."""
    level, place = coast(rock=9.0), camera()
    drawn = render(level, place, SIZE, 0.0, "position", Show.hide("water"), linear=True, renderer=renderer)
    for px, py in ((64, 40), (20, 60), (100, 30)):
        hit = pick(level, place, SIZE, px + 0.5, py + 0.5)
        np.testing.assert_allclose(hit, drawn[py, px], atol=0.25)
    assert pick(level, camera(pitch=30), SIZE, 64, 36) is None
    assert pick(level, camera(x=-5000), SIZE, 0, 70) is None


def test_camera_matrices_agree_with_their_rays():
    place = camera(yaw=217.0, pitch=-33.0)
    matrices = camera_matrices(place, SIZE, jitter=(0.3, -0.2))
    for px, py in ((3.0, 5.0), (100.0, 60.0)):
        ray = matrices.ray(px, py, SIZE)
        clip = matrices.view_projection @ np.append(ray * 50, 1)
        np.testing.assert_allclose(clip[:2] / clip[3], [2 * px / 128 - 1, 1 - 2 * py / 72], atol=1e-9)
    far = matrices.view_projection @ np.append(matrices.ray(64, 36, SIZE), 0)
    assert -far[3] <= far[2] <= far[3]


def test_gl_is_left_without_errors(renderer, ctx):
    render(coast(), camera(), SIZE, renderer=renderer, samples=2)
    assert ctx.error == "GL_NO_ERROR"


def test_a_released_renderer_can_draw_again(ctx):
    """It gives everything back, twice if asked, and what it draws next is what it drew."""
    made, level = Renderer(ctx), coast()
    first = render(level, camera(), SIZE, 2.0, renderer=made)
    made.release()
    made.release()
    assert np.array_equal(first, render(level, camera(), SIZE, 2.0, renderer=made))
    made.release()


def test_night_falls_without_a_step(renderer):
    """L02: as the sun sinks far below the horizon no wave lights up: neighbouring pictures differ by little."""
    level, means = coast(), []
    for elevation in np.arange(-19.0, -22.0, -0.25):
        level.set("light.sun_from", "date")
        level.set("light.month", 3)
        level.set("light.day", 20)
        level.set("light.latitude_deg", 0.0)
        level.set("light.longitude_deg", 0.0)
        level.set("light.hour", 18.12 - elevation / 15.0)
        means.append(render(level, camera(pitch=-12), SIZE, 5.0, linear=True, renderer=renderer).mean())
    steps = np.abs(np.diff(means)) / means[:-1]
    assert steps.max() < 0.02


def test_maps_that_are_kept_are_told(ctx):
    """What the memory table counts: three maps of the land's shadow, the open sky, shadows of things, the mirror."""
    renderer = Renderer(ctx)
    render(coast(), camera(), (32, 18), 1.0, renderer=renderer)
    held = gpu_memory(renderer)
    names = [row.name for row in held if row.kind == "kept"]
    assert names.count("shadowmap") == 3
    assert {"lobes", "opennessmap"} <= set(names)
    (props,) = [row for row in held if row.name == "propmap"]
    assert props.layout == "2048 × 1024, depth"
    assert props.bytes == 4 * 2048 * 1024
    renderer.release()
    assert gpu_memory(renderer) == []
