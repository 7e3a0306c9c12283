"""Strokes: begin, move, end, abort, undo, replay, bad input (T01, T08)."""

import json
import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shorewright.brushes import BRUSHES, Stroke
from shorewright.level import BadInput, Grid, Journal, Level

POINTS = [(40, 52, 1.0), (90, 100, 0.4), (200, 60, 0.9), (150.5, 180.25, 1.0)]
FREE = [name for name, brush in BRUSHES.items() if not brush.effect.layer]  # these work on any layer
MODES = {"plain": {}, "ctrl": {"invert": True}, "shift": {"smooth": True}}


def rough_level(rows=260, cols=240, seed=2):
    y, x = np.mgrid[:rows, :cols]
    noise = np.random.default_rng(seed).normal(size=(rows, cols))
    return Level(Grid(rows, cols), (noise + y * 0.06 - 5 - x * 0.01).astype(np.float32))


def start(level, name, journal=None, invert=False, smooth=False, **params):
    brush = replace(BRUSHES[name], layer="height", channels=())  # every effect on the layer that is looked at here
    return Stroke(level, journal or Journal(level), brush, brush.with_params(params), invert, smooth)


def play(stroke, points=POINTS):
    stroke.begin(*points[0])
    for point in points[1:]:
        stroke.move(*point)
    return stroke.end()


def play_again(level, journal, stroke):
    """What a script does: the samples and parameters a stroke recorded, by way of JSON."""
    values = json.loads(json.dumps(stroke.params.model_dump(mode="json")))
    params = stroke.brush.with_params(values)
    again = Stroke(level, journal, stroke.brush, params, stroke.invert, stroke.smooth)
    return play(again, json.loads(json.dumps(stroke.samples)))


def state(level):
    """Everything a save would hold, as bytes."""
    return {
        name: (data.array.tobytes(), data.written.tobytes(), data.sculpt.tobytes() if name == "height" else b"")
        for name, data in level.layers.items()
        if not data.neutral or name == "height"
    }


every_stroke = pytest.mark.parametrize(
    ("name", "mode"), [(name, mode) for name in FREE for mode in MODES], ids=lambda part: part
)


@every_stroke
def test_undo_and_redo_give_the_same_bytes(name, mode):
    """T08: undo of a stroke over an earlier stroke, and redo."""
    level = rough_level()
    journal = Journal(level)
    before = [state(level)]
    for shift in (0, 7):
        play(start(level, name, journal, size_m=22, **MODES[mode]), [(x + shift, y, p) for x, y, p in POINTS])
        before.append(state(level))
    assert before[0] != before[1] != before[2]
    assert len(journal.done) == 2
    journal.undo()
    assert state(level) == before[1]
    journal.undo()
    assert state(level) == before[0]
    journal.redo()
    journal.redo()
    assert state(level) == before[2]


@every_stroke
def test_an_aborted_stroke_leaves_no_trace(name, mode):
    level = rough_level()
    journal = Journal(level)
    play(start(level, "raise", journal))
    before = state(level)
    stroke = start(level, name, journal, size_m=40, **MODES[mode])
    stroke.begin(*POINTS[0])
    stroke.move(*POINTS[1])
    assert state(level) != before
    stroke.abort()
    assert state(level) == before
    assert len(journal.done) == 1
    assert stroke.move(*POINTS[2]).empty
    assert stroke.end().empty
    assert state(level) == before


@every_stroke
def test_a_recorded_stroke_replays_to_the_same_bytes(name, mode):
    """T08: through JSON and on another level object, whatever was painted before."""
    one, other = rough_level(), rough_level()
    stroke = start(one, name, size_m=33.3, **MODES[mode])
    play(stroke)
    journal = Journal(other)
    play_again(other, journal, stroke)
    assert state(other) == state(one)
    assert state(one) != state(rough_level())
    journal.undo()
    play_again(other, journal, stroke)
    assert state(other) == state(one)


@every_stroke
def test_the_cells_returned_and_marked_hold_every_change(name, mode):
    """Uploads follow marks: nothing changes outside, and the marks don't grow to the whole level."""
    level = rough_level(700, 600)
    level.layers["height"].array  # noqa: B018 - from here on the live array exists
    before, revision = level.height.copy(), level.revision
    stroke = start(level, name, size_m=12, **MODES[mode])
    stroke.begin(40, 52)
    for point in [(60, 60), (120, 90), (90, 140)]:
        shown = level.height.copy()
        rect = stroke.move(*point)
        shown[rect.slices] = level.height[rect.slices]
        assert np.array_equal(shown, level.height)
    rect = stroke.end()
    changed = np.argwhere(level.height != before)
    assert len(changed)
    assert (changed >= rect[:2]).all()
    assert (changed < rect[2:]).all()
    marked = np.zeros(level.grid.shape, bool)
    for rect in level.changed_since("height", revision):
        marked[rect.slices] = True
    assert marked[tuple(changed.T)].all()
    assert marked.mean() < 0.2


