"""What a window doesn't wait for, in another process or in parts: the same bits as at once (T14)."""

import time

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app.arrival_lender import ArrivalLender
from shorewright.app.shared_maps import bytes_of
from shorewright.level import Journal, Rect
from shorewright.level.arrival import arrival, asked_of
from shorewright.level.arrival_map import resized
from shorewright.level.beach_map import beach_map
from shorewright.level.flow import current
from shorewright.level.shaping_request import shape_request
from shorewright.level.shore import shore_map
from shorewright.level.shore_field import shore_field


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


class OnePart:
    """Lends one part a call, to every third nothing; and nothing beside."""

    calls = 0

    def beside(self, name, key, request):
        return None

    def in_parts(self, name, parts):
        self.calls += 1
        return self.calls % 3 > 0 and next(parts, self) is self


def test_a_field_in_parts_ends_as_at_once():
    """H11, H10: edits that come while a change is being worked out are in the end in field and beach, to the bit."""
    level = make_beach(rows=129, cols=161, slope=0.05)
    beach_map(level)
    level.solver = OnePart()
    had = shore_field(level).packed.copy()
    random = np.random.default_rng(4)
    with np.errstate(divide="raise", invalid="raise", over="raise"):
        for number in range(60):
            if number < 40:
                row, col = random.integers(5, 100, 2).tolist()
                level.layers["height"].array[row : row + 20, col : col + 9] += np.float32(random.choice([-2, 1.5]))
                level.mark("height", Rect(row, col, row + 20, col + 9))
            beach_map(level)
    assert shore_field(level).behind
    while shore_field(level).behind or beach_map(level).revision != shore_field(level).revision:
        beach_map(level)
    field, beach = shore_field(level), beach_map(level)
    assert not np.array_equal(field.packed, had)
    level.derived.clear()
    level.solver = None
    assert beach_map(level).packed.tobytes() == beach.packed.tobytes()
    assert shore_field(level).packed.tobytes() == field.packed.tobytes()


def test_who_needs_the_field_now_gets_it():
    """H11: `now` ends what is being worked out."""
    level = make_beach(rows=129, cols=161, slope=0.05)
    shore_field(level)
    level.solver = OnePart()
    bar(level, 3.0)
    assert shore_field(level).behind
    made = shore_field(level, now=True)
    assert not made.behind
    level.derived.clear()
    assert shore_field(level, now=True).packed.tobytes() == made.packed.tobytes()


def requests(level):
    """One of each kind that a process is asked."""
    asked, seen = [], OnePart()
    seen.beside = lambda name, key, request: asked.append(request())
    level.set("timing.source", "travel_time")
    shore_map(level)
    current(level)
    level.solver = seen
    bar(level)
    level.mark("flow", level.grid.rect)
    shore_field(level, now=True)
    shore_map(level)
    current(level)
    level.solver = None
    made = asked_of(level, 0.0)
    shape = shape_request(level, 10**6, 14.0, (80.0, 60.0), 30.0, 0, 30.0)
    return [*asked, made, made.request, shape]


def arrays(request):
    """What it holds, requests in it included."""
    for value in vars(request).values():
        if isinstance(value, np.ndarray):
            yield value
        elif hasattr(value, "kept"):
            yield from arrays(value)


def test_all_requests_follow_the_protocol():
    """T14: kept, none shares memory with the level or its maps; the room asked for its answer is enough."""
    level = make_beach(rows=129, cols=161, slope=0.05)
    found = requests(level)
    assert [type(one).__name__ for one in found] == [
        "BedRequest", "CurrentRequest", "Asked", "SwellRequest", "ShapeRequest",
    ]  # fmt: skip
    field = shore_field(level)
    owned = [level.height, shore_map(level).packed, field.packed, field.distance_m]
    for request in found:
        kept = request.kept()
        assert not any(np.shares_memory(a, b) for a in arrays(kept) for b in owned)
        assert 0 <= bytes_of(kept.answered()) <= kept.answer_bytes


def test_maps_at_other_samples():
    """T14: a plane stays one, and every second sample of a map is that sample."""
    row, col = np.mgrid[0:9, 0:13].astype(np.float32)
    plane = np.stack([row, 2 * col, row - col], -1)
    assert np.array_equal(resized(plane, (5, 7)), plane[::2, ::2])
    fine = resized(plane, (17, 25))
    assert np.allclose(fine[::2, ::2], plane)
    assert np.allclose(fine[1, :, 0], 0.5)
