"""Dispersion of water waves (T06): wavenumber, phase and group speed of one period over any depth."""

import numpy as np
import pytest
from shorewright.level.dispersion import deep_water_length, group_speed, phase_speed, wavenumber
from shorewright.level.earth import GRAVITY

DEPTHS_M = np.geomspace(0.01, 1000.0, 400)
PERIODS_S = (1.5, 3.33, 6.0, 10.0, 14.0, 25.0)


@pytest.mark.parametrize("period_s", PERIODS_S)
def test_wavenumber_solves_the_relation(period_s):
    """T06: omega² = g k tanh(k h) to a millionth from a puddle to the deep."""
    k = wavenumber(period_s, DEPTHS_M)
    omega_2 = (2 * np.pi / period_s) ** 2
    assert np.abs(GRAVITY * k * np.tanh(k * DEPTHS_M) / omega_2 - 1).max() < 1e-6
    assert (np.diff(k) <= 1e-12 * k[1:]).all()


def test_limits_are_long_and_deep_water():
    """T06: sqrt(g h) where the wave is long, g P / 2 pi where the bed is far below; energy goes half as fast there."""
    assert phase_speed(1000.0, 2.0) == pytest.approx(np.sqrt(GRAVITY * 2.0), rel=1e-4)
    assert phase_speed(8.0, 1000.0) == pytest.approx(GRAVITY * 8.0 / (2 * np.pi), rel=1e-9)
    assert group_speed(1000.0, 2.0) / phase_speed(1000.0, 2.0) == pytest.approx(1.0, abs=1e-3)
    assert group_speed(8.0, 1000.0) / phase_speed(8.0, 1000.0) == pytest.approx(0.5, abs=1e-6)
    assert phase_speed(8.0, 1000.0) * 8.0 == pytest.approx(deep_water_length(8.0), rel=1e-9)


@pytest.mark.parametrize("period_s", PERIODS_S)
def test_group_speed_is_the_slope_of_the_relation(period_s):
    """T06: d omega / d k, by differences of the period."""
    step = 1e-4
    for depth_m in (0.5, 3.0, 20.0, 200.0):
        k = [float(wavenumber(period_s * (1 + s), depth_m)) for s in (-step, step)]
        omega = [2 * np.pi / (period_s * (1 + s)) for s in (-step, step)]
        slope = (omega[1] - omega[0]) / (k[1] - k[0])
        assert float(group_speed(period_s, depth_m)) == pytest.approx(slope, rel=1e-5)
