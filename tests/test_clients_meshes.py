"""GLB files as Blender, three.js and Babylon read them, corner for corner, and as Khronos' validator judges (T09, H03).

Truth is the level's own; each client's axes stand in `clients/solids.py`.
"""

import functools
import json

import numpy as np
import pytest
from clients.browser import browse
from clients.odd import ODD, SAMPLES, odd_coast
from clients.programs import SCRIPTS, need, ran, run_babylon, run_blender
from clients.solids import TERRAIN, read_solids, true_solids
from coasts import make_beach
from scipy import ndimage
from shorewright.io import read_level
from shorewright.io.export import export
from shorewright.io.export.mesh_rows import MESHES
from shorewright.io.images import read_image
from shorewright.level.walk import walkable

KINDS = (TERRAIN, *MESHES)
# What a client reads of each coast: every kind once, the ground and the beach of both.
READ = {"cove": (TERRAIN, "beach", "rivers", "props"), "pyramid_rock": (TERRAIN, "beach", "tiles", "walkable_mesh")}
# Of each array the largest difference, m for places; Blender keeps colours as bytes and normals in 16 bits.
TOLERANCES = {"positions": 1e-4, "normals": 1e-4, "tangents": 1e-4, "uv": 2e-4, "colours": 1e-5}
COARSER = {"Blender": {"normals": 0.02, "colours": 0.005}}
SAME_WAY = {"beach": 0.9, "props": 0.88}  # parts whose UVs fold: at a beach's ends, under a hull seen from above


@pytest.fixture(scope="module", params=ODD)
def coast(request):
    return odd_coast(request)


@pytest.fixture(scope="module")
def files(coast, tmp_path_factory):
    """Every GLB of a coast by its kind."""
    paths = export(coast.level, "raw", tmp_path_factory.mktemp(coast.name) / "out", KINDS, name=coast.name)
    kinds = {"terrain": TERRAIN}
    found = {path.stem.removeprefix(f"{coast.name}_"): path for path in paths if path.suffix == ".glb"}
    return {kinds.get(kind, kind): path for kind, path in found.items()}


def run_three(out, paths, coast) -> None:
    """Arrays, a ray down on the odd sample, and a picture from above, a pixel a sample."""
    (rows, cols), (east, north), (x, y, _) = coast.level.grid.shape, coast.level.grid.extent_m, coast.odd_place
    query = [f"glb={path.name}" for path in paths] + [f"ground={coast.name}_terrain.glb", f"ray={x},{-y}"]
    page = f"three_read.html?{'&'.join(query)}&size={cols},{rows},{east},{north}"
    browse("three", page, {path.name: path for path in paths}, out)


READERS = {
    "Blender": lambda out, paths, coast: run_blender(out, paths),
    "Babylon": lambda out, paths, coast: run_babylon(out, paths),
    "three": run_three,
}


@pytest.fixture(scope="module")
def read_by(coast, files, tmp_path_factory):
    """The folder of what a client read, files of READ in one run, a folder of each inside."""

    @functools.cache
    def folder(name: str):
        out = tmp_path_factory.mktemp("read")
        READERS[name](out, [files[kind] for kind in READ[coast.name]], coast)
        return out

    return folder


def test_khronos_finds_nothing_wrong(coast, files):
    """T09: 0 errors and 0 warnings in every file."""
    assert {TERRAIN, "beach", "tiles", "walkable_mesh"} <= set(files)
    assert coast.name != "cove" or set(files) == set(KINDS)
    valid(files.values())


def test_khronos_finds_nothing_wrong_in_a_delta(tmp_path):
    """T09: the same for the level with the most rivers."""
    need("Khronos")
    paths = export(read_level(SAMPLES / "delta.shore"), "raw", tmp_path / "out", KINDS, name="delta")
    valid([path for path in paths if path.suffix == ".glb"])


def valid(paths) -> None:
    told = json.loads(ran("Khronos", SCRIPTS / "validate.mjs", *paths))
    assert set(told) == set(map(str, paths))
    for path, issues in told.items():
        assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), (path, issues["messages"][:3])


