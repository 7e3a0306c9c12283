"""Inverse sculpting: ten drags of crests, and what the bed must not do (T07)."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shorewright.level import BadInput, Grid, Level
from shorewright.level.arrival import period_s, swell
from shorewright.level.shaping import shape_front
from shorewright.level.shaping_lines import contours, crest_near, crosses_itself, dragged, phase_at
from shorewright.level.shaping_plate import Plate
from shorewright.level.shore import shore_map

T = 14.0


def coast(kind, cell_m=1.0):
    """A beach that rises to the north from 9 m of water; with a bar before it, or a headland in the middle."""
    y, x = np.mgrid[0 : 320 + cell_m : cell_m, 0 : 360 + cell_m : cell_m]
    slope = 0.035
    height = (y - 250.0) * slope
    if kind == "bar":
        height += 1.3 * np.exp(-(((y - 160.0) / 14.0) ** 2))
    if kind == "headland":
        height += 6.0 * np.exp(-(((x - 180.0) / 34.0) ** 2) - ((y - 235.0) / 50.0) ** 2)
    level = Level(Grid(*y.shape, cell_m), height.astype(np.float32))
    for name, value in {"sea.swell_length_m": 90.0, "sea.swell_heading_deg": 0.0, "sea.phase_noise": 0.2}.items():
        level.set(name, value)
    return level


# where it is grabbed, how it is dragged (m), radius, time
DRAGS = {
    "depth": [
        ("beach", (120, 185), (0, 2), 20), ("beach", (200, 190), (1, -8), 30), ("bar", (180, 170), (0, 15), 50),
        ("headland", (215, 165), (10, -12), 50), ("beach", (180, 170), (0, -30), 80),
    ],
    "travel_time": [
        ("beach", (120, 150), (0, 2), 20), ("beach", (200, 170), (0, -6), 50), ("bar", (180, 165), (0, -12), 70),
        ("headland", (230, 150), (6, -10), 70), ("beach", (180, 150), (0, -30), 120),
    ],
}  # fmt: skip


def drag(level, at, by, radius_m):
    wave, crest = crest_near(level, T, at, radius_m)
    grabbed = crest[np.hypot(*(crest - at).T).argmin()]
    line = dragged(crest, grabbed, by, radius_m)
    return wave, grabbed, line, shape_front(level, T, line, radius_m, at=grabbed, wave=wave)


def apply(level, shaped):
    level.write("height", shaped.rect, level.height[shaped.rect.slices] + shaped.change)


@pytest.mark.parametrize(("kind", "at", "by", "radius_m"), DRAGS["depth"])
def test_by_depth(kind, at, by, radius_m):
    """T07: half a cell on 95 % of the line, through the real clock; land, sea, slopes and the rest stay."""
    level = coast(kind)
    before, sea = level.height.copy(), shore_map(level).packed[..., 2].copy()
    wave, grabbed, line, shaped = drag(level, at, by, radius_m)
    phase, _ = phase_at(level, T, *line.T)
    assert np.abs(phase.v - wave).max() > 0.01  # it wasn't there before
    apply(level, shaped)
    phase, _ = phase_at(level, T, *shaped.line.T)
    late = np.maximum(np.abs(phase.v - wave) - 1 / 60 / level.settings.shore.interval_s, 0)  # a frame is no matter
    away_m = late / np.maximum(np.hypot(phase.dx, phase.dy), 1e-4)
    assert np.quantile(away_m, 0.95) < 0.5 * level.grid.cell_m
    check_bed(level, before, sea, grabbed, radius_m)


@pytest.mark.parametrize(("kind", "at", "by", "radius_m"), DRAGS["travel_time"])
def test_by_travel_time(kind, at, by, radius_m):
    """T07: a quarter of a second on 95 % of the line, through the real times of travel."""
    level = coast(kind, 2.0)
    level.set("timing.source", "travel_time")
    before, sea = level.height.copy(), shore_map(level).packed[..., 2].copy()
    wave, grabbed, _, shaped = drag(level, at, by, radius_m)
    apply(level, shaped)
    phase, _ = phase_at(level, T, *shaped.line.T)
    late_s = np.abs(phase.v - wave) * period_s(swell(level, T))[0]
    assert np.quantile(late_s, 0.95) < 0.25
    check_bed(level, before, sea, grabbed, radius_m)


def check_bed(level, before, sea, at, radius_m):
    rows, cols = np.indices(before.shape)
    outside = np.hypot(cols * level.grid.cell_m - at[0], rows * level.grid.cell_m - at[1]) >= radius_m
    assert np.array_equal(level.height[outside], before[outside])
    assert not np.array_equal(level.height, before)
    assert np.array_equal(level.height < level.sea_level_m, before < level.sea_level_m)
    assert np.array_equal(shore_map(level).packed[..., 2], sea)
    steep = [np.hypot(*np.gradient(ground.astype(float), level.grid.cell_m)) for ground in (before, level.height)]
    assert (steep[1] <= np.maximum(np.tan(np.radians(37.0)), 1.1 * steep[0] + 0.02)).all()
    assert np.array_equal(level.height[[0, -1]], before[[0, -1]])


def test_blend():
    """T06, T07: with both clocks mixed the crest comes as near."""
    level = coast("beach", 2.0)
    level.set("timing.source", "blend")
    wave, _, _, shaped = drag(level, (180, 190), (0, -6), 50)
    apply(level, shaped)
    phase, _ = phase_at(level, T, *shaped.line.T)
    assert np.quantile(np.abs(phase.v - wave), 0.95) * period_s(swell(level, T))[0] < 0.25


def test_limits_are_told():
    """T07: a bed that may hardly slope leaves the crest short, and says by how much; the rest is as near as it gets."""
    level = coast("beach")
    wave, crest = crest_near(level, T, (200, 190), 40)
    line = dragged(crest, (200, 190), (0, 14), 40)
    before = level.height.copy()
    shaped = shape_front(level, T, line, 40, wave=wave, slope_deg=3.0)
    assert shaped.forbidden
    assert all(short.why == "slope limit" and "m short: slope limit" in short.text for short in shaped.forbidden)
    short = np.concatenate([np.arange(f.first, f.last + 1) for f in shaped.forbidden])
    assert shaped.left_m[short].max() == pytest.approx(max(f.left_m for f in shaped.forbidden))
    assert shaped.left_m[short].max() < 14
    assert np.array_equal(level.height, before)  # nothing is written by looking


REFUSED = {
    "onto dry land": ({"line": [(150, 255), (200, 262)], "radius_m": 40}, "dry land"),
    "outside the level": ({"line": [(150, 200), (420, 200)], "radius_m": 40}, "leaves the level"),
    "across itself": ({"line": [(150, 180), (190, 190), (190, 180), (150, 190)], "radius_m": 40}, "crosses itself"),
    "no crest near": ({"line": [(150, 30), (190, 30)], "radius_m": 20}, "no crest"),
    "no line": ({"line": [(150, 180)], "radius_m": 40}, "two points or more"),
    "no number": ({"line": [(150, 180), (float("nan"), 180)], "radius_m": 40}, "two points or more"),
    "a point": ({"line": [(150, 180), (150.1, 180)], "radius_m": 40}, "shorter than a cell"),
    "radius": ({"line": [(150, 180), (190, 180)], "radius_m": 1e4}, "radius"),
    "slope": ({"line": [(150, 180), (190, 180)], "radius_m": 40, "slope_deg": 89}, "slope limit"),
    "wave": ({"line": [(150, 180), (190, 180)], "radius_m": 40, "wave": 900}, "no crest"),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_refused(case):
    """T07: one sentence, and nothing changes."""
    level = coast("beach")
    before = level.height.copy()
    options, told = dict(REFUSED[case][0]), REFUSED[case][1]
    with pytest.raises(BadInput, match=told) as error:
        shape_front(level, T, options.pop("line"), options.pop("radius_m"), **options)
    assert "\n" not in str(error.value)
    assert np.array_equal(level.height, before)


def test_no_sea():
    """T07: a level of dry land has no front to shape."""
    level = Level(Grid(80, 90), np.full((80, 90), 3.0, np.float32))
    with pytest.raises(BadInput, match="no sea"):
        shape_front(level, T, [(20, 20), (60, 20)], 30)


def test_plate():
    """T07: the plate meets its demands, is 0 beyond its rim, and bends least: its rows are the spline's values."""
    plate = Plate((100.0, 80.0), 40.0, 40, (300.0, 300.0))
    x, y = np.array([90.0, 100.0, 112.0]), np.array([75.0, 84.0, 80.0])
    wanted = np.array([0.3, -0.2, 0.1])
    bent = plate.meet(plate.rows(x, y), wanted)
    axis_x, axis_y = np.arange(50.0, 151.0), np.arange(30.0, 131.0)
    raised = plate.raised(bent, axis_x, axis_y)
    assert np.allclose(raised[(y - 30).astype(int), (x - 50).astype(int)], wanted, atol=2e-3)
    assert np.allclose(plate.rows(x, y) @ bent.ravel()[plate.free], wanted, atol=2e-3)
    away = np.hypot(axis_x[None] - 100, axis_y[:, None] - 80)
    assert not raised[away >= 40].any()
    assert np.abs(raised[(away > 36) & (away < 40)]).max() < 0.05 * np.abs(raised).max()


def test_contours():
    """T07: the line of a map at a value is one chain on the circle that it is."""
    x = y = np.linspace(-10, 10, 61)
    values = np.hypot(x[None], y[:, None])
    (line,) = contours(values, x, y, 6.0)
    assert np.allclose(np.hypot(*line.T), 6.0, atol=0.02)
    assert len(line) > 100
    values[:, x > 0] = np.nan
    (half,) = contours(values, x, y, 6.0)
    assert half[:, 0].max() < 0.4


@settings(max_examples=25)
@given(st.integers(0, 10_000))
def test_crosses_itself(seed):
    """T07: as the crossings of its pieces say one by one."""
    line = np.random.default_rng(seed).uniform(0, 10, (6, 2))

    def cross(a, b, c, d):
        t, u = np.linalg.solve(np.array([b - a, c - d]).T, c - a)
        return 0 < t < 1 and 0 < u < 1

    wanted = any(cross(*line[i : i + 2], *line[j : j + 2]) for i in range(5) for j in range(i + 2, 5))
    assert crosses_itself(line) == wanted
