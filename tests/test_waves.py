"""The sea on the CPU: clock, masks, groups, normals; the shader against it (D03 D04 D10 D11 D30 H05 H06 H28 to H30).

Rows by id: D03 D04 D10 D11 D30 D31 H05 H06 H28 H29 H30.
"""

import numpy as np
import pytest
from coasts import make_beach
from points import feedback
from shorewright.level import BadInput
from shorewright.level.gerstner import AXIS_CLEARANCE_DEG, groups
from shorewright.level.shore_waves import front_speed_mps
from shorewright.level.waves import sea_at, surface_at

DAYS = 7 * 86_400.0


def deep_level(**sea):
    """Twenty metres of water everywhere."""
    level = make_beach(slope=0.0)
    level.write("height", level.grid.rect, -20.0)
    for name, value in sea.items():
        level.set(f"sea.{name}", value)
    return level


def along(level, y, t, x=80.0):
    return sea_at(level, t, np.full_like(y, x), y)


def test_front_stands_on_its_depth_contour():
    """D03: on a planar beach the landward flank of the line is centred on f, at every moment."""
    level = make_beach(rows=257, slope=0.04)
    shore = level.settings.shore
    y = np.linspace(4, 250, 20_000)
    for t in np.linspace(0, shore.interval_s, 7):
        sample = along(level, y, t)
        s = 1 - sample.clock_depth_m / shore.range_m
        for k in range(shore.count):
            f = ((t / shore.interval_s + k) / shore.count) % 1 * (1 + shore.runup)
            if not 0.35 < f < 0.95:
                continue
            near = np.abs(s - f) < 0.01
            assert np.allclose(sample.shore.b[near].mean(), 0.5, atol=0.06)


@pytest.mark.parametrize("mask", ["line", "back", "fall"])
def test_masks_are_never_negative_and_travel_landward(mask):
    """D03, D04: every mask stays in 0 … 1 and its centre moves towards land."""
    level = make_beach(rows=257, slope=0.04)
    level.set("shore.count", 1)
    level.set("shore.interval_s", 20.0)
    y = np.linspace(4, 250, 4000)
    centres = []
    for t in (8.0, 10.0, 12.0, 14.0):
        values = getattr(along(level, y, t).shore, mask)
        assert values.min() >= 0
        assert values.max() <= 1
        assert values.max() > 0.5
        centres.append(np.average(y, weights=values))
    assert np.all(np.diff(centres) > 1.0)


@pytest.mark.parametrize(("sway", "slide"), [(0.0, True), (0.0, False), (0.35, True)])
def test_water_runs_up_and_back_by_the_set_run_up(sway, slide):
    """D10 H20: over one period the water's edge moves by the run-up ± 10 %, the line arrives with it."""
    level = make_beach(rows=257, slope=0.05, sway=sway)
    level.set("shore.slide", slide)
    shore = level.settings.shore
    y = np.linspace(100, 200, 8000)
    bed = (y - 128.0) * 0.05
    times = np.linspace(0, shore.interval_s, 180, endpoint=False)
    edges, fronts = [], []
    for t in times:
        sample = along(level, y, t)
        edges.append(bed[sample.height_m > bed].max())
        landmost = y[sample.shore.line > 0.1]
        fronts.append((landmost.max() - 128.0) * 0.05 if landmost.size else np.nan)
    rise = max(edges) - min(edges)
    assert rise == pytest.approx(shore.range_m * shore.runup, rel=0.1)
    apart = abs(times[int(np.nanargmax(fronts))] - times[int(np.argmax(edges))]) / shore.interval_s
    assert min(apart, 1 - apart) <= 0.1


def test_single_waves_reach_differently_far_and_without_a_jump():
    """D10 L06: every wave turns at or below the run-up limit, where its own noise says, and time has no seam."""
    level = make_beach(rows=257, slope=0.05)
    level.set("shore.runup_variety", 0.6)
    shore = level.settings.shore
    y = np.full(400, 128.0 + 0.3 * shore.range_m * shore.runup / 0.05)
    x = np.linspace(5, 155, 400)
    limit = 1 + shore.runup
    reached = []
    for k in range(6):
        times = (k + np.linspace(0, 1, 60)) * shore.interval_s
        reached.append(np.max([sea_at(level, t, x, y).shore.edge_s for t in times], axis=0))
    reached = np.array(reached)
    assert reached.max() <= limit + 1e-9
    assert reached.min() >= 1 + 0.39 * shore.runup - 1e-9
    assert np.ptp(reached, axis=0).max() > 0.2 * shore.runup  # one place, several waves
    assert np.ptp(reached, axis=1).max() > 0.2 * shore.runup  # one wave, several places
    arrival = shore.count / limit * shore.interval_s
    for t in arrival + shore.interval_s * np.arange(7):
        before, after = (sea_at(level, t + step, x, y).shore.edge_s for step in (-1e-4, 1e-4))
        assert np.abs(after - before).max() < 1e-4


