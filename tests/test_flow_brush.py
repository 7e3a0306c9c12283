"""Painting the current (T02): way of the stroke, modes, clicks, coherence."""

import math

import numpy as np
import pytest
from shorewright.brushes import BRUSHES, Stroke
from shorewright.level import Grid, Journal, Level
from shorewright.level.projection import EXACT, divergence, divergence_free
from test_strokes import play, play_again, state


def bay(rows=150, cols=160):
    """Five metres of water south of a straight shore with an island in it."""
    y, x = np.mgrid[:rows, :cols]
    ground = np.where(y > 120, 0.2 * (y - 120.0), -0.15 * (120.0 - y))
    ground = np.where(np.hypot(x - 100, y - 60) < 12, 2.0, np.maximum(ground, -5))
    return Level(Grid(rows, cols), ground.astype(np.float32))


def flow(level, *points, invert=False, smooth=False, journal=None, **params):
    params = {"size_m": 15, "falloff": 0.5, **params}
    brush = BRUSHES["flow"]
    stroke = Stroke(level, journal or Journal(level), brush, brush.with_params(params), invert, smooth)
    play(stroke, points)
    return stroke


def there(level, x, y):
    return level.layers["flow"].array[y, x].tolist()


def arc(turns=0.5, n=60, radius=40):
    return [(70 + radius * math.cos(a), 60 + radius * math.sin(a)) for a in np.linspace(0, turns * math.tau, n)]


def test_the_water_goes_the_way_of_the_stroke():
    """T02: heading from the stroke, speed from the knob, the same all along, and undone in one step."""
    level, journal = bay(), None
    before, journal = state(level), Journal(level)
    flow(level, (30, 30), (90, 30), speed_mps=1.5, journal=journal)
    for x in (30, 45, 60, 90):
        assert there(level, x, 30) == pytest.approx([1.5, 0], abs=1e-5)
    journal.undo()
    assert state(level) == before


def test_a_curve_is_followed():
    level = bay()
    flow(level, *arc(), speed_mps=2)
    for share in (0.2, 0.5, 0.8):
        a = share * math.pi
        x, y = 70 + 40 * math.cos(a), 60 + 40 * math.sin(a)
        east, north = there(level, round(x), round(y))
        assert math.hypot(east, north) == pytest.approx(2, abs=0.05)
        ahead = math.degrees(math.atan2(north, east) - (a + math.pi / 2))
        assert abs((ahead + 180) % 360 - 180) < 25


def test_going_back_turns_the_water():
    level = bay()
    flow(level, (30, 30), (90, 30), (30, 30), speed_mps=1)
    assert there(level, 60, 30)[0] == pytest.approx(-1, abs=0.02)


def test_pressure_is_speed_or_amount():
    """T02: half pressure paints half the speed whole, or the speed at half strength."""
    for pressure, expected in (("speed", 1.0), ("amount", 3.0)):
        level = bay()
        level.write("flow", level.grid.rect, np.float32([4, 0]))
        flow(level, (30, 30, 0.5), (90, 30, 0.5), speed_mps=2, pressure=pressure)
        assert there(level, 60, 30)[0] == pytest.approx(expected, abs=1e-4)


def test_modes():
    level = bay()
    level.write("flow", level.grid.rect, np.float32([1, 0]))
    flow(level, (60, 30), (60, 60), mode="add", speed_mps=0.5)
    assert there(level, 60, 45) == pytest.approx([1, 0.5], abs=1e-5)
    flow(level, (60, 30), (60, 60), mode="add", speed_mps=0.5, invert=True)
    assert there(level, 60, 45) == pytest.approx([1, 0], abs=1e-5)
    flow(level, (60, 30), (60, 60), mode="rotate", angle_deg=90)
    assert there(level, 60, 45) == pytest.approx([0, -1], abs=1e-5)
    flow(level, (60, 30), (60, 60), mode="rotate", angle_deg=90, invert=True)
    assert there(level, 60, 45) == pytest.approx([1, 0], abs=1e-5)
    flow(level, (60, 30), (60, 60), mode="erase", strength=0.5)
    assert there(level, 60, 45) == pytest.approx([0.5, 0], abs=1e-5)
    flow(level, (60, 30), (60, 60), invert=True)  # the contrary of replace
    assert there(level, 60, 45) == [0, 0]


def test_smoothing():
    level = bay()
    level.write(
        "flow", level.grid.rect, np.random.default_rng(1).normal(size=(*level.grid.shape, 2)).astype(np.float32)
    )
    before = level.layers["flow"].array[35:45, 55:65].std()
    flow(level, (60, 40), smooth=True)
    assert level.layers["flow"].array[35:45, 55:65].std() < 0.3 * before


