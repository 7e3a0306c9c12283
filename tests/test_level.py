"""Grid, rectangles, parameters, dirty rectangles, clock, walkable depth: the document itself (T05, D31)."""

import numpy as np
import pytest
from coasts import make_beach
from hypothesis import given
from hypothesis import strategies as st
from shorewright.level import LAYERS, SECTOR, TILE, BadInput, Clock, Grid, Level, Rect, Settings
from shorewright.level.level import cover, merge
from shorewright.level.params import describe, get, replace
from shorewright.level.walk import walkable

sides = st.integers(2, 3000)
cells = st.integers(-50, 3050)


@given(sides, sides)
def test_tiles_and_sectors_cover_the_grid_once(rows, cols):
    """Every cell lies in one tile and one sector; the last sector takes the closing row and column."""
    grid = Grid(rows, cols)
    assert sum(grid.tile_rect(tile).cells for tile in grid.tiles(grid.rect)) == rows * cols
    assert sum(grid.sector_rect(sector).cells for sector in grid.sectors()) == rows * cols
    last = grid.sector_rect((grid.sector_shape[0] - 1, grid.sector_shape[1] - 1))
    assert (last.row1, last.col1) == (rows, cols)


def test_a_size_of_one_sector_and_a_row_is_one_sector():
    assert Grid(SECTOR + 1, SECTOR + 1).sector_shape == (1, 1)
    assert Grid(2 * SECTOR + 1, SECTOR + 2).sector_shape == (2, 2)
    assert TILE * 8 == SECTOR


@given(st.lists(st.tuples(cells, cells, st.integers(1, 40), st.integers(1, 40)), max_size=40))
def test_merged_rectangles_cover_what_went_in(parts):
    rects = [Rect(r, c, r + h, c + w) for r, c, h, w in parts]
    merged = merge(rects)
    assert len(merged) <= 16
    for rect in rects:
        assert any(m.intersect(rect) == rect for m in merged)


@given(st.floats(-10, 300), st.floats(-10, 300), st.floats(0, 90))
def test_a_rectangle_along_nothing_holds_every_cell_of_the_disc(x, y, radius):
    grid = Grid(200, 260, 1.5)
    rect = grid.rect_along(*grid.to_cells(x, y), *grid.to_cells(x, y), radius / grid.cell_m)
    rows, cols = np.mgrid[0:200, 0:260]
    touched = np.hypot(rows * 1.5 - y, cols * 1.5 - x) <= radius * (1 - 1e-9)
    inside = np.zeros(grid.shape, bool)
    if not rect.empty:
        inside[rect.slices] = True
    assert not (touched & ~inside).any()


def test_readers_learn_the_rectangles_newer_than_what_they_hold():
    level = make_beach()
    seen = level.revision
    level.write("height", Rect(3, 4, 9, 12), 1.0)
    level.write("height", Rect(60, 4, 70, 12), 1.0)
    assert level.changed_since("height", seen) == [Rect(3, 4, 9, 12), Rect(60, 4, 70, 12)]
    assert level.changed_since("height", level.revision) == []
    assert level.changed_since("foam", seen) == []


def test_a_reader_that_slept_gets_what_changed_and_one_that_holds_nothing_gets_everything():
    level = make_beach()
    seen = level.revision
    for i in range(600):
        level.write("foam", Rect(i % 100, 0, i % 100 + 1, 1), 0.5)
    assert level.changed_since("foam", seen) == [Rect(0, 0, 100, 1)]
    assert level.changed_since("foam", level.revision - 1) == [Rect(99, 0, 100, 1)]
    assert level.changed_since("foam", 0) == [level.grid.rect]


@given(st.lists(st.tuples(*[st.integers(0, 200)] * 2, *[st.integers(1, 90)] * 2), max_size=40))
def test_covering_rectangles_hold_every_changed_cell_once(parts):
    rects = [Rect(r, c, r + h, c + w) for r, c, h, w in parts]
    seen, sent = np.zeros((300, 300), bool), np.zeros((300, 300), int)
    covered = cover(rects)
    for rect in rects:
        seen[rect.slices] = True
    for rect in covered:
        sent[rect.slices] += 1
    assert len(covered) <= 64
    assert (sent[seen] == 1).all()
    assert sent.max(initial=0) <= 1


