"""Weather maps from and to images: layouts, swizzles, sizes, seams, round trips, what is refused (Z04, T04)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app.cli import main
from shorewright.app.session import Session
from shorewright.io import read_level, write_level
from shorewright.io.images import read_header, read_image, write_image
from shorewright.io.swizzle import parse
from shorewright.io.weather_maps import WEATHER_LAYOUTS, layout_values, read_weather_map, write_weather_map
from shorewright.level import BadInput, Rect
from shorewright.level.sky_maps import (
    CELL_M,
    TILE_M,
    laid_over,
    placed,
    resampled,
    seam_ratio,
    sky_map,
    unpulled,
    wrap_blended,
)
from shorewright.level.textures import spectral_noise
from shorewright.level.weather import pulled, weather_at

PNGSUITE = (
    "xc1n0g08", "xc9n2c08", "xcrn0g04", "xcsn0g01", "xd0n2c08", "xd3n2c08", "xd9n2c08",
    "xdtn0g01", "xhdn0g08", "xlfn0g04", "xs1n0g01", "xs2n0g01", "xs4n0g01", "xs7n0g01",
)  # fmt: skip


def tiling(side=512, seed=1):
    """float32 `(side, side, 3)` in 0 … 1 that tiles."""
    noise = np.stack([spectral_noise(side, seed + n, 1.2, 2, 30) for n in range(3)], -1)
    return np.clip(0.5 + 0.15 * noise, 0, 1).astype(np.float32)


def whole(bits, seed=3):
    rng = np.random.default_rng(seed)
    return rng.integers(0, 1 << bits, (512, 512, 3)).astype(np.uint8 if bits == 8 else np.uint16)


# Round trips


@pytest.mark.parametrize(("bits", "suffix"), [(8, ".png"), (16, ".png"), (8, ".tif"), (16, ".tif")])
def test_what_a_file_can_hold_comes_back(tmp_path, bits, suffix):
    """Whole samples survive bit for bit, north on top."""
    source = write_image(tmp_path / f"a{suffix}", whole(bits), data=True)
    sky, notes = read_weather_map(source)
    assert sky.shape == (512, 512, 6)
    assert (sky[..., 3:] == 1).all()
    again = write_weather_map(tmp_path / f"b{suffix}", sky[..., :3], bits=bits)
    np.testing.assert_array_equal(read_image(again), read_image(source))
    np.testing.assert_array_equal(np.rint(sky[::-1, :, :3] * ((1 << bits) - 1)), whole(bits))
    assert notes == []


@pytest.mark.parametrize(("bits", "suffix"), [(16, ".exr"), (32, ".exr"), (32, ".tif")])
def test_floats_come_back(tmp_path, bits, suffix):
    values = tiling()
    values = values.astype(np.float16).astype(np.float32) if bits == 16 else values
    path = write_weather_map(tmp_path / f"a{suffix}", values, bits=bits)
    np.testing.assert_array_equal(read_weather_map(path)[0][..., :3], values)


def test_eight_bits_survive_the_layer(tmp_path):
    """T04: a map of 8 bits that is imported, saved and exported is the file that came in."""
    source = write_image(tmp_path / "a.png", whole(8), data=True)
    with Session.new() as session:
        session.weather_import(source)
        session.save(tmp_path / "a.shore")
        session.weather_export(tmp_path / "b.png", stage="paint")
    np.testing.assert_array_equal(read_image(tmp_path / "b.png"), whole(8))
    level = read_level(tmp_path / "a.shore")
    np.testing.assert_array_equal(np.rint(level.layers["weather"].array[::-1, :, :3] * 255), whole(8))


def test_paint_and_its_weights_come_back(tmp_path):
    """T04: the paint in one file, its three weights in another, give the layer back; alpha alone holds one weight."""
    rng = np.random.default_rng(7)
    paint = (rng.integers(0, 256, (200, 200, 6)) / 255).astype(np.float32)
    paint[..., 3:] *= rng.random((200, 200, 1)) > 0.3
    with Session.new() as session, Session.new() as again:
        session.level.write("weather", Rect(100, 150, 300, 350), paint)
        session.weather_export(tmp_path / "sky.tif", stage="paint", bits=32)
        session.weather_export(tmp_path / "weights.tif", layout="weights", bits=32)
        told = session.weather_export(tmp_path / "one.png", layout="weighted")
        again.weather_import(tmp_path / "sky.tif", weights=str(tmp_path / "weights.tif"))
        wanted, found = session.level.layers["weather"].array, again.level.layers["weather"].array
        np.testing.assert_allclose(found[..., 3:], wanted[..., 3:], atol=1e-6)
        counts = wanted[..., 3:] > 0
        np.testing.assert_allclose(found[..., :3][counts], wanted[..., :3][counts], atol=1e-3)
    assert any("differ" in note for note in told)
    np.testing.assert_array_equal(
        read_image(tmp_path / "one.png")[::-1, :, 3], np.rint(wanted[..., 3:].max(axis=-1) * 255)
    )


def test_the_composed_sky_is_the_sky(tmp_path):
    """Z04: what is written of a stage is what `weather_at` says over the places that its samples stand for."""
    level = make_beach()
    level.set("weather.precipitation", 0.4)
    level.set("weather.east_m", 4321.0)
    level.write("weather", Rect(200, 200, 300, 300), 0.75)
    for stage, time_s in (("simulated", 0.0), ("painted", 900.0), ("final", 900.0)):
        sky, _ = layout_values(level, "ours", stage, time_s)
        path = write_weather_map(tmp_path / "a.tif", sky, bits=16)
        read = read_weather_map(path)[0]
        rows, cols = np.random.default_rng(1).integers(0, 512, (2, 200))
        x, y = cols * CELL_M - TILE_M / 2 + 4321.0, rows * CELL_M - TILE_M / 2
        wanted = weather_at(level, time_s, x, y, None, stage)[:, :3]
        np.testing.assert_allclose(read[rows, cols, :3], wanted, atol=1 / 65535)


def test_an_exported_sky_laid_over_its_level_changes_nothing_that_is_seen(tmp_path):
    """T04: the composed sky, painted over itself at time zero."""
    with Session.new() as session:
        level = session.level
        level.set("weather.precipitation", 0.3)
        x, y = np.random.default_rng(2).integers(-200, 200, (2, 300)) * CELL_M
        before = weather_at(level, 0.0, x, y, None, "final")
        session.weather_export(tmp_path / "sky.tif", bits=16)
        session.weather_import(tmp_path / "sky.tif")
        np.testing.assert_allclose(weather_at(level, 0.0, x, y, None, "final")[:, :3], before[:, :3], atol=1e-3)


def test_hdrp_holds_what_is_drawn(tmp_path):
    """Their cloud map: coverage, rain and the place along the table of types, three channels without a colour tag."""
    level = make_beach()
    level.set("weather.precipitation", 0.5)
    sky, _ = layout_values(level, "hdrp")
    np.testing.assert_array_equal(sky, sky_map(level, "final")[..., :3])
    path = write_weather_map(tmp_path / "a.png", sky, bits=8)
    assert read_header(path).channels == ("R", "G", "B")
    assert not any(chunk in path.read_bytes() for chunk in (b"sRGB", b"gAMA", b"iCCP", b"cHRM"))
    back = read_weather_map(path, layout="hdrp")[0][..., :3]
    dry = sky[..., 1] < 0.5
    np.testing.assert_allclose(pulled(back)[dry], sky[dry], atol=3 / 255)
    np.testing.assert_allclose(back[dry], sky_map(level, "painted")[..., :3][dry], atol=5 / 255)


def test_what_rain_pulled_is_let_go_again():
    rng = np.random.default_rng(4)
    sky = rng.random((1000, 3))
    sky[:, 1] *= 0.95
    np.testing.assert_allclose(unpulled(pulled(sky)), sky, atol=1e-5)
    assert np.isfinite(unpulled(np.array([[0.7, 1.0, 1.0]]))).all()


# Swizzles and layouts


def test_swizzles_pick_turn_round_and_fill(tmp_path):
    values = whole(8)
    path = write_image(tmp_path / "a.png", values, data=True)
    r, g, b = np.moveaxis(values[::-1] / np.float32(255), -1, 0)
    for text, wanted in (
        ("b,0,r", (b, 0 * b, r)), ("r,0,0.6", (r, 0 * r, 0.6 + 0 * r)), ("1-r,g,1-b", (1 - r, g, 1 - b)),
        ("bgr", (b, g, r)), (" R , 1-G , 1 ", (r, 1 - g, 1 + 0 * r)),
    ):  # fmt: skip
        np.testing.assert_allclose(read_weather_map(path, swizzle=text)[0][..., :3], np.stack(wanted, -1), atol=1e-7)
    sky, _ = read_weather_map(path, swizzle="r,g,-,b")
    np.testing.assert_array_equal(sky[..., 3], sky[..., 4])
    np.testing.assert_allclose(sky[..., 3], b, atol=1e-7)
    assert not sky[..., 5].any()


def test_peers_maps_are_read(data_dir):
    """The layouts of takram (R coverage) and clayjohn (B coverage, R type), both of which tile."""
    folder = data_dir / "weather"
    for name, layout, terms in (
        ("takram_local_weather.png", "takram", (0, 0.0, 0.6)), ("clayjohn_weather.bmp", "clayjohn", (2, 0.0, 0)),
    ):  # fmt: skip
        pixels = read_image(folder / name)[::-1]
        sky, notes = read_weather_map(folder / name, layout=layout)
        for channel, term in enumerate(terms):
            wanted = pixels[..., term] / np.float32(255) if isinstance(term, int) else np.float32(term)
            np.testing.assert_allclose(sky[..., channel], wanted, atol=1e-7)
        assert notes == []
        assert sky[..., 0].std() > 0.1


def test_grey_and_alpha(tmp_path):
    """One channel counts as red; a second one is alpha, and is not multiplied in."""
    grey = write_image(tmp_path / "g.png", whole(8)[..., :1], data=True)
    both = write_image(tmp_path / "ga.png", whole(8)[..., :2], channels=("Y", "A"), data=True)
    np.testing.assert_array_equal(
        read_weather_map(grey, swizzle="r,0,1")[0][..., 0], read_weather_map(both, swizzle="r,0,1,a")[0][..., 0]
    )
    weight = read_weather_map(both, swizzle="r,0,1,a")[0][..., 3]
    np.testing.assert_array_equal(np.rint(weight[::-1] * 255), whole(8)[..., 1])
    with pytest.raises(BadInput, match="no channel g, only r"):
        read_weather_map(grey)


def test_layouts_are_read_or_written_or_both():
    for row in WEATHER_LAYOUTS.values():
        assert row.swizzle or row.stage
        if row.swizzle:
            parse(row.swizzle)


# Sizes and seams


def test_constants_stay_and_means_are_kept():
    """Area means keep what a map holds; all sizes cover the same ground."""
    for rows, cols in ((512, 512), (64, 64), (1024, 1024), (700, 300), (2, 3), (1536, 100)):
        np.testing.assert_array_equal(resampled(np.full((rows, cols, 2), 0.3, np.float32)), np.float32(0.3))
    fine = np.random.default_rng(0).random((1536, 1024, 3)).astype(np.float32)
    made = resampled(fine)
    np.testing.assert_allclose(made, fine.reshape(512, 3, 512, 2, 3).mean(axis=(1, 3)), atol=1e-6)
    odd = np.random.default_rng(0).random((777, 613, 1)).astype(np.float32)
    assert resampled(odd).mean(dtype=float) == pytest.approx(odd.mean(dtype=float), abs=1e-6)


@pytest.mark.parametrize("side", [64, 100, 777, 1024])
def test_a_wave_is_where_it_was_at_any_size(side):
    """A torus resampled is the same torus: a wave keeps its phase and wraps."""
    at = (np.arange(side) + 0.5) / side
    wave = 0.5 + 0.4 * np.sin(2 * np.pi * (2 * at[:, None] + 3 * at[None, :]))
    made = resampled(wave[..., None].astype(np.float32))[..., 0]
    at = (np.arange(512) + 0.5) / 512
    np.testing.assert_allclose(made, 0.5 + 0.4 * np.sin(2 * np.pi * (2 * at[:, None] + 3 * at[None, :])), atol=0.012)


def test_other_sizes_are_told(tmp_path):
    path = write_image(tmp_path / "wide.png", (resampled(tiling(), 64)[:, :32] * 255).astype(np.uint8), data=True)
    _, notes = read_weather_map(path)
    assert any("32 × 64" in note and "stretched" in note for note in notes)


def test_a_seam_is_told_and_a_wrap_blend_mends_it(tmp_path):
    """The ratio falls from far over the limit to under 1.1, and the middle stays bit for bit."""
    cut = resampled(tiling(seed=9), 1024)[200:712, 100:612]
    path = write_weather_map(tmp_path / "cut.tif", cut, bits=32)
    _, notes = read_weather_map(path)
    assert any("does not tile" in note and "wrap blend" in note for note in notes)
    assert seam_ratio(cut) > 5
    sky, notes = read_weather_map(path, wrap_blend_m=4000.0)
    assert notes == []
    assert seam_ratio(sky[..., :3]) < 1.1
    band = round(4000 / CELL_M)
    np.testing.assert_array_equal(sky[band:-band, band:-band, :3], cut[band:-band, band:-band])
    assert sky[..., :3].min() >= 0
    assert sky[..., :3].max() <= 1
    assert 0.7 < seam_ratio(tiling()) < 1.3
    np.testing.assert_array_equal(wrap_blended(cut, 0, 0), cut)


def test_a_hard_edge_between_flat_halves(tmp_path):
    flat = np.zeros((64, 64, 3), np.uint8)
    flat[:, 32:] = 255
    assert seam_ratio(flat) == pytest.approx(63)
    assert seam_ratio(np.zeros((8, 8, 1))) == 1.0


# Placed


def test_a_small_map_lies_where_it_is_put():
    """Its middle at a place of the sky, its own size, all else untouched, over the wrap too."""
    ramp = np.stack(np.broadcast_arrays(*np.mgrid[0:200, 0:200] / 199.0), -1).astype(np.float32)
    for about in ((3000.0, -9000.0), (34_900.0, -34_000.0)):
        sky, weight = placed(ramp, 8000.0, about)
        axis = np.arange(512) * CELL_M - TILE_M / 2
        east, north = ((axis - at + TILE_M / 2) % TILE_M - TILE_M / 2 for at in about)
        inside = (np.abs(north) <= 4000)[:, None] & (np.abs(east) <= 4000)[None, :]
        np.testing.assert_array_equal(weight, inside)
        part = np.broadcast_to(0.5 + east / 8000, (512, 512))
        middle = inside & (np.abs(part - 0.5) < 0.45)
        np.testing.assert_allclose(sky[..., 1][middle], part[middle], atol=0.01)
    soft = placed(ramp, 8000.0, (0.0, 0.0), 2000.0)[1]
    assert soft[256, 256] == 1
    assert 0.4 < soft[256, 256 + round(3000 / CELL_M)] < 0.6


def test_skies_mix_by_their_weights():
    """What isn't painted lends nothing; whole weights replace; no weight leaves bits alone."""
    under = np.random.default_rng(1).random((50, 6)).astype(np.float32)
    over = np.concatenate([np.full((50, 3), 0.25), np.ones((50, 3))], -1).astype(np.float32)
    np.testing.assert_array_equal(laid_over(under, over), over)
    np.testing.assert_array_equal(laid_over(under, over, 0.0), under)
    bare = np.zeros((50, 6), np.float32)
    np.testing.assert_allclose(laid_over(bare, over, 0.3), np.repeat(np.float32([[0.25] * 3 + [0.3] * 3]), 50, 0))
    half = laid_over(over, under, 0.5)
    assert (half[:, 3:] == 1).all()
    np.testing.assert_allclose(half[:, :3], over[:, :3] + (under[:, :3] - over[:, :3]) * 0.5 * under[:, 3:], atol=1e-6)


