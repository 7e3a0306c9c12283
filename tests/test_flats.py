"""Fronts over flats, behind bars and among rocks by depth: how fast they go, how foam changes (D03, D04)."""

import heapq

import numpy as np
import pytest
from coasts import make_beach
from scipy import ndimage
from shorewright.app.session import Session
from shorewright.level.arrival import shore_at
from shorewright.level.bottleneck import KEPT, Toll, bottleneck, falling
from shorewright.level.grid import Grid
from shorewright.level.level import Level
from shorewright.level.shore import shore_map
from shorewright.level.timing import passage
from shorewright.level.waves import surface_at

FRAME_S = 1 / 60


def lone_waves(level):
    for name in ("variety", "stagger", "ragged", "sway"):
        level.set(f"shore.{name}", 0.0)
    level.set("sea.on", False)
    level.set("timing.source", "depth")
    return level


def rough_beach(seed, slope=0.04, rough_m=0.8, size_m=8.0, flat_m=0.0, rows=193, cols=97):
    noise = ndimage.gaussian_filter(np.random.default_rng(seed).standard_normal((rows, cols)), size_m / 3)
    north = np.arange(rows)[:, None] - 0.6 * rows
    even = np.where(north < -20, np.minimum(north + flat_m, -20), north) * slope
    return lone_waves(Level(Grid(rows, cols), (even + noise / noise.std() * rough_m).astype(np.float32)))


def followed(level, points=250, frames=90):
    """Changes of line, back and fall in a frame `(frames, points, 3)`, at random places that go with their fronts."""
    interval_s, (east, north) = shore_at(level, 0.0).interval_s, level.grid.extent_m
    at = np.random.default_rng(0).uniform(8, np.array([east, north]) - 8, (8 * points, 2))
    here = passage(level, 0.0, *at.T)
    x, y = at[(here.stands & (here.depth_m < level.settings.shore.range_m) & (here.depth_m > 0.25))][:points].T
    goes, last, changes = np.ones(len(x), bool), None, []
    for frame in range(frames):
        shore = surface_at(level, 3.0 + frame * FRAME_S, x, y).shore
        masks = np.stack([shore.line, shore.back, shore.fall], axis=-1)
        assert masks.min() >= 0
        if last is not None:
            changes.append(np.abs(masks - last)[goes])
        last, here = masks, passage(level, 0.0, x, y)
        goal = here.cycles.v + FRAME_S / interval_s
        for _ in range(40):  # steps of less than a cell up the gradient of its time
            short = goal - here.cycles.v
            steep2 = np.maximum(here.cycles.dx**2 + here.cycles.dy**2, 1e-9)
            by = goes * np.maximum(short, 0) / steep2
            by *= np.minimum(1, 0.8 / np.maximum(by * np.sqrt(steep2), 1e-9))
            x, y = x + here.cycles.dx * by, y + here.cycles.dy * by
            here = passage(level, 0.0, x, y)
            if short[goes].max(initial=0) < 1e-5:
                break
        inside = (x > 3) & (y > 3) & (x < east - 3) & (y < north - 3)
        goes &= inside & here.stands & (goal - here.cycles.v < 1e-3)
    assert goes.sum() > 30
    return np.concatenate(changes)


BEDS = {
    "rough": {},
    "rougher": {"slope": 0.03, "rough_m": 1.2, "size_m": 6.0},
    "flat": {"rough_m": 0.3, "flat_m": 60.0},
}


@pytest.mark.parametrize("bed", BEDS)
def test_foam_of_one_wave_changes_little_in_a_frame_on_rough_beds(bed):
    """D04: where fronts race through gaps and over flats too; before, masks jumped by 0.5 and more there."""
    changes = followed(rough_beach(1, **BEDS[bed]))
    assert changes.max() < 0.08
    assert np.quantile(changes, 0.999) < 0.02


def test_foam_of_one_wave_changes_little_in_a_frame_on_a_real_coast(data_dir):
    """D04: Pyramid Rock."""
    source = data_dir / "coasts" / "pyramidrock_hi.celeris.txt"
    with Session.imported(source, cell_m=(2, 1), rows="north-first") as session:
        assert followed(lone_waves(session.level)).max() < 0.05


def trough(flat_slope):
    """A bar 1 m under water, 110 m of flat behind it, a beach."""
    north = np.arange(257.0)[:, None] - 200
    bed = np.where(north < -130, (north + 130) * 0.04 - 2.5, np.where(north < -20, -2.5, north * 0.125))
    bed = bed + 1.5 * np.exp(-(((north + 130) / 8) ** 2)) + np.zeros((1, 65))
    level = lone_waves(Level(Grid(257, 65), bed.astype(np.float32)))
    level.set("shore.flat_slope", flat_slope)
    return level


def test_a_front_takes_its_time_behind_a_bar():
    """D03: it crosses the trough at the speed of a wave, not all at once; where the beach begins it still breaks."""
    y = np.arange(80.0, 176.0)
    x, slow, fast = np.full_like(y, 32.0), trough(0.0175), trough(0.0)
    took = {level: np.ptp(passage(level, 0.0, x, y).arrival_s) for level in (slow, fast)}
    assert took[fast] < 0.1
    assert took[slow] > 96 / 40
    middle = np.arange(80.0, 110.0)
    assert passage(slow, 0.0, np.full_like(middle, 32.0), middle).speed_mps.max() < 35
    for level in (slow, fast):
        bed = shore_map(level)
        assert np.array_equal(bed.bottleneck > 0, bed.falling > 0)
        assert (bed.falling <= bed.bottleneck).all()
    assert np.array_equal(shore_map(slow).packed[..., 2], shore_map(fast).packed[..., 2])


def test_an_even_beach_pays_no_toll():
    """D03: where the bed falls fast enough the clock is that of the depth, to the bit."""
    level = make_beach(slope=0.06)
    held = shore_map(level).packed.copy()
    level.set("shore.flat_slope", 0.0)
    assert np.array_equal(held, shore_map(level).packed)


@pytest.mark.parametrize("seed", range(3))
def test_the_toll_is_that_of_the_cheapest_way(seed):
    """D03: against a search from the sea outward on ground as rough as it can be; land as without it."""
    depth = np.random.default_rng(seed).normal(2, 2, (23, 31)).astype(np.float32)
    marker = np.full(depth.shape, -np.inf, np.float32)
    marker[0] = depth[0]
    least, toll = bottleneck(marker, depth), Toll(0.03, 5.0)
    best = np.full(depth.shape, -np.inf, np.float32)
    waiting = [(-value, 0, col) for col, value in enumerate(depth[0])]
    heapq.heapify(waiting)
    while waiting:
        value, row, col = heapq.heappop(waiting)
        if -value <= best[row, col]:
            continue
        best[row, col] = -value
        for r in range(max(row - 1, 0), min(row + 2, 23)):
            for c in range(max(col - 1, 0), min(col + 2, 31)):
                way_m, kept = 2.0 * np.hypot(r - row, c - col), KEPT * least[r, c]
                left = min(float(toll.taken(np.array([-value]), kept, way_m)[0]), float(least[r, c]))
                heapq.heappush(waiting, (-left, r, c))
    wet = least > 0
    made = falling(marker, least, 2.0, toll)
    assert made[wet] == pytest.approx(best[wet], abs=2e-3)
    assert np.array_equal(made[~wet], least[~wet])
    assert (made[wet] > 0).all()
