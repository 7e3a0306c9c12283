"""Travel time of a swell (T06): against Snell, a flume, its own mirror images, walls and islands."""

import sys

import numpy as np
import pytest
import swell_beds
from shorewright.level.dispersion import wavenumber
from shorewright.level.errors import BadInput
from shorewright.level.travel_time import plane_time, solve, strided


def _direction_deg(found):
    gy, gx = np.gradient(found.seconds.astype(np.float64), found.cell_m)
    return np.degrees(np.arctan2(gx, gy))


@pytest.mark.parametrize("period_s", [6.0, 10.0, 14.0])
def test_refraction_follows_snell(period_s):
    """T06: on a plane beach a swell at 35 degrees turns as k sin(angle) = constant says, within half a degree."""
    depth, cell_m = swell_beds.plane_beach()
    found = solve(depth, cell_m, period_s, 35.0)
    k_ref = float(wavenumber(period_s, found.depth_ref_m))
    wanted = np.degrees(np.arcsin(k_ref * np.sin(np.radians(35.0)) / wavenumber(period_s, np.maximum(depth, 0.3))))
    water = found.reached & (depth > 0.6)
    assert np.abs(_direction_deg(found) - wanted)[water].max() < 0.5
    assert wanted[water].min() < 12.0  # it does turn
    assert not found.meets.any()


@pytest.mark.parametrize("heading_deg", [0.0, 20.0, 90.0, 135.0, 200.0, 300.0])
def test_even_water_keeps_the_plane_wave(heading_deg):
    """T06: T = D · x / c to the bit that float32 has, from any side: it joins what is drawn beyond the level."""
    found = solve(np.full((60, 90), 14.0), 3.0, 9.0, heading_deg, origin_m=(100.0, -40.0))
    y, x = np.mgrid[:60, :90] * 3.0
    wanted = plane_time(x + 100.0, y - 40.0, heading_deg, found.speed_ref)
    assert np.abs(found.seconds - wanted).max() < 2e-5
    assert found.reached.all()


def test_flume_long_wave():
    """T06: crest times at the gauges of the composite beach within 5 % of the flume, 2.5 % of the linear series."""
    depth, cell_m = swell_beds.flume()
    found = solve(depth, cell_m, 1000.0, 0.0, least_depth_m=0.01)
    rows = np.round(np.array(swell_beds.FLUME_GAUGES_M) / cell_m).astype(int)
    times = found.seconds[rows, 2].astype(np.float64)
    assert np.abs(times / swell_beds.FLUME_MEASURED_S - 1).max() < 0.05
    assert np.abs(times / swell_beds.FLUME_ANALYTIC_S - 1).max() < 0.025


def test_grid_does_not_matter():
    """T06: over a rough coast half the samples give the same times within 0.1 s of a minute."""
    depth, cell_m = swell_beds.rough_coast()
    fine, coarse = solve(depth, cell_m, 9.0, 20.0), solve(*strided(depth, cell_m, 151), 9.0, 20.0)
    assert coarse.cell_m == 2 * cell_m
    both = fine.reached[::2, ::2] & coarse.reached & (depth[::2, ::2] > 1.0)
    off = np.abs(fine.seconds[::2, ::2] - coarse.seconds)[both]
    assert np.ptp(fine.seconds[fine.reached]) > 60
    assert np.percentile(off, 99) < 0.1
    assert off.max() < 0.5


def test_moved_level_moves_time():
    """T06: the same bed at another place of the world has T later by the plane wave's way there, nothing else."""
    depth, cell_m = swell_beds.rough_coast()
    here, there = (solve(depth, cell_m, 9.0, 20.0, origin_m=o) for o in ((0.0, 0.0), (64.0, -32.0)))
    moved = float(plane_time(64.0, -32.0, 20.0, here.speed_ref))
    assert np.abs(there.seconds - here.seconds - moved).max() < 2e-5


@pytest.mark.parametrize(("axis", "heading_deg"), [(1, -20.0), (0, 160.0), (None, 70.0)])
def test_mirrored_level_mirrors_time(axis, heading_deg):
    """T06: east for west, south for north and one axis for the other: the same map mirrored."""
    depth, cell_m = swell_beds.rough_coast()

    def mirrored(field):
        return field.T if axis is None else np.flip(field, axis)

    found = solve(depth, cell_m, 9.0, 20.0)
    other = solve(mirrored(depth), cell_m, 9.0, heading_deg)
    assert (mirrored(found.reached) == other.reached).all()
    difference = (mirrored(found.seconds) - other.seconds)[other.reached].astype(np.float64)
    assert np.ptp(difference) < 1e-4  # the world's origin is at another corner: one constant


def test_wall_shelters_and_pond_stays_still():
    """T06: a wall makes waves go round; a pond has none; T is finite everywhere."""
    depth = np.full((120, 120), 10.0)
    wall = depth.copy()
    wall[60:62, 30:] = -1.0
    wall[20:30, 20:30] = -1.0
    wall[23:27, 23:27] = 2.0
    open_sea, behind = solve(depth, 5.0, 9.0, 0.0), solve(wall, 5.0, 9.0, 0.0)
    later = behind.seconds - open_sea.seconds
    assert np.abs(later[:60, 35:]).max() < 0.2
    assert later[64, 100] > 20.0
    assert not behind.reached[23:27, 23:27].any()
    assert behind.reached[64, 100]
    assert np.isfinite(behind.seconds).all()


def test_fronts_meet_behind_an_island():
    """T06: right behind a round island is a line where two fronts meet, and nowhere before it."""
    y, x = np.mgrid[:201, :201] * 4.0
    depth = np.where(np.hypot(x - 400, y - 300) < 90, -1.0, 12.0)
    found = solve(depth, 4.0, 8.0, 0.0)
    assert found.meets[105:115, 100].min() > 0.8
    assert found.meets[:70].max() == 0.0
    assert found.meets[:, :60].max() == 0.0
    assert np.abs(found.seconds - found.seconds[:, ::-1]).max() < 1e-4


def test_swell_from_land_reaches_nothing():
    """T06: where no sea is on the side it comes from there are no waves, and no fault."""
    depth, cell_m = swell_beds.plane_beach(65)
    found = solve(depth, cell_m, 9.0, 180.0)
    assert not found.reached.any()
    assert np.isfinite(found.seconds).all()
    assert not solve(np.full((20, 20), -1.0), 1.0, 9.0, 0.0).reached.any()


def test_painted_speed_quickens():
    """T07: twice the speed over a strip takes half the time over it."""
    speed = np.ones((100, 60))
    speed[40:60] = 2.0
    even, painted = (solve(np.full((100, 60), 8.0), 2.0, 9.0, 0.0, speed=s) for s in (1.0, speed))
    saved = even.seconds[90, 30] - painted.seconds[90, 30]
    assert saved == pytest.approx(20 * 2.0 / even.speed_ref / 2, rel=0.03)


def test_missing_solver_is_one_sentence(monkeypatch):
    """T06: without the compiled package the sentence says what to install."""
    monkeypatch.setitem(sys.modules, "skfmm", None)
    with pytest.raises(BadInput, match="scikit-fmm"):
        solve(np.full((20, 20), 8.0), 2.0, 9.0, 0.0)
