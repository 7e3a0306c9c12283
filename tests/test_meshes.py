"""Meshes of props (D12): read from files, kept in a level's folder, refused in one sentence when they are bad."""

import logging

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shorewright.app.session import Session
from shorewright.io import LevelFolder, check, import_mesh, read_level, write_level
from shorewright.io.mesh_files import packed, unpacked
from shorewright.level import BadInput, Grid, Level
from shorewright.level import meshes as level_meshes
from shorewright.level.meshes import GREY, Mesh, block, content_name, decode_srgb, encode_srgb, made_of
from shorewright.level.objects import Prop

WEDGE = np.array([(0, 0, 0), (2, 0, 0), (2, 4, 0), (0, 4, 0), (1, 0, 1), (1, 4, 0.5)], float)  # metres, z up
FACES = np.array([(0, 2, 1), (0, 3, 2), (0, 1, 4), (2, 3, 5), (1, 2, 5), (1, 5, 4), (3, 0, 4), (3, 4, 5)])
RED = (0.6, 0.1, 0.05)


def trimesh_wedge(up="z"):
    import trimesh

    vertices = WEDGE if up == "z" else WEDGE[:, [0, 2, 1]] * (-1, 1, 1)  # what turning z up undoes
    return trimesh.Trimesh(vertices, FACES, process=False)


def points(mesh):
    """Corners of all triangles, sorted: what a mesh looks like, whatever its order."""
    corners = mesh.vertices[mesh.triangles].reshape(-1, 3).round(5)
    return corners[np.lexsort(corners.T)]


@pytest.mark.parametrize("kind", ["glb", "gltf", "obj", "ply", "stl"])
def test_every_format_gives_the_same_mesh(tmp_path, kind):
    """D12: y-up formats are turned so that z is up and +z of the file looks north."""
    up = "z" if kind in ("ply", "stl") else "y"
    path = tmp_path / f"a wedge.{kind}"
    wedge = trimesh_wedge(up)
    wedge.visual.vertex_colors = np.uint8([*(255 * np.array(RED)), 255])
    data = wedge.export(file_type=kind) if kind != "gltf" else None
    if kind == "gltf":
        for name, part in wedge.export(file_type="gltf").items():
            (path if name == "model.gltf" else tmp_path / name).write_bytes(part)
    else:
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
    found = import_mesh(path)
    np.testing.assert_allclose(points(found.mesh), points(made_of(WEDGE[FACES])), atol=1e-4)
    assert found.mesh.closed
    assert found.name.startswith("a_wedge_")
    assert found.notes == []
    assert found.mesh.normals.shape == found.mesh.colours.shape == found.mesh.vertices.shape
    expected = [GREY] * 3 if kind == "stl" else np.array(RED) if kind in ("glb", "gltf") else decode_srgb(np.array(RED))
    assert np.abs(found.mesh.colours - expected).max() < 0.01
    other = import_mesh(path, up="y" if up == "z" else "z")
    assert not np.allclose(other.mesh.box, found.mesh.box)
    assert np.allclose(import_mesh(path, scale=2.0).mesh.box, 2 * found.mesh.box, atol=1e-5)


def test_a_scene_is_merged_in_place(tmp_path):
    """Every part comes with its transform, a mirrored one with its outside out."""
    import trimesh

    scene, shift = trimesh.Scene(), np.eye(4)
    scene.add_geometry(trimesh_wedge("y"))
    shift[:3, 3], shift[0, 0] = (0, 5, 0), -1
    scene.add_geometry(trimesh_wedge("y"), transform=shift)
    path = tmp_path / "two.glb"
    path.write_bytes(scene.export(file_type="glb"))
    mesh = import_mesh(path).mesh
    np.testing.assert_allclose(mesh.box, [[-2, 0, 0], [2, 4, 6]], atol=1e-5)
    assert len(mesh.triangles) == 2 * len(FACES)
    corners = mesh.vertices[mesh.triangles].astype(float)
    for part in (corners[corners[:, :, 2].max(axis=1) < 4], corners[corners[:, :, 2].min(axis=1) > 4]):
        middle = part.reshape(-1, 3).mean(axis=0)
        assert np.einsum("ij,ij->", part[:, 0] - middle, np.cross(part[:, 1] - middle, part[:, 2] - middle)) > 0


