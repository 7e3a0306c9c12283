"""Wave objects, curved fronts and regions of swell (H08 H09 D32; H06 for their place among the groups)."""

import dataclasses

import numpy as np
import pytest
from coasts import make_beach
from points import feedback
from shorewright.level.dual import Dual
from shorewright.level.gerstner import groups
from shorewright.level.objects import SwellRegion, WaveObject
from shorewright.level.patches import PATCH_M
from shorewright.level.wave_lists import MOST_ON_PATCH, hectares, patch_lists
from shorewright.level.wave_objects import (
    HIGH,
    LOW,
    circle_weight,
    front_coordinate,
    object_fronts,
    object_shift,
    wave_pass,
)  # fmt: skip
from shorewright.level.wave_regions import ahead, region_fronts
from shorewright.level.wave_uniforms import wave_defines
from shorewright.level.waves import largest_height_m, sea_at, surface_at

WEEK = 7 * 86_400.0


def deep_level(*things, **sea):
    """Twenty metres of water everywhere, 400 × 300 m."""
    level = make_beach(rows=151, cols=201, cell_m=2.0, slope=0.0)
    level.write("height", level.grid.rect, -20.0)
    for name, value in sea.items():
        level.set(f"sea.{name}", value)
    for thing in things:
        level.put_object(thing.id, thing)
    return level


def wave(name="wave-1", **fields):
    return WaveObject(**{"id": name, "x": 190.0, "y": 150.0, "yaw_deg": 33.0, **fields})


def crowd(curvature=0.8):
    """Four objects over each other, two of either pass, bent both ways, and one region beside them."""
    return [
        wave("a", curvature=curvature),
        wave("b", x=230.0, curvature=-curvature, yaw_deg=-80.0, length_m=9.0, radius_m=60.0, amplitude_m=0.2),
        wave("c", y=110.0, curvature=0.0, yaw_deg=170.0, length_m=44.0, radius_m=120.0),
        wave("d", x=150.0, curvature=0.3, length_m=6.0, radius_m=50.0, amplitude_m=0.15, falloff=0.2),
        wave("e", x=90.0, y=60.0, ring=True, inverted=True, length_m=7.0, radius_m=40.0, amplitude_m=0.2),
    ]


def region(**fields):
    return SwellRegion(**{"id": "region-1", "x": 250.0, "y": 160.0, "radius_m": 110.0, **fields})


@pytest.mark.parametrize("curvature", [-1.0, -0.4, 0.0, 0.6, 1.0])
def test_the_bent_coordinate_has_its_exact_gradient(curvature):
    """H09: gradient by differences; ±1 are rings about a centre behind or before the object, 0 is straight."""
    thing = wave(curvature=curvature)
    fronts = object_fronts(thing, 3)
    at = np.random.default_rng(1).uniform(-60, 60, (2, 500)) + np.array([[thing.x], [thing.y]])
    lead = fronts.east[0], fronts.north[0]

    def q(x, y):
        return front_coordinate(thing, *lead, Dual(x, 1.0, 0.0), Dual(y, 0.0, 1.0))

    here, h = q(*at), 1e-4
    east = (q(at[0] + h, at[1])[0].v - q(at[0] - h, at[1])[0].v) / (2 * h)
    north = (q(at[0], at[1] + h)[0].v - q(at[0], at[1] - h)[0].v) / (2 * h)
    for got, want in ((here[0].dx, east), (here[0].dy, north), (here[1].v, east), (here[2].v, north)):
        np.testing.assert_allclose(got + 0 * want, want, atol=1e-7)
    assert q(np.array([thing.x]), np.array([thing.y]))[0].v == pytest.approx(0.0, abs=1e-12)
    side = np.sign(curvature) * 1.2 * thing.radius_m
    if abs(curvature) == 1:
        away = np.hypot(at[0] - thing.x + side * lead[0], at[1] - thing.y + side * lead[1])
        np.testing.assert_allclose(here[0].v, curvature * (away - 1.2 * thing.radius_m), atol=1e-9)
    if curvature == 0:
        np.testing.assert_allclose(here[0].v, (at[0] - thing.x) * lead[0] + (at[1] - thing.y) * lead[1], atol=1e-9)


