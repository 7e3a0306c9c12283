"""Painting foam, masks and covers (T03): modes, soft strokes that add up, alphas, limits."""

import json

import numpy as np
import pytest
from shorewright.brushes import BRUSHES, Stroke
from shorewright.brushes.alphas import pack, unpack
from shorewright.brushes.masks import SOURCES, limits_of
from shorewright.brushes.params import MapParams
from shorewright.io import read_level, write_level
from shorewright.io.alphas import read_alpha
from shorewright.io.images import write_image
from shorewright.level import LAYERS, BadInput, Grid, Journal, Level
from shorewright.level.params import row
from test_strokes import play, play_again, state

HARD = {"falloff": 0.0, "strength": 0.5, "size_m": 20}
ONTO = row(MapParams, "onto").choices


def beach(rows=160, cols=150):
    """Sea in the south, sloping up to land in the north, with a bump."""
    y, x = np.mgrid[:rows, :cols]
    bump = 4 * np.exp(-((x - 40) ** 2 + (y - 60) ** 2) / 120)
    return Level(Grid(rows, cols), (0.1 * (y - 90) + bump).astype(np.float32))


def paint(level, *points, invert=False, smooth=False, brush="paint", journal=None, **params):
    params = {**HARD, **params} if brush == "paint" else params
    stroke = Stroke(
        level, journal or Journal(level), BRUSHES[brush], BRUSHES[brush].with_params(params), invert, smooth
    )
    play(stroke, points)
    return stroke


@pytest.mark.parametrize("onto", ONTO)
def test_every_paintable_layer(onto):
    """T03: paint lands on the layer and channels that were picked, and undo takes it away."""
    level = beach()
    before, journal = state(level), Journal(level)
    paint(level, (70, 80), onto=onto, journal=journal)
    name, _, channel = onto.partition(".")
    here = np.atleast_1d(level.layers[name].array[80, 70])
    picked = [not channel or channel == part for part in LAYERS[name].channels]
    assert here.tolist() == [0.5 if yes else 0.0 for yes in picked]
    assert set(state(level)) == {*before, name}
    journal.undo()
    assert state(level) == before


def test_modes_and_their_contraries():
    """Add and remove stay within 0 to 1, set comes to the target by its share, reset to nothing."""
    level = beach()
    here = lambda: level.layers["snow"].array[80, 70].item()  # noqa: E731
    for mode, invert, strength, target, after in (
        ("add", False, 0.5, 1, 0.5), ("add", False, 0.75, 1, 1.0), ("add", True, 0.25, 1, 0.75),
        ("remove", False, 0.5, 1, 0.25), ("remove", True, 0.5, 1, 0.75), ("set", False, 0.5, 0.25, 0.5),
        ("set", False, 1.0, 0.25, 0.25), ("set", True, 0.5, 0.25, 0.125), ("reset", False, 1, 1, 0.0),
        ("remove", False, 1, 1, 0.0),
    ):  # fmt: skip
        paint(level, (70, 80), onto="snow", mode=mode, invert=invert, strength=strength, target=target)
        assert here() == after, (mode, invert)


def test_waves_in_rivers_are_painted_both_ways_and_replayed():
    """T03 D35: from none of them to all, −1 to 1; a replayed stroke leaves the same bytes."""
    level = beach()
    here = lambda: level.layers["mouth"].array[80, 70].item()  # noqa: E731
    for mode, strength, target, after in (
        ("remove", 0.5, 1, -0.5), ("remove", 1.0, 1, -1.0), ("add", 0.5, 1, -0.5), ("set", 1.0, -0.75, -0.75),
        ("add", 1.0, 1, 0.25), ("add", 1.0, 1, 1.0), ("reset", 1.0, 1, 0.0),
    ):  # fmt: skip
        paint(level, (70, 80), onto="mouth", mode=mode, strength=strength, target=target)
        assert here() == after, (mode, strength)
    params = {**HARD, "onto": "mouth", "mode": "remove"}
    first, again = beach(), beach()
    play_again(again, Journal(again), paint(first, (70, 80), (90, 84), **params))
    assert state(first) == state(again)
    assert first.layers["mouth"].array.min() == -0.5
    paint(level, (70, 80), onto="snow", mode="set", target=-1)
    assert level.layers["snow"].array.min() == 0.0