# As an edit


def test_an_import_is_one_step_that_plays_again(tmp_path):
    """T04 T08: undone, redone, recorded as a word, and placed where the wind has carried the air by then."""
    source = write_weather_map(tmp_path / "a.png", tiling())
    with Session.new() as session, Session.new() as again:
        session.level.set("clouds.on", False)
        steps = len(session.journal.done)
        session.scrub(1200.0)
        notes = session.weather_import(source, extent_m=9000.0, at=(500.0, 700.0), opacity=0.5)
        assert len(session.journal.done) == steps + 1
        assert any("clouds.on" in note for note in notes)
        data = session.level.layers["weather"]
        assert 0 < data.written.sum() < 16
        at = weather_at(session.level, 1200.0, np.array([500.0, 5500.0]), np.array([700.0, 700.0]), None, "painted")
        assert at[0, 3] == pytest.approx(0.5)
        assert at[1, 3] == 0
        made = data.array.copy()
        again.run(session.script)
        np.testing.assert_array_equal(again.level.layers["weather"].array, made)
        assert session.undo() == "Weather map a.png"
        assert not data.array.any()
        session.redo()
        np.testing.assert_array_equal(data.array, made)


def bad_files(folder):
    values = tiling()
    np.savez(folder / "none.npz", a=values)
    (folder / "empty.png").write_bytes(b"")
    (folder / "text.png").write_bytes(b"no picture at all")
    write_image(folder / "thin.png", np.zeros((1, 700, 3), np.uint8))
    write_image(folder / "nan.exr", np.where(values > 0.7, np.float32(np.nan), values))
    write_image(folder / "inf.exr", np.where(values > 0.7, np.float32(np.inf), values))
    write_image(folder / "hdr.exr", values * 4)
    write_image(folder / "negative.exr", values - 0.5)
    write_image(folder / "good.png", (values * 255).astype(np.uint8), data=True)
    write_image(folder / "small.png", np.zeros((8, 8, 3), np.uint8))


