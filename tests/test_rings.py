"""Rings on the water from hits and floating things (H19)."""

import itertools
import math

import numpy as np
import pytest
from scenes import camera
from shorewright.level import Grid, Level
from shorewright.level.objects import Hit, Prop
from shorewright.level.rings import HIT_LENGTH_M, MOST, SPENT, group_speed_mps, rings, wave_number

SIZE = (120, 120)
PLACE = (64.0, 64.0)
DOWN = camera(x=PLACE[0], y=PLACE[1], z=14.0, yaw=0.0, pitch=-90.0, fov=50.0)
STILL = {"sea.on": False, "shore.on": False, "sea.wind_mps": 0.0, "scatter.on": False, "foam.shore": 0.0}


def calm(*things):
    level = Level(Grid(129, 129), np.full((129, 129), -2.0, np.float32))
    for name, value in STILL.items():
        level.set(name, value)
    for thing in things:
        level.put_object(thing.id, thing)
    return level


def hit(time_s=1.0, **more):
    return Hit(id=more.pop("id", "hit"), x=more.pop("x", PLACE[0]), y=more.pop("y", PLACE[1]), time_s=time_s, **more)


def seen(renderer, level, t, view="rings", look=DOWN):
    renderer.draw(level, look, SIZE, t, view, quality="medium")
    return renderer.read(linear=True).astype(np.float64)


def slopes(renderer, level, t, look=DOWN):
    return (seen(renderer, level, t, look=look)[..., :2] - 0.5) / 2


def radius(picture):
    """Metres from the middle of the energy of slopes, and of each pixel."""
    span = 2 * 14.0 * math.tan(math.radians(25))
    y, x = (np.indices(SIZE) + 0.5) / SIZE[0] * span - span / 2
    away = np.hypot(x, y)
    return np.average(away, weights=(picture**2).sum(axis=2) / np.maximum(away, 0.1)), away


def test_rows_know_age_order_and_end():
    """H19: none before the hit and none when it is spent; the nearest come first; no more than there is room for."""
    level = calm(hit())
    ring_s = level.settings.things.ring_s
    assert len(rings(level, 1.0, PLACE)) == 0
    assert len(rings(level, 1.5, PLACE)) == 1
    assert len(rings(level, 1.01 + SPENT * ring_s, PLACE)) == 0
    late = rings(level, 0.99 + SPENT * ring_s, PLACE)[0]
    assert late[5] < 1e-3
    for n in range(40):
        level.put_object(f"h{n}", hit(id=f"h{n}", x=100.0 + n))
    rows = rings(level, 2.0, PLACE)
    assert len(rows) == MOST
    assert rows[0, 0] == PLACE[0]
    assert (np.diff(np.hypot(*(rows[:, :2] - PLACE).T)) >= 0).all()
    level.set("things.rings", 0.0)
    assert len(rings(level, 2.0, PLACE)) == 0


def test_only_what_floats_and_asks_for_it_draws_a_train():
    """H19: a standing prop draws none; a train's phase stays small after a year."""
    level = calm(Prop(id="boat", x=60, y=60, floats=True), Prop(id="post", x=61, y=60, floats=False),
                 Prop(id="mine", x=62, y=60, floats=True, ripples=False))  # fmt: skip
    rows = rings(level, 3.2e7, PLACE)
    assert len(rows) == 1
    assert rows[0, 0] == 60
    assert 0 <= rows[0, 7] <= 2 * math.pi


@pytest.mark.gl
def test_a_ring_grows_with_the_group_speed_is_round_and_dies_out(renderer):
    """H19: the middle of its energy goes ½ √(g / k) m/s; it is the same on all sides; nothing before the hit."""
    level = calm(hit())
    assert np.abs(slopes(renderer, level, 0.9)).max() < 1e-6
    pictures = [slopes(renderer, level, t) for t in (3.0, 5.0, 7.0)]
    middles = [radius(picture)[0] for picture in pictures]
    speed = group_speed_mps(wave_number(HIT_LENGTH_M, 1.0))
    for before, after in itertools.pairwise(middles):
        assert (after - before) / 2.0 == pytest.approx(speed, rel=0.15)
    for picture in pictures:
        assert np.abs(picture[..., 0] + picture[::-1, ::-1, 0]).max() < 0.02 * np.abs(picture).max()
        assert np.abs(picture[..., 0] - picture[::-1, :, 0]).max() < 0.02 * np.abs(picture).max()
        # a quarter turn takes east to north
        assert np.abs(np.rot90(picture[..., 0]) - picture[..., 1]).max() < 0.02 * np.abs(picture).max()
    assert np.abs(pictures[2]).max() < np.abs(pictures[0]).max()
    assert np.abs(slopes(renderer, level, 1.5 + SPENT * level.settings.things.ring_s)).max() < 1e-6


@pytest.mark.gl
def test_slopes_are_the_closed_form(renderer):
    """H19: k = g t² / (4 r²), phase g t² / (4 r), where waves are longer than pixels."""
    level = calm(hit())
    t = 3.0
    near = DOWN.model_copy(update={"z": 5.0})
    picture = slopes(renderer, level, 1.0 + t, near)
    place = seen(renderer, level, 1.0 + t, "position", near)[..., :2]
    away = np.hypot(place[..., 0] - PLACE[0], place[..., 1] - PLACE[1])
    _, _, radius_m, reach, k, slope, fading, _ = rings(level, 1.0 + t, PLACE)[0].astype(float)
    middle = group_speed_mps(k) * t
    assert radius_m == pytest.approx(middle)
    bell = np.exp2(-2.7 * np.log2(middle / away) ** 2)
    expected = slope * bell * np.sqrt(fading / (away + fading)) * np.sin(9.81 * t**2 / (4 * away)) * (away < reach)
    outward = (picture * (place - PLACE)).sum(axis=2) / away
    outer = away > 0.9 * middle
    assert np.abs(outward - expected)[outer].max() < 0.03 * np.abs(expected).max()
    assert np.abs(expected).max() > 0.1


@pytest.mark.gl
def test_normals_and_caustics_are_bent_and_no_vertex_moves(renderer):
    """H19, H13: hits and floating things change normals and the light on the bed, positions to the bit not at all."""
    plain = calm()
    for things in ((hit(),), (Prop(id="boat", x=66, y=65, floats=True),)):
        level = calm(*things)
        place = seen(renderer, plain, 3.0, "position")[..., :2]
        water = np.hypot(place[..., 0] - 66, place[..., 1] - 65) > 2.0  # not the thing itself
        for view, moved in (("normal", True), ("caustics", True), ("position", False), ("before", False)):
            difference = np.abs(seen(renderer, level, 3.0, view) - seen(renderer, plain, 3.0, view))[water].max()
            assert difference > 0.01 if moved else difference == 0, view
