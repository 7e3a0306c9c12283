"""One engine for every layer (T01): a brush on another layer is a row; and no seam at tiles or sectors."""

from dataclasses import replace

import numpy as np
import pytest
from shorewright.brushes import BRUSHES, Stroke
from shorewright.level import LAYERS, SECTOR, Grid, Journal, Level, Rect
from test_strokes import FREE, play, start, state

POINTS = [(40, 52, 1.0), (140, 150, 0.4), (150, 60, 0.9)]


def on_layer(name, layer, channels=()):
    return replace(BRUSHES[name], name=f"{name} {layer}", layer=layer, channels=channels)


def painted_level(layer, seed=4):
    """Some paint on the layer in two of its tiles."""
    level = Level(Grid(300, 270), np.zeros((300, 270), np.float32))
    data = level.layers[layer]
    rect = Rect(30, 20, 190, 110)
    noise = np.random.default_rng(seed).normal(size=rect.shape + data.shape[2:])
    level.write(layer, rect, noise.astype(np.float32))
    return level


def paint(level, brush, journal=None, points=POINTS, scale=1.0, **params):
    stroke = Stroke(level, journal or Journal(level), brush, brush.with_params(params))
    east, north = level.layers[brush.layer].grid.origin_m
    play(stroke, [(x * scale + east, y * scale + north, *rest) for x, y, *rest in points])


def cell(level, layer):
    return level.layers[layer].grid.cell_m


@pytest.mark.parametrize("layer", LAYERS)
@pytest.mark.parametrize("name", FREE)
def test_every_brush_works_on_every_layer(name, layer):
    """Undo, redo and unpainted tiles hold for layers of one and many channels, of single and half precision."""
    level = painted_level(layer)
    journal = Journal(level)
    before = state(level)
    brush, scale = on_layer(name, layer), cell(level, layer)
    paint(level, brush, journal, scale=scale, size_m=25 * scale)
    after = state(level)
    assert after != before
    assert set(before) == set(after), "no other layer is touched"
    values = level.layers[layer].array
    assert np.isfinite(values).all()
    journal.undo()
    assert state(level) == before
    journal.redo()
    assert state(level) == after


@pytest.mark.parametrize("name", [name for name in BRUSHES if BRUSHES[name].layer == "height"])
def test_channels_are_painted_like_layers_of_their_own(name):
    """What a brush does to four channels it does to each of them alone."""
    together = painted_level("cover")
    paint(together, on_layer(name, "cover"), size_m=25)
    for number in range(4):
        alone = Level(Grid(300, 270), np.zeros((300, 270), np.float32))
        painted = painted_level("cover").layers["cover"].array[..., number]
        alone.write("flow", alone.grid.rect, np.stack([painted, painted], axis=2))
        paint(alone, on_layer(name, "flow"), size_m=25)
        ours = together.layers["cover"].array[..., number]
        np.testing.assert_allclose(ours, alone.layers["flow"].array[..., 0], atol=4e-3)  # half against single precision
        assert np.array_equal(alone.layers["flow"].array[..., 0], alone.layers["flow"].array[..., 1])


@pytest.mark.parametrize("name", FREE)
def test_a_brush_may_be_for_some_channels_only(name):
    level = painted_level("cover")
    before = level.layers["cover"].array.copy()
    paint(level, on_layer(name, "cover", ("grass", "sand")), size_m=25)
    changed = (level.layers["cover"].array != before).any(axis=(0, 1))
    assert changed.tolist() == [True, False, True, False]


def test_a_release_rounds_nothing():
    """Soft strokes don't vanish, between dabs or after: a layer is float32, whatever the graphics card holds."""
    level = Level(Grid(200, 200), np.zeros((200, 200), np.float32))
    brush = on_layer("raise", "snow")
    stroke = Stroke(level, Journal(level), brush, brush.with_params({"strength": 0.3, "size_m": 30}))
    stroke.begin(100, 100)
    live = level.layers["snow"].array.copy()
    assert not np.array_equal(live, live.astype(np.float16))
    stroke.end()
    assert np.array_equal(level.layers["snow"].array, live)


def test_what_changes_nothing_is_no_step():
    """Less than float32 can say."""
    level = Level(Grid(200, 200), np.zeros((200, 200), np.float32))
    level.write("snow", level.grid.rect, 1.0)
    journal = Journal(level)
    before, brush = state(level), on_layer("raise", "snow")
    paint(level, brush, journal, strength=1e-9)
    assert state(level) == before
    assert not journal.done


# Seams


def ground(rows, cols):
    y, x = np.mgrid[:rows, :cols]
    noise = np.random.default_rng(9).normal(size=(rows, cols))
    return (noise + y * 0.05 - x * 0.02).astype(np.float32)


@pytest.mark.parametrize("name", FREE)
@pytest.mark.parametrize("options", [{}, {"invert": True}, {"opacity": 0.5}])
@pytest.mark.parametrize("corner", [(128, 128), (SECTOR, 128), (SECTOR + 1, 255)])
def test_no_seam_where_tiles_and_sectors_meet(name, options, corner):
    """The same ground and stroke inside one tile and across four of them, or across sectors, give the same shape."""
    patch = ground(110, 100)
    points = [(30, 30), (70, 80), (75, 30)]
    results = []
    for row, col in ((8, 10), (corner[0] - 55, corner[1] - 50)):
        level = Level(Grid(1200, 400), np.zeros((1200, 400), np.float32))
        level.write("height", Rect(row, col, row + 110, col + 100), patch)
        play(start(level, name, size_m=14, **options), [(x + col, y + row) for x, y in points])
        results.append(level.height[row : row + 110, col : col + 100])
    assert not np.array_equal(results[0], patch)
    np.testing.assert_allclose(results[1], results[0], atol=2e-4)
