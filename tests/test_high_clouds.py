"""The high layers: patterns that tile, lie along the wind and move each its own way (Z13)."""

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.level.high_clouds import SIDE
from shorewright.renderer import Show, high_layers
from shorewright.renderer.high_layers import LAYERS

SIZE = (96, 54)


@pytest.fixture(scope="module")
def patterns():
    return high_layers.patterns().astype(np.float64) / 255


def test_patterns_tile_and_come_again(patterns):
    """No step where one tile meets the next; each channel uses most of 0 … 1."""
    assert patterns.shape == (SIDE, SIDE, 4)
    for axis in (0, 1):
        inside = np.abs(np.diff(patterns, axis=axis)).mean((0, 1))
        seam = np.abs(np.take(patterns, 0, axis) - np.take(patterns, -1, axis)).mean(0)
        assert (seam < 1.6 * inside).all()
    assert (patterns.max((0, 1)) > 0.8).all()
    assert (patterns.min((0, 1)) == 0).all()


def test_cirrus_is_combed_and_heaps_are_round(patterns):
    """Ice changes far less along the wind than across; small heaps alike both ways."""
    along, across = (np.abs(np.diff(patterns, axis=axis)).mean((0, 1)) for axis in (1, 0))
    assert (across[:2] > 2.0 * along[:2]).all()
    assert 0.8 < across[3] / along[3] < 1.25


def sky(renderer, time_s=0.0, show=None, **clouds):
    level = coast()
    for path, value in {"on": True, **clouds}.items():
        level.set(f"clouds.{path}", value)
    level.set("weather.coverage", 0.0)
    level.set("weather.horizon_coverage", 0.0)
    renderer.draw(level, camera(pitch=45.0), SIZE, time_s=time_s, quality="low", show=show or Show())
    return renderer.read(linear=True).astype(np.float64)


@pytest.mark.gl
def test_each_layer_has_its_knob(renderer):
    """Z13: none without cover, and the more cover the more of it."""
    bare = sky(renderer, cirrus=0.0, alto=0.0)
    hidden = sky(renderer, cirrus=0.6, alto=0.6, show=Show.hide("clouds"))
    np.testing.assert_allclose(bare, hidden, rtol=1e-5)
    for name in ("cirrus", "alto"):
        added = [np.abs(sky(renderer, **{"cirrus": 0.0, "alto": 0.0, name: cover}) - bare).mean()
                 for cover in (0.3, 0.6, 0.9)]  # fmt: skip
        assert 0.0 < added[0] < added[1] < added[2]


@pytest.mark.gl
def test_layers_move_at_their_own_speed(renderer):
    """Z13: they move with time and come back with it; no two have one speed and one way."""
    there = sky(renderer, 0.0, cirrus=0.6, alto=0.6)
    assert not np.array_equal(there, sky(renderer, 30.0, cirrus=0.6, alto=0.6))
    assert np.array_equal(there, sky(renderer, 0.0, cirrus=0.6, alto=0.6))
    assert len({row[1] for row in LAYERS}) == len({row[2] for row in LAYERS}) == 4
