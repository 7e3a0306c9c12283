"""The brush table, footprints and paths (T01): what a dab covers and where dabs fall."""

import math
import subprocess
import sys
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shorewright.brushes import BRUSHES
from shorewright.brushes.footprint import Link, Round, Strip
from shorewright.brushes.path import AlongPath, Bounds, LinePath, Sample
from shorewright.level import LAYERS, BadInput, Grid, Rect
from shorewright.level.params import describe

EVERYWHERE = Bounds(-1e12, -1e12, 1e12, 1e12)


@pytest.mark.parametrize("brush", BRUSHES.values(), ids=BRUSHES)
def test_a_row_is_complete(brush):
    """T01: every brush has what the bar, the keys and the manual need."""
    assert BRUSHES[brush.name] is brush
    assert brush.layer in LAYERS
    assert brush.doc.endswith(".")
    assert brush.inverse
    rows = {row.name: row for row in describe(brush.params)}
    assert {"size_m", "strength", "falloff", "spacing", "opacity"} <= set(rows)
    for row in rows.values():
        assert row.doc.endswith(".")
        assert row.kind in ("choice", "bool", "text") or row.low <= row.default <= row.high


def test_the_brushes_have_their_own_keys():
    assert list(BRUSHES) == ["raise", "lower", "smooth", "flatten", "ramp", "rocks", "driftwood", "tufts", "weather",
                             "paint", "flow", "water"]  # fmt: skip
    assert len({brush.key for brush in BRUSHES.values()}) == len(BRUSHES)


@pytest.mark.parametrize(
    "values", [{"size_m": -1}, {"size_m": math.nan}, {"opacity": 2}, {"colour": 1}, {"strength": "x"}]
)
def test_bad_parameters_are_one_sentence(values):
    with pytest.raises(BadInput, match=next(iter(values))):
        BRUSHES["raise"].with_params(values)


def test_listing_brushes_loads_nothing_heavy():
    code = "import sys, shorewright.brushes; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert "shorewright.brushes" in loaded
    assert not {"scipy", "OpenImageIO", "moderngl", "trimesh", "pyvista", "imgui_bundle"} & set(loaded)


# Footprints


def weigh(footprint, link, rect):
    out, *spare = (np.empty(rect.shape, np.float32) for _ in range(3))
    return footprint.weights(link, rect, out, *spare)


def plain_round(radius, falloff, link, rect, places=2000):
    """Discs at many places of a link, the greatest of pressure times weight: float64, no geometry but the distance."""
    soft = max(radius * falloff, 1.0)
    rows, cols = np.mgrid[rect.row0 : rect.row1, rect.col0 : rect.col1]
    weights = np.zeros(rect.shape)
    for share in np.linspace(0, 1, places if link.length else 1):
        row, col = link.row0 + (link.row1 - link.row0) * share, link.col0 + (link.col1 - link.col0) * share
        t = np.clip((np.hypot(rows - row, cols - col) - (radius - soft)) / soft, 0, 1)
        pressure = link.pressure0 + (link.pressure1 - link.pressure0) * share
        np.maximum(weights, (1 - t * t * (3 - 2 * t)) * pressure, out=weights)
    return weights


LINKS = [Link(20.3, 21.7, 20.3, 21.7), Link(10.2, 12.9, 28.4, 30.1), Link(30.5, 9.5, 8.25, 25.0, 0.2, 0.9)]


@pytest.mark.parametrize("link", LINKS, ids=["dab", "way", "pressed"])
@pytest.mark.parametrize("falloff", [0.0, 0.4, 1.0])
def test_a_round_dab_is_measured_from_its_true_centre(link, falloff):
    """And drawn out it is what discs at every place of the way would give, with the pressure they have there."""
    rect = Rect(0, 0, 40, 44)
    ours, plain = weigh(Round(9.6, falloff), link, rect), plain_round(9.6, falloff, link, rect)
    np.testing.assert_allclose(ours, plain, atol=1e-5 if link.pressure0 == link.pressure1 else 0.04)


@pytest.mark.parametrize("footprint", [Round, Strip])
@pytest.mark.parametrize("link", LINKS, ids=["dab", "way", "pressed"])
def test_weights_are_the_same_bytes_in_any_block(footprint, link):
    footprint = footprint(9.6, 0.5)
    whole = weigh(footprint, link, Rect(0, 0, 40, 44))
    for part in (Rect(0, 0, 17, 44), Rect(17, 0, 40, 13), Rect(17, 13, 40, 44)):
        assert weigh(footprint, link, part).tobytes() == whole[part.slices].tobytes()


