"""Wave objects in hand: too many on a hectare, the fit to a bay, the gizmo and its handles, the view (H08 H09 D32)."""

import json

import numpy as np
import pytest
from scenes import camera
from shorewright import io
from shorewright.app import wave_gizmo
from shorewright.app.actions import ACTIONS
from shorewright.app.camera_control import to_screen
from shorewright.app.editor import Editor
from shorewright.app.object_grip import Grip
from shorewright.app.preferences import Preferences
from shorewright.app.session import Session
from shorewright.app.tools import SELECT
from shorewright.io.check_level import check
from shorewright.level import BadInput, Grid, Level
from shorewright.level.dual import Dual
from shorewright.level.objects import SwellRegion, WaveObject
from shorewright.level.wave_fit import fit_to_shore, shoreline
from shorewright.level.wave_lists import counted, patch_lists
from shorewright.level.wave_objects import front_coordinate, object_fronts
from shorewright.level.waves import surface_at

SIZE = (800, 500)


def bay(bend: float) -> Level:
    """Sea in the south; its shore a half circle of 150 m round (200, 120): a bay (1), a headland (−1), straight (0)."""
    y, x = np.mgrid[0:401, 0:401].astype(np.float64)
    away = np.hypot(x - 200, np.maximum(y - 120, 0)) - 150 if bend > 0 else 110 - np.hypot(x - 200, y - 380)
    height = np.where(bend == 0, (y - 250), away) * 0.08
    return Level(Grid(401, 401), height.astype(np.float32))


def wave(name="wave-1", **fields):
    return WaveObject(**{"id": name, "x": 200.0, "y": 170.0, "radius_m": 120.0, "yaw_deg": 77.0, **fields})


@pytest.fixture
def session():
    made = Session(bay(1))
    made.camera = camera(x=200.0, y=-60.0, z=150.0, yaw=0.0, pitch=-32.0)
    return made


@pytest.mark.parametrize(("bend", "least", "most"), [(1, 0.6, 1.0), (0, -0.06, 0.06), (-1, -1.0, -0.35)])
def test_a_fitted_front_lies_along_the_whole_shore(bend, least, most):
    """H09: in a bay fronts bulge ahead, off a headland they close round it, else they are straight."""
    level, thing = bay(bend), wave()
    values = fit_to_shore(level, thing)
    assert least <= values["curvature"] <= most
    assert values["yaw_deg"] == pytest.approx(0.0, abs=4.0)
    points = shoreline(level, thing.x, thing.y, thing.radius_m)
    spread = []
    for tried in (thing.model_copy(update=values), thing.model_copy(update={"yaw_deg": 0.0, "curvature": 0.0})):
        fronts = object_fronts(tried, 0)
        q = front_coordinate(tried, fronts.east[0], fronts.north[0], *map(Dual, points.T))[0].v
        spread.append(q.std())
        assert q.mean() > 0  # the shore is ahead
    assert spread[0] < 0.05 * thing.radius_m
    assert bend == 0 or spread[0] < 0.5 * spread[1]


def test_fitting_is_one_step_and_may_move_the_object(session):
    """H09, T08: the shore comes to lie at its share of the radius; undo is the way back; a script does it again."""
    session.place(wave(y=165.0))
    session.selected = "wave-1"
    before, steps = session.level.objects["wave-1"], len(session.journal.done)
    ACTIONS["wave.fit_place"].run(session)
    after = session.level.objects["wave-1"]
    assert len(session.journal.done) == steps + 1
    assert after.y == pytest.approx(270 - 0.55 * 120, abs=4.0)
    replayed = Session(bay(1))
    replayed.run(session.script)
    assert replayed.level.objects == session.level.objects
    session.undo()
    assert session.level.objects["wave-1"] == before
    session.place(wave("far", y=-300.0))
    with pytest.raises(BadInput, match=r"^far has no shore within its radius of 120 m"):
        session.fit_wave("far")
    session.place({"kind": "sea_seed", "id": "seed"})
    with pytest.raises(BadInput, match="no wave object"):
        session.fit_wave("seed")


