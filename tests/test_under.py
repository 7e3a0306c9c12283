"""What is seen through the sea: plates of the land lit before it, and the older way of bent albedo (D02, H12, H14)."""

import numpy as np
import pytest
from shorewright.level import Grid, Level

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
