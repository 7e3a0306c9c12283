"""Regions of swell with an outline of points (D32), and what travel time makes of regions."""

import numpy as np
import pytest
from coasts import make_beach
from hypothesis import given, settings
from hypothesis import strategies as st
from points import feedback
from shorewright.app import wave_gizmo
from shorewright.app.object_markers import outlines
from shorewright.app.session import Session
from shorewright.app.tools import SELECT
from shorewright.io.package import read_level, write_level
from shorewright.level import BadInput
from shorewright.level.objects import SwellRegion
from shorewright.level.outline import (
    band_m,
    deepest_m,
    edges_of,
    inside_m,
    reach_m,
    region_weight,
    ring,
    with_point,
    without_point,
)
from shorewright.level.waves import surface_at

HOOK = (-80.0, -50.0, 90.0, -60.0, 100.0, 70.0, 20.0, 60.0, 30.0, -5.0, -40.0, 0.0, -60.0, 80.0)


def region(**fields):
    return SwellRegion(**{"id": "r", "x": 250.0, "y": 160.0, "outline": HOOK, "amplitude": 2.0, **fields})


def deep_level(*things, **values):
    """Twenty metres of water, 500 × 320 m."""
    level = make_beach(rows=81, cols=126, cell_m=4.0, slope=0.0)
    level.write("height", level.grid.rect, -20.0)
    for path, value in values.items():
        level.set(path.replace("__", "."), value)
    for thing in things:
        level.put_object(thing.id, thing)
    return level


def test_by_an_edge_it_is_the_distance_and_it_tells_inside_from_outside():
    """D32: 2 / W against shapely's distance and sign."""
    import shapely

    shape = shapely.Polygon(np.array(HOOK).reshape(-1, 2))
    x, y = np.random.default_rng(1).uniform(-140, 140, (2, 3000))
    found, points = inside_m(edges_of(HOOK), x, y).v, shapely.points(x, y)
    assert np.array_equal(found > 0, shapely.contains(shape, points))
    away = shapely.distance(shape.exterior, points)
    corner = shapely.distance(shapely.MultiPoint(shape.exterior.coords), points)
    near = (away < 1.0) & (corner > 20)
    assert near.sum() > 20
    assert np.abs(found)[near] == pytest.approx(away[near], rel=0.1)
    hull = shapely.distance(shape.convex_hull, points)
    assert (-found[hull > 0] >= hull[hull > 0] - 1e-6).all()  # nothing reaches farther than `reach_m` says


def test_the_weight_has_its_exact_gradient_and_no_creases():
    """H29, D32: by differences; the gradient itself doesn't jump, as that of a plain distance would."""
    thing, h = region(falloff=0.8, outside=0.3), 1e-4
    x, y = np.random.default_rng(2).uniform(-120, 120, (2, 4000)) + np.array([[thing.x], [thing.y]])
    here, east, north = (region_weight(thing, *at) for at in ((x, y), (x + h, y), (x, y + h)))
    assert (east.v - here.v) / h == pytest.approx(here.dx, abs=2e-4)
    assert (north.v - here.v) / h == pytest.approx(here.dy, abs=2e-4)
    across = np.linspace(-100, 120, 8001)
    along = region_weight(thing, thing.x + across, np.full_like(across, thing.y - 30.0))
    assert np.abs(np.diff(along.dx)).max() < 2e-3
    assert along.v.max() > 0.9
    assert np.all(region_weight(thing, thing.x + 1.01 * reach_m(thing), np.array([thing.y])).v == 0)


@settings(max_examples=40, deadline=None)
@given(st.floats(0.05, 1), st.floats(0, 1), st.booleans())
def test_any_band_holds_its_two_ends(falloff, outside, turned):
    """D32: 0 at the outer end, 1 at the inner, the same whichever way round the points go."""
    points = np.array(HOOK).reshape(-1, 2)
    thing = region(
        falloff=falloff, outside=outside, outline=tuple((points[::-1] if turned else points).ravel().tolist())
    )
    x, y = np.meshgrid(np.linspace(100, 400, 41), np.linspace(30, 300, 41))
    weight, inside = region_weight(thing, x, y).v, inside_m(edges_of(HOOK), x - thing.x, y - thing.y).v
    beyond, within = band_m(thing)
    assert beyond + within == pytest.approx(falloff * deepest_m(HOOK))
    assert np.all(weight[inside <= -beyond - 1e-9] == 0)
    assert np.all(weight[inside >= within + 1e-9] == 1)


def test_a_circle_may_fade_outwards_too():
    """D32: `outside` 0 is the circle that was; at 1 all of it lies beyond."""
    x = np.linspace(250.0, 500.0, 200)
    plain, out = (
        region_weight(region(outline=(), radius_m=100.0, outside=o), x, np.full_like(x, 160.0)).v for o in (0, 1)
    )
    assert plain[x > 350].max() == 0
    assert out[x < 350].min() == 1
    assert out[x > 411].max() == 0


