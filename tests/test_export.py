"""Exports in general: manifest, determinism, source hash, names, what may be asked for (T10)."""

import json
import subprocess
import sys

import numpy as np
import pytest
from exports import GROUND, read_manifest, rough_level, snapshot
from shorewright.io import export as export_function
from shorewright.io.export import EXPORTERS, check, export, file_stem
from shorewright.level import BadInput, Grid, Level, Rect
from shorewright.level.objects import Camera

# Manifest


def test_manifest_answers_every_question(tmp_path):
    """Each field of the list in the research (authoring, section 4) is there and true."""
    level = rough_level(40, sea_m=1.5)
    level.georeference = {"crs": "EPSG:32604"}
    level.set("level.seed", 99)
    export(level, "unreal", tmp_path / "out", only=GROUND, name="cove.shore")
    path = tmp_path / "out" / "cove.shorewright.json"
    manifest = json.loads(path.read_text("utf-8"))
    record = manifest["files"][0]
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == [
        "cove.shorewright.json", "cove_flow.png", "cove_height.r16",
    ]  # fmt: skip
    assert manifest["schema_version"] == 2
    assert manifest["tool"]["version"]
    assert manifest["source"]["georeference"] == {"crs": "EPSG:32604"}
    assert manifest["world"] | {"origin": "", "axes": ""} == {
        "size_m": [39.0, 39.0],
        "origin": "",
        "axes": "",
        "row_0": "north",
        "sea_level_m": 1.5,
        "height_min_m": float(level.height.min()),
        "height_max_m": float(level.height.max()),
    }
    assert manifest["tiles"] == {"rows": 1, "cols": 1, "shared_edge": True}
    assert manifest["waves"]["seed"] == 99
    assert manifest["waves"]["time_s"] == 0.0
    assert manifest["waves"]["sea"]["swell_m"] == level.settings.sea.swell_m
    assert (record["width"], record["height"], record["bit_depth"], record["endianness"]) == (127, 127, 16, "little")
    assert record["colour_space"] == "linear"
    assert record["channels"][0]["neutral"] == 32768
    assert record["decode"]["formula"] == "z_cm = (v - 32768) / 128 * ScaleZ + ActorZ"
    assert record["decode"]["numbers"] == {"ScaleZ": manifest["engine"]["scale_z"], "ActorZ": 0.0}


@pytest.mark.parametrize("target", EXPORTERS)
def test_export_is_deterministic(tmp_path, target):
    """The same level gives the same bytes wherever and whenever it is exported; no path, no date."""
    for folder in ("one", "two/deep"):
        export(rough_level(20, 30), target, tmp_path / folder, name="bay")
    assert snapshot(tmp_path / "one") == snapshot(tmp_path / "two" / "deep")
    assert str(tmp_path) not in (tmp_path / "one" / "bay.shorewright.json").read_text("utf-8")


def test_source_hash_knows_every_change(tmp_path):
    """Ground, paint, settings, objects and cell size are in the hash; paint that is all neutral is not."""
    changes = {
        "as it was": lambda level: None,
        "ground": lambda level: level.write("height", Rect(3, 3, 4, 4), 5.0),
        "paint": lambda level: level.write("foam", Rect(0, 0, 2, 2), 0.5),
        "setting": lambda level: level.set("shore.range_m", 7.0),
        "object": lambda level: level.put_object("play", Camera(id="play")),
        "weather": lambda level: level.write("weather", Rect(500, 500, 502, 502), 1.0),
    }
    hashes = {}
    for name, change in changes.items():
        level = rough_level(20)
        change(level)
        hashes[name] = _source_hash(level, tmp_path / name)
    hashes["cell"] = _source_hash(rough_level(20, cell_m=2.0), tmp_path / "cell")
    assert len(set(hashes.values())) == len(hashes)
    neutral = rough_level(20)
    neutral.write("foam", Rect(0, 0, 2, 2), 0.0)
    assert _source_hash(neutral, tmp_path / "neutral") == hashes["as it was"]


def _source_hash(level, folder):
    export(level, "unreal", folder)
    return read_manifest(folder)["source"]["sha256"]


