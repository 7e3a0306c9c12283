"""GLB files as Blender, three.js and Babylon read them, corner for corner, and as Khronos' validator judges (T09, H03).

Truth is the level's own; each client's axes stand in `clients/solids.py`.
"""

import json

import numpy as np
import pytest
from clients.odd import ODD, SAMPLES, odd_coast
from clients.programs import SCRIPTS, ran, run_babylon, run_blender
from clients.solids import TERRAIN, read_solids, true_solids
from shorewright.io import read_level
from shorewright.io.export import export
from shorewright.io.export.mesh_rows import MESHES

KINDS = (TERRAIN, *MESHES)
# What a client reads of each coast: every kind once, the ground and the beach of both.
READ = {"cove": (TERRAIN, "beach", "rivers", "props"), "pyramid_rock": (TERRAIN, "beach", "tiles", "walkable_mesh")}
# Of each array the largest difference, m for places; Blender keeps colours as bytes and normals in 16 bits.
TOLERANCES = {"positions": 1e-4, "normals": 1e-4, "tangents": 1e-4, "uv": 2e-4, "colours": 1e-5}
COARSER = {"Blender": {"normals": 0.02, "colours": 0.005}}
SAME_WAY = {"beach": 0.88, "props": 0.88}  # parts whose UVs fold: at a beach's ends, under a hull seen from above
READERS = {"Blender": run_blender, "Babylon": run_babylon}


@pytest.fixture(scope="module", params=ODD)
def coast(request, data_dir):
    return odd_coast(request.param, data_dir)


@pytest.fixture(scope="module")
def files(coast, tmp_path_factory):
    """Every GLB of a coast by its kind."""
    paths = export(coast.level, "raw", tmp_path_factory.mktemp(coast.name) / "out", KINDS, name=coast.name)
    kinds = {"terrain": TERRAIN}
    found = {path.stem.removeprefix(f"{coast.name}_"): path for path in paths if path.suffix == ".glb"}
    return {kinds.get(kind, kind): path for kind, path in found.items()}


@pytest.fixture(scope="module", params=READERS)
def client(request, coast, files, tmp_path_factory):
    """`(name, folder)`: one run of a client over the files of READ, a folder of each inside."""
    folder = tmp_path_factory.mktemp("read")
    READERS[request.param](folder, [files[kind] for kind in READ[coast.name]])
    return request.param, folder


def test_khronos_finds_nothing_wrong(coast, files):
    """T09: 0 errors and 0 warnings in every file."""
    assert {TERRAIN, "beach", "tiles", "walkable_mesh"} <= set(files)
    assert coast.name != "cove" or set(files) == set(KINDS)
    valid(files.values())


def test_khronos_finds_nothing_wrong_in_a_delta(tmp_path):
    """T09: the same for the level with the most rivers."""
    paths = export(read_level(SAMPLES / "delta.shore"), "raw", tmp_path / "out", KINDS, name="delta")
    valid([path for path in paths if path.suffix == ".glb"])


def valid(paths) -> None:
    told = json.loads(ran("Khronos", SCRIPTS / "validate.mjs", *paths))
    assert set(told) == set(map(str, paths))
    for path, issues in told.items():
        assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), (path, issues["messages"][:3])


def test_corner_for_corner(coast, files, client):
    """T09, H03: places, normals, tangents, UVs and masks of each corner of each triangle, in the level's axes."""
    name, folder = client
    for kind in READ[coast.name]:
        read, wanted = read_solids(folder / files[kind].name, name), true_solids(coast.level, kind, coast.name)
        assert set(read) == set(wanted)
        for mesh, arrays in wanted.items():
            same_solid(read[mesh], arrays, name, kind)


def same_solid(read, wanted, name, kind) -> None:
    for key, values in wanted.items():
        if (name, key) == ("Blender", "tangents"):
            same_way(read, wanted, SAME_WAY.get(kind, 0.995))
            continue
        assert read[key].shape == values.shape, (kind, key)
        off = np.abs(read[key] - values).max()
        assert off <= COARSER.get(name, {}).get(key, TOLERANCES[key]), (kind, key, off)


def same_way(read, wanted, share) -> None:
    """Blender makes tangents anew from the UVs: they point the same way, where a triangle's UVs have one."""
    (a, b), (c, d) = ((wanted["uv"][i::3] - wanted["uv"][::3]).T for i in (1, 2))
    fair = np.repeat(np.abs(a * d - b * c) > 1e-9, 3)
    assert fair.mean() > 0.3
    along = (read["tangents"] * wanted["tangents"]).sum(1)[fair] > 0.5
    assert along.mean() > share, along.mean()


def test_corners_and_the_odd_sample(coast, files, client):
    """T09: the level's four corners and its one high sample stand where the level has them, to 0.1 mm."""
    name, folder = client
    height, (east, north) = coast.level.height, coast.level.grid.extent_m
    for kind in {TERRAIN, "tiles"} & set(READ[coast.name]):
        points = np.concatenate([top(mesh) for mesh in read_solids(folder / files[kind].name, name).values()])
        np.testing.assert_allclose(points[points[:, 2].argmax()], coast.odd_place, atol=1e-4)
        for row, col, x, y in ((0, 0, 0, 0), (0, -1, east, 0), (-1, 0, 0, north), (-1, -1, east, north)):
            nearest = points[np.hypot(points[:, 0] - x, points[:, 1] - y).argmin()]
            np.testing.assert_allclose(nearest, (x, y, height[row, col]), atol=1e-4)


def top(mesh) -> np.ndarray:
    """Places of the ground, without the foot of the skirts that hang from a tile."""
    return mesh["positions"][mesh["colours"][:, 0] > 0.5] if "colours" in mesh else mesh["positions"]
