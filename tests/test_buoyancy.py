"""Floating and drifting props (D12): on the drawn surface, as a function of time alone."""

import numpy as np
import pytest
from shorewright.level import Grid, Level, Rect
from shorewright.level.buoyancy import draft_of, hull_points, poses, surface_heights, turned
from shorewright.level.drift import MOST_S, drifted
from shorewright.level.meshes import block
from shorewright.level.objects import Disturbance, Prop

HULL = (1.4, 4.0, 0.8)
TIMES = (0.0, 3.3, 17.0, 604_800.0)


def sea(depth_m=20.0, side=129, hull=HULL, **settings):
    level = Level(Grid(side, side), np.full((side, side), -depth_m, np.float32))
    for name, value in settings.items():
        level.set(name.replace("__", "."), value)
    level.put_mesh("hull", block(hull))
    return level


def put(level, name="boat", **fields):
    thing = Prop(id=name, **{"mesh": "hull", "x": 64, "y": 60, "floats": True, "density": 0.5, **fields})
    level.put_object(name, thing)
    return thing


def water_line(level, t, name="boat"):
    """Mean over the hull points of the hull's water line less the drawn surface there, metres."""
    prop, pose = level.objects[name], poses(level, t)[name]
    points = hull_points(level, prop)
    bottom = prop.scale * level.meshes[prop.mesh].box[0, 2]
    local = np.column_stack([points, np.full(len(points), bottom + draft_of(level, prop))])
    world = pose.place + local @ pose.axes.T
    return float((world[:, 2] - surface_heights(level, t, world[:, :2])).mean())


STILL = {"sea__on": False, "shore__on": False}
SWELL = {"sea__swell_m": 1.5, "sea__swell_length_m": 60.0, "sea__chop_m": 0.0, "sea__phase_noise": 0.0}


@pytest.mark.parametrize("settings", [STILL, SWELL, {}], ids=["still", "swell", "sea"])
@pytest.mark.parametrize("density", [0.2, 0.5, 0.8])
def test_the_water_line_is_on_the_surface(settings, density):
    """D12: within 5 cm, at rest, on a long swell and on the sea as it comes."""
    level = sea(**settings)
    put(level, density=density, yaw_deg=35)
    for t in TIMES:
        assert abs(water_line(level, t)) < 0.05


def test_still_water_stands_still():
    """Nothing moves where nothing moves the water, and the axes stay upright."""
    level = sea(**STILL)
    put(level, yaw_deg=35, density=0.25)
    first, *others = (poses(level, t)["boat"] for t in TIMES)
    np.testing.assert_allclose(first.place, (64, 60, -0.2), atol=1e-9)
    np.testing.assert_allclose(first.axes, turned(35, 0, 0), atol=1e-9)
    for pose in others:
        np.testing.assert_allclose(pose.place, first.place, atol=1e-9)
        np.testing.assert_allclose(pose.axes, first.axes, atol=1e-9)


def test_headings_and_tilts():
    """Yaw clockwise from north, bow up, heeled to the right."""
    np.testing.assert_allclose(turned(90, 0, 0) @ (0, 1, 0), (1, 0, 0), atol=1e-12)
    assert (turned(0, 20, 0) @ (0, 1, 0))[2] > 0.3
    assert (turned(0, 0, 20) @ (1, 0, 0))[2] < -0.3
    axes = turned(130, 20, -40)
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1)


@pytest.mark.parametrize("yaw", [0.0, 70.0, 200.0])
def test_the_bow_follows_the_slope_of_the_waves(yaw):
    """On a swell much longer than the hull its axes are those of the surface: pitch is the slope along it."""
    level = sea(**SWELL)
    put(level, yaw_deg=yaw)
    pitches, slopes = [], []
    for t in np.arange(0, 12, 0.7):
        pose = poses(level, t)["boat"]
        bow = pose.axes[:, 1]
        flat = bow[:2] / np.hypot(*bow[:2])
        ends = pose.place[:2] + np.array([[1.0], [-1.0]]) * flat
        height = surface_heights(level, t, ends)
        pitches.append(bow[2] / np.hypot(*bow[:2]))
        slopes.append((height[0] - height[1]) / 2)
    assert np.ptp(slopes) > 0.05
    assert np.abs(np.array(pitches) - slopes).max() < 0.012


def test_a_large_hull_is_steadier_than_a_small_one():
    """Chop is shorter than a barge: it hardly tilts it, a dinghy it does."""
    level = sea(sea__swell_m=0.0, sea__chop_m=0.5, sea__chop_length_m=5.0)
    level.put_mesh("barge", block((6.0, 24.0, 2.0)))
    put(level, "small", density=0.3)
    put(level, "large", mesh="barge", x=70, y=70, density=0.3)
    tilt = {"small": [], "large": []}
    for t in np.arange(0, 20, 1.3):
        for name, pose in poses(level, t).items():
            tilt[name].append(np.degrees(np.arccos(pose.axes[2, 2])))
    assert np.mean(tilt["large"]) < 0.35 * np.mean(tilt["small"])
    assert np.mean(tilt["small"]) > 1


def test_time_alone_decides():
    """Stateless (D30): the same pose whatever was asked before, and whatever else floats."""
    level = sea()
    put(level)
    first = poses(level, 9.25)["boat"]
    for t in (100.0, 0.0, 9.0):
        poses(level, t)
    put(level, "other", x=30, y=40)
    again = poses(level, 9.25)["boat"]
    np.testing.assert_allclose(again.place, first.place, atol=1e-9)
    np.testing.assert_allclose(again.axes, first.axes, atol=1e-9)


