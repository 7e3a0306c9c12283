"""Shore waves that break (D34, H23): shape, foam, the way back from under a lip; the shader against the twin."""

import numpy as np
import pytest
from coasts import make_beach
from points import feedback
from shorewright.level.arrival import arrival, shore_at, swell
from shorewright.level.breaking import SPILLS, SURGES, iribarren, overhang_m
from shorewright.level.dual import Dual
from shorewright.level.gerstner import phase_noise
from shorewright.level.grid import Grid
from shorewright.level.level import Level
from shorewright.level.shore import shore_map
from shorewright.level.shore_waves import Travel, lead_arrival, s_cycles
from shorewright.level.waves import sea_at, surface_at

SOURCES = ("depth", "travel_time", "blend")


def breaking_beach(slope=0.08, plunge=1.0, source="depth", rows=257, cols=65, **options):
    """A planar beach without offshore waves or variety: its shore waves alone."""
    level = make_beach(rows=rows, cols=cols, slope=slope, **options)
    settings = {"plunge": plunge, "variety": 0.0, "stagger": 0.0, "ragged": 0.0}
    for name, value in settings.items():
        level.set(f"shore.{name}", value)
    level.set("timing.source", source)
    level.set("sea.swell_heading_deg", 8.0)
    level.set("sea.swell_m", 1.2)
    level.set("sea.chop_m", 0.0)
    level.set("sea.on", False)
    return level


def time_of(level, front_s: float) -> float:
    """When the depth's front stands at `front_s`."""
    shore = level.settings.shore
    return front_s / (1 + shore.runup) * shore.interval_s * shore.count


def cut(level, t, low, high, n=3000):
    """The surface over undeformed points on a line across the beach."""
    return surface_at(level, t, np.full(n, 32.0), np.linspace(low, high, n))


def front_y(level, front_s: float, slope: float) -> float:
    return 128.0 - (1 - front_s) * level.settings.shore.range_m / slope


def test_a_wave_steepens_hangs_over_and_goes_on_as_a_bore():
    """D34: on a slope of 8 % the landward face turns ever steeper; past the break it hangs over, then no more."""
    level = breaking_beach()
    steepest = {}
    for front_s in (0.55, 0.70, 0.75, 0.80, 0.83, 0.97):
        y = front_y(level, front_s, 0.08)
        here = cut(level, time_of(level, front_s), y - 12, y + 12)
        # metres forward per metre of undeformed way, least on the face; below 0 it hangs over
        steepest[front_s] = float((np.diff(here.y) / np.diff(here.before_y)).min())
    assert steepest[0.55] > 0.95
    assert steepest[0.55] > steepest[0.70] > steepest[0.75] > 0.0
    assert steepest[0.80] < -0.3
    assert steepest[0.83] < -0.3
    assert steepest[0.97] > 0.2


@pytest.mark.parametrize(("slope", "hangs"), [(0.025, False), (0.08, True), (0.45, False)])
def test_the_type_follows_from_the_slope(slope, hangs):
    """D34: ξ = tan β / √(H / L₀): only between spilling and surging a crest hangs over; a surge doesn't lean."""
    level = breaking_beach(slope)
    xi = slope * iribarren(level.settings.shore)
    assert (SPILLS[1] < xi < SURGES[0]) == hangs
    most, fold = 0.0, 1.0
    for front_s in np.linspace(0.76, 0.86, 6):
        y = front_y(level, front_s, slope)
        here = cut(level, time_of(level, front_s), y - 2 / slope, y + 1 / slope)
        most = max(most, float((here.y - here.before_y).max()))
        fold = min(fold, float((np.diff(here.y) / np.diff(here.before_y)).min()))
    assert (fold < -0.2) == hangs
    assert most <= overhang_m(level.settings.shore)
    assert most > 0.5 if slope < 0.4 else most < 1e-9


def test_the_lip_is_thrown_ahead_and_comes_down():
    """H23: lateral too: the foremost water of the crest gets ahead of the face and comes down."""
    level = breaking_beach()
    heights, ahead = [], []
    for front_s in (0.785, 0.80, 0.815, 0.83, 0.84):
        y = front_y(level, front_s, 0.08)
        here = cut(level, time_of(level, front_s), y - 6, y + 6)
        shore = level.settings.shore
        lip = int(np.argmin(np.abs(here.before_y - y + 0.5 * shore.width * shore.range_m / 0.08)))
        heights.append(float(here.height_m[lip] - here.height_m[-1]))  # over the water ahead
        ahead.append(float(here.y[lip] - here.before_y[lip]))
    assert np.all(np.diff(heights) < 0)
    assert heights[0] > 0.8
    assert heights[-1] < 0.25
    assert np.all(np.diff(ahead) > -0.05)
    assert ahead[-1] > 1.5


