"""Height maps of others: each kind of file read exactly, each flag honoured, each default told (issue: import; T10)."""

import numpy as np
import pytest
from shorewright.io import import_height
from shorewright.io.images import write_image
from shorewright.level import BadInput
from tiff_files import geotiff, nodata, placed, ramp


def told(found, *parts):
    """Whether some note holds each of the parts."""
    return all(any(part in note for note in found.notes) for part in parts)


def test_16_bit_png_needs_a_range(tmp_path):
    """v / 65535 · (max − min) + min, top row north; without a range refused by the flag's name."""
    values = np.array([[0, 65535, 1], [32768, 2, 3]], np.uint16)
    path = write_image(tmp_path / "a.png", values)
    with pytest.raises(BadInput, match="--height-range MIN MAX"):
        import_height(path)
    found = import_height(path, height_range=(-20, 80))
    assert np.array_equal(found.height, (values[::-1] / 65535 * 100 - 20).astype(np.float32))
    assert found.cell_m == 1.0
    assert told(found, "1 m is taken", "north edge")


def test_8_bit_is_warned_about(tmp_path):
    """256 heights: the note says how high the terraces will be."""
    path = write_image(tmp_path / "a.png", np.array([[0, 255], [51, 102]], np.uint8))
    found = import_height(path, height_range=(0, 51))
    assert told(found, "8-bit", "steps of 0.2 m", "terraces")
    assert np.allclose(found.height, [[10.2, 20.4], [0, 51]])


def test_exr_metres_and_normalised(tmp_path):
    """Outside 0 … 1 it is metres; inside nobody knows until --height-range says; metres with a range are refused."""
    metres = write_image(tmp_path / "metres.exr", ramp())
    assert np.array_equal(import_height(metres).height, ramp()[::-1])
    with pytest.raises(BadInput, match="leave out --height-range"):
        import_height(metres, height_range=(0, 1))
    part = (ramp() + 30) / 200
    unit = write_image(tmp_path / "unit.exr", part)
    with pytest.raises(BadInput, match="--height-range"):
        import_height(unit)
    assert np.allclose(import_height(unit, height_range=(-10, 90)).height, part[::-1] * 100 - 10, atol=1e-5)
    assert np.array_equal(import_height(unit, height_range=(0, 1)).height, part[::-1])


def test_grey_in_three_channels(tmp_path):
    """R = G = B but for rounding is a height map, colours are not; one channel can be named."""
    grey = np.repeat(ramp()[..., None], 3, axis=2)
    grey[3, 3, 1] += 0.01
    found = import_height(write_image(tmp_path / "grey.exr", grey))
    assert np.array_equal(found.height, ramp()[::-1])
    assert told(found, "differ by up to 0.01")
    grey[..., 1] *= 2
    path = write_image(tmp_path / "colour.exr", grey)
    with pytest.raises(BadInput, match="--array"):
        import_height(path)
    assert np.array_equal(import_height(path, array="G").height, grey[::-1, :, 1])
    with pytest.raises(BadInput, match="R, G, B"):
        import_height(path, array="height")


@pytest.mark.parametrize("big", [False, True], ids=["classic", "big"])
@pytest.mark.parametrize("order", "<>")
def test_geotiff_place_and_rows(tmp_path, order, big):
    """Both byte orders and sizes of TIFF: cell, easting and northing of the south-west sample, row 0 = north."""
    tags = placed(2.0, -2.0, 1000.0, 5000.0)
    found = import_height(geotiff(tmp_path / "a.tif", ramp(), tags=tags, order=order, big=big))
    assert np.array_equal(found.height, ramp()[::-1])
    assert found.cell_m == 2.0
    place = found.georeference
    assert (place["crs"], place["easting"], place["northing"]) == ("EPSG:32604", 1001.0, 5000.0 - 1 - 2 * 11)


def test_geotiff_south_first(tmp_path):
    """A positive north step puts row 0 in the south; a flag that says otherwise is refused."""
    path = geotiff(tmp_path / "a.tif", ramp(), tags=placed(2.0, 2.0, 1000.0, 5000.0, point=True))
    found = import_height(path)
    assert np.array_equal(found.height, ramp())
    assert (found.georeference["easting"], found.georeference["northing"]) == (1000.0, 5000.0)
    assert told(found, "south edge")
    with pytest.raises(BadInput, match="--rows north-first"):
        import_height(path, rows="north-first")
    assert np.array_equal(import_height(path, rows="south-first").height, ramp())