def test_what_is_no_outline_is_refused():
    """D32: one clear sentence each."""
    for outline in (
        (0.0, 0.0, 1.0, 1.0),
        (0.0,) * 7,
        tuple(range(34)),
        (0, 0, 50, 50, 50, 0, 0, 50),
        (0, 0, 9, 0, 18, 0),
    ):
        with pytest.raises(ValueError, match="outline"):
            region(outline=tuple(float(value) for value in outline))


@pytest.mark.parametrize("count", [3, 4, 8, 16])
def test_the_middle_of_a_ring_has_all_the_weight(count):
    """D32: the deepest place of an outline is its middle, never a corner that a sample falls on; W there is 2π / R."""
    outline = ring(count, 100.0)
    middle = inside_m(edges_of(outline), np.array([0.0]), np.array([0.0])).v[0]
    assert deepest_m(outline) == pytest.approx(middle, rel=0.02)
    assert middle < 100 / np.pi + 1e-6
    thing = region(outline=outline, falloff=0.9)
    assert region_weight(thing, np.array([thing.x]), np.array([thing.y])).v[0] == 1.0


def test_points_come_and_go():
    outline = ring(8, 100.0)
    assert len(outline) == 16
    assert with_point(outline, 2, (1.0, 2.0))[4:6] == (1.0, 2.0)
    more = with_point(outline, 7, (1.0, 2.0), new=True)
    assert len(more) == 18
    assert more[16:] == (1.0, 2.0)
    assert without_point(more, 8) == outline


@pytest.mark.gl
@pytest.mark.parametrize("source", ["depth", "travel_time"])
def test_shader_and_twin_agree_within_a_millimetre(ctx, source):
    """D30, D32: outlines and circles, swells that keep their times and others."""
    things = (
        region(outside=0.4),
        region(id="s", x=120.0, amplitude=1.0, turn_deg=60.0, outline=ring(5, 70.0), falloff=0.3),
    )
    level = deep_level(*things, region(id="t", outline=(), outside=0.5, amplitude=0.3, x=380.0), timing__source=source)
    at = np.random.default_rng(5).uniform(0, 500, (6000, 2)).astype(np.float32)
    got, want = feedback(ctx, level, 6.0, at), surface_at(level, 6.0, *at.astype(np.float64).T)
    assert np.abs(got[:, 2] - want.height_m).max() < 1e-3
    assert np.abs(got[:, 7] - want.normal[:, 0]).max() < 5e-3


def test_higher_swells_keep_their_times_of_arrival():
    """D32, T06: a region of twice the height is the same swell, twice as high; a turned one is another."""
    calm = {"timing__source": "travel_time", "sea__chop_m": 0.0, "sea__swell_steepness": 0.0, "shore__on": False}
    x, y = np.meshgrid(np.linspace(210, 290, 30), np.linspace(115, 130, 10))  # where it has all its weight
    plain, high, turned = (
        surface_at(deep_level(region(falloff=0.05, **fields), **calm), 7.0, x, y).height_m
        for fields in ({"amplitude": 1.0}, {"amplitude": 2.0}, {"amplitude": 2.0, "turn_deg": 40.0})
    )
    assert high == pytest.approx(2 * plain, abs=1e-6)
    assert np.corrcoef(turned.ravel(), plain.ravel())[0, 1] < 0.9


def test_points_are_dragged_put_in_and_joined_in_one_step(tmp_path):
    """D32: handles of an outline; a drag is one step of undo, and what would cross itself is refused."""
    level = deep_level()
    session = Session(level)
    session.place(region())
    session.selected, session.tool = "r", SELECT
    thing = session.level.objects["r"]
    found = wave_gizmo.handles(level, thing)
    assert {"aim", "point 0", "point 6", "between 6"} <= set(found)
    assert "size" not in found
    moved = wave_gizmo.dragged(level, thing, "point 1", thing.x + 120.0, thing.y - 70.0)["outline"]
    assert moved == with_point(HOOK, 1, (120.0, -70.0))
    more = wave_gizmo.dragged(level, thing, "between 6", thing.x - 110.0, thing.y + 10.0)["outline"]
    assert len(more) == len(HOOK) + 2
    assert more[-2:] == (-110.0, 10.0)
    less = wave_gizmo.dragged(level, thing, "point 2", thing.x + 90.0, thing.y - 55.0)["outline"]
    assert less == without_point(HOOK, 2)
    with pytest.raises(BadInput, match="cross"):
        session.alter("r", {"outline": with_point(HOOK, 2, (-100.0, 0.0))}, True)
    steps = len(session.journal.done)
    session.alter("r", {"outline": moved}, True)
    session.alter("r", {"outline": more}, True)
    session.seal()
    assert len(session.journal.done) == steps + 1
    assert len(wave_gizmo.lines(level, thing, 0.0)) >= 3
    assert len(outlines(level, thing)) == 1


def test_an_outline_is_kept_in_the_file(tmp_path):
    """T08, D32: written and read back, the circle's default left out of no file."""
    level = deep_level(region())
    write_level(level, tmp_path / "a.shore")
    assert read_level(tmp_path / "a.shore").objects["r"] == level.objects["r"]
