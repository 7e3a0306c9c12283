"""Objects as edits: merged drags, renaming, tools, markers, the water table's gradient (D12 H15 H01)."""

import numpy as np
import pytest
from coasts import make_beach
from scenes import camera
from shorewright.app import placing
from shorewright.app.editor import Editor
from shorewright.app.object_grip import Grip
from shorewright.app.object_markers import at_pixel, markers, outlines, shown
from shorewright.app.panels import gradient
from shorewright.app.panels.object_fields import HIDDEN_FIELDS, fields
from shorewright.app.preferences import Preferences
from shorewright.app.session import Session
from shorewright.app.tools import BRUSH, FRONT, LAKE, SELECT, TOOLS, pick_tool, put_away
from shorewright.level import BadInput
from shorewright.level.objects import OBJECT_KINDS

SIZE = (320, 200)


@pytest.fixture
def session():
    made = Session(make_beach(rows=257, slope=0.05))
    made.camera = camera(x=80.0, y=60.0, z=20.0, yaw=0.0, pitch=-30.0)
    return made


@pytest.fixture
def grip(session):
    return Grip(Editor(session, Preferences()))


def pixel(session, name):
    return next(tuple(at) for marker, at in shown(session.level, session.camera, SIZE) if marker.id == name)


@pytest.mark.parametrize("name", placing.PLACEABLES)
def test_every_row_can_be_placed_selected_and_undone(session, name):
    before = dict(session.level.objects)
    made = placing.put(session, name)
    if name == "prop":  # a level without meshes asks for a file
        assert made == ""
        assert list(session.requests) == ["prop"]
        return
    assert session.selected == made
    assert session.level.objects[made].kind == placing.PLACEABLES[name].kind
    while session.journal.done:
        session.undo()
    assert session.level.objects == before


def test_every_kind_has_a_row_and_fields_with_a_sentence():
    """The panel works for each kind by its declaration."""
    assert set(placing.BY_KIND) == set(OBJECT_KINDS)
    for kind in OBJECT_KINDS:
        rows = fields(kind)
        assert all(row.doc for row in rows)
        assert not {row.name for row in rows} & set(HIDDEN_FIELDS)
        assert ({"x", "y"} <= {row.name for row in rows}) != OBJECT_KINDS[kind].placeless


def test_a_drag_is_one_step_and_one_word(session):
    placing.put(session, "lamp")
    count, words = len(session.journal.done), len(session.record)
    for x in (50.0, 60.0, 70.0):
        session.alter("lamp-1", {"x": x}, merge=True)
    session.seal()
    session.alter("lamp-1", {"x": 71.0}, merge=True)
    assert len(session.journal.done) == count + 2
    assert len(session.record) == words + 2
    session.undo()
    assert session.level.objects["lamp-1"].x == 70.0
    session.undo()
    assert session.level.objects["lamp-1"].x not in (50.0, 60.0, 70.0)
    session.redo()
    session.redo()
    replayed = Session(make_beach(rows=257, slope=0.05))
    replayed.run(session.script)
    assert replayed.level.objects["lamp-1"] == session.level.objects["lamp-1"]


def test_bad_values_are_told_and_change_nothing(session):
    placing.put(session, "lamp")
    thing = session.level.objects["lamp-1"]
    with pytest.raises(BadInput, match="radius_m"):
        session.alter("lamp-1", {"radius_m": -3.0})
    with pytest.raises(BadInput, match="no object 'lamp-9'"):
        session.alter("lamp-9", {"x": 1.0})
    assert session.level.objects["lamp-1"] == thing


def test_renaming_is_one_step_and_keeps_a_table_in_use(session):
    placing.put(session, "lamp")
    placing.put(session, "water_table")
    session.rename("lamp-1", "pier")
    assert session.level.objects["pier"].id == "pier"
    with pytest.raises(BadInput, match="already"):
        session.rename("pier", "water-1")
    with pytest.raises(BadInput, match="id"):
        session.rename("pier", "a b")
    session.rename("water-1", "lagoon")
    assert session.selected == "lagoon"
    assert session.level.settings.water.table == "lagoon"
    replayed = Session(make_beach(rows=257, slope=0.05))
    replayed.run(session.script)
    assert replayed.level.objects == session.level.objects
    session.undo()
    session.undo()
    session.undo()
    assert "lamp-1" in session.level.objects
    assert "pier" not in session.level.objects


