"""The export for Unreal: sizes, exact words, sea level, scales, oblong levels, measured error (T10)."""

import numpy as np
import pytest
from exports import GROUND, read_manifest, rough_level
from shorewright.io.export import check, export, maps, unreal
from shorewright.io.export.unreal_weights import NAMES
from shorewright.io.images import read_image
from shorewright.level import BadInput, Grid, Level, Rect

PUBLISHED_SIZES = (127, 253, 505, 1009, 2017, 4033, 8129)


def unreal_cm(folder):
    """Height in centimetres as Unreal's importer makes it, north row first: written down here once more, by hand."""
    manifest = read_manifest(folder)
    (path,) = folder.glob("*.r16")
    words = np.frombuffer(path.read_bytes(), "<u2")
    side = round(len(words) ** 0.5)
    assert side * side == len(words)
    return (words.reshape(side, side).astype(float) - 32768) / 128 * manifest["engine"]["scale_z"]


# Sizes


@pytest.mark.parametrize("size", PUBLISHED_SIZES)
def test_landscape_size_is_the_smallest_that_holds_the_samples(size):
    assert unreal.landscape_size(size - 1).samples == size
    assert unreal.landscape_size(size).samples == size
    after = PUBLISHED_SIZES.index(size) + 1
    if after < len(PUBLISHED_SIZES):
        assert unreal.landscape_size(size + 1).samples == PUBLISHED_SIZES[after]
    else:
        with pytest.raises(BadInput, match=r"8130 samples.*8129"):
            unreal.landscape_size(size + 1)


@pytest.mark.parametrize("size", unreal.SIZES, ids=lambda size: str(size.samples))
def test_landscape_sizes_follow_epics_formula(size):
    assert size.samples == size.components * size.sections * size.quads + 1
    assert size.quads in (7, 15, 31, 63, 127, 255)
    assert size.sections in (1, 2)
    assert size.components**2 <= 1024


@pytest.mark.parametrize(
    ("samples", "size"), [(2, 127), (126, 127), (127, 127), (128, 253), (253, 253), (254, 505), (505, 505), (506, 1009)]
)
def test_unreal_decodes_to_the_ground(tmp_path, samples, size):
    """The words, decoded by the published formula, are the level's own samples, on any size."""
    level = rough_level(samples, cell_m=2.5)
    export(level, "unreal", tmp_path / "out", GROUND, name="coast")
    manifest, cm = read_manifest(tmp_path / "out"), unreal_cm(tmp_path / "out")
    assert cm.shape == (size, size)
    assert manifest["engine"]["scale_x"] == manifest["engine"]["scale_y"] == pytest.approx(250)
    assert manifest["engine"]["sample_spacing_m"] == 2.5
    at = np.minimum(np.arange(size), samples - 1)
    off = np.abs(cm - 100 * level.height[::-1].astype(float)[np.ix_(at, at)]).max()
    record, _ = manifest["files"]
    step = manifest["engine"]["scale_z"] / 128
    assert record["step"] == pytest.approx(step, rel=1e-12)
    assert record["max_error"] == pytest.approx(off, abs=1e-6)
    assert 0 < off <= step / 2 + 1e-6


def test_level_of_a_landscapes_size_fills_it(tmp_path):
    level = rough_level(127)
    export(level, "unreal", tmp_path / "out", "height")
    off = np.abs(unreal_cm(tmp_path / "out") - 100 * level.height[::-1].astype(float)).max()
    manifest = read_manifest(tmp_path / "out")
    assert off <= manifest["engine"]["scale_z"] / 256 + 1e-6
    assert manifest["notes"] == []


# Exact words


def test_known_heights_become_known_words(tmp_path):
    """ScaleZ 100 spans -256 … 255.992 m; every corner has its own word, the north-west one comes first."""
    height = np.zeros((127, 127), np.float32)
    height[0, 0], height[0, -1] = -256.0, -128.0  # south-west, south-east
    height[-1, 0], height[-1, -1] = 128.0, 256 - 1 / 128  # north-west, north-east
    export(Level(Grid(127, 127), height), "unreal", tmp_path / "out", "height", name="corners")
    data = (tmp_path / "out" / "corners_height.r16").read_bytes()
    words = np.frombuffer(data, "<u2").reshape(127, 127)
    assert read_manifest(tmp_path / "out")["engine"]["scale_z"] == 100.0
    assert data[:2] == bytes([0x00, 0xC0])  # 49152 = 128 m, little-endian
    assert [int(words[r, c]) for r, c in ((0, 0), (0, -1), (-1, 0), (-1, -1))] == [49152, 65535, 0, 16384]
    assert (words[1:-1] == 32768).all()


@pytest.mark.parametrize("sea_m", [0.0, 3.7, -41.25])
def test_sea_level_lands_on_32768(tmp_path, sea_m):
    level = rough_level(60, low=sea_m - 20, high=sea_m + 9, sea_m=sea_m)
    level.write("height", Rect(10, 20, 30, 50), sea_m)
    export(level, "unreal", tmp_path / "out", "height")
    words = np.fromfile(next((tmp_path / "out").glob("*.r16")), "<u2").reshape(127, 127)
    assert (words[:60, :60][::-1][10:30, 20:50] == 32768).all()
    assert read_manifest(tmp_path / "out")["world"]["sea_level_m"] == sea_m


