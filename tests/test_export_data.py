"""Data files of an export (T09): valid to their schemas, the level's own values, the engine's own axes; every row."""

import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from exports import MANIFEST, one, read_manifest, sign, snapshot
from jsonschema import Draft202012Validator
from scipy.interpolate import PchipInterpolator
from shorewright.io.export import EXPORTERS, check, export
from shorewright.io.export.common import DATA as NAMES
from shorewright.io.export.data_axes import AXES, Frame
from shorewright.io.export.data_kinds import IN_TIME
from shorewright.io.export.data_rows import DATA
from shorewright.io.export.data_schema import MODELS, schema_text
from shorewright.level import BadInput, Grid, Level
from shorewright.level.meshes import block
from shorewright.level.objects import (
    OBJECT_KINDS,
    Camera,
    Disturbance,
    FlowPoint,
    Hit,
    Marker,
    Mover,
    Pin,
    PointLight,
    Probe,
    Prop,
    River,
    SeaPatch,
    SeaSeed,
    Shot,
    SwellRegion,
    ViewCircle,
    WaterTable,
    WaveObject,
    WeatherKey,
)
from shorewright.level.probes import events, wet_and_dry
from shorewright.level.river_line import centre_line
from shorewright.level.sun import sun_place
from shorewright.level.tide import tide_m
from shorewright.level.weather_keys import level_at, run_m

ROOT = Path(__file__).parents[1]
NORTH_M, SEA_M = 60.0, 1.5  # of the level below
FALL = ((0, 0, 6, 6, 1), (4, -14, 6, 5, 2), (-2, -16, 7, 3, 4), (-6, -30, 8, SEA_M, 1))
THINGS = (
    Camera(id="look", x=10, y=20, z=7.5, yaw_deg=90, pitch_deg=30), SeaSeed(id="lagoon", x=4, y=4),
    Disturbance(id="push", x=12, y=8, time_s=3), FlowPoint(id="out", x=30, y=0), ViewCircle(id="far", x=20, y=10),
    SeaPatch(id="patch", x=30, y=10, sea="coastal"), WaveObject(id="wave", x=20, y=10, yaw_deg=270, radius_m=15),
    SwellRegion(id="lee", x=40, y=10, outline=(-5, -5, 6, -5, 0, 7)), WaterTable(id="clear"),
    PointLight(id="lamp", x=33, y=50, z=9, orbit_m=2), Hit(id="drop", x=5, y=6), Mover(id="wader", x=50, y=12),
    Prop(id="crate", mesh="block", x=30, y=50, z=5, yaw_deg=90, scale=2),
    Prop(id="raft", mesh="block", x=25, y=10, floats=True, scale=3, density=0.5),
    Probe(id="deep", x=35, y=8), Probe(id="swash", x=35, y=32.5),
    River(id="beck", x=60, y=58, points=FALL),
    WeatherKey(id="gale", time_s=20, fade_s=30, weather="gale"), WeatherKey(id="squall", x=9, time_s=90, radius_m=500),
    Shot(id="dusk", start_s=5, end_s=9), Marker(id="now", time_s=2.5),
)  # fmt: skip


def coast():
    """A small coast that holds one of everything; the tide and the day go by."""
    north, east = np.mgrid[0:61, 0:81].astype(float)
    level = Level(Grid(61, 81), ((north - 30) * 0.08 + SEA_M + 0.05 * np.sin(east / 9)).astype(np.float32))
    level.put_mesh("block", block())
    for thing in THINGS:
        level.put_object(thing.id, thing)
    for path, value in {
        "level.sea_level_m": SEA_M, "tide.on": True, "tide.period_s": 60.0, "tide.high_s": 10.0, "tide.range_m": 0.4,
        "tide.curve": (0.0, 1.0, 0.4, 0.0, 0.7, 0.3), "light.sun_from": "date", "light.day_rate": 600.0,
        "time.loop_end_s": 8.0,
    }.items():  # fmt: skip
        level.set(path, value)
    return level


@pytest.fixture(scope="module")
def level():
    return coast()


@pytest.fixture(scope="module", params=EXPORTERS)
def written(request, level, tmp_path_factory):
    """Target, folder."""
    folder = tmp_path_factory.mktemp(request.param) / "out"
    export(level, request.param, folder, "data", name="bay")
    return request.param, folder


