"""Wave heights along the way (D34, T06): against measured shoaling, linear theory, bars, islands and formulas."""

import numpy as np
import pytest
import swell_beds
from shorewright.level.dispersion import group_speed, wavenumber
from shorewright.level.runup import breaker_type, hunt, stockdon, surf_similarity
from shorewright.level.swell_request import Swell, SwellRequest, felt_bed, solve_request
from shorewright.level.travel_time import solve
from shorewright.level.wave_heights import wave_heights


@pytest.mark.parametrize("case", ["031041", "061071"])
def test_shoaling_as_measured(data_dir, case):
    """D34: Hansen & Svendsen's heights on a slope of 1:34.3, period 3.33 s, within 6 % down to 0.19 m of water."""
    x_m, measured_m, _ = np.loadtxt(data_dir / f"surf/hansen_svendsen_1979/ht_setup_{case}.txt").T
    cell_m, slope, toe_m = 0.05, 0.0292, 0.36
    x = np.arange(-3.0, 12.0, cell_m)
    depth = np.repeat((toe_m - slope * np.maximum(x, 0.0))[:, None], 5, axis=1)
    found = solve(depth, cell_m, 3.33, 0.0, least_depth_m=0.005)
    surf = wave_heights(depth, found, float(measured_m[:5].mean()), least_depth_m=0.005)
    before = toe_m - slope * x_m >= 0.19
    off = np.interp(x_m, x, surf.height_m[:, 2])[before] / measured_m[before] - 1
    assert np.abs(off).max() < 0.06
    # The measured waves broke in 0.093 and 0.120 m; linear waves grow later, and so break nearer to the shore.
    first = depth[np.argmax(surf.broken[:, 2] > 0), 2]
    assert 0.06 < first < 0.13
    assert surf.breaker.max() == 2  # plunging, as they did


@pytest.mark.parametrize("heading_deg", [0.0, 35.0, -35.0])
def test_shoaling_and_refraction_on_a_plane_beach(heading_deg):
    """T06: H² cg cos(angle) = constant within 1 % up to breaking, the same all along the shore."""
    depth, cell_m = swell_beds.plane_beach()
    found = solve(depth, cell_m, 10.0, heading_deg)
    surf = wave_heights(depth, found, 1.0)
    water = np.maximum(depth, 0.3)
    sine = np.sin(np.radians(heading_deg)) * wavenumber(10.0, found.depth_ref_m) / wavenumber(10.0, water)
    wanted = np.sqrt(group_speed(10.0, found.depth_ref_m) / group_speed(10.0, water))
    wanted *= np.sqrt(np.cos(np.radians(heading_deg)) / np.sqrt(1 - sine**2))
    unbroken = (surf.broken == 0) & (depth > 1.0)
    assert unbroken.sum() > 0.5 * depth.size
    assert np.abs(surf.height_m / wanted - 1)[unbroken].max() < 0.01
    assert (surf.height_m[depth > 0.1] <= 0.781 * depth[depth > 0.1]).all()


def test_time_since_breaking_runs_with_the_wave():
    """D34: from the break point in, a second of travel is a second since breaking; none before."""
    depth, cell_m = swell_beds.plane_beach()
    found = solve(depth, cell_m, 10.0, 0.0)
    surf = wave_heights(depth, found, 1.5)
    column = 128
    inside = np.flatnonzero((surf.broken[:, column] > 0.5) & found.reached[:, column])
    since, seconds = (f[inside, column].astype(np.float64) for f in (surf.since_break_s, found.seconds))
    assert len(inside) > 10
    assert np.abs(np.diff(since) - np.diff(seconds)).max() < 1e-3
    assert 0 <= since[0] <= seconds[0] - found.seconds[inside[0] - 1, column]
    assert surf.since_break_s[: inside[0], column].max() == 0.0
    assert np.flatnonzero(surf.break_point[:, column]).tolist() == [inside[0]]
    assert (np.diff(surf.height_m[inside, column]) < 0).all()


def test_waves_form_again_behind_a_bar():
    """D34: they break on the bar, not in the trough behind it, and once more on the beach, lower."""
    y = np.arange(0, 600.0, 2.0)
    profile = np.interp(y, [0, 150, 250, 300, 350, 560, 600], [12, 12, 1.8, 1.8, 5.0, 0.0, -1.0])
    depth = np.repeat(profile[:, None], 9, axis=1)
    surf = wave_heights(depth, solve(depth, 2.0, 9.0, 0.0), 1.6)
    starts = y[np.flatnonzero(surf.break_point[:, 4])]
    assert len(starts) == 2
    assert 220 < starts[0] < 300
    assert 450 < starts[1] < 560
    trough = (y > 345) & (y < 400)
    assert surf.broken[trough, 4].max() < 0.5
    assert surf.broken[(y > 390) & (y < 440), 4].max() < 0.15
    heights = surf.break_height_m[np.flatnonzero(surf.break_point[:, 4]), 4]
    assert heights[1] < 0.7 * heights[0]