def test_source_hash_survives_saving(tmp_path):
    from shorewright.io import read_level, write_level

    level = rough_level(150)
    level.write("height", Rect(3, 3, 40, 50), 5.0)
    level.write("cover", Rect(100, 100, 140, 140), 0.3)
    level.put_object("play", Camera(id="play"))
    write_level(level, tmp_path / "a.shore")
    again = _source_hash(read_level(tmp_path / "a.shore"), tmp_path / "b")
    assert _source_hash(level, tmp_path / "a") == again


@pytest.mark.parametrize(
    ("name", "stem"),
    [
        ("cove.shore", "cove"),
        ("Pyramid Rock", "Pyramid Rock"),
        ("Bucht-ä", "Bucht-ä"),
        ("../../etc", "_.._etc"),
        ("a/b\\c:d", "a_b_c_d"),
        ("coast_4033x4033", "coast_4033-4033"),
        ("海" * 120, "海" * 50),
        ("é" * 75 + "海", "é" * 75),
        ("a" * 149 + "é", "a" * 149),
        (".shore", "level"),
        ("", "level"),
    ],
)
def test_file_names_are_safe_everywhere(tmp_path, name, stem):
    """`4033x4033` is a tile index to Unreal; separators and drive letters lead out of the folder."""
    assert file_stem(name) == stem
    paths = export(rough_level(4), "unreal", tmp_path / "out", only=GROUND, name=name)
    assert [path.name for path in paths] == [f"{stem}_height.r16", f"{stem}_flow.png", f"{stem}.shorewright.json"]
    assert all(path.parent == tmp_path / "out" and path.is_file() for path in paths)
    assert check(tmp_path / "out") == []


# What is asked for


def test_unknown_target_and_map_are_refused_with_the_list(tmp_path):
    level = rough_level(4)
    with pytest.raises(BadInput, match=r"'blender'.*unreal, unity, godot"):
        export(level, "blender", tmp_path / "out")
    with pytest.raises(BadInput, match=r"'sand'.*height, mesh, layers"):
        export(level, "raw", tmp_path / "out", only=["height", "sand"])
    for target, name, told in (
        ("raw", "heigth", "'heigth': did you mean height[?]$"),
        ("unreal", "project", "unreal .*'project': only godot-project has it$"),
    ):
        with pytest.raises(BadInput, match=told):
            export(level, target, tmp_path / "out", only=["flow", name])
    with pytest.raises(BadInput, match="nothing"):
        export(level, "raw", tmp_path / "out", only=[])
    assert not (tmp_path / "out").exists()


def test_levels_that_cannot_be_exported_leave_nothing(tmp_path):
    for target, samples in (("godot-hterrain", 4098), ("godot", 16385)):
        large = Level(Grid(2, samples), np.zeros((2, samples), np.float32))
        with pytest.raises(BadInput, match=f"{samples} samples along its longer side.*{samples - 1}"):
            export(large, target, tmp_path / "out", GROUND)
    for target, options, word in (
        ("unity", {"tile": 100}, "tile of 100.*33, 65"),
        ("unreal", {"tile": 128}, "tile of 128.*127, 253"),
        ("unreal", {"tile": 127, "resample": True}, "not both"),
        ("raw", {"resample": True}, "nothing to resample"),
        ("godot-hterrain", {"tile": 65}, "no tiles"),
    ):
        with pytest.raises(BadInput, match=word):
            export(rough_level(8), target, tmp_path / "out", GROUND, **options)
    holes = rough_level(8)
    holes.layers["height"].array[3, 3] = np.nan
    with pytest.raises(BadInput, match="no numbers"):
        export(holes, "raw", tmp_path / "out")
    assert list(tmp_path.iterdir()) == []


def test_io_offers_the_function_and_the_table():
    assert export_function is export


def test_table_loads_without_heavy_libraries():
    """`shorewright` starts fast: the table of targets must not pull in meshes, images or GL (design)."""
    code = (
        "import sys; from shorewright.io.export import EXPORTERS; "
        "print(sorted({'trimesh', 'pyvista', 'OpenImageIO', 'scipy', 'moderngl'} & set(sys.modules)), len(EXPORTERS))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == f"[] {len(EXPORTERS)}"
