"""How rivers look: flow, eddies, both layers of foam, where foam comes from, the mouth (D14 to D16, D19, D22, D35)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level import Rect
from shorewright.level.objects import Camera, Disturbance, River
from shorewright.level.plume import EDDIES, RUNS_MPS, TILE_HALVES
from shorewright.level.river_bed import carved
from shorewright.level.river_flow import river_flow
from shorewright.level.river_map import river_map
from shorewright.level.waves import sea_at
from shorewright.renderer import render

pytestmark = pytest.mark.gl
SIZE = (24, 64)
ABOVE = Camera(id="above", x=24, y=98, z=64, yaw_deg=0, pitch_deg=-89.9, fov_deg=50)
MOUTH = Camera(id="mouth", x=24, y=60, z=125, yaw_deg=0, pitch_deg=-89.9, fov_deg=50)


def brook(levels=(3.0, 2.9), mps=0.0, ends_m=72, width_m=12.0):
    """A beach with a river straight down it, 43 m long, its points evenly along; it flows as fast as is painted."""
    level = make_beach(rows=121, cols=49)
    for path in ("river.wave_m", "river.curl", "river.stagnant_still", "flow.shore_mps", "flow.rivers"):
        level.set(path, 0.0)
    way = np.linspace(0, ends_m - 115, len(levels))
    points = tuple((0.0, float(y), width_m, float(v), 1.0) for y, v in zip(way, levels, strict=True))
    river = River(id="river", x=24, y=115, points=points)
    level.write("height", *carved(level, river))
    level.put_object("river", river)
    paint(level, "flow", (0.0, -mps))
    return level


def paint(level, layer, value):
    level.write(layer, Rect(0, 0, 121, 49), np.asarray(value, np.float32))


def seen(level, renderer, view, camera=ABOVE, time_s=3.0):
    return render(level, camera, SIZE, time_s, view, linear=True, renderer=renderer, quality="low")


def buffers(level, renderer, camera=ABOVE, time_s=3.0):
    """What the water's pass wrote: foam, albedo, light from below, and from straight above the place."""
    seen(level, renderer, "flow_speed", camera, time_s)
    textures = next(iter(renderer.targets.values())).textures

    def read(name):
        texture = textures[name]
        kind = {"f1": np.uint8, "f2": np.float16, "f4": np.float32}[texture.dtype]
        values = np.frombuffer(texture.read(alignment=1), kind).reshape(*texture.size[::-1], texture.components)[::-1]
        return values / np.float32(255) if kind is np.uint8 else values.astype(np.float32)

    return {
        "material": read("g_material")[..., 1] * 255,
        "foam": read("g_material")[..., 2],
        "wet": read("g_material")[..., 3],
        "albedo": read("g_albedo")[..., :3] ** 2,
        "light": read("g_emissive")[..., :3],
        "xy": read("g_before"),
        "z": camera.z - read("g_eye_depth")[..., 0],
    }


def middle(picture):
    """The pixels over the river, away from its banks and ends."""
    return picture[12:-12, 10:14]


def test_foam_rises_with_speed_between_its_two_edges(renderer):
    """D15: smoothstep of the current's length, white from the high edge on; the drawn foam follows."""
    covers = []
    for mps in (0.5, 2.0, 5.0):
        level = brook(mps=mps)
        level.set("river.speed_low_mps", 1.0)
        level.set("river.speed_high_mps", 4.0)
        u = np.clip((mps - 1) / 3, 0, 1)
        np.testing.assert_allclose(middle(seen(level, renderer, "flow_speed")), u * u * (3 - 2 * u), atol=2e-3)
        covers.append(middle(buffers(level, renderer)["foam"]).mean())
    assert covers[0] < 0.02
    assert covers[0] + 0.05 < covers[1] < covers[2] - 0.2


