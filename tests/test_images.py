"""Images: every round trip exact, every trap of OpenImageIO guarded (design, Measured here)."""

import struct
import time

import numpy as np
import pytest
from shorewright.io import images
from shorewright.io.images import load_image, read_header, read_image, write_image
from shorewright.level import BadInput

KINDS = {".png": ("u1", "u2"), ".tif": ("u1", "u2", "f4"), ".exr": ("f4",)}
CASES = [(suffix, kind, count) for suffix, kinds in KINDS.items() for kind in kinds for count in (1, 2, 3, 4)]


def samples(kind, count, rows=17, cols=23):
    rng = np.random.default_rng(2)
    if kind == "f4":
        return rng.normal(0, 50, (rows, cols, count)).astype(np.float32)
    return rng.integers(0, np.iinfo(kind).max, (rows, cols, count), endpoint=True, dtype=kind)


@pytest.mark.parametrize(("suffix", "kind", "count"), CASES)
def test_round_trip_is_exact(tmp_path, suffix, kind, count):
    """2- and 4-channel PNG included: their last channel is no alpha that is multiplied in."""
    array = samples(kind, count)
    again = read_image(write_image(tmp_path / f"a{suffix}", array))
    assert again.dtype == array.dtype
    assert np.array_equal(again, array)


def test_two_dimensions_and_strides(tmp_path):
    """A 2-D, reversed, strided array is written as it looks, not as its memory lies."""
    array = samples("f4", 1)[..., 0]
    view = array[::-1, ::2]
    assert np.array_equal(read_image(write_image(tmp_path / "a.exr", view))[..., 0], view)
    assert np.array_equal(read_image(write_image(tmp_path / "b.exr", array.T))[..., 0], array.T)


def test_exr_is_what_others_read(tmp_path):
    """Float32 ZIP with channel Y, or half on request; names can be given."""
    array = samples("f4", 1)
    header = read_header(write_image(tmp_path / "a.exr", array))
    assert (header.dtype, header.channels, header.attributes["compression"]) == ("float", ("Y",), "zip")
    header, half = load_image(write_image(tmp_path / "b.exr", array, half=True))
    assert (header.dtype, half.dtype) == ("half", np.float32)
    assert np.array_equal(half, array.astype(np.float16).astype(np.float32))
    assert read_header(write_image(tmp_path / "c.exr", samples("f4", 2), channels=("u", "v"))).channels == ("u", "v")


@pytest.mark.parametrize("suffix", KINDS)
def test_bytes_do_not_depend_on_the_clock(tmp_path, monkeypatch, suffix):
    """No date gets into a file: EXR and TIFF would carry one."""
    array = samples(KINDS[suffix][-1], 1)
    one = write_image(tmp_path / f"a{suffix}", array).read_bytes()
    time.sleep(1.05)  # the stamp has whole seconds
    assert write_image(tmp_path / f"a{suffix}", array).read_bytes() == one


def test_16_bit_png_is_data(tmp_path):
    """No sRGB, gAMA or iCCP chunk: engines would bend the heights."""
    data = write_image(tmp_path / "a.png", samples("u2", 1)).read_bytes()
    chunks, at = [], 8
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at : at + 8])
        chunks.append(name)
        at += 12 + size
    assert not {b"sRGB", b"gAMA", b"iCCP", b"cICP"} & set(chunks)


def test_attributes_survive(tmp_path):
    path = write_image(tmp_path / "a.exr", samples("f4", 1), attributes={"shorewright:written": "10/01"})
    assert read_header(path).attributes["shorewright:written"] == "10/01"


class Mumbling:
    def geterror(self):
        raise UnicodeDecodeError("utf-8", b"\xff", 0, 1, "invalid start byte")


def test_geterror_may_raise():
    """It raised UnicodeDecodeError on damaged EXRs."""
    assert images.error_of(Mumbling()) == "damaged data"