@pytest.fixture(scope="module")
def unity(level, tmp_path_factory):
    """An export to look into, where Y is up."""
    folder = tmp_path_factory.mktemp("unity") / "out"
    export(level, "unity", folder, "data", name="bay")
    return folder


def read(folder, name):
    return json.loads((folder / f"bay_{name}.json").read_text("utf-8"))


def by_id(data, kind, name):
    return next(row for row in data[kind] if row["id"] == name)


# Schemas


@pytest.mark.parametrize("name", MODELS)
def test_the_published_schemas_are_those_of_the_models(name):
    """Run `python -m shorewright.app.schemas docs/schema` after changing a parameter or a record."""
    text = (ROOT / "docs" / "schema" / f"{name}.schema.json").read_text("utf-8")
    assert text == schema_text(name)
    Draft202012Validator.check_schema(json.loads(text))
    assert {path.name for path in (ROOT / "docs" / "schema").iterdir()} == {f"{n}.schema.json" for n in MODELS}


@pytest.mark.parametrize("name", DATA)
def test_every_file_fits_the_schema_beside_it(written, name):
    _, folder = written
    data = read(folder, name)
    schema = json.loads((folder / data["$schema"]).read_text("utf-8"))
    assert list(Draft202012Validator(schema).iter_errors(data)) == []
    data["level"] = 7
    assert [tuple(error.path) for error in Draft202012Validator(schema).iter_errors(data)] == [("level",)]


def test_a_manifest_fits_its_schema(written):
    _, folder = written
    schema = json.loads((folder / "bay_manifest.schema.json").read_text("utf-8"))
    assert list(Draft202012Validator(schema).iter_errors(read_manifest(folder))) == []


def test_a_schema_says_what_a_parameter_is():
    """Unit, range, default and sentence come from where it is declared."""
    swell = json.loads(schema_text("settings"))["$defs"]["Sea"]["properties"]["swell_m"]
    assert swell == {
        "default": 0.45, "description": "Amplitude of the low group, three fronts.", "maximum": 8, "minimum": 0,
        "soft": [0, 2], "type": "number", "unit": "m",
    }  # fmt: skip


@pytest.mark.parametrize("name", DATA)
def test_the_weakest_reader_can_read_it(unity, name):
    """Unity's JsonUtility: no list in a list, and every list of one shape."""

    def look(value):
        if isinstance(value, list):
            assert not any(isinstance(part, list) for part in value)
            assert len({tuple(part) if isinstance(part, dict) else None for part in value}) <= 1
        for part in value.values() if isinstance(value, dict) else value if isinstance(value, list) else ():
            look(part)

    look(read(unity, name))


# The level's own values


def test_settings_are_the_levels(written, level):
    data = read(written[1], "settings")
    assert data["settings"] == json.loads(level.settings.model_dump_json())
    assert (data["environment"], data["weather"]) == ("", "")
    assert [row["name"] for row in data["weathers"]][:2] == ["calm", "breeze"]
    assert by_name(data["weathers"], "gale")["settings"]["sea"]["swell_m"] == 1.3
    assert by_name(data["environments"], "fog")["settings"]["fog"]["density"] == 0.0046


def by_name(rows, name):
    return next(row for row in rows if row["name"] == name)


def test_a_preset_that_holds_is_named(tmp_path):
    from shorewright.level.environments import environment_settings
    from shorewright.level.weather_presets import weather_settings

    level = coast()
    level.set_settings(weather_settings(environment_settings(level.settings, "noon"), "snow"))
    export(level, "raw", tmp_path / "out", "settings", name="bay")
    data = read(tmp_path / "out", "settings")
    assert data["weather"] == "snow"
    assert data["environment"] == ""  # the weather's wind is another