def textured(path, texture="paint.png"):
    path.write_text(
        "mtllib look.mtl\nusemtl paint\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.1 0.9\nvt 0.9 0.9\nvt 0.1 0.1\nf 1/1 2/2 3/3\n"
    )
    (path.parent / "look.mtl").write_text(f"newmtl paint\nKd 0.5 0.5 0.5\nmap_Kd {texture}\n")


def test_textures_colour_the_vertices_and_missing_ones_are_told(tmp_path):
    """A texture is read at each vertex; without its file, or without the material's, the mesh comes all the same."""
    from PIL import Image

    path = tmp_path / "sail.obj"
    textured(path)
    quarters = np.zeros((8, 8, 3), np.uint8)
    quarters[:4, :4], quarters[:4, 4:], quarters[4:, :4] = (255, 0, 0), (0, 255, 0), (0, 0, 255)
    Image.fromarray(quarters).save(tmp_path / "paint.png")
    found = import_mesh(path)
    assert found.notes == []
    assert {tuple(colour) for colour in found.mesh.colours} == {(1, 0, 0), (0, 1, 0), (0, 0, 1)}
    (tmp_path / "paint.png").unlink()
    assert "paint.png" in import_mesh(path).notes[0]
    (tmp_path / "look.mtl").unlink()
    found = import_mesh(path)
    assert "look.mtl" in found.notes[0]
    assert np.ptp(found.mesh.colours) < 1e-6


