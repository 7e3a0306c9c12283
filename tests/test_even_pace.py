"""Keep the pace even (T07): sculpting that leaves fronts an even speed along their way."""

from itertools import pairwise

import numpy as np
import pytest
from shorewright.app.session import Session
from shorewright.brushes import BRUSHES, Stroke
from shorewright.level import Grid, Journal, Level
from shorewright.level.timing import front_speed_mps

SIDE, SLOPE = 161, 0.03
AT, RADIUS = (80.0, 60.0), 24.0


def bumpy() -> Level:
    """A beach that rises to the north, with bars across and pits along it."""
    y, x = np.mgrid[0:SIDE, 0:SIDE].astype(np.float64)
    bumps = 0.12 * np.sin(2 * np.pi * y / 13.0) * (1 + 0.5 * np.sin(2 * np.pi * x / 29.0))
    level = Level(Grid(SIDE, SIDE), (SLOPE * (y - 125.0) + bumps).astype(np.float32))
    level.set("shore.smooth_m", 0.0)
    level.set("shore.monotone", False)
    return level


def stroke(level, name="raise", points=(AT,), **params) -> Level:
    brush = BRUSHES[name]
    held = Stroke(level, Journal(level), brush, brush.with_params({"size_m": RADIUS, **params}))
    held.begin(*points[0])
    for point in points[1:]:
        held.move(*point)
    held.end()
    return level


def uneven(level: Level) -> float:
    """Spread of the logarithm of the speed along the way of the front, in the inner part of a dab."""
    y = np.arange(AT[1] - 0.4 * RADIUS, AT[1] + 0.4 * RADIUS, 0.5) + 0.25
    speeds = [front_speed_mps(level, 0.0, np.full_like(y, x), y) for x in AT[0] + np.linspace(-6, 6, 7)]
    return float(np.mean([np.std(np.log(np.clip(speed, 0.05, 60.0))) for speed in speeds]))


@pytest.mark.parametrize(
    ("name", "params"),
    [("raise", {"strength": 0.05}), ("lower", {"strength": 0.05}), ("smooth", {"strength": 0.0}),
     ("ramp", {"strength": 0.0})],
)  # fmt: skip
def test_a_stroke_evens_the_speed(name, params):
    """T07: the speed along the way varies less than half as much as it did, and as it does without.

    With little strength: what a brush lifts or digs by itself is left as it is.
    """
    points = [AT] if name != "ramp" else [(AT[0], AT[1] - 12.0), (AT[0], AT[1] + 12.0)]
    was = uneven(bumpy())
    params = {**params, "falloff": 0.5}
    without = uneven(stroke(bumpy(), name, points, **params))
    evened = uneven(stroke(bumpy(), name, points, even_pace=1.0, **params))
    assert evened < 0.5 * was
    assert evened < 0.5 * without


def test_less_of_it_evens_less():
    """T07: the knob."""
    found = [uneven(stroke(bumpy(), strength=0.0, falloff=0.5, even_pace=share)) for share in (0.0, 0.3, 0.9)]
    assert found[0] > found[1] > found[2]


@pytest.mark.parametrize("name", ["raise", "lower", "smooth", "ramp"])
def test_nothing_outside_and_nothing_without(name):
    """T07, T01: no cell outside the footprint changes; with 0 the bytes are those of a brush without it."""
    points = [(60.0, 50.0), (80.0, 60.0), (95.0, 75.0)]
    start = bumpy().height.copy()
    even = stroke(bumpy(), name, points, even_pace=1.0, strength=0.3).height
    plain = stroke(bumpy(), name, points, strength=0.3).height
    zero = stroke(bumpy(), name, points, strength=0.3, even_pace=0.0).height
    assert zero.tobytes() == plain.tobytes()
    assert even.tobytes() != plain.tobytes()
    y, x = np.mgrid[0:SIDE, 0:SIDE]
    away = np.full(x.shape, np.inf)
    for (ax, ay), (bx, by) in pairwise(points):
        part = np.clip(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2), 0, 1)
        away = np.minimum(away, np.hypot(x - ax - part * (bx - ax), y - ay - part * (by - ay)))
    reach = RADIUS if name != "ramp" else 1.5 * RADIUS
    assert np.array_equal(even[away > reach + 1], start[away > reach + 1])
    assert np.abs(even - start).max() < 1.5  # bumps go, nothing heaps up


def test_an_even_bed_stays():
    """T07: where the bed runs evenly already, there is nothing to do."""
    y = np.arange(SIDE, dtype=np.float64)[:, None] + np.zeros(SIDE)
    level = Level(Grid(SIDE, SIDE), (SLOPE * (y - 125.0)).astype(np.float32))
    start = level.height.copy()
    stroke(level, strength=0.0, even_pace=1.0)
    assert np.abs(level.height - start).max() < 1e-4


def test_undo_and_replay():
    """T07, T08: undo is exact, and a script makes the same bytes."""
    with Session(bumpy()) as session:
        start = session.level.height.copy()
        session.set_param("even_pace", 0.8, "raise")
        session.drag("raise", (60, 50), (90, 70), (100, 90), size_m=15, strength=0.5, even_pace=0.8)
        end = session.level.height.copy()
        word = session.record[-1]
        session.undo()
        assert session.level.height.tobytes() == start.tobytes()
        params = session.with_params(word.brush, word.params)
        session.draw(word.brush, params, word.points)
        assert session.level.height.tobytes() == end.tobytes()
