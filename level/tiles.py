"""Tiles of a layer as an atom of undo (T08): what changed in them, packed without loss.

Of every 128² tile only the cells whose bits differ are kept, so a stroke that grazes a tile costs what it changed.
Rough ground has few redundant bits: what compresses is the byte of sign and exponent, so the four byte planes are
packed apart (one stream for all cost a tenth more on white noise), as they are or as differences, whichever is less.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import zstandard

from .grid import Rect

if TYPE_CHECKING:
    from .layers import LayerData
    from .level import Level

PLANES = 4
HEADER = struct.Struct("<?4I")  # differences?, bytes of each plane

Tile = tuple[int, int]


def pack(values: np.ndarray) -> bytes:
    """Float32 samples of any shape as bytes: byte planes apart, raw or as differences along the samples, zstd."""
    bits = np.ascontiguousarray(values, np.float32).view(np.uint32).reshape(-1)
    if not bits.size:
        return b""
    delta = bits.copy()
    delta[1:] -= bits[:-1]
    squeeze = zstandard.ZstdCompressor(level=1).compress
    raw, differences = (
        [squeeze(np.ascontiguousarray(plane)) for plane in samples.view(np.uint8).reshape(-1, PLANES).T]
        for samples in (bits, delta)
    )
    smaller = sum(map(len, differences)) < sum(map(len, raw))
    planes = differences if smaller else raw
    return HEADER.pack(smaller, *map(len, planes)) + b"".join(planes)


def unpack(data: bytes, shape: tuple[int, ...]) -> np.ndarray:
    """The inverse of `pack`."""
    if not data:
        return np.zeros(shape, np.float32)
    differences, *sizes = HEADER.unpack_from(data)
    bits = np.empty(int(np.prod(shape)), np.uint32)
    planes, at = bits.view(np.uint8).reshape(-1, PLANES), HEADER.size
    for plane, size in enumerate(sizes):
        planes[:, plane] = np.frombuffer(zstandard.decompress(data[at : at + size]), np.uint8)
        at += size
    if differences:
        np.cumsum(bits, out=bits)
    return bits.view(np.float32).reshape(shape)


@dataclass
class Patch:
    """The far side of a swap for one tile: was it ever written there, which cells differ, what they hold."""

    written: bool
    cells: bytes  # a bit for every cell, zstd; empty = every cell
    values: bytes  # `pack` of those cells; empty where the far side was never written

    @property
    def bytes(self) -> int:
        return 64 + len(self.cells) + len(self.values)

    @staticmethod
    def between(old: np.ndarray | None, new: np.ndarray) -> Patch:
        """What leads from a tile as it is now back to `old` (None = never written)."""
        differ = new.view(np.uint32) != (0 if old is None else old.view(np.uint32))
        if differ.ndim == 3:
            differ = differ.any(axis=2)
        cells = b"" if differ.all() else zstandard.compress(np.packbits(differ).tobytes(), 1)
        return Patch(old is not None, cells, b"" if old is None else pack(old[differ]))

    def differ(self, shape: tuple[int, int]) -> np.ndarray:
        """The cells that differ, bool `(rows, cols)`."""
        if not self.cells:
            return np.ones(shape, bool)
        bits = np.frombuffer(zstandard.decompress(self.cells), np.uint8)
        return np.unpackbits(bits, count=shape[0] * shape[1]).reshape(shape).view(bool)

    def swap(self, data: LayerData, tile: Tile) -> Patch:
        """Put the far side into the layer and return the way back."""
        now = data.tile(tile)
        shape = data.grid.tile_rect(tile).shape
        differ = self.differ(shape)
        there = np.zeros(shape + data.shape[2:], np.float32) if now is None else now
        back = Patch(now is not None, self.cells, b"" if now is None else pack(there[differ]))
        if self.written:
            there[differ] = unpack(self.values, (int(differ.sum()), *there.shape[2:]))
        data.put_tile(tile, there if self.written else None)
        return back


@dataclass
class Tiles:
    """An atom: what the other side of the swap holds for some tiles of a layer.

    A tile may be handed in whole: as `pack` of all its samples, or None for never written.
    """

    layer: str
    held: dict[Tile, Patch]
    rect: Rect  # bounds of what changed
    bytes: int = field(init=False)  # counted once a swap: panels ask in every frame

    def __post_init__(self) -> None:
        for tile, whole in self.held.items():
            if not isinstance(whole, Patch):
                self.held[tile] = Patch(whole is not None, b"", whole or b"")
        self._count()

    def _count(self) -> None:
        self.bytes = sum(patch.bytes for patch in self.held.values())

    @staticmethod
    def settle(data: LayerData, kept: Mapping[Tile, tuple], rect: Rect) -> Tiles:
        """Make what a step left in the live array the stored tiles, and keep the way back to its snapshots."""
        held: dict[Tile, Patch] = {}
        for tile, snapshot in kept.items():
            stored, live = snapshot
            before = stored if live is None else live
            now = data.array[data.grid.tile_rect(tile).slices]
            if not (now.any() if before is None else (now != before).any()):
                continue
            data.settle(tile, snapshot)
            patch = Patch.between(stored, data.tile(tile))
            if patch.differ(now.shape[:2]).any():
                held[tile] = patch
            else:  # rounding took back what little had changed
                data.restore(tile, snapshot)
        return Tiles(data.row.name, held, rect)

    def swap(self, level: Level) -> None:
        data = level.layers[self.layer]
        for tile, patch in self.held.items():
            self.held[tile] = patch.swap(data, tile)
        self._count()
        for rect in data.grid.cover(self.held, self.rect):
            level.mark(self.layer, rect)
