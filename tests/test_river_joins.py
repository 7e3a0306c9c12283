"""Where rivers meet other rivers and lakes, and drop: tails, beds, levels (D13, D35)."""

import json

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app.session import Session
from shorewright.io import read_level, write_level
from shorewright.level import BadInput
from shorewright.level.objects import Camera
from shorewright.level.river_bed import carved
from shorewright.level.river_join import line_of, main_first, runs_to_sea
from shorewright.level.river_map import river_map
from shorewright.level.river_trace import begun
from shorewright.renderer import render
from test_rivers import coast, down, valley

LEAST = 70  # of 255


def put(level, river, carve=True):
    if carve:
        level.write("height", *carved(level, river))
    level.put_object(river.id, river)
    return river


def tributary(name="creek", end_m=0.3):
    """From the west into the river of `coast`, low down; it ends in the middle of that."""
    return down(15, 112, 60, 96, (3.0, 2.0, end_m)).model_copy(update={"id": name})


def test_a_new_river_ends_in_the_water_that_is_there():
    """D13: as a tributary at that water's level, no point below it, no reach out to sea."""
    with Session(valley()) as session:
        session.river_begin("river", 62.0, 150.0)
        session.river_carve("river")
        session.river_begin("creek", 95.0, 140.0)
        river, creek, made = session.river("river"), session.river("creek"), river_map(session.level)
        carved_m = carved(session.level, creek)[1]
    x, y, _, level_m, _ = creek.points[-1]
    at = made.at(95.0 + x, 140.0 + y)
    assert at["share"].v >= 0.5
    assert made.owner[round(140 + y), round(95 + x)] == 1  # "river"
    assert level_m == pytest.approx(float(at["stage"].v), abs=0.1)
    assert level_m > 0.5
    assert min(point[3] for point in creek.points) == level_m
    assert (creek.reach_m, river.reach_m) == (0.0, 60.0)
    assert np.isfinite(carved_m).all()


def test_a_new_river_ends_in_a_lake():
    """D13: painted water is as good as a river's, though its bed lies below the sea."""
    level = make_beach(rows=161, cols=121)
    ground = level.height.copy()
    ground[90:110, 20:100] = -2.0
    level.write("height", level.grid.rect, ground)
    lake = np.zeros(level.grid.shape, np.float32)
    lake[90:110, 20:100] = 1.0
    level.write("river_mask", level.grid.rect, lake)
    level.write("river_surface", level.grid.rect, 1.5 * lake)
    x, y, _, level_m, _ = begun(level, 60.0, 150.0)["points"][-1]
    assert lake[int(150 + y), int(60 + x)] == 1
    assert level_m == pytest.approx(1.5, abs=0.01)


def test_only_what_comes_to_the_sea_runs_out_to_it():
    """D35: no tail across the main river, none on land, none in a lake; the main river keeps its own."""
    level = coast()
    river = level.objects["river"]
    assert runs_to_sea(level, river)
    creek = put(level, tributary(), carve=False)
    assert not runs_to_sea(level, creek)
    line = line_of(level, creek)
    assert line.mouth == len(line.x)
    assert runs_to_sea(level, river)
    assert line_of(level, river).mouth < len(line_of(level, river).x)
    assert not runs_to_sea(level, down(15, 150, 40, 130, (0.4, 0.2)))
    assert main_first((creek, river)) == [1, 0]
    level.write("river_mask", level.grid.rect, np.float32(1))
    assert not runs_to_sea(level, river)


def test_no_dam_is_raised_across_another_river():
    """D13: neither river's banks stand in the other's water, whichever is carved last."""
    for first in ("river", "creek"):
        level = make_beach(rows=161, cols=121)
        main = down(60, 155, 60, 74, (4.5, 3.0, 2.4, 0.5, 0.0))
        both = {"river": main, "creek": tributary(end_m=1.4)}
        for river in both.values():
            level.put_object(river.id, river)
        for name in (first, *(set(both) - {first})):
            level.write("height", *carved(level, both[name]))
        for river in both.values():
            line = line_of(level, river)
            on = slice(4, line.mouth - 1)
            ground = level.height[np.rint(line.y[on]).astype(int), np.rint(line.x[on]).astype(int)]
            assert (line.level_m[on] - ground).min() > 0.6, (first, river.id)