def test_a_click_on_a_marker_selects_and_a_drag_moves_over_the_sea(session, grip):
    """The object stays under the pointer, as high above the surface as it was; the whole drag is one step."""
    placing.put(session, "lamp", (80.0, 100.0, 0.0))
    session.selected, session.tool = "", SELECT
    start = pixel(session, "lamp-1")
    steps = len(session.journal.done)
    assert grip.press(start, SIZE, False, False)
    assert session.selected == "lamp-1"
    assert grip.drag((start[0] + 1, start[1]), SIZE)
    grip.release()
    assert len(session.journal.done) == steps  # a click moves nothing
    foot = grip.surface(start, SIZE)
    assert grip.press(start, SIZE, False, False)
    for way in (10, 25, 40):
        assert grip.drag((start[0] + way, start[1] + 5), SIZE)
    grip.release()
    moved, now = session.level.objects["lamp-1"], grip.surface((start[0] + 40, start[1] + 5), SIZE)
    assert len(session.journal.done) == steps + 1
    assert (moved.x - 80.0, moved.y - 100.0) == pytest.approx((now[0] - foot[0], now[1] - foot[1]), abs=0.02)
    clearance = moved.z - placing.surface_m(session.level, moved.x, moved.y)
    assert clearance == pytest.approx(placing.PLACEABLES["lamp"].up_m, abs=0.02)
    assert not grip.press((5.0, 5.0), SIZE, False, False)  # the sky
    assert session.selected == ""


def test_turning_and_lifting(session, grip):
    placing.put(session, "camera")
    session.alter("camera-1", {"y": 110.0, "z": 6.0})
    session.tool = SELECT
    start = pixel(session, "camera-1")
    yaw = session.level.objects["camera-1"].yaw_deg
    assert grip.press(start, SIZE, True, False)
    grip.drag((start[0] + 60, start[1]), SIZE)
    grip.release()
    assert session.level.objects["camera-1"].yaw_deg == pytest.approx(placing.turned(yaw, 30.0), abs=0.1)
    assert grip.press(start, SIZE, False, True)
    grip.drag((start[0], start[1] - 20), SIZE)
    grip.release()
    assert session.level.objects["camera-1"].z > 7.0
    assert pixel(session, "camera-1")[1] == pytest.approx(start[1] - 20, abs=3)
    placing.put(session, "mover")
    with pytest.raises(BadInput, match="no direction"):
        placing.turn(session, 15.0)


def test_tools_drop_where_one_clicks(session, grip):
    """A burst keeps the clock's moment; the drag that follows belongs to the same step."""
    session.clock.scrub(7.25)
    pick_tool(session, "burst")
    steps = len(session.journal.done)
    where = (150.0, 120.0)
    assert grip.press(where, SIZE, False, False)
    assert grip.drag((170.0, 120.0), SIZE)
    grip.release()
    (burst,) = [thing for thing in session.level.objects.values() if thing.kind == "disturbance"]
    assert burst.time_s == 7.25
    assert (burst.x, burst.y) == pytest.approx(grip.surface((170.0, 120.0), SIZE)[:2], abs=0.02)
    assert len(session.journal.done) == steps + 1
    put_away(session)
    assert session.tool == BRUSH
    with pytest.raises(BadInput, match="no tool is called"):
        pick_tool(session, "hammer")
    session.pick_brush("lower")
    assert session.tool == BRUSH
    assert set(TOOLS) == {BRUSH, SELECT, FRONT, LAKE, *(row.name for row in placing.PLACEABLES.values() if row.clicks)}


