"""Godot 4 itself reads what is exported for it, in a browser: the kit's shader, the project, meshes and words (T09)."""

import base64
import json

import numpy as np
import pytest
from clients.godot4 import run_godot4
from clients.odd import ODD, SAMPLES, odd_coast
from clients.programs import CLIENTS, SCRIPTS
from coasts import make_beach
from kit_parts import asked
from shorewright.io import read_level
from shorewright.io.export import export
from shorewright.io.images import read_image
from shorewright.level import Rect
from shorewright.level.flow import current
from shorewright.level.waves import surface_at

TIMES_S = (0.0, 3.7, 600.5, 604_800.75)
COLS, ROWS = 50, 50
pytestmark = pytest.mark.skipif(CLIENTS["Godot 4"].missing() is not None, reason=str(CLIENTS["Godot 4"].missing()))


def exported(level, folder, *maps) -> dict[str, bytes]:
    """Files of the level's project, by name."""
    export(level, "godot-project", folder, maps, name="bay")
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def sea_in_godot(level, tmp_path, asks):
    """(n, 8) position, normal and current at (n, 3) times and points."""
    files = exported(level, tmp_path / "out", "project")
    times = np.unique(asks[:, 0])
    files["sea.gdshaderinc"] = files["bay_sea.gdshaderinc"]
    files["points.gdshader"] = (SCRIPTS / "godot4_points.gdshader").read_bytes()
    files["points.f32"] = np.float32(asks[:, 1:]).tobytes()
    told = {"name": "bay", "cols": COLS, "rows": ROWS, "times_s": times.tolist()}
    files["asked.json"] = json.dumps(told).encode()
    found = run_godot4("godot4_points.gd", files, tmp_path / "told")
    pixels = [np.frombuffer(base64.b64decode(text), np.uint8) for text in found["answer"]]
    return np.concatenate([values_of(one.reshape(-1, ROWS, COLS, 3)) for one in pixels])


def values_of(blocks: np.ndarray) -> np.ndarray:
    """(points, 8) floats of 16 blocks of pixels, each with two bytes of one."""
    words = blocks[..., 0].astype(np.uint32) | blocks[..., 1].astype(np.uint32) << 8
    bits = words[0::2] | words[1::2] << 16
    return np.moveaxis(bits.view(np.float32), 0, -1).reshape(-1, 8)


@pytest.mark.parametrize("name", ["cove", "delta"])
def test_godots_sea_is_the_editors(name, tmp_path):
    """T09: compiled by Godot 4, the kit gives the twin's sea at 10,000 points and times within a millimetre."""
    level = read_level(SAMPLES / f"{name}.shore")
    asks = asked(level, TIMES_S, COLS * ROWS)
    found = sea_in_godot(level, tmp_path, asks)
    apart = []
    for t in TIMES_S:
        here = asks[:, 0] == t
        sea = surface_at(level, t, asks[here, 1], asks[here, 2])
        twin = np.stack([sea.x, sea.y, sea.height_m], -1)
        apart.append(np.abs(found[here, :3] - twin))
        flow = np.stack(current(level).at(asks[here, 1], asks[here, 2]), -1)
        assert np.abs(found[here, 6:] - flow).max() < 1e-4
    assert np.concatenate(apart).max() < 1e-3


@pytest.fixture(params=ODD)
def coast(request):
    return odd_coast(request)


def test_godots_own_readers_see_the_level(coast, tmp_path):
    """T09: corners and an odd sample of words, pictures and meshes stand where Godot puts them, north at −Z."""
    level, odd = coast.level, coast.odd
    rows, cols = level.grid.shape
    north = level.grid.extent_m[1]
    level.write("snow", Rect(odd[0], odd[1], odd[0] + 1, odd[1] + 1), np.ones((1, 1), np.float32))
    export(level, "godot", tmp_path / "out", ["height", "snow", "tiles", "beach"], name="bay")
    files = {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()}
    engine = json.loads(files["bay.shorewright.json"])["engine"]
    samples = [odd, (0, 0), (0, cols - 1), (rows - 1, 0), (rows - 1, cols - 1)]
    picture = [(col, rows - 1 - row) for row, col in samples]
    places = [(col * level.grid.cell_m, north - row * level.grid.cell_m) for row, col in samples]
    asked_of = {
        "words": {"name": "bay_height.r16", "places": picture, **engine},
        "pictures": {"bay_snow.png": picture},
        "meshes": {"bay_tiles.glb": places, "bay_beach.glb": []},
    }  # fmt: skip
    told = run_godot4("godot4_files.gd", files | {"asked.json": json.dumps(asked_of).encode()}, tmp_path / "told")
    found = json.loads(told["found"][0])
    truth = np.array([level.height[at] for at in samples]) - level.sea_level_m
    assert np.abs(np.array(found["words"]) - truth).max() < 0.51 * (engine["max_m"] - engine["min_m"]) / 65535
    snow = found["pictures"]["bay_snow.png"]
    assert snow["size"] == [cols, rows]
    assert [colour[0] for colour in snow["colours"]] == [255, 0, 0, 0, 0]
    tiles = found["meshes"]["bay_tiles.glb"]["meshes"]
    finest = [one for one in tiles if one["name"].endswith("lod0")]
    for number, height in enumerate(truth):
        there = [one["heights"][str(number)] for one in finest if str(number) in one["heights"]]
        assert there == pytest.approx([height] * len(there), abs=0.002)  # it packs a mesh's box into 16 bits
        assert there
    for one in [*tiles, *found["meshes"]["bay_beach.glb"]["meshes"]]:
        assert one["has"] == [True] * 4
        assert one["up"] > 0


def test_the_project_draws_ground_and_a_sea_that_moves(tmp_path):
    """T09: opened in Godot, its own scene shows sand beside blue water, and a second later other waves."""
    level = make_beach(rows=129, cols=129, cell_m=1.0)
    files = exported(level, tmp_path / "out", "project")
    scene_of_level = files["main.tscn"].decode().replace("level_name =", "coarse = 4\nheld = true\nlevel_name =")
    files |= {"main.tscn": scene_of_level.encode()}
    found = run_godot4("godot4_drawn.gd", files, tmp_path / "told", size="160x120")
    for number, text in enumerate(found["picture"]):
        (tmp_path / f"{number}.png").write_bytes(base64.b64decode(text))
    early, late = (read_image(tmp_path / f"{number}.png")[..., :3].astype(int) for number in range(2))
    land, sea = early[10:40, 20:140], early[80:110, 20:140]
    assert (land[..., 0] > land[..., 2] + 10).mean() > 0.9
    assert (sea[..., 2] > sea[..., 0] + 10).mean() > 0.8
    assert (np.abs(early - late).max(-1) > 8)[50:].mean() > 0.05
    assert np.abs(early - late)[:40].max() <= 2
