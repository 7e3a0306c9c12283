"""The whole current in bytes: one code, still water stands, what exporters write and `check` decodes (T02, T10)."""

import json

import numpy as np
import pytest
from exports import MANIFEST, sign, slope_level
from hypothesis import given
from hypothesis import strategies as st
from shorewright.io.export import check, export
from shorewright.io.images import read_image, write_image
from shorewright.level import BadInput, Grid, Level
from shorewright.level.flow import current
from shorewright.level.flow_bytes import MOST, NEUTRAL, coded, decoded, encoded, fitting_range, flow_bytes
from shorewright.level.objects import Camera
from shorewright.renderer import render


@given(st.floats(-8, 8), st.floats(-8, 8), st.floats(0.125, 16))
def test_there_and_back(east, north, range_mps):
    """T02: within half a step inside the range, the range itself beyond it; never a byte 0."""
    values = encoded(np.array([east, north]), range_mps)
    assert values.dtype == np.uint8
    assert values.min() >= 1
    wanted = np.clip([east, north], -range_mps, range_mps)
    np.testing.assert_allclose(decoded(values, range_mps), wanted, atol=0.5 * range_mps / MOST * (1 + 1e-9))


@pytest.mark.parametrize("range_mps", [0.125, 0.3, 1.0, 7.7, 64.0])
def test_still_water_is_exactly_still(range_mps):
    """T02: 0 is a byte of its own, also as a sampler's float; every byte comes back as itself."""
    assert (encoded(np.zeros((3, 2)), range_mps) == NEUTRAL).all()
    assert not decoded(np.full((3, 2), NEUTRAL), range_mps).any()
    sampled = np.float32(NEUTRAL / 255) * np.float32(255)
    assert not decoded(np.full(2, sampled), range_mps).any()
    every = np.stack([np.arange(1, 256), np.full(255, NEUTRAL)], -1).astype(np.uint8)
    assert (encoded(decoded(every, range_mps), range_mps) == every).all()


@pytest.mark.parametrize(("fastest", "range_mps"), [(0.0, 0.125), (0.1, 0.125), (0.3, 0.5), (1.0, 1.0), (1.01, 2.0)])
def test_range_is_the_smallest_power_of_two(fastest, range_mps):
    assert fitting_range(fastest) == range_mps


def test_a_levels_bytes_follow_its_current_and_setting():
    """T02: kept while nothing changes; a range asked for is taken, and what is over it clipped; B is the water."""
    level = slope_level()
    level.write("flow", level.grid.rect, np.array([0.9, -0.2], np.float32))
    coded_now = flow_bytes(level)
    assert flow_bytes(level) is coded_now
    flow = current(level).packed
    assert coded_now.range_mps == fitting_range(np.abs(flow[..., :2]).max())
    assert np.abs(decoded(coded_now.bytes, coded_now.range_mps) - flow[..., :2]).max() <= coded_now.step_mps / 2 + 1e-7
    assert ((coded_now.bytes[..., 2] == 255) == (flow[..., 3] > 0)).all()
    level.set("flow.export_mps", 0.5)
    clipped = flow_bytes(level)
    assert clipped.range_mps == 0.5
    assert clipped.bytes[..., 0].max() == NEUTRAL + MOST
    assert decoded(clipped.bytes, 0.5).max() == 0.5
    assert coded(current(level), 4.0).bytes[..., 0].max() < 2 * NEUTRAL - 64


@pytest.mark.parametrize("target", ["raw", "unreal"])
def test_exported_bytes_are_the_levels(tmp_path, target):
    """T10: north first, no colour tags, decoded by the manifest's own numbers; the same bytes in every target."""
    level = slope_level(sea_m=2.0)
    export(level, target, tmp_path / "out", only="flow", name="bay")
    (record,) = json.loads((tmp_path / "out" / MANIFEST).read_text("utf-8"))["files"]
    path = tmp_path / "out" / "bay_flow.png"
    values, numbers = read_image(path), record["decode"]["numbers"]
    assert (values[::-1] == flow_bytes(level).bytes).all()
    assert not any(tag in path.read_bytes() for tag in (b"sRGB", b"gAMA", b"iCCP"))
    flow = (values[..., :2].astype(float) - 128) / 127 * numbers["range_mps"]
    truth = current(level).packed[::-1, :, :2]
    off = 100 * np.abs(flow - truth).max()
    assert record["max_error"] == pytest.approx(off, abs=1e-9)
    assert off <= record["step"] / 2 + 1e-6
    assert not flow[truth == 0].any()
    assert numbers["row_0_y_m"] == 29.0
    assert check(tmp_path / "out") == []


