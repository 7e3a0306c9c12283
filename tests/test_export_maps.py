"""Maps of MAPS in files (T09): coded, decoded, checked; parametrised over the rows, so that a new one is tested too."""

import json

import numpy as np
import pytest
from exports import MANIFEST, one, painted_level, sign
from shorewright.io import check, export
from shorewright.io.export.codes import CODES, decoded, encoded
from shorewright.io.export.map_rows import MAPS
from shorewright.io.export.mesh_rows import MESHES
from shorewright.io.images import read_image


@pytest.fixture(scope="module")
def painted():
    return painted_level()


@pytest.fixture(scope="module", params=["raw", "unreal", "unity", "godot"])
def written(request, painted, tmp_path_factory):
    folder = tmp_path_factory.mktemp(request.param) / "out"
    export(painted, request.param, folder, only=list(MAPS), name="bay")
    return folder, {f["map"]: f for f in json.loads((folder / MANIFEST).read_text("utf-8"))["files"]}


@pytest.mark.parametrize("name", MAPS)
def test_every_map_decodes_to_the_level(painted, written, name):
    """T09: decoded with the record's own numbers, north first, no farther off than half a step."""
    folder, files = written
    row = MAPS[name]
    samples = row.make(painted)
    assert samples is not None
    record = files[name]
    code = "float" if record["bit_depth"] == 32 else row.code
    low, high = ([c[end] or 0 for c in record["channels"]] for end in ("low", "high"))
    truth = np.asarray(samples.values)[::-1].astype(float)
    values = read_image(folder / record["name"])[..., : truth.shape[-1]]
    found = decoded(values, code, low, high, record["bit_depth"])
    target = folder.parent.name.rstrip("0123456789")
    turned = {"unreal": (row.north, row.green), "godot": (row.north,)}.get(target, ())
    for channel in turned:
        if channel is not None:
            truth[..., channel] *= -1
    off = np.abs(found - truth).max(axis=(0, 1))
    assert off == pytest.approx([c["max_error"] for c in record["channels"]], abs=1e-6)
    if record["bit_depth"] < 32:
        steps = CODES[code].step(np.array(low), np.array(high), 2 ** record["bit_depth"] - 1)
        assert (off <= steps / 2 + 1e-6 * np.maximum(np.abs(high), 1)).all()


def test_untouched_maps_are_fine(written):
    folder, files = written
    assert set(files) == set(MAPS)
    assert check(folder) == []


def test_same_level_same_bytes(painted, written, tmp_path):
    folder, _ = written
    target = folder.parent.name.rstrip("0123456789")
    export(painted, target, tmp_path / "again", only=list(MAPS), name="bay")
    for path in folder.iterdir():
        assert (tmp_path / "again" / path.name).read_bytes() == path.read_bytes(), path.name


def test_a_map_that_is_turned_is_found(painted, tmp_path):
    """A picture of the right size, flipped, with all hashes made to fit."""
    from shorewright.io.images import write_image

    export(painted, "raw", tmp_path / "out", only="foam", name="bay")
    path = tmp_path / "out" / "bay_foam.png"
    write_image(path, np.ascontiguousarray(read_image(path)[::-1]), data=True)
    sign(tmp_path / "out", lambda data: None)
    one(check(tmp_path / "out"), "bay_foam.png")


@pytest.mark.parametrize("edit", [{"max_error": 0.5}, {"step": 1.0}, {"width": 5}], ids=str)
def test_false_statements_are_found(painted, tmp_path, edit):
    export(painted, "raw", tmp_path / "out", only="snow", name="bay")
    sign(tmp_path / "out", lambda data: data["files"][0].update(edit))
    assert check(tmp_path / "out")


@pytest.mark.parametrize("bits", [8, 16])
@pytest.mark.parametrize("code", ["signed", "unsigned"])
def test_codes_keep_their_ends_and_zero(code, bits):
    low, high = (-3.0, 3.0) if code == "signed" else (0.0, 3.0)
    values = np.array([low, 0.0, high])
    found = decoded(encoded(values, code, low, high, bits), code, low, high, bits)
    assert found == pytest.approx(values, abs=1e-12)
    assert CODES[code].step(low, high, 2**bits - 1) > 0


def test_maps_and_meshes_have_names_of_their_own():
    assert not set(MAPS) & set(MESHES)