@pytest.mark.parametrize("name", READERS)
def test_corner_for_corner(coast, files, read_by, name):
    """T09, H03: places, normals, tangents, UVs and masks of each corner of each triangle, in the level's axes."""
    folder = read_by(name)
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


@pytest.mark.parametrize("name", READERS)
def test_corners_and_the_odd_sample(coast, files, read_by, name):
    """T09: the level's four corners and its one high sample stand where the level has them, to 0.1 mm."""
    folder = read_by(name)
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


def test_three_hits_and_draws_it(coast, read_by):
    """T09: a ray down hits the odd sample's height; seen from above beach and rivers lie where the level has them."""
    folder = read_by("three")
    hits = json.loads((folder / "ray.json").read_text())
    x, y, z = coast.odd_place
    np.testing.assert_allclose(hits[0], (x, z, -y), atol=1e-4)
    seen = read_image(folder / "above.png")[..., :3] > 200
    red, blue = seen[..., 0], seen[..., 2]
    drawn = {kind: MESHES[kind].make(coast.level)[0] for kind in ("beach", "rivers")}
    lies(drawn["beach"][:1], red | blue, coast)
    lies(drawn["rivers"], blue, coast)
    assert blue.any() == bool(drawn["rivers"])


def lies(parts, mask, coast) -> None:
    """The middle of every triangle is in the mask, not in a copy of it turned round; nor is the mask much larger."""
    corners = np.concatenate([part.positions[part.triangles][..., :2] for part in parts] or [np.empty((0, 3, 2))])
    if not len(corners):
        return
    col, row = (corners.mean(1) / coast.level.grid.cell_m).T
    for turned, inside in ((mask[::-1], True), (mask, False), (mask[::-1, ::-1], False)):
        share = turned[np.rint(row).astype(int), np.rint(col).astype(int)].mean()
        assert share > 0.98 if inside else share < 0.9, (inside, share)


def test_recast_finds_a_way_along_the_beach(tmp_path):
    """T09, D31: a navmesh of the walkable mesh leads along the cove's beach, nowhere else than where one can walk."""
    need("Recast")
    level = read_level(SAMPLES / "cove.shore")
    path, _ = export(level, "raw", tmp_path / "out", ["walkable_mesh"], name="cove")
    free = walkable(level)
    broad = ndimage.label(ndimage.binary_erosion(free, iterations=4))[0]
    widest = broad == np.bincount(broad[broad > 0]).argmax()
    row, col = np.nonzero(widest & (level.height > 0.2) & (level.height < 2))
    ends = [(int(col[i]), float(level.height[row[i], col[i]]), -int(row[i])) for i in (col.argmin(), col.argmax())]
    assert ends[1][0] - ends[0][0] > 500
    told = json.loads(ran("Recast", SCRIPTS / "recast_path.mjs", path, *(",".join(map(str, end)) for end in ends)))
    points = np.array(told["points"])
    assert np.abs(points[[0, -1]][:, [0, 2]] - np.array(ends)[:, [0, 2]]).max() < 1.5
    step = np.linspace(0, len(points) - 1, 2000)
    x, _, z = (np.interp(step, np.arange(len(points)), points[:, axis]) for axis in range(3))
    near = ndimage.binary_dilation(free)
    assert near[np.rint(-z).astype(int), np.rint(x).astype(int)].all()


def test_meshes_lie_on_unitys_terrain(tmp_path):
    """T09: an importer that negates X, as those for Unity do, gets X east, Z north and the sea at Y 0."""
    need("Babylon")
    level = make_beach(rows=97, cols=113)
    level.set("level.sea_level_m", 0.5)
    out = tmp_path / "out"
    export(level, "unity", out, ["beach"], name="bay")
    (tmp_path / "read").mkdir()
    run_babylon(tmp_path / "read", [out / "bay_beach.glb"])
    for part in MESHES["beach"].make(level)[0]:
        read = np.fromfile(tmp_path / "read" / "bay_beach.glb" / f"{part.name}.positions.f32", "<f4").reshape(-1, 3)
        east, north, up = part.positions[part.triangles].reshape(-1, 3).T
        assert np.abs(read - np.stack([east, up - 0.5, north], -1)).max() < 1e-4
