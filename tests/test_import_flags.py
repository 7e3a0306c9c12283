"""Flags of an import and the real coasts: nothing guessed silently, square cells, every sample kept (T10)."""

import numpy as np
import pytest
from shorewright.io import import_height
from shorewright.level import BadInput
from tiff_files import ramp


def told(found, *parts):
    """Whether some note holds each of the parts."""
    return all(any(part in note for note in found.notes) for part in parts)


def test_depth_down(tmp_path):
    """Depths counted downward are turned over; a ground all on one side of 0 makes the notes ask."""
    np.savez(tmp_path / "a.npz", height=ramp() + 31)
    assert told(import_height(tmp_path / "a.npz"), "--depth-down")
    assert np.array_equal(import_height(tmp_path / "a.npz", depth_down=True).height, -(ramp() + 31)[::-1])


@pytest.mark.parametrize(("cell", "shape"), [("3x1", (12, 25)), ((1, 2), (23, 9)), ("1.5×1", (12, 13))])
def test_cells_that_are_not_square(tmp_path, cell, shape):
    """Resampled to the finer spacing: exact at the original samples, even slopes survive, nothing overshoots."""
    rng = np.random.default_rng(0)
    for values in (ramp(), rng.normal(0, 9, (12, 9)).astype(np.float32)):
        np.savez(tmp_path / "a.npz", height=values)
        found = import_height(tmp_path / "a.npz", cell_m=cell, rows="south-first")
        assert found.height.shape == shape
        assert found.cell_m == 1.0
        step = -(-shape[0] // 12), -(-shape[1] // 9)
        if cell == "1.5×1":
            assert np.array_equal(found.height[:, ::3], values[:, ::2])
        else:
            assert np.array_equal(found.height[:: step[0], :: step[1]], values)
        assert values.min() <= found.height.min()
        assert found.height.max() <= values.max()
        assert told(found, "aren't square")
    np.savez(tmp_path / "a.npz", height=ramp())
    slopes = np.gradient(import_height(tmp_path / "a.npz", cell_m=cell, rows="south-first").height)
    assert all(np.ptp(slope) < 1e-4 for slope in slopes)


@pytest.mark.parametrize(
    ("flags", "named"),
    [
        ({"rows": "upside-down"}, "--rows"),
        ({"cell_m": 0}, "--cell-m"),
        ({"cell_m": "2by1"}, "--cell-m"),
        ({"cell_m": (1, 2, 3)}, "--cell-m"),
        ({"cell_m": float("nan")}, "--cell-m"),
        ({"height_range": (5, 5)}, "--height-range"),
        ({"height_range": (0, float("inf"))}, "--height-range"),
        ({"fill_m": float("nan")}, "--fill"),
        ({"array": "nothing"}, "'nothing'"),
        ({"size": (12, 9)}, "--size"),
    ],
)
def test_flags_that_make_no_sense(tmp_path, flags, named):
    np.savez(tmp_path / "a.npz", height=ramp())
    with pytest.raises(BadInput, match=named):
        import_height(tmp_path / "a.npz", **flags)


def test_too_large_after_resampling(tmp_path):
    """A cell of 1000 × 1 m would need more samples than a level holds: refused before it is made."""
    np.savez(tmp_path / "a.npz", height=ramp(20, 40))
    with pytest.raises(BadInput, match="at most 16385"):
        import_height(tmp_path / "a.npz", cell_m=(1000, 1))


# Real files


def test_pyramid_rock(data_dir):
    """The real coast: 401 columns 2 m apart by 601 rows 1 m apart become 801 × 601 of 1 m, every sample kept."""
    path = data_dir / "coasts/pyramidrock_hi.celeris.txt"
    values = np.loadtxt(path).astype(np.float32)
    assert values.shape == (601, 401)
    found = import_height(path, cell_m="2x1", rows="south-first")
    assert found.height.shape == (601, 801)
    assert np.array_equal(found.height[:, ::2], values)
    assert found.height[0].mean() > found.height[-1].mean()  # row 0 is the land side
    assert (found.height < 0).mean() == pytest.approx(0.77, abs=0.01)
    # Neighbours across columns differ about twice as much as across rows: it is the columns that are 2 m apart.
    across, along = (np.abs(np.diff(values, axis=axis)).mean() for axis in (1, 0))
    assert 1.6 < across / along < 2.5


def test_rompy_geotiff(data_dir):
    """Degrees, NaN and south-first rows in one real file."""
    path = data_dir / "coasts/rompy_wa_bathy.tif"
    with pytest.raises(BadInput, match=r"--cell-m 20\.\d+x23\.\d+"):
        import_height(path)
    with pytest.raises(BadInput, match="south-first"):
        import_height(path, cell_m=20, rows="north-first")
    found = import_height(path, cell_m=20)
    assert found.height.shape == (180, 176)
    assert np.isfinite(found.height).all()
    assert told(found, "2275 of 31680 samples (7.2 %)")
    assert found.georeference["crs"] == "EPSG:4326"
    assert found.georeference["latitude"] == pytest.approx(-32.6483, abs=1e-4)
    found = import_height(path, cell_m="20x23.7")
    assert found.height.shape == (213, 176)


def test_topobathy(data_dir):
    found = import_height(data_dir / "coasts/topobathy.npz", cell_m=(2439, 3706))
    assert (found.height.min(), found.height.max() > 2100) == (-1437, True)


@pytest.mark.parametrize("name", ["16bit.png", "16bit.exr", "32bit.exr"])
def test_manticorp(data_dir, name):
    """One normalised map from other exporters as PNG, half and float EXR in RGB: all ask for the range."""
    path = data_dir / f"terrain_files/manticorp_heightmap_{name}"
    with pytest.raises(BadInput, match="--height-range"):
        import_height(path)
    found = import_height(path, height_range=(-50, 150))
    assert found.height.shape == (253, 253)
    assert found.height.min() == -50
    assert found.height.max() == pytest.approx(150, abs=0.02)
