"""Exports for Unity and Godot, tiles and resampling for all (T09): decoded here once more by each engine's formula."""

import numpy as np
import pytest
from exports import GROUND, MANIFEST, one, read_manifest, rough_level, sign, slope_level, snapshot
from shorewright.io import check, export
from shorewright.io.export import EXPORTERS, godot, layout, unity
from shorewright.io.export.records import Options
from shorewright.io.images import read_image, write_image
from shorewright.level import BadInput, Grid, Level

ENGINES = ("unreal", "unity", "godot", "godot-hterrain")
TILES = {"unreal": 127, "unity": 33}


def words(path):
    values = np.fromfile(path, "<u2")
    side = round(len(values) ** 0.5)
    return values.reshape(side, -1).astype(float)


def ground_m(folder, path, target):
    """Metres over the level's zero, south row first: the engines' formulas, written down by hand."""
    manifest = read_manifest(folder)
    engine, sea = manifest["engine"], manifest["world"]["sea_level_m"]
    if target == "unity":
        return words(path) / 65536 * engine["terrain_height_m"] + engine["position_y_m"] + sea
    if target == "unreal":
        return (words(path)[::-1] - 32768) / 128 * engine["scale_z"] / 100 + sea
    low, high = engine["min_m"], engine["max_m"]
    values = np.fromfile(path, "<u2").reshape(engine["rows"], engine["cols"])
    return (values / 65535 * (high - low) + low)[::-1] + sea


def height_file(folder):
    return next(p for p in sorted(folder.iterdir()) if p.suffix in (".raw", ".r16"))


@pytest.mark.parametrize("target", ENGINES)
@pytest.mark.parametrize("sea_m", [0.0, 3.7])
def test_words_decode_to_the_ground(tmp_path, target, sea_m):
    """T09: no farther off than half a step of the target's own, on an oblong level; its edge goes on beyond it."""
    level = slope_level(40, 57, 1.5, sea_m)
    export(level, target, tmp_path / "out", GROUND, name="bay")
    found = ground_m(tmp_path / "out", height_file(tmp_path / "out"), target)
    record = next(f for f in read_manifest(tmp_path / "out")["files"] if f["map"] == "height" and f["step"])
    rows, cols = np.minimum(np.arange(len(found)), 39), np.minimum(np.arange(found.shape[1]), 56)
    if target in ("unreal", "godot-hterrain"):  # the level in the north-west
        rows = np.maximum(np.arange(len(found)) - (len(found) - 40), 0)
    off = np.abs(found - level.height[np.ix_(rows, cols)]).max()
    assert 100 * off == pytest.approx(record["max_error"], abs=1e-5)
    assert 0 < record["max_error"] <= record["step"] / 2 + 1e-5
    assert record["resampling"] is None
    assert check(tmp_path / "out") == []


@pytest.mark.parametrize("target", EXPORTERS)
@pytest.mark.parametrize("turn", ["flip", "mirror", "transpose"])
def test_one_odd_sample_tells_a_turned_file(tmp_path, target, turn):
    """A plain with one peak, of a size that needs no edge: turned, with all hashes made to fit."""
    side = {"unreal": 127, "unity": 65, "godot-hterrain": 65}.get(target, 50)
    height = np.zeros((side, side), np.float32)
    height[20, 31] = 9.0
    export(Level(Grid(side, side), height), target, tmp_path / "out", "height", name="bay")
    path = height_file(tmp_path / "out")
    turned = {"flip": np.flipud, "mirror": np.fliplr, "transpose": np.transpose}[turn]
    np.ascontiguousarray(turned(np.fromfile(path, "<u2").reshape(side, side))).tofile(path)
    sign(tmp_path / "out", lambda data: None)
    found = check(tmp_path / "out")
    assert found
    assert all(path.name in finding for finding in found)


@pytest.mark.parametrize("target", EXPORTERS)
def test_corners_stand_where_the_engine_has_them(tmp_path, target):
    side = {"unreal": 127, "unity": 65, "godot-hterrain": 65}.get(target, 50)
    height = np.zeros((side, side), np.float32)
    height[0, 0], height[0, -1], height[-1, 0], height[-1, -1] = -8, -4, 2, 16  # SW, SE, NW, NE
    export(Level(Grid(side, side), height), target, tmp_path / "out", "height", name="bay")
    first_row = words(height_file(tmp_path / "out"))[0]
    order = np.argsort([first_row[0], first_row[-1]]).tolist()
    assert order == [0, 1]
    south = first_row[0] == 0  # the lowest of all is the south-west
    assert south == (target == "unity")


def test_an_odd_pixel_of_the_float_map_is_found(tmp_path):
    export(slope_level(), "godot", tmp_path / "out", "height", name="bay")
    path = tmp_path / "out" / "bay_height.exr"
    write_image(path, np.ascontiguousarray(read_image(path)[::-1]))
    sign(tmp_path / "out", lambda data: None)
    one(check(tmp_path / "out"), "bay_height.exr")


# Sizes, tiles, resampling


