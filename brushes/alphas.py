"""Alphas: grey pictures that shape a dab (T03), as text in a stroke's parameters, so that a script needs no file.

smoke 128 eNqt…        name, side in pixels, 8-bit rows from the north, deflated, base64
"""

from __future__ import annotations

import base64
import binascii
import re
import zlib
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

SIDE = 128  # pixels that are kept of a picture
MOST_SIDE = 256  # that a text may hold
MOST_TEXT = 200_000


@dataclass(frozen=True)
class Alpha:
    """`grey` float32 0 to 1 `(side, side)`, row 0 south as in every layer."""

    name: str
    grey: np.ndarray


def pack(name: str, grey: np.ndarray, side: int = SIDE) -> str:
    """A picture `(rows, cols)` 0 to 1, row 0 on top, as text: in the middle of a square, made smaller where needed."""
    rows, cols = grey.shape
    whole = max(rows, cols)
    square = np.zeros((whole, whole), np.float32)
    top, left = (whole - rows) // 2, (whole - cols) // 2
    square[top : top + rows, left : left + cols] = np.clip(grey, 0, 1)
    if whole > side:
        square = smaller(square, side)
    samples = np.rint(square * 255).astype(np.uint8)
    name = re.sub(r"[^\w.-]+", "_", name)[:40] or "alpha"
    return f"{name} {len(samples)} {base64.b64encode(zlib.compress(samples.tobytes(), 9)).decode()}"


@lru_cache(16)
def unpack(text: str) -> Alpha:
    """What `pack` packed; ValueError when the text is something else."""
    parts = text.split(" ")
    if len(parts) != 3 or not parts[1].isdigit() or len(text) > MOST_TEXT:
        raise ValueError("it is no packed picture: name, side and samples")
    name, side = parts[0], int(parts[1])
    if not 1 <= side <= MOST_SIDE:
        raise ValueError(f"a packed picture has 1 to {MOST_SIDE} pixels a side, not {side}")
    try:
        inflate = zlib.decompressobj()
        samples = inflate.decompress(base64.b64decode(parts[2], validate=True), side * side + 1)
    except (binascii.Error, zlib.error):
        raise ValueError(f"the packed picture {name} is damaged") from None
    if len(samples) != side * side:
        raise ValueError(f"the packed picture {name} has other samples than its side of {side} says")
    grey = np.frombuffer(samples, np.uint8).reshape(side, side)[::-1].astype(np.float32) / np.float32(255)
    grey.flags.writeable = False
    return Alpha(name, grey)


def checked(text: str) -> str:
    """The text, as it came, when it can be unpacked or is empty."""
    if text:
        unpack(text)
    return text


def smaller(square: np.ndarray, side: int) -> np.ndarray:
    """A square picture with fewer pixels, each the mean of what it covers."""
    for _ in range(2):  # rows, then the other way
        total = np.concatenate([np.zeros((1, square.shape[1])), np.cumsum(square, axis=0, dtype=np.float64)])
        at = np.linspace(0, len(square), side + 1)
        low = np.minimum(at.astype(int), len(square) - 1)
        edges = total[low] + (total[low + 1] - total[low]) * (at - low)[:, None]
        square = (np.diff(edges, axis=0) * (side / len(square))).T
    return np.ascontiguousarray(square, np.float32)