def test_a_fall_stays_sharp_and_its_banks_hold_it():
    """D13: the level is within 0.4 m of the line's down a fall, nowhere over the bank, and the bed is under it."""
    level = make_beach(rows=161, cols=121)
    river = down(60, 155, 60, 74, (9.5, 9.2, 9.0, 0.5, 0.0), depth_m=0.5)
    knots = list(river.points)
    knots[3] = (0.0, -44.0, 8.0, 4.0, 2.0)  # 5 m down in 3.5
    river = put(level, river.model_copy(update={"points": tuple(knots)}))
    made, line = river_map(level), line_of(level, river)
    on = slice(3, line.mouth - 2)
    stage = made.at(line.x[on], line.y[on])["stage"].v + level.mean_sea_m
    assert np.abs(stage - line.level_m[on]).max() < 0.4
    water = made.packed[90:150, :, 0] + level.mean_sea_m
    share = made.packed[90:150, :, 1]
    assert (water - level.height[90:150])[(share > 0.3) & (share < 0.95)].max() < 0.05
    middle = made.packed[80:150, 60, 0] + level.mean_sea_m - level.height[80:150, 60]
    assert middle.min() > 0.1


def test_a_dragged_river_waits_for_nothing():
    """D13 D35: with a solver beside, water moves at once; the waves that meet it follow when its flow has come."""

    class Beside:
        comes = False

        def beside(self, name, key, request):
            return request().answered() if self.comes else None

    level = coast()
    river, before = level.objects["river"], river_map(level)
    level.solver = Beside()
    level.put_object("river", river.model_copy(update={"x": river.x + 6.0}))
    moved = river_map(level)
    assert moved.packed[130, 70, 1] == 1
    assert before.packed[130, 70, 1] == 0
    assert moved.packed[130, 70, 3] <= 0  # none of the sea's waves in new water
    assert river_map(level) is moved
    level.solver.comes = True
    came = river_map(level)
    fresh = coast()
    fresh.write("height", level.grid.rect, level.height)
    fresh.put_object("river", level.objects["river"])
    np.testing.assert_array_equal(came.packed, river_map(fresh).packed)


@pytest.mark.gl
def test_a_fall_above_an_eye_in_the_air_is_not_black(renderer):
    """D13: it is seen from outside, with no dark line at the eye's horizon."""
    level = make_beach(rows=161, cols=121)
    river = down(60, 155, 60, 74, (9.5, 9.2, 9.0, 0.5, 0.0), depth_m=0.5)
    knots = list(river.points)
    knots[3] = (0.0, -44.0, 8.0, 3.0, 2.0)
    put(level, river.model_copy(update={"points": tuple(knots)}))
    level.set("river.turbulent", 0.0)  # or foam covers it
    eye = Camera(id="eye", x=60, y=100, z=6, yaw_deg=0, pitch_deg=10, fov_deg=50)
    drawn = render(level, eye, (240, 135), 3.0, renderer=renderer, quality="low")[..., :3].astype(float)
    assert drawn[:, 100:140].max(-1).min() > LEAST


def test_a_wrong_river_in_a_file_is_told_in_a_sentence(tmp_path):
    """D13: which object, what is wrong and where; not all its points."""
    folder = tmp_path / "wrong.shore"
    write_level(coast(), folder)
    path = folder / "level.json"
    text = json.loads(path.read_text())
    text["objects"][0]["points"][2][3] = 50.0
    path.write_text(json.dumps(text))
    with pytest.raises(BadInput) as told:
        read_level(folder)
    says = str(told.value).partition("cannot be used: ")[2]
    assert says.startswith("object 'river', points: point 3 of the river lies 47.00 m higher")
    assert len(says) < 140
