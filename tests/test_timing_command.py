"""The command `timing`: its files read back against closed forms on a plane beach; all of it or nothing (T06)."""

import hashlib
import json
from types import SimpleNamespace

import numpy as np
import pytest
from coasts import make_beach
from shorewright import io
from shorewright.app.cli import main
from shorewright.app.commands.timing import _events
from shorewright.io.images import load_image, read_image
from shorewright.level.shore_waves import front_speed_mps

SLOPE, ROWS = 0.05, 97


@pytest.fixture
def beach(tmp_path):
    level = make_beach(rows=ROWS, cols=65, slope=SLOPE)
    for path in ("shore.stagger", "sea.phase_noise"):
        level.set(path, 0.0)
    level.georeference = {"crs": "EPSG:32632"}
    io.write_level(level, tmp_path / "plane.shore")
    return level, tmp_path / "plane.shore"


def run(path, out, *more):
    return main(["timing", str(path), "-o", str(out), *more])


def digests(folder):
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(folder.iterdir())}


def test_files_hold_the_closed_forms(beach, tmp_path, capsys):
    """T06: arrival and speed a sample a height vertex, north row first; lines at the depths of the clock."""
    (level, path), out, t = beach, tmp_path / "out", 4.0
    assert run(path, out, "--time", "4") == 0
    assert str(out) in capsys.readouterr().out
    assert {"arrival_shore.exr", "front_speed.exr", "crests.geojson", "isochrones.geojson", "hot_spots.json",
            "events.json", "timing.png", "timing.json"} == set(digests(out))  # fmt: skip
    shore = level.settings.shore
    travel_s = shore.interval_s * shore.count / (1 + shore.runup)
    header, arrival = load_image(out / "arrival_shore.exr")
    assert (header.channels, header.dtype, arrival.shape) == (("Y",), "float", (ROWS, 65, 1))
    depth = -level.height[::-1]  # row 0 north
    inner = (depth > 0.3) & (np.arange(ROWS)[:, None] < ROWS - 14)
    np.testing.assert_allclose(arrival[..., 0][inner], (1 - depth[inner] / shore.range_m) * travel_s, atol=0.02)
    assert np.isnan(arrival[..., 0][depth < 0]).all()
    speed = read_image(out / "front_speed.exr")[..., 0]
    np.testing.assert_allclose(speed[inner], front_speed_mps(shore, SLOPE), rtol=0.01)
    lines = json.loads((out / "crests.geojson").read_text())
    assert lines["properties"]["georeference"] == {"crs": "EPSG:32632"}
    assert lines["features"]
    for line in lines["features"]:
        at = np.array(line["geometry"]["coordinates"])
        s = (t - line["properties"]["wave"] * shore.interval_s) / travel_s
        if at[0, 1] > 14:
            np.testing.assert_allclose(at[:, 1], 48 - (1 - s) * shore.range_m / SLOPE, atol=0.03)
    times = [
        line["properties"]["arrival_s"] for line in json.loads((out / "isochrones.geojson").read_text())["features"]
    ]
    assert times
    assert all(value % 2 == 0 for value in times)
    assert json.loads((out / "events.json").read_text())["note"]
    assert read_image(out / "timing.png").std() > 10


def test_bytes_come_again_and_a_folder_of_its_own_is_written_anew(beach, tmp_path):
    _, path = beach
    for name in ("a", "b"):
        assert run(path, tmp_path / name) == 0
    assert digests(tmp_path / "a") == digests(tmp_path / "b")
    before = digests(tmp_path / "a")
    assert run(path, tmp_path / "a", "--time", "3") == 0
    assert digests(tmp_path / "a") != before


def test_one_swell_takes_the_place_of_the_levels_own(beach, tmp_path):
    """T06: crests of --swell come a period apart, from its side, and there is one map of arrival."""
    _, path = beach
    assert run(path, tmp_path / "s", "--swell", "6,0") == 0
    assert "arrival_swell1.exr" in digests(tmp_path / "s")
    assert "arrival_swell2.exr" not in digests(tmp_path / "s")
    assert json.loads((tmp_path / "s" / "timing.json").read_text())["period_s"] == pytest.approx(6.0, abs=1e-4)
    arrival = read_image(tmp_path / "s" / "arrival_swell1.exr")[..., 0]
    known = np.isfinite(arrival).all(axis=1)
    assert known.sum() > 30
    assert (np.diff(arrival[known], axis=0) < 0).all()  # row 0 is north: later towards land
    assert np.ptp(arrival[known], axis=1).max() < 0.2  # heading 0: crests lie from west to east


@pytest.mark.parametrize(
    ("more", "word"),
    [
        (("--swell", "9"), "swell"), (("--swell", "0.1,20"), "0.1"), (("--swell", "9,700"), "700"),
        (("--swell", "9,20", "--source", "depth"), "travel_time"), (("--time", "nan"), "--time"),
        (("--source", "moon"), "source"), (("--every", "0"), "--every"),
    ],
)  # fmt: skip
def test_bad_input_is_one_sentence_and_writes_nothing(beach, tmp_path, capsys, more, word):
    _, path = beach
    assert run(path, tmp_path / "x", *more) == 2
    told = capsys.readouterr().err
    assert word in told
    assert told.count("\n") == 1
    assert not (tmp_path / "x").exists()


def test_folders_with_other_things_and_levels_without_sea_are_refused(beach, tmp_path, capsys):
    level, path = beach
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    assert run(path, tmp_path / "mine") == 2
    assert "notes.txt" in capsys.readouterr().err
    assert [entry.name for entry in (tmp_path / "mine").iterdir()] == ["notes.txt"]
    level.set("level.sea_level_m", -50.0)
    io.write_level(level, tmp_path / "dry.shore")
    assert run(tmp_path / "dry.shore", tmp_path / "y") == 2
    assert "no sea" in capsys.readouterr().err
    assert not (tmp_path / "y").exists()


def test_events_are_the_crests_at_probes(beach):
    """T06: every crest of the minute, a period apart, with its break."""
    level, _ = beach
    level.objects["buoy"] = SimpleNamespace(kind="probe", id="buoy", x=32.0, y=10.0)
    found = _events(level, 5.0)["events"]
    shore = level.settings.shore
    times = np.array([event["time_s"] for event in found])
    assert len(times) == (65.0 - times[0]) // shore.interval_s + 1
    np.testing.assert_allclose(np.diff(times), shore.interval_s, atol=2e-3)
    assert {event["probe"] for event in found} == {"buoy"}
    assert all(5.0 <= event["time_s"] <= 65.0 and event["breaks_s"] > event["time_s"] for event in found)