def test_calm_behind_an_island_high_behind_a_shoal():
    """T06: an island's lee is sheltered, its sides aren't; a shoal gathers waves behind it; nothing grows for ever."""
    y, x = np.mgrid[:201, :201] * 4.0
    island = np.where(np.hypot(x - 400, y - 300) < 90, -1.0, 12.0)
    surf = wave_heights(island, solve(island, 4.0, 8.0, 0.0), 1.0)
    assert surf.height_m[110, 85:116].max() < 0.5
    assert np.abs(surf.height_m[110, :40] - 1).max() < 0.05
    shoal = 12.0 - 9.0 * np.exp(-((x - 400) ** 2 + (y - 300) ** 2) / 100**2)
    surf = wave_heights(shoal, solve(shoal, 4.0, 8.0, 0.0), 0.5)
    assert surf.height_m[90, 100] > 0.7
    assert surf.height_m[130, 100] > 0.55
    assert surf.height_m[130, 75] < 0.5
    assert surf.height_m.max() < 2.0 * 0.5 * 1.5


def test_mirrored_level_mirrors_heights():
    """T06: east for west gives the same heights mirrored, to rounding."""
    depth = swell_beds.rough_coast()[0]
    here, there = (
        wave_heights(bed, solve(bed, 3.0, 9.0, heading), 1.0)
        for bed, heading in ((depth, 20.0), (depth[:, ::-1], -20.0))
    )
    assert np.abs(here.height_m - there.height_m[:, ::-1]).max() < 1e-4
    assert np.isfinite(here.height_m).all()


def test_half_the_samples_give_the_same_heights():
    """T06: maps for the shader are made coarser than T; half the samples of the same T agree within 0.1 m of 1."""
    depth, cell_m = swell_beds.rough_coast()
    found = solve(depth, cell_m, 9.0, 20.0)
    fine, coarse = wave_heights(depth, found, 1.0), wave_heights(depth[::2, ::2], found.strided(2), 1.0)
    off = np.abs(fine.height_m[::2, ::2] - coarse.height_m)[depth[::2, ::2] > 1.0]
    assert np.percentile(off, 95) < 0.1


def test_no_swell_no_heights():
    """T06: a swell from land, and one of no height, leave still water."""
    depth, cell_m = swell_beds.plane_beach(65)
    for heading_deg, height_m in ((180.0, 1.0), (0.0, 0.0)):
        surf = wave_heights(depth, solve(depth, cell_m, 9.0, heading_deg), height_m)
        assert surf.height_m.max() == surf.runup_m.max() == surf.breaker.max() == 0


def test_breaker_types_and_runup():
    """D34: spilling, plunging and surging by surf similarity; run-up by Hunt and by Stockdon at worked values."""
    assert breaker_type(surf_similarity(np.array([0.01, 0.08, 0.6]), 1.0, 8.0)).tolist() == [1, 2, 3]
    # 1 m, 10 s: L0 = 156.1 m, root of H L0 = 12.5 m.
    assert hunt(0.1, 1.0, 10.0) == pytest.approx(1.249, abs=2e-3)
    assert stockdon(0.1, 1.0, 10.0) == pytest.approx(1.1 * (0.437 + 0.6123), abs=5e-3)
    depth, cell_m = swell_beds.plane_beach()
    up = [wave_heights(depth, solve(depth, cell_m, 10.0, 0.0), h).runup_m[240, 128] for h in (0.5, 2.0)]
    assert up[1] / up[0] == pytest.approx(2.0, rel=0.01)  # grows with the root of the height


def test_boulders_are_not_felt_channels_are():
    """T06: a bed of boulders refracts like one without; a channel between rocks stays open; a plane stays as it is."""
    depth = np.full((101, 101), 6.0, np.float32)
    depth[5::10, 5::10] = -1.0
    assert felt_bed(depth, 1.0, 4.0).min() > 5.0
    (found,) = solve_request(SwellRequest(depth, 1.0, (Swell(8.0, 0.0),)))
    assert found.time.meets.max() == 0.0
    assert found.time.reached.all()
    rocks = np.full((101, 101), -8.0, np.float32)
    rocks[:, 49:52] = 3.0
    assert (felt_bed(rocks, 1.0, 4.0)[:, 49:52] > 0).all()
    plane = np.linspace(9.0, -1.0, 201, dtype=np.float32)[:, None].repeat(20, axis=1)
    inner = slice(30, 170)
    assert np.abs(felt_bed(plane, 1.0, 4.0) - plane)[inner].max() < 1e-3


def test_any_bed_has_an_answer():
    """T06: noise for a bed, land in corners, strips, painted speed, any heading and scale: finite maps, no warning."""
    rng = np.random.default_rng(5)
    reached = 0
    for _ in range(60):
        shape = tuple(rng.integers(2, 40, 2))
        bed = rng.normal(0, 1, shape) * rng.uniform(0.1, 30) + rng.uniform(-5, 20)
        speed = rng.uniform(0.25, 4, shape).astype(np.float32)
        swell = Swell(float(rng.uniform(2, 25)), float(rng.uniform(-400, 400)), float(rng.uniform(0.05, 6)))
        cell_m, side, over_m = (rng.choice(values) for values in ([0.1, 1.0, 30.0], [9, 513], [0.0, 4.0]))
        request = SwellRequest(
            bed.astype(np.float32), cell_m, (swell,), speed=speed, heights_side=int(side), bed_over_m=over_m
        )
        (found,) = solve_request(request)
        reached += found.time.reached.any()
        maps = [found.time.seconds, found.time.meets, *(v for v in vars(found.heights).values())]
        assert all(np.isfinite(field).all() for field in maps)
        assert all((field >= 0).all() for field in maps[1:])
        assert found.time.meets.max() <= 1
    assert reached > 30
