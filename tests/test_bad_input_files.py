"""Files that cannot be height maps: one sentence each that names the file, never a traceback (issue: bad input)."""

import struct
import subprocess
import sys
import zlib

import numpy as np
import pytest
from shorewright.io import import_height
from shorewright.io.images import read_image, write_image
from shorewright.level import BadInput
from tiff_files import geotiff, nodata, placed, ramp

PNGSUITE = (
    "xc1n0g08", "xc9n2c08", "xcrn0g04", "xcsn0g01", "xd0n2c08", "xd3n2c08", "xd9n2c08",
    "xdtn0g01", "xhdn0g08", "xlfn0g04", "xs1n0g01", "xs2n0g01", "xs4n0g01", "xs7n0g01",
)  # fmt: skip
SUFFIXES = (".png", ".exr", ".tif", ".npz", ".npy", ".r16", ".raw", ".txt", ".csv", ".asc")


def refuse(path, **flags):
    with pytest.raises(BadInput) as caught:
        import_height(path, **flags)
    sentence = str(caught.value)
    assert path.name in sentence
    assert "\n" not in sentence
    assert len(sentence) < 400
    return sentence


@pytest.mark.parametrize("name", PNGSUITE)
def test_pngsuite(data_dir, name):
    """The 14 corrupt files of PngSuite, as terrain and as pictures."""
    path = data_dir / f"bad_images/{name}.png"
    refuse(path, height_range=(0, 1))
    with pytest.raises(BadInput, match=name):
        read_image(path)


def test_nothing_but_our_sentence_reaches_stderr(tmp_path, data_dir):
    """libpng prints complaints of its own, and OpenImageIO prints unread errors when the program ends."""
    exr = write_image(tmp_path / "a.exr", ramp())
    exr.write_bytes(exr.read_bytes()[:-40])
    tif = geotiff(tmp_path / "a.tif", ramp(), tags=placed(1, -1, 0, 0))
    tif.write_bytes(tif.read_bytes()[:100])
    paths = [*(data_dir / f"bad_images/{name}.png" for name in PNGSUITE), exr, tif, tmp_path / "none.png"]
    code = """
import sys
from shorewright.io import import_height
from shorewright.level import BadInput
for path in sys.argv[1:]:
    try:
        import_height(path, height_range=(0, 1))
    except BadInput as error:
        print(error)
"""
    done = subprocess.run([sys.executable, "-c", code, *map(str, paths)], capture_output=True, text=True)
    assert done.stderr == ""
    assert done.returncode == 0
    assert len(done.stdout.splitlines()) == len(paths)


def good(path):
    """A small good file of each kind."""
    if path.suffix == ".png":
        return write_image(path, (ramp() + 30).astype(np.uint16))
    if path.suffix == ".exr":
        return write_image(path, ramp())
    if path.suffix == ".tif":
        return geotiff(path, ramp(), tags=placed(1, -1, 0, 0))
    if path.suffix == ".npz":
        np.savez_compressed(path, height=ramp())
    elif path.suffix == ".npy":
        np.save(path, ramp())
    elif path.suffix in (".r16", ".raw"):
        np.zeros(13 * 13, "<u2").tofile(path)
    elif path.suffix == ".asc":
        path.write_text("ncols 9\nnrows 12\ncellsize 1\n" + "\n".join(" ".join(map(str, row)) for row in ramp()))
    else:
        np.savetxt(path, ramp(), delimiter="," if path.suffix == ".csv" else " ")
    return path


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_missing_empty_folder_and_garbage(tmp_path, suffix):
    """What no reader can use: nothing there, an empty file, a folder, random bytes, a text."""
    flags = {"height_range": (0, 1)} if suffix in (".r16", ".raw") else {}
    assert "does not exist" in refuse(tmp_path / f"none{suffix}", **flags)
    (tmp_path / f"empty{suffix}").write_bytes(b"")
    assert "empty" in refuse(tmp_path / f"empty{suffix}", **flags)
    (tmp_path / f"folder{suffix}").mkdir()
    assert "not a file" in refuse(tmp_path / f"folder{suffix}", **flags)
    (tmp_path / f"noise{suffix}").write_bytes(np.random.default_rng(0).bytes(4099))
    refuse(tmp_path / f"noise{suffix}", **flags)
    (tmp_path / f"words{suffix}").write_text("not a height map\nat all")
    refuse(tmp_path / f"words{suffix}", **flags)


@pytest.mark.parametrize("suffix", [s for s in SUFFIXES if s not in (".txt", ".csv")])
def test_cut_short(tmp_path, suffix):
    """A good file cut after each tenth of it (a plain text grid cut at a line's end is a smaller grid)."""
    path = good(tmp_path / f"a{suffix}")
    flags = {"height_range": (0, 1)} if suffix in (".png", ".r16", ".raw") else {}
    import_height(path, **flags)
    data = path.read_bytes()
    for tenth in range(1, 10):
        path.write_bytes(data[: len(data) * tenth // 10])
        refuse(path, **flags)


def chunk(name, body):
    return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))


def huge_png(path):
    head = struct.pack(">IIBBBBB", 2_000_000, 2_000_000, 16, 0, 0, 0, 0)
    body = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(b"\0" * 100)) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + body)


def huge_exr(path):
    write_image(path, ramp())
    data = path.read_bytes()
    for name in (b"dataWindow\0box2i\0", b"displayWindow\0box2i\0"):
        at = data.index(name) + len(name) + 4 + 8
        data = data[:at] + struct.pack("<ii", 10**8, 10**8) + data[at + 8 :]
    path.write_bytes(data)


