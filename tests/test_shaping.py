"""Inverse sculpting: ten drags of crests, and what the bed must not do (T07)."""

import numpy as np
import pytest
from shorewright.level import Grid, Level
from shorewright.level.arrival import period_s, swell
from shorewright.level.shaping import shape_front
from shorewright.level.shaping_lines import crest_near, dragged, phase_at
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
