"""The bytes of undo (T08): packing loses no bit, only what changed is kept, the budget holds."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from shorewright.level import LAYERS, TILE, Grid, Journal, Rect
from shorewright.level.tiles import Patch, Tiles, pack, unpack
from test_journal import do, new_level, state, write


@given(
    hnp.arrays(
        np.uint32,
        hnp.array_shapes(min_dims=1, max_dims=3, max_side=9),
        elements=st.one_of(st.integers(0, 2**32 - 1), st.sampled_from([0, 0x80000000, 0x3F800000, 0x7FC00000])),
    )
)
def test_packing_loses_no_bit(bits):
    values = bits.view(np.float32)
    assert unpack(pack(values), values.shape).tobytes() == values.tobytes()


def test_packing_nothing():
    assert pack(np.zeros((0,), np.float32)) == b""
    assert unpack(b"", (0,)).shape == (0,)


def noise_of(shape):
    return np.random.default_rng(1).normal(size=shape).astype(np.float32)


def test_only_cells_that_differ_are_kept():
    old = noise_of((TILE, TILE))
    new = old.copy()
    new[40:60, 30:50] += 1
    patch = Patch.between(old, new)
    assert patch.bytes < 20 * 20 * 4 + 400
    assert Patch.between(old, old + 1).bytes < 0.87 * old.nbytes, "of white noise little can be saved"
    smooth = np.add.outer(np.linspace(0, 2, TILE), np.linspace(0, 1, TILE) ** 2).astype(np.float32)
    assert Patch.between(smooth, smooth + 1).bytes < 0.5 * smooth.nbytes
    assert Patch.between(None, new).bytes < 200, "what was never written costs nothing"


@pytest.mark.parametrize("layer", ["height", "cover"])
@pytest.mark.parametrize("written", [False, True])
def test_a_whole_tile_can_be_handed_in(layer, written):
    """The recovery log makes atoms of packed tiles; None is a tile that was never written."""
    level = new_level()
    data = level.layers[layer]
    if written:
        level.write(layer, Rect(0, 0, 10, 10), 3.0)
    before = state(level)
    tile = noise_of(data.grid.tile_rect((0, 1)).shape + data.shape[2:])
    atom = Tiles(layer, {(0, 0): None, (0, 1): pack(tile)}, level.grid.rect)
    revision = level.revision
    atom.swap(level)
    assert data.tile((0, 0)) is None
    assert data.tile((0, 1)).tobytes() == tile.tobytes()
    assert level.changed_since(layer, revision)
    after = state(level)
    atom.swap(level)
    assert state(level) == before
    atom.swap(level)
    assert state(level) == after


def test_every_layer_has_an_array_that_undo_can_swap():
    level = new_level()
    journal = Journal(level)
    before = state(level)
    with journal.step("All") as step:
        for name in LAYERS:
            write(level, step, name, Rect(3, 4, 60, 50), 1)
    journal.undo()
    assert state(level) == before


# Covers


@given(st.sets(st.tuples(st.integers(0, 4), st.integers(0, 5)), max_size=20))
def test_a_cover_holds_exactly_its_tiles(tiles):
    grid = Grid(600, 700)
    count = np.zeros(grid.shape, int)
    for rect in grid.cover(tiles):
        count[rect.slices] += 1
    expected = np.zeros(grid.shape, int)
    for tile in tiles:
        expected[grid.tile_rect(tile).slices] = 1
    assert np.array_equal(count, expected)
    within = Rect(100, 130, 260, 270)
    assert all(rect == rect.intersect(within) for rect in grid.cover(tiles, within))


# The budget


class Shelf:
    """A store that counts."""

    def __init__(self):
        self.held = {}

    def put(self, key, data):
        assert key not in self.held
        self.held[key] = data

    def get(self, key):
        return self.held[key]

    def drop(self, key):
        del self.held[key]


def scribble_often(journal, count=12):
    states = [state(journal.level)]
    for seed in range(1, count + 1):
        do(journal, ("write", "height", Rect(seed, seed, seed + 90, seed + 90), seed))
        states.append(state(journal.level))
    return states


def test_without_a_store_the_oldest_steps_go():
    journal = Journal(new_level(), budget_bytes=120_000)
    states = scribble_often(journal)
    assert journal.bytes <= 120_000
    kept = len(journal.done)
    assert 2 <= kept < 12
    for expected in states[-2 : -2 - kept : -1]:
        journal.undo()
        assert state(journal.level) == expected
    assert journal.undo() is None


def test_with_a_store_no_step_is_lost():
    shelf = Shelf()
    journal = Journal(new_level(), budget_bytes=120_000, store=shelf)
    states = scribble_often(journal)
    assert journal.bytes <= 120_000
    assert len(journal.done) == 12
    assert len(shelf.held) >= 5
    for expected in states[-2::-1]:
        journal.undo()
        assert state(journal.level) == expected
        assert journal.bytes <= 120_000, "what can be redone counts too"
    for expected in states[1:]:
        journal.redo()
        assert state(journal.level) == expected
        assert journal.bytes <= 120_000
    while journal.undo():
        pass
    do(journal, ("write", "height", Rect(0, 0, 90, 90), 5))
    assert not shelf.held, "what can no longer be redone is given back"


def test_a_store_that_fails_costs_no_step():
    """The step stays where it was: everything can be undone once the store answers again."""
    shelf = Shelf()
    journal = Journal(new_level(), budget_bytes=10, store=shelf)
    states = scribble_often(journal, 3)
    journal.undo()
    kept, shelf.held = shelf.held, {}
    with pytest.raises(KeyError):
        journal.undo()
    assert len(journal.done) == 2
    assert state(journal.level) == states[2]
    shelf.held = kept
    for expected in states[1::-1]:
        journal.undo()
        assert state(journal.level) == expected


def test_one_step_past_the_budget_is_kept():
    journal = Journal(new_level(), budget_bytes=10)
    before = state(journal.level)
    scribble_often(journal, 1)
    journal.undo()
    assert state(journal.level) == before
