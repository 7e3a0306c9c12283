"""Props in the picture (D12): where they are, their colours, under water, shadows, no sea inside."""

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.level import Grid, Level, Rect
from shorewright.level.buoyancy import poses
from shorewright.level.meshes import block, made_of
from shorewright.level.objects import Prop
from shorewright.renderer import Show, render
from shorewright.renderer.camera import camera_matrices

pytestmark = pytest.mark.gl
SIZE = (160, 90)
CALM = {"sea.on": False, "shore.on": False, "scatter.on": False, "fog.on": False}


def sheet(corners, colour):
    """Two triangles over four corners, both sides."""
    a, b, c, d = np.array(corners, float)
    faces = np.array([(a, b, c), (a, c, d), (c, b, a), (d, c, a)])
    return made_of(faces, np.broadcast_to(np.array(colour, float), faces.shape))


def tray():
    """An open box, 2 × 4 × 1 m, its walls and floor 5 cm thick."""
    cube = block().vertices[block().triangles].astype(float)
    rows = [((2, 4, 0.05), (0, 0, 0))]
    rows += [((0.05, 4, 1), (x, 0, 0)) for x in (-0.975, 0.975)]
    rows += [((2, 0.05, 1), (0, y, 0)) for y in (-1.975, 1.975)]
    return made_of(np.concatenate([cube * size + place for size, place in rows]))


def scene(depth_m=6.0, **settings):
    level = Level(Grid(129, 129), np.full((129, 129), -depth_m, np.float32))
    for path, value in {**CALM, **settings}.items():
        level.set(path, value)
    level.put_mesh("block", block())
    level.put_mesh("tray", tray())
    return level


def put(level, name="thing", **fields):
    level.put_object(name, Prop(id=name, **{"mesh": "block", "x": 64, "y": 74, **fields}))


def shot(level, renderer, view="final", cam=None, **options):
    cam = cam or camera(x=64, y=60, z=6, yaw=0, pitch=-20)
    return render(level, cam, SIZE, view=view, renderer=renderer, **{"linear": True, "quality": "low", **options})


def marked(level, renderer, cam=None, **options):
    """Where the view of props shows one: their colours are the only ones in it."""
    return np.ptp(shot(level, renderer, "props", cam, **options), axis=-1) > 0.3


def test_it_is_drawn_where_it_was_placed(renderer):
    """D12: the pixels of a prop are those that its corners enclose, turned and scaled; each prop has its colour."""
    level, cam = scene(), camera(x=64, y=60, z=6, yaw=0, pitch=-20)
    put(level, z=3.0, scale=2.0, yaw_deg=30)
    put(level, "other", x=58, z=1.0)
    numbers = shot(level, renderer, "props", cam)
    seen = np.ptp(numbers, axis=-1) > 0.3
    assert len(np.unique(numbers[seen].round(3), axis=0)) == 2
    matrices = camera_matrices(cam, SIZE, 0.1)
    level.put_object("other", None)
    pose = poses(level, 0.0)["thing"]
    corners = pose.place + (2.0 * block().vertices) @ pose.axes.T
    clip = np.column_stack([corners - matrices.position, np.ones(len(corners))]) @ matrices.view_projection.T
    x, y = ((clip[:, i] / clip[:, 3] * (1, -1)[i] + 1) / 2 * SIZE[i] for i in (0, 1))
    rows, cols = np.nonzero(marked(level, renderer, cam))
    assert abs(cols.min() - x.min()) < 1.5
    assert abs(cols.max() + 1 - x.max()) < 1.5
    assert abs(rows.min() - y.min()) < 1.5
    assert abs(rows.max() + 1 - y.max()) < 1.5


def test_flag_and_setting_hide_it(renderer):
    """T11: hidden, nothing of it is left, its shadow neither."""
    level = scene()
    empty = shot(level, renderer)
    put(level, z=1.0)
    assert not np.array_equal(shot(level, renderer), empty)
    assert np.array_equal(shot(level, renderer, show=Show.hide("things")), empty)
    level.set("things.on", False)
    assert np.array_equal(shot(level, renderer), empty)


def test_it_has_the_colours_of_its_mesh(renderer):
    """Vertex colours are the albedo, on both sides of a sheet."""
    level, colour = scene(), (0.5, 0.1, 0.05)
    level.put_mesh("sail", sheet([(-2, 0, 0), (2, 0, 0), (2, 0, 3), (-2, 0, 3)], colour))
    put(level, mesh="sail", z=2.0)
    for yaw in (0, 180):
        put(level, mesh="sail", z=2.0, yaw_deg=yaw)
        seen = marked(level, renderer)
        albedo = shot(level, renderer, "albedo")[seen]
        assert seen.sum() > 200
        np.testing.assert_allclose(np.median(albedo, axis=0), colour, atol=0.01)


