"""Single fronts in closed form: H04 lateral shift, H07 phase noise, H22 what physics may leave out."""

import dataclasses

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level.dual import Dual
from shorewright.level.gerstner import PHASE_GAIN, Deformed, Fronts, deform, groups, phase_noise
from shorewright.level.waves import sea_at, surface_at


def deep_level(**sea):
    """Twenty metres of water everywhere."""
    level = make_beach(slope=0.0)
    level.write("height", level.grid.rect, -20.0)
    for name, value in sea.items():
        level.set(f"sea.{name}", value)
    return level


def single(fronts: Fronts, i: int) -> Fronts:
    return Fronts(*(getattr(fronts, field.name)[i : i + 1] for field in dataclasses.fields(Fronts)))


def carried(level, front: tuple[int, int], t, x, y) -> Deformed:
    """Where one front alone carries undeformed points."""
    group, i = front
    fronts = groups(level.settings.sea, level.settings.level.seed)[group]
    start = Deformed(Dual(x, 1.0, 0.0), Dual(y, 0.0, 1.0), Dual(np.zeros_like(x)))
    return deform(start, single(fronts, i), t, Dual(1.0), [phase_noise(level.settings.sea, fronts, i, x, y)])


ALL = [(group, i) for group, count in ((0, 5), (1, 3)) for i in range(count)]


@pytest.mark.parametrize("front", ALL)
def test_a_front_shifts_points_along_its_way_a_quarter_turn_before_it_lifts_them(front):
    """H04: x + D Q A cos θ, z = A sin θ (Finch, GPU Gems 1, equation 9), closed form against one front."""
    level = deep_level(phase_noise=0.0)
    fronts = groups(level.settings.sea, level.settings.level.seed)[front[0]]
    i, t = front[1], 3.7
    x, y = np.random.default_rng(2).uniform(0, 150, (2, 2000))
    heading = np.array([fronts.east[i], fronts.north[i]])
    k = 2 * np.pi / fronts.length_m[i]
    theta = k * (heading[0] * x + heading[1] * y) - np.sqrt(9.81 * k) * t
    point = carried(level, front, t, x, y)
    np.testing.assert_allclose(point.z.v, fronts.amplitude_m[i] * np.sin(theta), atol=1e-9)
    np.testing.assert_allclose(point.x.v - x, heading[0] * fronts.lateral_m[i] * np.cos(theta), atol=1e-9)
    np.testing.assert_allclose(point.y.v - y, heading[1] * fronts.lateral_m[i] * np.cos(theta), atol=1e-9)
    assert fronts.lateral_m[i] > fronts.amplitude_m[i]


def test_the_lateral_shift_draws_crests_together():
    """H04: with it less than half of the sea stands above the still level, and crests are sharper than troughs."""
    x, y = np.meshgrid(np.linspace(10, 150, 220), np.linspace(10, 120, 220))
    share = {}
    for steepness in (0.0, 1.0):
        level = deep_level(swell_steepness=steepness, swell_m=1.5, chop_m=0.0)
        surface = sea_at(level, 2.0, x, y)
        share[steepness] = (surface.height_m > 0).mean()
        shift = np.hypot(surface.x - surface.before_x, surface.y - surface.before_y)
        assert (shift.max() > 0.5) == (steepness > 0)
    assert share[1.0] < share[0.0] - 0.05


@pytest.mark.parametrize("front", ALL)
def test_crests_keep_their_speed_everywhere_under_phase_noise(front):
    """H07: at single places, not on the mean, each front goes within 1 % of ω / k; its crests bend."""
    level = deep_level(phase_noise=0.8, phase_noise_m=40.0)
    group, i = front
    fronts = groups(level.settings.sea, level.settings.level.seed)[group]
    way, crest = np.array([fronts.east[i], fronts.north[i]]), np.array([fronts.north[i], -fronts.east[i]])
    length = fronts.length_m[i]
    offset, dt = np.linspace(-0.5, 0.5, 4001) * length, 0.05
    expected = np.sqrt(9.81 * length / (2 * np.pi))
    for place in np.random.default_rng(4).uniform(0, 600, (12, 2)):
        x, y = place[:, None] + way[:, None] * offset
        tops = [offset[np.argmax(carried(level, front, 2.0 + k * dt, x, y).z.v)] for k in range(2)]
        moved = (tops[1] - tops[0]) % length
        assert moved / dt == pytest.approx(expected, rel=0.01, abs=2 * length / 4000 / dt)
    x, y = np.array([[40.0], [50.0]]) + crest[:, None] * np.linspace(0, 300, 400)
    bend = phase_noise(level.settings.sea, fronts, i, x, y).v
    assert np.ptp(bend) > 0.3 * 0.8 * abs(PHASE_GAIN[len(fronts.length_m)][i])
    assert np.abs(bend).max() <= 0.4 + 1e-9


def test_physics_without_the_high_group_stands_on_world_points():
    """H22: left out, the sea is that of chop_m = 0; the lateral shift is inverted to 1e-4 with and without it."""
    level = deep_level(swell_m=1.0, chop_m=0.3)
    x, y = np.random.default_rng(6).uniform(5, 115, (2, 1500))
    skipped, whole = (sea_at(level, 4.0, x, y, skip_chop=skip) for skip in (True, False))
    for sample in (skipped, whole):
        assert np.abs(np.stack([sample.x - x, sample.y - y])).max() < 1e-4
        assert np.abs(sample.before_x - x).max() > 0.1
    assert 0.1 < np.abs(whole.height_m - skipped.height_m).max() < 0.75
    level.set("sea.chop_m", 0.0)
    without = sea_at(level, 4.0, x, y)
    np.testing.assert_allclose(skipped.height_m, without.height_m, atol=1e-9)
    np.testing.assert_allclose(skipped.normal, without.normal, atol=1e-9)
    again = surface_at(level, 4.0, skipped.before_x, skipped.before_y)
    np.testing.assert_allclose(again.height_m, skipped.height_m, atol=1e-6)