def huge_tif(path):
    geotiff(path, ramp())
    data = bytearray(path.read_bytes())
    for tag in (256, 257):
        at = data.index(struct.pack("<HHI", tag, 4, 1))
        data[at + 8 : at + 12] = struct.pack("<I", 3_000_000)
    path.write_bytes(data)


def huge_npy(path, box=False):
    head = b"{'descr': '<f8', 'fortran_order': False, 'shape': (1000000, 1000000), }"
    head += b" " * (63 - (10 + len(head)) % 64) + b"\n"
    data = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head + bytes(64)
    if not box:
        path.write_bytes(data)
        return
    import zipfile

    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("height.npy", data)


def huge_asc(path):
    path.write_text("ncols 4000000\nnrows 4000000\ncellsize 1\n1 2 3\n")


def wide_txt(path):
    path.write_text(("1 " * 20000 + "\n") * 2)


def long_raw(path):
    with path.open("wb") as file:
        file.truncate(2 * 40000 * 40000)  # sparse: takes no disk


HUGE = {
    ".png": huge_png,
    ".exr": huge_exr,
    ".tif": huge_tif,
    ".npy": huge_npy,
    ".npz": lambda path: huge_npy(path, box=True),
    ".asc": huge_asc,
    ".txt": wide_txt,
    ".r16": long_raw,
}


@pytest.mark.parametrize("suffix", HUGE)
def test_absurdly_large(tmp_path, suffix):
    """What a header claims is checked before memory is taken."""
    path = tmp_path / f"a{suffix}"
    HUGE[suffix](path)
    import resource

    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    sentence = refuse(path, **({"height_range": (0, 1)} if suffix in (".png", ".r16") else {}))
    assert "at most 16385" in sentence
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 200_000  # KiB


@pytest.mark.parametrize("suffix", [".exr", ".npz", ".txt", ".tif"])
def test_nothing_but_nan(tmp_path, suffix):
    """No sample at all, by NaN, infinity or the no-data value."""
    path = tmp_path / f"a{suffix}"
    values = np.full((8, 8), np.nan, np.float32)
    values[0] = np.inf
    if suffix == ".exr":
        write_image(path, values)
    elif suffix == ".npz":
        np.savez(path, height=values)
    elif suffix == ".txt":
        np.savetxt(path, values)
    else:
        geotiff(path, np.full((8, 8), -5, np.float32), tags=[*placed(1, -1, 0, 0), nodata("-5")])
    assert "every sample is missing" in refuse(path)


OTHERS = {
    "ragged.txt": (lambda p: p.write_text("1 2 3\n4 5\n6 7 8\n"), "not a grid"),
    "words.txt": (lambda p: p.write_text("1 2 3\n4 x 6\n"), "not a grid"),
    "points.txt": (lambda p: np.savetxt(p, np.random.default_rng(0).random((100, 3))), "points"),
    "single.txt": (lambda p: p.write_text("1 2 3\n"), "at least 2"),
    "binary.txt": (lambda p: p.write_bytes(b"1 2\0 3"), "binary"),
    "few.asc": (lambda p: p.write_text("ncols 3\nnrows 3\ncellsize 1\n1 2 3\n4 5 6\n"), "promises"),
    "head.asc": (lambda p: p.write_text("ncols 3\nnrows three\n"), "no number"),
    "lacks.asc": (lambda p: p.write_text("ncols 3\n1 2 3\n"), "lacks"),
    "cube.npz": (lambda p: np.savez(p, height=np.zeros((3, 3, 3))), "3 dimensions"),
    "text.npz": (lambda p: np.savez(p, height=np.array([["a", "b"], ["c", "d"]])), "not numbers"),
    "complex.npz": (lambda p: np.savez(p, height=np.zeros((3, 3), complex)), "not numbers"),
    "objects.npz": (lambda p: np.savez(p, height=np.array([[{}, 1], [2, 3]], object)), "not numbers"),
    "none.npz": (lambda p: np.savez(p, line=np.zeros(9)), "--array"),
    "small.exr": (lambda p: write_image(p, np.full((1, 5), 9, np.float32)), "at least 2"),
    "kind.xyz": (lambda p: p.write_text("1 2 3"), "no kind that can be imported"),
    "noext": (lambda p: p.write_text("1 2 3"), "no kind that can be imported"),
    "swapped.png": (lambda p: write_image(p.with_suffix(".exr"), ramp()).rename(p), "signature"),
    "nodata.tif": (lambda p: geotiff(p, ramp(), tags=[*placed(1, -1, 0, 0), nodata("none")]), "no-data value"),
    "place.tif": (lambda p: geotiff(p, ramp(), tags=placed(float("nan"), -1.0, 0, 0)), "makes no sense"),
}


@pytest.mark.parametrize("name", OTHERS)
def test_not_a_height_map(tmp_path, name):
    make, part = OTHERS[name]
    make(tmp_path / name)
    assert part in refuse(tmp_path / name)


@pytest.mark.parametrize("suffix", [".png", ".exr", ".tif", ".npz", ".asc"])
def test_damaged_bytes_never_trace(tmp_path, suffix):
    """A seeded storm of flipped bytes: read or refused, nothing else."""
    path = good(tmp_path / f"a{suffix}")
    data = path.read_bytes()
    rng = np.random.default_rng(4)
    refused = []
    for _ in range(60):
        broken = bytearray(data)
        for at in rng.integers(len(data), size=rng.integers(1, 5)):
            broken[at] = rng.integers(256)
        path.write_bytes(broken)
        try:
            found = import_height(path, **({"height_range": (0, 1)} if suffix == ".png" else {}))
            assert np.isfinite(found.height).all()
        except BadInput as error:
            refused.append(str(error))
    assert len(refused) > 5
    assert not any("\n" in sentence or len(sentence) > 400 for sentence in refused)
