"""The sheet on the beach: it slides on the sand (H10), and all of the shore sways with one phase (H20)."""

import numpy as np
import pytest
from coasts import make_beach
from points import feedback, transform
from scenes import SIZE, camera, coast, is_sea
from shorewright.level import Level, Rect
from shorewright.level.beach_map import NO_BEACH_M, beach_map
from shorewright.level.objects import SeaPatch
from shorewright.level.pick import ground_at
from shorewright.level.shore import shore_map
from shorewright.level.shore_field import decode_beach_m, shore_field
from shorewright.level.shore_swash import uprush
from shorewright.level.shore_waves import before_waves
from shorewright.level.waves import sea_at, surface_at
from shorewright.renderer import render

QUANTUM_M = 4 / 256
ROCK = 80.0, 131.0, 1.3  # place, height


def rocky_beach(**shore):
    """A swaying beach with a boulder a few metres wide at the water line and a berm."""
    level = make_beach(rows=257, slope=0.04, sway=0.3)
    y, x = np.mgrid[0:257, 0:161].astype(np.float64)
    rock = ROCK[2] * np.exp(-((x - ROCK[0]) ** 2 + (y - ROCK[1]) ** 2) / 4)
    berm = 0.25 * np.exp(-(((y - 138) / 3) ** 2))
    level.write("height", level.grid.rect, level.height + (rock + berm).astype(np.float32))
    for name, value in shore.items():
        level.set(f"shore.{name}", value)
    return level


def on_the_beach(count=4000, seed=5):
    return np.random.default_rng(seed).uniform((5, 90), (155, 170), (count, 2)).astype(np.float32).T


@pytest.mark.gl
@pytest.mark.parametrize("t", [3.0, 8.7, 7 * 86_400.0])
def test_shader_and_twin_slide_on_the_same_sand_in_the_same_phase(ctx, t):
    """H10 H20 D30: height within 1 mm, thickness, normal and phase too, over the whole beach."""
    level = rocky_beach(stagger=0.3, runup_variety=0.5)
    x, y = on_the_beach()
    got = feedback(ctx, level, t, np.stack([x, y], 1))
    want = surface_at(level, t, x.astype(np.float64), y.astype(np.float64))
    assert np.abs(got[:, 2] - want.height_m).max() < 1e-3
    assert np.abs(got[:, 8] - want.sheet_m).max() < 1e-3
    assert np.abs(got[:, 9] - want.shore.arrived).max() < 1e-4
    assert (want.sheet_m < -0.05).sum() > 300
    assert (want.sheet_m > 0.05).sum() > 300
    crease = np.abs(want.sheet_m) < 1e-3
    assert np.abs(got[:, [7, 10]] - want.normal[:, :2])[~crease].max() < 5e-3


def test_the_surface_never_dips_below_the_sand():
    """H10: nowhere that the sea reaches, at no time; without the slide it does."""
    level = rocky_beach()
    x, y = (v.astype(np.float64) for v in on_the_beach())
    field = shore_field(level)
    at = np.rint(np.stack([y, x]) / field.cell_m).astype(int)
    y, x = at * field.cell_m
    sand = np.minimum(field.beach_m[*at], ground_at(level, x, y))
    near = (np.abs(sand) < 1.9) & (shore_map(level).at(x, y)["sea"].v > 0)
    for t in np.linspace(0, 18, 7):
        dip = (sand - surface_at(level, t, x, y).height_m)[near]
        assert dip.max() < 1.3 * QUANTUM_M
    level.set("shore.slide", False)
    assert (sand - surface_at(level, 3.0, x, y).height_m)[near].max() > 0.3


def test_the_slide_leaves_water_as_it_is():
    """H10: where water stands over the sand both are one; the sheet lies just under the sand elsewhere."""
    level = rocky_beach()
    x, y = (v.astype(np.float64) for v in on_the_beach())
    on = surface_at(level, 5.0, x, y)
    level.set("shore.slide", False)
    off = surface_at(level, 5.0, x, y)
    wet = on.sheet_m > 0
    assert wet.any()
    assert np.array_equal(on.height_m[wet], off.height_m[wet])
    assert np.array_equal(on.normal[wet], off.normal[wet])
    lying = on.height_m[~wet] - ground_at(level, x[~wet], y[~wet])
    assert lying.max() < 0
    assert np.median(lying) > -1.5 * QUANTUM_M