def test_a_fifth_object_on_a_hectare_is_refused_and_the_weakest_named(session):
    """H08: when placed and when moved; nothing changes, and the sentence names the weakest that is there."""
    for n, height in enumerate((0.9, 0.3, 0.6, 0.5)):
        session.place(wave(f"wave-{n}", amplitude_m=height, radius_m=40.0, x=150.0))
    before, steps = dict(session.level.objects), len(session.journal.done)
    with pytest.raises(BadInput, match=r"at most 4 wave objects reach one hectare.*the weakest there is wave-1"):
        session.place(wave("late", radius_m=40.0, x=150.0))
    assert (dict(session.level.objects), len(session.journal.done)) == (before, steps)
    session.place(wave("late", radius_m=40.0, x=350.0))
    with pytest.raises(BadInput, match="the weakest there is wave-1"):
        session.alter("late", {"x": 190.0})
    session.alter("wave-1", {"x": 152.0})  # one of the four goes about within them
    for n in range(4):
        session.place(SwellRegion(id=f"region-{n}"))
    with pytest.raises(BadInput, match="at most 4 regions"):
        session.place(SwellRegion(id="region-9"))


def test_a_file_with_too_many_is_told_of_and_the_weakest_left_out(tmp_path):
    """H08: `check` and the note on opening name it; it makes no waves anywhere; the others do."""
    level = bay(1)
    for n, height in enumerate((0.9, 0.3, 0.6, 0.5, 0.4)):
        level.put_object(f"wave-{n}", wave(f"wave-{n}", amplitude_m=height))
    io.write_level(level, tmp_path / "bay.shore")
    told = [line for line in check(tmp_path / "bay.shore") if "wave" in line]
    assert len(told) == 1
    assert "wave-1, the weakest, is left out" in told[0]
    notes: list[str] = []
    opened = io.read_level(tmp_path / "bay.shore", notes)
    assert any("wave-1, the weakest, is left out" in note for note in notes)
    assert [thing.id for thing in counted(opened)[0]] == ["wave-0", "wave-2", "wave-3", "wave-4"]
    assert max(len(those) for those in patch_lists(counted(opened)[0]).values()) == 4
    x, y = np.meshgrid(np.linspace(100, 300, 50), np.linspace(80, 250, 50))
    with_it = surface_at(opened, 3.0, x, y).height_m
    opened.put_object("wave-1", None)
    assert np.array_equal(with_it, surface_at(opened, 3.0, x, y).height_m)
    level.put_object("wave-1", None)
    io.write_level(level, tmp_path / "fine.shore")
    assert check(tmp_path / "fine.shore") == []
    assert json.loads((tmp_path / "fine.shore" / "level.json").read_text())["objects"]


def test_a_crop_that_moves_hectares_tells_whom_it_leaves_out(session):
    """H08: five objects on two hectares come to lie on one; the note names the weakest, undo brings it back."""
    for n in range(5):
        x = 85.0 if n < 2 else 115.0
        session.place(wave(f"wave-{n}", x=x, y=50.0, radius_m=10.0, amplitude_m=0.9 - 0.1 * n))
    assert len(counted(session.level)[0]) == 5
    session.crop(50.0, 0.0, 400.0, 400.0)
    assert [thing.id for thing in counted(session.level)[0]] == [f"wave-{n}" for n in range(4)]
    assert any(note.startswith("left out of the sea now") and note.endswith("wave-4") for note in session.notes)
    session.undo()
    assert len(counted(session.level)[0]) == 5


@pytest.mark.parametrize("curvature", [-0.9, 0.0, 0.5, 1.0])
def test_the_gizmo_draws_the_crests_of_the_lead_front(curvature):
    """H08, H09: where its lines are the lead's height is greatest, and they move on with the clock."""
    level, thing = bay(1), wave(curvature=curvature)
    fronts = object_fronts(thing, level.settings.level.seed)
    for t in (0.0, 4.7):
        drawn = [line.points for line in wave_gizmo.lines(level, thing, t)[3:]]
        assert len(drawn) >= 6
        for points in drawn:
            q = front_coordinate(thing, fronts.east[0], fronts.north[0], *map(Dual, points[:, :2].T))[0].v
            height = np.sin(2 * np.pi * (q / thing.length_m - fronts.omega[0] * t / (2 * np.pi)))
            np.testing.assert_allclose(height, 1.0, atol=1e-4)
            assert np.all(np.hypot(points[:, 0] - thing.x, points[:, 1] - thing.y) <= thing.radius_m + 1e-6)