def test_smoothing_evens_paint_and_stays_in_its_range():
    level = beach()
    noise = np.random.default_rng(3).random(level.grid.shape).round().astype(np.float32)
    level.write("ice", level.grid.rect, noise)
    paint(level, (70, 80), onto="ice", smooth=True, strength=1.0)
    there = level.layers["ice"].array[72:88, 62:78]
    assert there.std() < 0.25 * noise[72:88, 62:78].std()
    assert 0 <= there.min() <= there.max() <= 1


@pytest.mark.parametrize(("mode", "begins"), [("add", 0.0), ("remove", 1.0)])
def test_a_thousand_soft_dabs_are_their_sum(mode, begins):
    """T03: 0.1 % a dab, a thousand times in a stroke: none is lost."""
    level = beach()
    level.write("foam", level.grid.rect, begins)
    params = {**HARD, "strength": 0.001, "spacing": 0.1, "build_up": True, "onto": "foam.constant", "mode": mode}
    stroke = Stroke(level, Journal(level), BRUSHES["paint"], BRUSHES["paint"].with_params(params))
    dabs = 0
    stroke.begin(70, 80)
    canvas_paint = stroke.canvas.paint

    def counted(*args):
        nonlocal dabs
        dabs += 1
        return canvas_paint(*args)

    stroke.canvas.paint = counted
    while dabs < 899:
        stroke.move(74, 80)
        stroke.move(70, 80)
    live = level.layers["foam"].array[80, 70, 1]
    assert abs(live - begins) == pytest.approx(0.001 * (dabs + 1), abs=2e-5)
    stroke.end()
    assert abs(level.layers["foam"].array[80, 70, 1] - begins) == pytest.approx(0.001 * (dabs + 1), abs=2e-5)


@pytest.mark.parametrize("onto", ["foam.transient", "river_foam.turbulent", "snow", "ice", "mouth"])
def test_a_thousand_soft_strokes_are_their_sum(onto, tmp_path):
    """T03: strokes of their own, each too soft for a half float near 1, saved and read again half way."""
    level = beach()
    layer, _, channel = onto.partition(".")
    begins = 0.7
    level.write(layer, level.grid.rect, begins)
    params = {**HARD, "strength": 0.0001, "onto": onto, "mode": "add"}
    for count in range(1000):
        paint(level, (70, 80), **params)
        if count == 500:
            write_level(level, tmp_path / "soft.shore")
            level = read_level(tmp_path / "soft.shore")
    values = level.layers[layer].array[80, 70]
    at = level.layers[layer].row.channels.index(channel) if channel else 0
    assert float(np.atleast_1d(values)[at]) == pytest.approx(begins + 0.1, abs=1e-4)


def test_opacity_bounds_a_stroke_that_builds_up():
    level = beach()
    points = [(70 + 5 * (n % 2), 80) for n in range(200)]
    paint(level, *points, onto="quiet", build_up=True, strength=0.2, opacity=0.3)
    assert level.layers["quiet"].array.max() == pytest.approx(0.3, abs=2e-4)


# Limits


def test_limits_hold_together():
    """T03: foam only where the depth is 0 to 2 m and the slope below 8°: nothing elsewhere, and whole inside."""
    level = beach()
    paint(level, (20, 80), (130, 80), size_m=60, strength=1.0, only_where="depth_m 0..2; slope_deg ..8")
    depth = -level.height
    north, east = np.gradient(level.height)
    slope = np.degrees(np.arctan(np.hypot(north, east)))
    foam = level.layers["foam"].array[..., 1]
    allowed = (depth >= 0) & (depth <= 2) & (slope <= 8)
    inner = np.s_[30:130, 5:145]
    assert np.array_equal(foam[inner] > 0, allowed[inner])
    assert 0.1 < allowed[inner].mean() < 0.5


