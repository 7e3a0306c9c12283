"""The shadow map: a change works out a strip again, to the same bytes as the whole; nothing else works it out."""

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.level import Grid, Journal, Level, Rect
from shorewright.renderer import Renderer, Show

pytestmark = pytest.mark.gl
SIZE = (32, 18)


def bumpy(rows: int, cols: int, sun: tuple[float, float]) -> Level:
    rng = np.random.default_rng(5)
    level = Level(Grid(rows, cols), rng.uniform(0, 3, (rows, cols)).astype(np.float32))
    level.set("light.sun_azimuth_deg", sun[0])
    level.set("light.sun_elevation_deg", sun[1])
    return level


def shadow_bytes(renderer, level, quality: str = "medium") -> bytes:
    renderer.draw(level, camera(), SIZE, quality=quality)
    return list(renderer.kept["shadows"].values())[-1].texture.read()


@pytest.mark.parametrize("sun", [(0, 12), (90, 30), (137.3, 5), (225, 0.6), (291, 60), (200, 90)], ids=str)
@pytest.mark.parametrize(("rows", "cols", "quality"), [(257, 301, "medium"), (700, 641, "low")])
def test_a_strip_is_the_same_bytes_as_the_whole(renderer, ctx, rows, cols, quality, sun):
    """Dabs in the middle and at the borders, while a stroke is open: as a renderer that has never seen the level."""
    level = bumpy(rows, cols, sun)
    shadow_bytes(renderer, level, quality)
    level.live = True
    for place in (Rect(90, 100, 110, 125), Rect(0, 0, 12, 9), Rect(rows - 8, cols - 9, rows, cols)):
        level.layers["height"].array[place.slices] += 7.5
        level.mark("height", place)
        part = shadow_bytes(renderer, level, quality)
        assert renderer.stats["shadow_share"] < 0.6
    fresh = Renderer(ctx)
    assert part == shadow_bytes(fresh, level, quality)
    assert fresh.stats["shadow_share"] == 1.0
    fresh.release()


def test_an_undone_stroke_leaves_the_map_as_it_was(renderer):
    level = bumpy(257, 257, (120, 15))
    journal, before = Journal(level), shadow_bytes(renderer, level)
    with journal.step("Raise") as step:
        rect = Rect(100, 40, 130, 60)
        step.save(level.layers["height"], rect)
        level.layers["height"].array[rect.slices] += 9
        level.mark("height", rect)
        assert shadow_bytes(renderer, level) != before
    journal.undo()
    assert shadow_bytes(renderer, level) == before


def test_only_the_ground_and_the_sun_work_it_out_again(renderer):
    level = coast()
    shadow_bytes(renderer, level)
    for change in (
        lambda: level.set("water.foam", 0.3),
        lambda: level.write("cover", Rect(4, 4, 9, 9), 1.0),
        lambda: level.put_object("c", camera()),
    ):
        change()
        shadow_bytes(renderer, level)
        assert "shadow_rounds" not in renderer.stats
    level.set("light.sun_azimuth_deg", 12.0)
    shadow_bytes(renderer, level)
    assert renderer.stats["shadow_share"] == 1.0


def test_tiers_that_take_turns_keep_their_maps(renderer):
    """Moving at low and standing still at medium: neither works the other's map out again."""
    level = coast(side=700)
    for quality in ("low", "medium"):
        shadow_bytes(renderer, level, quality)
    for quality in ("low", "medium"):
        shadow_bytes(renderer, level, quality)
        assert "shadow_rounds" not in renderer.stats
    assert len(renderer.kept["shadows"]) == 2


def test_a_change_while_shadows_are_off_is_seen_when_they_come_back(renderer, ctx):
    level = bumpy(257, 257, (90, 20))
    shadow_bytes(renderer, level)
    level.write("height", Rect(60, 60, 90, 90), 20.0)
    renderer.draw(level, camera(), SIZE, show=Show.hide("shadows"))
    fresh = Renderer(ctx)
    assert shadow_bytes(renderer, level) == shadow_bytes(fresh, level)
    fresh.release()


def test_levels_of_one_size_do_not_share_a_map(renderer):
    one, other = bumpy(257, 257, (90, 20)), coast()
    other.set("light.sun_azimuth_deg", 90.0)
    other.set("light.sun_elevation_deg", 20.0)
    while other.revision < one.revision:
        other.set("water.foam", 0.4)
    first = shadow_bytes(renderer, one)
    assert shadow_bytes(renderer, other) != first
    assert shadow_bytes(renderer, one) == first
