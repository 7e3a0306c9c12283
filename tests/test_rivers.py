"""Water that isn't the sea: its line, its level, the mouth, CPU against GPU (D13, D35, H32)."""

import numpy as np
import pytest
from coasts import make_beach
from points import feedback
from pydantic import ValidationError
from shorewright.app.script import Script
from shorewright.app.session import Session
from shorewright.level import BadInput, Grid, Level
from shorewright.level.objects import Camera, River, WaveObject
from shorewright.level.river_bed import carved
from shorewright.level.river_edit import deleted, inserted, set_point, snapped
from shorewright.level.river_line import centre_line
from shorewright.level.river_map import river_map
from shorewright.level.river_trace import traced
from shorewright.level.waves import sea_at, surface_at
from shorewright.renderer import render
from shorewright.renderer.passes import sea


def down(x0, y0, x1, y1, levels, width_m=8.0, speed_mps=1.0, **more):
    """A straight river with points at these levels."""
    way = np.linspace(0, 1, len(levels))
    points = tuple((float(u * (x1 - x0)), float(u * (y1 - y0)), width_m, float(v), speed_mps)
                   for u, v in zip(way, levels, strict=True))  # fmt: skip
    return River(id="river", x=x0, y=y0, points=points, **more)


def coast(**more):
    """A beach that rises to the north with a river in a bed of its own: 100 m down a slope into the sea."""
    level = make_beach(rows=161, cols=121)
    level.set("sea.swell_m", 0.3)
    river = down(60, 155, 60, 74, (4.5, 3.0, 2.4, 0.5, 0.0), **more)
    level.write("height", *carved(level, river))
    level.put_object("river", river)
    return level


@pytest.mark.parametrize(
    ("points", "says"),
    [
        ([(0, 0, 5, 1, 1)], "two points"),
        ([(0, 0, 5, 1, 1), (50, 0, 0, 1, 1)], "0 m wide"),
        ([(0, 0, 5, 1, 1), (50, 0, 5, 2, 1)], "1.00 m higher"),
        ([(0, 0, 5, 1, 1), (0, 0, 5, 1, 1)], "one place"),
        ([(0, 0, 5, 3, 1), (50, 0, 5, 2, 1), (50, 50, 5, 2, 1), (20, -30, 5, 1, 1)], "crosses itself"),
        ([(0, 0, 5, 3, 99), (50, 0, 5, 2, 1)], "99 m/s"),
    ],
)
def test_wrong_lines_are_told(points, says):
    """D13: two points or more, of some width, downhill, never across themselves."""
    with pytest.raises(ValidationError, match=says):
        River(id="river", points=points)


def test_the_dense_line_runs_through_its_points_and_downhill():
    """D13: no overshoot of the level between two points, even past a fall."""
    points = ((0, 0, 4, 9, 1), (40, 10, 6, 8.9, 1), (45, 12, 6, 2, 2), (90, 0, 9, 2, 1), (120, 40, 12, 0, 1))
    line = centre_line(River(id="river", x=7, y=3, points=points, reach_m=0), 0.0)
    for east, north, width, level, speed in points:
        at = np.argmin(np.hypot(line.x - 7 - east, line.y - 3 - north))
        found = line.x[at] - 7, line.y[at] - 3, 2 * line.half_m[at], line.level_m[at], line.speed_mps[at]
        np.testing.assert_allclose(found, (east, north, width, level, speed), atol=1e-9)
    assert (np.diff(line.level_m) <= 1e-12).all()
    assert np.diff(line.along_m).max() < 1.6


def test_the_bed_is_carved_under_the_water_and_holds_it():
    """D13: water in the middle is as deep as asked, and no bank lies lower than the water beside it."""
    level = coast()
    made, ground = river_map(level), level.height
    middle = level.mean_sea_m + made.packed[150, 60, 0] - ground[150, 60]
    assert middle == pytest.approx(1.2, abs=0.1)
    rows = slice(90, 154)
    over = made.packed[rows, :, 0] - ground[rows]
    rim = (made.packed[rows, :, 1] > 0) & (made.packed[rows, :, 1] < 0.5)
    assert rim.any()
    assert (over[rim] < 0.02).all()
    before, after = make_beach(rows=161, cols=121).height, ground
    assert (after[:, :20] == before[:, :20]).all()


