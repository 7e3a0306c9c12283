"""A front shaped by a process beside the window: the same bits as at once, and nothing waits (T07)."""

import time

import numpy as np
import pytest
from shorewright.app.invariants import broken
from shorewright.app.session import Session
from shorewright.app.shaping_lender import ShapingLender
from shorewright.level import BadInput
from shorewright.level.shaping_request import shape_request
from test_shaping import coast
from test_shaping_session import PLACE


@pytest.fixture(scope="module")
def beside():
    lender = ShapingLender()
    lender.warm()
    yield lender
    lender.close()


@pytest.fixture
def session():
    with Session(coast("beach")) as made:
        made.scrub(14.0)
        made.set_front("radius_m", 30.0)
        yield made


def drag(session, beside, way_m=-6.0):
    held = session.front_begin(*PLACE, False, beside)
    for part in (0.5, 1.0):
        session.stroke_move(PLACE[0], PLACE[1] + way_m * part)
    return held


def until(done):
    for _ in range(6000):
        if done():
            return
        time.sleep(0.01)
    pytest.fail("nothing came")


@pytest.mark.parametrize("source", ["depth", "travel_time"])
def test_the_same_bits(session, beside, source):
    """T07: previews come, the release goes on without a wait, and its step is what a script makes of the word."""
    session.set("timing.source", source)
    start = session.level.height.copy()
    held = drag(session, beside)
    assert np.array_equal(session.level.height, start)  # nothing is worked out in the hand's own process
    until(lambda: session.front_take() is None and held.shaped is not None)
    assert not np.array_equal(session.level.height, start)
    session.front_release()
    assert session.stroke is held
    assert session.level.live  # the last preview stands
    until(lambda: session.front_take() is held)
    assert session.stroke is None
    end = session.level.height.copy()
    assert [step.label for step in session.journal.done[-1:]] == ["Shape front"]
    word = session.record[-1]
    assert session.undo() == "Shape front"
    assert np.array_equal(session.level.height, start)
    session.shape_front(word.line, word.radius_m, t=word.t, at=word.at, wave=word.wave, slope_deg=word.slope_deg)
    assert np.array_equal(session.level.height, end)
    assert broken(session) == []


def test_other_edits_wait(session, beside):
    """T07, T08: whatever is done before the settled bed has come is done after it."""
    drag(session, beside)
    session.front_release()
    session.set("shore.height_m", 1.9)
    assert [step.label for step in session.journal.done] == ["Shape front", "Set shore.height_m"]
    assert broken(session) == []


def test_undo_on_the_way(session, beside):
    """T07, T08: undo before the settled bed has come leaves no trace, and no late answer is taken in."""
    start = session.level.height.copy()
    drag(session, beside)
    session.front_release()
    session.undo()
    time.sleep(0.3)
    assert session.front_take() is None
    assert np.array_equal(session.level.height, start)
    assert session.journal.done == []


def test_an_unmoved_hand(session, beside):
    """T07, T08: press and release make no step."""
    session.front_begin(*PLACE, False, beside)
    session.front_release()
    assert session.stroke is None
    assert session.journal.done == []


def test_what_cannot_be(session, beside):
    """T07: a line onto land is refused in one sentence, the hand goes on, and release leaves the last good bed."""
    held = drag(session, beside)
    until(lambda: session.front_take() is None and held.shaped is not None)
    held._lines[beside.ask(np.array([[0.0, 0.0], [0.0, 0.0]]), True)] = np.zeros((2, 2))
    until(lambda: session.front_take() is None and held.refused)
    assert "line" in held.refused
    session.front_release()
    until(lambda: session.front_take() is held)
    assert len(session.journal.done) == 1


def test_unknown_ground(session):
    """T07: a request without ground about a drag that is not kept says so."""
    from dataclasses import replace

    request = replace(shape_request(session.level, -5, 14.0, PLACE, 30.0, 0, 35.0), height=None)
    with pytest.raises(BadInput, match="not known"):
        request.answered()
