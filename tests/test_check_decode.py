"""`check` on exports that were made to fit: every hash is right, and only decoding tells what is wrong (T10)."""

import numpy as np
import pytest
from exports import one, sign, slope_level
from shorewright.io.export import check, export, meshes
from shorewright.io.images import write_image
from shorewright.level import Rect


@pytest.fixture
def unreal(tmp_path):
    export(slope_level(), "unreal", tmp_path / "out", name="bay")
    return tmp_path / "out"


@pytest.fixture
def raw(tmp_path):
    export(slope_level(), "raw", tmp_path / "out", name="bay")
    return tmp_path / "out"


@pytest.mark.parametrize(
    "name", ["../secret.r16", "/etc/passwd", "sub/x.r16", "..\\secret.r16", "C:secret.r16", "..", ""]
)
def test_names_stay_inside_the_folder(unreal, name):
    """Not even opened: the file outside has the hash the manifest states, and it is still refused."""
    (unreal.parent / "secret.r16").write_bytes((unreal / "bay_height.r16").read_bytes())
    sign(unreal, lambda data: data["files"][0].update(name=name))
    assert any("outside the folder" in finding for finding in check(unreal))


def test_link_that_leads_out_is_found(unreal):
    (unreal / "bay_height.r16").rename(unreal.parent / "elsewhere.r16")
    (unreal / "bay_height.r16").symlink_to(unreal.parent / "elsewhere.r16")
    one(check(unreal), "link")


@pytest.mark.parametrize(
    "edit",
    [
        lambda d: d["engine"].update(scale_z=d["engine"]["scale_z"] * 1.01),
        lambda d: d["engine"].update(scale_x=101.0),
        lambda d: d["engine"].update(scale_y=d["engine"]["scale_y"] * 1.001),
        lambda d: d["engine"].update(resolution=253),
        lambda d: d["engine"].update(actor_z_cm=50.0),
        lambda d: d["engine"].update(sea_level_v=0),
        lambda d: d["engine"]["level_part"].update(rows=127),
        lambda d: d.update(engine=None),
        lambda d: d["world"].update(sea_level_m=1.0),
        lambda d: d["world"].update(height_max_m=d["world"]["height_max_m"] - 1),
        lambda d: d["source"].update(cols=400),
        lambda d: d["source"].update(cols=9000),
        lambda d: d["source"].update(cell_m=2.0),
        lambda d: d["files"][0].update(width=126),
        lambda d: d["files"][0].update(width=128, height=126),
        lambda d: d["files"][0]["decode"]["numbers"].update(ScaleZ=100.0),
        lambda d: d["files"][0]["decode"].update(formula="z_cm = v"),
        lambda d: d["files"][0].update(step=1.0),
        lambda d: d["files"][0].update(max_error=5.0),
        lambda d: d["files"][0].update(max_error=0.0),
        lambda d: d["probes"][7].update(height_m=d["probes"][7]["height_m"] + 0.01),
        lambda d: d["probes"][7].update(col=5000),
        lambda d: d.update(probes=[]),
        lambda d: d.update(files=[]),
        lambda d: d.update(target="quake"),
        lambda d: d.update(extra=1),
        lambda d: d["files"][0].update(width="wide"),
    ],
)
def test_wrong_statements_are_found_though_every_hash_fits(unreal, edit):
    """A manifest that was made to fit: sizes, scales and errors are worked out again, heights decoded."""
    assert check(unreal) == []
    sign(unreal, edit)
    findings = check(unreal)
    assert findings
    assert not any("edited" in finding or "sha256" in finding for finding in findings)


def test_wrong_words_are_found_though_every_hash_fits(unreal):
    """The whole map one row too far north, then one value too high everywhere, as faulty exporters do it."""
    path = unreal / "bay_height.r16"
    words = np.fromfile(path, "<u2").reshape(127, 127)
    for wrong in (np.roll(words, -1, axis=0), words[::-1], words.T, words + 1, words.byteswap(), words >> 8):
        path.write_bytes(np.ascontiguousarray(wrong, "<u2").tobytes())
        sign(unreal, lambda data: None)
        assert any("bay_height.r16" in finding for finding in check(unreal))


# Raw files that were made to fit


def test_wrong_float_map_is_found(raw):
    write_image(raw / "bay_height.exr", np.ascontiguousarray(slope_level().height)[..., None])  # south first
    sign(raw, lambda data: None)
    assert any("bay_height.exr" in finding for finding in check(raw))


def test_single_wrong_word_is_found_against_the_float_map(raw):
    words = np.fromfile(raw / "bay_height.r16", "<u2")
    words[41 * 3 + 5] += 40  # no probe stands there
    words.tofile(raw / "bay_height.r16")
    sign(raw, lambda data: None)
    one(check(raw), "bay_height.r16")


@pytest.mark.parametrize("fault", ["mirrored", "dented", "upside down", "no normals", "no mesh"])
def test_wrong_mesh_is_found(raw, fault):
    import trimesh

    mesh = meshes.terrain_mesh(slope_level().height, 1.0)
    if fault == "mirrored":
        mesh.positions[:, 2] *= -1
    if fault == "dented":
        mesh.positions[77, 1] -= 0.5
    if fault == "upside down":
        mesh.normals[:] *= -1
    path = raw / "bay_terrain.glb"
    if fault == "no normals":
        ground = trimesh.Trimesh(mesh.positions, mesh.faces, process=False)
        path.write_bytes(ground.export(file_type="glb", include_normals=False))
    elif fault == "no mesh":
        path.write_bytes(b"glTF" + bytes(60))
    else:
        meshes.write_glb(path, mesh, "bay")
    sign(raw, lambda data: None)
    one(check(raw), "bay_terrain.glb")


def test_wrong_vti_is_found(raw):
    level = slope_level()
    level.write("height", Rect(0, 0, 2, 2), 3.0)
    meshes.write_vti(raw / "bay.vti", level)
    sign(raw, lambda data: None)
    assert any("bay.vti" in finding for finding in check(raw))
    (raw / "bay.vti").write_text("<VTKFile", "utf-8")
    sign(raw, lambda data: None)
    assert any("bay.vti" in finding for finding in check(raw))
