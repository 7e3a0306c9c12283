"""Metres, cells, tiles and sectors: the only place with that arithmetic.

Samples sit **at vertices**: N samples span N - 1 intervals. Sample (0, 0) is the south-west one and stands at world
(0, 0); x runs east along columns, y north along rows, both in metres. Row 0 is south in memory.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

from .errors import BadInput

TILE = 128  # cells a side: the unit of undo, sparsity and revision
SECTOR = 1024  # cells a side: the unit of files
MAX_SIDE = 16385


class Rect(NamedTuple):
    """A half-open rectangle of cells: rows row0..row1 - 1, columns col0..col1 - 1."""

    row0: int
    col0: int
    row1: int
    col1: int

    @property
    def slices(self) -> tuple[slice, slice]:
        return slice(self.row0, self.row1), slice(self.col0, self.col1)

    @property
    def tiles(self) -> tuple[slice, slice]:
        """The tiles it touches, as slices of the grid of tiles (`LayerData.written`)."""
        return slice(self.row0 // TILE, -(-self.row1 // TILE)), slice(self.col0 // TILE, -(-self.col1 // TILE))

    @property
    def shape(self) -> tuple[int, int]:
        return max(self.row1 - self.row0, 0), max(self.col1 - self.col0, 0)

    @property
    def empty(self) -> bool:
        return self.row1 <= self.row0 or self.col1 <= self.col0

    @property
    def cells(self) -> int:
        rows, cols = self.shape
        return rows * cols

    def union(self, other: Rect) -> Rect:
        if self.empty:
            return other
        if other.empty:
            return self
        return Rect(
            min(self.row0, other.row0),
            min(self.col0, other.col0),
            max(self.row1, other.row1),
            max(self.col1, other.col1),
        )

    def intersect(self, other: Rect) -> Rect:
        return Rect(
            max(self.row0, other.row0),
            max(self.col0, other.col0),
            min(self.row1, other.row1),
            min(self.col1, other.col1),
        )

    def pad(self, cells: int) -> Rect:
        return Rect(self.row0 - cells, self.col0 - cells, self.row1 + cells, self.col1 + cells)

    def shifted(self, window: Rect) -> Rect:
        """The same cells counted from the corner of `window`."""
        return Rect(self.row0 - window.row0, self.col0 - window.col0, self.row1 - window.row0, self.col1 - window.col0)


NOWHERE = Rect(0, 0, 0, 0)


@dataclass(frozen=True)
class Grid:
    """A rectangle of square cells: `rows` × `cols` samples, `cell_m` metres apart; sample (0, 0) stands at `origin_m`.

    One that `wraps` goes on after its last sample with its first, east and north.
    """

    rows: int
    cols: int
    cell_m: float = 1.0
    origin_m: tuple[float, float] = (0.0, 0.0)
    wraps: bool = False

    def __post_init__(self) -> None:
        if not (2 <= self.rows <= MAX_SIDE and 2 <= self.cols <= MAX_SIDE):
            raise BadInput(f"a level of {self.cols} × {self.rows} samples is outside 2 to {MAX_SIDE} a side")
        if not (math.isfinite(self.cell_m) and 0.001 <= self.cell_m <= 100_000):
            raise BadInput(f"a cell of {self.cell_m} m is outside 0.001 to 100000 m")

    @property
    def shape(self) -> tuple[int, int]:
        return self.rows, self.cols

    @property
    def extent_m(self) -> tuple[float, float]:
        """Metres (east, north) from the first to the last sample, of a grid that wraps to where it begins again."""
        ends = 0 if self.wraps else 1
        return (self.cols - ends) * self.cell_m, (self.rows - ends) * self.cell_m

    @property
    def rect(self) -> Rect:
        return Rect(0, 0, self.rows, self.cols)

    @property
    def tile_shape(self) -> tuple[int, int]:
        return -(-self.rows // TILE), -(-self.cols // TILE)

    def clip(self, rect: Rect) -> Rect:
        return rect.intersect(self.rect)

    def to_cells(self, x_m, y_m):
        """Fractional (row, column) of a world point; works on arrays."""
        east_m, north_m = self.origin_m
        return (y_m - north_m) / self.cell_m, (x_m - east_m) / self.cell_m

    def nearest(self, x: float, y: float) -> tuple[int, int]:
        """Row and column of the sample nearest to a world place; that of the border beyond it."""
        return tuple(min(max(round((v - o) / self.cell_m), 0), n - 1)
                     for v, o, n in zip((y, x), self.origin_m[::-1], self.shape, strict=True))  # fmt: skip

    def to_metres(self, row, col):
        """World (x, y) of a (row, column); works on arrays."""
        east_m, north_m = self.origin_m
        return col * self.cell_m + east_m, row * self.cell_m + north_m

    def rect_along(self, row0: float, col0: float, row1: float, col1: float, reach: float) -> Rect:
        """The cells within `reach` cells of a line between two fractional cells, clipped to the level.

        On a grid that wraps they run on past its border (`laps`), no farther than once round.
        """
        rect = Rect(
            math.ceil(min(row0, row1) - reach),
            math.ceil(min(col0, col1) - reach),
            math.floor(max(row0, row1) + reach) + 1,
            math.floor(max(col0, col1) + reach) + 1,
        )
        return self._once_round(rect) if self.wraps else self.clip(rect)

    def _once_round(self, rect: Rect) -> Rect:
        """The middle of a rectangle that is wider than the torus."""
        row0 = max(rect.row0, (rect.row0 + rect.row1 - self.rows) // 2)
        col0 = max(rect.col0, (rect.col0 + rect.col1 - self.cols) // 2)
        return Rect(row0, col0, min(rect.row1, row0 + self.rows), min(rect.col1, col0 + self.cols))

    def laps(self, rect: Rect) -> Iterator[tuple[Rect, Rect]]:
        """The parts of a rectangle that may run past the border: where each is asked for, and where its cells lie.

        Without wrapping that is the part inside.
        """
        if not self.wraps:
            inside = self.clip(rect)
            if not inside.empty:
                yield inside, inside
            return
        for row0, row1 in _rounds(rect.row0, rect.row1, self.rows):
            for col0, col1 in _rounds(rect.col0, rect.col1, self.cols):
                row, col = row0 % self.rows, col0 % self.cols
                yield Rect(row0, col0, row1, col1), Rect(row, col, row + row1 - row0, col + col1 - col0)

    def tiles(self, rect: Rect) -> Iterator[tuple[int, int]]:
        """(tile row, tile column) of every tile that `rect` touches."""
        rect = self.clip(rect)
        if rect.empty:
            return
        for tile_row in range(rect.row0 // TILE, (rect.row1 - 1) // TILE + 1):
            for tile_col in range(rect.col0 // TILE, (rect.col1 - 1) // TILE + 1):
                yield tile_row, tile_col

    def tile_rect(self, tile: tuple[int, int]) -> Rect:
        return self.clip(Rect(tile[0] * TILE, tile[1] * TILE, (tile[0] + 1) * TILE, (tile[1] + 1) * TILE))

    def cover(self, tiles: Iterable[tuple[int, int]], within: Rect | None = None) -> list[Rect]:
        """Few disjoint rectangles that hold exactly these tiles, cut to `within`."""
        runs: list[Rect] = []  # of tiles: first along rows, then runs of the same columns stacked
        for row, col in sorted(tiles):
            if runs and runs[-1].row0 == row and runs[-1].col1 == col:
                runs[-1] = runs[-1]._replace(col1=col + 1)
            else:
                runs.append(Rect(row, col, row + 1, col + 1))
        stacked: dict[tuple[int, int, int], Rect] = {}
        for run in runs:
            below = stacked.pop((run.row0, run.col0, run.col1), run)
            stacked[run.row1, run.col0, run.col1] = below._replace(row1=run.row1)
        rects = (Rect(*(TILE * side for side in run)).intersect(within or self.rect) for run in stacked.values())
        return [self.clip(rect) for rect in rects if not rect.empty]

    @property
    def sector_shape(self) -> tuple[int, int]:
        """Sectors (rows, columns); the last of each takes the closing row or column too."""
        return max((self.rows - 2) // SECTOR, 0) + 1, max((self.cols - 2) // SECTOR, 0) + 1

    def sector_rect(self, sector: tuple[int, int]) -> Rect:
        sector_rows, sector_cols = self.sector_shape
        row1 = self.rows if sector[0] == sector_rows - 1 else (sector[0] + 1) * SECTOR
        col1 = self.cols if sector[1] == sector_cols - 1 else (sector[1] + 1) * SECTOR
        return Rect(sector[0] * SECTOR, sector[1] * SECTOR, row1, col1)

    def sectors_at(self, rect: Rect) -> tuple[slice, slice]:
        """The sectors that a rectangle (not empty, inside the level) touches, as slices of the grid of sectors."""
        rows, cols = self.sector_shape
        return (
            slice(min(rect.row0 // SECTOR, rows - 1), min((rect.row1 - 1) // SECTOR, rows - 1) + 1),
            slice(min(rect.col0 // SECTOR, cols - 1), min((rect.col1 - 1) // SECTOR, cols - 1) + 1),
        )

    def sectors(self) -> Iterator[tuple[int, int]]:
        sector_rows, sector_cols = self.sector_shape
        for sector_row in range(sector_rows):
            for sector_col in range(sector_cols):
                yield sector_row, sector_col


def _rounds(first: int, end: int, side: int) -> Iterator[tuple[int, int]]:
    """A run of whole numbers cut at the multiples of `side`."""
    while first < end:
        stop = min(end, (first // side + 1) * side)
        yield first, stop
        first = stop