def test_a_coastal_hectare_has_no_contact():
    """H10, H27: where a patch is overridden as coastal the wave alone counts; away from it the sand holds the sheet."""
    level = rocky_beach()
    x, y = (v.astype(np.float64) for v in on_the_beach(1000))
    held = surface_at(level, 5.0, x, y)
    level.put_object("p", SeaPatch(id="p", x=50.0, y=150.0, sea="coastal"))
    patched = surface_at(level, 5.0, x, y)
    level.set("shore.slide", False)
    free = surface_at(level, 5.0, x, y)
    inside = (patched.x < 100) & (patched.y > 100) & (patched.y < 200)
    beyond = patched.x > 121
    lying = held.sheet_m < 0
    assert (inside & lying).any()
    assert (beyond & lying).any()
    np.testing.assert_allclose(patched.height_m[inside], free.height_m[inside], atol=1e-9)
    np.testing.assert_allclose(patched.height_m[beyond], held.height_m[beyond], atol=1e-9)


def test_the_sheet_starts_with_its_front_and_is_stopped_by_gravity():
    """D10: at the still water line the edge goes as fast as the front, at its furthest point it stands."""
    level = make_beach(rows=257, slope=0.05)
    shore = level.settings.shore
    arrival = shore.count / (1 + shore.runup) * shore.interval_s
    up_s = uprush(shore) * shore.interval_s
    spot = np.array([80.0]), np.array([130.0])

    def edge(t):
        return float(sea_at(level, t, *spot).shore.edge_s[0])

    front_per_s = (1 + shore.runup) / (shore.count * shore.interval_s)
    assert (edge(arrival + 0.02) - edge(arrival + 0.01)) / 0.01 == pytest.approx(front_per_s, rel=0.03)
    speeds = [abs(edge(arrival + up_s + k) - edge(arrival + up_s - k)) / (2 * k) for k in (0.01, 0.02)]
    assert max(speeds) < 0.02 * front_per_s
    assert edge(arrival + up_s) == pytest.approx(1 + shore.runup, rel=1e-6)


def test_rocks_poke_through_and_slices_end_at_two_metres():
    """H10: the sand has no rocks; 2 m above and below the still sea nothing holds the surface."""
    level = rocky_beach()
    x, y, height = (np.array([v]) for v in ROCK)
    assert sea_at(level, 0.0, x, y).height_m < ground_at(level, x, y) - 0.3 * height
    alpha = shore_field(level).packed[..., 3]
    sand = beach_map(level).packed[..., 0].astype(np.float64)
    inside = (alpha > 0) & (alpha < 255)
    assert inside.any()
    assert (~inside).any()
    assert (sand[~inside] == NO_BEACH_M).all()
    below = decode_beach_m(alpha)[inside] - sand[inside]
    assert below.min() >= 0.5 * QUANTUM_M
    assert np.median(below) < QUANTUM_M


def test_a_stroke_leaves_the_map_of_a_new_level():
    """H10 H20: windows give the bits of the whole map, so that a settled picture depends on the level alone."""
    level = rocky_beach()
    beach_map(level)
    step = Rect(120, 60, 150, 100)
    level.write("height", step, level.height[step.slices] - 0.7)
    changed = beach_map(level)
    fresh = Level(level.grid, level.height.astype(np.float32))
    assert np.array_equal(changed.packed, beach_map(fresh).packed)
    whole = changed.packed.shape[0] * changed.packed.shape[1]
    assert 0 < sum(rect.cells for rect in changed.changed_since(changed.log[0][0])) < whole


def test_the_sway_turns_along_the_shore_and_stands_across_it():
    """H20: on a straight shore the phase is one from the water to the run-up limit, and another some way along."""
    level = make_beach(rows=257, slope=0.04, sway=0.3)
    x, y = np.meshgrid(np.arange(20.0, 140.0, 2), np.arange(112.0, 146.0, 2))
    phase = sea_at(level, 2.0, x, y).shore.arrived
    assert np.ptp(phase, axis=0).max() < 0.02
    assert np.ptp(phase, axis=1).min() > 0.2
    assert np.abs(phase - phase.mean()).max() < 2 * 0.3
    far = beach_map(level).at(np.array([80.0]), np.array([10.0]))[1]
    assert far.v == 0  # beyond the range of the shore


