"""The ground as 16-bit height maps without a header, one file a tile, and the places to check them by."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...level.beat import beat
from . import maps
from .earlier import Piece
from .job import Job
from .layout import Layout, Tile, resampling
from .manifest import describe_file
from .records import Channel, Decode, FileRecord, Probe

PROBES = 5  # a side


@dataclass(frozen=True)
class Words:
    """How an engine reads 16 bits: metres over the sea are `low_m + word * step_m`, and `decode` is its own formula."""

    low_m: float
    step_m: float
    formula: str
    numbers: dict[str, float]
    decode: Callable[[np.ndarray], np.ndarray]
    unit: str = "m"
    neutral: float | None = None


def write_heights(job: Job, layout: Layout, words: Words, name_of: Callable[[Tile], str], doc: str) -> Piece:
    """All tiles of the ground; each record's error is that of the bytes against the ground they were made from."""
    height, sea = job.level.height, job.level.sea_level_m
    lost = resampling(layout, height, job.level.grid.cell_m)
    files = []
    for tile in layout.tiles():
        path = job.folder / name_of(tile)
        ground = ((rows, z - sea) for rows, z in maps.bilinear(height, tile.rows_at, tile.cols_at))
        maps.write_u16(path, ground, words.low_m, words.step_m)
        files.append(_record(job, path, tile, words, doc).model_copy(update={"resampling": lost}))
        beat(len(files) / (layout.tile_rows * layout.tile_cols))
    return Piece(files)


def _record(job: Job, path, tile: Tile, words: Words, doc: str) -> FileRecord:
    height, sea = job.level.height, job.level.sea_level_m
    side = len(tile.rows_at)
    stored = maps.read_u16(path, side, len(tile.cols_at))
    truth = maps.bilinear(height, tile.rows_at, tile.cols_at)
    error_m = maps.largest_difference(stored, truth, lambda values: words.decode(values) + sea)
    return describe_file(
        path,
        map="height",
        doc=doc,
        width=len(tile.cols_at),
        height=side,
        bit_depth=16,
        sample_type="uint16",
        row_0="north" if tile.rows_at[0] > tile.rows_at[-1] else "south",
        channels=[Channel(name="height", meaning="height above the sea", unit=words.unit, neutral=words.neutral)],
        decode=Decode(formula=words.formula, numbers=words.numbers),
        step=100 * words.step_m,
        max_error=100 * error_m,
    )


def write_floats(path: Path, height: np.ndarray, sea_m: float = 0.0) -> float:
    """Metres over `sea_m` as EXR, channel Y, north first, from `height` with row 0 north; returns its error in metres.

    The file's floats are measured against float64.
    """
    from ..image_rows import read_rows, write_rows

    blocks = maps.row_blocks(height)
    write_rows(path, (*height.shape, 1), np.float32, ((values - sea_m)[..., None] for _, values in blocks))
    back = ((rows, values[..., 0]) for rows, values in read_rows(path, maps.row_slices(*height.shape)))
    return maps.largest_difference(back, maps.row_blocks(height), lambda values: values.astype(np.float64) + sea_m)


def probes(job: Job, layout: Layout) -> list[Probe]:
    """The ground at a 5 × 5 of the exported samples and at those nearest the level's lowest and highest sample; of
    tiles at one off the middle of each.
    """
    height = job.level.height
    rows, cols = (np.unique(np.linspace(0, len(at) - 1, PROBES).round().astype(int)) for at in _axes(layout))
    places = [(int(row), int(col)) for row in rows for col in cols]
    for extreme in (height.argmin(), height.argmax()):
        at = np.unravel_index(extreme, height.shape)
        places.append(tuple(int(np.abs(axis - n).argmin()) for axis, n in zip(_axes(layout), at, strict=True)))
    if layout.tiled:
        on = layout.side - 1
        places += [(tile.row * on + on // 3, tile.col * on + on // 4) for tile in layout.tiles()]
    return [_probe(job, layout, *place) for place in dict.fromkeys(places)]


def _axes(layout: Layout) -> tuple[np.ndarray, np.ndarray]:
    return layout.rows_at, layout.cols_at


def _probe(job: Job, layout: Layout, row: int, col: int) -> Probe:
    level, deep = job.level, row * layout.spacing_m
    ((_, value),) = maps.bilinear(level.height, layout.rows_at[[row]], layout.cols_at[[col]])
    return Probe(
        col=col,
        row=row,
        x_m=float(col * layout.spacing_m),
        y_m=float(level.grid.extent_m[1] - deep if layout.north_first else deep),
        height_m=float(value[0, 0]),
    )


def part_notes(layout: Layout, records: list[FileRecord]) -> list[str]:
    """What an artist should know about a level that isn't of a legal size."""
    notes = []
    if not layout.whole:
        part = layout.part()
        how = "resampled" if layout.resampled else "sample for sample"
        notes.append(
            f"The level is the {part.corner} {part.cols} x {part.rows} samples ({part.east_m:g} m east, "
            f"{part.deep_m:g} m {'south' if layout.north_first else 'north'}), {how}; beyond it its edge goes on."
        )
    lost = records[0].resampling if records else None
    if lost:
        notes.append(
            f"Resampled from {lost.from_cols} x {lost.from_rows} samples every {lost.from_cell_m:g} m to one every "
            f"{layout.spacing_m:g} m: at the level's samples the ground is {lost.max_error_cm:.3g} cm off at most, "
            f"{lost.rms_error_cm:.3g} cm root mean square."
        )
    return notes