@pytest.mark.parametrize("source", SOURCES)
def test_normals_of_a_breaking_wave_come_from_its_positions(source):
    """H23 H29: analytic normals within 0.5° of differences, lateral shift and all."""
    level = breaking_beach(source=source, rough_m=0.05)
    level.set("shore.variety", 0.5)
    level.set("shore.ragged", 0.7)
    level.set("sea.on", True)
    at = np.random.default_rng(2).uniform((5, 70), (60, 130), (4000, 2)).T
    t, h = time_of(level, 0.81), 1e-5

    def point(x, y):
        sample = surface_at(level, t, x, y)
        return np.stack([sample.x, sample.y, sample.height_m], -1)

    east = point(at[0] + h, at[1]) - point(at[0] - h, at[1])
    north = point(at[0], at[1] + h) - point(at[0], at[1] - h)
    normal = np.cross(east, north)
    area = np.linalg.norm(normal, axis=-1) / (4 * h * h)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    # inside a cell of the bed: across its border the bilinear bed has a crease; where it folds there is no normal
    level.set("shore.plunge", 0.0)
    carried = surface_at(level, t, *at)
    inside = np.all(np.abs(np.stack([carried.x, carried.y]) % 1.0 - 0.5) < 0.48, axis=0) & (area > 0.05)
    level.set("shore.plunge", 1.0)
    here = surface_at(level, t, *at)
    cosine = np.clip((here.normal * normal).sum(-1), -1, 1)[inside]
    assert np.degrees(np.arccos(cosine)).max() < 0.5
    if source == "depth":
        assert (here.normal[inside][:, 2] < 0).any()  # the underside of the lip


@pytest.mark.parametrize("source", SOURCES)
def test_the_world_is_asked_from_above(source):
    """D30 H23: world points come back within a millimetre, also under a lip, where the upper surface answers."""
    level = breaking_beach(source=source)
    level.set("sea.on", True)
    x, y = np.full(1500, 32.0), np.linspace(70, 140, 1500)
    for t in np.linspace(0, 9, 7):
        there = sea_at(level, float(t), x, y)
        assert np.isfinite(there.height_m).all()
        assert np.abs(there.y - y).max() < 1e-3
        assert np.abs(there.x - x).max() < 1e-3
        carried = surface_at(level, float(t), x, np.linspace(60, 140, 1500))
        again = sea_at(level, float(t), carried.x, carried.y)
        # a lip's last decimetres may lie between two places that are asked
        assert np.mean(again.height_m - carried.height_m < -0.02) < 0.004


def test_nothing_is_carried_while_the_knob_is_at_zero():
    """D34: at 0 slope, lip and time of breaking change no bit."""
    level = breaking_beach(plunge=0.0)
    level.set("sea.on", True)
    at = np.random.default_rng(4).uniform(0, 64, 3000), np.random.default_rng(5).uniform(40, 140, 3000)
    plain = surface_at(level, 3.0, *at)
    level.set("shore.lip_m", 4.0)
    level.set("shore.breaking_s", 5.0)
    again = surface_at(level, 3.0, *at)
    assert plain.shore.shift is None
    for name in ("x", "y", "height_m", "normal"):
        assert np.array_equal(getattr(plain, name), getattr(again, name))


def arrival_along(level, y) -> np.ndarray:
    """When crest 0 of the shore waves passes places on the line across the beach, in cycles."""
    x, shore, made = np.full_like(y, 32.0), shore_at(level, 0.0), arrival(level, 0.0)
    s = 1.0 - shore_map(level).at(x, y)["smoothed"] * (1 / shore.range_m)
    nothing = Dual(np.zeros_like(y))
    if made is None:
        return (s * s_cycles(shore)).v
    bend = phase_noise(level.settings.sea, swell(level, 0.0), 0, x, y)
    return lead_arrival(shore, s, nothing, Travel.of(made.at(x, y), bend, 1.0)).v


