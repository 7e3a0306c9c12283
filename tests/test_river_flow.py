"""How rivers run: the potential flow over their beds, and how the current takes it up (D13, D06)."""

import time

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app.arrival_lender import ArrivalLender
from shorewright.app.shared_maps import placed
from shorewright.level import Rect
from shorewright.level.drift import drifted
from shorewright.level.flow import FAR_M, current
from shorewright.level.objects import Prop, River
from shorewright.level.river_bed import carved
from shorewright.level.river_flow import flow_request, river_flow
from shorewright.level.river_map import river_shape

BENDS = ((0, 0, 9, 4.5, 1), (-14, -22, 9, 3.2, 1), (12, -46, 5, 2.0, 1), (4, -66, 9, 0.8, 1), (0, -84, 9, 0, 1))
STRAIGHT = ((0, 0, 12, 4, 1), (0, -25, 12, 3, 1), (0, -40, 6, 2.5, 1), (0, -50, 6, 2.3, 1), (0, -84, 12, 0, 1))


def coast(*lines, rows=161, cols=121):
    """A beach that rises to the north with rivers in beds of their own, given by (x, y, points)."""
    level = make_beach(rows=rows, cols=cols)
    for n, (x, y, points) in enumerate(lines):
        river = River(id=f"river{n}", x=x, y=y, points=points)
        level.write("height", *carved(level, river))
        level.put_object(river.id, river)
    return level


def through_rows(flow):
    """m³/s to the south through each row of the map's samples that it crosses, without its first and last ones."""
    south = -(flow.velocity[..., 1] * flow.depth_m).sum(1) * flow.cell_m
    wet = np.flatnonzero(flow.wet.any(1))
    return south[wet[6:-9]]


def test_a_river_keeps_its_discharge():
    """D13: the flux through any section of an unpainted river is constant within 1 %, round a rock in it too."""
    level = coast((60, 155, BENDS))
    flux = through_rows(river_flow(level))
    assert flux.mean() > 1.0
    np.testing.assert_allclose(flux, flux.mean(), rtol=0.01)
    level.write("height", Rect(130, 50, 134, 54), np.float32(9))  # rock
    flow = river_flow(level)
    row, col = 132 - flow.corner[0], 52 - flow.corner[1]
    assert not flow.wet[row, col]
    assert (flow.velocity[~flow.wet] == 0).all()
    rocky = through_rows(flow)
    np.testing.assert_allclose(rocky, rocky.mean(), rtol=0.01)


def test_it_is_faster_in_narrows_and_has_no_seam_in_the_middle():
    """D13: half as wide, about twice as fast; across a straight reach the heading turns by no step."""
    flow = river_flow(coast((60, 155, STRAIGHT)))
    speed = np.hypot(flow.velocity[..., 0], flow.velocity[..., 1])
    wide, narrow = (speed[155 - down - flow.corner[0], 60 - flow.corner[1]] for down in (15, 45))
    assert narrow / wide == pytest.approx(2.0, rel=0.25)
    across = flow.velocity[155 - 15 - flow.corner[0], 55 - flow.corner[1] : 66 - flow.corner[1]]
    heading = np.degrees(np.arctan2(across[:, 0], -across[:, 1]))
    assert np.abs(np.diff(heading)).max() < 3
    assert np.abs(np.diff(speed[155 - 15 - flow.corner[0], 56 - flow.corner[1] : 65 - flow.corner[1]])).max() < 0.1


def test_the_speed_is_near_what_its_points_say():
    """D13: one discharge for all of it, by the geometric mean."""
    level = coast((60, 155, STRAIGHT))
    flow, line = river_flow(level), river_shape(level).lines[0]
    middle = [flow.velocity[round(y) - flow.corner[0], round(x) - flow.corner[1]]
              for x, y in zip(line.x[5 : line.mouth - 5], line.y[5 : line.mouth - 5], strict=True)]  # fmt: skip
    assert np.exp(np.log(np.linalg.norm(middle, axis=1)).mean()) == pytest.approx(1.0, rel=0.1)


def test_rivers_that_meet_add_up_and_leave_by_one_mouth():
    """D13: a river that ends in another's water isn't stopped there."""
    side = ((0, 0, 4, 4.6, 1), (20, -20, 4, 3.4, 1), (36, -40, 4, 2.6, 1))
    alone = river_flow(coast((60, 155, STRAIGHT)))
    level = coast((22, 158, side), (60, 155, STRAIGHT))
    level.write("height", Rect(112, 51, 124, 58), np.float32(1))  # the bed dug last stands as a dam in the other
    flow = river_flow(level)
    assert len(flow.mouths) == 1
    assert flow.mouths[0].speed_mps > 1.15 * alone.mouths[0].speed_mps