@pytest.mark.parametrize("sway", [0.0, 0.35])
def test_without_vertex_animation_the_edge_stands_still_while_masks_travel(sway):
    """D10: the switch holds the surface, not the clock."""
    level = make_beach(rows=257, slope=0.05, sway=sway)
    level.set("shore.vertex", False)
    y = np.linspace(100, 200, 2000)
    first, later = along(level, y, 1.0), along(level, y, 4.0)
    near = np.abs(y - 128.0) < 8
    assert np.array_equal(first.height_m[near], later.height_m[near])
    assert not np.array_equal(first.shore.line, later.shore.line)


def test_a_front_passes_a_bar_once():
    """D03 on real beds: behind a bar the clock never runs seaward again; the switch brings back the talk's clock."""
    level = make_beach(rows=257, slope=0.03)
    bar = np.exp(-(((np.arange(257)[:, None] - 70.0) / 8.0) ** 2)).astype(np.float32) * 1.6
    level.write("height", level.grid.rect, level.height + bar)
    y = np.linspace(5, 120, 2000)
    assert np.diff(along(level, y, 0.0).clock_depth_m).max() <= 1e-6
    level.set("shore.monotone", False)
    assert np.diff(along(level, y, 0.0).clock_depth_m).max() > 1e-3


def test_a_hollow_inland_stays_still():
    """D03: shore waves run only in water connected to the sea."""
    level = make_beach(rows=257, slope=0.05)
    rows, cols = np.mgrid[0:257, 0:161]
    hollow = np.hypot(rows - 190.0, cols - 80.0) < 20
    level.write("height", level.grid.rect, np.where(hollow, -2.0, level.height))
    inside = sea_at(level, 3.3, np.array([80.0, 86.0]), np.array([190.0, 183.0]))
    assert np.all(inside.height_m == 0)
    assert inside.shore.line.max() == 0


@pytest.mark.parametrize(("rim_m", "moves"), [(0.3, True), (1.0, False)])
def test_a_tide_pool_moves_only_while_the_swash_tops_its_rim(rim_m, moves):
    """D03, D10: a pool behind a rim lower than the run-up fills when water comes over, behind a higher one never."""
    level = make_beach(rows=257, slope=0.05)
    north = np.arange(257)[:, None] - 128.0
    beach = north * 0.05 + np.zeros((1, 161))
    inland = np.abs(np.arange(161) - 80.0)[None] < 40  # the level's border is open sea
    pool = (north > rim_m / 0.05) & (north < rim_m / 0.05 + 30) & inland
    level.write("height", level.grid.rect, np.where(pool, -1.0, beach))
    middle = (np.array([80.0]), np.array([128.0 + rim_m / 0.05 + 15]))
    heights = np.array([sea_at(level, t, *middle).height_m[0] for t in np.linspace(0, 9, 90)])
    assert (heights.max() > 0.3) == moves
    assert heights.min() == 0
    assert (heights == 0).mean() > 0.3


@pytest.mark.parametrize("heading", [0, 45, 90, 133, 270])
@pytest.mark.parametrize("variance", [0.0, 0.35, 1.0])
def test_fronts_avoid_axes_and_each_other(heading, variance):
    """H05: no front within 5° of an axis, none of one group parallel to another, the high group starts in reverse."""
    level = deep_level(swell_heading_deg=float(heading), variance=variance)
    for fronts in groups(level.settings.sea, 3):
        angle = np.degrees(np.arctan2(fronts.east, fronts.north))
        off = np.abs((angle + 45) % 90 - 45)
        assert off.min() >= min(5.0, AXIS_CLEARANCE_DEG)
        apart = [abs((a - b + 90) % 180 - 90) for i, a in enumerate(angle) for b in angle[:i]]
        assert min(apart) > 2.0


