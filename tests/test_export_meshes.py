"""Meshes of MESHES: every row written, read back, checked, and valid to Khronos (T09)."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from clients.programs import SCRIPTS, ran
from exports import MANIFEST, one, sign
from shorewright.io.export import check, export
from shorewright.io.export.mesh_glb import read_parts
from shorewright.io.export.mesh_ground import terrain_tiles
from shorewright.io.export.mesh_rows import MESHES
from shorewright.io.export.records import Manifest
from shorewright.level import Grid, Level
from shorewright.level.meshes import block
from shorewright.level.objects import Prop, River
from shorewright.level.walk import walkable


def coast():
    """A bay with a river that falls, a raft and two crates."""
    y, x = np.mgrid[0:121, 0:151].astype(float)
    level = Level(Grid(121, 151), ((y - 60) * 0.12 + 2 * np.sin(x / 17)).astype(np.float32))
    fall = ((0, 0, 8, 6, 2), (0, -12, 8, 5.8, 2), (-1, -16, 8, 3, 4), (-3, -50, 8, 0, 1))
    level.put_object("beck", River(id="beck", x=90, y=110, points=fall))
    level.put_mesh("block", block())
    level.put_object("raft", Prop(id="raft", mesh="block", x=60, y=20, floats=True, scale=3))
    level.put_object("a", Prop(id="a", mesh="block", x=30, y=100, z=5, yaw_deg=30, scale=2))
    return level


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    level, folder = coast(), tmp_path_factory.mktemp("meshes") / "out"
    return level, folder, written(level, folder)


def written(level, folder):
    """Records by mesh of an export of all meshes."""
    *_, path = export(level, "raw", folder, list(MESHES), name="bay")
    data = json.loads(path.read_text("utf-8"))
    del data["manifest_sha256"]
    return {record.map: record for record in Manifest.model_validate(data).files}


@pytest.fixture
def copy(made, tmp_path):
    return Path(shutil.copytree(made[1], tmp_path / "copy"))


@pytest.mark.parametrize("name", MESHES)
def test_every_row_is_written_and_checked(made, name):
    """T09: one GLB a row, its numbers those of the bytes."""
    _, folder, files = made
    parts = read_parts(folder / files[name].name)
    assert [p.name for p in parts] == [p.name for p in files[name].parts]
    assert all(len(part.triangles) for part in parts)
    assert any(
        line.startswith(files[name].name) for line in json.loads((folder / MANIFEST).read_text())["import_recipe"]
    )


def test_check_finds_nothing(made):
    assert check(made[1]) == []


def test_khronos_finds_no_error(made):
    """T09: the reference validator, where it is installed."""
    paths = sorted(made[1].glob("*.glb"))
    told = json.loads(ran("Khronos", SCRIPTS / "validate.mjs", *paths))
    assert set(told) == set(map(str, paths))
    for path, issues in told.items():
        assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), (path, issues["messages"][:3])


def test_trimesh_reads_them_too(made):
    """T09: another reader finds as many triangles, and UVs turned its way."""
    import trimesh

    _, folder, files = made
    for record in files.values():
        scene = trimesh.load(folder / record.name, process=False, force="scene")
        assert sum(len(mesh.faces) for mesh in scene.geometry.values()) == sum(p.triangles for p in record.parts)


def test_water_and_sand_are_one_topology(made):
    """H03: same triangles, UVs and masks; the water lies flat on the sea, the sand on the ground."""
    level, folder, files = made
    water, sand = read_parts(folder / files["beach"].name)
    assert (water.name, sand.name) == ("water", "sand")
    np.testing.assert_array_equal(water.triangles, sand.triangles)
    for name in ("TEXCOORD_0", "COLOR_0"):
        np.testing.assert_array_equal(water.values[name], sand.values[name])
    assert (water.values["POSITION"][:, 1] == level.mean_sea_m).all()
    x, y, z = sand.values["POSITION"].T
    assert np.abs(y - ((-z - 60) * 0.12 + 2 * np.sin(x / 17))).max() < 0.01


@pytest.mark.parametrize("name", [name for name in MESHES if name != "props"])
def test_tangents_point_along_growing_u(made, name):
    """T09: the map from UV to space of each triangle has its u where the tangents are, v against the bitangent."""
    for part in read_parts(made[1] / made[2][name].name):
        p, uv = (part.values[key][part.triangles].astype(float) for key in ("POSITION", "TEXCOORD_0"))
        normal = part.values["NORMAL"][part.triangles].astype(float).mean(1)
        flat = normal[:, 1] > 0.9 if name != "tiles" else np.arange(len(p)) < 100
        e, d = p[:, 1:] - p[:, :1], uv[:, 1:] - uv[:, :1]
        area = d[:, 0, 0] * d[:, 1, 1] - d[:, 0, 1] * d[:, 1, 0]
        fair = flat & (np.abs(area) > 1e-9)
        along = (e[:, 0] * d[:, 1, 1:] - e[:, 1] * d[:, 0, 1:])[fair] / area[fair, None]
        down = (e[:, 1] * d[:, 0, :1] - e[:, 0] * d[:, 1, :1])[fair] / area[fair, None]
        tangent = part.values["TANGENT"][part.triangles][..., :3].astype(float).mean(1)[fair]
        across = np.cross(normal[fair], tangent)
        assert ((along * tangent).sum(1) > 0).mean() > 0.97
        assert ((down * across).sum(1) < 0).mean() > 0.97


def test_tiles_share_edges_and_coarser_ones_hide_behind_skirts():
    """T09: neighbours have the same vertices; a coarse edge's skirt reaches below the fine one."""
    rng = np.random.default_rng(4)
    level = Level(Grid(150, 200), rng.normal(0, 1, (150, 200)).astype(np.float32))
    parts = {part.name: part for part in terrain_tiles(level)[0]}
    assert len(parts) == 2 * 2 * 3
    for lod in range(3):
        west, east = (parts[f"tile_0_{col}_lod{lod}"].positions for col in (0, 1))
        edges = [np.unique(side[side[:, 0] == 128], axis=0) for side in (west, east)]
        np.testing.assert_array_equal(*edges)
    fine, coarse = (parts[f"tile_0_0_lod{lod}"] for lod in (0, 2))
    top = [p.positions[(p.positions[:, 0] == 128) & (p.colours[:, 0] == 1)] for p in (fine, coarse)]
    foot = coarse.positions[(coarse.positions[:, 0] == 128) & (coarse.colours[:, 0] == 0)]
    order = np.argsort(foot[:, 1])
    assert (np.interp(top[0][:, 1], foot[order, 1], foot[order, 2]) < top[0][:, 2]).all()
    assert len(coarse.triangles) < len(fine.triangles) / 10