def test_foam_lies_on_falls_and_nowhere_else(renderer):
    """D16: where the water's own level leans, whatever the bed and the ripples do."""
    level = brook(levels=(6.0, 5.98, 5.96, 5.94, 3.0, 2.98, 2.96, 2.94))  # 2.94 m over the fourth of seven parts
    drawn = buffers(level, renderer)
    white = seen(level, renderer, "river_normal_foam")[..., 0]
    y, foam = drawn["xy"][:, 12, 1], drawn["foam"]
    edge = 43 / 7
    on_it = np.abs(y - (115 - 3.5 * edge)) < 0.3 * edge
    off_it = (np.abs(y - (115 - 3.5 * edge)) > edge) & (y > 76) & (y < 112)
    foot = (y < 115 - 4.1 * edge) & (y > 115 - 4.6 * edge)
    assert white[on_it, 11:13].min() > 0.8
    assert white[off_it, 11:13].max() < 0.02
    assert foam[on_it, 11:13].mean() > 0.3
    assert foam[off_it & ((y > 101) | (y < 79)), 11:13].max() < 0.02
    assert foam[foot, 11:13].mean() > 0.3  # it boils where it comes down, and calms down


def test_a_fall_is_clear_over_its_lip(renderer):
    """D16: it comes down clear as far as the knob says, then breaks up; its strands go down with it."""
    level = brook(levels=(6.0, 5.98, 5.96, 5.94, 3.0, 2.98, 2.96, 2.94))
    covers, edge = [], 43 / 7
    for clear_m in (0.0, 1.2, 6.0):
        level.set("river.fall_clear_m", clear_m)
        drawn = buffers(level, renderer)
        y = drawn["xy"][:, 12, 1]
        covers.append(drawn["foam"][np.abs(y - (115 - 3.5 * edge)) < 0.4 * edge, 11:13].mean())
    assert covers[0] > covers[1] + 0.03 > covers[2] + 0.06
    later = buffers(level, renderer, time_s=3.2)["foam"]
    assert np.abs(later - drawn["foam"])[:, 11:13].max() > 0.02


def test_a_step_of_the_bed_draws_no_line_of_foam(renderer):
    """D16: no foam by depth on rivers, and none of the sea's shore."""
    level = brook(mps=2.0)
    level.set("river.speed_low_mps", 1.0)
    level.set("river.speed_high_mps", 3.6)
    before = middle(buffers(level, renderer)["foam"])
    assert 0.02 < before.mean() < 0.9
    bed = Rect(90, 20, 98, 29)
    level.write("height", bed, level.height[bed.slices] + np.float32(0.8))
    np.testing.assert_allclose(middle(buffers(level, renderer)["foam"]), before, atol=1 / 255 + 1e-6)


def test_each_layer_has_its_own_mask_and_look(renderer):
    """D14: painted stagnant foam is not painted turbulent foam; without paint there is neither."""
    level = brook()
    assert middle(buffers(level, renderer)["foam"]).max() < 0.01
    layers = []
    for amounts in ((0.6, 0.0), (0.0, 0.6)):
        paint(level, "river_foam", amounts)
        drawn = buffers(level, renderer)
        foam, albedo = middle(drawn["foam"]), middle(drawn["albedo"])
        assert foam.std() > 0.05
        thick = foam > 0.6 * foam.max()
        layers.append((foam, (albedo[thick] / foam[thick, None]).mean(axis=0)))
    assert np.abs(layers[0][0] - layers[1][0]).max() > 0.2
    assert layers[1][1].min() > 1.5 * layers[0][1].max()  # turbulent foam is the brighter


def test_no_curl_is_the_raw_flow_and_much_of_it_turns_the_flow_round(renderer):
    """D14: curl noise blended into the flow, none … extreme."""
    level = brook(mps=1.0)
    raw = seen(level, renderer, "river_raw_flow")
    np.testing.assert_array_equal(raw, seen(level, renderer, "river_flow_sum"))
    assert middle(raw)[..., 1].max() < 0.3  # southwards
    level.set("river.curl", 6.0)
    turned = middle(seen(level, renderer, "river_flow_sum"))
    assert turned[..., 1].min() < 0.3
    assert turned[..., 1].max() > 0.55


