"""Streamlines of the current: along it, evenly spread, over water, drawn where no land hides them (T02)."""

import time

import numpy as np
import pytest
from exports import slope_level
from shorewright.app.cli import main
from shorewright.app.streamlines import StreamlineView, streamlines
from shorewright.io import write_level
from shorewright.level import Grid, Level
from shorewright.level.flow import current
from shorewright.level.flow_arrows import on_water
from shorewright.level.objects import Camera
from shorewright.renderer import Overlays, render


def whirl(side=96):
    """Water that turns about the middle of a pool with a block of land in the east."""
    ground = np.full((side, side), -3.0, np.float32)
    ground[30:60, 80:90] = 6.0
    level = Level(Grid(side, side), ground)
    y, x = np.mgrid[:side, :side] - 0.5 * side
    away = np.hypot(x, y)[..., None]
    level.write("flow", level.grid.rect, (np.stack([-y, x], -1) * 0.02 * np.exp(-((away / 24) ** 2))).astype("f4"))
    level.set("flow.shore_mps", 0.0)
    return level


def test_lines_run_along_the_current():
    """Each step goes the way of the water there; in a whirl a line keeps its distance from the middle."""
    level = whirl()
    lines = streamlines(level).lines
    assert len(lines) > 5
    checked = 0
    for line in lines:
        xy = line[:, :2]
        mid, way = 0.5 * (xy[1:] + xy[:-1]), np.diff(xy, axis=0)
        flow = np.stack(current(level).at(mid[:, 0], mid[:, 1]), -1)
        along = (way * flow).sum(-1) / np.maximum(np.hypot(*way.T) * np.hypot(*flow.T), 1e-9)
        body = along > 0.97
        assert body.mean() >= 0.6  # the rest are heads
        radius = np.hypot(xy[:, 0] - 48, xy[:, 1] - 48)
        if np.median(radius) > 6:
            assert np.percentile(np.abs(radius - np.median(radius)), 80) < 1.0
            checked += 1
        np.testing.assert_allclose(line[0, 3], np.hypot(*current(level).at(xy[:1, 0], xy[:1, 1])), atol=1e-6)
    assert checked > 3


def test_lines_are_evenly_spread_over_water():
    """No two lie in the same place, none on land, and most of the water that moves has one near it."""
    level = whirl()
    lines, water = streamlines(level).lines, current(level)
    places = np.concatenate([line[:, :2] for line in lines])
    assert on_water(water, *places.T).mean() > 0.98  # a head's barb may touch the shore
    y, x = np.mgrid[2:94:3, 2:94:3].reshape(2, -1).astype(float)
    fast = np.hypot(*water.at(x, y)) > 0.05
    near = np.hypot(x[fast, None] - places[:, 0], y[fast, None] - places[:, 1]).min(1)
    assert (near < 5).mean() > 0.95
    assert streamlines(Level(Grid(9, 9), np.full((9, 9), -3.0, np.float32))).lines == ()


def test_as_many_lie_beside_each_other_as_are_asked_for():
    """T02: twice as many across the level, twice as many lines at least; no nearer than cells leave room for."""
    level, lines = whirl(), {}
    for across in (12, 24, 32, 72):
        level.set("flow.streamlines", across)
        lines[across] = streamlines(level).lines
    assert len(lines[24]) > 2 * len(lines[12]) > 20
    assert all(np.array_equal(a, b) for a, b in zip(lines[32], lines[72], strict=True))


def test_they_are_traced_once_for_a_current():
    """In a thread, kept by the current: what is drawn meanwhile are the ones before."""
    level, view = whirl(64), StreamlineView()

    def settled():
        ends = time.monotonic() + 30
        found = view.lines(level)
        while (view.busy or found is None) and time.monotonic() < ends:
            time.sleep(0.005)
            found = view.lines(level)
        return view.lines(level)

    assert view.lines(level) is None
    first = settled()
    assert first.lines
    assert settled() is first
    level.set("flow.painted", 0.5)
    assert view.lines(level) is first
    while settled() is first:
        pass
    second = settled()
    assert max(line[:, 3].max() for line in second.lines) < max(line[:, 3].max() for line in first.lines)


@pytest.mark.gl
def test_they_are_drawn_on_water_in_front_of_land_alone(renderer):
    """From the east the block hides what lies behind it; the sky stays clear."""
    level = whirl()
    lines = streamlines(level)
    high = Camera(id="c", x=48, y=-10, z=40, yaw_deg=0, pitch_deg=-35)
    behind = Camera(id="d", x=94, y=45, z=2.5, yaw_deg=270, pitch_deg=0)
    changed = []
    for camera in (high, behind):
        plain, shown = (
            render(level, camera, renderer=renderer, size=(96, 54), quality="low", overlays=Overlays(streamlines=what))
            for what in (None, lines)
        )
        changed.append((plain != shown).any(-1))
    assert 0.03 < changed[0].mean() < 0.8
    assert not changed[0][:4].any()
    assert not changed[1][:, 20:76].any()


def test_the_verb_hands_them_to_the_picture(tmp_path, monkeypatch):
    """Nothing is traced unless asked for."""
    write_level(slope_level(40, 48), tmp_path / "bay.shore")
    drawn = []
    monkeypatch.setattr("shorewright.app.commands.pictures._draw", lambda *given: drawn.append(given[5]))
    for more in ([], ["--streamlines"], ["--arrows"]):
        assert main(["render", str(tmp_path / "bay.shore"), "-o", str(tmp_path / "x.png"), *more]) == 0
    plain, lines, arrows = drawn
    assert "overlays" not in plain
    assert lines["overlays"].streamlines.lines
    assert arrows["overlays"].streamlines is None