def test_no_dam_is_built_out_to_sea():
    """D13: carving a river that ends beyond the shoreline raises no ground that the sea covers."""
    level = make_beach(rows=161, cols=121)
    before = level.height.copy()
    rect, made = carved(level, down(60, 155, 60, 50, (4.5, 3.0, 1.2, 0.3, 0.0)))
    under = before[rect.slices] < level.mean_sea_m
    assert under.any()
    assert (made <= before[rect.slices])[under].all()
    assert (made < before[rect.slices])[under].any()


def test_surface_stands_at_the_rivers_level_inland_and_at_the_seas_outside():
    """H32: water at any level is one surface with the sea."""
    level = coast()
    level.set("river.wave_m", 0.0)
    inland = sea_at(level, 3.0, np.full(3, 60.0), np.array([150.0, 130.0, 110.0]))
    expected = river_map(level).packed[[150, 130, 110], 60, 0]
    np.testing.assert_allclose(inland.height_m, expected, atol=2e-3)
    far = np.full(3, 20.0), np.array([10.0, 30.0, 60.0])
    bare = make_beach(rows=161, cols=121)
    bare.set("sea.swell_m", 0.3)
    np.testing.assert_array_equal(sea_at(level, 3.0, *far).height_m, sea_at(bare, 3.0, *far).height_m)


@pytest.mark.parametrize("tide_m", [0.0, 0.8, -0.5])
def test_no_step_and_no_kink_through_the_mouth(tide_m):
    """D35: along the middle from river to sea, height and slope change as smoothly as anywhere in the sea."""
    level = coast()
    level.set("sea.swell_m", 0.0)
    level.set("sea.chop_m", 0.0)
    level.set("shore.on", False)
    level.set("river.wave_m", 0.0)
    level.tide_m = tide_m
    y = np.arange(20.0, 150.0, 0.05)
    height = sea_at(level, 0.0, np.full(y.shape, 60.0), y).height_m
    assert np.abs(np.diff(height)).max() < 0.05 * 0.25
    assert height[0] == pytest.approx(tide_m, abs=1e-6)
    assert height.min() >= tide_m - 1e-6


@pytest.mark.gl
@pytest.mark.parametrize("t", [0.0, 604_800.0])
def test_shader_and_twin_agree(ctx, t):
    """D30 with a river: 10,000 points within a millimetre at 0 and a week."""
    level = coast()
    level.set("river.wave_m", 0.2)
    rng = np.random.default_rng(1)
    at = rng.uniform((0, 0), (120, 160), (10_000, 2))
    twin = surface_at(level, t, at[:, 0], at[:, 1])
    seen = feedback(ctx, level, t, at)
    assert np.abs(seen[:, 2] - twin.height_m).max() < 1e-3


def valley():
    """A slope with a winding valley down to the sea."""
    y, x = np.mgrid[0:161, 0:121].astype(float)
    middle = 60 + 15 * np.sin(y / 25)
    return Level(Grid(161, 121, 1.0), (0.05 * (y - 50) + 0.002 * (x - middle) ** 2).astype(np.float32))


def test_a_new_river_follows_its_valley_to_the_sea():
    """D13: traced from a spring, downhill all the way, near the valley's bottom, into the sea."""
    level = valley()
    points = np.array(traced(level, 62.0, 150.0))
    x, y = points[:, 0] + 62, points[:, 1] + 150
    assert (np.diff(points[:, 3]) <= 0).all()
    assert level.height[int(y[-1]), int(x[-1])] < 0
    assert np.abs(x - (60 + 15 * np.sin(y / 25))).max() < 10
    assert traced(level, 60.0, 10.0)[-1][3] == pytest.approx(0.0)  # from out at sea, it comes from the land


def test_points_are_inserted_deleted_and_kept_downhill():
    """D13: a point more leaves the line where it was; a level stays between its neighbours'."""
    river = down(60, 155, 60, 74, (4.5, 3.0, 0.0))
    points, n = inserted(river, 61.0, 140.0)
    assert n == 1
    more = river.model_copy(update={"points": points})
    np.testing.assert_allclose(centre_line(more, 0.0).level_m.max(), 4.5)
    assert points[1][3] == pytest.approx(np.interp(15, [0, 40.5], [4.5, 3.0]), abs=0.2)
    assert deleted(more, 1) == river.points
    assert set_point(river, 1, level_m=9.0)[1][3] == 4.5
    assert set_point(river, 1, level_m=-9.0)[1][3] == 0.0
    with pytest.raises(BadInput, match="two points"):
        deleted(down(60, 155, 60, 74, (4.5, 3.0)), 0)