def test_the_sea_is_met_before_its_bed(session):
    """A low look over water means the water there, not the sand far behind it."""
    origin, ray = np.array([80.0, 0.0, 3.0]), np.array([0.0, 1.0, -0.1])
    x, y, z = placing.meets_surface(session.level, origin, ray)
    assert (x, y, z) == pytest.approx((80.0, 30.0, 0.0))
    assert placing.meets_surface(session.level, origin, np.array([0.0, -1.0, 0.2])) is None


def test_markers_stand_on_what_they_mark(session):
    placing.put(session, "lamp", (80.0, 100.0, 0.0))
    placing.put(session, "view_circle", (60.0, 90.0, 0.0))
    placing.put(session, "sea_patch", (60.0, 90.0, 0.0))
    placing.put(session, "water_table")
    found = {marker.id: marker for marker in markers(session.level)}
    assert set(found) >= {"lamp-1", "view-1", "patch-1"}
    assert "water-1" not in found
    assert found["lamp-1"].place[2] - found["lamp-1"].foot[2] == pytest.approx(3.0, abs=0.02)
    (ring,) = outlines(session.level, session.level.objects["view-1"])
    assert np.hypot(ring[:, 0] - 60.0, ring[:, 1] - 90.0) == pytest.approx(400.0)
    (square,) = outlines(session.level, session.level.objects["patch-1"])
    assert square[:, :2].min(axis=0) == pytest.approx((0.0, 0.0))
    assert square[:, :2].max(axis=0) == pytest.approx((100.0, 100.0))
    assert np.linalg.norm(np.diff(square[:, :2], axis=0), axis=1).max() == pytest.approx(10.0)
    assert at_pixel(session.level, session.camera, SIZE, pixel(session, "lamp-1")) == "lamp-1"


def test_gradient_stops_stay_in_order(session):
    """H15: a stop never passes its neighbours; one put on the line changes no colour."""
    placing.put(session, "water_table")
    stops = session.level.objects["water-1"].stops
    for part in (0.0, 0.3, 1.0):
        assert gradient.to_axis(gradient.to_metres(part)) == pytest.approx(part)
    moved = gradient.with_stop(stops, 3, metres=900.0)
    recoloured = gradient.with_stop(stops, 3, left=(0.5, 0.4, 0.3))
    assert recoloured[3] == (stops[3][0], 0.5, 0.4, 0.3, *stops[3][4:])
    assert moved == tuple(sorted(moved))
    assert stops[2][0] < moved[3][0] < stops[4][0]
    more, number = gradient.inserted(stops, 2.345)
    assert len(more) == len(stops) + 1
    table = np.array(stops)
    for i in range(1, 7):
        assert more[number][i] == pytest.approx(np.interp(2.345, table[:, 0], table[:, i]))
    session.alter("water-1", {"stops": more})
    assert session.level.objects["water-1"].stops == more


def test_a_copy_is_checked_like_anything_else(session):
    """A duplicate whose name would be too long is refused; nothing is left behind."""
    session.place({"kind": "mover", "id": "m" * 64, "x": 80.0, "y": 90.0})
    session.selected = "m" * 64
    before = dict(session.level.objects)
    with pytest.raises(BadInput, match="id"):
        placing.duplicate(session)
    assert session.level.objects == before


def test_a_drag_that_is_broken_off_is_a_step_of_its_own(session, grip):
    placing.put(session, "lamp", (80.0, 100.0, 0.0))
    session.tool = SELECT
    start = pixel(session, "lamp-1")
    assert grip.press(start, SIZE, False, False)
    assert grip.drag((start[0] + 20, start[1]), SIZE)
    put_away(session)  # Esc
    assert not grip.drag((start[0] + 40, start[1]), SIZE)
    grip.release()
    steps = len(session.journal.done)
    session.alter("lamp-1", {"x": 60.0}, merge=True)
    assert len(session.journal.done) == steps + 1
    put_away(session)
    put_away(session)
    assert (session.tool, session.selected) == (BRUSH, "")