def test_crests_travel_the_way_the_object_looks_at_the_speed_of_deep_water():
    """H08: the lead front's crest moves along the yaw by √(g λ / 2π) × speed a second, at the middle and beside it."""
    thing = wave(curvature=0.7, speed=1.3, lateral=0.0)
    way, across = np.array([np.sin(np.radians(33)), np.cos(np.radians(33))]), np.array([np.cos(np.radians(33)), -0.545])
    fronts = object_fronts(thing, 3)
    lead = dataclasses.replace(fronts, amplitude_m=fronts.amplitude_m * [1, 0, 0])
    assert (lead.east[0], lead.north[0]) == pytest.approx(tuple(way))
    speed = 1.3 * np.sqrt(9.81 * thing.length_m / (2 * np.pi))
    for beside in (0.0, 25.0, -30.0):
        x, y = (thing.x, thing.y) + across * beside
        q, gx, gy = front_coordinate(thing, *way, Dual(np.array([x]), 1.0, 0.0), Dual(np.array([y]), 0.0, 1.0))
        # where a crest at q goes in dt: by speed along the gradient, less than one where straight and ring are blended
        slope = np.hypot(gx.v, gy.v)
        dt = 0.01
        later = front_coordinate(
            thing, *way, Dual(x + gx.v / slope**2 * speed * dt), Dual(y + gy.v / slope**2 * speed * dt)
        )[0]
        assert float(later.v[0] - q.v[0]) == pytest.approx(speed * dt, rel=1e-3)
    assert fronts.omega[0] * thing.length_m / (2 * np.pi) == pytest.approx(speed)


def test_rings_run_out_from_their_middle_and_inverted_ones_have_round_tops():
    """H32: heights depend on the distance alone; upside down the hollows are sharper than the tops."""
    level = deep_level(wave(ring=True, lateral=1.0, length_m=9.0), swell_m=0.0, chop_m=0.0)
    turn = np.linspace(0, 2 * np.pi, 25)
    heights = sea_at(level, 2.0, 190 + 30 * np.cos(turn), 150 + 30 * np.sin(turn)).height_m
    assert np.ptp(heights) < 1e-6
    r = np.linspace(25, 40, 600)
    upright = sea_at(level, 2.0, 190 + r, np.full(r.shape, 150.0)).height_m
    level.put_object("wave-1", wave(ring=True, lateral=1.0, length_m=9.0, inverted=True))
    round_tops = sea_at(level, 2.0, 190 + r, np.full(r.shape, 150.0)).height_m
    assert ((upright - upright.mean()) ** 3).mean() > 0 > ((round_tops - round_tops.mean()) ** 3).mean()
    assert sea_at(level, 2.0, np.array([190.0]), np.array([150.0])).height_m[0] == pytest.approx(0, abs=1e-6)


def test_an_object_adds_its_waves_within_its_circle_alone():
    """H08: bit for bit the sea without it outside; up to its amplitude at the middle; weight falls from 1 to 0."""
    thing = wave()
    x, y = np.meshgrid(np.linspace(5, 395, 90), np.linspace(5, 295, 70))
    with_it, without = (surface_at(deep_level(*things), 4.0, x, y) for things in ((thing,), ()))
    outside = np.hypot(x - thing.x, y - thing.y) >= thing.radius_m
    assert np.array_equal(with_it.height_m[outside], without.height_m[outside])
    assert np.array_equal(with_it.normal[outside], without.normal[outside])
    more = np.abs(with_it.height_m - without.height_m)[~outside]
    assert 0.5 * thing.amplitude_m < more.max() < 1.3 * thing.amplitude_m  # the swell shifts too: it rides on it
    along = np.linspace(0, thing.radius_m, 200)
    weight = circle_weight(thing, thing.x + along, np.full(200, thing.y)).v
    assert weight[0] == 1
    assert weight[-1] == 0
    assert np.all(np.diff(weight) <= 0)
    assert np.abs(np.diff(weight)).max() < 0.02


def test_fronts_take_their_place_by_wavelength():
    """H06, H08: short fronts go with the chop and are left out with it; long ones with the swell."""
    sea = deep_level().settings.sea
    assert [wave_pass(sea, length) for length in (2.0, 7.5, 17.0, 20.0, 46.0, 300.0)] == [HIGH] * 3 + [LOW] * 3
    x = np.linspace(150, 230, 300)
    for length, stays in ((6.0, False), (30.0, True)):
        alone, whole = (
            surface_at(deep_level(*things, swell_m=0.0, chop_m=0.0), 3.0, x, x - 40, skip_chop=True).height_m
            for things in ((), (wave(length_m=length),))
        )
        assert (np.abs(whole - alone).max() > 0.1) == stays


