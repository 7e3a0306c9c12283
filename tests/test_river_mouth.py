"""Where a river runs into the sea: its jet, the waves that it stops, raises and lets in; no seam (D35)."""

import numpy as np
import pytest
from points import feedback
from scipy.optimize import brentq
from shorewright.level.blocking import MOST_GAIN, met, stopping_speed
from shorewright.level.flow import current
from shorewright.level.pick import ground_at
from shorewright.level.river_flow import river_flow
from shorewright.level.river_jet import CORE, Mouth
from shorewright.level.river_map import code_of_waves, river_map, river_shape, waves_of_code
from shorewright.level.waves import sea_at, surface_at
from test_rivers import coast, down

G = 9.81


def fast(speed_mps=1.6, **settings):
    """The coast of test_rivers with a river at that speed, in a sea of swell of 8 s and short chop."""
    level = coast()
    level.put_object("river", down(60, 155, 60, 74, (4.5, 3.0, 2.4, 0.5, 0.0), speed_mps=speed_mps))
    for path, value in {"sea.swell_m": 0.3, "sea.swell_length_m": 100.0, "sea.chop_m": 0.08, "sea.chop_length_m": 4.0,
                        **settings}.items():  # fmt: skip
        level.set(path, value)
    return level


def test_a_current_stops_short_waves_and_not_long_ones():
    """D35: in deep water g P / (8 π): 0.78 m/s stops 2 s, 8 s isn't stopped by less than 3.1."""
    assert stopping_speed(2.0, 30.0) == pytest.approx(0.78, abs=0.01)
    assert stopping_speed(8.0, 300.0) == pytest.approx(3.12, abs=0.02)
    assert stopping_speed(120.0, 1.0) == pytest.approx(np.sqrt(G), rel=0.1)  # no wave runs up rapids
    assert met(2.0, 30.0, 0.9).through == 0
    assert met(2.0, 30.0, 0.6).through == 1
    assert met(8.0, 30.0, 0.9).through == 1
    assert met(2.0, 30.0, 0.0).gain == 1


@pytest.mark.parametrize("share", [0.2, 0.6, 0.9])
def test_heights_keep_the_wave_action(share):
    """D35: (cg + U) H² / σ is that of the waves before, solved from (ω − k U)² = g k."""
    period = 4.0
    omega, against = 2 * np.pi / period, share * float(stopping_speed(period, 1000.0))
    still = omega**2 / G
    k = brentq(lambda k: np.sqrt(G * k) - k * against - omega, 0.5 * still, 4 * still)
    sigma = np.sqrt(G * k)
    action = ((0.5 * np.sqrt(G / k) - against) / sigma) / (0.5 * np.sqrt(G / still) / omega)
    found = met(period, 1000.0, against)
    assert found.gain == pytest.approx(min(action**-0.5, MOST_GAIN), rel=0.01)
    slower = (0.5 * np.sqrt(G / k) - against) / (0.5 * np.sqrt(G / k))
    assert found.white == pytest.approx(1.0 if slower < 0.2 else 0.0, abs=0.7 if 0.2 < slower < 0.5 else 1e-9)


def test_the_jet_keeps_its_core_then_decays_and_spreads():
    """D35: U0 to 5.2 widths, then U0 √(core / d); half of that at b0 + 0.1 d from the middle."""
    jet = Mouth(10, 20, 0.6, -0.8, 1.5, 4.0, 1.0, 1e6)

    def speed(ahead, left):
        return jet.speed(10 + 0.6 * ahead + 0.8 * left, 20 - 0.8 * ahead + 0.6 * left, 0.01)

    core = CORE * 8
    np.testing.assert_allclose(speed(np.array([0.0, 20, core]), 0.0), 1.5, rtol=1e-6)
    np.testing.assert_allclose(speed(np.array([2, 5]) * core, 0.0), 1.5 * np.sqrt([0.5, 0.2]), rtol=1e-6)
    for ahead in (30.0, core, 4 * core):
        middle, sides = speed(ahead, 0.0), speed(ahead, np.array([-1, 1]) * (4 + 0.1 * ahead))
        np.testing.assert_allclose(sides, 0.5 * middle, rtol=5e-3)
    assert speed(-1.0, 0.0) == 0


def test_the_current_goes_out_to_sea_without_a_step():
    """D35: along the middle through the mouth and to its end the velocity changes by little a metre, then is gone."""
    level = fast()
    level.set("flow.shore_mps", 0.0)
    y = np.arange(2.0, 140.0, 0.25)
    east, north = current(level).at(np.full(y.shape, 60.0), y)
    fastest = np.abs(np.diff(north)).max() / 0.25
    at_mouth = river_flow(level).mouths[0].speed_mps
    assert fastest < 0.3 * at_mouth
    assert north[np.searchsorted(y, 60.0)] == pytest.approx(-at_mouth, rel=0.1)
    assert abs(north[0]) < 1e-6
    assert np.abs(east).max() < 0.2 * at_mouth


