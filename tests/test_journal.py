"""The journal (T08): undo after do, redo after undo and abort are identities, on tiles, settings, objects and grids."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shorewright.level import BadInput, Grid, Journal, Level, Rect
from shorewright.level.objects import SeaSeed

ROWS, COLS = 200, 150


def new_level(rows=ROWS, cols=COLS):
    base = np.random.default_rng(rows).normal(size=(rows, cols)).astype(np.float32)
    return Level(Grid(rows, cols), base)


def state(level):
    """All that an undo has to bring back, byte for byte."""
    tiles = {
        name: {tile: data.tile(tile).tobytes() for tile in map(tuple, np.argwhere(data.written).tolist())}
        for name, data in level.layers.items()
    }
    base, live = level.layers["height"].base.tobytes(), level.height.tobytes()
    return level.grid, base, live, tiles, level.settings, dict(level.objects), dict(level.georeference)


# What can be done to a level. A round has one atom or several.

rects = st.builds(
    lambda row, col, rows, cols: Rect(row, col, min(row + rows, ROWS), min(col + cols, COLS)),
    st.integers(0, ROWS - 1),
    st.integers(0, COLS - 1),
    st.integers(1, ROWS),
    st.integers(1, COLS),
)
writes = st.tuples(st.just("write"), st.sampled_from(["height", "snow", "cover"]), rects, st.integers(0, 9))
sets = st.tuples(st.just("set"), st.sampled_from(["sea.swell_m", "shore.range_m"]), st.floats(0.5, 4))
puts = st.tuples(st.just("put"), st.sampled_from(["a", "b"]), st.one_of(st.none(), st.floats(-9, 9)))
deeds = st.one_of(writes, sets, puts)


def write(level, step, layer, rect, seed):
    """Scribble on a rectangle as a stroke does; seed 0 writes what is there already."""
    data = level.layers[layer]
    rect = data.grid.clip(rect)
    step.save(data, rect)
    if seed:
        noise = np.random.default_rng(seed).normal(size=rect.shape + data.shape[2:])
        data.array[rect.slices] += noise.astype(np.float32)
    level.mark(layer, rect)


def do(journal, deed):
    level, (kind, *what) = journal.level, deed
    if kind == "write":
        with journal.step("Write") as step:
            write(level, step, *what)
    elif kind == "set":
        journal.set(*what)
    else:
        name, x = what
        journal.put(name, None if x is None else SeaSeed(id=name, x=x))


@settings(max_examples=40, deadline=None)
@given(st.lists(deeds, min_size=1, max_size=6))
def test_undo_takes_back_each_deed_and_redo_does_it_again(done):
    level = new_level()
    journal = Journal(level)
    states = [state(level)]
    for deed in done:
        steps = len(journal.done)
        do(journal, deed)
        if len(journal.done) > steps:
            states.append(state(level))
        else:
            assert state(level) == states[-1], "what leaves no step changed nothing"
    for before in states[-2::-1]:
        assert journal.undo()
        assert state(level) == before
    assert journal.undo() is None
    for after in states[1:]:
        assert journal.redo()
        assert state(level) == after
    assert journal.redo() is None


@settings(max_examples=25, deadline=None)
@given(st.lists(writes, min_size=1, max_size=5), st.lists(writes, max_size=2))
def test_an_aborted_step_leaves_no_trace(scribbles, earlier):
    level = new_level()
    journal = Journal(level)
    for deed in earlier:
        do(journal, deed)
    before, labels = state(level), [step.label for step in journal.done]
    step = journal.begin("Scribble")
    for _, *what in scribbles:
        write(level, step, *what)
    journal.abort()
    assert state(level) == before
    assert [step.label for step in journal.done] == labels
    assert journal.open is None
    assert journal.commit() is None


def test_a_step_whose_body_fails_is_rolled_back():
    level = new_level()
    journal = Journal(level)
    before = state(level)

    def fails():
        with journal.step("Fails") as step:
            write(level, step, "height", Rect(0, 0, 50, 50), 3)
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fails()
    assert state(level) == before
    with pytest.raises(BadInput):
        journal.set("sea.swell_m", 1e9)
    assert state(level) == before
    assert not journal.done


def test_undo_in_mid_step_aborts_it():
    level = new_level()
    journal = Journal(level)
    before = state(level)
    write(level, journal.begin("Open"), "height", Rect(0, 0, 50, 50), 3)
    assert journal.redo() is None
    assert journal.undo() == "Open"
    assert state(level) == before


def test_a_new_deed_ends_redo():
    journal = Journal(new_level())
    do(journal, ("set", "sea.swell_m", 1.0))
    journal.undo()
    do(journal, ("set", "sea.swell_m", 2.0))
    assert journal.redo() is None
    assert journal.level.settings.sea.swell_m == 2.0


# Slider drags


def test_a_drag_of_a_slider_is_one_step_until_it_is_released():
    level = new_level()
    journal = Journal(level)
    first = level.settings
    for value in (0.6, 0.7, 0.8):
        journal.set("sea.swell_m", value, merge=True)
    journal.seal()
    dragged = level.settings
    for value in (0.9, 1.0):
        journal.set("sea.swell_m", value, merge=True)
    journal.set("shore.range_m", 3.0, merge=True)
    assert [step.label for step in journal.done] == ["Set sea.swell_m", "Set sea.swell_m", "Set shore.range_m"]
    journal.undo()
    journal.undo()
    assert level.settings == dragged
    journal.undo()
    assert level.settings == first
    journal.redo()
    journal.set("sea.swell_m", 3.0, merge=True)
    assert len(journal.done) == 2, "what was undone and done again is not dragged on"
    journal.undo()
    assert level.settings == dragged


# Whole grids


def reset(journal, rows, cols, seed):
    level = journal.level
    with journal.step("Import") as step:
        journal.whole(step)
        base = np.random.default_rng(seed).normal(size=(rows, cols)).astype(np.float32)
        level.reset(Grid(rows, cols, 2.0), base)
        level.georeference = {"epsg": seed}


@settings(max_examples=15, deadline=None)
@given(st.lists(writes, max_size=3), st.lists(writes, max_size=3), st.integers(2, 300), st.integers(2, 300))
def test_a_change_of_grid_undoes_with_the_strokes_around_it(before, after, rows, cols):
    level = new_level()
    journal = Journal(level)
    states = [state(level)]

    def note():
        if len(journal.done) == len(states):
            states.append(state(level))

    for deed in before:
        do(journal, deed)
        note()
    reset(journal, rows, cols, 7)
    note()
    for deed in after:
        if not level.grid.clip(deed[2]).empty:
            do(journal, deed)
            note()
    for expected in states[-2::-1]:
        journal.undo()
        assert state(level) == expected
    for expected in states[1:]:
        journal.redo()
        assert state(level) == expected


@pytest.mark.parametrize("end", ["commit", "abort"])
def test_strokes_and_a_new_grid_in_one_step(end):
    level = new_level()
    journal = Journal(level)
    before = state(level)
    step = journal.begin("Both")
    write(level, step, "height", Rect(0, 0, 140, 140), 2)
    journal.whole(step)
    level.reset(Grid(60, 70), np.zeros((60, 70), np.float32))
    write(level, step, "height", Rect(0, 0, 30, 30), 3)
    if end == "commit":
        journal.commit()
        after = state(level)
        journal.undo()
        assert state(level) == before
        journal.redo()
        assert state(level) == after
        journal.undo()
    else:
        journal.abort()
    assert state(level) == before
