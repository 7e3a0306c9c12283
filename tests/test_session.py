"""The session: every edit undoable, recorded, replayable; saved and opened again (T05, T08, T10)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app.invariants import broken
from shorewright.app.session import Session
from shorewright.brushes import BRUSHES
from shorewright.level import BadInput, Grid
from shorewright.level.objects import Camera


def state(session):
    """What a level is, in bytes and values that compare."""
    level = session.level
    layers = {name: data.array.tobytes() for name, data in level.layers.items() if not data.neutral}
    return level.grid, level.height.tobytes(), layers, level.settings, dict(level.objects), dict(level.georeference)


@pytest.fixture
def session(tmp_path):
    with Session(make_beach(), spill_root=tmp_path / "spill") as session:
        yield session
        assert broken(session) == []


EDITS = {
    **{name: lambda s, n=name: s.drag(n, (60, 60), (90, 70, 0.5), (100, 40), size_m=9) for name in BRUSHES},
    "inverted": lambda s: s.drag("raise", (60, 60), (90, 70), invert=True),
    "smoothed": lambda s: s.drag("raise", (60, 60), (90, 70), smooth=True),
    "set": lambda s: s.set("sea.swell_m", 1.25),
    "sea level": lambda s: s.set("level.sea_level_m", -1.5),
    "place": lambda s: s.place({"id": "spot", "kind": "sea_seed", "x": 5.0, "y": 6.0}),
    "resize": lambda s: s.resize(samples=97),
    "crop": lambda s: s.crop(20, 30, 120, 100),
}


@pytest.mark.parametrize("name", EDITS)
def test_undo_and_redo_are_the_way_back_and_forth(session, name):
    """T08: undo after do is identity, redo after undo is identity, for everything a session can do."""
    session.drag("raise", (80, 64), size_m=20)  # something to be resampled, cropped, smoothed
    session.place(Camera(id="old", x=3, y=4))
    before = state(session)
    EDITS[name](session)
    after = state(session)
    assert after != before
    assert broken(session) == []
    assert session.undo()
    assert state(session) == before
    assert broken(session) == []
    assert session.redo()
    assert state(session) == after
    session.undo()
    session.undo()
    session.undo()
    assert session.undo() is None


@pytest.mark.parametrize("name", EDITS)
def test_what_was_done_replays_to_the_same_bytes(session, tmp_path, name):
    """T10: the recorded script makes the same level out of the same beginning."""
    EDITS[name](session)
    session.undo()
    session.redo()
    with Session(make_beach(), spill_root=tmp_path) as other:
        other.run(session.script)
        assert state(other) == state(session)


def test_a_recorded_stroke_holds_its_own_parameters(session, tmp_path):
    """A script doesn't depend on how the brush of whoever replays it is set."""
    session.drag("raise", (60, 60), (90, 70))
    with Session(make_beach(), spill_root=tmp_path) as other:
        other.set_param("size_m", 33, "raise")
        other.run(session.script)
        assert state(other) == state(session)


def test_pointer_and_drag_are_one_engine(session, tmp_path):
    """The window's begin, move, end give the bytes of one `drag` (T10)."""
    session.pick_brush("flatten")
    session.stroke_begin(60, 60)
    session.stroke_move(70, 66)
    session.stroke_move(90, 70, 0.25)
    session.stroke_end()
    with Session(make_beach(), spill_root=tmp_path) as other:
        other.drag("flatten", (60, 60), (70, 66), (90, 70, 0.25))
        assert state(other) == state(session)


def test_abort_leaves_no_trace(session):
    """Esc in mid-stroke: same bytes, nothing to undo, nothing recorded."""
    before = state(session)
    session.stroke_begin(60, 60)
    session.stroke_move(90, 70)
    assert state(session) != before
    session.stroke_abort()
    assert state(session) == before
    assert session.record == []
    assert session.undo() is None
    assert not session.dirty or session.path is None


def test_undo_in_mid_stroke_aborts_it(session):
    session.drag("raise", (30, 30))
    before = state(session)
    session.stroke_begin(60, 60)
    session.stroke_move(90, 70)
    session.undo()
    assert state(session) == before
    assert session.stroke_move(95, 75).empty
    assert session.stroke_end().empty
    assert session.undo() == "Raise"


def test_an_edit_in_mid_stroke_ends_the_stroke_first(session):
    session.stroke_begin(60, 60)
    session.stroke_move(90, 70)
    session.set("sea.swell_m", 2)
    assert [step.label for step in session.journal.done] == ["Raise", "Set sea.swell_m"]
    assert session.stroke is None


def test_a_slider_drag_is_one_step(session):
    """T08: changes merge until the slider is let go; the script keeps the last."""
    first = session.level.settings
    for value in (0.5, 0.6, 0.7):
        session.set("sea.swell_m", value, merge=True)
    session.seal()
    session.set("sea.swell_m", 0.9, merge=True)
    assert len(session.journal.done) == 2
    session.undo()
    assert session.level.settings.sea.swell_m == 0.7
    session.undo()
    assert session.level.settings is first


def test_setting_what_already_is_leaves_no_step(session):
    session.set("sea.swell_m", session.level.settings.sea.swell_m)
    assert not session.journal.done


def test_crop_moves_objects_and_keeps_bits(session):
    """Cells inside are the same bits; an object keeps its place on the land."""
    session.drag("raise", (60, 60), (90, 70))
    session.place(Camera(id="spot", x=50, y=60))
    height = session.level.height.copy()
    session.crop(20, 30, 120, 100)
    assert session.level.grid == Grid(71, 101, 1.0)
    assert np.array_equal(session.level.height, height[30:101, 20:121])
    assert (session.level.objects["spot"].x, session.level.objects["spot"].y) == (30, 30)