def test_a_limit_fades_inside_its_range():
    level = beach()
    paint(level, (100, 70), size_m=60, strength=1.0, only_where="depth_m 0..4 ~1")
    foam, depth = level.layers["foam"].array[:, 100, 1], -level.height[:, 100]
    near = np.abs(np.arange(160) - 70) < 55
    t = np.clip(np.minimum(depth, 4 - depth), 0, 1)
    np.testing.assert_allclose(foam[near], (t * t * (3 - 2 * t))[near], atol=1e-3)


@pytest.mark.parametrize("source", SOURCES)
def test_every_source_limits(source):
    """Each splits what a brush does in two: within a range that holds some of the values, and beyond."""
    level = beach()
    rng = np.random.default_rng(1)
    name, *_ = source.partition(".")
    if name in LAYERS:
        level.write(name, level.grid.rect, rng.random(level.layers[name].shape).astype(np.float32))
    done = []
    middle = {"depth_m": 1.0, "height_m": -1.0, "slope_deg": 6.0, "flow_mps": 0.05, "shore_m": 12.0}.get(source, 0.5)
    level.write("flow", level.grid.rect, np.float32(0.02) * rng.random((*level.grid.shape, 2)).astype(np.float32))
    onto = "shelter" if source == "yielding" else "yielding"
    for text in (f"{source} ..{middle}", f"{source} {middle}.."):
        before = level.layers[onto].array.copy()
        paint(level, (70, 70), size_m=50, onto=onto, strength=0.25, only_where=text)
        done.append(level.layers[onto].array - before)
        level.write(onto, level.grid.rect, before)
    assert (done[0] > 0).sum() > 0
    assert (done[1] > 0).sum() > 0
    both = np.zeros(level.grid.shape, bool)
    both[25:116, 25:116] = np.hypot(*(np.mgrid[25:116, 25:116] - 70)) < 45
    assert ((done[0] > 0) | (done[1] > 0))[both].all()
    assert ((done[0] > 0) & (done[1] > 0))[both].mean() < 0.03  # a value that is both ends


def test_limits_are_those_of_the_press_for_sculpting_too():
    """A brush that lifts ground out of its own limit goes on to the end of the stroke; other brushes obey as well."""
    level = beach()
    before = level.height.copy()
    paint(level, (70, 60), (75, 60), (70, 60), brush="raise", strength=5, size_m=20, only_where="height_m ..-2.5")
    raised = level.height - before
    assert raised.max() == pytest.approx(5, abs=1e-4)
    assert (before[raised > 0] <= -2.5).all()


def test_a_limited_stroke_plays_again():
    """Limits and alphas are parameters: what was recorded makes the same bytes, whatever the process knew before."""
    alpha = pack("noise", np.random.default_rng(2).random((40, 30)))
    params = {"only_where": "flow_mps 0.1..; shore_m ..15 ~3; depth_m 0..", "alpha": alpha, "alpha_turn": "random"}
    level = beach()
    stroke = paint(level, (40, 60), (90, 70), strength=0.3, **params)
    again = beach()
    play_again(again, Journal(again), stroke)
    assert state(again) == state(level)
    assert level.layers["foam"].array.any()


@pytest.mark.parametrize(("text", "told"), [
    ("depth 0..2", "no limit is called 'depth'"), ("depth_m", "no limit"), ("depth_m 3..1", "ends before"),
    ("depth_m 0..1 ~-2", "less than nothing"), ("; ".join(["ice 0..1"] * 13), "12 limits"),
])  # fmt: skip
def test_bad_limits_are_one_sentence(text, told):
    with pytest.raises(BadInput, match=told):
        BRUSHES["raise"].with_params({"only_where": text})