def test_lists_of_neighbouring_patches_agree_at_their_border():
    """H08: along every border the objects that only one side lists weigh exactly nothing: no crack."""
    things = crowd()
    lists = patch_lists(things)
    part = np.linspace(0, PATCH_M, 400)
    compared = 0
    for col, row in [(c, r) for c in range(5) for r in range(4)]:
        here = {t.id for t in lists.get((col, row), ())}
        for other, x, y in (
            ((col - 1, row), np.full(400, col * PATCH_M), row * PATCH_M + part),
            ((col, row - 1), col * PATCH_M + part, np.full(400, row * PATCH_M)),
        ):
            for name in here ^ {t.id for t in lists.get(other, ())}:
                thing = next(t for t in things if t.id == name)
                assert np.all(circle_weight(thing, x, y).v == 0)
                compared += 1
    assert compared > 10
    on_some = {at for thing in things for at in hectares(thing)}
    x, y = np.random.default_rng(3).uniform((0, 0), (400, 300), (4000, 2)).T
    for at in {(int(a // PATCH_M), int(b // PATCH_M)) for a, b in zip(x, y, strict=True)} - on_some:
        inside = (x // PATCH_M == at[0]) & (y // PATCH_M == at[1])
        assert all(np.all(circle_weight(t, x[inside], y[inside]).v == 0) for t in things)
    assert max(len(those) for those in lists.values()) == MOST_ON_PATCH


@pytest.mark.parametrize("curvature", [-1.0, 0.8])
def test_normals_include_objects_and_regions(curvature):
    """H08, H09, D32, H29: analytic normals within 0.5° of differences."""
    level = deep_level(*crowd(curvature), region(turn_deg=40.0, length=0.8, amplitude=1.7))
    at = np.random.default_rng(1).uniform((100, 60), (320, 240), (3000, 2)).T
    h = 1e-4

    def point(x, y):
        sample = surface_at(level, 7.3, x, y)
        return np.stack([sample.x, sample.y, sample.height_m], -1)

    east = point(at[0] + h, at[1]) - point(at[0] - h, at[1])
    north = point(at[0], at[1] + h) - point(at[0], at[1] - h)
    normal = np.cross(east, north)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    cosine = np.clip((surface_at(level, 7.3, *at).normal * normal).sum(-1), -1, 1)
    assert np.degrees(np.arccos(cosine)).max() < 0.5


def test_the_sea_is_never_higher_than_it_says():
    """H08, D32: largest_height_m holds with objects and regions on each other."""
    level = deep_level(*crowd(), region(amplitude=2.5), swell_m=1.0)
    x, y = np.meshgrid(np.linspace(100, 340, 160), np.linspace(60, 240, 120))
    highest = max(np.abs(surface_at(level, t, x, y).height_m).max() for t in (0.0, 2.3, 5.1))
    assert 2.0 < highest <= largest_height_m(level)
    assert largest_height_m(deep_level(swell_m=1.0)) < highest


def test_a_region_without_changes_is_the_sea_itself():
    """D32: all factors 1 and no turn: to rounding the same surface; nothing is torn at its edge."""
    x, y = np.meshgrid(np.linspace(150, 350, 80), np.linspace(60, 260, 80))
    plain = surface_at(deep_level(), 5.0, x, y)
    same = surface_at(deep_level(region(amplitude=1.0)), 5.0, x, y)
    np.testing.assert_allclose(same.height_m, plain.height_m, atol=1e-9)
    outside = np.hypot(x - 250, y - 160) >= 110
    changed = surface_at(deep_level(region(amplitude=0.2, length=2.0, turn_deg=90.0)), 5.0, x, y)
    assert np.array_equal(changed.height_m[outside], plain.height_m[outside])
    assert np.abs(changed.height_m - plain.height_m)[~outside].max() > 0.2


def test_a_region_scales_turns_and_hastens_the_seas_own_fronts():
    """D32: amplitude, length, speed and direction by their factors; phase at its middle is the sea's own at t = 0."""
    level = deep_level(swell_steepness=0.2)
    low = groups(level.settings.sea, level.settings.level.seed)[1]
    there = region_fronts(low, region(amplitude=1.5, length=2.0, speed=0.5, turn_deg=30.0))
    turned = np.degrees(np.arctan2(there.east, there.north) - np.arctan2(low.east, low.north)) % 360
    np.testing.assert_allclose(turned, 30.0, atol=1e-9)
    np.testing.assert_allclose(there.amplitude_m, 1.5 * low.amplitude_m)
    np.testing.assert_allclose(there.length_m, 2 * low.length_m)
    np.testing.assert_allclose(there.omega, 0.5 * low.omega / np.sqrt(2))
    own = (low.east * 250 + low.north * 160) / low.length_m
    new = (there.east * 250 + there.north * 160) / there.length_m + ahead(low, there, region())
    np.testing.assert_allclose(np.cos(2 * np.pi * (own - new)), 1.0, atol=1e-9)
    calm = deep_level(region(amplitude=0.0), chop_m=0.0)
    assert surface_at(calm, 3.0, np.array([250.0]), np.array([160.0])).height_m[0] == 0


def test_objects_come_in_nearer_to_the_shore_than_the_open_sea():
    """H08, D11: in three amplitudes of water over the start they stand whole; where none is left they are nothing."""
    heights = {}
    for things in ((), (wave(x=80.0, y=170.0, yaw_deg=0.0, curvature=0.0, lateral=0.0, amplitude_m=0.5),)):
        level = make_beach(rows=401, slope=0.05)
        for name, value in (("swell_m", 0.0), ("chop_m", 0.0), ("deep_full_m", 12.0)):
            level.set(f"sea.{name}", value)
        level.set("shore.on", False)
        for thing in things:
            level.put_object(thing.id, thing)
        y = np.linspace(100, 198, 2000)
        heights[len(things)] = np.max(
            [np.abs(surface_at(level, t, np.full(2000, 80.0), y).height_m) for t in np.linspace(0, 4, 30)], axis=0
        )
    depth = (200 - y) * 0.05
    whole = (depth > level.settings.sea.deep_start_m + 1.6) & (y > 155)
    assert heights[0].max() == 0
    assert heights[1][whole].min() > 0.25
    assert heights[1][depth < level.settings.sea.deep_start_m - 0.2].max() == 0


def test_world_points_are_inverted_with_objects_too():
    """D30: asking at the world xy a point was carried to gives its height back."""
    level = deep_level(*crowd(), region(turn_deg=20.0))
    x, y = np.random.default_rng(5).uniform((110, 70), (310, 230), (1000, 2)).T
    carried = surface_at(level, 4.0, x, y)
    back = sea_at(level, 4.0, carried.x, carried.y)
    assert np.abs(back.height_m - carried.height_m).max() < 1e-3


def test_without_objects_the_programs_are_what_they_were():
    """H08, D32: each kind asks for its define, none for none."""
    assert wave_defines(deep_level()) == {}
    assert set(wave_defines(deep_level(wave()))) == {"WAVE_OBJECTS"}
    assert set(wave_defines(deep_level(wave(), region()))) == {"WAVE_OBJECTS", "WAVE_REGIONS"}


def test_seeds_differ_and_names_do_not():
    """H08: a renamed object makes the same waves, another seed others; its lead is what was asked for."""
    one, same, other = (object_fronts(wave(name, seed=seed), 3) for name, seed in (("a", 0), ("b", 0), ("a", 1)))
    assert np.array_equal(one.length_m, same.length_m)
    assert not np.array_equal(one.length_m, other.length_m)
    assert one.length_m[0] == other.length_m[0] == wave().length_m
    still = Dual(np.zeros(3), 1.0, 0.0), Dual(np.zeros(3), 0.0, 1.0)
    first, later = (object_shift(wave(speed=0.0), 3, t, *still)[2].v for t in (0.0, 9.0))
    assert np.array_equal(first, later)


@pytest.mark.parametrize("length", [2.0, 8.0, 60.0])
def test_no_object_folds_its_crests(length):
    """H08: however steep and high, alone its waves never overtake themselves: each point of the world is met once."""
    level = deep_level(wave(amplitude_m=4.0, lateral=1.0, length_m=length), swell_m=0.0, chop_m=0.0)
    along = np.linspace(-60, 60, 6000)
    way = np.sin(np.radians(33)), np.cos(np.radians(33))
    sample = surface_at(level, 2.0, 190 + along * way[0], 150 + along * way[1])
    met = sample.x * way[0] + sample.y * way[1]
    assert np.diff(met).min() > 0


@pytest.mark.gl
@pytest.mark.parametrize("t", [0.0, WEEK])
@pytest.mark.parametrize("kinds", ["objects", "regions", "both"])
def test_shader_and_twin_agree_within_a_millimetre(ctx, kinds, t):
    """H08, H09, D32, D30: 10,000 points through transform feedback, at t = 0 and after a week."""
    things = crowd() if kinds != "regions" else []
    if kinds != "objects":
        things += [region(turn_deg=70.0, length=1.3, speed=0.7), region(id="r2", x=120.0, radius_m=90.0, amplitude=0.3)]
    level = deep_level(*things)
    at = np.random.default_rng(9).uniform((0, 0), (400, 300), (10_000, 2)).astype(np.float32)
    got = feedback(ctx, level, t, at)
    want = surface_at(level, t, at[:, 0].astype(np.float64), at[:, 1].astype(np.float64))
    assert np.abs(got[:, 2] - want.height_m).max() < 1e-3
    assert np.abs(got[:, 0] - want.x).max() < 1e-3
    assert np.abs(got[:, 1] - want.y).max() < 1e-3
    assert np.abs(got[:, 7] - want.normal[:, 0]).max() < 2e-3
    plain = surface_at(deep_level(), t, at[:, 0].astype(np.float64), at[:, 1].astype(np.float64))
    assert np.abs(want.height_m - plain.height_m).max() > 0.3
