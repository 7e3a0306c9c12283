"""Hot spots: each kind where the bed makes it, none on an even beach, with numbers that follow from the bed (T06)."""

import numpy as np
import pytest
from shorewright.level import Grid, Level
from shorewright.level.contours import contours
from shorewright.level.hot_spots import KINDS, hot_spots
from shorewright.level.speed_ramp import BREAKERS, ramp_colour, stops


def coast(profile, cols=97, **changes):
    """A coast that is the same all along; `profile(y)` is the ground in metres, y metres northwards."""
    y = np.arange(193.0)
    height = np.repeat(np.asarray(profile(y), np.float32)[:, None], cols, axis=1)
    level = Level(Grid(193, cols), height)
    for path, value in {"shore.stagger": 0.0, "shore.sway": 0.0, "sea.phase_noise": 0.0, **changes}.items():
        level.set(path, value)
    return level


def spots(level, kind):
    assert kind in KINDS
    return [spot for spot in hot_spots(level, 0.0) if spot.kind == kind]


def even(y):
    return (y - 130) * 0.05


def test_an_even_beach_has_none():
    assert hot_spots(coast(even), 0.0) == []


def test_flat_ground_races_and_says_which_slope_would_not():
    """T06: on 1 : 200 fronts run at range · (1 + runup) / (travel · slope), over the limit."""
    level = coast(lambda y: np.interp(y, [0, 60, 110, 192], [-8, -2.0, -1.75, 4]))
    level.set("shore.flat_slope", 0.0)
    (spot,) = spots(level, "too_fast")
    shore, limit = level.settings.shore, level.settings.timing.fast_mps
    across = shore.range_m * (1 + shore.runup) / (shore.interval_s * shore.count)
    assert spot.value == pytest.approx(across / 0.005, rel=0.1)
    assert 60 < spot.y < 110
    assert f"1 : {limit / across:.0f} " in spot.advice
    assert f"{limit:g} m/s" in spot.sentence


def test_a_wall_stalls_fronts():
    level = coast(lambda y: np.interp(y, [0, 90, 100, 192], [-6, -4.5, -0.5, 3]), **{"timing.slow_mps": 0.8})
    (spot,) = spots(level, "stalling")
    assert 85 < spot.y < 105
    assert spot.value > level.settings.timing.stall_s
    level.set("timing.stall_s", 30.0)
    assert not spots(level, "stalling")


def test_a_shoal_far_out_breaks_off_the_beach():
    """T06: `far_m` against the metres between the break line and the still shoreline."""
    level = coast(lambda y: np.interp(y, [0, 20, 40, 120, 192], [-8, -4, -1.0, -0.9, 4]))
    (spot,) = spots(level, "off_the_beach")
    shoreline = 120 + 72 * 0.9 / 4.9
    assert spot.value == pytest.approx(shoreline - spot.y, abs=2.0)
    level.set("timing.far_m", 150.0)
    assert not spots(level, "off_the_beach")


@pytest.mark.parametrize("source", ["depth", "travel_time"])
def test_a_bar_is_told_with_its_trough(source):
    """T06: depth behind a bar against the least depth on the way there."""
    level = coast(lambda y: np.interp(y, [0, 60, 80, 100, 140, 192], [-8, -2.5, -1.0, -2.2, 0, 4]))
    level.set("timing.source", source)
    (spot,) = spots(level, "bar")
    assert spot.value == pytest.approx(1.2, abs=0.1)
    assert spot.y == pytest.approx(100, abs=2)
    assert ("again on the beach" in spot.sentence) == (source == "travel_time")
    if source == "travel_time":
        level.set("shore.height_m", 0.2)  # too low to break on it
        assert not spots(level, "bar")
        level.set("shore.height_m", 1.2)
    level.set("timing.bar_m", 1.5)
    assert not spots(level, "bar")


def test_contours_are_joined_closed_and_have_the_high_side_on_their_left():
    y, x = np.mgrid[0:40, 0:50].astype(float)
    hill = 15 - np.hypot(x - 24.3, y - 19.6)
    (ring,) = contours(hill, 5.0, np.ones_like(hill, bool))
    np.testing.assert_allclose(ring[0], ring[-1])
    np.testing.assert_allclose(np.hypot(*(ring - (24.3, 19.6)).T), 10.0, atol=0.02)
    area = 0.5 * np.sum(ring[:-1, 0] * ring[1:, 1] - ring[1:, 0] * ring[:-1, 1])
    assert area == pytest.approx(np.pi * 100, rel=0.01)  # positive: anticlockwise round the hill


def test_contours_end_where_the_field_is_not_known():
    y, x = np.mgrid[0:20, 0:30].astype(float)
    known = (x < 10) | (x > 14)
    lines = contours(y, 7.25, known)
    assert sorted(line[:, 0].max() - line[:, 0].min() for line in lines) == [9.0, 14.0]
    assert all((line[:, 1] == 7.25).all() for line in lines)
    assert contours(y, 99.0, known) == []


def test_saddles_join_the_way_their_middle_lies():
    field = np.array([[1.0, 0.0], [0.0, 1.0]])
    for at, expected in ((0.4, 2), (0.6, 2)):
        assert len(contours(field, at, np.ones((2, 2), bool))) == expected
    (a, b) = contours(field, 0.4, np.ones((2, 2), bool))
    assert np.allclose(a.mean(0) + b.mean(0), [1, 1])


def test_colours_of_speed_get_lighter_in_even_steps_for_every_eye():
    """T06: L* rises evenly, and also what a red-blind eye sees of the ramp; breakers differ in lightness or hue."""
    linear = np.where(stops() <= 0.04045, stops() / 12.92, ((stops() + 0.055) / 1.055) ** 2.4)
    lightness = 116 * np.cbrt(linear @ [0.2126, 0.7152, 0.0722]) - 16
    steps = np.diff(lightness)
    assert (steps > 0).all()
    assert steps.std() < 0.15 * steps.mean()
    red_blind = linear @ np.array([[0.11, 0.11, 0.0], [0.89, 0.89, 0.0], [0.0, 0.0, 1.0]])  # Viénot et al. 1999
    assert (np.diff(red_blind @ [0.2126, 0.7152, 0.0722]) > 0).all()
    np.testing.assert_allclose(ramp_colour([0.0, 1.0]), stops()[[0, -1]])
    assert len(set(BREAKERS.values())) == 3
