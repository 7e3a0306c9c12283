"""Pictures of exports as GDAL, Blender, Godot 3 and three.js read them: corners, one odd sample, every other one (T09).

Each client hands over all it read, in its own order of rows; the numbers are decoded by the manifest's own formula.
"""

import json
import re
import shutil

import numpy as np
import pytest
from clients.browser import browse
from clients.odd import ODD, decoded, odd_coast, same_picture, truth
from clients.programs import SCRIPTS, ran, run_blender
from exports import painted_level, read_manifest
from shorewright.io.export import export
from shorewright.io.export.map_rows import MAPS

EXPORTED = {"unreal": ("height", "normals"), "unity": ("height", "normals", "flow16"), "godot": ("height", "flow16"),
        "godot-hterrain": ("height",), "raw": ("height",)}  # fmt: skip


@pytest.fixture(scope="module", params=ODD)
def coast(request):
    return odd_coast(request)


@pytest.fixture(scope="module")
def exported(coast, tmp_path_factory):
    """`(folder, records by file name's end)` of each target, made when first asked for."""
    made = {}

    def of(target: str):
        if target not in made:
            folder = tmp_path_factory.mktemp(target) / "out"
            export(coast.level, target, folder, EXPORTED[target], name="odd")
            made[target] = folder, {file["name"].removeprefix("odd_"): file for file in read_manifest(folder)["files"]}
        return made[target]

    return of


def error(record) -> float:
    """The largest error by the manifest, in the unit of the decoded values: that of heights in metres is told in cm."""
    told_cm = record["error_unit"] == "cm" and record["channels"][0]["unit"] == "m"
    return record["max_error"] / (100 if told_cm else 1)


def same(coast, exported, target, name, words, coarse=0.0) -> None:
    """`words` are what a client read, in the file's order of rows; `coarse`: off by that share of the largest."""
    record = exported(target)[1][name]
    wanted = truth(coast, target, record)
    rows, cols = wanted.shape[:2]
    found = decoded(record, words.reshape(record["height"], record["width"], -1)[..., : wanted.shape[-1]])
    level_part = found[-rows:, :cols] if record["row_0"] == "south" else found[:rows, :cols]
    tolerance = 1.001 * error(record) + 2e-6 + coarse * np.abs(wanted).max()  # 2e-6: made in float32
    same_picture(level_part, wanted, tolerance, coast.odd if record["map"] == "height" else None)


# GDAL


def vrt(path, record) -> str:
    """A raw height map as GDAL is told of one."""
    width, height = record["width"], record["height"]
    return (
        f'<VRTDataset rasterXSize="{width}" rasterYSize="{height}"><VRTRasterBand dataType="UInt16" band="1" '
        f'subClass="VRTRawRasterBand"><SourceFilename relativeToVRT="0">{path}</SourceFilename><PixelOffset>2'
        f"</PixelOffset><LineOffset>{2 * width}</LineOffset><ByteOrder>LSB</ByteOrder></VRTRasterBand></VRTDataset>"
    )


@pytest.mark.parametrize(
    ("target", "name"),
    [
        ("unreal", "height.r16"),
        ("unity", "height.raw"),
        ("godot", "height.r16"),
        ("godot-hterrain", "height.raw"),
        ("raw", "height.r16"),
        ("unreal", "normals.png"),
        ("unity", "normals.png"),
        ("unity", "flow16.png"),
    ],
)
def test_gdal(coast, exported, tmp_path, target, name):
    """T09: the words of each channel, and the least and the greatest height by its statistics."""
    folder, records = exported(target)
    path, record = folder / f"odd_{name}", records[name]
    if path.suffix != ".png":
        raw, path = path, tmp_path / "raw.vrt"
        path.write_text(vrt(raw, record))
    ran("GDAL", "-q", "-of", "ENVI", "-co", "INTERLEAVE=BIP", path, tmp_path / "read.bin")
    same(coast, exported, target, name, np.fromfile(tmp_path / "read.bin", "<u2"))
    if record["map"] == "height":
        band = json.loads(ran("GDAL", "-json", "-stats", path, command="gdalinfo"))["bands"][0]
        ends = decoded(record, np.array([[band["minimum"], band["maximum"]]]))[0]
        wanted = truth(coast, target, record)
        assert ends == pytest.approx([wanted.min(), wanted.max()], abs=1.001 * error(record))


