"""Raw files: 16 bits, float EXR, GLB and .vti, each read back by another library and compared point by point (T10)."""

import json
import struct

import numpy as np
import pytest
from exports import GROUND, slope_level
from shorewright.io.export import check, export, meshes
from shorewright.level import Grid, Level, Rect


@pytest.fixture
def raw(tmp_path):
    """(level, folder, manifest, file records by ending) of a whole raw export."""
    level = slope_level(23, 31, 1.5, sea_m=2.0)
    level.write("foam", Rect(2, 3, 9, 12), np.array([0.25, 0.75]))
    level.write("flow", Rect(0, 0, 5, 5), np.array([1.5, -2.5]))
    level.write("ice", Rect(20, 25, 23, 31), 1.0)
    level.write("weather", Rect(0, 0, 4, 4), 1.0)
    own = ["height", "mesh", "layers", "weather", "flow"]
    export(level, "raw", tmp_path / "out", own, name="bay")
    manifest = json.loads((tmp_path / "out" / "bay.shorewright.json").read_text("utf-8"))
    return level, tmp_path / "out", manifest, {file["name"].split(".")[-1]: file for file in manifest["files"]}


def test_all_files_are_listed_and_nothing_else(raw):
    _, folder, manifest, _ = raw
    names = [
        "bay.shorewright.json",
        "bay.vti",
        "bay_flow.png",
        "bay_height.exr",
        "bay_height.r16",
        "bay_terrain.glb",
        "bay_weather.tif",
    ]
    assert sorted(path.name for path in folder.iterdir()) == names
    assert sorted([file["name"] for file in manifest["files"]] + [names[0]]) == names
    assert manifest["world"]["sea_level_m"] == 2.0
    assert check(folder) == []


def test_sixteen_bits_decode_to_the_ground(raw):
    level, folder, manifest, files = raw
    record, world = files["r16"], manifest["world"]
    words = np.frombuffer((folder / record["name"]).read_bytes(), "<u2").reshape(23, 31)
    assert (words.min(), words.max()) == (0, 65535)
    low, high = record["decode"]["numbers"]["min_m"], record["decode"]["numbers"]["max_m"]
    assert (low, high) == (world["height_min_m"], world["height_max_m"]) == (level.height.min(), level.height.max())
    off = 100 * np.abs(words / 65535 * (high - low) + low - level.height[::-1]).max()
    assert record["max_error"] == pytest.approx(off, abs=1e-9)
    assert 0 < off <= record["step"] / 2 + 1e-9
    assert record["step"] == pytest.approx(100 * (high - low) / 65535)


def test_float_map_is_the_ground_itself(raw):
    """One channel named Y, 32 bits, lossless: the one layout Blender, three and Godot all read right."""
    import OpenImageIO

    level, folder, _, files = raw
    image = OpenImageIO.ImageInput.open(str(folder / files["exr"]["name"]))
    spec = image.spec()
    assert (tuple(spec.channelnames), str(spec.format), spec.getattribute("compression")) == (("Y",), "float", "zip")
    assert np.array_equal(image.read_image("float")[..., 0], level.height[::-1])
    image.close()
    assert files["exr"]["max_error"] == 0


def test_glb_stands_on_the_ground_north_is_minus_z(raw):
    import trimesh

    level, folder, _, files = raw
    (mesh,) = trimesh.load(folder / files["glb"]["name"], process=False, force="scene").geometry.values()
    vertices = np.asarray(mesh.vertices).reshape(23, 31, 3)
    north, east = np.mgrid[0:23, 0:31] * 1.5
    np.testing.assert_array_equal(vertices[..., 0], east)
    np.testing.assert_array_equal(vertices[..., 1], level.height)
    np.testing.assert_array_equal(vertices[..., 2], -north)
    assert len(mesh.faces) == 2 * 22 * 30 == files["glb"]["mesh"]["triangles"]
    assert (mesh.face_normals[:, 1] > 0).all()  # counter-clockwise from above
    assert files["glb"]["max_error"] == 0
    assert files["glb"]["mesh"]["surface_error_cm"] == 0