def test_without_sway_the_shore_keeps_step():
    """H20: at 0 the rhythm's length changes nothing; with it fronts come at other times."""
    level = make_beach(rows=257, slope=0.04)
    x, y = (v.astype(np.float64) for v in on_the_beach(800))
    plain = surface_at(level, 4.0, x, y)
    level.set("shore.sway_m", 20.0)
    assert np.array_equal(plain.height_m, surface_at(level, 4.0, x, y).height_m)
    assert np.ptp(plain.shore.arrived) == 0
    level.set("shore.sway", 0.3)
    assert np.abs(plain.height_m - surface_at(level, 4.0, x, y).height_m).max() > 0.1


@pytest.mark.gl
@pytest.mark.parametrize("quality", ["low", "medium"])
@pytest.mark.parametrize("time_s", [4.0, 6.5])
def test_the_picture_shows_water_where_the_twin_has_some(renderer, quality, time_s):
    """H10: the sheet ends where the twin's does, without holes and without land fighting through it."""
    level = coast(slope=0.05)
    level.set("shore.sway", 0.2)
    shot = camera(y=138.0, z=4.0, pitch=-35.0, yaw=0.0)
    wet = is_sea(render(level, shot, SIZE, time_s, "material", None, quality, linear=True, renderer=renderer))
    at = render(level, shot, SIZE, time_s, "position", None, quality, linear=True, renderer=renderer).astype(float)
    sheet = sea_at(level, time_s, at[..., 0], at[..., 1]).sheet_m
    assert wet[sheet > 0.04].mean() > 0.995
    assert wet[sheet < -0.02].mean() < 0.005
    assert min(wet.mean(), 1 - wet.mean()) > 0.1


@pytest.mark.parametrize("settings", [{}, {"back": 0.8, "gap": 0.3}, {"width": 0.8, "back": 0.02}, {"fall": 0.3}])
def test_before_the_first_wave_every_mask_is_nothing(settings):
    """D03: what the shader leaves out there is exactly 0."""
    level = make_beach(rows=401, slope=0.08, sway=0.4)
    for name, value in settings.items():
        level.set(f"shore.{name}", value)
    x, y = np.random.default_rng(8).uniform((2, 2), (158, 200), (6000, 2)).T
    bed = shore_map(level).at(x, y)
    out = before_waves(level.settings.shore, bed)
    assert out.any()
    assert (~out).any()
    for t in np.linspace(0, 27, 9):
        masks = sea_at(level, t, x, y).shore
        for mask in (masks.a, masks.b, masks.line, masks.back, masks.fall, masks.lift.v, masks.lift.dx, masks.lift.dy):
            assert not mask[out].any()


COPIES = """
in vec2 in_at; out vec4 v_places; out float v_second;
#include "lib/foam_beach.glsl"
void main() {
    beach_ride = vec3(fract(in_at.x), floor(in_at.x), 1.0);
    beach_carried = vec2(0.0, in_at.y);
    vec2 first, second;
    beach_places(vec2(5.0, 3.0), 9.0, vec2(0.24, 0.2083), vec2(0.37, 0.61), first, second, v_second);
    v_places = vec4(first, second);
}
"""


@pytest.mark.gl
def test_foam_rides_the_beach_in_two_copies_that_cross_fade(ctx):
    """H20: weights 1 − |2φ − 1| at φ and φ + ½; a copy starts elsewhere only while its weight is 0, and else it goes
    with the sheet."""
    waves = np.arange(3.0, 6.0, 1 / 256)
    carried = 7 * np.sin(waves)
    got = transform(ctx, COPIES, np.stack([waves, carried], 1), {"v_places": 4, "v_second": 1}, {}, {})
    first, second, weight = got[:, :2], got[:, 2:4], got[:, 4]
    phase = waves % 1
    np.testing.assert_allclose(1 - weight, 1 - np.abs(2 * phase - 1), atol=1e-6)
    np.testing.assert_allclose(weight, 1 - np.abs(2 * ((phase + 0.5) % 1) - 1), atol=1e-6)
    for copy, share in ((first, 1 - weight), (second, weight)):
        at = copy * 9.0 + np.stack([np.zeros_like(carried), carried], 1)  # without what the sheet carries
        starts = np.abs(np.diff(at, axis=0)).max(axis=1) > 1e-3
        assert starts.sum() >= 2
        assert share[1:][starts].max() == 0
