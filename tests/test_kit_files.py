"""The runtime kit as files of an export: what its json says, what check finds, several levels in one program (T09)."""

import json
import subprocess

import numpy as np
import pytest
from kit_parts import LEVELS, READ, asked, build, placed, plain, put_files, run_c
from shorewright.io.export import check, export
from shorewright.io.export.kit import measure, verify
from shorewright.io.export.kit.changes import track_of
from shorewright.io.export.kit.data import Made, kit_data
from shorewright.io.export.kit.files import guard_of, sources, text_of
from shorewright.io.export.kit.parse import parse
from shorewright.io.export.kit.parts import PARTS
from shorewright.io.export.kit.reach import pruned
from shorewright.io.export.kit.source import one_text
from shorewright.io.export.kit.uniform_docs import meaning
from shorewright.level import BadInput
from shorewright.level.waves import surface_at

ALL = ["WAVE_OBJECTS", "WAVE_REGIONS", "PATCHED", "PINS", "RIVERS", "PLUNGE", "TRAVEL_TIME"]


def clouded():
    level = placed()
    level.set("clouds.on", True)
    return level


def test_an_export_with_the_kit_checks_and_a_changed_file_is_found(tmp_path):
    """T09: all files listed with hashes and a measured error; 200 probes with normals, which C's answers fit."""
    level, out = clouded(), tmp_path / "out"
    export(level, "raw", out, name="bay", only="kit")
    assert check(out) == []
    names = {path.name for path in out.iterdir()}
    for part in PARTS:
        assert {f"bay_{part}{s}" for s in (".h", ".hlsl", ".glsl", ".gdshaderinc", ".json", ".f32", ".u8")} < names
    probes = json.loads((out / "bay_sea.json").read_text())["probes"]
    assert len(probes) == 200
    asks = np.array([[p["time_s"], *p["before"]] for p in probes])
    told = run_c(level, asks, tmp_path)
    assert np.abs(told[:, :6] - [[*p["position"], *p["normal"]] for p in probes]).max() < 1e-3
    files = json.loads((out / "bay.shorewright.json").read_text())["files"]
    errors = {file["name"]: file["max_error"] for file in files}
    assert 0 < errors["bay_sea.h"] < 1e-3
    assert errors["bay_sea.f32"] == errors["bay_sea.u8"] == 0  # read back from the disk
    path = out / "bay_sea.h"
    path.write_text(path.read_text() + "\n")
    assert any("bay_sea.h" in finding for finding in check(out))


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    out = tmp_path_factory.mktemp("kit") / "out"
    export(plain(), "raw", out, name="bay", only="kit")
    return out


def swapped(old, new):
    return lambda text: text.replace(old, new)


def spoilt_json(change):
    def spoil(text):
        told = json.loads(text)
        change(told)
        return json.dumps(told)

    return spoil


def lower(told):
    told["maps"]["u_bed"]["height"] = 5


def endless(told):
    told["probes"][3]["position"] = [1, 2, 1e999]


def higher(told):
    told["probes"][3]["position"][2] = 0.77


SPOILT = {
    "C's own uniform": (".h", swapped("g->u_shore_range_m = ", "g->u_shore_range_m = 9"), "u_shore_range_m"),
    "HLSL's own uniform": (".hlsl", swapped("u_cell_m = ", "u_cell_m = 7"), "u_cell_m"),
    "a uniform that a source has not": (".gdshaderinc", swapped("u_foam_tile_m", "u_tile"), "u_foam_tile_m"),
    "maps that do not fill the file": (".json", spoilt_json(lower), "does not begin"),
    "a probe that is no number": (".json", spoilt_json(endless), "finite"),
    "a height that its functions do not give": (".json", spoilt_json(higher), "off its probes"),
    "a function that gives another height": (".glsl", swapped("level_m + rise", "level_m + 1.01 * rise"), "off its"),
    "no list at all": (".json", lambda text: "[1, 2]", "no list of numbers"),
}


@pytest.mark.parametrize("fault", SPOILT)
def test_check_finds_what_does_not_fit_together(fault, exported, tmp_path):
    """T09: numbers and sources of different exports are told apart by what they hold, not by their hashes."""
    from shorewright.io.export.records import Manifest

    suffix, spoil, word = SPOILT[fault]
    data = json.loads((exported / "bay.shorewright.json").read_text())
    data.pop("manifest_sha256")
    manifest = Manifest.model_validate(data)
    whole = {record.name: exported / record.name for record in manifest.files}
    assert verify.check_kit(manifest, whole) == []
    name = f"bay_sea{suffix}"
    whole[name] = tmp_path / name
    text = (exported / name).read_text()
    whole[name].write_text(spoil(text))
    assert whole[name].read_text() != text
    found = verify.check_kit(manifest, whole)
    assert any(word in finding for finding in found), found


def test_the_json_says_what_each_number_is():
    """T09: a unit and a sentence for every uniform and map that any level's kit may have; how maps are read."""
    from shorewright.io.export.kit.numbers import numbers

    for part in PARTS.values():
        unit = pruned(parse(one_text(ALL, part.name)), part.wanted)
        for one in unit.variables("uniform"):
            _, doc = meaning(one.name)
            assert doc.endswith("."), one.name
    told = numbers(sources(plain(), "bay"))
    assert told["meaning"].keys() == told["uniforms"].keys() | told["maps"].keys()
    assert told["meaning"]["u_shore_range_m"]["unit"] == "m"
    assert told["maps"]["u_noise"]["format"] == "unorm8"
    assert told["maps"]["u_bed"]["file"] == "bay_sea.f32"
    assert told["loop_s"] == 0


