"""Pictures of exports as GDAL, Blender, Godot 3 and three.js read them: corners, one odd sample, every other one (T09).

Each client hands over all it read, in its own order of rows; the numbers are decoded by the manifest's own formula.
"""

import json

import numpy as np
import pytest
from clients.odd import ODD, decoded, odd_coast, same_picture, truth
from clients.programs import ran, run_blender
from exports import read_manifest
from shorewright.io.export import export

MAPS = {"unreal": ("height", "normals"), "unity": ("height", "normals", "flow16"), "godot": ("height", "flow16"),
        "raw": ("height",)}  # fmt: skip


@pytest.fixture(scope="module", params=ODD)
def coast(request, data_dir):
    return odd_coast(request.param, data_dir)


@pytest.fixture(scope="module")
def exported(coast, tmp_path_factory):
    """`(folder, records by file name's end)` of each target, made when first asked for."""
    made = {}

    def of(target: str):
        if target not in made:
            folder = tmp_path_factory.mktemp(target) / "out"
            export(coast.level, target, folder, MAPS[target], name="odd")
            made[target] = folder, {file["name"].removeprefix("odd_"): file for file in read_manifest(folder)["files"]}
        return made[target]

    return of


def same(coast, exported, target, name, words) -> None:
    """`words` are what a client read, north row first where the file has it so."""
    record = exported(target)[1][name]
    wanted = truth(coast, target, record)
    rows, cols = wanted.shape[:2]
    found = decoded(record, words.reshape(record["height"], record["width"], -1)[..., : wanted.shape[-1]])
    level_part = found[-rows:, :cols] if record["row_0"] == "south" else found[:rows, :cols]
    tolerance = 1.001 * record["max_error"] + 2e-6  # the exporter works in float32
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
        assert ends == pytest.approx([wanted.min(), wanted.max()], abs=1.001 * record["max_error"])


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
