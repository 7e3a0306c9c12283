"""The shore field: distance, direction and bare beach in closed form, by window and on the GPU (H10, H11)."""

import numpy as np
import pytest
from coasts import make_beach
from hypothesis import given
from hypothesis import settings as how
from hypothesis import strategies as st
from shorewright.level import Grid, Journal, Level, Rect
from shorewright.level.bottleneck import bottleneck
from shorewright.level.objects import SeaSeed
from shorewright.level.shore import shore_map
from shorewright.level.shore_distance import joined_water
from shorewright.level.shore_field import (
    decode_beach_m,
    decode_direction,
    decode_distance_m,
    direction,
    shore_field,
)

CLOSE_M = 0.05


def places(field):
    """World x, y of every texel."""
    return np.meshgrid(*(np.arange(side) * field.cell_m for side in field.packed.shape[1::-1]))


def level_of(height, cell_m=1.0):
    return Level(Grid(*height.shape, cell_m), height.astype(np.float32))


def plane(side=161, slope=0.05, heading_deg=0.0, cell_m=1.0):
    """A beach that rises along a heading through the middle of the level; returns the level and its way inland, m."""
    y, x = (np.mgrid[0:side, 0:side] - side // 2) * cell_m
    inland = x * np.sin(np.radians(heading_deg)) + y * np.cos(np.radians(heading_deg)) + 0.3
    return level_of(inland * slope, cell_m)


def island(side=201, radius=40.0, slope=0.06):
    y, x = np.mgrid[0:side, 0:side] - side // 2 + 0.2
    return level_of(slope * (radius - np.hypot(x, y)))


def bay(side=201, slope=0.08):
    """Land but for a round bay that opens to the south over its whole width: water within 50 m of the middle line."""
    y, x = np.mgrid[0:side, 0:side].astype(np.float64)
    to_land = 50 - np.hypot(x - 100, np.maximum(y - 100, 0))
    return level_of(-slope * to_land)


@pytest.mark.parametrize("heading_deg", [0, 1, 20, 45, 90, 137, 250])
@pytest.mark.parametrize("cell_m", [0.5, 1.0])
def test_a_straight_beach(heading_deg, cell_m):
    """H11: distance within 5 cm, and the way to the shore, on beaches of every heading."""
    level = plane(heading_deg=heading_deg, cell_m=cell_m)
    field = shore_field(level)
    x, y = (axis - 80 * cell_m for axis in places(field))
    turn = np.radians(heading_deg)
    inland = x * np.sin(turn) + y * np.cos(turn) + 0.3
    ends = np.abs(x * np.cos(turn) - y * np.sin(turn)) < 60 * cell_m  # where the shoreline's nearest point is inside
    ends &= (np.abs(x - inland * np.sin(turn)) < 79 * cell_m) & (np.abs(y - inland * np.cos(turn)) < 79 * cell_m)
    expected = np.clip(-inland, -60, 60)
    assert ends.mean() > 0.4
    np.testing.assert_allclose(field.distance_m[ends], expected[ends], atol=CLOSE_M)
    inner = ends & (np.abs(inland) < 58)
    inner[[0, -1]], inner[:, [0, -1]] = False, False
    toward = decode_direction(field.packed[..., 1:3])[inner]
    np.testing.assert_allclose(toward, np.broadcast_to([np.sin(turn), np.cos(turn)], toward.shape), atol=0.08)


def test_a_round_island():
    """H11: distance = r − R within 5 cm, on land to the middle of the island."""
    level = island()
    field = shore_field(level)
    x, y = places(field)
    r = np.hypot(x - 99.8, y - 99.8)
    np.testing.assert_allclose(field.distance_m, np.clip(r - 40, -60, 60), atol=CLOSE_M)


def test_a_bay():
    """H11: water between two shores measures to the nearer, and lands meet in the middle."""
    level = bay()
    field = shore_field(level)
    x, y = places(field)
    expected = 50 - np.hypot(x - 100, np.maximum(y - 100, 0))
    np.testing.assert_allclose(field.distance_m, np.clip(expected, -60, 60), atol=CLOSE_M)


def test_the_shoreline_is_where_the_bilinear_depth_is_zero():
    """H11: the sign is that of the still depth on rough ground too; near it distance is depth / slope."""
    rng = np.random.default_rng(5)
    field = shore_field(level := make_beach(rough_m=0.02, slope=0.1))
    depth = -level.height
    assert np.array_equal(field.distance_m[::2, ::2] > 0, (depth > 0) & field.sea)
    steep = level_of(0.3 * (np.mgrid[0:65, 0:65][0] - 32.0) + rng.uniform(-0.02, 0.02))
    near = np.abs(shore_field(steep).distance_m[::2, ::2]) < 1
    np.testing.assert_allclose(shore_field(steep).distance_m[::2, ::2][near], -steep.height[near] / 0.3, atol=1e-3)


def test_water_is_sea_as_the_shore_map_has_it():
    """H11: joined to the border over water, corners count; ponds are land, a seed makes one sea."""
    level = make_beach(rough_m=0.8)
    field = shore_field(level)
    assert 0.2 < field.sea.mean() < 0.8
    assert np.array_equal(field.sea, shore_map(level).bottleneck > 0)
    height = np.full((101, 101), 3.0)
    height[40:60, 40:60] = -1
    pond = level_of(height)
    assert (shore_field(pond).distance_m == -60).all()
    pond.put_object("lagoon", SeaSeed(id="lagoon", x=50, y=50))
    assert shore_field(pond).distance_m[100, 100] > 9


@given(st.integers(0, 2**32 - 1))
@how(max_examples=20)
def test_joined_water_is_what_the_bottleneck_lets_through(seed):
    depth = np.random.default_rng(seed).normal(0, 1, (17, 23)).astype(np.float32)
    start = np.zeros(depth.shape, bool)
    start[0] = depth[0] > 0
    marker = np.where(start, depth, -np.inf).astype(np.float32)
    assert np.array_equal(joined_water(depth > 0, start), bottleneck(marker, depth) > 0)


# The beach


@pytest.mark.parametrize("heading_deg", [0, 30, 45])
def test_a_plain_beach_is_kept(heading_deg):
    """H10: on a slope the slice is the height within 1.6 cm, to the edge of the level."""
    level = plane(heading_deg=heading_deg)
    field = shore_field(level)
    height = np.clip(level.height, -1.99, 1.99)
    np.testing.assert_allclose(decode_beach_m(field.packed[::2, ::2, 3]), height, atol=0.016)
    np.testing.assert_allclose(field.beach_m[::2, ::2], level.height, atol=2e-4)


def test_rocks_are_left_out_of_the_beach():
    """H10: a rock narrower than 8 m is gone, its foot goes on sloping; a mound that is wider stays."""
    level = plane(slope=0.08)
    bare = level.height.copy()
    y, x = np.mgrid[0:161, 0:161]
    rock = 1.8 * (np.hypot(x - 60, y - 85) < 2.6) + 0.9 * np.exp(-((x - 100) ** 2 + (y - 78) ** 2) / 3)
    level.write("height", level.grid.rect, bare + rock)
    found = shore_field(level).beach_m[::2, ::2]
    assert rock.max() > 1.7
    assert np.abs(found - bare).max() < 0.12
    mound = 1.5 * np.exp(-(((x - 80) / 14) ** 2 + ((y - 80) / 14) ** 2))
    level.write("height", level.grid.rect, bare + mound)
    assert np.abs(shore_field(level).beach_m[::2, ::2] - (bare + mound)).max() < 0.05


def test_the_sea_level_moves_the_field():
    """Distance and slice are about the still sea, wherever it stands."""
    level, raised = plane(), plane()
    raised.write("height", raised.grid.rect, level.height + 1.5)
    raised.set("level.sea_level_m", 1.5)
    np.testing.assert_allclose(shore_field(raised).distance_m, shore_field(level).distance_m, atol=1e-3)
    np.testing.assert_allclose(shore_field(raised).beach_m, shore_field(level).beach_m, atol=1e-5)


# By window


def fresh(level):
    other = Level(level.grid, level.height.copy(), level.settings)
    other.objects = level.objects
    return shore_field(other)


def same(field, other):
    return all(np.array_equal(getattr(field, name), getattr(other, name))
               for name in ("distance_m", "beach_m", "packed", "wet", "sea"))  # fmt: skip


def dab(level, journal, rng, commit):
    step = journal.begin("Raise")
    data = level.layers["height"]
    row, col, size = rng.integers(0, data.grid.rows), rng.integers(0, data.grid.cols), int(rng.integers(2, 30))
    rect = data.grid.clip(Rect(row - size, col - size, row + size, col + size))
    step.save(data, rect)
    data.array[rect.slices] += rng.choice([-2.5, -0.4, 0.4, 2.5])
    level.mark("height", rect)
    live = shore_field(level)
    assert same(live, fresh(level))
    journal.commit() if commit else journal.abort()


@pytest.mark.parametrize(("seed", "cell_m"), [(0, 1.0), (1, 1.0), (2, 0.25), (3, 2.0), (4, 9.0)])
def test_windows_have_the_bits_of_a_whole_bake(seed, cell_m):
    """H10, H11: after strokes, live and settled, aborted and undone; and the rectangles told hold all that changed."""
    rng = np.random.default_rng(seed)
    level = make_beach(rows=230, cols=301, cell_m=cell_m, slope=0.02 / cell_m, rough_m=0.05)
    level.set("shore.distance_range_m", min(22.0 * cell_m, 100.0))
    journal = Journal(level)
    field = shore_field(level)
    for number in range(8):
        before, revision = field.packed.copy(), field.revision
        dab(level, journal, rng, commit=number % 4 != 3)
        if number % 3 == 2:
            journal.undo()
        assert shore_field(level) is field
        assert same(field, fresh(level))
        told = np.zeros(before.shape[:2], bool)
        for rect in field.changed_since(revision):
            told[rect.slices] = True
        assert not (before != field.packed).any(axis=2)[~told].any()
        assert not told.all()


def test_a_dam_turns_the_water_behind_it_into_land():
    """H11: what a stroke cuts off from the sea far away changes with it, and comes back with undo."""
    height = np.full((120, 260), 2.0)
    height[50:70, :200] = -1.0  # a lagoon 200 m long, open to the west
    level = level_of(height)
    level.set("shore.distance_range_m", 15.0)
    journal = Journal(level)
    field = shore_field(level)
    assert field.distance_m[120, 380] > 0
    step = journal.begin("Raise")
    data = level.layers["height"]
    rect = Rect(45, 10, 75, 14)
    step.save(data, rect)
    data.array[rect.slices] = 3.0
    level.mark("height", rect)
    assert shore_field(level).distance_m[120, 380] < 0
    assert same(field, fresh(level))
    journal.commit()
    journal.undo()
    assert shore_field(level).distance_m[120, 380] > 0
    assert same(field, fresh(level))


def test_a_dab_on_a_hill_moves_no_shoreline():
    level = plane(side=401)
    field = shore_field(level)
    revision = field.revision
    level.write("height", Rect(350, 200, 353, 203), 30.0)
    (rect,) = shore_field(level).changed_since(revision)
    assert rect.cells < 220**2  # what the beach needs, not the range of distances


def test_it_is_kept_until_something_it_reads_changes():
    level = plane(side=65)
    field = shore_field(level)
    level.set("light.exposure_ev", 12.0)
    assert shore_field(level) is field
    level.set("shore.distance_range_m", 10.0)
    assert shore_field(level) is not field
    assert np.abs(shore_field(level).distance_m).max() == 10


@pytest.mark.parametrize(
    ("shape", "cell_m", "expected_m"),
    [((65, 97), 1.0, 0.5), ((65, 97), 2.0, 1.0), ((65, 97), 0.5, 0.5), ((65, 97), 0.25, 0.5), ((20, 1500), 1.0, 1.0),
     ((20, 4097), 1.0, 2.0), ((2, 2), 1.0, 0.5), ((2, 30), 100.0, 50.0)],
)  # fmt: skip
def test_texels_are_half_a_metre_where_they_fit(shape, cell_m, expected_m):
    """H10: about 4 texels a m², at most 2049 a side, never finer than half the level's cell; any shape works."""
    north = np.arange(shape[0])[:, None] * cell_m
    field = shore_field(level_of(np.broadcast_to(north - north.mean() + 0.1, shape) * 0.1, cell_m))
    assert field.cell_m == expected_m
    assert max(field.packed.shape) <= 2049
    assert field.packed.shape[1] == int((shape[1] - 1) * cell_m / expected_m) + 1
    assert np.isfinite(field.distance_m).all()
    assert np.isfinite(field.beach_m).all()


@pytest.mark.parametrize("height", [-30.0, 30.0])
def test_all_sea_and_all_land_are_fine(height):
    field = shore_field(level_of(np.full((65, 97), height)))
    assert (field.distance_m == (60 if height < 0 else -60)).all()
    assert (decode_direction(field.packed[..., 1:3]) == 0).all()


# The packed copy


def test_packed_says_what_the_float_copy_says():
    """H11: within range / 256, the sign kept; directions within 1/127; the slice within half its step."""
    field = shore_field(island())
    distance = decode_distance_m(field.packed[..., 0], field.range_m)
    assert np.array_equal(distance > 0, field.distance_m > 0)
    assert np.abs(distance - field.distance_m).max() <= field.range_m / 256 + 1e-4
    unit = np.moveaxis(direction(field.distance_m, field.cell_m), 0, -1)
    assert np.abs(decode_direction(field.packed[..., 1:3]) - unit).max() < 0.5 / 127 + 1e-4
    inside = np.abs(field.beach_m) < 2
    error = decode_beach_m(field.packed[..., 3]) - field.beach_m
    assert np.abs(error[inside]).max() <= 2 / 256 + 1e-4
    assert inside.mean() > 0.2


@pytest.mark.gl
def test_shaders_decode_what_python_does(ctx):
    """H10, H11: at texels and between them, and beyond the level; sent by rectangle when asked for."""
    from shorewright.renderer.program import Shader
    from shorewright.renderer.uniforms import bind_textures, set_uniforms, shore_field_uniforms
    from shorewright.renderer.upload import Uploader

    text = """#include "lib/shore_field.glsl"
#ifdef VERTEX
in vec2 in_xy;
out vec4 out_value;
void main() {
    vec4 p = shore_field_at(in_xy);
    out_value = vec4(decode_distance_m(p.r), decode_direction(p.gb), decode_beach_m(p.a));
}
#endif
#ifdef FRAGMENT
void main() {}
#endif
"""
    level, uploader = island(side=101, radius=25.0), Uploader(ctx)
    program = ctx.program(vertex_shader=_stage(text), varyings=["out_value"])
    target = ctx.simple_framebuffer((1, 1))  # a surfaceless context has none, and drawing needs one
    target.use()
    shader = Shader.__new__(Shader)
    shader.program = program
    rng = np.random.default_rng(2)
    level.set("shore.distance_range_m", 10.0)
    for number in range(2):
        if number:
            level.write("height", Rect(45, 70, 50, 76), 1.0)
        field = shore_field(level)
        texels = rng.integers(0, [field.packed.shape[1], field.packed.shape[0]], (300, 2))
        points = np.vstack([texels * field.cell_m, [[-40, 20.5], [300, 300]]]).astype("f4")
        clipped = np.clip(np.round(points / field.cell_m).astype(int), 0, np.array(field.packed.shape[1::-1]) - 1)
        bytes_ = field.packed[clipped[:, 1], clipped[:, 0]]
        expected = np.column_stack([decode_distance_m(bytes_[:, 0], field.range_m), decode_direction(bytes_[:, 1:3]),
                                    decode_beach_m(bytes_[:, 3])])  # fmt: skip
        textures = {"u_shore_field": uploader.shore_field(level)}
        set_uniforms(program, shore_field_uniforms(level))
        bind_textures(shader, textures)
        vertices = ctx.vertex_array(program, [(ctx.buffer(points.tobytes()), "2f", "in_xy")])
        out = ctx.buffer(reserve=16 * len(points))
        vertices.transform(out, ctx.POINTS)

        found = np.frombuffer(out.read(), "f4").reshape(-1, 4)
        np.testing.assert_allclose(found, expected, atol=5e-3)
        sent = uploader.sent["u_shore_field"]
    assert field.packed.nbytes < sent < 1.7 * field.packed.nbytes  # the whole, and the window of the change
    uploader.shore_field(level)
    assert uploader.sent["u_shore_field"] == sent  # nothing changed since
    uploader.release()


def _stage(text):
    from shorewright.renderer.program import resolve

    return "#version 410 core\n#define VERTEX\n" + resolve("probe.glsl", {"probe.glsl": text}).text


@pytest.mark.gl
def test_views_show_the_field(ctx):
    """H10, H11: the numbers of the three views are those of the field; nothing is sent while nobody looks."""
    from shorewright.level.objects import Camera
    from shorewright.renderer import Renderer, Show, render

    level, renderer = plane(side=129, slope=0.08), Renderer(ctx)
    camera = Camera(id="c", x=64, y=20, z=60, yaw_deg=0, pitch_deg=-50, fov_deg=60)
    options = {"size": (96, 54), "renderer": renderer, "show": Show.hide("water"), "linear": True, "quality": "low"}
    render(level, camera, **options)
    assert "u_shore_field" not in renderer.uploader.sent
    position, distance, slice_m, toward = (
        render(level, camera, view=name, **options)
        for name in ("position", "shore_distance", "beach_slice", "shore_direction")
    )
    inside = ((position[..., :2] > 1) & (position[..., :2] < 127)).all(axis=2)
    assert inside.sum() > 500
    inland = position[..., 1][inside] - 64 + 0.3
    clear = np.abs(inland) < 55
    step_m = 60 / 128  # software OpenGL filters 8-bit texels into 8 bits
    assert np.abs(distance[..., 0][inside] + inland)[clear].max() < step_m
    low = np.abs(inland) < 20
    assert np.abs(slice_m[..., 0][inside] - 0.08 * inland)[low].max() < 0.03
    np.testing.assert_allclose(toward[inside][clear][:, :2], [[0.5, 1.0]] * clear.sum(), atol=0.02)
    renderer.release()


@pytest.mark.parametrize(("shape", "cell_m"), [((2, 2), 0.25), ((2, 900), 1.0), ((3, 3), 0.1), ((900, 3), 0.2)])
def test_thin_levels_keep_both_sides(shape, cell_m):
    """H11: a level of two rows, or far finer than the field, has a field all the same."""
    height = np.linspace(-1, 1, shape[1], dtype=np.float32) * np.ones((shape[0], 1), np.float32)
    field = shore_field(level_of(height, cell_m))
    assert min(field.packed.shape[:2]) >= 2
    assert np.isfinite(decode_distance_m(field.packed[..., 0], field.range_m)).all()
