"""What is seen through the sea: plates of the land lit before it, and the older way of bent albedo (D02, H12, H14)."""

import numpy as np
import pytest
from shorewright.level import Grid, Level
from shorewright.renderer import Show

from .scenes import SIZE, camera, coast

STILL = {
    "sea.swell_m": 0.0, "sea.chop_m": 0.0, "shore.height_m": 0.0, "shore.draw_m": 0.0, "water.foam": 0.0,
    "water.plankton": 0.0, "water.silt": 0.0, "water.scatter": 0.0, "caustics.on": False,
    "fog.on": False, "scatter.on": False,
}  # fmt: skip


def picture(renderer, level, view="hdr", look=None, **settings):
    for name, value in settings.items():
        level.set(name.replace("__", "."), value)
    renderer.draw(level, look or camera(), SIZE, 14.0, view, quality="medium")
    return renderer.read(linear=True)


@pytest.mark.parametrize("model", ["plate", "albedo"])
def test_a_bed_under_a_centimetre_of_clear_water_is_as_bright_as_a_dry_one(renderer, model):
    """D02: seen from above the light from below is within 5 % of the bed in air, whichever model."""
    level = Level(Grid(129, 129), np.full((129, 129), -0.01, np.float32))
    for name, value in STILL.items():
        level.set(name, value)
    look = camera(64.0, 64.0, 20.0, pitch=-89.0)
    dry = picture(renderer, level, look=look, water__on=False)
    wet = picture(renderer, level, "emissive", look, water__on=True, water__model=model)
    assert np.median(wet / 0.98) == pytest.approx(np.median(dry), rel=0.05)


def test_both_models_agree_in_metres_of_water(renderer):
    """D02 H12: the same bed, the same way down along the sun and up along the eye."""
    level = coast()
    for name, value in STILL.items():
        level.set(name, value)
    plate, albedo = (picture(renderer, level, "emissive", water__model=model) for model in ("plate", "albedo"))
    seen = albedo.sum(axis=2) > 0
    assert seen.mean() > 0.3
    assert np.median(plate[seen] / np.maximum(albedo[seen], 1e-6)) == pytest.approx(1.0, abs=0.1)


def test_plate_b_is_plate_a_blurred(renderer):
    """H12: no blur leaves A; more blur leaves less of the contrast between neighbours, and the mean."""
    level = coast(rock=6.0)
    a = picture(renderer, level, "plate_a", water__blur=2.0)
    b = picture(renderer, level, "plate_b")
    same = picture(renderer, level, "plate_b", water__blur=0.0)
    assert np.abs(same - a).max() <= 0.01 * a.max()
    steps = [np.abs(np.diff(plate[:40], axis=1)).mean() for plate in (a, b)]
    assert steps[1] < 0.7 * steps[0]


def test_low_quality_and_the_setting_leave_plates_out(renderer):
    """D02: the setting chooses the model; with `albedo` blur and its distance change nothing, with `plate` they do."""
    level = coast(rock=6.0)
    sharp, blurred = (picture(renderer, level, water__model="albedo", water__blur=v) for v in (0.0, 4.0))
    assert (sharp == blurred).all()
    level.set("water.blur_distance_m", 0.5)
    sharp, blurred = (picture(renderer, level, water__model="plate", water__blur=v) for v in (0.0, 4.0))
    assert np.abs(sharp - blurred).max() > 1e-3


def test_the_land_above_water_is_as_it_was(renderer):
    """D01 D02: lit before the sea or after it, land looks the same."""
    level = coast()
    first, once = (picture(renderer, level, water__model=model) for model in ("plate", "albedo"))
    land = np.abs(picture(renderer, level, "material") - np.array([0.62, 0.5, 0.3])).max(axis=-1) < 0.01
    assert 0.1 < land.mean() < 0.9
    assert np.abs(first - once)[land].max() <= 1e-3 * once.max()


def bent_and_not(renderer, level, look, **settings):
    """What is seen through the water with the look bent, and straight."""
    return (picture(renderer, level, "emissive", look, water__bend=bend, **settings) for bend in (1.0, 0.0))


def stripes():
    """Shallow clear water over a bed of steps, whose edges show where they are seen."""
    y, x = np.mgrid[0:129, 0:129]
    level = Level(Grid(129, 129), np.where((x // 4 + y // 4) % 2 == 0, -1.2, -2.4).astype(np.float32))
    for name, value in {**STILL, "shore.on": False, "sea.wind_mps": 12.0, "foam.shore": 0.0}.items():
        level.set(name, value)
    return level


def test_bend_moves_what_is_seen_and_nothing_else(renderer):
    """H14: no bend shows the bed where it is; the bend shifts it by the waves' slope, the more the steeper they are."""
    look = camera(64.0, 64.0, 5.0, pitch=-89.0)
    level = stripes()
    bent, straight = bent_and_not(renderer, level, look, water__dispersion=0.0)
    hidden = Show.hide("refraction")
    renderer.draw(level, look, SIZE, 14.0, "emissive", quality="medium", show=hidden)
    assert np.array_equal(straight, renderer.read(linear=True))
    ripples = np.abs(bent - straight).mean()
    assert ripples > 0.01 * straight.mean()
    # a steeper surface bends further
    twice = picture(renderer, level, "emissive", look, water__bend=2.0)
    assert np.abs(twice - straight).mean() > 1.2 * ripples


def test_a_level_mirror_bends_nothing(renderer, monkeypatch):
    """H14: straight down through water without a wave on it the bent picture is the straight one."""
    from shorewright.renderer import look as look_uniforms

    monkeypatch.setattr(look_uniforms, "ripple_slopes", lambda sea, seed: np.full(2, 1e-12))
    level = stripes()
    level.set("sea.on", False)
    bent, straight = bent_and_not(renderer, level, camera(64.0, 64.0, 10.0, pitch=-90.0, yaw=0.0))
    assert np.abs(bent - straight).max() < 2e-3 * straight.max()


def test_dispersion_parts_red_from_blue(renderer):
    """H12: red is bent less than green and blue more: the share of the way that gives each channel back."""
    look = camera(64.0, 64.0, 5.0, pitch=-89.0)
    level = stripes()
    whole = {bend: picture(renderer, level, "emissive", look, water__bend=bend, water__dispersion=0.0)
             for bend in (0.75, 1.0, 1.25)}  # fmt: skip
    parted = picture(renderer, level, "emissive", look, water__bend=1.0, water__dispersion=0.5)
    for channel, bend in ((0, 0.75), (1, 1.0), (2, 1.25)):
        wrong = {b: np.abs(parted[..., channel] - seen[..., channel]).mean() for b, seen in whole.items()}
        assert min(wrong, key=wrong.get) == bend, (channel, wrong)
