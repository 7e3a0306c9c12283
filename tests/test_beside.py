"""What a release asks of the process beside the window: shore map and current, the same bits as at once (T14)."""

import time

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app.arrival_lender import ArrivalLender
from shorewright.level import Journal
from shorewright.level.arrival import arrival
from shorewright.level.flow import current
from shorewright.level.shore import shore_map


@pytest.fixture(scope="module")
def lender():
    made = ArrivalLender()
    yield made
    made.close()


@pytest.fixture
def level(lender):
    made = make_beach(rows=129, cols=161, slope=0.05)
    lender.forget()
    shore_map(made)
    current(made)
    made.solver = lender
    return made


def bar(level, metres=0.8):
    """A stroke that lifts a bar off the beach."""
    with Journal(level).step("bar") as step:
        rows = slice(40, 48)
        data = level.layers["height"]
        step.save(data, level.grid.rect)
        data.array[rows, 30:130] += np.float32(metres)
        level.mark("height", level.grid.rect)


def waited_for(lender, done):
    end = time.monotonic() + 60
    while not done():
        lender.look()
        assert time.monotonic() < end
        time.sleep(0.01)


def test_the_settled_map(level, lender):
    """T14: till the whole map has come the changed windows stand; then it is that of the level alone."""
    had = shore_map(level)
    bar(level)
    coming = shore_map(level)
    assert coming is had
    assert not coming.whole
    assert lender.busy
    waited_for(lender, lambda: shore_map(level).whole)
    made, seen = shore_map(level), current(level)
    waited_for(lender, lambda: current(level) is not seen or not lender.busy)
    made_current = current(level)
    level.derived.clear()
    level.solver = None
    assert shore_map(level).packed.tobytes() == made.packed.tobytes()
    assert shore_map(level).bottleneck.tobytes() == made.bottleneck.tobytes()
    assert current(level).packed.tobytes() == made_current.packed.tobytes()


def test_what_has_to_be_right_does_not_wait(level):
    """T07, T14: who asks for the map as it is now gets the whole of it at once."""
    bar(level)
    assert shore_map(level, now=True).whole
    assert shore_map(level).whole


def test_times_wait_for_the_settled_map(level, lender):
    """T06, T14: while the shore map is on its way no times over a half-known bed are asked for."""
    level.set("timing.source", "travel_time")
    arrival(level, 0.0)
    waited_for(lender, lambda: (found := arrival(level, 0.0)) is not None and found.settled)
    bar(level)
    assert not arrival(level, 0.0).settled
    waited_for(lender, lambda: arrival(level, 0.0).settled)
    made = arrival(level, 0.0)
    level.derived.clear()
    level.solver = None
    assert arrival(level, 0.0).packed.tobytes() == made.packed.tobytes()