def test_time_settings_reach_the_clock(session):
    """T05: the clock follows the level's rate and loop, through undo too."""
    session.set("time.rate", 2)
    session.set_all("Loop", {"time.loop_start_s": 4, "time.loop_end_s": 10})
    assert (session.clock.rate, session.clock.loop) == (2, (4, 10))
    assert session.undo() == "Loop", "both ends are one step"
    assert session.clock.loop is None
    session.redo()
    assert session.script["actions"][-3]["values"] == {"time.loop_start_s": 4.0, "time.loop_end_s": 10.0}
    with pytest.raises(BadInput, match=r"time\.loop_end_s"):
        session.set_all("Loop", {"time.loop_start_s": 5, "time.loop_end_s": -1})
    assert session.clock.loop == (4, 10)
    session.clock.scrub(9.5)
    session.advance(1.0)
    assert session.clock.time_s == pytest.approx(5.5)
    session.undo()
    assert session.clock.loop is None


def test_scripts_run_at_a_paused_moment(session):
    """T05: time, pause and step are words of a script."""
    session.run({"version": 1, "actions": [{"do": "time", "t": 12.5}, {"do": "pause"}, {"do": "step", "steps": 3}]})
    assert session.clock.paused
    assert session.clock.time_s == pytest.approx(12.5 + 3 * session.clock.step_s)


@pytest.mark.parametrize(
    ("action", "told"),
    [
        ({"do": "stroke", "brush": "rase", "points": [[1, 2]]}, "rase"),
        ({"do": "stroke", "brush": "raise", "params": {"sise_m": 3}, "points": [[1, 2]]}, "sise_m"),
        ({"do": "stroke", "brush": "raise", "params": {"size_m": -3}, "points": [[1, 2]]}, "size_m"),
        ({"do": "set", "name": "sea.swel", "value": 1}, "sea.swel"),
        ({"do": "set", "name": "sea.swell_m", "value": 1e9}, "swell_m"),
    ],
)
def test_a_script_is_checked_before_anything_is_done(session, action, told):
    """T10: the action's number, and the level as it was."""
    before = state(session)
    with pytest.raises(BadInput, match="action 2") as caught:
        session.run({"version": 1, "actions": [{"do": "stroke", "brush": "raise", "points": [[60, 60]]}, action]})
    assert told in str(caught.value)
    assert state(session) == before


@pytest.mark.parametrize(
    "call",
    [
        lambda s: s.drag("rase", (1, 2)),
        lambda s: s.drag("raise"),
        lambda s: s.drag("raise", (1, float("nan"))),
        lambda s: s.drag("raise", (1, 2), (3, float("inf"))),
        lambda s: s.drag("raise", (1, 2, 3)),
        lambda s: s.drag("raise", (1, 2), size_m=-1),
        lambda s: s.drag("raise", (1, 2), colour=1),
        lambda s: s.stroke_begin(float("nan"), 2),
        lambda s: s.pick_brush("rase"),
        lambda s: s.set_param("size_m", "wide"),
        lambda s: s.set("sea", 3),
        lambda s: s.set("sea.swell_m", "high"),
        lambda s: s.place({"id": "a"}),
        lambda s: s.place({"id": "a", "kind": "camera", "fov_deg": 500}),
        lambda s: s.remove("nobody"),
        lambda s: s.resize(),
        lambda s: s.resize(samples=1),
        lambda s: s.resize(samples=100_000),
        lambda s: s.resize(cell_m=float("nan")),
        lambda s: s.resize(samples=10, cell_m=1),
        lambda s: s.crop(0, 0, 0, 10),
        lambda s: s.crop(-5, 0, 10, 10),
        lambda s: s.crop(0, 0, 1e9, 10),
        lambda s: s.crop(0, 0, float("nan"), 10),
        lambda s: s.run({"version": 9}),
        lambda s: s.save(),
        lambda s: s.import_height("nowhere.png"),
    ],
)
def test_bad_input_is_one_sentence_and_changes_nothing(session, call):
    """T08, T10: refused, and the level, the undo list and the record are as they were."""
    before = state(session)
    with pytest.raises(BadInput) as caught:
        call(session)
    assert "\n" not in str(caught.value)
    assert state(session) == before
    assert session.stroke is None
    assert not session.journal.done
    assert session.record == []


def test_a_pointer_that_leaves_the_level_is_no_error(session):
    """Strokes go on past the border and may begin there."""
    session.stroke_begin(-50, -50)
    session.stroke_move(float("nan"), 3)
    session.stroke_move(60, 60)
    session.stroke_move(5000, 60)
    assert not session.stroke_end().empty


def test_slider_drags_replay_as_the_steps_they_were(session, tmp_path):
    """T08, T10: two drags of one slider, one with a pause in it, one back to where it began, then undo twice."""
    for values in ((0.5, 0.8), (0.9, 0.8), (1.1, 0.8)):
        for value in values:
            session.set("sea.swell_m", value, merge=True)
            session.toggle_pause()
        session.seal()
    session.undo()
    session.undo()
    with Session(make_beach(), spill_root=tmp_path) as other:
        other.run(session.script)
        assert len(other.journal.done) == len(session.journal.done) == 1
        assert state(other) == state(session)