BAD = [
    ("empty.png", {}, "is empty"), ("text.png", {}, "not a usable PNG"), ("missing.png", {}, "does not exist"),
    ("none.npz", {}, "not an image"), ("thin.png", {}, "700 × 1"), ("nan.exr", {}, "not numbers"),
    ("inf.exr", {}, "not numbers"), ("hdr.exr", {}, "0 to 1"), ("negative.exr", {}, "0 to 1"),
    (".", {}, "not a file"),
    ("good.png", {"swizzle": "r,g"}, "2 parts"), ("good.png", {"swizzle": "r,x,b"}, "'x'"),
    ("good.png", {"swizzle": "r,2,b"}, "'2'"), ("good.png", {"swizzle": "nan,r,g"}, "'nan'"),
    ("good.png", {"swizzle": "r,g,b,a"}, "no channel a"), ("good.png", {"swizzle": "-,-,-"}, "takes nothing"),
    ("good.png", {"swizzle": "1-1,g,b"}, "'1-1'"), ("good.png", {"layout": "nubis"}, "there are: ours"),
    ("good.png", {"layout": "weights"}, "weights alone"), ("good.png", {"weights": "small.png"}, "8 × 8"),
    ("good.png", {"extent_m": 10.0}, "outside 273 to 70000"), ("good.png", {"extent_m": 80_000.0}, "extent_m"),
    ("good.png", {"opacity": 2.0}, "opacity"), ("good.png", {"at": (0.0, float("nan"))}, "at"),
    ("good.png", {"extent_m": 9000.0, "wrap_blend_m": 100.0}, "feather"), ("good.png", {"wrap_blend_m": -1.0}, "wrap"),
    ("good.png", {"colour": 3}, "colour"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "options", "told"), BAD, ids=[f"{n}-{o}" for n, o, _ in BAD])
