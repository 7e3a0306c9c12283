"""Large images a few rows at a time: neither the whole picture nor the whole file lies in memory.

write_rows(path, (rows, cols, 3), np.uint16, blocks)     # blocks: arrays of rows, from the top
for rows, samples in read_rows(path, slices): ...
with open_rows(path) as image: image.header, image.read(rows)
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..level import BadInput
from .images import Header, check_written, damaged, error_of, header_of, kind_of, open_image, set_attributes
from .transaction import disk_reason

NAMES = {1: "Y", 3: "RGB", 4: "RGBA"}


def write_rows(path: Path, shape: tuple[int, int, int], dtype: type, blocks: Iterable[np.ndarray]) -> None:
    """`(rows, cols, channels)` samples without colour tags; `blocks` hold its rows from the top.

    As `write_image`: the file appears whole or not at all, BadInput when the disk refuses.
    """
    part = path.with_name(f".{path.name}.part{path.suffix}")
    try:
        _encode(part, shape, np.dtype(dtype), blocks)
        os.replace(part, path)
    except OSError as error:
        raise BadInput(f"cannot write {path}: {disk_reason(error, path.parent)}") from None
    finally:
        with contextlib.suppress(OSError):
            part.unlink()


def _encode(path: Path, shape: tuple[int, int, int], dtype: np.dtype, blocks: Iterable[np.ndarray]) -> None:
    import OpenImageIO

    rows, cols, count = shape
    kind = kind_of(path, dtype)
    spec = OpenImageIO.ImageSpec(cols, rows, count, kind)
    spec.channelnames = tuple(NAMES[count])
    set_attributes(spec, path, kind, True, {})
    output = OpenImageIO.ImageOutput.create(str(path))
    done = output.open(str(path), spec)
    row = 0
    for block in blocks if done else ():
        pixels = np.ascontiguousarray(block, dtype)
        done = done and output.write_scanlines(row, row + len(pixels), 0, pixels)
        row += len(pixels)
        if not done:
            break
    reason = error_of(output)
    closed = output.close()
    if not (done and closed and row == rows):
        raise OSError(0, reason or error_of(output) or "the image was not written")
    if path.suffix.lower() == ".png":
        check_written(path)


@dataclass(frozen=True)
class ImageRows:
    """An image that is open, to be read some rows at a time."""

    path: Path
    header: Header
    image: Any

    @property
    def shape(self) -> tuple[int, int, int]:
        return self.header.rows, self.header.cols, len(self.header.channels)

    @property
    def dtype(self) -> np.dtype:
        """Of the samples that `read` returns."""
        return np.dtype(self.header.dtype if self.header.whole else np.float32)

    def read(self, rows: slice) -> np.ndarray:
        """The samples of those rows, as `read_image` has them; BadInput when they are damaged or not there."""
        wanted, (_, cols, channels) = self.header.dtype if self.header.whole else "float", self.shape
        try:
            pixels = self.image.read_scanlines(rows.start, rows.stop, 0, 0, channels, wanted)
        except Exception as error:  # the binding raises what it likes
            raise damaged(self.path, str(error)) from None
        reason = error_of(self.image)
        if pixels is None or reason:
            raise damaged(self.path, reason)
        return pixels.reshape(rows.stop - rows.start, cols, channels)


@contextlib.contextmanager
def open_rows(path: Path) -> Iterator[ImageRows]:
    """The image open for reading; BadInput when it is none."""
    image = open_image(path)
    with contextlib.closing(image):
        yield ImageRows(path, header_of(path, image), image)


def read_rows(path: Path, slices: Iterable[slice]) -> Iterator[tuple[slice, np.ndarray]]:
    """The samples of those rows, as `read_image` has them; BadInput when the image is damaged or has fewer rows."""
    with open_rows(path) as image:
        for rows in slices:
            yield rows, image.read(rows)
