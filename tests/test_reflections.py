"""Reflections of the land in the plane of the sea (H17)."""

import numpy as np
import pytest
from scenes import camera
from shorewright.level import Grid, Level
from shorewright.renderer import Show

SIZE = (160, 90)
SEEN = {"y": 60.0, "z": 4.0, "pitch": 0.0, "yaw": 0.0}
CALM = {
    "sea.on": False, "shore.on": False, "water.foam": 0.0, "foam.shore": 0.0, "fog.on": False, "scatter.on": False,
    "sea.wind_mps": 0.0, "caustics.on": False, "water.roughness": 0.01,
}  # fmt: skip


def cliff():
    """Calm deep water before a wall 60 m to the north of the camera, 9 m high on the left, 20 m on the right."""
    y, x = np.mgrid[0:257, 0:257].astype(np.float64)
    height = np.where(y > 120, np.where(x > 128, 20.0, 9.0), -30.0)
    level = Level(Grid(257, 257), height.astype(np.float32))
    for name, value in CALM.items():
        level.set(name, value)
    return level


def picture(renderer, level, view="hdr", quality="medium", show=None, **look):
    renderer.draw(level, camera(**{**SEEN, **look}), SIZE, 3.0, view, quality=quality, show=show)
    seen = renderer.read(linear=True).astype(np.float64)
    assert np.isfinite(seen).all()
    return seen


def flipped(rows):
    """The picture mirrored at the horizon, which is its middle row when the camera looks level."""
    return rows[::-1]


@pytest.fixture
def still(monkeypatch):
    """Water without ripples."""
    from shorewright.renderer import look

    monkeypatch.setattr(look, "LEAST_SLOPE2", 1e-9)
    monkeypatch.setattr(look, "ripple_slopes", lambda sea, seed: np.full(2, 1e-9))
    return cliff()


@pytest.mark.gl
def test_the_cliff_stands_upside_down_in_calm_water(renderer, still):
    """H17: the mirrored radiance is the lit land's, line by line, from the water line on, to some per cent."""
    mirrored, lit = picture(renderer, still, "reflections"), picture(renderer, still)
    material = picture(renderer, still, "material")
    sea = material[..., 2] > 0.7
    # what a level mirror shows: the wall seen from below the sea, 4 m under it instead of over it
    row = np.arange(SIZE[1])
    middle = (SIZE[1] - 1) / 2
    rise = (middle - row) / (SIZE[1] / 2) * np.tan(np.radians(25))  # tangent of the view's elevation
    col = 110  # before the wall of 20 m
    wall = 61.0
    errors, signed = [], []
    for r in row[sea[:, col]]:
        height = -rise[r] * wall - 4.0  # where the mirrored ray meets the wall
        if not 1.0 < height < 18.0:
            continue
        other = middle - (height - 4.0) / wall / np.tan(np.radians(25)) * SIZE[1] / 2
        low = int(np.floor(other))
        expected = lit[low, col] * (1 - other + low) + lit[low + 1, col] * (other - low)
        errors.append(np.abs(mirrored[r, col] / expected - 1).max())
        signed.append((mirrored[r, col] / expected - 1).mean())
    assert len(errors) > 8
    assert np.median(errors) < 0.1  # rock has grain; the mirror has half its pixels
    assert np.abs(np.mean(signed)) < 0.04


@pytest.mark.gl
def test_what_is_mirrored_is_what_fresnel_leaves_of_it(renderer, still):
    """H17: what the surface sends is the mirrored land's light times Fresnel; off, the picture is as it was."""
    mirrored = picture(renderer, still, "reflections")
    with_it, without = picture(renderer, still), picture(renderer, still, show=Show.hide("reflections"))
    off = cliff_off(still)
    assert np.array_equal(without, picture(renderer, off))
    below = picture(renderer, still, "emissive")
    sea = picture(renderer, still, "material")[..., 2] > 0.7
    hit = sea & (mirrored.min(axis=2) > 0.05)
    assert hit.sum() > 500
    rays = camera_rays()
    cosine = np.abs(rays[..., 2])
    fresnel = 0.02 + 0.98 * (1 - cosine) ** 5
    share = ((with_it - below) / np.maximum(mirrored, 1e-6)).mean(axis=2)
    steep = hit & (cosine > 0.1)  # where water of one normal and its mean mirror agree
    assert steep.sum() > 100
    assert np.median(share[steep] / fresnel[steep]) == pytest.approx(1.0, abs=0.15)