def test_a_failed_write_leaves_nothing(tmp_path, monkeypatch):
    """An old picture stays, no part file is left, the reason is told."""
    path = write_image(tmp_path / "a.png", samples("u1", 3))
    old = path.read_bytes()

    def fail(*args, **options):
        args[0].write_bytes(b"half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(images, "encode", fail)
    with pytest.raises(BadInput, match="the disk is full"):
        write_image(path, samples("u1", 1))
    assert path.read_bytes() == old
    assert [f.name for f in tmp_path.iterdir()] == ["a.png"]


def test_a_png_cut_short_is_no_success(tmp_path, monkeypatch):
    """On a full disk OpenImageIO writes a part of a PNG and reports success."""
    import os

    real = os.path.getsize
    done = []

    def cut(path):
        done.append(real(path))
        os.truncate(path, real(path) - 20)
        return written(path)

    written = images.check_written
    monkeypatch.setattr(images, "check_written", cut)
    with pytest.raises(BadInput, match="cut short"):
        write_image(tmp_path / "a.png", samples("u2", 1))
    assert done
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("name", "told"), [("no/where/a.png", "cannot write"), ("a.jp2", "use one of"), ("a", "use one")]
)
def test_places_that_cannot_be_written(tmp_path, name, told):
    with pytest.raises(BadInput, match=told):
        write_image(tmp_path / name, samples("u1", 1))


def test_a_wrong_kind_of_samples_is_a_fault_of_the_program(tmp_path):
    for name, array in (("a.png", samples("f4", 1)), ("a.exr", samples("u2", 1)), ("a.exr", samples("f4", 5))):
        with pytest.raises(ValueError, match=r"samples|names"):
            write_image(tmp_path / name, array)


def adam7(array):
    """An interlaced 8-bit grey PNG, which OpenImageIO cannot write."""
    import zlib

    raw = b""
    for x, y, dx, dy in (
        (0, 0, 8, 8),
        (4, 0, 8, 8),
        (0, 4, 4, 8),
        (2, 0, 4, 4),
        (0, 2, 2, 4),
        (1, 0, 2, 2),
        (0, 1, 1, 2),
    ):
        part = array[y::dy, x::dx]
        if part.size:
            raw += b"".join(b"\0" + row.tobytes() for row in part)

    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    head = struct.pack(">IIBBBBB", array.shape[1], array.shape[0], 8, 0, 0, 0, 1)
    return images_signature() + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b"")


def images_signature():
    from shorewright.io.png_check import SIGNATURE

    return SIGNATURE


@pytest.mark.parametrize("shape", [(1, 1), (3, 5), (8, 8), (17, 23)])
def test_interlaced_png(tmp_path, shape):
    """The check before decoding knows how many bytes Adam7 takes at any size."""
    array = np.random.default_rng(0).integers(0, 256, shape, dtype=np.uint8)
    (tmp_path / "a.png").write_bytes(adam7(array))
    assert np.array_equal(read_image(tmp_path / "a.png")[..., 0], array)


@pytest.mark.parametrize(("suffix", "dtype"), [(".png", np.uint8), (".png", np.uint16), (".exr", np.float32)])
@pytest.mark.parametrize("channels", [1, 3])
def test_rows_at_a_time_are_the_same_picture(tmp_path, suffix, dtype, channels):
    """T09: written and read by blocks of any height, the file's samples are those of the whole picture."""
    from shorewright.io.image_rows import read_rows, write_rows

    rng = np.random.default_rng(2)
    picture = (rng.random((71, 33, channels)) * 200).astype(dtype)
    path = tmp_path / f"a{suffix}"
    write_rows(path, picture.shape, dtype, (picture[start : start + 16] for start in range(0, 71, 16)))
    np.testing.assert_array_equal(read_image(path), picture)
    slices = [slice(0, 7), slice(7, 40), slice(40, 71)]
    for rows, samples in read_rows(path, slices):
        assert samples.dtype == dtype
        np.testing.assert_array_equal(samples, picture[rows])
