"""Quality tiers: few pixels brought to full size, numbers never scaled, overlays sharp, once only (T11, D31)."""

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.renderer import TIERS, Overlays, Ring, render

pytestmark = pytest.mark.gl
SIZE = (160, 90)


def drawn_pixels(renderer) -> int:
    (targets,) = renderer.targets.values()
    return targets.drawn[0] * targets.drawn[1]


@pytest.mark.parametrize("size", [SIZE, (161, 91), (7, 3), (1, 1)])
@pytest.mark.parametrize("quality", TIERS)
def test_every_tier_gives_the_size_that_was_asked(renderer, quality, size):
    shot = render(coast(), camera(), size, 1.0, quality=quality, renderer=renderer)
    assert shot.shape == (size[1], size[0], 3)
    scale = TIERS[quality].scale
    assert drawn_pixels(renderer) == max(round(size[0] * scale), 1) * max(round(size[1] * scale), 1)


def test_low_draws_at_most_a_third_of_mediums_pixels_and_fewer_triangles(renderer):
    """Software OpenGL spends nearly everything on pixels: counts, not times."""
    level, place, seen = coast(), camera(), {}
    for quality in TIERS:
        render(level, place, SIZE, 1.0, quality=quality, renderer=renderer)
        seen[quality] = drawn_pixels(renderer), renderer.stats["sea_triangles"], renderer.stats["terrain_triangles"]
    assert seen["low"][0] <= seen["medium"][0] / 3
    assert seen["low"][1] < 0.5 * seen["medium"][1] < 0.25 * seen["high"][1] * 2
    assert seen["low"][2] <= seen["medium"][2] <= seen["high"][2]


def test_the_filtered_picture_is_the_full_one_with_less_detail(renderer):
    """Bytes of low, medium's shown smaller: same place, same light."""
    level, place = coast(rock=9.0), camera()
    full = render(level, place, SIZE, 1.0, quality="medium", renderer=renderer).astype(float)
    low = render(level, place, SIZE, 1.0, quality="low", renderer=renderer).astype(float)
    blocks = [shot.reshape(9, 10, 16, 10, 3).mean(axis=(1, 3)) for shot in (full, low)]
    assert np.abs(blocks[0] - blocks[1]).mean() < 6
    assert np.abs(full.mean() - low.mean()) < 3


def test_numbers_are_never_made_up_by_the_filter(renderer):
    level, place = coast(), camera()
    options = {"size": SIZE, "time_s": 1.0, "quality": "low", "renderer": renderer}
    assert render(level, place, linear=True, **options).shape == (90, 160, 3)
    for view in ("material", "eye_depth"):
        render(level, place, view=view, **options)
        assert drawn_pixels(renderer) == 160 * 90


def test_a_size_somebody_else_chose_is_drawn_as_it_is(renderer):
    """The window's governor lowers the size itself: the tier doesn't lower it again."""
    renderer.draw(coast(), camera(), SIZE, 1.0, quality="low", scale=1.0)
    assert drawn_pixels(renderer) == 160 * 90


def test_overlays_are_drawn_at_full_size(renderer):
    """D31: the ring of a picture drawn with a quarter of the pixels lies where the full one's does."""
    level, place = coast(), camera(y=20.0, z=60.0, pitch=-50.0)
    overlays = Overlays(ring=Ring(128.0, 90.0, 20.0), centre=True, outline=True)
    marks = []
    for scale in (1.0, 0.5):
        bare, ringed = (
            (renderer.draw(level, place, (320, 180), 1.0, scale=scale, overlays=what), renderer.read())[1].astype(int)
            for what in (None, overlays)
        )
        marks.append(np.abs(bare - ringed).max(axis=2) > 60)
    full, half = marks
    grown = full.copy()
    for axis in (0, 1):
        for step in (1, -1):
            grown |= np.roll(full, step, axis)
    assert full.sum() > 200
    assert 0.7 < half.sum() / full.sum() < 1.4
    assert (half & ~grown).sum() < 0.03 * half.sum()


def test_samples_of_a_small_picture_stay_in_place(renderer):
    """Jitter is counted in drawn pixels: the mean of many lies where the single picture does."""
    level, place = coast(rock=9.0), camera()
    one, many = (
        render(level, place, SIZE, 1.0, quality="low", samples=n, renderer=renderer).astype(float) for n in (1, 8)
    )
    blocks = [shot.reshape(9, 10, 16, 10, 3).mean(axis=(1, 3)) for shot in (one, many)]
    assert np.abs(blocks[0] - blocks[1]).mean() < 3


def test_samples_may_be_gathered_in_parts(renderer):
    """L04: a still picture that gathers its samples over several frames ends as the one drawn with all at once."""
    level = coast(rock=4.0)
    whole = render(level, camera(), SIZE, 3.0, samples=6, renderer=renderer)
    one = render(level, camera(), SIZE, 3.0, renderer=renderer)
    for part in (range(0, 4), range(4, 5), range(5, 6)):
        renderer.draw(level, camera(), SIZE, 3.0, samples=6, part=part)
    assert (renderer.read() == whole).all()
    assert (one != whole).any()
