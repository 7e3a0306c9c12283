"""Faults of a painted flow and arrows of the current (T02)."""

import json
from pathlib import Path

import numpy as np
import pytest
from shorewright.app.cli import main
from shorewright.io import read_level, write_level
from shorewright.level import Grid, Level
from shorewright.level.flow_arrows import flow_arrows
from shorewright.level.flow_lint import flow_faults
from shorewright.level.objects import Camera, FlowPoint
from shorewright.renderer import Overlays, render
from test_rivers import coast

SAMPLES = Path(__file__).parents[1] / "sample_levels"


def basin(side=64):
    """Still water 3 m deep with a block of land, 2 m cells."""
    ground = np.full((side, side), -3.0, np.float32)
    ground[20:30, 40:50] = 2.0
    return Level(Grid(side, side, 2.0), ground)


def painted(values):
    level = basin()
    level.write("flow", level.grid.rect, values.astype(np.float32))
    return level


def turning(side=64, rate=0.03, row=32.0, col=20.0):
    """Water that turns about a cell: no divergence."""
    y, x = np.mgrid[:side, :side]
    fade = np.exp(-((x - col) ** 2 + (y - row) ** 2) / 60)
    return np.stack([-(y - row) * rate * fade, (x - col) * rate * fade], -1)


def kinds(level, **options):
    return [fault.kind for fault in flow_faults(level, **options)]


def test_nothing_painted_and_nothing_wrong():
    """A whirl of 8 cells of radius keeps its water: divergence of its samples is small."""
    assert kinds(basin()) == []
    assert kinds(painted(turning())) == []


def test_water_of_a_line_is_water():
    """D13: paint that runs across a river into its bank is told; down the river it is not."""
    level = coast()
    flow = np.zeros((*level.grid.shape, 2), np.float32)
    flow[120:140, 60, 1] = -0.5
    level.write("flow", level.grid.rect, flow)
    assert "ashore" not in kinds(level)
    flow[120:140, 58:66] = (0.5, 0.0)
    level.write("flow", level.grid.rect, flow)
    assert "ashore" in kinds(level)
    level.put_object("river", None)
    assert "ashore" not in kinds(level)  # dry ground


@pytest.mark.parametrize("name", ["cove", "delta"])
def test_sample_levels_have_no_faults(name):
    assert flow_faults(read_level(SAMPLES / f"{name}.shore")) == []


@pytest.mark.parametrize("step", [0.5 / 127.5, -0.5 / 127.5, 1 / 127])
def test_drift_of_an_8_bit_neutral(step):
    """T02: 0.5 cannot be said in 8 bits: still water that was decoded so creeps."""
    flow = turning()
    flow[np.hypot(flow[..., 0], flow[..., 1]) < 0.02] = 2.0 * step
    faults = flow_faults(painted(flow), range_mps=2.0)
    assert [fault.kind for fault in faults] == ["drift"]
    assert faults[0].value == pytest.approx(2 * abs(step) * np.sqrt(2), abs=1e-5)
    assert faults[0].cells > 1000


def test_water_into_land():
    """The worst cell of the block's west side, in metres, with the speed there."""
    flow = np.zeros((64, 64, 2))
    flow[22:28, 30:40, 0] = 0.5
    flow[25, 39, 0] = 0.8
    fault = next(fault for fault in flow_faults(painted(flow)) if fault.kind == "ashore")
    assert (fault.x, fault.y) == (39 * 2.0, 25 * 2.0)
    assert fault.value == pytest.approx(0.8)
    away = painted(-flow)
    assert "ashore" not in kinds(away)


def test_clipped_speeds():
    level = painted(turning(rate=1.5))
    level.set("flow.shore_mps", 0.0)
    fastest = np.abs(level.layers["flow"].array).max()
    fault = next(fault for fault in flow_faults(level, range_mps=2.0) if fault.kind == "clipped")
    assert fault.value == pytest.approx(fastest, abs=1e-5)
    assert "clipped" not in kinds(level, range_mps=float(fastest) + 0.01)
    assert "clipped" not in kinds(level)  # the export takes the range that holds it
    level.set("flow.export_mps", 1.0)
    assert "clipped" in kinds(level)


def test_whole_current_is_looked_at():
    """T02: nothing is painted, yet flow points clip; paint made so weak that it is a step of the bytes drifts."""
    level = basin()
    level.put_object("here", FlowPoint(id="here", x=60, y=60, radius_m=40, speed_mps=3))
    assert kinds(level) == []
    assert kinds(level, range_mps=1.0) == ["clipped"]
    level = painted(np.broadcast_to(np.array([0.5, 0.5]), (64, 64, 2)))
    level.set("flow.shore_mps", 0.0)
    level.set("flow.painted", 0.02)
    assert "drift" not in kinds(level)
    level.set("flow.export_mps", 1.0)
    (fault,) = (fault for fault in flow_faults(level) if fault.kind == "drift")
    assert fault.value == pytest.approx(0.02 * 0.5 * np.sqrt(2), rel=1e-4)
    assert "129, 129" in fault.sentence