@pytest.mark.parametrize(("heading", "expected"), [((0.6, 0.8), 1), ((-0.6, 0.8), -1)])
def test_comb_runs_along_the_shore(heading, expected):
    """T02: the speed stays, the way becomes that of the straight shore, whichever is nearer."""
    level = bay()
    level.write("flow", level.grid.rect, np.float32(heading))
    flow(level, (30, 112), mode="comb", falloff=0.0)
    east, north = there(level, 30, 112)
    assert math.hypot(east, north) == pytest.approx(1, abs=1e-5)
    assert east * expected > 0.99


def test_clicks():
    """A click paints the way the water runs, a heading where it stands, or goes out from its place."""
    level = bay()
    level.set("flow.shore_mps", 0.0)
    flow(level, (60, 40), heading_deg=90, speed_mps=2)
    assert there(level, 60, 40) == pytest.approx([2, 0], abs=1e-5)
    flow(level, (64, 40), heading_deg=180, speed_mps=1)  # it runs east there now
    assert there(level, 64, 40) == pytest.approx([1, 0], abs=1e-2)
    flow(level, (40, 80), click="away", falloff=0.0)
    assert there(level, 47, 80) == pytest.approx([1, 0], abs=1e-5)
    assert there(level, 40, 73) == pytest.approx([0, -1], abs=1e-5)
    flow(level, (40, 80), click="towards", falloff=0.0)
    assert there(level, 47, 80) == pytest.approx([-1, 0], abs=1e-5)


@pytest.mark.parametrize("params", [{}, {"mode": "comb"}, {"mode": "coherent"}, {"click": "away", "mode": "add"}])
def test_strokes_play_again(params):
    """T02: recorded samples and parameters make the same bytes."""
    levels = [bay(), bay()]
    for level in levels:
        flow(level, *arc(), size_m=20)
    stroke = flow(levels[0], (60, 60), (80, 62, 0.5), size_m=30, **params)
    play_again(levels[1], Journal(levels[1]), stroke)
    assert state(levels[0]) == state(levels[1])


def test_make_coherent():
    """T02: after the release the divergence is below 1 % of the speed per cell, none flows into land, none outside."""
    level = bay()
    flow(level, (40, 60), (140, 64), size_m=30, speed_mps=1.0)
    flow(level, (70, 20), (72, 100), size_m=20, mode="add")
    before = level.layers["flow"].array.copy()
    wet = level.height < 0
    flow(level, (70, 60), (120, 60), size_m=32, mode="coherent", falloff=0.3)
    after = level.layers["flow"].array
    inside = (after != before).any(-1) & wet
    assert inside.sum() > 3000
    speed = np.hypot(after[..., 0], after[..., 1])
    apart = np.abs(divergence(wet, after[..., 0], after[..., 1], 1.0))
    assert (apart[inside] <= 0.01 * np.maximum(speed[inside], 0.05)).all()
    was = np.abs(divergence(wet, before[..., 0], before[..., 1], 1.0))
    assert was[inside].max() > 0.2
    assert not after[~wet & (np.hypot(*(np.mgrid[:150, :160] - np.array([60, 95])[:, None, None])) < 20)].any()


def test_projection_leaves_alone_what_is_coherent():
    """Water that turns about has no divergence and stays; a source becomes still; land keeps none."""
    y, x = np.mgrid[:40, :50] - 20.0
    wet = np.ones(x.shape, bool)
    east, north = divergence_free(wet, -y, x, 1.0)
    np.testing.assert_allclose(east, -y, atol=1e-6)
    np.testing.assert_allclose(north, x, atol=1e-6)
    walled = np.zeros_like(wet)
    walled[5:-5, 5:-5] = True
    east, north = divergence_free(walled, x, y, 1.0)
    assert np.abs(divergence(walled, east, north, 1.0)).max() < 1e-6
    assert np.hypot(east, north)[~walled].max() == 0
    assert np.hypot(east, north).mean() < 0.05 * np.hypot(x, y).mean()


def test_many_cells_go_the_quick_way():
    """T02: away from shores and rim, nine cells of ten and more are below 1 % of the speed."""
    side = math.isqrt(EXACT) + 30
    y, x = np.mgrid[:side, :side]
    wet = np.hypot(x - 60, y - 70) > 20
    speed = np.where(wet, 1 + 0.4 * np.sin(x / 17), 0)
    east, north = divergence_free(wet, speed, 0.2 * speed, 1.0)
    core = np.hypot(x - 60, y - 70) > 26
    core[:6] = core[-6:] = core[:, :6] = core[:, -6:] = False
    apart = np.abs(divergence(wet, east, north, 1.0)) / np.maximum(np.hypot(east, north), 0.05)
    assert (apart[core] < 0.01).mean() > 0.95
    assert (np.abs(divergence(wet, speed, 0.2 * speed, 1.0))[core] / speed[core] < 0.01).mean() < 0.5