def bad_files(folder):
    """Files that hold no mesh: what is wrong, name, bytes."""
    glb = trimesh_wedge("y").export(file_type="glb")
    ply = trimesh_wedge().export(file_type="ply")
    header = b"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nelement face 0\nend_header\n"
    rows = {
        "cut.glb": glb[: len(glb) // 2],
        "head.glb": glb[:20],
        "zeros.glb": glb[:12] + bytes(200),
        "prose.obj": b"It was a dark and stormy night.\nThe sea ran high.\n",
        "nan.obj": b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "huge.obj": b"v 1e30 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "line.obj": b"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n",
        "far.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",
        "empty.ply": b"",
        "none.ply": header,
        "cut.ply": ply[: len(ply) - 30],
        "words.stl": b"no mesh at all",
        "empty.gltf": b"{}",
        "broken.gltf": b'{"asset": {"version": "2.0"}, "buffers": [{"uri": "gone.bin", "byteLength": 4}]}',
        "boat.fbx": glb,
    }
    for name, data in rows.items():
        (folder / name).write_bytes(data)
    return [*rows, "missing.glb", "."]


def test_bad_files_get_one_sentence(tmp_path, caplog):
    """D12: never a traceback, never a log line, the file's name in it."""
    caplog.set_level(logging.WARNING)
    for name in bad_files(tmp_path):
        with pytest.raises(BadInput) as told:
            import_mesh(tmp_path / name)
        text = str(told.value)
        assert str(tmp_path) in text, text
        assert "\n" not in text
        assert 20 < len(text) < 400, text
    assert not caplog.records


def test_too_many_triangles_are_refused(tmp_path, monkeypatch):
    from shorewright.io import meshes

    monkeypatch.setattr(meshes, "MOST_TRIANGLES", 5)
    monkeypatch.setattr(level_meshes, "MOST_TRIANGLES", 5)
    path = tmp_path / "a.ply"
    path.write_bytes(trimesh_wedge().export(file_type="ply"))
    with pytest.raises(BadInput, match="8 triangles, a prop takes 5 at most"):
        import_mesh(path)
    with pytest.raises(BadInput, match="5 at most"):
        made_of(WEDGE[FACES])


def test_hard_edges_stay_and_round_ones_are_smooth():
    """A block's corner has three normals; on a fine ball the normal is the way from its middle."""
    cube = block()
    assert len(cube.vertices) == 24
    assert (np.abs(cube.normals).max(axis=1) > 0.999).all()
    from shorewright.level.scatter_shapes import icosphere

    vertices, triangles = icosphere(3)
    ball = made_of(vertices[triangles])
    assert len(ball.vertices) == len(vertices)
    assert (ball.normals * ball.vertices).sum(axis=1).min() > 0.999
    inside_out = made_of(vertices[triangles[:, ::-1]])
    assert (inside_out.normals * inside_out.vertices).sum(axis=1).min() > 0.999
    assert not made_of(vertices[triangles[:-1]]).closed


def test_colours_survive_their_bytes():
    """Linear to bytes and back is the identity on what bytes hold, and close elsewhere."""
    linear = decode_srgb(np.arange(256) / 255)
    assert (np.rint(255 * encode_srgb(linear)) == np.arange(256)).all()


@given(st.integers(0, 2**32), st.integers(1, 60))
def test_a_file_is_the_mesh(seed, count):
    """Bytes and back are the identity, and the same mesh has the same name."""
    rng = np.random.default_rng(seed)
    mesh = made_of(rng.normal(size=(count, 3, 3)), rng.uniform(size=(count, 3, 3)))
    again = unpacked(packed(mesh))
    for name in ("vertices", "normals", "colours", "triangles"):
        assert np.array_equal(getattr(mesh, name), getattr(again, name))
    assert content_name("x", again) == content_name("x", mesh)
    assert not again.vertices.flags.writeable


# In a level's folder


def level_with(mesh, name="wedge"):
    level = Level(Grid(33, 33), np.zeros((33, 33), np.float32))
    name = content_name(name, mesh)
    level.put_mesh(name, mesh)
    level.put_object("boat", Prop(id="boat", mesh=name, x=10, y=12, floats=True))
    return level, name


def test_save_and_load_is_the_identity(tmp_path):
    """D12: meshes lie in the folder, are written once, and go when no prop names them."""
    path = tmp_path / "a.shore"
    level, name = level_with(made_of(WEDGE[FACES]))
    level.put_mesh("unused_00000000", block())
    assert f"meshes/{name}.ply" in write_level(level, path)
    assert [file.name for file in (path / "meshes").iterdir()] == [f"{name}.ply"]
    assert write_level(level, path) == []
    notes = []
    loaded = read_level(path, notes)
    assert notes == []
    assert check(path) == []
    assert loaded.objects == level.objects
    assert packed(loaded.meshes[name]) == packed(level.meshes[name])
    assert write_level(loaded, path) == []
    loaded.put_object("boat", None)
    write_level(loaded, path)
    assert not (path / "meshes").exists()
    loaded.put_object("boat", level.objects["boat"])  # as undo does
    write_level(loaded, path)
    assert packed(read_level(path).meshes[name]) == packed(level.meshes[name])


def flipped(data):
    middle = len(data) - 40
    return data[:middle] + bytes([data[middle] ^ 1]) + data[middle + 1 :]


@pytest.mark.parametrize(
    ("spoil", "told"),
    [
        (lambda data: None, "missing"),
        (lambda data: b"", "no mesh that Shorewright wrote"),
        (lambda data: data[:-1], "cut short"),
        (lambda data: data.replace(b"element face 8", b"element face 9"), "cut short"),
        (lambda data: data.replace(b"element vertex", b"element  vertex"), "no mesh"),
        (lambda data: data[:-4] + b"\xff\xff\xff\x7f", "vertices that it does not have"),
        (lambda data: data.replace(np.float32(4).tobytes(), np.float32(np.nan).tobytes()), "no finite numbers"),
    ],
)
def test_a_bad_mesh_is_told_and_the_level_opens(tmp_path, spoil, told):
    """D12: a box stands in; saving keeps what is there and does not lose the prop."""
    path = tmp_path / "a.shore"
    level, name = level_with(made_of(WEDGE[FACES]))
    write_level(level, path)
    file = path / "meshes" / f"{name}.ply"
    data = spoil(file.read_bytes())
    file.unlink() if data is None else file.write_bytes(data)
    notes = []
    loaded = read_level(path, notes)
    assert len(notes) == 1
    assert told in notes[0]
    assert "box stands in" in notes[0]
    assert loaded.meshes == {}
    assert level_meshes.mesh_of(loaded, loaded.objects["boat"]) is level_meshes.STAND_IN
    assert len(check(path)) == 1
    write_level(loaded, path)
    assert file.exists() is (data is not None)
    loaded.put_mesh(name, level.meshes[name])  # brought in again
    write_level(loaded, path)
    assert check(path) == []


def test_a_changed_mesh_is_used_and_told(tmp_path):
    path = tmp_path / "a.shore"
    level, name = level_with(block())
    write_level(level, path)
    file = path / "meshes" / f"{name}.ply"
    data = file.read_bytes()
    at = data.index(b"end_header\n") + 11 + 24  # the first vertex' red
    file.write_bytes(data[:at] + bytes([data[at] ^ 64]) + data[at + 1 :])
    notes = []
    assert name in read_level(path, notes).meshes
    assert "changed since it was saved" in notes[0]
    assert "hash differs" in check(path)[0]


def test_a_save_with_meshes_killed_at_every_step(tmp_path):
    """T08 with meshes: the level is then the old or the new one."""
    from level_saves import Killed

    def attempt(path, at):
        level, name = level_with(made_of(WEDGE[FACES]))
        write_level(level, path)
        other = content_name("other", block())
        level.put_mesh(other, block())
        level.put_object("boat", Prop(id="boat", mesh=other))
        left = [at]

        def kill(step):
            left[0] -= 1
            if left[0] < 0:
                raise Killed(step)

        folder = LevelFolder(path, kill)
        try:
            folder.save(level)
        except Killed:
            folder._lock.release()
        else:
            folder.close()
        return name, other, left[0] >= 0

    for at in range(40):
        path = tmp_path / f"{at}.shore"
        old, new, whole = attempt(path, at)
        found = read_level(path)
        shown = found.objects["boat"].mesh
        assert shown in (old, new)
        assert shown in found.meshes
        with LevelFolder(path) as folder:
            assert folder.open().objects["boat"].mesh == shown
        assert check(path) == []
        if whole:
            assert [file.stem for file in (path / "meshes").iterdir()] == [new]
            return
    pytest.fail("a save has more steps than this test thought")


def test_names_that_lead_out_are_refused():
    for name in ("../x", "a/b", "a.b", "é", "x" * 81):
        with pytest.raises(ValueError, match="mesh"):
            Prop(id="p", mesh=name)


# In a session


def test_session_script_undo_and_recovery(tmp_path):
    """T08: placing is a step, its mesh comes back with undo, with the script, and out of the recovery log."""
    from shorewright.app.recovery_offer import offers

    path = tmp_path / "wedge.ply"
    path.write_bytes(trimesh_wedge().export(file_type="ply"))
    session = Session.new(Grid(65, 65))
    session.keep_log(tmp_path / "logs")
    name = session.import_mesh(path)
    thing = session.place_prop(name, 20, 60, floats=False, scale=2.0)
    ground = session.level.height[60, 20]
    assert session.level.objects[thing].z == pytest.approx(float(ground), abs=1e-3)
    assert session.undo()
    assert thing not in session.level.objects
    assert session.redo()
    assert isinstance(session.level.meshes[session.level.objects[thing].mesh], Mesh)
    again = Session.new(Grid(65, 65))
    again.run(session.script)
    assert again.level.objects == session.level.objects
    assert packed(again.level.meshes[name]) == packed(session.level.meshes[name])
    session.recovery.settle()
    session.recovery._lock.release()  # as a dead process does
    offer = offers(tmp_path / "logs")[0]
    recovered = Session.recover(offer)
    assert recovered.level.objects[thing] == session.level.objects[thing]
    assert packed(recovered.level.meshes[name]) == packed(session.level.meshes[name])
    for one in (recovered, again):
        one.close()
