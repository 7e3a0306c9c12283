"""The force simulation (D18)."""

import numpy as np
import pytest
from coasts import make_beach
from scenes import camera
from shorewright.level import Rect
from shorewright.level.force import FOAM_LASTS, MEMORY, SIDE, STEP_S, ForceField, force_field
from shorewright.level.objects import Disturbance, Mover
from shorewright.level.waves import sea_at
from shorewright.renderer.offscreen import render

CENTRE = (80.0, 60.0)


def stirred(**settings):
    level = make_beach(rows=257, slope=0.05)
    for name, value in settings.items():
        level.set(name, value)
    level.put_object("m", Mover(id="m", x=80, y=60, circle_m=5.0, speed_mps=3.0))
    level.put_object("b", Disturbance(id="b", x=74, y=62, time_s=3.0, radius_m=3.0, strength=4.0))
    return level


def test_fifty_movers_stay_bounded_and_it_comes_to_rest():
    """D18: ten seconds of a crowd: no NaN, under the limit; some decay times later nothing moves."""
    rng = np.random.default_rng(3)
    movers = [Mover(id=f"m{n}", x=60 + 40 * rng.random(), y=40 + 40 * rng.random(), speed_mps=6 * rng.random())
              for n in range(50)]  # fmt: skip
    level = make_beach()
    field = ForceField(level.settings.force, (60, 20), 0.0)
    for _ in range(round(10 / STEP_S)):
        field.step(movers, ())
        assert np.isfinite(field.state).all()
    packed = field.packed()
    assert 0.02 < np.abs(packed[..., 2]).max() <= level.settings.force.limit_m
    assert packed[..., 3].max() > 0.3
    for _ in range(round(2 * MEMORY * FOAM_LASTS * level.settings.force.decay_s / STEP_S)):
        field.step((), ())
    assert not field.state.any()


def test_it_scrolls_by_whole_cells_without_smearing():
    """D18: what stays in the window keeps its bits at its place in the world; what comes in is at rest."""
    level = stirred()
    field = force_field(level, 4.0, CENTRE)
    before, first = field.state.copy(), field.first
    field.scroll((first[0] + 9, first[1] - 5))
    assert np.array_equal(field.state[:, 5:, : SIDE - 9], before[:, : SIDE - 5, 9:])
    assert not field.state[:, :5].any()
    assert not field.state[:, :, SIDE - 9 :].any()


def test_a_pause_is_no_step_and_nothing_stirs_without_cause():
    """D18: the same time is the same state; no movers and no bursts, no field; the burst has its moment."""
    level = stirred()
    first = force_field(level, 4.0, CENTRE).state.copy()
    assert np.array_equal(force_field(level, 4.0, CENTRE).state, first)
    level.put_object("m", None)
    assert force_field(level, 2.9, CENTRE) is None
    assert np.abs(force_field(level, 3.2, CENTRE).state).max() > 0.1
    level.put_object("b", None)
    assert force_field(level, 4.0, CENTRE) is None


def test_strength_and_switch(renderer):
    """D18: one knob scales it all, the switch takes it away."""
    level = stirred()
    strong = np.abs(force_field(level, 4.0, CENTRE).packed()[..., 2]).max()
    level.set("force.strength", 0.2)
    assert np.abs(force_field(level, 4.0, CENTRE).packed()[..., 2]).max() < 0.5 * strong
    level.set("force.on", False)
    assert force_field(level, 4.0, CENTRE) is None


def test_the_quiet_area_holds_it_down():
    """D39: push, lift and foam by the painted strength, in one array for twin and shader; the state runs on."""
    level = stirred()
    free = force_field(level, 4.0, CENTRE).packed().copy()
    state = force_field(level, 4.0, CENTRE).state.copy()
    level.write("quiet", Rect(0, 0, level.grid.rows, 80), 1.0)
    level.set("quiet.force", 0.7)
    field = force_field(level, 4.0, CENTRE)
    held = field.packed()
    x = np.arange(SIDE) * field.settings.cell_m + field.origin_m[0]
    assert np.abs(free[:, x < 79]).max() > 0.1
    assert np.allclose(held[:, x < 79], 0.3 * free[:, x < 79], atol=1e-6)
    assert np.array_equal(held[:, x > 80], free[:, x > 80])
    assert np.array_equal(field.state, state)
    level.set("quiet.force", 0.0)
    assert np.array_equal(force_field(level, 4.0, CENTRE).packed(), free)
    level.set("quiet.force", 0.7)
    moved = force_field(level, 4.0, (CENTRE[0] - 500.0, CENTRE[1]))  # beyond the level nothing is painted
    assert np.isfinite(moved.packed()).all()


@pytest.mark.gl
def test_the_drawn_surface_is_lifted_as_the_twin_says(renderer):
    """D18, D30: the same array on both sides: within 3 cm of the drawn surface, and it is lifted at all."""
    level = stirred(**{"sea.on": False, "shore.on": False, "force.limit_m": 0.5})
    shot = camera(x=80.0, y=50.0, z=14.0, yaw=0.0, pitch=-55.0)
    place = render(level, shot, (160, 90), 4.0, "position", linear=True, renderer=renderer)
    sea = render(level, shot, (160, 90), 4.0, "sea_mask", linear=True, renderer=renderer)[..., 0] > 0.99
    field = level.derived["force"]
    sample = sea_at(level, 4.0, place[sea][:, 0], place[sea][:, 1], force=field)
    assert np.abs(sample.height_m - level.sea_level_m).max() > 0.05
    assert np.percentile(np.abs(sample.height_m - place[sea][:, 2]), 99) < 0.03
    foam = render(level, shot, (160, 90), 4.0, "force_foam", linear=True, renderer=renderer)[..., 0]
    assert foam.max() > 0.3
    again = render(level, shot, (160, 90), 4.0, "position", linear=True, renderer=renderer)
    assert np.array_equal(place, again)