def test_a_push_cuts_stagnant_foam_and_it_grows_back(renderer):
    """D19: white before, gone where the water is pushed, back when the push has faded."""
    level = brook()
    paint(level, "river_foam", (0.9, 0.0))
    level.put_object("burst", Disturbance(id="burst", x=24, y=98, time_s=2.0, radius_m=3, strength=4))
    before, cut, healing, after = (
        seen(level, renderer, "river_masked", time_s=t)[28:36, 10:14, 1].mean() for t in (1.9, 2.5, 9.0, 40.0)
    )
    assert before > 0.2
    assert cut < 0.1 * before
    assert cut <= healing <= 1.05 * after
    assert after > 0.8 * before


def test_a_push_lifts_a_river_as_the_twin_says(renderer):
    """D18, D13: the force simulation acts on water at any level."""
    level = brook()
    level.set("force.limit_m", 0.5)
    level.put_object("burst", Disturbance(id="burst", x=24, y=98, time_s=2.0, radius_m=4, strength=8))
    drawn = buffers(level, renderer, time_s=2.5)
    x, y = np.moveaxis(middle(drawn["xy"]), -1, 0)
    still = sea_at(level, 2.5, x, y).height_m
    lift = sea_at(level, 2.5, x, y, force=level.derived["force"]).height_m - still
    seen_lift = middle(drawn["z"]) - still
    assert np.abs(lift).max() > 0.1
    # the low tier draws cells, not the surface of each pixel
    assert np.sqrt(np.mean((seen_lift - lift) ** 2)) < 0.3 * np.sqrt(np.mean(lift**2))


def test_banks_are_wet_a_little_above_the_water(renderer):
    """D22 for rivers: a band as high as the knob says, none without."""
    level = brook(levels=(3.0, 3.0))
    bands = []
    for wet_m in (0.0, 0.3):
        level.set("river.wet_m", wet_m)
        drawn = buffers(level, renderer)
        bank = (np.round(drawn["material"]) == 1) & (drawn["z"] > 3.0) & (drawn["xy"][..., 1] > 80)
        wet = bank & (drawn["wet"] > 0.3)
        bands.append(wet.sum())
        assert (drawn["z"][wet] < 3.0 + 1.6 * wet_m + 0.02).all()
    assert bands[0] == 0
    assert bands[1] > 20


def mouth(renderer, **settings):
    """Light out of the water along the middle from river to sea, and how far north each of it is."""
    level = brook(levels=(3.0, 1.5, 0.0), ends_m=66)
    level.set("flow.rivers", 1.0)
    for path in ("sea.on", "shore.on", "caustics.on", "fog.on"):
        level.set(path, False)
    for path, value in settings.items():
        level.set(path.replace("__", "."), value)
    drawn = buffers(level, renderer, MOUTH)
    y = drawn["xy"][:, 12, 1]
    there = (y > 2) & (y < 108)
    return drawn["light"][there][:, 11:13].mean(axis=1), y[there]


def test_colours_cross_the_mouth_without_a_line(renderer):
    """D35: the light out of the water changes along the middle as smoothly through the mouth as elsewhere."""
    clear, y = mouth(renderer, river__silt=0.0, river__humus=0.0)
    brown, _ = mouth(renderer, river__silt=20.0)
    far, inland = (y < 8), (y > 75)
    added = np.abs(brown - clear).max(axis=1)
    assert added[inland].min() > 0.05 * clear.max()
    assert added[far].max() < 0.1 * added[inland].min()
    steps = np.abs(np.diff(brown - clear, axis=0)).max(axis=1)
    assert steps[y[1:] < 75].max() < 0.25 * added.max()


def plumes(renderer, **settings):
    """The view `plume` of the mouth, and where its pixels lie."""
    level = brook(levels=(3.0, 1.5, 0.0), ends_m=66)
    level.set("flow.rivers", 1.0)
    for path in ("sea.on", "shore.on"):
        level.set(path, False)
    for path, value in settings.items():
        level.set(path.replace("__", "."), value)
    xy = buffers(level, renderer, MOUTH)["xy"]
    return level, seen(level, renderer, "plume", MOUTH), xy


