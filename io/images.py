"""Images through OpenImageIO, with every trap of that road guarded.

`write_image` writes what was asked or raises. OpenImageIO reports success on 2-D arrays it wrote as garbage and on a
PNG that a full disk cut short, takes the last channel of a 2- or 4-channel PNG for alpha and multiplies with it, stamps
the current date into files, tags 16-bit PNG as sRGB, and its `geterror()` can raise. Row 0 of every array here is the
**top** of the picture.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..level import BadInput
from ..level.grid import MAX_SIDE
from .transaction import disk_reason

WRITABLE = (".png", ".exr", ".tif", ".tiff", ".jpg")
READABLE = (*WRITABLE, ".bmp", ".jpeg", ".tga", ".hdr")
FITS = {".png": ("uint8", "uint16"), ".exr": ("float", "half"), ".jpg": ("uint8",)}
MAX_CHANNELS = 32


@dataclass(frozen=True)
class Header:
    """What a picture says about itself before a sample is decoded; `dtype` is how the file stores a sample."""

    rows: int
    cols: int
    channels: tuple[str, ...]
    dtype: str
    attributes: dict[str, object] = field(default_factory=dict)

    @property
    def whole(self) -> bool:
        """Whether samples are whole numbers."""
        return "int" in self.dtype


def read_header(path: Path | str) -> Header:
    """Size, channels and attributes of an image without decoding it; BadInput when it is none."""
    image = open_image(Path(path))
    with contextlib.closing(image):
        return header_of(Path(path), image)


def read_image(path: Path | str) -> np.ndarray:
    """The samples of an image as stored: `(rows, cols, channels)` integers or float32, row 0 on top.

    Half and double become float32. BadInput when the file is missing, damaged, no image, or larger than a level can be.
    """
    return load_image(path)[1]


def load_image(path: Path | str) -> tuple[Header, np.ndarray]:
    """Header and samples of an image, read in one opening."""
    path = Path(path)
    image = open_image(path)
    with contextlib.closing(image):
        header = header_of(path, image)
        wanted = header.dtype if header.whole else "float"  # asked for floats, integers would come normalised
        try:
            pixels = image.read_image(wanted)
        except Exception as error:  # D-traps: the binding raises what it likes
            raise damaged(path, str(error)) from None
        reason = error_of(image)
        if pixels is None or reason:
            raise damaged(path, reason)
    if pixels.shape != (header.rows, header.cols, len(header.channels)):
        raise damaged(path, "its samples do not fill its declared size")
    return header, pixels


def write_image(
    path: Path | str,
    array: np.ndarray,
    *,
    channels: Sequence[str] | None = None,
    half: bool = False,
    data: bool | None = None,
    attributes: Mapping[str, object] | None = None,
) -> Path:
    """Write `(rows, cols)` or `(rows, cols, channels)` samples, row 0 on top; the file appears whole or not at all.

    uint8 and uint16 go to PNG or TIFF, uint8 also to JPEG, float32 to EXR (ZIP; `half` for 16 bits) or TIFF. `data`
    True leaves out colour tags, the default for all but uint8. `channels` names them, by default Y, RG, RGB or RGBA.
    BadInput when the disk refuses.
    """
    path = Path(path)
    part = path.with_name(f".{path.name}.part{path.suffix}")
    try:
        encode(part, array, channels=channels, half=half, data=data, attributes=attributes)
        os.replace(part, path)
    except OSError as error:
        raise BadInput(f"cannot write {path}: {disk_reason(error, path.parent)}") from None
    finally:
        with contextlib.suppress(OSError):
            part.unlink()
    return path


def encode(path: Path, array: np.ndarray, *, channels=None, half=False, data=None, attributes=None) -> None:
    """`write_image` straight to its final name, OSError when that fails: for callers with a transaction."""
    import OpenImageIO

    pixels = np.ascontiguousarray(array if array.ndim == 3 else array[..., None])
    kind = kind_of(path, pixels.dtype, half)
    names = tuple(channels or {1: "Y", 2: "RG", 3: "RGB", 4: "RGBA"}.get(pixels.shape[2], ()))
    if len(names) != pixels.shape[2]:
        raise ValueError(f"{pixels.shape[2]} channels need as many names, not {names}")
    spec = OpenImageIO.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], kind)
    spec.channelnames = names
    set_attributes(spec, path, kind, data, attributes or {})
    output = OpenImageIO.ImageOutput.create(str(path))
    if output is None:
        raise OSError(0, f"no writer for {path.suffix} ({_global_error()})")
    done = output.open(str(path), spec) and output.write_image(pixels)
    reason = error_of(output)
    closed = output.close()
    if not (done and closed):
        raise OSError(0, reason or error_of(output) or "the image was not written")
    if path.suffix.lower() == ".png":
        check_written(path)


def check_written(path: Path) -> None:
    """OSError for a PNG cut short: on a full disk OpenImageIO writes as much as fits and reports success."""
    from .png_check import check_png

    try:
        check_png(path)
    except BadInput as error:
        raise OSError(0, str(error)) from None


def kind_of(path: Path, dtype: np.dtype, half: bool = False) -> str:
    """OpenImageIO's name for how a file stores samples of this type; an error where it can't."""
    suffix = path.suffix.lower()
    if suffix not in WRITABLE:
        raise BadInput(f"cannot write {path.name}: use one of {', '.join(WRITABLE)}")
    kind = {"uint8": "uint8", "uint16": "uint16", "float32": "float", "float16": "half"}.get(dtype.name)
    fits = FITS.get(suffix, ("uint8", "uint16", "float"))
    if kind not in fits:
        raise ValueError(f"{dtype} samples do not go into {suffix}")
    return "half" if half and suffix == ".exr" else kind


def set_attributes(spec, path: Path, kind: str, data: bool | None, attributes: Mapping[str, object]) -> None:
    """Compression, colour tags and no clock, as all files of ours have them."""
    suffix = path.suffix.lower()
    if suffix != ".png":
        spec.attribute("compression", "jpeg:88" if suffix == ".jpg" else "zip")
        spec.attribute("DateTime", "")  # otherwise the clock gets into the bytes
    data = kind != "uint8" if data is None else data
    if suffix != ".exr":
        spec.attribute("oiio:ColorSpace", "data" if data else "srgb_rec709_scene")
    if suffix == ".png":
        spec.attribute("oiio:UnassociatedAlpha", 1)  # or the last of 2 or 4 channels is multiplied in
    for name, value in attributes.items():
        spec.attribute(name, value)


def open_image(path: Path):
    """An opened ImageInput, sizes checked; BadInput otherwise."""
    import OpenImageIO

    _check_file(path)
    if path.suffix.lower() == ".png":
        from .png_check import check_png

        check_png(path)
    config = OpenImageIO.ImageSpec()
    config.attribute("oiio:UnassociatedAlpha", 1)
    config.attribute("oiio:RawColor", 1)
    try:
        image = OpenImageIO.ImageInput.open(str(path), config)
    except Exception as error:
        raise damaged(path, str(error)) from None
    if image is None:
        raise damaged(path, _global_error())
    return image


def _check_file(path: Path) -> None:
    try:
        if not path.exists():
            raise BadInput(f"{path} does not exist")
        if not path.is_file():
            raise BadInput(f"{path} is not a file, so it cannot be read as an image")
        if path.suffix.lower() not in READABLE:
            raise BadInput(f"{path} is not an image that can be read: use one of {', '.join(READABLE)}")
        with path.open("rb") as file:
            if not file.read(1):
                raise BadInput(f"{path} is empty")
    except OSError as error:
        raise BadInput(f"{path} cannot be read: {error.strerror}") from None


def header_of(path: Path, image) -> Header:
    """What an opened image says of itself; BadInput when no level can be that."""
    spec = image.spec()
    if spec.width > MAX_SIDE or spec.height > MAX_SIDE or spec.depth > 1:
        raise BadInput(f"{path} declares {spec.width} × {spec.height} samples; at most {MAX_SIDE} a side can be read")
    if spec.width < 1 or spec.height < 1 or not 1 <= spec.nchannels <= MAX_CHANNELS:
        raise damaged(path, f"it declares {spec.width} × {spec.height} samples of {spec.nchannels} channels")
    if spec.deep:
        raise BadInput(f"{path} is a deep image, which holds no plain samples: flatten it first")
    attributes = {}
    for item in spec.extra_attribs:
        with contextlib.suppress(Exception):  # text that isn't UTF-8 raises
            attributes[item.name] = item.value
    return Header(spec.height, spec.width, tuple(spec.channelnames), str(spec.format), attributes)


def error_of(thing) -> str:
    """What OpenImageIO says went wrong, on one line; reading it may itself raise (UnicodeDecodeError)."""
    try:
        return _line(thing.geterror())
    except Exception:
        return "damaged data"


def _global_error() -> str:
    """The pending global error; left unread, OpenImageIO prints it when the program ends."""
    import OpenImageIO

    return error_of(OpenImageIO)


def _line(text: str) -> str:
    text = " ".join(text.split()).rstrip(".")
    return text if len(text) <= 160 else text[:157] + "…"


def damaged(path: Path, reason: str) -> BadInput:
    """The sentence about an image that cannot be read."""
    if "limits:resolution" in reason or "limits:imagesize" in reason:
        return BadInput(f"{path} declares more samples than can be read: at most {MAX_SIDE} a side")
    reason = _line(reason).replace(str(path), path.name)
    return BadInput(f"{path} cannot be read as an image; it is damaged or of another kind ({reason or 'unnamed'})")
