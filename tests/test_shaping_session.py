"""Fronts shaped in a session: one step, no trace after Esc, the same bytes from a script and after a kill (T07)."""

import json

import numpy as np
import pytest
from shorewright.app.actions import ACTIONS
from shorewright.app.invariants import broken
from shorewright.app.recovery_offer import offers
from shorewright.app.script import dumps, parse
from shorewright.app.session import Session
from shorewright.level import BadInput
from test_shaping import coast

PLACE = (180.0, 190.0)


@pytest.fixture
def session():
    with Session(coast("beach")) as made:
        made.scrub(14.0)
        made.set_front("radius_m", 30.0)
        yield made


def drag(session, way_m=-6.0, steps=3, anew=False):
    session.front_begin(*PLACE, anew)
    for n in range(1, steps + 1):
        session.stroke_move(PLACE[0], PLACE[1] + way_m * n / steps)


def test_one_step(session):
    """T07, T08: the bed follows live; release is one step; undo and redo lead to the same bytes."""
    start = session.level.height.copy()
    drag(session)
    live = session.level.height.copy()
    assert session.level.live
    assert not np.array_equal(live, start)
    session.stroke_end()
    end = session.level.height.copy()
    assert [step.label for step in session.journal.done] == ["Shape front"]
    assert np.abs(end - live).max() < 0.25 * np.abs(end - start).max()  # what one saw is what one gets
    assert session.undo() == "Shape front"
    assert np.array_equal(session.level.height, start)
    session.redo()
    assert np.array_equal(session.level.height, end)
    assert broken(session) == []


@pytest.mark.parametrize("by", ["abort", "undo"])
def test_no_trace(session, by):
    """T07: Esc or undo in mid-drag, and nothing has happened."""
    start, done = session.level.height.copy(), len(session.journal.done)
    drag(session)
    assert session.dirty
    ACTIONS[by].run(session)
    assert np.array_equal(session.level.height, start)
    assert session.stroke is None
    assert len(session.journal.done) == done
    assert broken(session) == []


def test_a_click_is_no_step(session):
    """T07: a crest that was held and not moved leaves no step."""
    start = session.level.height.copy()
    session.front_begin(*PLACE)
    session.stroke_end()
    assert not session.journal.done
    assert np.array_equal(session.level.height, start)


def test_a_script_says_the_same(session):
    """T07, T10: the recorded drag gives the same bytes, through JSON too."""
    session.drag("raise", (150, 150), size_m=12)
    drag(session)
    session.stroke_end()
    with Session(coast("beach")) as again:
        again.run(json.loads(dumps(parse(session.script))))
        assert np.array_equal(again.level.height, session.level.height)


def test_drawn_anew(session):
    """T07: with Shift the hand draws where the crest shall be."""
    session.front_begin(*PLACE, anew=True)
    line = np.stack([np.linspace(165, 195, 12), 187 + 2 * np.cos(np.linspace(-1.5, 1.5, 12))], axis=1)
    for point in line:
        session.stroke_move(*point)
    assert session.stroke.shaped is not None
    session.stroke_end()
    assert [step.label for step in session.journal.done] == ["Shape front"]


def test_refused_while_dragging(session):
    """T07: a line on land is refused while the hand is there; what stood before it stays, and can be released."""
    drag(session)
    kept = session.level.height.copy()
    session.stroke_move(PLACE[0], 300.0)
    assert "dry land" in session.stroke.refused
    assert np.array_equal(session.level.height, kept)
    session.stroke_end()
    assert len(session.journal.done) == 1


def test_nothing_to_grab(session):
    """T07: no crest near is one sentence, and no step is open."""
    with pytest.raises(BadInput, match="no crest"):
        session.front_begin(180, 20)
    assert session.journal.open is None
    assert session.stroke is None


def test_by_words(session):
    """T07: `shape_front` takes a line and the moment; a wrong one changes nothing."""
    shaped = session.shape_front([(160, 186), (200, 186)], 35.0, t=14.0)
    assert np.quantile(shaped.left_m, 0.9) < 0.5
    assert [word["do"] for word in session.script["actions"]] == ["time", "shape_front"]
    before = session.level.height.copy()
    for line in ([(160, 290), (200, 290)], [(160, 186)], [("a", 1), (2, 3)]):
        with pytest.raises((BadInput, ValueError)):
            session.shape_front(line, 35.0)
    assert np.array_equal(session.level.height, before)
    assert len(session.journal.done) == 1


def test_after_a_kill(tmp_path):
    """T07, T08: the recovery log holds the step."""
    with Session(coast("beach")) as session:
        session.keep_log(tmp_path)
        session.shape_front([(160, 186), (200, 186)], 35.0, t=14.0)
        session.recovery.settle()
        wanted = session.level.height.copy()
        session.recovery.close(discard=False)
        session.recovery = None
    found = offers(tmp_path)
    assert len(found) == 1
    with Session.recover(found[0]) as again:
        assert np.array_equal(again.level.height, wanted)


def test_larger_circle(session):
    """T07: the keys of the brush's size serve the circle."""
    session.tool = "front"
    ACTIONS["larger"].run(session)
    assert session.front.radius_m > 30
    size = session.params[session.brush].size_m
    ACTIONS["smaller"].run(session)
    assert session.params[session.brush].size_m == size
    with pytest.raises(BadInput):
        session.set_front("radius_m", 0.1)