def cliff_off(level):
    level.set("water.reflections", 0.0)
    return level


def camera_rays():
    """Unit directions of the picture's pixels, looking north and level with a field of 50° upwards."""
    y, x = np.mgrid[0 : SIZE[1], 0 : SIZE[0]] + 0.5
    half = np.tan(np.radians(25))
    up = (1 - 2 * y / SIZE[1]) * half
    right = (2 * x / SIZE[0] - 1) * half * SIZE[0] / SIZE[1]
    rays = np.stack([right, np.ones_like(up), up], -1)
    return rays / np.linalg.norm(rays, axis=2, keepdims=True)


@pytest.mark.gl
def test_sky_is_not_mirrored_where_land_stands(renderer, still):
    """H17: at the foot of the wall all of the mirror is land; where the low wall ends, sky comes back."""
    mirrored = picture(renderer, still, "reflections")
    sea = picture(renderer, still, "material")[..., 2] > 0.7
    first = np.argmax(sea, axis=0)
    tall, low = (np.array([mirrored[first[c] + 1 : first[c] + 20, c].min() for c in cols]) for cols in ((110,), (50,)))
    assert tall.min() > 0.02
    assert low.min() < 1e-3


@pytest.mark.gl
@pytest.mark.parametrize("place", [{"z": 90.0, "pitch": -80.0}, {"z": 0.3}, {"z": -4.0}, {"y": 250.0, "z": 40.0}])
def test_no_camera_makes_nonsense(renderer, place):
    """H17: from above, just over the water, under it and from on the land every number is finite, with waves too."""
    level = cliff()
    for name in ("sea.on", "shore.on"):
        level.set(name, True)
    assert picture(renderer, level, "reflections", **place).min() >= 0
    picture(renderer, level, **place)


@pytest.mark.gl
def test_low_quality_leaves_them_out(renderer):
    """H17: the low tier keeps one colour for the coast."""
    level = cliff()
    on = picture(renderer, level, quality="low")
    level.set("water.reflections", 0.0)
    assert np.array_equal(on, picture(renderer, level, quality="low"))


@pytest.mark.gl
def test_a_wall_that_the_picture_cuts_off_goes_on_in_the_mirror(renderer, still):
    """H17: where the mirrored ray leaves the picture over land its edge is repeated for a while, over sky it is sky."""
    mirrored = picture(renderer, still, "reflections", pitch=-18.0)
    lit = picture(renderer, still, pitch=-18.0)
    sea = picture(renderer, still, "material", pitch=-18.0)[..., 2] > 0.7
    tall = mirrored[sea[:, 110], 110]
    assert sea[0, 110] == 0  # the wall reaches the top of the picture
    assert (tall[:20].min(axis=1) > 0.02).all()
    cut = np.flatnonzero(sea[:, 110])[0]
    seen_m = 2 * cut  # rows down to where the mirror image of what is seen ends
    beyond = mirrored[seen_m : seen_m + 6, 110]
    assert beyond.max() < 1.5 * lit[:cut, 110].max()
    assert beyond.min() > 0


@pytest.mark.gl
def test_both_models_of_the_water_mirror_the_same(renderer, still):
    """H17, D02: land is lit first for the mirror where no plates are made of it; odd sizes are as good as even."""
    plate = picture(renderer, still, "reflections")
    still.set("water.model", "albedo")
    albedo = picture(renderer, still, "reflections")
    assert np.array_equal(plate, albedo)
    on = picture(renderer, still)
    assert np.abs(on - picture(renderer, still, show=Show.hide("reflections"))).max() > 0.05
    renderer.draw(still, camera(**SEEN), (SIZE[0] + 1, SIZE[1] + 1), 3.0, "reflections", quality="medium")
    odd = renderer.read(linear=True)
    assert np.isfinite(odd).all()
    assert np.median(odd[60:70, 105:115]) == pytest.approx(np.median(plate[60:70, 105:115]), rel=0.1)