def test_every_kind_is_in_one_file_with_its_parameters(written, level):
    """All objects, each in one list, with what they were given."""
    _, folder = written
    objects, keys = read(folder, "objects"), read(folder, "keys")
    assert {"pin", *(thing.kind for thing in THINGS)} == set(OBJECT_KINDS)
    assert {*OBJECT_KINDS} & {*objects} == {*OBJECT_KINDS} - {*IN_TIME}
    assert {*OBJECT_KINDS} & {*keys} == {*IN_TIME}
    for thing in THINGS:
        row = by_id(keys if thing.kind in IN_TIME else objects, thing.kind, thing.id)
        told = {
            key: value for key, value in json.loads(thing.model_dump_json()).items() if key not in ("points", "stops")
        }
        skipped = {"x", "y"} if thing.placeless else set()
        assert {key: row[key] for key in told.keys() - skipped} == {key: told[key] for key in told.keys() - skipped}


def test_a_pin_is_told(tmp_path):
    """Alone: over a tide that moves, pins make probes slow."""
    level = Level(Grid(9, 9), np.full((9, 9), -3, np.float32))
    level.put_object("here", Pin(id="here", x=6, y=8, time_s=4))
    export(level, "unreal", tmp_path / "out", "objects", name="bay")
    (row,) = read(tmp_path / "out", "objects")["pin"]
    assert row["time_s"] == 4
    assert numbers(row["engine"]) == (600, 0, 0)
    assert check(tmp_path / "out") == []


# Known numbers: the camera stands at x 10, y 20, 6 m over the sea, and looks east and 30° up
CAMERA = {
    "raw": ((10, 20, 7.5), (0.75**0.5, 0, 0.5), (-0.5, 0, 0.75**0.5)),
    "unreal": ((1000, 4000, 600), (0.75**0.5, 0, 0.5), (-0.5, 0, 0.75**0.5)),
    "unity": ((10, 6, 20), (0.75**0.5, 0.5, 0), (-0.5, 0.75**0.5, 0)),
    "godot": ((10, 6, 40), (0.75**0.5, 0.5, 0), (-0.5, 0.75**0.5, 0)),
}
CAMERA["godot-hterrain"] = CAMERA["godot-project"] = CAMERA["godot"]
LOOKS = {"raw": ((0, 1, 0), (0, 0, 1)), "unreal": ((1, 0, 0), (0, 0, 1)), "unity": ((0, 0, 1), (0, 1, 0)),
         "godot": ((0, 0, -1), (0, 1, 0))}  # fmt: skip
LOOKS["godot-hterrain"] = LOOKS["godot-project"] = LOOKS["godot"]
# a crate that looks east: no turn where that is ahead, else a quarter about the vertical
HALF = 0.5**0.5
EAST = {"raw": (0, 0, -HALF, HALF), "unreal": (0, 0, 0, 1), "unity": (0, HALF, 0, HALF), "godot": (0, -HALF, 0, HALF)}
EAST["godot-hterrain"] = EAST["godot-project"] = EAST["godot"]
# the camera's turn as each engine makes it of angles: Unreal FRotator(30, 0, 0), Unity Quaternion.Euler(-30, 90, 0),
# Godot rotation_degrees (30, -90, 0), without an engine 90° clockwise about z after 30° up about x
S, C = HALF * np.sin(np.pi / 12), HALF * np.cos(np.pi / 12)
LOOK = {"raw": (S, -S, -C, C), "unreal": (0, -S / HALF, 0, C / HALF), "unity": (-S, C, S, C), "godot": (S, -C, S, C)}
LOOK["godot-hterrain"] = LOOK["godot-project"] = LOOK["godot"]


def numbers(told, letters="xyz"):
    return tuple(told[letter] for letter in letters)


def turned(q, way):
    """A vector turned by a quaternion, by the formula that all engines share."""
    xyz, w = np.array(numbers(q)), q["w"]
    return way + 2 * w * np.cross(xyz, way) + 2 * np.cross(xyz, np.cross(xyz, way))


def test_a_camera_stands_and_looks_as_the_engine_has_it(written):
    target, folder = written
    data = read(folder, "objects")
    camera, (at, ahead, up) = by_id(data, "camera", "look"), CAMERA[target]
    engine = camera["engine"]
    assert numbers(engine) == pytest.approx(at)
    assert numbers(engine["ahead"]) == pytest.approx(ahead)
    assert numbers(engine["up"]) == pytest.approx(up)
    for axis, name in zip(LOOKS[target], ("ahead", "up")):
        assert turned(engine["rotation"], np.array(axis, float)) == pytest.approx(numbers(engine[name]), abs=1e-8)
    assert numbers(engine["rotation"], "xyzw") == pytest.approx(LOOK[target], abs=1e-8)
    crate = by_id(data, "prop", "crate")["engine"]
    assert numbers(crate["rotation"], "xyzw") == pytest.approx(EAST[target], abs=1e-8)