def test_what_is_no_weather_map_is_told_in_a_sentence(tmp_path, monkeypatch, name, options, told):
    """T04: and the sky stays as it was."""
    monkeypatch.chdir(tmp_path)
    bad_files(tmp_path)
    with Session.new() as session:
        with pytest.raises(BadInput) as caught:
            session.weather_import(name, **options)
        sentence = str(caught.value)
        assert told in sentence
        assert "\n" not in sentence
        assert len(sentence) < 300
        assert session.level.layers["weather"].neutral
        assert not session.journal.done


@pytest.mark.parametrize("name", PNGSUITE)
def test_damaged_pictures(data_dir, name):
    """The 14 corrupt files of PngSuite."""
    with pytest.raises(BadInput, match=name):
        read_weather_map(data_dir / f"bad_images/{name}.png", swizzle="r,0,0")


@pytest.mark.parametrize(
    ("name", "options", "told"),
    [
        ("a.bmp", {}, "end it in"), ("a.png", {"bits": 32}, "8 or 16"), ("a.exr", {"bits": 8}, "16 or 32"),
        ("a.png", {"side": 1}, "outside 2"), ("a.png", {"layout": "takram"}, "only read"),
        ("a.png", {"stage": "dreamt"}, "no stage"), ("a.png", {"layout": "weights", "stage": "final"}, "no stage"),
        ("none/a.png", {}, "none"),
    ],
)  # fmt: skip
def test_exports_that_cannot_be(tmp_path, name, options, told):
    with Session.new() as session, pytest.raises(BadInput, match=told):
        session.weather_export(tmp_path / name, **options)
    assert list(tmp_path.iterdir()) == []