TWO = (
    READ
    + """
#define SHOREWRIGHT_PREFIX bay_
#include "bay_sea.h"
#define SHOREWRIGHT_PREFIX cape_
#include "cape_sea.h"
#define SHOREWRIGHT_PREFIX bay_
#include "bay_sky.h"
#include "other.h"
int main(void) {
    bay_sea_state bay;
    cape_sea_state cape;
    bay_sky_state sky;
    bay_sea_set_up(&bay, whole_file("bay_sea.f32"), whole_file("bay_sea.u8"));
    cape_sea_set_up(&cape, whole_file("cape_sea.f32"), whole_file("cape_sea.u8"));
    bay_sky_set_up(&sky, whole_file("bay_sky.f32"), whole_file("bay_sky.u8"));
    double ask[3];
    while (fread(ask, sizeof(double), 3, stdin) == 3) {
        vec2 at = {(float)ask[1], (float)ask[2]};
        bay_sea_at_time(&bay, ask[0]);
        cape_sea_at_time(&cape, ask[0]);
        bay_sky_at_time(&sky, ask[0]);
        bay_Sea one = bay_sea_surface(&bay, at);
        cape_Sea two = cape_sea_surface(&cape, at);
        float told[6] = {one.position.z, two.position.z, bay_foam_on(&bay, one), cape_foam_on(&cape, two),
                         bay_weather_at(&sky, at).x, other(at)};
        fwrite(told, sizeof(float), 6, stdout);
    }
    return 0;
}
"""
)
OTHER = """#include "bay_sea.h"
#include "bay_sky.h"
#include "other.h"
float other(vec2 at) {
    static sea_state g;
    (void)g;
    return at.x;
}
"""


def test_two_levels_and_two_parts_live_in_one_program(tmp_path):
    """T09: headers of two levels with a prefix each, sea and sky, in one unit; and plain in another unit."""
    bay, cape = clouded(), LEVELS["plunging"]()
    for stem, level, part in (("bay", bay, "sea"), ("bay", bay, "sky"), ("cape", cape, "sea")):
        put_files(sources(level, stem, part), tmp_path, f"{stem}_{part}")
    (tmp_path / "main.c").write_text(TWO)
    (tmp_path / "other.c").write_text(OTHER)
    (tmp_path / "other.h").write_text("float other(vec2 at);\n")
    build(tmp_path, "main.c", "other.c")
    asks = asked(bay, [61.0], 200)
    ran = subprocess.run(["./run"], cwd=tmp_path, input=asks.tobytes(), capture_output=True, check=True)
    told = np.frombuffer(ran.stdout, np.float32).reshape(-1, 6)
    for column, level in ((0, bay), (1, cape)):
        assert np.abs(told[:, column] - surface_at(level, 61.0, asks[:, 1], asks[:, 2]).height_m).max() < 1e-3
    assert np.abs(told[:, 0] - told[:, 1]).max() > 0.05
    assert np.array_equal(told[:, 5], np.float32(asks[:, 1]))


def test_a_function_that_gives_no_number_is_told_and_not_written(monkeypatch, tmp_path):
    """T09: NaN at the first time and none later; the largest error may not hide it."""
    times, off_by = [], measure.off_by

    def spoilt(run, probes):
        times.append(probes[0]["time_s"])
        return off_by(run, probes) + (np.nan if len(times) == 2 else 0.0)

    monkeypatch.setattr(measure, "off_by", spoilt)
    with pytest.raises(BadInput, match=r"^the sea of bay gives values that are no finite numbers"):
        export(plain(), "raw", tmp_path / "out", name="bay", only="kit")
    assert len(times) > 2
    assert not (tmp_path / "out").exists()


def test_a_uniform_that_becomes_no_number_is_seen():
    """T09: neither a track's error nor the comparison with the level takes NaN for 0."""

    def truth(t):
        return {"u_a": np.float32(np.nan if 0 < t < 4000 else 1.0)}

    track = track_of([0.0, 3999.0, 9000.0, 9001.0], ["u_a"], truth)
    assert np.isnan(track.error["u_a"])
    unit = parse("uniform float u_a;\nfloat f() { return u_a; }\n")
    assert kit_data(plain(), unit, Made(truth, dict, [])).held.keys() == {"u_a"}
    assert kit_data(plain(), unit, Made(lambda t: truth(0.0), dict, [])).held == {}


def test_no_two_names_share_a_guard():
    """T09: names that differ in what a macro cannot hold, or in capitals, may lie in one program."""
    stems = ["my_bay_sea", "my bay_sea", "my-bay_sea", "My_bay_sea", "mü_bay_sea", "m海_bay_sea", "m_bay_sea"]
    guards = [guard_of(stem, "H") for stem in stems]
    assert len(set(guards)) == len(stems)
    assert all(guard.isascii() and guard.isidentifier() for guard in guards)
    assert guards[0] == "SHOREWRIGHT_MY_BAY_SEA_H"


def test_sea_and_sky_share_no_name_in_a_shader():
    """T09: a game may include both in one shader."""
    level = clouded()
    units = [sources(level, "bay", part).unit for part in PARTS]
    names = [{one.name for one in (*unit.functions(), *unit.variables(), *unit.structs().values())} for unit in units]
    assert not names[0] & names[1]


@pytest.mark.parametrize("word", ["c", "hlsl", "godot", "glsl"])
def test_the_same_level_gives_the_same_text(word):
    """T09: no date, no path, no order that changes."""
    one, other = (text_of(sources(clouded(), "bay", "sea"), "bay", word) for _ in range(2))
    assert one == other


def test_a_changed_shader_is_exported_anew():
    """T09: what tells an export that the kit would come out the same knows the shaders too."""
    from shorewright.io.export.follows import code_files

    names = {path.name for path in code_files()}
    assert {"waves.glsl", "foam_amount.glsl", "cubes.glsl", "run.py"} < names