def test_the_axes_are_those_of_the_manifest(written):
    """Formulas in the file, evaluated, and the manifest's own sentence agree."""
    target, folder = written
    data, manifest = read(folder, "objects"), read_manifest(folder)
    engine, place = data["engine"], by_id(data, "camera", "look")["place"]
    known = {"north_m": engine["north_m"], "sea_level_m": engine["sea_level_m"], **{k: place[k] for k in "xyz"}}
    found = [eval(engine[axis].replace("100 ", "100 * "), {}, known) for axis in "xyz"]
    assert found == pytest.approx(CAMERA[target][0])
    assert (engine["north_m"], engine["sea_level_m"]) == (NORTH_M, SEA_M)
    if target != "raw":
        words = [engine[axis].replace("north_m", "size_north").replace("z - sea_level_m", "height - sea level")
                 for axis in "xyz"]  # fmt: skip
        assert "X = {}, Y = {}, Z = {}".format(*words) in manifest["world"]["axes"]
    else:
        assert manifest["world"]["axes"].startswith("x east, y north, height up, metres")
    assert {*AXES} == {*EXPORTERS}


def test_places_lie_on_the_exported_height_map(written, level):
    """The column and row of a manifest's probe are where the engine's axes have its place; Unity's rows go north."""
    target, folder = written
    frame = Frame.of(level, target)
    manifest = read_manifest(folder)
    assert len(manifest["probes"]) > 3
    up, north = (2, 1) if target in ("raw", "unreal") else (1, 2)
    for probe in manifest["probes"]:
        truth = np.array([probe["x_m"], probe["y_m"], probe["height_m"]])
        at = frame.place(truth) / frame.axes.units_per_m
        row = NORTH_M - at[north] if target == "raw" else at[north]
        assert (at[0], row) == pytest.approx((probe["col"], probe["row"]), abs=1e-6)
        assert at[up] == pytest.approx(truth[2] - (SEA_M if target != "raw" else 0), abs=1e-6)
        assert frame.back(at * frame.axes.units_per_m) == pytest.approx(truth, abs=1e-6)


def test_what_has_no_height_lies_on_water_or_ground(unity, level):
    data = read(unity, "objects")
    assert by_id(data, "wave", "wave")["engine"]["y"] == 0
    swash = by_id(data, "probe", "swash")
    from shorewright.level.pick import ground_at

    assert swash["place"]["z"] == pytest.approx(float(ground_at(level, np.array([35.0]), np.array([32.5]))[0]))
    assert numbers(by_id(data, "sea_patch", "patch")["north_east"]["engine"]) == (100, 0, 100)


def test_a_raft_floats_where_the_level_says(unity, level):
    from shorewright.level.buoyancy import poses

    raft, pose = by_id(read(unity, "objects"), "prop", "raft"), poses(level, 0.0)["raft"]
    assert numbers(raft["place"]) == pytest.approx(tuple(pose.place), abs=1e-6)
    assert numbers(raft["place"]["ahead"]) == pytest.approx(tuple(pose.axes[:, 1]), abs=1e-8)
    assert raft["draft_m"] == pytest.approx(pose.draft_m)
    assert len(raft["hull"]) == 15
    assert raft["high"]["z"] - raft["low"]["z"] == pytest.approx(2 * raft["draft_m"])
    line = raft["low"]["z"] + raft["draft_m"]
    assert len(raft["lid"]) >= 4
    for corner in raft["lid"]:
        assert line < corner["z"] < raft["high"]["z"]
        assert abs(corner["x"]) < raft["high"]["x"]
    assert by_id(read(unity, "objects"), "prop", "crate")["lid"] == []