@pytest.mark.parametrize(
    "wrong",
    [
        lambda v: v[::-1],
        lambda v: v[:, ::-1],
        lambda v: v[..., [1, 0, 2]],
        lambda v: v - np.array([1, 1, 0], np.uint8),  # 127 taken for neutral: still water drifts
        lambda v: 255 - v,
    ],
)
def test_wrong_bytes_are_found_though_every_hash_fits(tmp_path, wrong):
    """T10: mirrored, swapped, a step beside zero: only decoding tells."""
    export(slope_level(), "raw", tmp_path / "out", only="flow", name="bay")
    path = tmp_path / "out" / "bay_flow.png"
    write_image(path, np.ascontiguousarray(wrong(read_image(path))), data=True)
    sign(tmp_path / "out", lambda data: None)
    assert any("bay_flow.png" in finding for finding in check(tmp_path / "out"))


@pytest.mark.parametrize(
    "edit",
    [
        lambda d: d["files"][0]["decode"]["numbers"].update(range_mps=4.0),
        lambda d: d["files"][0]["decode"]["numbers"].update(cell_m=1.5),
        lambda d: d["files"][0]["decode"]["numbers"].update(row_0_y_m=30.0),
        lambda d: d["files"][0]["decode"]["numbers"].pop("fastest_mps"),
        lambda d: d["files"][0]["decode"].update(formula="v = 2 t - 1"),
        lambda d: d["files"][0].update(max_error=50.0),
        lambda d: d["files"][0].update(max_error=0.0),
        lambda d: d["files"][0].update(width=40),
        lambda d: d["flow_probes"][0].update(row=4000),
        lambda d: d.update(flow_probes=[]),
    ],
)
@pytest.mark.parametrize("target", ["raw", "unreal"])
def test_wrong_statements_about_the_current_are_found(tmp_path, target, edit):
    export(slope_level(), target, tmp_path / "out", only="flow", name="bay")
    sign(tmp_path / "out", edit)
    assert check(tmp_path / "out")


def test_clipped_and_still_levels(tmp_path):
    """T02: a range too small is said and within what it costs; a level where nothing moves has no such map."""
    level = slope_level()
    level.set("flow.export_mps", 0.125)
    export(level, "raw", tmp_path / "out", only="flow", name="bay")
    manifest = json.loads((tmp_path / "out" / MANIFEST).read_text("utf-8"))
    assert any("clips" in line for line in manifest["import_recipe"])
    assert check(tmp_path / "out") == []
    still = Level(Grid(9, 9), np.full((9, 9), 3.0, np.float32))
    assert flow_bytes(still).still
    assert len(export(still, "unreal", tmp_path / "still", only=["height", "flow"])) == 2
    with pytest.raises(BadInput, match="nothing of that"):
        export(still, "unreal", tmp_path / "none", only="flow")


def moved_pool():
    """A pool without waves; in its eastern half the paint runs, in the western all is still."""
    level = Level(Grid(96, 96), np.full((96, 96), -4.0, np.float32))
    painted = np.zeros((96, 96, 2), np.float32)
    painted[:, 48:] = 0.7, 0.3
    level.write("flow", level.grid.rect, painted)
    for name in ("flow.shore_mps", "sea.swell_m", "sea.chop_m"):
        level.set(name, 0.0)
    level.set("shore.on", False)
    return level


@pytest.mark.gl
def test_view_of_the_bytes_moves_where_they_do(renderer):
    """T02: two moments differ where the bytes say so, in nothing where the current is zero."""
    level = moved_pool()
    camera = Camera(id="c", x=48, y=20, z=30, yaw_deg=0, pitch_deg=-60)
    now, later = (
        render(level, camera, (96, 54), time_s, view="flow_exported", renderer=renderer).astype(int)
        for time_s in (4.0, 5.3)
    )
    changed = (now != later).any(-1)
    assert not changed[:, :46].any()
    assert changed[:, 52:].mean() > 0.4
    assert now[:, :46].std() > 10  # foam lies there too


@pytest.mark.gl
def test_gpu_decodes_as_the_cpu(renderer):
    """T02: what is lost stays within the rounding of both components; a range too small shows what it cuts off."""
    level = moved_pool()
    camera = Camera(id="c", x=70, y=20, z=30, yaw_deg=0, pitch_deg=-60)
    shot = {"size": (64, 36), "time_s": 0.0, "view": "flow_lost", "renderer": renderer, "linear": True}
    right = render(level, camera, **shot)[..., 0][:, 32:]  # all of it where the current is even
    off = decoded(encoded([0.7, 0.3], 1.0), 1.0) - [0.7, 0.3]
    assert np.median(right) == pytest.approx(np.hypot(*off) * MOST, abs=0.1)  # the float current is a half
    level.set("flow.export_mps", 0.35)
    cut = np.median(render(level, camera, **shot)[..., 0][:, 32:])
    assert cut == pytest.approx(0.35 * MOST / 0.35, rel=0.02)