@pytest.mark.parametrize("floats", [False, True])
def test_it_throws_a_shadow(renderer, floats):
    """L03 with D12: on the ground beside it, away from the sun; what floats takes its shadow along."""
    level = scene(depth_m=-1.0 if not floats else 2.0)
    cam = camera(x=64, y=40, z=30, yaw=0, pitch=-40)
    lit = shot(level, renderer, "prop_shadow", cam)[..., 0]
    put(level, z=1.0, scale=5.0, floats=floats, density=0.1)
    dark = shot(level, renderer, "prop_shadow", cam)[..., 0] < 0.5
    seen = marked(level, renderer, cam)
    assert lit.min() > 0.9
    assert (dark & ~seen).sum() > 30
    middle = np.argwhere(dark & ~seen).mean(axis=0)
    put(level, x=78, z=1.0, scale=5.0, floats=floats, density=0.1)
    dark = shot(level, renderer, "prop_shadow", cam)[..., 0] < 0.5
    seen = marked(level, renderer, cam)
    assert np.argwhere(dark & ~seen).mean(axis=0)[1] > middle[1] + 10
    level.put_object("thing", None)
    assert np.array_equal(shot(level, renderer, "prop_shadow", cam)[..., 0], lit)


def test_shadows_move_and_leave_nothing_behind(renderer):
    """The map is put right where something floated a moment ago: drawn at once or after others, the same bytes."""
    level = scene(depth_m=3.0)
    level.set("sea.on", True)
    put(level, scale=4.0, floats=True, density=0.2)
    cam = camera(x=64, y=40, z=30, yaw=0, pitch=-40)
    first = shot(level, renderer, "shadow", cam, time_s=3.0)
    for t in (5.0, 7.5, 60.0):
        shot(level, renderer, "shadow", cam, time_s=t)
    assert np.array_equal(shot(level, renderer, "shadow", cam, time_s=3.0), first)


def test_water_shows_what_is_under_it(renderer):
    """D02: a prop on the bed is seen through the water, in the water's colours."""
    level = scene(depth_m=1.5)
    empty = shot(level, renderer)
    level.put_mesh("white", sheet([(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)], (0.8, 0.8, 0.8)))
    put(level, mesh="white", y=70, z=-1.3)
    change = shot(level, renderer) - empty
    assert not marked(level, renderer).any()  # the sea lies over all of it
    bright = change.sum(axis=-1) > 0.1 * empty.sum(axis=-1)
    assert bright.sum() > 40
    gain = np.median(change[bright] / empty[bright], axis=0)
    assert gain[2] > gain[0]  # red is lost on its way through the water


def test_no_sea_inside_a_hull(renderer):
    """D12: the floor of an open box lies under the water line; dry, it shows, else the sea does."""
    level, cam = scene(), camera(x=64, y=70, z=6, yaw=0, pitch=-60)
    floor = {}
    for dry in (True, False):
        put(level, mesh="tray", floats=True, density=0.4, dry=dry, y=74)
        material = shot(level, renderer, "material", cam)
        sea = np.abs(material - np.array([0.1, 0.35, 0.75])).max(axis=-1) < 0.01
        matrices, pose = camera_matrices(cam, SIZE, 0.1), poses(level, 0.0)["thing"]
        at = pose.place + pose.axes @ (0, 0.5, 0.06) - matrices.position
        clip = matrices.view_projection @ np.array([*at, 1.0])
        col, row = (int((clip[i] / clip[3] * (1, -1)[i] + 1) / 2 * SIZE[i]) for i in (0, 1))
        floor[dry] = sea[row, col]
        assert sea.mean() > 0.5  # round about it the sea is as it was
    assert floor == {True: False, False: True}


def test_a_missing_mesh_is_a_box(renderer):
    """The frame still draws: a box of a metre stands where a mesh should be."""
    level = scene()
    put(level, mesh="nowhere_00000000", z=2.0, scale=2.0)
    box = marked(level, renderer)
    put(level, mesh="block", z=2.0, scale=2.0)
    assert box.sum() > 50
    assert np.array_equal(box, marked(level, renderer))


@pytest.mark.parametrize("view", ["final", "normal", "roughness", "hdr", "eye_depth"])
def test_pictures_with_props_are_finite(renderer, view):
    """On a rough sea, drifting, on a beach, steeply tilted, tiny and far away."""
    level = coast()
    level.put_mesh("block", block())
    level.write("flow", Rect(0, 0, 120, 257), np.array([0.5, 0.2], np.float32))
    for n, fields in enumerate((
        {"floats": True}, {"floats": True, "drifts": True, "x": 90}, {"floats": True, "y": 141, "scale": 3.0},
        {"pitch_deg": 80.0, "roll_deg": -170.0, "z": 2.0}, {"scale": 0.001}, {"x": -9e5, "y": 9e5},
        {"density": 1.5, "floats": True},
    )):  # fmt: skip
        put(level, f"p{n}", **{"x": 128.0, "y": 90.0, **fields})
    for t in (0.0, 604_800.0):
        assert np.isfinite(shot(level, renderer, view, camera(), time_s=t)).all()


def test_nothing_costs_nothing(renderer):
    """Neutral: without props no pass draws, sends or keeps anything."""
    level = scene()
    sent = renderer.uploader.sent["props"]
    shot(level, renderer)
    assert "props" not in renderer.stats
    assert "prop_casters" not in renderer.stats
    assert renderer.uploader.sent["props"] == sent
    put(level, z=1.0)
    shot(level, renderer)
    once = renderer.uploader.sent["props"]
    assert once > sent
    shot(level, renderer, time_s=9.0)
    assert renderer.uploader.sent["props"] == once
