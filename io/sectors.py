"""One sector of one layer as an EXR file that any image tool opens, and back.

Row 0 of the file is the **north** edge (top of the picture), the level's row 0 is south. A single map is channel `Y`,
two are R and G (with an empty B, since some readers want three), four are R, G, B and A, more are C4, C5 … besides;
float32, or half where that holds every sample exactly, ZIP. Which 128² tiles were written stands in the attribute
`shorewright:written`: one digit a tile, rows from south to north, parted by `/`. A tile counts as written when
its digit is 1 or any of its samples isn't zero, so a file that another tool has saved again loses nothing but tiles
painted with plain zero.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..level import BadInput
from ..level.grid import TILE
from .images import encode, load_image, read_header

WRITTEN = "shorewright:written"


def file_channels(count: int) -> int:
    """Channels in the file for so many in the layer."""
    return {1: 1, 2: 3}.get(count, count)


def write_sector(path: Path, samples: np.ndarray, half: bool, written: np.ndarray | None) -> None:
    """Write `(rows, cols)` or `(rows, cols, channels)` float32 samples; OSError when the disk refuses."""
    image = samples if samples.ndim == 3 else samples[..., None]
    if image.shape[2] == 2:
        image = np.concatenate([image, np.zeros_like(image[..., :1])], axis=2)
    attributes = {} if written is None else {WRITTEN: "/".join("".join("01"[t] for t in row) for row in written * 1)}
    more = image.shape[2] > 4
    names = [*"RGBA", *(f"C{n}" for n in range(4, image.shape[2]))] if more else None
    encode(path, image[::-1], channels=names, half=half, data=True, attributes=attributes)


def check_header(path: Path, shape: tuple[int, int], channels: int, older: tuple[int, ...] = ()) -> None:
    """BadInput unless the file is a sector of this size, or has the channels of an older one; takes no memory."""
    header = read_header(path)
    if (header.rows, header.cols) != shape:
        size = f"{header.cols} × {header.rows}"
        raise BadInput(f"{path} holds {size} samples where the level needs {shape[1]} × {shape[0]}")
    if len(header.channels) not in (file_channels(channels), *older):
        raise BadInput(f"{path} has {len(header.channels)} channels where its layer needs {file_channels(channels)}")


def read_sector(
    path: Path, shape: tuple[int, int], channels: int, older: tuple[int, ...] = ()
) -> tuple[np.ndarray, np.ndarray]:
    """(samples with row 0 south, written tiles) of a sector; BadInput when it is damaged, of another size, or has NaN.

    samples: float32 `(rows, cols)` or `(rows, cols, channels)`, a view; written: bool `(tile rows, tile cols)`.
    """
    header, image = load_image(path)
    if image.shape[2] in older:
        channels = image.shape[2]
    if image.shape[:2] != shape or image.shape[2] != file_channels(channels) or image.dtype != np.float32:
        raise BadInput(f"{path} holds {image.shape} samples where the level needs {(*shape, file_channels(channels))}")
    low, high = float(image.min()), float(image.max())  # NaN comes through both
    if not (np.isfinite(low) and np.isfinite(high)):
        bad = int((~np.isfinite(image)).sum())
        raise BadInput(f"{path} holds {bad} samples that are not numbers, so the sector is damaged")
    samples = image[::-1, :, 0] if channels == 1 else image[::-1, :, :channels]
    return samples, _written(str(header.attributes.get(WRITTEN, "")), samples)


def _written(text: str, samples: np.ndarray) -> np.ndarray:
    shape = -(-samples.shape[0] // TILE), -(-samples.shape[1] // TILE)
    written = np.zeros(shape, bool)
    lines = text.split("/")
    if len(lines) == shape[0] and all(len(line) == shape[1] for line in lines):
        written |= np.array([[digit == "1" for digit in line] for line in lines])
    for row, col in np.argwhere(~written):
        written[row, col] = samples[row * TILE : (row + 1) * TILE, col * TILE : (col + 1) * TILE].any()
    return written