def test_the_curve_of_a_river_follows_from_its_points(unity):
    """The formula of the schema, written down anew, gives the line; so it does after the last point, at sea."""
    beck = by_id(read(unity, "objects"), "river", "beck")
    points = np.array([numbers(row["place"]) for row in beck["points"]])
    assert points[:, :2] == pytest.approx(np.array(FALL)[:, :2] + (60, 58))
    p = np.vstack([2 * points[0] - points[1], points, 2 * points[-1] - points[-2]])[:, :2]
    line = [row for row in beck["line"] if not row["at_sea"]]
    found, at = [], []
    for n in range(len(points) - 1):
        p0, p1, p2, p3 = p[n : n + 4]
        d0, d1, d2 = (np.hypot(*(b - a)) ** 0.5 for a, b in ((p0, p1), (p1, p2), (p2, p3)))
        m1 = d1 * ((p1 - p0) / d0 - (p2 - p0) / (d0 + d1) + (p2 - p1) / d1)
        m2 = d1 * ((p2 - p1) / d1 - (p3 - p1) / (d1 + d2) + (p3 - p2) / d2)
        parts = max(int(np.ceil(np.hypot(*(p2 - p1)))), 2)
        for u in np.arange(parts + (n == len(points) - 2)) / parts:
            found.append(p1 + u * m1 + u**2 * (3 * (p2 - p1) - 2 * m1 - m2) + u**3 * (2 * (p1 - p2) + m1 + m2))
            at.append(n + u)
    assert [numbers(row["place"])[:2] for row in line] == pytest.approx(np.array(found), abs=1e-6)
    widths = PchipInterpolator(range(len(points)), [row["width_m"] for row in beck["points"]])(at)
    assert [row["width_m"] for row in line] == pytest.approx(widths, abs=1e-6)
    assert len(beck["line"]) == len(centre_line(THINGS[-5], SEA_M).x) > len(line)
    assert numbers(line[0]["engine"]) == pytest.approx((60, 6 - SEA_M, 58))


def test_a_wave_is_three_fronts_of_the_kit(unity, level):
    from shorewright.level.wave_objects import object_uniforms

    wave = by_id(read(unity, "objects"), "wave", "wave")
    way, size = (object_uniforms(level, 0.0)[name][:3] for name in ("u_wave_way", "u_wave_size"))
    for front, (east, north, cycles, start), (amplitude_m, lateral_m) in zip(wave["fronts"], way, size):
        told = [front[name] for name in ("east", "north", "start", "amplitude_m", "lateral_m")]
        assert told == pytest.approx([east, north, start, amplitude_m, lateral_m], abs=1e-6)
        assert 1 / front["length_m"] == pytest.approx(cycles, rel=1e-6)
    later = object_uniforms(level, 7.0)["u_wave_way"][:3, 3]
    phases = [(front["start"] + 7 * front["rate_hz"]) % 1 for front in wave["fronts"]]
    assert phases == pytest.approx(later, abs=1e-5)


# Tracks and events


def linear(rows, name, times):
    return np.interp(times, [row["time_s"] for row in rows], [row[name] for row in rows])


def test_tracks_give_the_levels_moments(unity, level):
    """Linear between rows: the tide to a thousandth of its range, weather to a thousandth of what a key changes."""
    data, times = read(unity, "keys"), np.linspace(0, 59.9, 173)
    assert np.abs(linear(data["tide_track"], "tide_m", times) - tide_m(level.settings, times)).max() < 0.4e-3
    assert data["tide_period_s"] == 60
    assert data["tide_track"][0]["tide_m"] == data["tide_track"][-1]["tide_m"]
    assert linear(data["tide_track"], "sea_level_m", 10.0) == pytest.approx(SEA_M + 0.2)
    rows = [{"time_s": row["time_s"], "swell": row["settings"]["sea"]["swell_m"], "run": row["wind_run_m"]}
            for row in data["weather_track"]]  # fmt: skip
    assert [row["time_s"] for row in rows[:3]] == [0, 20, pytest.approx(20 + 30 / 32)]
    swell = [level_at(level, t).settings.sea.swell_m for t in times]
    assert rows[-1] == {
        "time_s": 50,
        "swell": 1.3,
        "run": pytest.approx(run_m(level, 50, "weather.wind_mps"), abs=1e-6),
    }
    assert np.abs(linear(rows, "swell", times) - swell).max() < 1e-3 * (1.3 - 0.45)
    assert (
        np.abs(linear(rows, "run", times[:140]) - [run_m(level, t, "weather.wind_mps") for t in times[:140]]).max()
        < 0.1
    )
    assert data["day_s"] == 144
    sun = [{"time_s": row["time_s"], **row["to_sun"]} for row in data["sun_track"]]
    way = np.array([linear(sun, axis, 31.7) for axis in "xzy"])
    azimuth, elevation = np.radians(sun_place(level.settings.light, 31.7))
    truth = (np.sin(azimuth) * np.cos(elevation), np.cos(azimuth) * np.cos(elevation), np.sin(elevation))
    assert np.degrees(np.arccos(min(way @ truth / np.linalg.norm(way), 1.0))) < 0.05
    record = next(f for f in read_manifest(unity)["files"] if f["name"] == "bay_keys.json")
    assert 0 < record["decode"]["numbers"]["weather_track_error_share"] < 1e-3
    assert 0 < record["max_error"] < 0.04