def test_the_plume_is_the_jets_water(renderer):
    """D35: without eddies the shader's share of river water is the twin's, with no step to its sides."""
    level, shown, xy = plumes(renderer, mouth__waver=0.0, mouth__seam=0.0, mouth__blocked=0.0)
    jet = river_flow(level).mouths[0]
    assert jet.speed_mps > RUNS_MPS
    ahead, across = jet.off(xy[..., 0], xy[..., 1])
    out = (ahead > 1.6 * jet.half_m) & (xy[..., 1] > 1)
    wanted = jet.water(xy[..., 0], xy[..., 1])
    np.testing.assert_allclose(shown[..., 0][out], wanted[out], atol=4e-3)
    assert wanted[out].max() > 0.5
    assert wanted[out & (np.abs(across) > 15)].max() < 0.3
    assert not shown[..., 1].any()


def test_eddies_push_its_edge_and_foam_lies_along_it(renderer):
    """D35: with `waver` the edge is elsewhere, with `seam` there is foam by it and none in the middle."""
    level, even, _ = plumes(renderer, mouth__waver=0.0)
    _, shown, xy = plumes(renderer, mouth__waver=1.0)
    assert np.abs(shown[..., 0] - even[..., 0]).max() > 0.1
    jet = river_flow(level).mouths[0]
    ahead, across = jet.off(xy[..., 0], xy[..., 1])
    out = (ahead > 2 * jet.half_m) & (ahead < 0.6 * jet.reach_m)
    assert even[out & (np.abs(across) > 0.8 * jet.half_m), 1].max() > 0.1
    assert even[out & (np.abs(across) < 0.3 * jet.half_m), 1].max() < 0.02


def test_a_still_river_has_no_plume(renderer):
    """D35: no current, nothing goes out with it."""
    level, shown, xy = plumes(renderer, flow__on=False)
    jet = river_flow(level).mouths[0]
    ahead, _ = jet.off(xy[..., 0], xy[..., 1])
    assert not shown[ahead > 1.6 * jet.half_m].any()
    assert shown[..., 0].max() > 0.9


def test_chop_that_the_current_stops_is_white(renderer):
    """D35: foam in the buffer where the map says white, none of it with `blocked` 0."""
    covers = []
    for blocked in (0.0, 1.0):
        level = brook(levels=(3.0, 1.5, 0.0), ends_m=66)
        for path, value in {"flow.rivers": 1.0, "shore.on": False, "mouth.blocked": blocked, "mouth.seam": 0.0,
                            "mouth.flotsam": 0.0, "sea.wind_mps": 0.0, "foam.height": 0.0, "sea.chop_length_m": 3.0,
                            "river.speed_foam": 0.0}.items():  # fmt: skip
            level.set(path, value)
        drawn = buffers(level, renderer, MOUTH)
        white = river_map(level).at(*np.moveaxis(drawn["xy"].astype(float), -1, 0))["white"].v
        covers.append((drawn["foam"][white > 0.7], drawn["foam"][(white == 0) & (drawn["xy"][..., 1] < 60)]))
    assert covers[0][0].size > 10
    assert covers[1][0].mean() > covers[0][0].mean() + 0.05
    np.testing.assert_allclose(covers[1][1], covers[0][1], atol=1 / 255)


def test_eddies_go_down_the_jet_and_round_without_a_jump(renderer):
    """D35: after the time that a tile takes all of it is as before; half of that later it isn't."""
    level, _, _ = plumes(renderer, mouth__blocked=0.0)
    jet = river_flow(level).mouths[0]
    period_s = TILE_HALVES * jet.half_m / (EDDIES * jet.speed_mps)
    before, after, other = (seen(level, renderer, "plume", MOUTH, at * period_s) for at in (1 - 1e-5, 1 + 1e-5, 1.5))
    assert np.abs(after - before).max() < 0.03
    assert np.abs(other - before).max() > 0.1