def test_swell_comes_into_a_river_that_stops_the_chop():
    """D35: what each band leaves in the mouth, up the river and beside it; white where the chop is held up."""
    level = fast()
    at = river_map(level).at(np.full(4, 60.0), np.array([70.0, 78.0, 150.0, 5.0]))
    assert at["chop"].v[1] < 0.05
    assert at["swell"].v[1] > 0.7
    assert at["swell"].v[2] < 0.01
    assert at["chop"].v[3] == at["swell"].v[3] == 1
    assert river_map(level).at(np.full(140, 60.0), np.linspace(10, 80, 140))["white"].v.max() > 0.5
    slow = fast(0.1)
    assert river_map(slow).at(60.0, 70.0)["chop"].v > 0.9


def test_painted_shares():
    """D35: the mask of the mouth by hand: −1 lets no waves in, 1 all of them."""
    level = fast()
    level.write("mouth", level.grid.rect, np.float32(-1))
    below = river_map(level).at(60.0, 74.0)
    level.write("mouth", level.grid.rect, np.float32(1))
    above = river_map(level).at(60.0, 110.0)
    assert below["swell"].v == below["chop"].v == 0
    assert above["swell"].v == above["chop"].v == 1


def test_shares_fit_one_number():
    """D35: swell, chop and white come back from their code within its steps, 1 exactly."""
    rng = np.random.default_rng(2)
    swell, chop, white = rng.uniform(0, (2, 2, 1), (500, 3)).T
    swell[0], chop[0] = 1.0, 1.0
    back = waves_of_code(code_of_waves(swell, chop, white, np.zeros(500)).astype(np.float64))
    np.testing.assert_allclose(back[0], swell, atol=0.002)
    np.testing.assert_allclose(back[1], chop, atol=0.002)
    np.testing.assert_allclose(back[2], white, atol=0.008)
    assert back[0][0] == back[1][0] == 1
    assert waves_of_code(code_of_waves(0.0, 0.0, 0.0, 0.7))[3] == pytest.approx(0.7)


@pytest.mark.parametrize("source", ["depth", "travel_time"])
@pytest.mark.parametrize(("shore", "sides"), [(True, (-0.8, 0.8)), (False, (-1.0, -0.9, 0.9, 1.0))])
def test_no_seam_along_banks_and_mouth(shore, sides, source):
    """D35: two places a millimetre apart across any border differ by less than 2 cm and 2°, at 20 moments.

    Shore waves kink where the bed does, which it does at the bank itself: there without them.
    """
    level, rng = fast(**{"shore.on": shore, "timing.source": source}), np.random.default_rng(7)
    line = river_shape(level).lines[0]
    way = np.stack([np.gradient(line.x), np.gradient(line.y)], -1)
    way /= np.linalg.norm(way, axis=1)[:, None]
    left = np.stack([-way[:, 1], way[:, 0]], -1)
    middle, half = np.stack([line.x, line.y], -1), line.half_m[:, None]
    banks = np.concatenate([middle + side * half * left for side in sides])
    ends = middle[-1] + np.linspace(-1, 1, 15)[:, None] * half[-1] * left[-1]
    mouth = middle[line.mouth] + np.linspace(-1.5, 1.5, 31)[:, None] * half[line.mouth] * left[line.mouth]
    at = np.concatenate([banks, ends, mouth])
    across = np.concatenate(
        [np.tile(left, (len(sides), 1)), np.tile(way[-1], (15, 1)), np.tile(way[line.mouth], (31, 1))]
    )
    for t in rng.uniform(0, 600, 20):
        one, two = (sea_at(level, t, *(at + 0.0005 * side * across).T) for side in (-1, 1))
        assert np.abs(one.height_m - two.height_m).max() < 0.02
        seen = np.minimum(one.height_m, two.height_m) > ground_at(level, *at.T) + 0.05  # not under the bank
        angle = np.degrees(np.arccos(np.clip((one.normal * two.normal).sum(-1), -1, 1)))
        assert np.count_nonzero(seen) > 100
        assert angle[seen].max() < 2


@pytest.mark.gl
@pytest.mark.parametrize("source", ["depth", "travel_time"])
def test_shader_and_twin_agree_where_waves_meet_the_jet(ctx, source):
    """D30, D35: 10,000 points round the mouth within a millimetre."""
    level, rng = fast(**{"timing.source": source}), np.random.default_rng(3)
    at = rng.uniform((40, 5), (80, 110), (10_000, 2))
    seen = feedback(ctx, level, 33.3, at)
    assert river_map(level).most_gain > 1.2
    assert np.abs(seen[:, 2] - surface_at(level, 33.3, at[:, 0], at[:, 1]).height_m).max() < 1e-3