def test_events_are_the_probes(unity, level):
    """Crests by the level's own function and what gets wet, over the clock's loop, in order."""
    data = read(unity, "events")
    assert (data["from_s"], data["to_s"], data["repeats_s"]) == (0, 8, 0)
    assert [row for row in data["events"] if row["kind"] == "crest"] == [
        {key: row[key] for key in ("time_s", "kind", "probe", "height_m")} for row in events(level, 0, 8)
    ]
    others = [row for row in data["events"] if row["kind"] != "crest"]
    assert others == [
        {key: row[key] for key in ("time_s", "kind", "probe", "height_m")} for row in wet_and_dry(level, 0, 8)
    ]
    assert {row["kind"] for row in data["events"]} == {"crest", "wet", "dry"}
    assert data["probes"][0] == {"id": "deep", "wet": True}


@pytest.mark.parametrize(
    ("settings", "wanted"),
    [
        ({}, (0, 60, 0)),
        ({"time.loop_s": 24.0}, (0, 24, 24)),
        ({"time.loop_s": 5000.0}, (0, 600, 0)),
        ({"time.loop_s": 10.0, "time.loop_start_s": 5.0, "time.loop_end_s": 35.0}, (5, 35, 10)),
    ],
)
def test_the_span_of_events_is_the_clocks(settings, wanted):
    from shorewright.io.export.data_events import span

    level = Level(Grid(3, 3), np.zeros((3, 3), np.float32))
    for path, value in settings.items():
        level.set(path, value)
    assert span(level.settings.time) == wanted


# Again, and what changes what


def test_the_same_level_gives_the_same_bytes_and_keeps_its_files(level, tmp_path):
    export(level, "unity", tmp_path / "one", "data", name="bay")
    export(coast(), "unity", tmp_path / "two", NAMES, name="bay")
    before = snapshot(tmp_path / "one")
    assert snapshot(tmp_path / "two") == before
    files = {path.name: os.stat(path).st_ino for path in (tmp_path / "one").iterdir() if path.name != MANIFEST}
    export(coast(), "unity", tmp_path / "one", "data", name="bay")
    assert {name: os.stat(tmp_path / "one" / name).st_ino for name in files} == files
    assert check(tmp_path / "one") == []


@pytest.mark.parametrize(
    ("path", "value", "changed"),
    [
        ("fog.density", 0.01, {"settings"}),
        ("light.hour", 9.0, {"settings", "keys"}),
        ("time.loop_end_s", 9.0, {"settings", "events"}),
        ("tide.period_s", 70.0, {"settings", "keys", "events", "objects"}),  # props float at time 0
    ],
)
def test_a_setting_changes_only_the_files_that_hold_it(unity, tmp_path, path, value, changed):
    level = coast()
    level.set(path, value)
    export(level, "unity", tmp_path / "out", "data", name="bay")
    before, after = snapshot(unity), snapshot(tmp_path / "out")
    different = {name for name in before if before[name] != after[name]}
    assert different == {MANIFEST, *(f"bay_{name}.json" for name in changed)}


def test_what_a_level_has_not_is_empty(tmp_path):
    level = Level(Grid(9, 9), np.linspace(-1, 1, 81, dtype=np.float32).reshape(9, 9))
    export(level, "godot", tmp_path / "out", "data", name="bay")
    assert {*read_manifest(tmp_path / "out")["empty"]} == {"objects", "keys", "events"}
    assert {f["map"] for f in read_manifest(tmp_path / "out")["files"]} == {"settings", "schema"}
    with pytest.raises(BadInput, match="nothing of that"):
        export(level, "godot", tmp_path / "none", "events", name="bay")


