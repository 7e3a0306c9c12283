"""The current (D05 D06 D39) and the foam it carries (D07 D09 D21 H18)."""

import numpy as np
import pytest
from coasts import make_beach
from scenes import camera
from shorewright.level import Rect
from shorewright.level.flow import current
from shorewright.level.objects import FlowPoint
from shorewright.renderer.offscreen import render
from shorewright.renderer.show import Show

ABOVE = camera(x=80.0, y=60.0, z=40.0, yaw=0.0, pitch=-89.0)
CALM = {"sea.on": False, "shore.on": False, "sea.wind_mps": 0.0, "flow.shore_mps": 0.0, "foam.shore": 0.0}


def beach(**settings):
    level = make_beach(rows=257, slope=0.05)
    for name, value in settings.items():
        level.set(name, value)
    return level


def still_beach(**settings):
    return beach(**{**CALM, **settings})


def foam(level, renderer, t, show=None, view="foam", shot=ABOVE):
    return render(level, shot, (160, 90), t, view, show, linear=True, renderer=renderer)[..., 0]


def test_the_current_runs_to_the_shore_by_itself():
    """D06: nothing painted: towards land off the beach, none on land, the set speed far enough from the shoreline."""
    flow = current(beach(**{"flow.shore_mps": 0.5}))
    east, north = flow.at(np.full(3, 80.0), np.array([100.0, 110.0, 200.0]))
    assert np.allclose(north[:2], 0.5, atol=0.05)
    assert np.allclose(east, 0.0, atol=0.05)
    assert abs(north[2]) < 1e-6


def test_a_flow_point_draws_the_water_and_is_calm_itself():
    """D06: B − A over its length times its speed; several add up; no NaN where there is no way."""
    level = still_beach()
    level.put_object("a", FlowPoint(id="a", x=80, y=60, speed_mps=0.8, radius_m=60))
    flow = current(level)
    assert np.isfinite(flow.packed).all()
    around = np.linspace(0, 2 * np.pi, 16, endpoint=False)
    x, y = 80 + 20 * np.cos(around), 60 + 20 * np.sin(around)
    east, north = flow.at(x, y)
    assert np.allclose(np.stack([east, north]), -0.8 * np.stack([np.cos(around), np.sin(around)]), atol=0.08)
    assert np.allclose(flow.at(80.0, 60.0), 0.0, atol=1e-6)
    level.put_object("b", FlowPoint(id="b", x=80, y=60, speed_mps=-0.8, radius_m=60))
    assert np.allclose(current(level).at(x, y), 0.0, atol=1e-6)


def test_paint_adds_and_the_quiet_area_holds_down():
    """D06, D39: painted current on top of the procedural one, both less where it is quiet."""
    level = beach(**{"flow.shore_mps": 0.5})
    level.write("flow", level.grid.rect, np.broadcast_to(np.float32([0.3, 0.0]), (*level.grid.shape, 2)))
    assert np.allclose(current(level).at(80.0, 105.0), [0.3, 0.5], atol=0.05)
    level.write("quiet", level.grid.rect, 1.0)
    assert np.allclose(current(level).at(80.0, 105.0), [0.3 * 0.4, 0.5 * 0.4], atol=0.05)
    level.set("flow.on", False)
    assert np.abs(current(level).packed[..., :2]).max() == 0


def painted(level, channel=1, amount=0.6):
    values = np.zeros((*level.grid.shape, 2), np.float32)
    values[..., channel] = amount
    level.write("foam", level.grid.rect, values)
    return level


@pytest.mark.gl
def test_still_water_shows_no_motion(renderer):
    """D05: no waves, no current: the foam lies where it lies."""
    level = painted(still_beach())
    first, later = (foam(level, renderer, t) for t in (0.0, 7.3))
    assert first.std() > 0.02
    assert np.array_equal(first, later)


@pytest.mark.gl
def test_a_constant_flow_moves_foam_and_keeps_its_mean(renderer):
    """D05: over a cycle the mean cover stays within 2 %; and the texture does move."""
    level = painted(still_beach())
    level.write("flow", level.grid.rect, np.broadcast_to(np.float32([0.4, 0.2]), (*level.grid.shape, 2)))
    seen = [foam(level, renderer, t) for t in np.linspace(0, level.settings.flow.interval_s, 9)]
    means = np.array([picture.mean() for picture in seen])
    assert np.abs(means / means.mean() - 1).max() < 0.02
    assert np.abs(seen[1] - seen[0]).mean() > 0.01


@pytest.mark.gl
def test_without_flow_masks_travel_and_textures_stand_still(renderer):
    """D05: the switch holds the textures; fronts go on."""
    level = painted(beach(**{"foam.shore": 0.0, "sea.on": False, "sea.wind_mps": 0.0}))
    off = Show.hide("flow")
    lines = [foam(level, renderer, t, off, "wave_line") for t in (2.0, 4.0)]
    assert np.abs(lines[0] - lines[1]).max() > 0.2
    level.write("flow", level.grid.rect, np.broadcast_to(np.float32([0.4, 0.2]), (*level.grid.shape, 2)))
    deep = camera(x=80.0, y=15.0, z=12.0, yaw=0.0, pitch=-89.0)  # beyond the shore waves
    moving = [foam(level, renderer, t, None, "foam", deep) for t in (2.0, 4.0)]
    held = [foam(level, renderer, t, off, "foam", deep) for t in (2.0, 4.0)]
    assert np.abs(moving[0] - moving[1]).mean() > 2 * np.abs(held[0] - held[1]).mean()