def test_glb_carries_normals_and_texture_coordinates(tmp_path):
    """Read from the file's own JSON: trimesh would make up the normals that are missing. A plane has one normal."""
    north, east = np.mgrid[0:9, 0:12] * 2.0
    export(Level(Grid(9, 12, 2.0), (0.3 * east + 0.4 * north).astype(np.float32)), "raw", tmp_path / "out", "mesh")
    data = (tmp_path / "out" / "level_terrain.glb").read_bytes()
    json_size, _ = struct.unpack_from("<II", data, 12)
    tree, binary = json.loads(data[20 : 20 + json_size]), data[28 + json_size :]
    (primitive,) = tree["meshes"][0]["primitives"]

    def attribute(name, width):
        accessor = tree["accessors"][primitive["attributes"][name]]
        view = tree["bufferViews"][accessor["bufferView"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return np.frombuffer(binary, "<f4", accessor["count"] * width, start).reshape(-1, width)

    normals = attribute("NORMAL", 3)
    np.testing.assert_allclose(normals, np.tile(np.array([-0.3, 1, 0.4]) / np.sqrt(1.25), (108, 1)), atol=1e-6)
    uphill = np.array([1, 0.3, 0]) / np.sqrt(1.09)  # to the east along the plane
    tangents = attribute("TANGENT", 4)
    assert (tangents[:, 3] == 1).all()
    assert np.abs((tangents[:, :3] * normals).sum(1)).max() < 1e-6
    assert (tangents[:, :3] @ uphill).min() > 0.9
    uv = attribute("TEXCOORD_0", 2).reshape(9, 12, 2)
    np.testing.assert_allclose(uv[..., 0], east / 22, atol=1e-6)
    np.testing.assert_allclose(uv[..., 1], 1 - north / 16, atol=1e-6)  # glTF: v = 0 is the picture's top, the north


@pytest.mark.parametrize(("rows", "cols"), [(2, 2), (23, 31), (129, 64), (4097, 4097), (8193, 300), (16385, 16385)])
@pytest.mark.parametrize("budget", [50, 5000, meshes.TRIANGLE_BUDGET])
def test_mesh_keeps_its_triangle_budget(rows, cols, budget):
    """The smallest stride that keeps it: one less would break it."""

    def triangles(stride):
        return 2 * -(-(rows - 1) // stride) * -(-(cols - 1) // stride)

    stride = meshes.stride_for(rows, cols, budget)
    assert triangles(stride) <= budget
    assert stride == 1 or triangles(stride - 1) > budget


def test_thinned_mesh_stands_on_samples_and_knows_its_error():
    """Vertices stay exact samples, the edge stays the edge; between them the distance is what brute force finds."""
    level = slope_level(40, 53, 1.0)
    mesh = meshes.terrain_mesh(level.height, 1.0, budget=200)
    assert mesh.stride > 3
    assert len(mesh.faces) <= 200
    assert (mesh.rows_at[-1], mesh.cols_at[-1]) == (39, 52)
    rows, cols = -mesh.positions[:, 2].astype(int), mesh.positions[:, 0].astype(int)
    np.testing.assert_array_equal(mesh.positions[:, 1], level.height[rows, cols])
    worst = 0.0
    for face in mesh.faces:
        (x0, z0, y0), (x1, z1, y1), (x2, z2, y2) = mesh.positions[face].astype(float)
        whole = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        for x in range(int(min(x0, x1, x2)), int(max(x0, x1, x2)) + 1):
            for y in range(int(min(y0, y1, y2)), int(max(y0, y1, y2)) + 1):
                b = ((x - x0) * (y2 - y0) - (x2 - x0) * (y - y0)) / whole
                c = ((x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)) / whole
                if min(b, c, 1 - b - c) >= -1e-12:
                    worst = max(worst, abs(z0 + b * (z1 - z0) + c * (z2 - z0) - level.height[-y, x]))
    assert meshes.surface_error_m(level.height, mesh) == pytest.approx(worst, abs=1e-9)
    assert worst > 0.1


def test_vti_holds_the_ground_and_every_written_layer(raw):
    """Points in the level's own order, x east fastest; flow as a vector, the weather map on its own grid left out."""
    import pyvista

    level, folder, _, files = raw
    image = pyvista.read(folder / files["vti"]["name"])
    assert image.dimensions == (31, 23, 1)
    assert image.spacing == (1.5, 1.5, 1.0)
    assert image.origin == (0, 0, 0)
    assert sorted(image.point_data.keys()) == ["flow", "foam", "height", "ice"]
    np.testing.assert_array_equal(image.point_data["height"].reshape(23, 31), level.height)
    np.testing.assert_array_equal(image.point_data["foam"].reshape(23, 31, 2), level.layers["foam"].array)
    np.testing.assert_array_equal(image.point_data["ice"].reshape(23, 31), level.layers["ice"].array)
    flow = image.point_data["flow"].reshape(23, 31, 3)
    np.testing.assert_array_equal(flow[..., :2], level.layers["flow"].array)
    assert (flow[..., 2] == 0).all()
    np.testing.assert_array_equal(image.points[33], [2 * 1.5, 1.5, 0])
    assert image.field_data["sea_level_m"][0] == 2.0
    assert [channel["name"] for channel in files["vti"]["channels"]] == ["height", "flow", "foam", "ice"]


def test_the_painted_sky_is_a_file_of_its_own(raw):
    """Z04: exact, north first, its grid told; a value out of range is found by the check."""
    from shorewright.io.images import read_image, write_image

    level, folder, manifest, files = raw
    record = files["tif"]
    wanted = level.layers["weather"].array
    found = read_image(folder / record["name"])
    np.testing.assert_array_equal(found[::-1], wanted)
    assert [channel["name"] for channel in record["channels"]] == list(level.layers["weather"].row.channels)
    assert any("tiling" in line and "row 255, column 256" in line for line in manifest["import_recipe"])
    row, col = 255, 256
    assert level.layers["weather"].grid.to_metres(511 - row, col) == (0.0, 0.0)
    write_image(folder / record["name"], found + np.float32(2), channels=[*"RGBA", "C4", "C5"])
    assert any(record["name"] in finding for finding in check(folder))


@pytest.mark.parametrize(
    ("only", "names"),
    [
        ("height", ["bay_height.exr", "bay_height.r16"]),
        (["mesh"], ["bay_terrain.glb"]),
        (("layers", "mesh"), ["bay.vti", "bay_terrain.glb"]),
    ],
)
def test_only_picks_maps_and_leaves_no_stale_ones(tmp_path, only, names):
    """The folder then holds what its manifest lists: a mesh of yesterday's ground beside it would be a trap."""
    export(slope_level(5, 6), "raw", tmp_path / "out", name="bay")
    paths = export(slope_level(7, 6), "raw", tmp_path / "out", only=only, name="bay")
    assert sorted(path.name for path in paths) == sorted([*names, "bay.shorewright.json"])
    assert sorted((tmp_path / "out").iterdir()) == sorted(paths)
    assert check(tmp_path / "out") == []


def test_flat_ground_is_no_division_by_zero(tmp_path, flat_level):
    export(flat_level, "raw", tmp_path / "out", "height")
    assert (np.fromfile(tmp_path / "out" / "level_height.r16", "<u2") == 0).all()
    assert check(tmp_path / "out") == []


def test_a_real_coast_goes_through_the_targets(tmp_path, data_dir):
    """Pyramid Rock at its own 2 m × 1 m samples made square: errors stay within half a step, the mesh in its budget."""
    grid = np.loadtxt(data_dir / "coasts" / "pyramidrock_hi.celeris.txt")
    east = np.arange(801) / 2
    height = np.array([np.interp(east, np.arange(401), row) for row in grid])[::-1].astype(np.float32)
    level = Level(Grid(601, 801, 1.0), height)
    for target in ("unreal", "unity", "godot", "raw"):
        only = [*GROUND, "mesh", "layers"] if target == "raw" else GROUND
        *_, path = export(level, target, tmp_path / target, only, name="pyramid_rock.shore")
        assert check(tmp_path / target) == []
        for file in json.loads(path.read_text("utf-8"))["files"]:
            assert file["max_error"] <= (file["step"] or 0) / 2 + 1e-5
            assert file["max_error"] < (1.0 if file["map"] == "flow" else 0.05)  # cm/s
            assert file["mesh"] is None or file["mesh"]["triangles"] <= meshes.TRIANGLE_BUDGET
