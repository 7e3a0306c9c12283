"""Painting the weather map (T04, Z05): the torus under a stroke, and what each mode does, by closed forms."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shorewright.brushes import BRUSHES, Stroke
from shorewright.level import LAYERS, Grid, Journal, Level, Rect
from shorewright.level.layers import WEATHER_GRID

CELL = WEATHER_GRID.cell_m
SIDE = WEATHER_GRID.rows
HALF = SIDE * CELL / 2
ONE = np.float32(1)


def level():
    return Level(Grid(33, 33), np.zeros((33, 33), np.float32))


def sky(level):
    return level.layers["weather"].array


def paint(level, points, journal=None, name="weather", invert=False, smooth=False, **params):
    brush = BRUSHES[name] if name == "weather" else replace(BRUSHES[name], layer="weather", channels=())
    stroke = Stroke(level, journal or Journal(level), brush, brush.with_params(params), invert, smooth)
    stroke.begin(*points[0])
    for point in points[1:]:
        stroke.move(*point)
    stroke.end()
    return stroke


def strewn(level, seed=3):
    """Some paint all over the map, weights from 0 to 1."""
    level.write("weather", WEATHER_GRID.rect, np.random.default_rng(seed).random((SIDE, SIDE, 6), np.float32))
    return level


# The torus

WAY = [(-2000.0, 1500.0, 1.0), (6000.0, -1000.0, 0.5), (4000.0, 7000.0, 1.0)]


@pytest.mark.parametrize("shift", [(128, 0), (200, 13), (256, 256), (-301, 90), (1024 + 7, -512 - 250)])
@pytest.mark.parametrize(
    ("name", "params"),
    [("weather", {}), ("weather", {"mode": "smooth"}), ("weather", {"mode": "add"}), ("raise", {}), ("smooth", {}),
     ("ramp", {"size_m": 900}), ("flatten", {})],
)  # fmt: skip
def test_a_stroke_over_the_border_is_the_same_stroke_elsewhere(name, params, shift):
    """Check 8 of the research: shifted by whole cells on the torus, bit for bit, over what lay there shifted too."""
    here, there = strewn(level()), level()
    there.write("weather", WEATHER_GRID.rect, np.roll(sky(here), shift, (0, 1)))
    moved = [(x + shift[1] * CELL, y + shift[0] * CELL, p) for x, y, p in WAY]
    before = sky(here).copy()
    options = {"size_m": 3000, "spacing": 0.2, **params}
    paint(here, WAY, name=name, **options)
    paint(there, moved, name=name, **options)
    assert not np.array_equal(sky(here), before)
    assert np.roll(sky(here), shift, (0, 1)).tobytes() == sky(there).tobytes()


@pytest.mark.parametrize("size_m", [500, 9000, 40_000])
def test_what_lies_outside_keeps_its_bits_and_undo_brings_all_back(size_m):
    """Check 8: a stroke over the corner where both borders meet touches no texel beyond its reach."""
    painted = strewn(level())
    before, journal = sky(painted).copy(), Journal(painted)
    paint(painted, [(HALF - 700, HALF + 300)], journal, size_m=size_m, coverage=0.2)
    after = sky(painted).copy()
    rows, cols = np.mgrid[:SIDE, :SIDE] * CELL
    away = [
        np.abs((at - HALF - centre + HALF) % (2 * HALF) - HALF)
        for at, centre in ((rows, HALF + 300), (cols, HALF - 700))
    ]
    outside = np.hypot(*away) > size_m
    assert np.array_equal(after[outside], before[outside])
    inside = np.hypot(*away) < 0.25 * size_m
    assert inside.any()
    assert (after[inside][:, 3:] == 1).all()
    np.testing.assert_allclose(after[inside][:, 0], 0.2, atol=1e-3)
    journal.undo()
    assert sky(painted).tobytes() == before.tobytes()
    journal.redo()
    assert sky(painted).tobytes() == after.tobytes()


def test_a_recorded_stroke_plays_again_to_the_same_bytes():
    """T08: by way of JSON, past the border more than once."""
    first, second = strewn(level()), strewn(level())
    stroke = paint(first, [(30_000, 10), (47_000.123, 900.7, 0.3), (90_000.5, 30_000)], size_m=2500, mode="add")
    params = json.loads(json.dumps(stroke.params.model_dump(mode="json")))
    paint(second, json.loads(json.dumps(stroke.samples)), **params)
    assert sky(first).tobytes() == sky(second).tobytes()


def test_a_hand_far_away_costs_little():
    painted = level()
    stroke = paint(painted, [(0, 0), (1e9, 0), (0, 1e9), (0, 0)], size_m=20_000, spacing=1)
    assert len(stroke.samples) == 4
    assert np.isfinite(sky(painted)).all()


def test_changes_are_told_on_both_sides_of_the_border():
    painted = level()
    at = painted.revision
    paint(painted, [(HALF, 0)], size_m=1000)
    rects = painted.changed_since("weather", at)
    written = np.zeros((SIDE, SIDE), bool)
    for rect in rects:
        written[rect.slices] = True
    assert (written | ~sky(painted).any(axis=2)).all()
    assert written[:, 0].any()
    assert written[:, -1].any()


@settings(max_examples=60, deadline=None)
@given(st.integers(-900, 900), st.integers(-900, 900), st.integers(1, 700), st.integers(1, 700))
def test_laps_hold_every_cell_once(row, col, rows, cols):
    grid, asked = WEATHER_GRID, Rect(row, col, row + rows, col + cols)
    count = np.zeros((rows, cols), int)
    for part, held in grid.laps(asked):
        assert part.shape == held.shape
        assert grid.clip(held) == held
        assert (part.row0 - held.row0) % SIDE == 0
        assert (part.col0 - held.col0) % SIDE == 0
        count[part.shifted(asked).slices] += 1
    assert (count == 1).all()


# What the modes do

MIDDLE = (SIDE // 2, SIDE // 2)


def at_middle(level):
    return sky(level)[MIDDLE].astype(np.float64)


@pytest.mark.parametrize("strength", [1.0, 0.6, 0.25])
def test_set_shows_the_mixture_of_what_was_shown_and_the_target(strength):
    """mix(mix(simulation, value, weight), target, m) for any simulation; soft edges and weights of their own too."""
    painted = strewn(level())
    before = sky(painted).astype(np.float64)
    targets = {"coverage": 0.9, "precipitation": 0.3, "type": 0.1}
    paint(painted, [(0, 0)], size_m=6000, strength=strength, opacity=0.9, **targets)
    mask = level()
    brush = replace(BRUSHES["raise"], layer="weather", channels=("coverage",))
    stroke = Stroke(mask, Journal(mask), brush, brush.with_params({"size_m": 6000, "strength": 1, "falloff": 0.7}))
    stroke.begin(0, 0)
    m = (sky(mask)[..., :1] * strength * 0.9).astype(np.float64)  # the footprint, not yet rounded
    after = sky(painted).astype(np.float64)
    assert m.max() == pytest.approx(0.9 * strength)
    for simulated in (0.0, 0.37, 1.0):
        shown = simulated + (before[..., :3] - simulated) * before[..., 3:]
        expected = shown + (np.array(list(targets.values())) - shown) * m
        now = simulated + (after[..., :3] - simulated) * after[..., 3:]
        np.testing.assert_allclose(now, expected, atol=1.5e-3)


def test_a_value_is_the_target_where_nothing_was_painted():
    """Even where the brush is faint: the weight fades, not the value."""
    painted = level()
    paint(painted, [(0, 0)], size_m=6000, falloff=1, coverage=0.625, precipitation=0.25, type=0.5)
    values = sky(painted)[sky(painted)[..., 3] > 0]
    assert len(values) > 1000
    assert (values[:, :3] == [0.625, 0.25, 0.5]).all()
    assert len(np.unique(values[:, 3])) > 100


@pytest.mark.parametrize("mode", ["set", "add", "erase"])
def test_a_stroke_that_crosses_itself_paints_no_more(mode):
    once, often = strewn(level()), strewn(level())
    paint(once, [(-9000, 0), (9000, 0)], mode=mode, strength=0.5)
    paint(often, [(-9000, 0), (9000, 0), (-9000, 0), (9000, 0)], mode=mode, strength=0.5)
    np.testing.assert_allclose(sky(often), sky(once), atol=1e-3)


@pytest.mark.parametrize("mode", ["set", "add", "erase", "smooth"])
@pytest.mark.parametrize("painted", [("coverage",), ("precipitation",), ("type",), ("coverage", "type"), ()])
def test_a_channel_that_is_not_painted_keeps_value_and_weight(mode, painted):
    """T04: one of them, several, all or none."""
    here, names = strewn(level()), LAYERS["weather"].channels[:3]
    before, journal = sky(here).copy(), Journal(here)
    paint(here, [(0, 0)], journal, mode=mode, **{f"paint_{name}": name in painted for name in names})
    changed = (sky(here) != before).any(axis=(0, 1))
    for number, name in enumerate(names):
        assert changed[number + 3] == (name in painted)
        assert changed[number] <= changed[number + 3]
    assert bool(journal.done) == bool(painted)


@pytest.mark.parametrize(("invert", "sign"), [(False, 1), (True, -1)])
def test_add_moves_what_is_shown_by_a_step(invert, sign):
    """Ctrl takes away; where nothing is painted it starts from what the settings say."""
    painted = level()
    for name, value in (("coverage", 0.4), ("precipitation", 0.0), ("type", 0.9)):
        painted.set(f"weather.{name}", value)
    paint(painted, [(0, 0)], mode="add", step=0.2, strength=0.5, invert=invert)
    expected = np.clip(np.array([0.4, 0.0, 0.9]) + sign * 0.2, 0, 1)
    np.testing.assert_allclose(at_middle(painted), [*expected, 0.5, 0.5, 0.5], atol=1e-3)
    shown = 0.5 * np.array([0.4, 0.0, 0.9]) + 0.5 * expected
    paint(painted, [(0, 0)], mode="add", step=0.2, strength=1.0, invert=invert)
    np.testing.assert_allclose(at_middle(painted), [*np.clip(shown + sign * 0.2, 0, 1), 1, 1, 1], atol=1e-3)


def test_erase_brings_the_simulation_back():
    """The weight fades by 1 − m, the value stays; quite erased is never painted, and Ctrl does it in the mode set."""
    painted = strewn(level())
    before = at_middle(painted)
    paint(painted, [(0, 0)], mode="erase", strength=0.25)
    np.testing.assert_allclose(at_middle(painted), [*before[:3], *(before[3:] * 0.75)], atol=1e-3)
    other = strewn(level())
    paint(painted, [(0, 0)], mode="erase", size_m=20_000)
    paint(other, [(0, 0)], invert=True, size_m=20_000)
    assert not at_middle(painted).any()
    assert not at_middle(other).any()


def test_painting_and_erasing_leaves_what_was_never_painted():
    painted = level()
    paint(painted, [(0, 0)], size_m=3000)
    paint(painted, [(0, 0)], size_m=15_000, mode="erase")
    assert not sky(painted).any()


def test_smooth_keeps_even_paint_and_leaks_no_value():
    """Values of neighbours that aren't painted don't count, however far off they are."""
    even = level()
    even.write("weather", WEATHER_GRID.rect, np.tile(np.float32([0.7, 0.2, 0.6, 0.5, 0.25, 0.75]), (SIDE, SIDE, 1)))
    before = sky(even).copy()
    paint(even, [(0, 0), (5000, 0)], mode="smooth")
    assert np.array_equal(sky(even), before)
    island = level()
    cells = np.zeros((SIDE, SIDE, 6), np.float32)
    cells[..., 0] = 1  # a value without weight: nothing is painted there
    cells[250:262, 250:262] = [0.25, 0.5, 0.75, 1, 1, 1]
    island.write("weather", WEATHER_GRID.rect, cells)
    paint(island, [(0, 0)], mode="smooth", size_m=6000)
    now = sky(island)
    weights = now[..., 3]
    assert 0 < weights[249, 256] < 1
    assert weights[250, 256] < 1
    assert weights.sum() == pytest.approx(144, rel=0.1)  # but for the brush fading off
    spread = weights > 0.01
    np.testing.assert_allclose(now[spread][:, :3], np.tile([0.25, 0.5, 0.75], (spread.sum(), 1)), atol=3e-3)


def test_smooth_meets_in_the_middle_by_weight():
    """Between two skies the value goes over without a step, and what is shown keeps its mean."""
    painted = level()
    cells = np.ones((SIDE, SIDE, 6), np.float32)
    cells[:, 256:, 0] = 0
    painted.write("weather", WEATHER_GRID.rect, cells)
    for _ in range(3):
        paint(painted, [(0, -8000), (0, 8000)], mode="smooth", size_m=8000)
    line = sky(painted)[256, :, 0].astype(np.float64)
    assert (np.diff(line[200:312]) <= 1e-3).all()
    assert np.abs(np.diff(line[200:312])).max() < 0.3
    assert line[200:312].mean() == pytest.approx(0.5, abs=0.01)
    assert np.array_equal(sky(painted)[..., 3], cells[..., 3])


def test_shift_smooths_the_weather_whatever_the_mode():
    """The same as the mode smooth, on the layer weather alone."""
    one, other = strewn(level()), strewn(level())
    journal = Journal(one)
    paint(one, [(0, 0), (3000, 0)], journal, smooth=True, mode="erase", strength=0.7)
    paint(other, [(0, 0), (3000, 0)], mode="smooth", strength=0.7)
    assert sky(one).tobytes() == sky(other).tobytes()
    assert [step.label for step in journal.done] == ["Smooth weather"]
    assert one.layers["height"].neutral


def test_history_names_what_was_done():
    painted = strewn(level())
    journal = Journal(painted)
    for mode in ("set", "add", "erase"):
        for invert in (False, True):
            paint(painted, [(0, 0)], journal, mode=mode, invert=invert, strength=0.5)
    assert [step.label for step in journal.done] == [
        "Paint weather", "Erase weather", "More weather", "Less weather", "Erase weather", "Paint weather",
    ]  # fmt: skip