def test_group_knobs_share_out_the_amplitude():
    """H28: single fronts derive from the group's one set of knobs, deterministically, and sum to it."""
    level = deep_level(swell_m=1.2)
    high, low = groups(level.settings.sea, 5)
    assert (len(high.length_m), len(low.length_m)) == (5, 3)
    assert low.amplitude_m.sum() == pytest.approx(1.2)
    assert low.rms_m < 1.2
    again = groups(level.settings.sea, 5)[1]
    assert np.array_equal(low.length_m, again.length_m)


def test_crests_run_with_deep_water_dispersion():
    """H05: every front obeys ω² = g k at speed 1."""
    for fronts in groups(deep_level().settings.sea, 11):
        speed = fronts.omega * fronts.length_m / (2 * np.pi)
        assert np.allclose(speed, np.sqrt(9.81 * fronts.length_m / (2 * np.pi)), rtol=1e-9)


@pytest.mark.parametrize("make", [deep_level, lambda: make_beach(slope=0.06), lambda: make_beach(rough_m=0.2)])
def test_normals_come_from_the_same_function_as_positions(make):
    """H29: analytic normals within 0.5° of float64 differences, through the group-by-group deformation."""
    level = make()
    level.set("shore.stagger", 0.5)
    level.set("shore.runup_variety", 0.5)
    at = np.random.default_rng(1).uniform(5, 115, (2, 3000))
    h = 1e-4

    def point(x, y):
        sample = surface_at(level, 7.3, x, y)
        return np.stack([sample.x, sample.y, sample.height_m], -1)

    # Inside a cell of the bed: across its border the bilinear bed has a crease, and a difference would straddle it.
    after = point(*at)[:, :2]
    inside = np.all(np.abs(after % 1.0 - 0.5) < 0.49, axis=1) & np.all(np.abs(at.T % 1.0 - 0.5) < 0.49, axis=1)
    east = point(at[0] + h, at[1]) - point(at[0] - h, at[1])
    north = point(at[0], at[1] + h) - point(at[0], at[1] - h)
    normal = np.cross(east, north)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    cosine = np.clip((surface_at(level, 7.3, *at).normal * normal).sum(-1), -1, 1)[inside]
    assert np.degrees(np.arccos(cosine)).max() < 0.5
    assert np.abs(normal[..., :2]).max() > 0.05


def test_small_waves_ride_on_large_ones():
    """H06: between groups the base is deformed: the sum differs from adding both groups at one base."""
    level = deep_level(swell_m=1.5, chop_m=0.4)
    x = np.linspace(20, 100, 400)
    both = surface_at(level, 2.0, x, x).height_m
    low = surface_at(level, 2.0, x, x, skip_chop=True).height_m
    level.set("sea.swell_m", 0.0)
    high = surface_at(level, 2.0, x, x).height_m
    assert np.abs(both - (low + high)).max() > 0.02


def test_world_height_inverts_the_lateral_shift():
    """D30, H30: asking at the world xy a point was carried to gives that point's height back."""
    level = deep_level(swell_m=1.2)
    x = np.linspace(10, 110, 500)
    carried = surface_at(level, 4.0, x, x[::-1])
    assert np.abs(carried.x - x).max() > 0.2
    back = sea_at(level, 4.0, carried.x, carried.y)
    assert np.abs(back.height_m - carried.height_m).max() < 1e-4
    assert np.abs(back.before_x - x).max() < 1e-3


def test_offshore_waves_fade_with_depth():
    """D11: none where the shore waves rule, full where the sea is deep, in between neither is cut off."""
    level = make_beach(rows=400, slope=0.08)
    y = np.linspace(0, 200, 2000)
    deep = along(level, y, 0.0).deep
    assert deep[0] == pytest.approx(1.0)
    assert deep[-1] == 0.0
    assert np.abs(np.diff(deep)).max() < 0.02


def test_flatter_bed_makes_a_faster_front():
    """D31: the speed the tool quotes is range · (1 + runup) / (travel · slope)."""
    shore = make_beach().settings.shore
    assert front_speed_mps(shore, 0.02) == pytest.approx(2 * front_speed_mps(shore, 0.04))
    assert front_speed_mps(shore, 0.05) == pytest.approx(5 * 1.13 / 27 / 0.05)