def test_a_wave_breaks_on_a_bar_comes_to_rest_and_breaks_again():
    """D34: by times of travel foam and lip of one wave stop behind the bar and begin anew, at 30 fps without a jump."""
    level = breaking_beach(0.03, source="travel_time", rows=321)
    north = np.arange(321.0)
    bed = ((north - 230) * 0.03 + 1.6 * np.exp(-(((north - 150) / 14) ** 2)))[:, None] + np.zeros((1, 65))
    settings, level = level.settings, Level(Grid(321, 65, 1.0), bed.astype(np.float32))
    level.set_settings(settings)
    interval_s, y = shore_at(level, 0.0).interval_s, np.linspace(80, 228, 2961)
    cycles = np.maximum.accumulate(arrival_along(level, y))
    behind, samples = np.array([-0.25, -0.1, -0.03, 0.0, 0.03]), []
    for now in np.arange(*cycles[[0, -1]], 1 / 30 / interval_s):
        at = np.interp(now + behind, cycles, y)
        shore = surface_at(level, now * interval_s, np.full_like(at, 32.0), at).shore
        samples.append((at, shore.white, np.hypot(shore.shift[0].v, shore.shift[1].v)))
    at, white, shift = np.moveaxis(np.array(samples), 1, 0)
    assert np.abs(np.diff(white, axis=0)).max() < 0.05
    assert np.abs(np.diff(shift, axis=0)).max() < 0.06
    crest = at[:, 3]
    on_bar, trough, inshore = (white[(crest > low) & (crest < high)].max(axis=1)
                               for low, high in ((140, 156), (176, 186), (212, 224)))  # fmt: skip
    assert on_bar.max() > 0.8
    assert trough.max() < 0.1
    assert inshore.max() > 0.7


@pytest.mark.parametrize("source", ["depth", "travel_time"])
def test_foam_and_shape_of_one_wave_change_little_from_frame_to_frame(source):
    """D34 D04: one wave followed at 30 fps from the outer edge to the swash: its line, back, fall and white water, at
    places that go with it, change by a bounded amount; it is clear before it breaks, white after."""
    level = breaking_beach(source=source)
    interval_s, y = shore_at(level, 0.0).interval_s, np.linspace(66, 140, 1481)
    cycles = np.maximum.accumulate(arrival_along(level, y))
    behind = np.array([-0.9, -0.5, -0.25, -0.1, -0.03, 0.0, 0.03, 0.08])  # in cycles, below 0 seaward
    first, last = np.interp([70.0, 135.0], y, cycles)
    white, masks = [], []
    for now in np.arange(first, last, 1 / 30 / interval_s):
        at = np.interp(now + behind, cycles, y)
        shore = surface_at(level, now * interval_s, np.full_like(at, 32.0), at).shore
        white.append(shore.white)
        masks.append(np.stack([shore.line, shore.back, shore.fall]))
    assert len(white) > 150
    white, masks = np.array(white), np.array(masks)
    assert np.abs(np.diff(white, axis=0)).max() < 0.05
    assert np.abs(np.diff(masks, axis=0)).max() < 0.065
    assert white[:20].max() < 0.05
    assert white.max() > 0.7
    peak = int(white.max(1).argmax())
    assert white[-1].max() < 0.7 * white[peak].max()


def test_times_of_breaking_run_on_through_the_break():
    """D34: seconds since the break grow by as much as the wave takes, before it breaks as after."""
    level = breaking_beach(source="travel_time")
    made, y = arrival(level, 0.0), np.linspace(60.0, 124.0, 400)
    x = np.full_like(y, 32.0)
    breaks, cycles = made.breaks(x, y), made.at(x, y).swells[0].v
    near = np.abs(breaks.since_s.v) < 6.0
    assert near.sum() > 80
    breaks_at = (cycles * made.period_s[0] - breaks.since_s.v)[near]
    assert np.ptp(breaks_at) < 0.25
    assert breaks.shows.v[near].min() > 0.97
    broke = y[np.argmin(np.abs(breaks.since_s.v))]
    high_m = made.at(np.array([32.0]), np.array([broke])).lead_height.v[0] * level.settings.shore.height_m
    assert high_m / ((128 - broke) * 0.08) == pytest.approx(level.settings.timing.breaker, rel=0.15)
    assert breaks.similarity.v[near] == pytest.approx(0.08 * iribarren(shore_at(level, 0.0)), rel=0.25)
    # the gradient is that of the values
    h = 1e-4
    there = (made.breaks(x, y + h).since_s.v - made.breaks(x, y - h).since_s.v) / (2 * h)
    assert breaks.since_s.dy == pytest.approx(there, abs=1e-3)