@pytest.mark.gl
def test_painted_layers_come_with_the_waves_or_stay(renderer):
    """D07: transient = painted × (back + fall), constant = painted."""
    transient = [foam(painted(beach(), 0), renderer, t, None, "foam_transient") for t in (2.0, 4.0)]
    assert np.abs(transient[0] - transient[1]).max() > 0.2
    assert transient[0].min() < 0.1
    constant = [foam(painted(beach(), 1), renderer, t, None, "foam_constant") for t in (2.0, 4.0)]
    assert constant[0].max() == pytest.approx(0.6, abs=0.01)
    calm = painted(still_beach(), 0)
    assert foam(calm, renderer, 2.0, None, "foam_transient").max() == 0


@pytest.mark.gl
def test_constant_foam_follows_the_shore_and_height_foam_the_crests(renderer):
    """H18: each part between its two edges."""
    shot = camera(x=80.0, y=118.0, z=26.0, yaw=0.0, pitch=-89.0)
    level = beach(**{"foam.shore": 0.5, "foam.shore_near_m": 2.0, "foam.shore_far_m": 10.0})
    shore, distance = (foam(level, renderer, 1.0, None, view, shot) for view in ("foam_shore", "shore_distance"))
    sea = foam(level, renderer, 1.0, None, "material", shot) == np.float32(0.1)
    assert shore[sea & (distance > 10.5)].max() == 0
    assert shore[sea & (distance > 0.5) & (distance < 1.5)].min() > 0.4
    high = foam(level, renderer, 1.0, None, "foam_height")
    assert 0 <= high.min() <= high.max() <= level.settings.foam.height + 1e-3


@pytest.mark.gl
def test_the_highest_crests_bear_some_foam_out_of_the_box(renderer):
    """H18: with nothing set, on some per cent of the open sea; none on a calm, none in a light wind."""
    level = beach()
    level.write("height", level.grid.rect, -30.0)
    look = camera(x=80.0, y=100.0, z=60.0, yaw=0.0, pitch=-60.0)
    share = np.mean([foam(level, renderer, t, None, "foam_height", look) > 0.1 for t in (0.0, 5.0, 11.0)])
    assert 0.003 < share < 0.12
    for name, value in (("sea.wind_mps", 3.0), ("sea.swell_m", 0.0)):
        level = beach(**{name: value})
        level.write("height", level.grid.rect, -30.0)
        assert foam(level, renderer, 5.0, None, "foam_height", look).max() == 0


@pytest.mark.gl
def test_foam_shades_the_bed_towards_the_sun(renderer):
    """D21: nothing without foam; black and white mask under it; less where the strength is less."""
    bare = foam(still_beach(), renderer, 1.0, None, "foam_shadow")
    assert bare[bare > 0].min() == 1.0
    level = painted(still_beach(), 1, 0.9)
    shade = foam(level, renderer, 1.0, None, "foam_shadow")
    wet = shade > 0
    assert shade[wet].min() < 0.7
    level.set("foam.shadow", 0.0)
    assert foam(level, renderer, 1.0, None, "foam_shadow")[wet].min() == 1.0


@pytest.mark.gl
def test_the_shade_lies_beside_its_foam(renderer):
    """D21: with the sun in the west the shade of a patch lies east of it, by the foam there, not the foam above."""
    level = still_beach()
    for name, value in {"light.sun_azimuth_deg": 270.0, "light.sun_elevation_deg": 20.0, "foam.shadow": 1.0,
                        "foam.shadow_limit_m": 4.0}.items():  # fmt: skip
        level.set(name, value)
    level.write("height", level.grid.rect, -8.0)
    level.write("foam", Rect(40, 60, 70, 90), np.array([0.0, 1.0], np.float32))
    look = camera(x=75.0, y=55.0, z=40.0, yaw=0.0, pitch=-90.0)
    shade = foam(level, renderer, 1.0, None, "foam_shadow", look)
    before = render(level, look, shade.shape[::-1], 1.0, "before", linear=True, renderer=renderer)
    dark = shade < 0.9
    shift = 4.0 * np.cos(np.radians(20.0))
    assert dark.sum() > 50
    assert before[dark][:, 0].min() > 60 + shift - 1.5
    assert before[dark][:, 0].max() > 90 + 0.5 * shift
    assert before[dark][:, 0].max() < 90 + shift + 1.5


@pytest.mark.gl
def test_foam_roughness_is_a_switch_of_its_own(renderer):
    """D09: albedo stays, only the roughness goes back to the water's."""
    level = painted(still_beach(), 1, 0.9)
    rough, white = (foam(level, renderer, 1.0, None, view) for view in ("roughness", "albedo"))
    level.set("foam.roughness", False)
    smooth, same = (foam(level, renderer, 1.0, None, view) for view in ("roughness", "albedo"))
    assert np.array_equal(white, same)
    assert rough[white > 0.2].mean() > smooth[white > 0.2].mean() + 0.1