def test_settings_out_of_range_are_refused_in_one_sentence():
    level = make_beach()
    with pytest.raises(BadInput, match=r"^sea\.swell_m = 99.*less than or equal to 8"):
        level.set("sea.swell_m", 99)
    with pytest.raises(BadInput, match="no setting is called"):
        level.set("sea.swel", 1)


@pytest.mark.gl
@pytest.mark.parametrize("source", ["depth", "travel_time", "blend"])
@pytest.mark.parametrize("t", [0.0, DAYS])
def test_shader_and_twin_agree_within_a_millimetre(ctx, t, source):
    """D30, T06: 10,000 points through transform feedback, at t = 0 and after a week, in every source of phase."""
    level = make_beach(rows=513, cols=769, cell_m=2.0, slope=0.03, rough_m=0.15)
    level.set("timing.source", source)
    level.set("shore.stagger", 0.4)
    level.set("shore.runup_variety", 0.7)
    at = np.random.default_rng(9).uniform(-0.05, 1.05, (10_000, 2)) * np.array(level.grid.extent_m)
    at = at.astype(np.float32)
    got = feedback(ctx, level, t, at)
    want = surface_at(level, t, at[:, 0].astype(np.float64), at[:, 1].astype(np.float64))
    assert np.abs(got[:, 2] - want.height_m).max() < 1e-3
    assert np.abs(got[:, 0] - want.x).max() < 2e-3
    assert np.abs(got[:, 4] - want.shore.line).max() < 5e-3
    assert np.abs(got[:, 7] - want.normal[:, 0]).max() < 5e-3


def crest_speed(level, front: int) -> tuple[float, float]:
    """Metres a second that the crests of one front go, by the turn of its phase over a long line; and by dispersion."""
    fronts = groups(level.settings.sea, level.settings.level.seed)[1]
    along = np.linspace(0, 150, 3001)
    x, y = 5 + along * fronts.east[front], 5 + along * fronts.north[front]
    k = 2 * np.pi / fronts.length_m[front]
    step_s = 0.1

    def phase(t):
        # what the height has of this front along its own way
        height = surface_at(level, t, x, y).height_m
        return np.angle(np.sum(height * np.hanning(len(along)) * np.exp(-1j * k * along)))

    turned = -(phase(step_s) - phase(0.0) + np.pi) % (2 * np.pi) - np.pi
    return abs(turned) / step_s / k, float(np.sqrt(9.81 / k))


@pytest.mark.parametrize("noise", [0.0, 0.25])
@pytest.mark.parametrize("front", range(3))
def test_crests_go_as_fast_as_linear_dispersion_says(front, noise):
    """H05, H07: each front within 1 %, with the phase noise too: it stands still."""
    level = deep_level(swell_length_m=12.0, swell_m=0.3, chop_m=0.0, swell_steepness=0.0, phase_noise=noise)
    measured, expected = crest_speed(level, front)
    assert measured == pytest.approx(expected, rel=0.01)


def test_phase_noise_moves_crests_and_keeps_their_height():
    """H07: phase, not amplitude: single fronts keep their range, the rows their place no longer."""
    x, y = np.meshgrid(np.linspace(5, 155, 120), np.linspace(5, 250, 200))
    heights = {}
    for noise in (0.0, 0.6):
        level = deep_level(chop_m=0.0, swell_steepness=0.0, phase_noise=noise, phase_noise_m=60.0)
        heights[noise] = surface_at(level, 3.0, x, y).height_m
    plain, moved = heights.values()
    assert moved.std() == pytest.approx(plain.std(), rel=0.1)
    assert np.abs(moved).max() <= 0.45 + 1e-6
    assert np.corrcoef(plain.ravel(), moved.ravel())[0, 1] < 0.9


def test_a_sea_without_waves_stands_still():
    """No swell, no chop, no shore waves: nothing depends on time."""
    level = make_beach(rows=257, slope=0.05)
    for path, value in (("sea.on", False), ("shore.on", False)):
        level.set(path, value)
    x, y = np.meshgrid(np.linspace(5, 155, 40), np.linspace(5, 250, 60))
    first, later = (surface_at(level, t, x, y) for t in (0.0, 123.4))
    assert np.array_equal(first.height_m, later.height_m)
    assert np.array_equal(first.normal, later.normal)
    assert np.array_equal(first.x, later.x)