def test_names_stand_for_one_map_each():
    for row in EXPORTERS.values():
        names = [name for name, _ in row.maps]
        assert len(names) == len(set(names))
        assert {*NAMES} <= {*names}
        assert not {*row.groups} & {*names}
        assert row.choose("data") == {*NAMES}
        assert row.choose(["data", "height"]) == {*NAMES, "height"}
        with pytest.raises(BadInput, match="did you mean data"):
            row.choose("date")


# Check


@pytest.fixture
def copy(unity, tmp_path):
    return Path(shutil.copytree(unity, tmp_path / "copy"))


def change(folder, name, edit):
    """Edit a data file as an export would write it, and sign the manifest anew."""
    from shorewright.io.export.data_models import _block

    data = read(folder, name)
    edit(data)
    (folder / f"bay_{name}.json").write_text(_block(data, 0) + "\n", "utf-8")
    sign(folder, lambda manifest: None)


def test_check_finds_nothing(written):
    assert check(written[1]) == []


TAMPERED = {
    "sea": ("settings", lambda d: d["settings"]["sea"].update(swell_m=0.46), "another sea"),
    "seed": ("settings", lambda d: d["settings"]["level"].update(seed=8), "another seed"),
    "range": ("settings", lambda d: d["settings"]["fog"].update(density=0.3), "settings.fog.density"),
    "preset": ("settings", lambda d: d.update(weather="gale"), "'gale'"),
    "missing": ("settings", lambda d: d["settings"]["fog"].pop("density"), "lacks values"),
    "strange": ("settings", lambda d: d["settings"].update(haze={}), "settings.haze"),
    "place": ("objects", lambda d: d["flow_point"][0]["engine"].update(z=1.0), "out: place and engine"),
    "level": ("objects", lambda d: d["river"][0]["line"][3]["place"].update(z=1.0), "beck: place and engine"),
    "turn": ("objects", lambda d: d["camera"][0]["engine"]["rotation"].update(w=0.5), "look: place and engine"),
    "axes": ("objects", lambda d: d["engine"].update(sea_level_m=0.0), "axes"),
    "twice": ("objects", lambda d: d["probe"][0].update(id="look"), "one id"),
    "schema": ("objects", lambda d: d.update({"$schema": "none.json"}), "schema is not beside"),
    "other": ("keys", lambda d: d.update(level="cove"), "another level"),
    "tide": ("keys", lambda d: d["tide_track"][3].update(tide_m=0.3), "do not fit"),
    "both": ("keys", lambda d: d["tide_track"][3].update(tide_m=0.3, sea_level_m=1.8), "not that of the settings"),
    "order": ("keys", lambda d: d["sun_track"].reverse(), "sun_track are not in order"),
    "time": ("events", lambda d: d["events"][-1].update(time_s=9.5), "outside 0 to 8"),
    "probe": ("events", lambda d: d["events"][0].update(probe="none"), "probe that the level has not"),
    "height": ("events", lambda d: d["events"][0].update(height_m=300.0), "no sea of this level"),
}


@pytest.mark.parametrize("how", TAMPERED)
def test_check_finds_values_that_cannot_be(copy, how):
    """Even where every hash fits."""
    name, edit, word = TAMPERED[how]
    change(copy, name, edit)
    found = check(copy)
    assert any(word in finding and f"bay_{name}.json" in finding for finding in found), found


def test_check_finds_an_altered_file(copy):
    path = copy / "bay_keys.json"
    path.write_text(path.read_text("utf-8").replace("gale", "calm", 1), "utf-8")
    one(check(copy), "bay_keys.json")
    path.unlink()
    one(check(copy), "is missing")


@pytest.mark.parametrize("text", ["{}", "not JSON", '{"$schema": "https://json-schema.org/draft/2020-12/schema"}'])
def test_check_finds_a_schema_that_is_none(copy, text):
    (copy / "bay_events.schema.json").write_text(text, "utf-8")
    sign(copy, lambda manifest: None)
    one(check(copy), "bay_events.schema.json")
