"""The layer under a stroke: snapshots, masks and pieces, tile by tile.

The base of `base + s · m` is read from the snapshots that the undo step keeps anyway, and the mask is one small array a
tile: on 4097² that was faster than dense arrays of the level's size, whose fresh pages cost as much as the dab.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..level import TILE, Level, Rect
from ..level.grid import NOWHERE
from ..level.journal import Step
from .effects import Effect, Piece
from .footprint import Footprint, Link
from .masks import Mask
from .surroundings import Surroundings

BLOCK = 3 * TILE  # a dab within this is weighed at once, a larger one tile by tile


class Canvas:
    """What a stroke paints on: one layer of a level within an open undo step."""

    def __init__(
        self,
        level: Level,
        step: Step,
        layer: str,
        channels: tuple[int, ...],
        limits: Mask | None = None,
        surroundings: Surroundings | None = None,
    ) -> None:
        self.level = level
        self.limits = limits
        self.surroundings = surroundings
        self.step = step
        self.data = level.layers[layer]
        self.channels = channels
        self.masks: dict[tuple[int, int], np.ndarray] = {}
        self.painted: set[tuple[int, int]] = set()  # since the last rewind
        self.bounds = NOWHERE  # of everything the stroke wrote
        key = "brushes.scratch"
        if key not in level.derived:
            level.derived[key] = np.empty((3, BLOCK * BLOCK), np.float32)
        self._scratch = level.derived[key]

    # Reading

    def sample(self, row: float, col: float) -> np.ndarray:
        """The layer at a fractional cell, bilinear, held at the border or wrapped; float32 `(channels,)`."""
        rows, cols = self.data.grid.shape
        if self.data.grid.wraps:
            row0, col0 = math.floor(row), math.floor(col)
            near = np.stack([self.data.read(Rect(r % rows, c % cols, r % rows + 1, c % cols + 1))
                             for r in (row0, row0 + 1) for c in (col0, col0 + 1)])  # fmt: skip
        else:
            row, col = min(max(row, 0.0), rows - 1.0), min(max(col, 0.0), cols - 1.0)
            row0, col0 = min(int(row), rows - 2), min(int(col), cols - 2)
            near = self.data.read(Rect(row0, col0, row0 + 2, col0 + 2))
        near = near.astype(np.float64).reshape(2, 2, -1)
        south, north = near[:, 0] + (near[:, 1] - near[:, 0]) * (col - col0)
        return (south + (north - south) * (row - row0)).astype(np.float32)

    def window(self, rect: Rect, border: int, channel: int, base: bool = False) -> np.ndarray:
        """A copy of `rect` with a border, of one channel, as it is or (`base`) as the stroke found it.

        Outside the level the samples are mirrored through the edge sample, so that slopes go on; a torus goes round.
        """
        wide = rect.pad(border)
        if self.data.grid.wraps:
            return self._wrapped_window(wide, channel, base)
        inside = self.data.grid.clip(wide)
        values = _channel(self.data.read(inside), channel)
        values = self._as_found(values, inside, channel) if base else values
        missing = (
            (inside.row0 - wide.row0, wide.row1 - inside.row1),
            (inside.col0 - wide.col0, wide.col1 - inside.col1),
        )
        if not any(map(any, missing)):
            return values.copy()
        return np.pad(values, missing, "reflect", reflect_type="odd")

    def found(self, layer: str, rect: Rect, border: int = 0, channel: int = 0) -> np.ndarray:
        """A layer of the level's own grid as the stroke found it, with a border as `window` makes it."""
        if layer == self.data.row.name:
            return self.window(rect, border, channel, base=True)
        data, wide = self.level.layers[layer], rect.pad(border)
        inside = data.grid.clip(wide)
        missing = (
            (inside.row0 - wide.row0, wide.row1 - inside.row1),
            (inside.col0 - wide.col0, wide.col1 - inside.col1),
        )
        return np.pad(_channel(data.read(inside), channel), missing, "reflect", reflect_type="odd")

    def _wrapped_window(self, wide: Rect, channel: int, base: bool) -> np.ndarray:
        out = np.empty(wide.shape, np.float32)
        for asked, held in self.data.grid.laps(wide):
            values = _channel(self.data.read(held), channel)
            out[_inside(asked, wide)] = self._as_found(values, held, channel) if base else values
        return out

    def _as_found(self, values: np.ndarray, rect: Rect, channel: int) -> np.ndarray:
        values = values.copy()
        kept = self.step.snapshots.get(self.data.row.name, {})
        for tile in self.data.grid.tiles(rect):
            if tile in kept:
                whole = self.data.grid.tile_rect(tile)
                part = whole.intersect(rect)
                values[_inside(part, rect)] = _channel(self._base(tile)[_inside(part, whole)], channel)
        return values

    def _base(self, tile: tuple[int, int]) -> np.ndarray:
        """A saved tile as the stroke found it."""
        stored, live = self.step.snapshots[self.data.row.name][tile]
        base = stored if live is None else live
        shape = self.data.grid.tile_rect(tile).shape + self.data.shape[2:]
        return np.broadcast_to(np.float32(0), shape) if base is None else base

    # Writing

    def rewind(self) -> list[Rect]:
        """Put back what was painted, for a path whose dabs replace each other; returns what that changed."""
        rects = self.data.grid.cover(self.painted, self.bounds)
        for tile in self.painted:
            self.data.array[self.data.grid.tile_rect(tile).slices] = self._base(tile)
        self.painted.clear()
        return rects

    def paint(self, link: Link, footprint: Footprint, effect: Effect, masked: bool) -> list[Rect]:
        """One dab; returns the rectangles it touched."""
        whole = footprint.rect(link, self.data.grid)
        if whole.empty:
            return []
        effect.prepare(self, whole, link)
        rects = []
        for asked, held in self._blocks(whole, link, footprint):
            self.step.save(self.data, held)
            out, *spare = (flat[: asked.cells].reshape(asked.shape) for flat in self._scratch)
            weight = footprint.weights(link, asked, out, *spare)
            if self.limits:
                self.limits.hold(self, held, weight)
            for piece in self._pieces(asked, held, weight, spare[0], link, masked):
                effect.write(piece)
            rects.append(held)
            self.bounds = self.bounds.union(held)
        return rects

    def _blocks(self, rect: Rect, link: Link, footprint: Footprint) -> Iterator[tuple[Rect, Rect]]:
        """Where the dab is, and where its cells lie: the same but on a grid that wraps."""
        for asked, held in self.data.grid.laps(rect):
            if max(rect.shape) <= BLOCK:
                yield asked, held
                continue
            for tile in self.data.grid.tiles(held):
                part = self.data.grid.tile_rect(tile).intersect(held)
                block = _moved(part, held, asked)
                if not footprint.misses(link, block):
                    yield block, part

    def _pieces(
        self, asked: Rect, held: Rect, weight: np.ndarray, spare: np.ndarray, link: Link, masked: bool
    ) -> Iterator[Piece]:
        array = self.data.array
        for tile in self.data.grid.tiles(held):
            whole = self.data.grid.tile_rect(tile)
            part = whole.intersect(held)
            in_tile, in_block = _inside(part, whole), _inside(part, held)
            here = weight[in_block]
            mask = self._mask(tile, whole, in_tile, here) if masked else here
            base, live = self._base(tile)[in_tile], array[part.slices]
            self.painted.add(tile)
            for channel in self.channels:
                yield Piece(
                    _moved(part, held, asked),
                    channel,
                    link,
                    _channel(base, channel),
                    mask,
                    here,
                    _channel(live, channel),
                    spare[in_block],
                    base,
                )

    def _mask(self, tile: tuple[int, int], whole: Rect, in_tile: tuple, weight: np.ndarray) -> np.ndarray:
        mask = self.masks.get(tile)
        if mask is None:
            mask = self.masks[tile] = np.zeros(whole.shape, np.float32)
        here = mask[in_tile]
        return np.maximum(here, weight, out=here)


def _inside(part: Rect, whole: Rect) -> tuple[slice, slice]:
    """Slices of `part` in an array that holds `whole`."""
    return (
        slice(part.row0 - whole.row0, part.row1 - whole.row0),
        slice(part.col0 - whole.col0, part.col1 - whole.col0),
    )


def _moved(part: Rect, held: Rect, asked: Rect) -> Rect:
    """`part` of `held` as a part of `asked`, the same cells counted from elsewhere."""
    row, col = asked.row0 - held.row0, asked.col0 - held.col0
    return Rect(part.row0 + row, part.col0 + col, part.row1 + row, part.col1 + col)


def _channel(values: np.ndarray, channel: int) -> np.ndarray:
    return values if values.ndim == 2 else values[..., channel]
