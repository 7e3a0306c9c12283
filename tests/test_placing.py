"""Objects placed where the camera looks (D01 D06 H15)."""

import pytest
from coasts import make_beach
from scenes import camera
from shorewright.app.actions import ACTIONS
from shorewright.app.session import Session
from shorewright.level.objects import Disturbance, FlowPoint, Mover, PointLight, WaterTable

PLACED = {
    "place.flow_point": FlowPoint,
    "place.lamp": PointLight,
    "place.mover": Mover,
    "place.burst": Disturbance,
    "place.water_table": WaterTable,
}


@pytest.fixture
def session():
    made = Session(make_beach(rows=257, slope=0.05))
    made.camera = camera(x=80.0, y=60.0, z=20.0, yaw=0.0, pitch=-30.0)
    return made


@pytest.mark.parametrize("name", PLACED)
def test_an_object_comes_where_one_looks_and_goes_with_undo(session, name):
    before = dict(session.level.objects)
    ACTIONS[name].run(session)
    ACTIONS[name].run(session)
    made = [thing for key, thing in session.level.objects.items() if key not in before]
    assert [type(thing) for thing in made] == [PLACED[name]] * 2
    if name != "place.water_table":
        assert (made[0].x, made[0].y) == pytest.approx((80.0, 60.0 + 20.0 / 0.577), abs=12)
    replayed = Session(make_beach(rows=257, slope=0.05))
    replayed.run(session.script)
    assert replayed.level.objects.keys() >= {thing.id for thing in made}
    while session.journal.done:
        session.undo()
    assert session.level.objects == before


def test_where_only_sky_is_the_middle_of_the_level_counts(session):
    session.camera = camera(pitch=40.0)
    ACTIONS["place.lamp"].run(session)
    lamp = session.level.objects["lamp-1"]
    assert (lamp.x, lamp.y) == pytest.approx(tuple(side / 2 for side in session.level.grid.extent_m), abs=0.01)


def test_a_water_table_is_in_use_at_once(session):
    ACTIONS["place.water_table"].run(session)
    assert session.level.settings.water.table == "water-1"