def test_sizes_are_those_the_engines_take():
    assert unity.SIDES == (33, 65, 129, 257, 513, 1025, 2049, 4097)
    assert godot.SIDES == (65, 129, 257, 513, 1025, 2049, 4097)
    assert [godot.region_size(n) for n in (2, 2048, 2049, 16384)] == [64, 64, 128, 512]


@pytest.mark.parametrize("target", TILES)
def test_tiles_share_edges_and_one_range(tmp_path, target):
    """T09: put together again they are the level; an edge that differs is found."""
    side, out = TILES[target], tmp_path / "out"
    level = slope_level(side + 12, 2 * side + 5, 2.0, 1.0)
    export(level, target, out, "height", name="bay", tile=side)
    manifest = read_manifest(out)
    assert (manifest["tiles"]["rows"], manifest["tiles"]["cols"]) == (2, 3)
    name = "bay_height_{}_{}.raw" if target == "unity" else "bay_height_x{}_y{}.r16"
    whole = np.full((2 * side - 1, 3 * side - 2), np.nan)
    for x in range(3):
        for y in range(2):
            south = y if target == "unity" else 1 - y
            down, along = south * (side - 1), x * (side - 1)
            place = np.s_[down : down + side, along : along + side]
            tile = ground_m(out, out / name.format(x, y), target)
            before = whole[place]
            shared = ~np.isnan(before)
            np.testing.assert_array_equal(before[shared], tile[shared])
            whole[place] = tile
    lies = whole[: side + 12] if target == "unity" else whole[-(side + 12) :]
    assert np.abs(lies[:, : 2 * side + 5] - level.height).max() <= manifest["files"][0]["step"] / 200 + 1e-6
    assert check(out) == []
    damaged = out / name.format(1, 0)
    values = np.fromfile(damaged, "<u2").reshape(side, side)
    values[3, 0] += 1
    values.tofile(damaged)
    sign(out, lambda data: None)
    one(check(out), "edge they share")


@pytest.mark.parametrize("turn", [np.flipud, np.fliplr, np.transpose])
def test_one_turned_tile_is_found(tmp_path, turn):
    export(rough_level(97, 97), "unity", tmp_path / "out", "height", name="bay", tile=33)
    path = tmp_path / "out" / "bay_height_1_1.raw"
    np.ascontiguousarray(turn(np.fromfile(path, "<u2").reshape(33, 33))).tofile(path)
    sign(tmp_path / "out", lambda data: None)
    assert any(path.name in finding and "off the level" in finding for finding in check(tmp_path / "out"))


@pytest.mark.parametrize("tile", [2, 34, 33])
def test_tiles_out_of_all_measure_are_a_sentence(tmp_path, tile):
    """From a doctored manifest too: what it asks for is never laid out."""
    if tile == 33:
        with pytest.raises(BadInput, match="too many"):
            export(
                Level(Grid(2050, 2050), np.zeros((2050, 2050), np.float32)), "unity", tmp_path / "a", GROUND, tile=33
            )
    export(rough_level(20), "unity", tmp_path / "out", "height", name="bay")
    sign(tmp_path / "out", lambda data: (data["options"].update(tile=tile), data["source"].update(rows=16385)))
    assert check(tmp_path / "out")


def test_a_level_past_the_largest_landscape_becomes_tiles(tmp_path):
    height = np.linspace(-5, 5, 2 * 8130, dtype=np.float32).reshape(2, 8130)
    export(Level(Grid(2, 8130), height), "unreal", tmp_path / "out", "height", name="strip")
    manifest = read_manifest(tmp_path / "out")
    assert manifest["tiles"] == {"rows": 1, "cols": 9, "shared_edge": True}
    assert manifest["engine"]["resolution"] == 1009
    assert check(tmp_path / "out") == []