def test_limits_write_themselves():
    text = "depth_m 0..2 ~0.5; flow_mps 1..; foam.constant ..0.4"
    assert "; ".join(limit.text() for limit in limits_of(text)) == text
    assert BRUSHES["flow"].with_params({"only_where": " depth_m   0.0..2.0~.5 ;"}).only_where == "depth_m 0..2 ~0.5"


# Alphas


def corner():
    """White in its upper right quarter."""
    grey = np.zeros((32, 32), np.float32)
    grey[:16, 16:] = 1
    return pack("corner", grey)


@pytest.mark.parametrize(("deg", "row", "col"), [(0, 1, 1), (90, -1, 1), (180, -1, -1), (-90, 1, -1)])
def test_an_alpha_shapes_the_dab_and_turns_clockwise(deg, row, col):
    level = beach()
    paint(level, (70, 80), strength=1.0, alpha=corner(), alpha_angle_deg=deg)
    foam = level.layers["foam"].array[..., 1]
    for r, c in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        assert foam[80 + 10 * r, 70 + 10 * c] == float((r, c) == (row, col))


def test_an_alpha_goes_along_the_stroke():
    """Eastwards the picture's up is east; the press leaves no stamp of another way."""
    level = beach()
    paint(level, (40, 80), (90, 80), strength=1.0, alpha=corner(), alpha_turn="along")
    foam = level.layers["foam"].array[..., 1]
    assert foam[70:79, 62:88].min() > 0.9  # right of the way
    assert foam[82:, :].max() == 0
    assert foam[70:79, :40].max() == 0
    click = beach()
    paint(click, (70, 80), strength=1.0, alpha=corner(), alpha_turn="along")
    assert click.layers["foam"].array[90, 80, 1] == 1


def test_random_turns_follow_from_the_seed():
    made = []
    for seed in (1, 1, 2):
        level = beach()
        paint(level, (70, 80), alpha=corner(), alpha_turn="random", alpha_seed=seed)
        made.append(level.layers["foam"].array.tobytes())
    assert made[0] == made[1] != made[2]


def test_alphas_from_files(tmp_path):
    """T03: grey, colours and transparency, 8 and 16 bits and floats; the text holds the picture within 8 bits."""
    grey = np.random.default_rng(5).random((200, 100)).astype(np.float32)
    for name, pixels in (
        ("a.png", np.rint(grey * 255).astype(np.uint8)), ("b.png", np.rint(grey * 65535).astype(np.uint16)),
        ("c.exr", grey), ("d.exr", np.stack([grey] * 3, -1)), ("e.exr", grey * 4 / grey.max()),
        ("f.exr", np.stack([np.ones_like(grey)] * 3 + [grey], -1)),
    ):  # fmt: skip
        read = read_alpha(write_image(tmp_path / name, pixels))
        scale = grey.max() if name == "e.exr" else 1
        np.testing.assert_allclose(read, grey / scale, atol=3e-3)
    kept = unpack(pack("a b", read))
    assert kept.name == "a_b"
    assert kept.grey.shape == (128, 128)
    assert kept.grey.mean() == pytest.approx(grey.mean() / 2, abs=2e-3)  # half of its square
    with pytest.raises(BadInput, match="black everywhere"):
        read_alpha(write_image(tmp_path / "black.exr", np.zeros((8, 8), np.float32)))
    (tmp_path / "no.png").write_bytes(b"nothing")
    with pytest.raises(BadInput):
        read_alpha(tmp_path / "no.png")


@pytest.mark.parametrize("text", ["x", "a 4 AAAA", "a 9000 AAAA", "a 4 !", corner()[:-8]])
def test_bad_alphas_are_one_sentence(text):
    with pytest.raises(BadInput, match="alpha"):
        BRUSHES["paint"].with_params({"alpha": text})


def test_an_alpha_keeps_within_a_script_word():
    """A picture of noise, which packs worst, stays below the text's bound and goes through JSON."""
    text = pack("noise", np.random.default_rng(1).random((512, 512)))
    assert len(json.dumps(text)) < 25_000
    assert BRUSHES["raise"].with_params({"alpha": text}).alpha == text