def test_labels_say_what_was_done():
    level = rough_level()
    journal = Journal(level)
    for name in FREE:
        for options in MODES.values():
            play(start(level, name, journal, **options))
    labels = [step.label for step in journal.done]
    assert labels[:3] == ["Raise", "Lower", "Smooth"]
    assert labels[3:6] == ["Lower", "Raise", "Smooth"]
    assert labels[12:15] == ["Ramp", "Cut ramp", "Smooth"]


def test_a_click_is_enough():
    for name in ("raise", "lower", "smooth", "flatten"):
        level = rough_level()
        before = level.height.copy()
        stroke = start(level, name, size_m=9)
        assert not stroke.begin(100, 100).empty
        assert not np.array_equal(level.height, before), "the first dab is there before the release"
        stroke.end()
        assert not np.array_equal(level.height, before)


@pytest.mark.parametrize("place", [(100.5, 99.5), (100.1, 99.8), (100.3, 100.4)])
@pytest.mark.parametrize("name", ["raise", "lower", "smooth", "flatten"])
def test_a_radius_below_a_cell_changes_the_nearest(name, place):
    level = rough_level()
    before = level.height.copy()
    play(start(level, name, size_m=0.05, invert=name == "flatten"), [place])
    changed = np.argwhere(level.height != before)
    assert 1 <= len(changed) <= 9
    assert [round(place[1]), round(place[0])] in changed.tolist() or place == (100.5, 99.5)


@pytest.mark.parametrize("name", FREE)
def test_a_brush_larger_than_the_level(name):
    level = rough_level(150, 140)
    before = level.height.copy()
    journal = Journal(level)
    play(start(level, name, journal, size_m=5000), [(20, 20), (110, 130)])
    assert (level.height != before).mean() > 0.9
    assert np.isfinite(level.height).all()
    journal.undo()
    assert np.array_equal(level.height, before)


@pytest.mark.parametrize("name", FREE)
@pytest.mark.parametrize("invert", [False, True])
def test_strength_or_opacity_zero_is_no_step(name, invert):
    for nothing in ({"strength": 0}, {"opacity": 0}):
        level = rough_level()
        journal = Journal(level)
        before = level.height.tobytes()
        assert play(start(level, name, journal, invert=invert, **nothing)).empty
        assert level.height.tobytes() == before
        assert not journal.done
        assert level.layers["height"].neutral, "tiles that were not changed don't count as written"


@pytest.mark.parametrize("name", FREE)
def test_the_brush_works_past_the_border(name):
    """A pointer outside the map still reaches in (complaint: brushes that stop at the border)."""
    level = rough_level()
    before = level.height.copy()
    play(start(level, name, size_m=30), [(-10, 40), (-12, 140), (-400, -900), (1e8, 300), (250, 150)])
    changed = level.height != before
    assert changed.any()
    assert np.isfinite(level.height).all()
    far = rough_level()
    play(start(far, name, size_m=30), [(-100, 40), (-100, 90)])
    assert np.array_equal(far.height, before)


@pytest.mark.parametrize(
    ("place", "bad"), [*product(range(3), (math.nan, math.inf, -math.inf)), (0, 1e300), (1, -1e10)]
)
def test_samples_that_are_no_numbers(place, bad):
    sample = [100.0, 100.0, 1.0]
    sample[place] = bad
    level = rough_level()
    journal = Journal(level)
    stroke = start(level, "raise", journal)
    with pytest.raises(BadInput, match="finite"):
        stroke.begin(*sample)
    assert journal.open is None
    stroke.begin(50, 50)
    before = level.height.tobytes()
    assert stroke.move(*sample).empty
    assert level.height.tobytes() == before
    assert len(stroke.samples) == 1


def test_pressure_is_held_to_0_and_1():
    heights = []
    for pressures in [(7, -3), (1, 0)]:
        level = rough_level()
        play(start(level, "raise"), [(50, 50, pressures[0]), (120, 90, pressures[1])])
        heights.append(level.height.tobytes())
    assert heights[0] == heights[1]


@settings(max_examples=25, deadline=None)
@given(
    st.sampled_from(sorted(FREE)),
    st.lists(
        st.tuples(st.floats(-60, 200), st.floats(-60, 200), st.floats(-1, 2)),
        min_size=1,
        max_size=6,
    ),
    st.floats(0.02, 80),
    st.floats(0, 1),
    st.sampled_from(sorted(MODES)),
)
def test_any_stroke_undoes_and_replays(name, points, size_m, falloff, mode):
    level = rough_level(140, 150)
    journal = Journal(level)
    before = state(level)
    stroke = start(level, name, journal, size_m=size_m, falloff=falloff, **MODES[mode])
    play(stroke, points)
    after = state(level)
    assert np.isfinite(level.height).all()
    if journal.done:
        journal.undo()
    assert state(level) == before
    play_again(level, journal, stroke)
    assert state(level) == after


def test_pressure_that_rises_over_no_way_at_all_is_finite():
    level = rough_level()
    play(start(level, "raise", size_m=9), [(0, 0, 0.0), (1e-45, 0, 1.0)])
    assert np.isfinite(level.height).all()
