"""How a level lies in the square height maps an engine takes: sample for sample from one corner, tiled, or resampled.

Sample for sample loses nothing: a level smaller than its square lies in one corner, and beyond it the edge goes on,
which as seabed surprises nobody. Stretching it over the square would put the landscape's samples between the level's
and blunt every peak; other spacings east than north would turn brushes into ellipses. `resample` is for levels that
have to be of another size all the same: the longer side takes the whole of a legal one, and the error is told.
Tiles share their edge samples and one height range (research, authoring 4).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...level import BadInput
from . import maps
from .engine_records import Options, Part, Resampling

MOST_TILES = 1024  # a manifest lists them all
SPARE = 8  # tiles may reach beyond the level by an eighth of its longer side


class Tile(NamedTuple):
    """One file: the fractional rows and columns of the level that its samples read."""

    row: int
    col: int
    rows_at: np.ndarray
    cols_at: np.ndarray


@dataclass(frozen=True)
class Layout:
    """`rows_at` and `cols_at` are over all tiles, in the order of the files' rows; `step` is level samples a sample."""

    side: int
    tile_rows: int
    tile_cols: int
    spacing_m: float
    rows_at: np.ndarray
    cols_at: np.ndarray
    shape: tuple[int, int]
    north_first: bool
    step: float = 1.0

    @property
    def resampled(self) -> bool:
        return self.step != 1.0

    @property
    def tiled(self) -> bool:
        return self.tile_rows * self.tile_cols > 1

    @property
    def part_rows(self) -> int:
        """File rows that hold the level."""
        return int((self.shape[0] - 1) / self.step + 1e-9) + 1

    @property
    def part_cols(self) -> int:
        return int((self.shape[1] - 1) / self.step + 1e-9) + 1

    @property
    def whole(self) -> bool:
        """Whether nothing but the level is in it."""
        return (self.part_rows, self.part_cols) == (len(self.rows_at), len(self.cols_at))

    @property
    def outside(self) -> str:
        return "the whole square is the level" if self.whole else "continues the edge of the level"

    @property
    def extent_m(self) -> tuple[float, float]:
        """The level's own (east, north)."""
        rows, cols = self.shape
        return (cols - 1) / self.step * self.spacing_m, (rows - 1) / self.step * self.spacing_m

    def part(self) -> Part:
        east, deep = self.extent_m
        corner = "north-west" if self.north_first else "south-west"
        return Part(
            cols=self.part_cols, rows=self.part_rows, east_m=east, deep_m=deep, corner=corner, outside=self.outside
        )

    def tiles(self) -> Iterator[Tile]:
        """Row by row, as the files' rows go."""
        for row in range(self.tile_rows):
            for col in range(self.tile_cols):
                first = row * (self.side - 1), col * (self.side - 1)
                rows_at, cols_at = (
                    at[start : start + self.side] for at, start in zip((self.rows_at, self.cols_at), first, strict=True)
                )
                yield Tile(row, col, rows_at, cols_at)


def lay_out(
    shape: tuple[int, int], cell_m: float, sizes: tuple[int, ...], options: Options, north_first: bool, tiles: bool
) -> Layout:
    """The layout that a target with these legal `sizes` gets; BadInput when the level is larger than all of them."""
    longer = max(shape)
    if options.tile is not None and (options.tile not in sizes or not tiles):
        raise BadInput(f"a tile of {options.tile} samples a side is none that this target takes")
    fits = next((size for size in sizes if size >= longer), None)
    if options.resample:
        return _stretched(shape, cell_m, fits or sizes[-1], north_first)
    if options.tile is None and fits is None and not tiles:
        raise BadInput(
            f"this level has {longer} samples along its longer side and the largest height map here has {sizes[-1]}: "
            "crop or resize it first (`shorewright crop`, `shorewright resize`), or export with --resample"
        )
    side = options.tile or fits or tile_side(longer, sizes)
    counts = [-(-(n - 1) // (side - 1)) for n in shape]
    if counts[0] * counts[1] > MOST_TILES:
        raise BadInput(f"{counts[1]} × {counts[0]} tiles of {side} samples are too many: at most {MOST_TILES}")
    north, east = (np.minimum(np.arange(c * (side - 1) + 1.0), n - 1) for c, n in zip(counts, shape, strict=True))
    north = (shape[0] - 1) - north if north_first else north
    return Layout(side, counts[0], counts[1], cell_m, north, east, shape, north_first)


def plain_layout(shape: tuple[int, int], cell_m: float) -> Layout:
    """The level itself, north first, as one picture."""
    rows, cols = shape
    return Layout(max(shape), 1, 1, cell_m, np.arange(rows - 1.0, -1, -1), np.arange(float(cols)), shape, True)


def tile_side(samples: int, sizes: tuple[int, ...]) -> int:
    """The largest tile that spends little beyond the level, else the one that spends least."""

    def beyond(size: int) -> int:
        return -(-(samples - 1) // (size - 1)) * (size - 1) - (samples - 1)

    good = [size for size in sizes if beyond(size) * SPARE <= samples]
    return max(good) if good else min(sizes, key=beyond)


def _stretched(shape: tuple[int, int], cell_m: float, side: int, north_first: bool) -> Layout:
    """The longer side over all of `side` samples, the shorter one as far as it reaches."""
    along = np.linspace(0, max(shape) - 1, side)
    north, east = np.minimum(along, shape[0] - 1), np.minimum(along, shape[1] - 1)
    north = (shape[0] - 1) - north if north_first else north
    step = (max(shape) - 1) / (side - 1)
    return Layout(side, 1, 1, cell_m * step, north, east, shape, north_first, step)


def resampling(layout: Layout, height: np.ndarray, cell_m: float) -> Resampling | None:
    """The ground between the resampled samples against the level's own samples; None when none is lost."""
    if not layout.resampled:
        return None
    kept = np.empty((len(layout.rows_at), len(layout.cols_at)), np.float32)
    for block, values in maps.bilinear(height, layout.rows_at, layout.cols_at):
        kept[block] = values
    rows, cols = layout.shape
    north = np.arange(rows)[::-1] if layout.north_first else np.arange(rows)
    there = maps.bilinear(kept, north / layout.step, np.arange(cols) / layout.step)
    worst, rms = maps.differences(there, maps.row_blocks(height))
    return Resampling(
        from_cols=cols, from_rows=rows, from_cell_m=cell_m, max_error_cm=100 * worst, rms_error_cm=100 * rms
    )