@pytest.mark.parametrize("curvature", [-1.0, -0.3, 0.0, 0.45, 1.0])
def test_a_front_drawn_to_its_own_place_keeps_its_curvature(curvature):
    """H09: the bend's handle is the inverse of the front's shape; past a ring it stays a ring."""
    thing = wave(curvature=curvature)
    at = wave_gizmo.handles(bay(1), thing)["bend"]
    assert wave_gizmo.dragged(bay(1), thing, "bend", *at[:2])["curvature"] == pytest.approx(curvature, abs=2e-3)
    assert wave_gizmo.curvature_through(100.0, -95.0, 50.0) == 1.0
    assert wave_gizmo.curvature_through(100.0, 95.0, -50.0) == -1.0


@pytest.mark.parametrize(
    ("handle", "field", "reads"),
    [("size", "radius_m", wave), ("aim", "yaw_deg", wave), ("bend", "curvature", wave),
     ("size", "radius_m", lambda: SwellRegion(id="wave-1", x=200, y=170)),
     ("aim", "turn_deg", lambda: SwellRegion(id="wave-1", x=200, y=170))],
)  # fmt: skip
def test_dragging_a_handle_changes_one_field_in_one_step(session, tmp_path, handle, field, reads):
    """H08, H09: the handle follows the pointer; the whole drag is one step."""
    session.place(reads().model_copy(update={"yaw_deg": 0.0}) if field != "turn_deg" else reads())
    session.selected, session.tool = "wave-1", SELECT
    grip = Grip(Editor(session, Preferences()))
    before, steps = session.level.objects["wave-1"], len(session.journal.done)
    start = to_screen(session.camera, SIZE, wave_gizmo.handles(session.level, before)[handle][None])[0][0]
    assert grip.press(tuple(start), SIZE, False, False)
    for way in (8, 20, 30):
        assert grip.drag((start[0] + way, start[1] + way), SIZE)
    grip.release()
    after = session.level.objects["wave-1"]
    changed = {name for name in type(after).model_fields if getattr(after, name) != getattr(before, name)}
    assert changed == {field}
    assert len(session.journal.done) == steps + 1
    if handle == "size":
        there = wave_gizmo.handles(session.level, after)[handle]
        assert np.hypot(there[0] - 200, there[1] - 170) == pytest.approx(after.radius_m)
        assert after.radius_m > before.radius_m


@pytest.mark.gl
def test_the_view_counts_the_objects_of_each_hectare(renderer):
    """H08: colours by number as patch_lists counts, white where their weight is whole."""
    from shorewright.renderer import render

    level = bay(1)
    for name, x in (("a", 60.0), ("b", 130.0), ("c", 190.0)):
        level.put_object(name, wave(name, x=x, y=60.0, radius_m=50.0, falloff=0.9))
    above = camera(x=200.0, y=130.0, z=400.0, yaw=0.0, pitch=-90.0, fov=40.0)
    options = {"size": (96, 72), "quality": "low", "renderer": renderer, "linear": True}
    shown = render(level, above, view="wave_objects", **options)
    place = render(level, above, view="position", **options)
    colours = np.array([[0.05, 0.08, 0.14], [0.08, 0.22, 0.45], [0.08, 0.45, 0.40], [0.75, 0.55, 0.15]])
    lists = patch_lists(counted(level)[0])
    x, y = place[..., 0], place[..., 1]
    seen = (x > 60) & (x < 340) & (y > 10) & (y < 92) & (np.abs(x / 100 - np.rint(x / 100)) > 0.08)
    for thing in level.objects.values():
        seen &= np.hypot(x - thing.x, y - thing.y) > thing.radius_m
    counts = np.array([len(lists.get((col, 0), ())) for col in range(4)])[(x[seen] // 100).astype(int)]
    assert set(counts) >= {0, 1, 2}
    np.testing.assert_allclose(shown[seen], colours[counts], atol=0.02)
    middle = np.hypot(x - 60, y - 60) < 4
    assert shown[middle].min() > 0.7