@pytest.mark.parametrize("footprint", [Round, Strip])
@pytest.mark.parametrize("link", LINKS, ids=["dab", "way", "pressed"])
def test_nothing_is_weighed_outside_the_rectangle(footprint, link):
    footprint, grid = footprint(6.3, 0.8), Grid(64, 64)
    weights = weigh(footprint, link, grid.rect)
    inside = footprint.rect(link, grid)
    outside = weights.copy()
    outside[inside.slices] = 0
    assert not outside.any()
    assert weights[inside.slices].max() > 0.15
    for tile in (Rect(r, c, r + 8, c + 8) for r in range(0, 64, 8) for c in range(0, 64, 8)):
        if footprint.misses(link, tile):
            assert not weights[tile.slices].any()


@given(st.floats(0, 31), st.floats(0, 31), st.floats(0.001, 2), st.floats(0, 1))
def test_a_radius_below_a_cell_still_finds_the_nearest(row, col, radius, falloff):
    weights = weigh(Round(radius, falloff), Link(row, col, row, col), Rect(0, 0, 32, 32))
    assert weights[round(row), round(col)] == weights.max() > 0.15


def test_a_strip_is_full_between_its_ends_and_fades_beside_and_beyond():
    weights = weigh(Strip(10, 0.5), Link(30, 20, 30, 60), Rect(0, 0, 60, 80))
    assert (weights[25:36, 20:61] > 1 - 1e-6).all()
    assert weights[30, 61] < 1
    assert weights[30, 65] == 0
    assert 0 < weights[22, 40] < 1
    assert weights[20, 40] == 0


# Paths


def walk(samples, spacing=2.0, bounds=EVERYWHERE):
    path = AlongPath(spacing, 0.1, bounds)
    dabs = list(path.begin(samples[0]))
    for sample in samples[1:]:
        dabs += path.move(sample)
    return dabs + list(path.end())


def test_a_click_is_one_dab():
    assert walk([Sample(3, 4, 0.5)]) == [(Sample(3, 4, 0.5), Sample(3, 4, 0.5))]
    assert len(walk([Sample(3, 4), Sample(3, 4), Sample(3, 4)])) == 1


def test_dabs_fall_by_distance_and_join_up():
    dabs = walk([Sample(0, 0, 0.0), Sample(11, 0, 1.0)])
    assert [dab.end.x for dab in dabs] == pytest.approx([0, 2, 4, 6, 8, 10, 11])
    assert [dab.end.pressure for dab in dabs] == pytest.approx([x / 11 for x in (0, 2, 4, 6, 8, 10, 11)])
    assert all(here.end == then.start for here, then in pairwise(dabs))


@given(st.lists(st.floats(0.001, 0.999), max_size=40), st.floats(0.3, 30), st.floats(-50, 50), st.floats(-50, 50))
def test_dabs_do_not_depend_on_the_event_rate(shares, spacing, x, y):
    """A pointer asked often or seldom draws the same stroke (complaint 7 of the research)."""
    start, end = Sample(7, -3, 0.2), Sample(x, y, 0.9)
    between = [Sample(*(a + (b - a) * share for a, b in zip(start, end, strict=True))) for share in sorted(shares)]
    seldom, often = walk([start, end], spacing), walk([start, *between, end], spacing)
    way = math.hypot(x - 7, y + 3)
    if min(way % spacing, -way % spacing) > 1e-6:  # else rounding decides whether the last dab is the rest
        assert len(seldom) == len(often)
    np.testing.assert_allclose(seldom[-1].end, often[-1].end, atol=1e-6)
    for one, other in zip(seldom[:-1], often[:-1], strict=False):
        np.testing.assert_allclose(one.end, other.end, atol=1e-6)


def test_a_way_far_outside_costs_nothing_and_keeps_the_rhythm():
    bounds = Bounds(-5, -5, 25, 25)
    samples = [Sample(10, 10), Sample(1e9, 10), Sample(1e9, 5e8), Sample(10.5, 12)]
    dabs = walk(samples, 2.0, bounds)
    assert len(dabs) < 60
    assert [dab.end.x for dab in dabs[:8]] == pytest.approx([10, 12, 14, 16, 18, 20, 22, 24])
    short, long = walk([Sample(-40, 3), Sample(60, 3)], 2.0, bounds), walk([Sample(-40, 3), Sample(60, 3)], 2.0)
    inside = [dab for dab in long if -5 <= dab.end.x <= 25]
    assert all(dab in short for dab in inside)


def test_a_line_is_replaced_by_each_move():
    path = LinePath(0.5, 1.0, EVERYWHERE)
    assert list(path.begin(Sample(0, 0))) == []
    assert list(path.move(Sample(3, 0))) == [(Sample(0, 0), Sample(3, 0))]
    assert list(path.move(Sample(5, 1))) == [(Sample(0, 0), Sample(5, 1))]
    assert list(path.move(Sample(0.1, 0))) == []
