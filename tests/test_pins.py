"""Pins: a crest is here at this moment (T07)."""

import numpy as np
import pytest
from coasts import make_beach
from points import feedback
from shorewright.app import placing
from shorewright.app.session import Session
from shorewright.level import BadInput
from shorewright.level.objects import Pin
from shorewright.level.pins import bent, check_pins, pins
from shorewright.level.shaping import shape_front
from shorewright.level.shaping_lines import phase_at
from shorewright.level.timing import passage
from shorewright.level.waves import surface_at

PLACES = [(60.0, 25.0, 4.0), (110.0, 30.0, 6.0), (30.0, 40.0, 5.5)]


def beach(source="depth", count=0):
    level = make_beach(sway=0.2)
    level.set("timing.source", source)
    for n, (x, y, time_s) in enumerate(PLACES[:count]):
        level.put_object(f"pin-{n}", Pin(id=f"pin-{n}", x=x, y=y, time_s=time_s))
    return level


def away(phase):
    return np.abs(phase - np.rint(phase))


@pytest.mark.parametrize("source", ["depth", "travel_time", "blend"])
@pytest.mark.parametrize("count", [1, 3])
def test_a_crest_is_there_then(source, count):
    """T07: at each pin a crest passes at its moment; without pins it didn't."""
    level, bare = beach(source, count), beach(source)
    for x, y, time_s in PLACES[:count]:
        assert away(phase_at(level, time_s, x, y)[0].v) < 1e-6
        assert away(phase_at(bare, time_s, x, y)[0].v) > 1e-3


@pytest.mark.parametrize("source", ["depth", "travel_time", "blend"])
def test_the_timing_knows_of_pins(source):
    """T06, T07: what is read as the moment of a crest is the moment that was pinned."""
    level = beach(source, 3)
    for x, y, time_s in PLACES:
        found = passage(level, time_s, [x], [y])
        assert away(time_s / found.period_s - found.cycles.v[0]) < 1e-6


def test_one_pin_shifts_all():
    """T07: the whole sea is that of another moment."""
    level, bare = beach(count=1), beach()
    for one in (level, bare):
        one.set("sea.on", False)
    shift_s = pins(level, 0.0).shift * level.settings.shore.interval_s
    x, y = np.meshgrid(np.linspace(5, 150, 40), np.linspace(5, 100, 40))
    pinned, other = (surface_at(*which, x, y, True) for which in ((level, 20.0), (bare, 20.0 - shift_s)))
    assert np.abs(pinned.shore.line - other.shore.line).max() < 1e-6
    assert pinned.shore.line.max() > 0.5


def test_without_pins_nothing_changes():
    """T07: no pin, not a bit."""
    level = beach()
    assert pins(level, 3.0) is None
    level.put_object("pin", Pin(id="pin", x=60, y=25, time_s=4.0))
    level.put_object("pin", None)
    x = np.linspace(0, 100, 200)
    assert np.array_equal(surface_at(level, 3.0, x, x).height_m, surface_at(beach(), 3.0, x, x).height_m)


def test_gradient():
    """T07: the correction's gradient is that of its values."""
    found = bent(np.array([(10.0, 10.0), (40.0, 20.0), (25.0, 50.0)]), np.array([0.1, 0.9, 0.3]))
    x, y, step = np.array([12.0, 30.0]), np.array([15.0, 33.0]), 1e-5
    got = found.at(x, y)
    assert np.allclose(got.dx, (found.at(x + step, y).v - found.at(x - step, y).v) / (2 * step), atol=1e-7)
    assert np.allclose(got.dy, (found.at(x, y + step).v - found.at(x, y - step).v) / (2 * step), atol=1e-7)
    assert found.at(1e5, 1e5).v == pytest.approx(found.shift)


def test_order_of_crests_is_kept():
    """T07: pins that ask for the impossible are refused in one sentence; the level is as it was."""
    with Session(beach(count=1)) as session:
        x, y, time_s = PLACES[0]
        near = {"kind": "pin", "id": "near", "x": x + 2.0, "y": y, "time_s": time_s + 4.5}
        with pytest.raises(BadInput, match="order"):
            session.place(near)
        assert "near" not in session.level.objects
        assert not session.journal.done
        session.place(near | {"x": x + 80.0, "time_s": time_s + 0.5})
        with pytest.raises(BadInput, match="at most 8"):
            check_pins(session.level, [Pin(id=f"p{n}") for n in range(9)])


def test_placed_at_the_clocks_moment():
    """T07: dropped at a paused moment, the wave comes there now; undo takes it back."""
    with Session(beach()) as session:
        session.scrub(7.3)
        name = placing.put(session, "pin", (70.0, 30.0, 0.0))
        assert session.level.objects[name].time_s == pytest.approx(7.3)
        assert away(phase_at(session.level, 7.3, 70.0, 30.0)[0].v) < 1e-6
        session.undo()
        assert not session.level.objects


def test_pins_and_shaping():
    """T07: a front is shaped in the sea that the pins make."""
    level = beach(count=1)
    line = np.stack([np.linspace(90, 130, 20), 32 + 2 * np.sin(np.linspace(0, 3.1, 20))], axis=1)
    shaped = shape_front(level, 9.0, line, 40)
    level.write("height", shaped.rect, level.height[shaped.rect.slices] + shaped.change)
    inner = np.hypot(*(shaped.line - shaped.line[len(shaped.line) // 2]).T) < 15
    phase, _ = phase_at(level, 9.0, *shaped.line[inner].T)
    assert np.abs(phase.v - shaped.wave).max() < 0.02


@pytest.mark.gl
@pytest.mark.parametrize("source", ["depth", "travel_time", "blend"])
def test_shader_and_twin_agree(ctx, source):
    """T07, D30: with three pins within a millimetre."""
    level = beach(source, 3)
    at = np.random.default_rng(4).uniform(-0.05, 1.05, (4000, 2)) * np.array(level.grid.extent_m)
    at = at.astype(np.float32)
    got = feedback(ctx, level, 31.0, at)
    want = surface_at(level, 31.0, at[:, 0].astype(np.float64), at[:, 1].astype(np.float64))
    assert np.abs(got[:, 2] - want.height_m).max() < 1e-3
    assert np.abs(got[:, 4] - want.shore.line).max() < 5e-3
    bare = beach(source)
    assert np.abs(surface_at(bare, 31.0, *at.T.astype(np.float64)).shore.line - want.shore.line).max() > 0.1