def test_sources_and_sinks():
    """Water that leaves a place on all sides: the number is its divergence."""
    y, x = np.mgrid[:64, :64]
    fade = np.exp(-((x - 20) ** 2 + (y - 45) ** 2) / 20)[..., None]
    level = painted(np.stack([x - 20, y - 45], -1) * 0.2 * fade)
    fault = next(fault for fault in flow_faults(level) if fault.kind == "divergence")
    assert (fault.x, fault.y) == (40.0, 90.0)
    assert fault.value == pytest.approx(0.2 * np.exp(-1 / 20) * 2 / 2, rel=0.01)  # two ways, cells of 2 m
    assert "nowhere" in fault.sentence


def test_the_verb(capsys, tmp_path):
    """Exit code 1 and a row for each fault; 0 where there is none; 2 for a range that is none."""
    y, x = np.mgrid[:64, :64]
    bad, good = painted(np.stack([x - 20.0, y - 45.0], -1) * 0.1), basin()
    for name, level in (("bad", bad), ("good", good)):
        write_level(level, tmp_path / f"{name}.shore")
    assert main(["lint", str(tmp_path / "bad.shore"), "--range", "2", "--json"]) == 1
    rows = json.loads(capsys.readouterr().out)
    assert {"divergence", "clipped"} <= {row["kind"] for row in rows}
    assert main(["lint", str(tmp_path / "good.shore")]) == 0
    assert "no faults" in capsys.readouterr().out
    assert main(["lint", str(tmp_path / "good.shore"), "--range", "0"]) == 2


def test_arrows_go_the_way_of_the_water():
    """T02: each runs along the current there, longer where it is faster, on a lattice that does not move."""
    level = painted(np.broadcast_to(np.array([0.6, 0.0]), (64, 64, 2)))
    level.set("flow.shore_mps", 0.0)
    arrows = flow_arrows(level, 60, 60, 10)
    assert len(arrows) > 100
    for line in arrows:
        start, *_, tip, _ = map(np.array, line)
        way = tip - start
        assert way[0] > 0.2
        assert abs(way[1]) < 1e-3
        assert start[2] == pytest.approx(0.05)
    starts = {tuple(line[0]) for line in arrows}
    moved = {tuple(line[0]) for line in flow_arrows(level, 61.3, 60.4, 10)}
    assert len(starts & moved) > 0.8 * len(starts)
    lone = max(np.hypot(*(np.array(line[-2]) - line[0])[:2]) for line in arrows)
    level.set("flow.painted", 0.5)
    assert max(np.hypot(*(np.array(a[-2]) - a[0])[:2]) for a in flow_arrows(level, 60, 60, 10)) < lone
    assert flow_arrows(basin_still(), 60, 60, 10) == []


def test_arrows_stay_off_dry_land_unless_paint_is_shown():
    """T02: paint lies on the block of land too; its arrows belong to the painted layer alone. Speeds come along."""
    level = painted(np.broadcast_to(np.array([0.6, 0.0]), (64, 64, 2)))
    level.set("flow.shore_mps", 0.0)
    wet, dry = (np.array([line[0] for line in flow_arrows(level, 90, 50, 10, dry)]) for dry in (False, True))
    on_land = [((points[:, 0] > 83) & (points[:, 0] < 95) & (points[:, 1] > 43) & (points[:, 1] < 55)).sum()
               for points in (wet, dry)]  # fmt: skip
    assert on_land[0] == 0
    assert on_land[1] >= 4
    assert wet[:, 3] == pytest.approx(0.6)


def basin_still():
    level = basin()
    level.set("flow.shore_mps", 0.0)
    return level


@pytest.mark.gl
def test_arrows_are_drawn(renderer):
    """T02: they change the picture over water and nothing else."""
    level = painted(np.broadcast_to(np.array([0.6, 0.0]), (64, 64, 2)))
    camera = Camera(id="c", x=60, y=20, z=12, yaw_deg=0, pitch_deg=-25)
    plain, shown = (
        render(level, camera, renderer=renderer, size=(96, 54), quality="low", overlays=Overlays(arrows=arrows))
        for arrows in (False, True)
    )
    changed = (plain != shown).any(-1)
    assert 0.01 < changed.mean() < 0.7
    assert not changed[:3].any()  # the sky