@pytest.mark.parametrize("breaking_s", [0.8, 2.0])
@pytest.mark.parametrize("source", ["depth", "travel_time"])
def test_a_lip_is_down_after_the_time_of_breaking(source, breaking_s):
    """D34: from where the lip leaves the crest until it is down a wave takes `shore.breaking_s`, in either source."""
    level = breaking_beach(source=source)
    level.set("shore.breaking_s", breaking_s)
    interval_s, y = shore_at(level, 0.0).interval_s, np.linspace(66, 134, 1361)
    cycles = np.maximum.accumulate(arrival_along(level, y))
    times = np.arange(*np.interp([90.0, 130.0], y, cycles), 1 / 30 / interval_s)
    crest = np.interp(times, cycles, y)
    progress = [surface_at(level, now * interval_s, np.array([32.0]), np.array([at])).shore.progress[0]
                for now, at in zip(times, crest, strict=True)]  # fmt: skip
    left, down = np.interp([0.0, 1.0], progress, times) * interval_s
    assert down - left == pytest.approx(breaking_s, rel=0.06)


def test_water_that_never_breaks_knows_of_no_break():
    """D34: over a deep bed no lip is thrown by times of travel."""
    level = breaking_beach(source="travel_time", slope=0.0)
    level.set("level.sea_level_m", 30.0)
    at = np.random.default_rng(3).uniform((5, 70), (60, 130), (500, 2)).T
    assert np.abs(arrival(level, 0.0).breaks(*at).shows.v).max() < 1e-6


@pytest.mark.gl
@pytest.mark.parametrize("source", SOURCES)
@pytest.mark.parametrize("t", [0.0, 7 * 86_400.0])
def test_shader_and_twin_agree_on_waves_that_break(ctx, t, source):
    """D34 H23 D30: 10,000 random points within a millimetre, lateral too, at t = 0 and after a week."""
    level = make_beach(rows=513, cols=769, cell_m=2.0, slope=0.06, rough_m=0.1)
    level.set("timing.source", source)
    for name, value in {"plunge": 1.0, "stagger": 0.4, "runup_variety": 0.7, "runup_by_slope": 0.8}.items():
        level.set(f"shore.{name}", value)
    at = np.random.default_rng(9).uniform((0.0, 0.3), (1.0, 0.55), (10_000, 2)) * np.array(level.grid.extent_m)
    at = at.astype(np.float32)
    got = feedback(ctx, level, t, at)
    want = surface_at(level, t, at[:, 0].astype(np.float64), at[:, 1].astype(np.float64))
    assert np.abs(got[:, 2] - want.height_m).max() < 1e-3
    assert np.abs(got[:, 0] - want.x).max() < 2e-3
    assert np.abs(got[:, 1] - want.y).max() < 2e-3
    assert np.abs(got[:, 4] - want.shore.line).max() < 5e-3
    # the same wave is the nearest: none seems broken because the one before it has
    stale = (got[:, 12] > -1.0) != (want.shore.progress > -1.0)
    assert stale[want.shore.line + want.shore.back + want.shore.fall > 0.02].mean() < 4e-3
    assert np.abs(got[:, 13] - want.shore.white).max() < 1e-2
    assert np.abs(got[:, 11] - want.shore.edge_s).max() < 1e-3
    moved = np.hypot(*(part.v for part in want.shore.shift))
    assert moved.max() > 0.3
    near = np.abs(want.normal[:, 2]) > 0.05
    assert np.abs(got[:, 7] - want.normal[:, 0])[near].max() < 2e-2


@pytest.mark.parametrize("slope", [0.03, 0.08])
def test_the_swash_reaches_as_high_as_the_slope_says(slope):
    """D10 T06: with `shore.runup_by_slope` it turns at Hunt's run-up for this beach, never past the run-up limit."""
    level = breaking_beach(slope, source="travel_time", plunge=0.0)
    made, x = arrival(level, 0.0), np.full(400, 32.0)
    limit_m = level.settings.shore.range_m * level.settings.shore.runup
    runup_m = made.breaks(np.array([32.0]), np.array([128.0])).runup_m.v[0]
    y, times = np.linspace(126.0, 128.0 + limit_m / slope, 400), np.linspace(0, made.period_s[0], 60)
    tops = {}
    for by_slope in (0.0, 1.0):
        level.set("shore.runup_by_slope", by_slope)
        tops[by_slope] = max(float((surface_at(level, t, x, y).shore.edge_s - 1).max()) for t in times)
    limit = level.settings.shore.runup
    assert tops[0.0] == pytest.approx(limit, rel=0.02)
    assert tops[1.0] == pytest.approx(limit * min(runup_m / limit_m, 1.0), rel=0.03)
    assert (tops[1.0] < 0.8 * limit) == (slope < 0.05)
