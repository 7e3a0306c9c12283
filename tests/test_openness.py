"""The map of the open sky: closed forms, plain ground sees all, a change worked out to the same bytes (L02, L03)."""

import numpy as np
import pytest
from scenes import camera
from shorewright.level import Grid, Level, Rect
from shorewright.level.open_sky import LEAST_CELLS, REACH_M, steps
from shorewright.renderer import Renderer, Show, render

pytestmark = pytest.mark.gl
SIZE = (32, 18)
SIDE = 257


def openness(renderer, level, quality: str = "medium") -> np.ndarray:
    """The map `(rows, cols, 4)`, row 0 south: open, rough × 2, bent normal about one half."""
    renderer.draw(level, camera(), SIZE, quality=quality)
    texture = list(renderer.kept["openness"].values())[-1].texture
    return np.frombuffer(texture.read(), np.uint8).reshape(texture.height, texture.width, 4) / 255


def ground(height) -> Level:
    y, x = np.mgrid[0:SIDE, 0:SIDE].astype(np.float64)
    return Level(Grid(SIDE, SIDE), np.asarray(height(x - 128, y - 128) + np.zeros_like(x), np.float32))


@pytest.mark.parametrize("quality", ["low", "medium", "high"])
@pytest.mark.parametrize("slope", [0.0, 0.3, 1.0])
def test_plain_ground_sees_all_of_its_sky(renderer, quality, slope):
    """Flat or tilted: 1 everywhere, not rough, and flat ground's mean way to the sky is up."""
    found = openness(renderer, ground(lambda x, y: slope * x - 0.4 * slope * y), quality)[90:-90, 90:-90]
    assert found[..., 0].min() == 1.0
    assert found[..., 1].max() < 0.02
    if slope == 0:
        np.testing.assert_allclose(found[..., 2:], 0.5, atol=0.005)


@pytest.mark.parametrize("quality", ["low", "medium", "high"])
@pytest.mark.parametrize("degrees", [15, 30, 45, 60])
def test_the_bottom_of_a_valley_sees_the_cosine_of_its_sides(renderer, quality, degrees):
    """Long sides rising at an angle a: an upward surface keeps cos a of the sky (view factor of an infinite strip)."""
    found = openness(renderer, ground(lambda x, y: np.abs(x) * np.tan(np.radians(degrees))), quality)
    assert found[128, 128, 0] == pytest.approx(np.cos(np.radians(degrees)), abs=0.02)


@pytest.mark.parametrize("away_m", [4, 12, 30])
def test_before_a_long_wall(renderer, away_m):
    """A wall 20 m high: (1 + cos a) / 2 of the sky for the angle a to its top; the free sky is away from it."""
    found = openness(renderer, ground(lambda x, y: np.where(x >= 0, 20.0, 0.0)), "high")[128, 128 - away_m]
    assert found[0] == pytest.approx((1 + np.cos(np.arctan(20 / away_m))) / 2, abs=0.05)
    assert found[2] < 0.45
    assert found[3] == pytest.approx(0.5, abs=0.02)


def test_broken_ground_is_rough_and_a_crease_is_not(renderer):
    rng = np.random.default_rng(1)
    crease = openness(renderer, ground(lambda x, y: 0.5 * np.abs(x)))
    broken = openness(renderer, ground(lambda x, y: rng.uniform(0, 3, x.shape)))
    assert crease[100:150, 100:150, 1].max() < 0.02
    assert np.median(broken[100:150, 100:150, 1]) > 0.2


@pytest.mark.parametrize(("rows", "cols", "quality"), [(257, 301, "medium"), (700, 641, "low")])
def test_a_part_is_the_same_bytes_as_the_whole(renderer, ctx, rows, cols, quality):
    """Dabs in the middle and at the borders, while a stroke is open."""
    rng = np.random.default_rng(5)
    level = Level(Grid(rows, cols), rng.uniform(0, 3, (rows, cols)).astype(np.float32))
    openness(renderer, level, quality)
    level.live = True
    for place in (Rect(90, 100, 110, 125), Rect(0, 0, 12, 9), Rect(rows - 8, cols - 9, rows, cols)):
        level.layers["height"].array[place.slices] += 7.5
        level.mark("height", place)
        part = openness(renderer, level, quality)
        assert renderer.stats["openness_share"] < 0.8
    fresh = Renderer(ctx)
    assert np.array_equal(part, openness(fresh, level, quality))
    assert fresh.stats["openness_share"] == 1.0
    fresh.release()


def test_only_the_ground_works_it_out_again(renderer):
    level = ground(lambda x, y: 0.1 * x)
    openness(renderer, level)
    level.set("light.sun_azimuth_deg", 12.0)
    level.write("cover", Rect(4, 4, 9, 9), 1.0)
    openness(renderer, level)
    assert "openness_share" not in renderer.stats


@pytest.mark.parametrize("cell_m", [0.25, 1.0, 8.0, 100.0])
def test_horizons_are_followed_far_enough_at_any_cell(cell_m):
    cells = steps(cell_m)
    assert cells[0] == 1
    assert cells[-1] == max(REACH_M / cell_m, LEAST_CELLS)
    assert (np.diff(cells) >= 0).all()


def test_the_view_shows_it(renderer):
    """`sky_visibility`: white on open ground, dark in a gorge."""
    level = ground(lambda x, y: 3.0 + 30 * (np.abs(x) > 4))
    place = camera(x=128.0, y=128.0, z=200.0, yaw=0.0, pitch=-90.0, fov=40.0)
    seen = render(
        level, place, (96, 96), view="sky_visibility", linear=True, renderer=renderer, show=Show.hide("water")
    )
    assert seen[48, 4, 0] > 0.97
    assert seen[48, 48, 0] < 0.3