def test_a_walker_fits_everywhere_on_the_mesh(made):
    level, folder, files = made
    (part,) = read_parts(folder / files["walkable_mesh"].name)
    x, _, z = part.values["POSITION"].T
    free = walkable(level)
    assert free[np.rint(-z).astype(int), np.rint(x).astype(int)].all()
    cells = free[1:, 1:] & free[:-1, 1:] & free[1:, :-1] & free[:-1, :-1]
    assert len(part.triangles) == 2 * cells.sum() > 0


def test_a_ribbon_is_as_wide_and_high_as_its_river(made):
    """H32: u reaches from bank to bank, v from the first point on, the level falls from 6 m to the sea."""
    _, folder, files = made
    (part,) = read_parts(folder / files["rivers"].name)
    u, v = part.values["TEXCOORD_0"].T
    height = part.values["POSITION"][:, 1]
    assert (u.min(), v.min()) == (0, 0)
    assert u[v == 0].max() == pytest.approx(8, abs=0.01)
    assert height[v == 0] == pytest.approx(6, abs=0.05)
    assert np.abs(height[:, None] - height[None, :])[v[:, None] == v[None, :]].max() == 0
    foam = part.values["COLOR_0"][:, 1]
    assert foam[(height < 5.5) & (height > 3.3)].min() > foam[v == 0].max()


def test_props_stand_where_the_level_has_them(made):
    import trimesh

    scene = trimesh.load(made[1] / made[2]["props"].name, process=False, force="scene")
    matrix = scene.graph.get("a")[0]
    np.testing.assert_allclose(matrix[:3, 3], (30, 5, -100), atol=1e-6)
    north = matrix[:3, :3] @ (0, 0, -1)
    np.testing.assert_allclose(north, 2 * np.array([np.sin(np.pi / 6), 0, -np.cos(np.pi / 6)]), atol=1e-6)


def _spoil_normals(data, part):
    start = data.index(np.ascontiguousarray(part.values["NORMAL"]).tobytes())
    data[start : start + 12] = np.array([0, 0.5, 0], "<f4").tobytes()


def _spoil_indices(data, part):
    start = data.index(part.triangles.astype("<u4").tobytes())
    data[start : start + 4] = np.array([10**7], "<u4").tobytes()


def _spoil_tangents(data, part):
    start = data.index(np.ascontiguousarray(part.values["TANGENT"]).tobytes())
    data[start : start + 12] = np.array([0, 0, 0], "<f4").tobytes()


@pytest.mark.parametrize(
    ("spoil", "word"),
    [(_spoil_normals, "normals"), (_spoil_indices, "vertices"), (_spoil_tangents, "tangents")],
)
def test_check_names_what_is_spoilt(copy, spoil, word):
    """T09: with sizes and hashes put right again, only decoding can find it."""
    path = copy / "bay_walkable_mesh.glb"
    data, (part,) = bytearray(path.read_bytes()), read_parts(path)
    spoil(data, part)
    path.write_bytes(data)
    sign(copy, lambda manifest: None)
    one(check(copy), word)


def test_check_names_other_extents_and_damage(copy):
    def edit(manifest):
        record = next(file for file in manifest["files"] if file["map"] == "rivers")
        record["parts"][0]["uv_high"][0] += 1

    sign(copy, edit)
    one(check(copy), "UVs")
    path = copy / "bay_beach.glb"
    path.write_bytes(path.read_bytes()[:-8])
    sign(copy, lambda manifest: None)
    assert any("GLB" in found for found in check(copy))


def test_a_level_without_any_has_no_such_files(tmp_path):
    flat = Level(Grid(20, 20), np.full((20, 20), -40, np.float32))
    assert list(written(flat, tmp_path / "out")) == ["tiles"]
    assert check(tmp_path / "out") == []