@pytest.mark.parametrize(
    ("low", "high"), [(-30, 55), (-55, 30), (2, 7), (-900, -20), (-1437, 2205), (-0.004, 0.001), (-256, 256 - 1 / 128)]
)
def test_scale_z_is_the_smallest_that_holds_the_level(tmp_path, low, high):
    wanted = 100 * max(abs(low) / 256 if low < 0 else 0, high / (256 - 1 / 128))
    scale = unreal.smallest_scale_z(low, high)
    assert wanted - 1e-9 <= scale <= wanted + 1e-6
    export(rough_level(127, low=low, high=high), "unreal", tmp_path / "out", "height")
    assert read_manifest(tmp_path / "out")["engine"]["scale_z"] == pytest.approx(scale, abs=1e-5)  # float32 heights
    words = np.fromfile(next((tmp_path / "out").glob("*.r16")), "<u2").astype(int)
    unused = words.min() if -low / 256 > high / (256 - 1 / 128) else 65535 - words.max()
    assert unused <= 1 + 32768 * 1e-6 / scale  # so a smaller scale would clip


def test_flat_level_at_sea_level_gets_the_engines_scale(tmp_path):
    export(Level(Grid(9, 9), np.zeros((9, 9), np.float32)), "unreal", tmp_path / "out", "height")
    assert read_manifest(tmp_path / "out")["engine"]["scale_z"] == 100.0
    assert (unreal_cm(tmp_path / "out") == 0).all()
    assert check(tmp_path / "out") == []


@pytest.mark.parametrize(("rows", "cols"), [(127, 64), (64, 127), (100, 30), (30, 100)])
def test_oblong_level_keeps_square_cells_and_its_edge_goes_on(tmp_path, rows, cols):
    level = rough_level(rows, cols, cell_m=3.0)
    export(level, "unreal", tmp_path / "out", "height")
    manifest, cm = read_manifest(tmp_path / "out"), unreal_cm(tmp_path / "out")
    engine, part = manifest["engine"], manifest["engine"]["level_part"]
    assert engine["scale_x"] == engine["scale_y"] == pytest.approx(300)
    at = np.arange(127)
    wanted = 100 * level.height[::-1].astype(float)[np.ix_(np.minimum(at, rows - 1), np.minimum(at, cols - 1))]
    assert np.abs(cm - wanted).max() <= engine["scale_z"] / 256 + 1e-6
    assert (part["east_cm"], part["south_cm"]) == (300.0 * (cols - 1), 300.0 * (rows - 1))
    assert (part["cols"], part["rows"]) == (cols, rows)
    beyond = cm[part["rows"] :] if rows < cols else cm[:, part["cols"] :].T
    assert len(beyond) > 20
    assert (beyond == beyond[0]).all()
    assert any("north-west" in note for note in manifest["notes"])


def test_recipe_types_the_values_that_decode(tmp_path):
    """What a person types into the dialog is what the words were made with, to the last digit of ScaleZ."""
    export(rough_level(100, 80), "unreal", tmp_path / "out", "height", name="bay")
    manifest = read_manifest(tmp_path / "out")
    engine, recipe = manifest["engine"], " | ".join(manifest["import_recipe"])
    assert f"Scale: X {engine['scale_x']:.6f} Y {engine['scale_y']:.6f} Z {engine['scale_z']:.6f}" in recipe
    assert float(f"{engine['scale_z']:.6f}") == engine["scale_z"]
    assert "bay_height.r16 (127 x 127)" in recipe
    assert engine["dialog_x_cm"] == pytest.approx(100 * 126 / 2)  # half of the square: the dialog wants the centre


def test_words_leaving_sixteen_bits_are_an_error():
    with pytest.raises(ValueError, match="leave the 16-bit range"):
        maps.quantise(np.array([0.0, 70000.0]), 0.0, 1.0)


# Weight maps


@pytest.mark.parametrize("resample", [False, True])
def test_weight_maps_lie_over_the_landscape(tmp_path, resample):
    """As large as the height map, north first, the edge going on beyond the level; all eight sum to 255 everywhere."""
    level = rough_level(90, 120, low=5, high=20)
    level.write("cover", Rect(60, 0, 90, 30), np.array([0, 0, 1, 0], np.float32))  # grass in the north-west
    export(level, "unreal", tmp_path, only=["height", "cover_weights_2", *NAMES], name="bay", resample=resample)
    assert check(tmp_path) == []
    pictures = [read_image(tmp_path / f"bay_{name}.png")[..., 0] for name in NAMES]
    assert all(picture.shape == (127, 127) and picture.dtype == np.uint8 for picture in pictures)
    assert (np.sum(pictures, axis=0, dtype=int) == 255).all()
    grass = pictures[NAMES.index("weight_grass")].astype(int) + pictures[NAMES.index("weight_dune_grass")]
    assert grass[3:24, 3:24].min() > 185  # where both kinds meet a quarter is neither
    own = read_image(tmp_path / "bay_cover_weights_2.png")[..., 0]
    if not resample:
        assert np.array_equal(pictures[NAMES.index("weight_grass")][:90, :120], own)
        assert np.array_equal(pictures[0][90:], np.repeat(pictures[0][89:90], 37, 0))


def test_tiled_landscapes_have_no_weight_maps(tmp_path):
    export(rough_level(150), "unreal", tmp_path, only=["height", *NAMES], name="bay", tile=127)
    assert set(NAMES) <= set(read_manifest(tmp_path)["empty"])
    assert check(tmp_path) == []