def test_a_slanting_stroke_is_not_its_bounding_box():
    """200 dabs of radius 128 across a 4097² level: at most half more than they touched, not four times (T08)."""
    rects = [Rect(200 + 9 * i, 300 + 9 * i, 457 + 9 * i, 557 + 9 * i) for i in range(200)]
    touched = 257 * 257 + 199 * (257 * 257 - 248 * 248)
    covered = cover(rects)
    assert sum(rect.cells for rect in covered) < 1.5 * touched
    assert merge(rects)[0].cells > 4 * touched


@pytest.mark.parametrize("name", LAYERS)
def test_a_layer_never_written_is_neutral_and_costs_nothing(name):
    level = make_beach()
    data = level.layers[name]
    assert data.neutral
    assert data.bytes == 0
    if name != "height":
        assert not data.read(data.grid.rect).any()
    level.write(name, Rect(1, 1, 3, 4), 0.3)
    assert data.written.sum() == 1
    assert np.all(data.read(Rect(1, 1, 3, 4)) == pytest.approx(0.3, abs=1e-6))


def test_height_is_base_plus_sculpt():
    """A re-import under the sculpt layer keeps the artist's work."""
    level = make_beach()
    level.write("height", Rect(10, 10, 20, 20), 4.0)
    height = level.layers["height"]
    assert np.allclose(height.base + height.sculpt, level.height, atol=1e-6)
    assert not height.sculpt[30:, 30:].any()


@pytest.mark.parametrize("row", describe(Settings), ids=lambda row: row.name)
def test_every_parameter_is_declared_whole(row):
    """One sentence, a range where it is a number, a default inside it, a soft range inside the hard one."""
    assert row.doc.endswith(".")
    if row.kind in ("float", "int"):
        assert row.low <= row.default <= row.high
        if row.soft:
            assert row.low <= row.soft[0] < row.soft[1] <= row.high
    settings = Settings()
    assert get(replace(settings, row.name, row.default), row.name) == row.default
    if row.kind in ("float", "int"):
        with pytest.raises(BadInput, match=row.name.split(".")[-1]):
            replace(settings, row.name, row.high + 1)


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), "much", None])
def test_a_setting_that_is_no_number_is_refused(bad):
    with pytest.raises(BadInput, match="swell_m"):
        replace(Settings(), "sea.swell_m", bad)


@pytest.mark.parametrize("shape", [(1, 10), (10, 1), (16386, 10)])
def test_grids_out_of_range_are_refused(shape):
    with pytest.raises(BadInput, match="samples"):
        Grid(*shape)


def test_a_base_that_does_not_fit_is_refused():
    with pytest.raises(BadInput, match="does not fit"):
        Level(Grid(10, 10), np.zeros((9, 10), np.float32))


def test_clock_runs_pauses_steps_and_loops():
    """T05: paused means no step; a step lands on the grid of steps; a loop comes round."""
    clock = Clock(step_s=0.1)
    assert clock.advance(0.35) == 3
    clock.paused = True
    assert clock.advance(1.0) == 0
    assert clock.time_s == pytest.approx(0.35)
    clock.step()
    assert clock.time_s == pytest.approx(0.4)
    clock.step(-2)
    assert clock.time_s == pytest.approx(0.2)
    clock.loop, clock.paused = (2.0, 3.0), False
    clock.scrub(2.9)
    clock.advance(0.3)
    assert clock.time_s == pytest.approx(2.2)
    clock.rate = -1.0
    clock.advance(0.4)
    assert clock.time_s == pytest.approx(2.8)


@given(st.floats(allow_nan=True, allow_infinity=True))
def test_clock_never_leaves_the_numbers(value):
    clock = Clock()
    clock.scrub(value)
    clock.advance(value)
    assert clock.time_s >= 0
    assert np.isfinite(clock.time_s)


def test_walkable_is_wading_depth_and_slope():
    """D31: the navmesh view."""
    level = make_beach(slope=0.06)
    open_ground = walkable(level)
    depth = -level.height
    assert np.array_equal(open_ground, depth <= level.settings.walk.depth_m)
    level.set("walk.slope_deg", 2.0)
    assert not walkable(level).any()


@pytest.mark.parametrize(
    "rect", [Rect(0, 0, 1, 1), Rect(0, 30, 40, 161), Rect(50, 50, 51, 90), Rect(128, 160, 129, 161)]
)
def test_walkable_of_a_part_is_part_of_the_whole(rect):
    level = make_beach(rough_m=0.6)
    whole = walkable(level)
    assert 0.2 < whole.mean() < 0.8
    assert np.array_equal(walkable(level, rect), whole[rect.slices])