# Command line


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_level(make_beach(), tmp_path / "beach.shore")
    bad_files(tmp_path)
    return tmp_path


def test_command_line_there_and_back(folder, capsys):
    """T04: import, export, and the bytes that came in; notes on stderr."""
    write_image("map.png", whole(8), data=True)
    assert main(["weather", "import", "beach.shore", "map.png", "--swizzle", "b,0,1-r"]) == 0
    said = capsys.readouterr()
    assert said.out == "100 % of the sky is painted\n"
    assert "clouds.on" in said.err
    assert main(["weather", "export", "beach.shore", "-o", "back.png", "--stage", "paint"]) == 0
    assert capsys.readouterr().out == "back.png\n"
    back = read_image("back.png")
    np.testing.assert_array_equal(back[..., 0], whole(8)[..., 2])
    np.testing.assert_array_equal(back[..., 2], 255 - whole(8)[..., 0])
    argv = "weather export beach.shore -o unity.png --layout hdrp --bits 16 --size 128 --time 60"
    assert main(argv.split()) == 0
    assert read_image("unity.png").shape == (128, 128, 3)
    argv = "weather import beach.shore good.png --at 500,-700 --extent-m 9000 --opacity 0.5 --feather 500"
    assert main(argv.split()) == 0


@pytest.mark.parametrize(
    ("argv", "told"),
    [
        ("import beach.shore good.png --swizzle r,q,b", "'q'"),
        ("import beach.shore nan.exr", "not numbers"),
        ("import beach.shore good.png --at 5", "--at"),
        ("import beach.shore good.png --layout x", "ours, weighted"),
        ("import beach.shore good.png --extent-m 5", "outside 273"),
        ("import beach.shore good.png --opacity nan", "opacity"),
        ("import beach.shore", "weather import needs IMAGE"),
        ("import nowhere.shore good.png", "nowhere.shore"),
        ("export beach.shore -o a.png --bits 12", "12"),
        ("export beach.shore -o a.gif", "a.gif"),
        ("export beach.shore -o no/a.png", "no"),
        ("export beach.shore -o a.png --time -1", "--time"),
        ("export beach.shore -o a.png --stage dawn", "dawn"),
        ("bogus", "no command 'weather bogus'"),
    ],
)
def test_command_line_refuses_in_a_sentence(folder, capsys, argv, told):
    """T10: exit code 2, one line, the level as it was."""
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert main(["weather", *argv.split()]) == 2
    said = capsys.readouterr()
    assert told in said.err
    assert said.err.count("\n") == 1
    assert {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()} == before