# Blender


def test_blender(coast, exported, tmp_path):
    """T09: 16-bit PNG and EXR of floats; Blender's rows begin at the bottom."""
    pictures = [("raw", "height.exr"), ("unity", "normals.png"), ("godot", "flow16.exr")]
    files = [exported(target)[0] / f"odd_{name}" for target, name in pictures]
    run_blender(tmp_path, files)
    for target, name in pictures:
        record = exported(target)[1][name]
        values = np.fromfile(tmp_path / f"odd_{name}.f32", "<f4").reshape(record["height"], record["width"], 4)[::-1]
        same(coast, exported, target, name, values * 65535 if name.endswith("png") else values)


# three.js


def test_three(coast, exported, tmp_path):
    """T09: EXR of one channel and of three; its textures begin at the bottom."""
    pictures = [("godot", "height.exr"), ("godot", "flow16.exr")]
    files = {f"odd_{name}": exported(target)[0] / f"odd_{name}" for target, name in pictures}
    browse("three", "three_read.html?" + "&".join(f"exr={name}" for name in files), files, tmp_path)
    for target, name in pictures:
        record = exported(target)[1][name]
        values = np.fromfile(tmp_path / f"odd_{name}.f32", "<f4").reshape(record["height"], record["width"], -1)[::-1]
        same(coast, exported, target, name, values)


# Godot 3


def test_godot_3(coast, exported, tmp_path):
    """T09: words of `.r16` to the bit; EXR, which it cuts to half floats of 11 bits."""
    folder, records = exported("godot")
    names = {"height.r16": ("<u2", 1), "height.exr": ("<f2", 4), "flow16.exr": ("<f2", 3)}
    shutil.copy(SCRIPTS / "godot3_read.gd", tmp_path)
    paths = [folder / f"odd_{name}" for name in names]
    ran("Godot 3", "--path", tmp_path, "-s", "godot3_read.gd", tmp_path, *paths, home=tmp_path)
    for name, (kind, channels) in names.items():
        read = np.fromfile(tmp_path / f"odd_{name}.bin", kind)
        values = read.reshape(records[name]["height"], records[name]["width"], channels)
        same(coast, exported, "godot", name, values, 2.0**-10 if kind == "<f2" else 0.0)


# Files as such


@pytest.fixture(scope="module")
def every_picture(tmp_path_factory):
    """Paths of all pictures of a small level that has every map, for the targets that differ in them."""
    level, found = painted_level(), []
    for target in ("unreal", "unity", "godot", "raw"):
        chosen = ["height", "flow", *MAPS, *(["flow_crest"] if target == "unity" else [])]
        found += export(level, target, tmp_path_factory.mktemp(target) / "out", chosen, name="bay")
    return found


def test_pngcheck(every_picture):
    """T09: no fault in any PNG, not even a chunk that it doesn't know."""
    paths = [path for path in every_picture if path.suffix == ".png"]
    assert len(paths) > 3 * len(MAPS) - 10
    told = ran("pngcheck", *paths)
    assert f"No errors were detected in {len(paths)} of the {len(paths)} files" in " ".join(told.split())
    assert "WARN" not in told.upper()


def test_exr_headers(every_picture):
    """T09: 32-bit floats, ZIP, named so that no importer takes a height for a colour or refuses it."""
    paths = [path for path in every_picture if path.suffix == ".exr"]
    assert len(paths) > 10
    for path in paths:
        told = ran("OpenEXR", path)
        channels = re.findall(r"^    (\S+), 32-bit floating-point, sampling 1 1$", told, re.MULTILINE)
        assert told.count("sampling") == len(channels)
        assert channels in (["Y"], ["B", "G", "R"], ["A", "B", "G", "R"]), path.name
        assert "compression (type compression): zip, multi-scanline blocks" in told
        assert "lineOrder (type lineOrder): increasing y" in told