def test_levels_snap_to_the_lowest_ground_so_far():
    """D13: snapped to the bed, never uphill."""
    level = valley()
    river = River(id="r", x=60.0, y=150.0, points=((0, 0, 6, 50, 1), (10, -60, 6, 40, 1), (0, -120, 6, 30, 1)))
    found = [point[3] for point in snapped(level, river)]
    assert found == sorted(found, reverse=True)
    assert found[-1] == 0.0
    assert found[0] == pytest.approx(level.height[150, 60], abs=0.1)


def test_a_hollow_is_filled_to_a_level_and_drained(tmp_path):
    """H32 D13: the basin alone is wet, undo takes it back; what would run out is refused."""
    y, x = np.mgrid[0:81, 0:81].astype(float)
    bowl = 5 + 0.02 * ((x - 40) ** 2 + (y - 40) ** 2).clip(0, 400)
    level = Level(Grid(81, 81, 1.0), bowl.astype(np.float32))
    with Session(level) as session:
        assert session.fill_water(40, 40, 8.0) == (bowl < 8).sum()
        wet = river_map(level).wet & (level.height < 8)
        np.testing.assert_array_equal(wet, bowl < 8)
        assert sea_at(level, 0.0, np.array([40.0]), np.array([45.0])).height_m[0] == pytest.approx(8.0, abs=1e-4)
        with pytest.raises(BadInput, match="out of the level"):
            session.fill_water(40, 40, 20.0)
        with pytest.raises(BadInput, match="ground here"):
            session.fill_water(40, 40, 4.0)
        session.fill_water(40, 40, 8.0, drain=True)
        assert not river_map(level).wet.any()
        session.undo()
        session.undo()
        assert river_map(level) is None


@pytest.mark.gl
def test_wave_objects_stand_on_any_water(ctx):
    """H32: rings in a pool eight metres up, the same in shader and twin; none on the dry ground round it."""
    y, x = np.mgrid[0:81, 0:81].astype(float)
    bowl = 5 + 0.02 * ((x - 40) ** 2 + (y - 40) ** 2).clip(0, 400)
    level = Level(Grid(81, 81, 1.0), bowl.astype(np.float32))
    with Session(level) as session:
        session.fill_water(40, 40, 8.0)
    level.put_object("rings", WaveObject(id="rings", x=40, y=40, ring=True, radius_m=9, length_m=3, amplitude_m=0.2))
    at = np.random.default_rng(2).uniform(30, 50, (4000, 2))
    twin = surface_at(level, 1.5, at[:, 0], at[:, 1])
    assert np.ptp(twin.height_m) > 0.2
    assert np.abs(feedback(ctx, level, 1.5, at)[:, 2] - twin.height_m).max() < 1e-3


def test_carving_is_one_step_and_a_word_of_the_script():
    """D13: undo ∘ do is the identity; the script carves the same bytes."""
    first, again = Session(valley()), Session(valley())
    before = first.level.height.copy()
    first.river_begin("creek", 62.0, 150.0)
    first.river_carve("creek")
    carved_m = first.level.height.copy()
    assert (carved_m != before).any()
    again.run(Script(actions=first.record))
    np.testing.assert_array_equal(again.level.height, carved_m)
    first.undo()
    np.testing.assert_array_equal(first.level.height, before)


@pytest.mark.gl
def test_chunks_far_from_rivers_are_drawn_without_them_to_the_same_bytes(renderer, monkeypatch):
    """D13: where no river is felt the sea costs what it did, and nothing is seen of where that begins."""
    level = coast()
    eye = Camera(id="eye", x=60, y=20, z=60, yaw_deg=0, pitch_deg=-50, fov_deg=60)

    def drawn():
        return render(level, eye, (96, 64), 3.0, renderer=renderer, quality="low")

    parts, few = drawn(), renderer.stats["river_chunks"]
    monkeypatch.setattr(sea, "_beside_rivers", lambda frame, lod, chunks: np.ones(len(chunks), bool))
    np.testing.assert_array_equal(parts, drawn())
    assert 0 < few < renderer.stats["river_chunks"]