def test_geotiff_cells(tmp_path):
    """A contradicting --cell-m is refused; degrees need it and the sentence gives the value; feet become metres."""
    metres = geotiff(tmp_path / "m.tif", ramp(), tags=placed(2.0, -2.0, 0.0, 0.0))
    with pytest.raises(BadInput, match="leave out --cell-m"):
        import_height(metres, cell_m=3)
    assert import_height(metres, cell_m=2).cell_m == 2
    feet = geotiff(tmp_path / "f.tif", ramp(), tags=placed(10.0, -10.0, 0.0, 0.0, unit=9002))
    assert import_height(feet).cell_m == pytest.approx(3.048)
    tags = placed(0.001, -0.001, 10.0, 60.0 + 0.001 * 6, model=2, epsg=4326)
    degrees = geotiff(tmp_path / "d.tif", ramp(), tags=tags)
    with pytest.raises(BadInput, match=r"--cell-m 55\.8\d*x111\.4") as caught:  # 1° at 60° N: 55.8 km, 111.4 km
        import_height(degrees)
    assert "degrees" in str(caught.value)
    found = import_height(degrees, cell_m=50)
    assert (found.cell_m, found.georeference["longitude"]) == (50, pytest.approx(10.0005))


def test_geotiff_rotated_and_whole_numbers(tmp_path):
    """A rotated raster is refused; int16 metres are metres, uint16 without a unit is not."""
    turned = [(34264, "d", (1, 0.5, 0, 0, 0.5, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1))]
    with pytest.raises(BadInput, match="rotated"):
        import_height(geotiff(tmp_path / "r.tif", ramp(), tags=turned))
    north = placed(1.0, -1.0, 0.0, 0.0)
    found = import_height(geotiff(tmp_path / "i.tif", ramp(dtype=np.int16), tags=north))
    assert np.array_equal(found.height, ramp()[::-1])
    path = geotiff(tmp_path / "u.tif", (ramp() + 30).astype(np.uint16), tags=north)
    with pytest.raises(BadInput, match="--height-range"):
        import_height(path)
    assert np.allclose(import_height(path, height_range=(0, 65535)).height, ramp()[::-1] + 30)


def test_nodata_is_filled_and_counted(tmp_path):
    """The tag's value, NaN, infinity and sentinels nobody names: filled from the neighbours, each told."""
    values = np.full((20, 20), 7.0, np.float32)
    values[0, :10] = -1.0
    values[10, 10], values[12, 3], values[13, 3] = np.nan, np.inf, 3.4e38
    values[15, 15] = -9999
    found = import_height(geotiff(tmp_path / "a.tif", values, tags=[*placed(1, -1, 0, 0), nodata("-1")]))
    assert np.allclose(found.height, 7.0)
    assert told(found, "10 samples have the file's no-data value -1", "1 samples of -9999", "14 of 400 samples")


def test_nodata_at_sea_level(tmp_path):
    """No-data 0 in a map of land only: the note counts it, and --fill gives the sea a floor."""
    values = np.full((20, 20), 7.0, np.float32)
    values[:, :12] = 0.0
    path = geotiff(tmp_path / "a.tif", values, tags=[*placed(1, -1, 0, 0), nodata("0")])
    assert told(import_height(path), "240 of 400 samples (60 %)", "--fill METRES")
    found = import_height(path, fill_m=-15)
    assert np.array_equal(found.height[:, :12], np.full((20, 12), -15, np.float32))


def test_filling_keeps_what_was_measured(tmp_path):
    """Only holes change, and they stay within their surroundings."""
    values = ramp(40, 40).astype(np.float64)
    holes = np.zeros(values.shape, bool)
    holes[10:20, 15:30] = True
    broken = np.where(holes, np.nan, values)
    np.savez(tmp_path / "a.npz", height=broken)
    found = import_height(tmp_path / "a.npz", rows="south-first")
    assert np.array_equal(found.height[~holes], values[~holes].astype(np.float32))
    around = values[8:22, 13:32]
    assert around.min() <= found.height[holes].min() <= found.height[holes].max() <= around.max()