def test_tiles_spend_little_beyond_the_level():
    assert layout.tile_side(5000, unity.SIDES) == 1025
    assert layout.tile_side(8193, unity.SIDES) == 4097
    for target in TILES:
        sizes = EXPORTERS[target].sizes
        for longer in (sizes[-1] + 1, 12000, 16385):
            made = layout.lay_out((longer, longer // 3), 1.0, sizes, Options(), True, True)
            assert made.side in sizes
            assert made.tile_rows * (made.side - 1) + 1 >= longer
            assert (made.tile_rows - 1) * (made.side - 1) + 1 < longer
            assert len(made.rows_at) <= 1.13 * longer


@pytest.mark.parametrize("target", ["unreal", "unity", "godot-hterrain"])
def test_resampling_is_told_apart_from_rounding(tmp_path, target):
    """T09: against the resampled ground half a step, against the level what the manifest states."""
    level = slope_level(50, 90)
    export(level, target, tmp_path / "out", GROUND, name="bay", resample=True)
    manifest = read_manifest(tmp_path / "out")
    record = next(f for f in manifest["files"] if f["map"] == "height")
    side = record["width"]
    found = ground_m(tmp_path / "out", height_file(tmp_path / "out"), target)
    found = found if target == "unity" else found[::-1]  # from the corner where the level lies
    ground = level.height if target == "unity" else level.height[::-1]
    at = np.minimum(np.linspace(0, 89, side), 49), np.linspace(0, 89, side)
    wanted = _bilinear(ground, *at)
    assert np.abs(found - wanted).max() <= record["step"] / 200 + 1e-5
    back = _bilinear(wanted, np.arange(50) * (side - 1) / 89, np.arange(90) * (side - 1) / 89)
    lost = record["resampling"]
    assert lost["max_error_cm"] == pytest.approx(100 * np.abs(back - ground).max(), rel=1e-4)
    assert 0 < lost["rms_error_cm"] < lost["max_error_cm"]
    assert any("Resampled" in note for note in manifest["notes"])
    assert check(tmp_path / "out") == []


def _bilinear(samples, rows, cols):
    from scipy.interpolate import RegularGridInterpolator

    at = np.stack(np.meshgrid(rows, cols, indexing="ij"), -1)
    grid = [np.arange(n) for n in samples.shape]
    return RegularGridInterpolator(grid, samples.astype(float), bounds_error=False, fill_value=None)(at)


# Numbers to type


@pytest.mark.parametrize(("low", "high"), [(-30, 55), (2, 7), (-900, -20), (-0.004, 0.001), (0, 0), (-1437.339, 2205)])
def test_unity_terrain_holds_the_level_in_numbers_one_can_type(low, high):
    terrain = unity.terrain_of(layout.lay_out((9, 9), 1.0, unity.SIDES, Options(), False, True), low, high)
    position, tall = terrain.position_y_m, terrain.terrain_height_m
    assert (float(f"{position:.2f}"), float(f"{tall:.2f}")) == (position, tall)
    assert position <= low
    assert position + tall * 65535 / 65536 >= high
    assert tall <= max((high - low) * 1.00002 + 0.05, 1.0)
    assert position + terrain.sea_level_share * tall == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("target", ["unity", "godot", "godot-hterrain"])
def test_recipe_and_axes_say_what_the_words_were_made_with(tmp_path, target):
    export(rough_level(40, sea_m=2.0), target, tmp_path / "out", GROUND, name="bay")
    manifest = read_manifest(tmp_path / "out")
    recipe, engine = " | ".join(manifest["import_recipe"]), manifest["engine"]
    assert height_file(tmp_path / "out").name in recipe
    numbers = ["terrain_height_m", "position_y_m"] if target == "unity" else ["min_m", "max_m"]
    for name in numbers:
        text = f"{engine[name]:.2f}" if target == "unity" else f"{engine[name]:.9g}"
        assert text in recipe
    assert "sea lies at Y 0" in recipe
    assert ("+Z north" if target == "unity" else "+Z south") in manifest["world"]["axes"]


@pytest.mark.parametrize("edit", ["position_y_m", "terrain_height_m", "sea_level_share", "heightmap_resolution"])
def test_false_numbers_of_a_terrain_are_found(tmp_path, edit):
    export(rough_level(20), "unity", tmp_path / "out", GROUND, name="bay")
    sign(tmp_path / "out", lambda data: data["engine"].update({edit: data["engine"][edit] + 1}))
    assert any(edit in finding for finding in check(tmp_path / "out"))


def test_only_height_maps_end_as_height_maps(tmp_path):
    """No importer takes another picture for the ground; a stray one is found."""
    for target in ENGINES:
        out = tmp_path / target
        export(slope_level(), target, out, [*GROUND, "normals"], name="bay")
        assert {p.name for p in out.iterdir() if p.suffix in (".r16", ".raw")} == {height_file(out).name}
        (out / "old.raw").write_bytes(b"\0\0")
        one(check(out), "old.raw")


def test_crest_gets_an_exact_half(tmp_path):
    """T09: (rg - 0.5) * strength is the current, and exactly none where there is none."""
    from shorewright.level.flow import current

    level = slope_level()
    level.write("flow", level.grid.rect, np.zeros((*level.grid.shape, 2), np.float32))
    level.layers["flow"].array[5:9, 7:12] = (0.7, -0.3)
    level.mark("flow", level.grid.rect)
    export(level, "unity", tmp_path / "out", "flow_crest", name="bay")
    record = read_manifest(tmp_path / "out")["files"][0]
    values = read_image(tmp_path / "out" / record["name"])[::-1, :, :2].astype(float)
    truth = current(level).packed[..., :2]
    assert np.abs((values - 0.5) * record["decode"]["numbers"]["strength"] - truth).max() < 1e-6
    assert (values[~truth.any(-1)] == 0.5).all()
    assert check(tmp_path / "out") == []


def test_deep_maps_for_godot_are_floats(tmp_path):
    """Godot 4 reads 16-bit PNG as 8 bits (research, files 3): none is written for it."""
    out = tmp_path / "out"
    export(slope_level(), "godot", out, ["normals", "river", "front_phase"], name="bay")
    assert all(f["bit_depth"] != 16 or f["name"].endswith(".r16") for f in read_manifest(out)["files"])
    assert (out / "bay_normals.exr").is_file()
    assert check(out) == []
    assert MANIFEST in snapshot(out)
