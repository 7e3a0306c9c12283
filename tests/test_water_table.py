"""Absorb and scatter tables (H15), and caustics (D08, H13)."""

import numpy as np
import pytest
from coasts import make_beach
from pydantic import ValidationError
from scenes import camera
from shorewright.level import BadInput
from shorewright.level.objects import WaterTable
from shorewright.level.textures import CAUSTICS_MEAN, caustics_texture
from shorewright.level.water_optics import absorption, backscatter
from shorewright.level.water_table import LENGTH_M, optics_table, water_table
from shorewright.renderer.offscreen import render

SHALLOWS = camera(x=80.0, y=60.0, z=20.0, yaw=0.0, pitch=-35.0)
RED = ((0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0), (4.0, 0.0, 0.0, 0.0, 0.3, 0.0, 0.0))


def picture(level, renderer, **options):
    return render(level, SHALLOWS, (128, 72), 3.0, renderer=renderer, **options)


def test_a_table_of_the_optics_is_the_closed_form():
    """H15: within half a percent everywhere between the stops."""
    water = make_beach().settings.water
    rows = water_table(optics_table("t", water))
    metres = np.linspace(0, LENGTH_M, rows.shape[1])[:, None]
    lost = absorption(water) + backscatter(water)
    left, deep = np.exp(-2 * metres * lost), 0.33 * backscatter(water) / lost
    assert np.abs(rows[0, :, :3] - left).max() < 0.005
    assert np.abs(rows[1, 512, :3] / deep - 1).max() < 0.01


@pytest.mark.gl
def test_tables_are_switched_live(renderer):
    """H15: one of the optics changes nothing one would see, another colours the sea; the switch goes back exactly."""
    level = make_beach(rows=257, slope=0.05)
    plain = picture(level, renderer)
    level.put_object("optics", optics_table("optics", level.settings.water))
    level.put_object("red", WaterTable(id="red", stops=RED))
    level.set("water.table", "optics")
    off = np.abs(picture(level, renderer).astype(int) - plain)
    assert np.percentile(off, 99) <= 3
    level.set("water.table", "red")
    red = picture(level, renderer)
    assert red[30:50, :, 0].mean() > plain[30:50, :, 0].mean() + 25
    level.set("water.table", "")
    assert np.array_equal(picture(level, renderer), plain)


def test_a_bad_table_is_told_in_a_sentence(renderer):
    """H15: an unknown name, stops out of range, too few of them."""
    level = make_beach()
    level.set("water.table", "lagoon")
    with pytest.raises(BadInput, match="no water table 'lagoon'"):
        picture(level, renderer)
    for stops in (RED[:1], ((0, 1, 1, 1, 0, 0, 7), RED[1])):
        with pytest.raises(ValidationError):
            WaterTable(id="t", stops=stops)
    assert WaterTable(id="t", stops=RED[::-1]).stops == RED


def test_caustics_tile_and_keep_the_light():
    """H13: the mean is 1, the wrap is as smooth as the inside, lines are much brighter than the mean."""
    light = caustics_texture()[..., 0] / CAUSTICS_MEAN
    assert light.mean() == pytest.approx(1.0, abs=0.03)
    assert np.percentile(light, 99) > 2.5
    steps = np.abs(np.diff(light, axis=1)).mean(), np.abs(light[:, 0] - light[:, -1]).mean()
    assert steps[1] < 1.5 * steps[0]


@pytest.mark.gl
def test_caustics_move_fade_with_depth_and_keep_the_mean(renderer):
    """D08: masked by the depth of the bed, by their own switch and strength."""
    level = make_beach(rows=257, slope=0.05)
    shot = camera(x=80.0, y=108.0, z=18.0, yaw=0.0, pitch=-89.0)
    seen = {t: render(level, shot, (160, 90), t, "caustics", linear=True, renderer=renderer)[..., 0] for t in (1, 3)}
    assert np.abs(seen[1] - seen[3]).mean() > 0.01
    assert seen[1].mean() == pytest.approx(0.3, rel=0.1)
    assert seen[1].std() > 0.02
    level.set("caustics.depth_m", 0.2)
    faint = render(level, shot, (160, 90), 1, "caustics", linear=True, renderer=renderer)[..., 0]
    assert faint.std() < 0.5 * seen[1].std()
    level.set("caustics.on", False)
    assert np.ptp(render(level, shot, (160, 90), 1, "caustics", linear=True, renderer=renderer)[..., 0]) < 1e-3