def test_npz_chooses_its_array(tmp_path):
    """`height` first, else the only 2-D one, else the one that is named."""
    np.savez(tmp_path / "a.npz", height=ramp(), other=np.zeros((3, 3)), line=np.zeros(4))
    assert np.array_equal(import_height(tmp_path / "a.npz").height, ramp()[::-1])
    assert import_height(tmp_path / "a.npz", array="other").height.shape == (3, 3)
    np.savez_compressed(tmp_path / "b.npz", topo=ramp(), line=np.zeros(4))
    assert np.array_equal(import_height(tmp_path / "b.npz", rows="south-first").height, ramp())
    np.savez(tmp_path / "c.npz", one=ramp(), two=ramp())
    with pytest.raises(BadInput, match="--array"):
        import_height(tmp_path / "c.npz")
    np.save(tmp_path / "d.npy", ramp())
    assert np.array_equal(import_height(tmp_path / "d.npy").height, ramp()[::-1])


def test_npz_coordinates(tmp_path):
    """An array of latitudes beside the map says which way its rows run; the cell stays the documented 1 m, and told."""
    north, east = 48 + np.arange(12) / 30, 200 + np.arange(9) / 30
    np.savez(tmp_path / "a.npz", topo=ramp(), latitude=north, longitude=east)
    found = import_height(tmp_path / "a.npz")
    assert np.array_equal(found.height, ramp())
    assert told(found, "'latitude'", "degrees", "1 m is taken")
    assert (found.cell_m, found.georeference) == (1.0, {"latitude": 48.0, "longitude": 200.0})
    with pytest.raises(BadInput, match="--rows north-first"):
        import_height(tmp_path / "a.npz", rows="north-first")


def test_r16(tmp_path):
    """Little-endian words, square or of a given size, with a range."""
    values = np.arange(12, dtype="<u2").reshape(3, 4) * 5000
    values.tofile(tmp_path / "a.r16")
    with pytest.raises(BadInput, match="--size COLSxROWS"):
        import_height(tmp_path / "a.r16", height_range=(0, 1))
    found = import_height(tmp_path / "a.r16", size=(4, 3), height_range=(-10, 55.535))
    assert np.allclose(found.height, values[::-1] / 1000 - 10, atol=1e-5)
    with pytest.raises(BadInput, match="24 bytes"):
        import_height(tmp_path / "a.r16", size=(4, 4), height_range=(0, 1))
    np.arange(16, dtype="<u2").tofile(tmp_path / "b.raw")
    assert import_height(tmp_path / "b.raw", height_range=(0, 65535)).height.tolist()[-1] == [0, 1, 2, 3]
    with pytest.raises(BadInput, match="--height-range"):
        import_height(tmp_path / "b.raw")


@pytest.mark.parametrize("sign", [" ", ",", ";", "\t"])
def test_text_grid(tmp_path, sign):
    """Blanks, commas, semicolons, tabs; comments and empty lines; a line end after the last number."""
    lines = [sign.join(f"{v:.3e}" for v in row) for row in ramp()]
    (tmp_path / "a.txt").write_text("# a grid\n\n" + "\n".join(lines) + "\n\n")
    found = import_height(tmp_path / "a.txt")
    assert np.array_equal(found.height, ramp()[::-1])
    assert told(found, "12 rows of 9 samples", "1 m is taken", "north edge")
    assert np.array_equal(import_height(tmp_path / "a.txt", rows="south-first").height, ramp())


def test_esri_grid(tmp_path):
    """Cell, corner, rows and no-data are stated there; flags may agree but not contradict."""
    values = ramp()
    values[0, 0] = -9999
    head = "ncols 9\nnrows 12\nxllcorner 100\nyllcorner 200\ncellsize 5\nNODATA_value -9999\n"
    (tmp_path / "a.asc").write_text(head + "\n".join(" ".join(map(str, row)) for row in values))
    found = import_height(tmp_path / "a.asc")
    assert np.array_equal(found.height[:-1], ramp()[::-1][:-1])
    assert (found.cell_m, found.georeference["easting"], found.georeference["northing"]) == (5.0, 102.5, 202.5)
    assert told(found, "1 of 108 samples")
    for flags in ({"cell_m": 4}, {"rows": "south-first"}):
        with pytest.raises(BadInput, match="leave out"):
            import_height(tmp_path / "a.asc", **flags)