def test_a_painted_lake_carries_what_comes_and_a_pool_stands():
    """D13, H32: painted water joined to a river carries its flow; nothing runs in a closed pool."""
    level = coast((60, 155, STRAIGHT))
    before = river_flow(level).mouths[0].speed_mps
    level.write("height", Rect(118, 66, 138, 84), np.float32(-1))
    level.write("river_mask", Rect(118, 62, 138, 84), np.float32(1))
    level.write("river_surface", Rect(118, 62, 138, 84), np.float32(2.9))
    level.write("height", Rect(20, 8, 32, 20), np.float32(-3))
    level.write("river_mask", Rect(20, 8, 32, 20), np.float32(1))
    level.write("river_surface", Rect(20, 8, 32, 20), np.float32(2.0))
    flow = river_flow(level)
    assert flow.mouths[0].speed_mps == pytest.approx(before, rel=0.2)
    speed = np.hypot(flow.velocity[..., 0], flow.velocity[..., 1])
    lake, pool = speed[128 - flow.corner[0], 75 - flow.corner[1]], speed[20 - flow.corner[0] : 32 - flow.corner[0]]
    assert 1e-3 < lake < 0.5
    assert pool[:, : 21 - flow.corner[1]].max() == 0


def painted_river(fall_m=3.0):
    """A bent ditch in flat ground, painted full of water whose level falls to the south."""
    level = make_beach(rows=161, cols=121)
    y, x = np.mgrid[20:140, 20:100].astype(float)
    middle = 60 + 12 * np.sin(y / 18)
    water = 6 + fall_m * (y - 20) / 120
    across = np.abs(x - middle) / (5 + 2 * np.sin(y / 9))
    rect = Rect(20, 20, 140, 100)
    level.write("height", rect, np.where(across < 1, water - 1.2 * (1 - across**2), water + 0.5))
    level.write("river_mask", rect, (across < 1).astype(np.float32))
    level.write("river_surface", rect, water)
    return level


def test_painted_water_runs_where_its_level_falls():
    """D13: as much through every section within 1 %, at the mean speed asked for; level water stands."""
    level = painted_river()
    flow = river_flow(level)
    flux = through_rows(flow)[4:-4]  # between its rims
    assert flux.mean() > 0.5
    np.testing.assert_allclose(flux, flux.mean(), rtol=0.01)
    speed = np.hypot(flow.velocity[..., 0], flow.velocity[..., 1])
    assert np.average(speed[flow.wet], weights=flow.depth_m[flow.wet]) == pytest.approx(0.7, rel=0.02)
    level.set("river.painted_mps", 1.4)
    np.testing.assert_allclose(river_flow(level).velocity, 2 * flow.velocity, rtol=1e-4, atol=1e-5)
    level.set("river.painted_mps", 0.0)
    assert not river_flow(level).velocity.any()
    assert not river_flow(painted_river(fall_m=0.0)).velocity.any()


def test_the_current_is_the_rivers_in_its_water_and_not_the_shores():
    """D06: no pull to the shore, no foam by its distance in a river; paint comes on top; a knob scales it."""
    level = coast((60, 155, STRAIGHT))
    flow, inside = river_flow(level), (60.0, 120.0)
    row, col = 120 - flow.corner[0], 60 - flow.corner[1]
    np.testing.assert_allclose(current(level).at(*inside), flow.velocity[row, col], atol=1e-6)
    assert current(level).packed[120, 60, 3] == FAR_M
    level.set("flow.rivers", 0.5)
    level.write("flow", level.grid.rect, np.array([0.3, 0.0], np.float32))
    np.testing.assert_allclose(current(level).at(*inside), 0.5 * flow.velocity[row, col] + (0.3, 0), atol=1e-6)


def test_coarse_samples_do_not_lose_a_narrow_river():
    """D06: three times as coarse as a river of two metres is laid, every sample on its way still carries it."""
    points = ((0, 0, 2, 4.5, 1), (10, -45, 2, 2.5, 1), (0, -84, 2, 0, 1))
    level = coast((60, 155, points))
    flow, line = river_flow(level), river_shape(level).lines[0]
    laid = flow.on((54, 41), 3.0)
    share = [laid[round(y / 3), round(x / 3), 2] for x, y in zip(line.x[4:70], line.y[4:70], strict=True)]
    assert min(share) > 0.5


def test_a_process_can_carry_it():
    """T14: the answer fits the block that is asked for, and is the same bits."""
    level = coast((60, 155, BENDS))
    request = flow_request(level, river_shape(level)).kept()
    found = request.answered()
    placed(found, memoryview(bytearray(request.answer_bytes)))
    np.testing.assert_array_equal(found.velocity, river_flow(level).velocity)


def test_things_float_down_it():
    """D12, D13: what drifts is carried down the river over ground that lies higher than the sea."""
    level = coast((60, 155, STRAIGHT))
    prop = Prop(id="log", mesh="block", x=60, y=150, floats=True, drifts=True)
    level.put_object("log", prop)
    east, north = drifted(level, prop, 40.0, 0.2)
    assert north < 130
    assert abs(east - 60) < 5


def test_a_release_asks_the_process_for_it():
    """T14: while it is worked out beside the window the last flow stands, then it is the same bits as at once."""
    level, lender = coast((60, 155, STRAIGHT)), ArrivalLender()
    seen = river_flow(level)
    level.solver = lender
    try:
        level.write("height", Rect(120, 50, 126, 60), np.float32(1))
        assert river_flow(level) is seen
        end = time.monotonic() + 60
        while river_flow(level) is seen:
            lender.look()
            assert time.monotonic() < end
            time.sleep(0.01)
        made = river_flow(level)
    finally:
        lender.close()
    level.derived.clear()
    level.solver = None
    assert river_flow(level).velocity.tobytes() == made.velocity.tobytes()
    assert river_flow(level).mouths == made.mouths