def test_it_grounds_on_the_beach():
    """Where the water is too shallow the hull lies on the ground and takes its slope; nothing sinks into it."""
    level = sea(**STILL)
    y = np.arange(129)[:, None]
    level.write("height", Rect(0, 0, 129, 129), (0.1 * (y - 64)).astype(np.float32))
    put(level, y=90, yaw_deg=0)
    put(level, "stone", y=20, density=1.2, yaw_deg=0)
    found = poses(level, 5.0)
    for name, slope in (("boat", 0.1), ("stone", 0.1)):
        pose = found[name]
        assert pose.afloat == 0
        assert pose.place[2] == pytest.approx(0.1 * (pose.place[1] - 64), abs=0.05)
        assert pose.axes[2, 1] / pose.axes[1, 1] == pytest.approx(slope, abs=1e-6)
    level.set("water.on", False)
    put(level, "dry", y=30)
    assert poses(level, 5.0)["dry"].afloat == 0


def test_a_push_lifts_it():
    """D18 with D12: what bursts in the water lifts what floats there."""
    from shorewright.level.force import force_field

    level = sea(**STILL)
    put(level)
    level.put_object("burst", Disturbance(id="burst", x=66, y=60, time_s=4.8, radius_m=4, strength=5))
    field = force_field(level, 5.0, (64, 60))
    flat, pushed = poses(level, 5.0)["boat"], poses(level, 5.0, field)["boat"]
    assert abs(pushed.place[2] - flat.place[2]) > 0.01


# Drifting


def with_current(east, north, drag=0.5, **fields):
    level = sea(side=257, flow__shore_mps=0.0, things__drag=drag, **STILL)
    level.write("flow", level.grid.rect, np.array([east, north], np.float32))
    return level, put(level, drifts=True, x=60, y=60, **fields)


def test_a_drifting_thing_takes_on_the_current():
    """Speed c · (1 − e^(−drag t)), place its integral: drag's time constant is 1 / drag."""
    level, prop = with_current(0.6, 0.25, drag=0.4)
    flow = np.array([0.6, 0.25])
    draft = draft_of(level, prop)
    for t in (0.0, 0.3, 2.5, 10.0, 77.7):
        way = flow * (t - (1 - np.exp(-0.4 * t)) / 0.4)
        np.testing.assert_allclose(drifted(level, prop, t, draft), np.array([60, 60]) + way, atol=1e-3)
    one, two = (np.array(drifted(level, prop, t, draft)) for t in (2.5, 2.5001))
    np.testing.assert_allclose((two - one) / 1e-4, flow * (1 - np.exp(-1)), rtol=0.02)


def test_the_path_does_not_depend_on_what_was_asked():
    """D12: backwards, forwards, by steps or at once: the same place, in turning water too."""
    places = []
    for order in ((40.0, 3.0, 25.5), (25.5, 40.0, 3.0), (3.0, 7.0, 25.5, 33.0, 40.0)):
        level, prop = with_current(0.0, 0.0)
        x = np.arange(257)[None, :]
        level.write(
            "flow",
            level.grid.rect,
            np.stack(np.broadcast_arrays(0.5 + 0 * x, np.sin(x / 9)), -1) * np.ones((257, 1, 1)),
        )
        found = {t: drifted(level, prop, t, 0.4) for t in order}
        places.append([found[t] for t in (3.0, 25.5, 40.0)])
    assert places[0] == places[1] == places[2]
    assert places[0][2][0] > 70


def test_it_strands_and_stays():
    """It stops where the water is too shallow, at the border and after MOST_S, and a changed coast changes its path."""
    level, prop = with_current(2.0, 0.0)
    level.write("height", Rect(0, 100, 257, 257), np.float32(-0.1))
    ends = [drifted(level, prop, t, 0.4) for t in (100.0, 300.0, MOST_S, 1e6)]
    assert 95 < ends[0][0] <= 100
    assert ends[0] == ends[1] == ends[2] == ends[3]
    level.write("height", Rect(0, 100, 257, 257), np.float32(-9))
    border = drifted(level, prop, 1e6, 0.4)
    assert 250 < border[0] <= 256
    still, other = with_current(0.0, 0.0)
    assert drifted(still, other, 500.0, 0.4) == (60, 60)
    assert drifted(*with_current(1.0, 0.0, drag=0.0), 50.0, 0.4) == (60, 60)


def test_poses_of_drifting_things_follow_the_path():
    level, prop = with_current(0.5, 0.0)
    for t in (0.0, 30.0):
        pose = poses(level, t)["boat"]
        np.testing.assert_allclose(pose.place[:2], drifted(level, prop, t, draft_of(level, prop)), atol=1e-9)
        assert np.isfinite(pose.axes).all()


def test_lids_lie_within_the_hull():
    """The lid of a box is inside its walls, between water line and rim."""
    from shorewright.level.hull_lid import area, lid, section

    hull = block(HULL)
    made = lid(hull, 0.3)
    assert 0.3 < made.vertices[0, 2] < 0.8
    assert area(made.vertices) == pytest.approx(1.4 * 4.0, rel=0.05)
    assert area(made.vertices) < 1.4 * 4.0
    assert section(hull, 5.0) is None
    assert lid(hull, 2.0) is None
