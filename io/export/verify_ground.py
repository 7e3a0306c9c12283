"""What every check of a ground asks: stated steps, range, probes, and for tiles one surface over their shared edges."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator
from pathlib import Path

import numpy as np

from . import maps
from .common import NAMES
from .heights import Words
from .layout import Layout, Tile
from .records import FileRecord, Manifest, Probe, Tiles

SLACK_CM = 1e-5  # float64 arithmetic on metres, not quantisation


def near(value: float, wanted: float) -> bool:
    return abs(value - wanted) <= 1e-9 * max(abs(wanted), 1e-9)


def own_records(manifest: Manifest, more: Collection[str] = ()) -> dict[str, list[FileRecord]]:
    """The records that are neither of common.py nor `more`, by what they show."""
    found: dict[str, list[FileRecord]] = {}
    for record in manifest.files:
        if record.map not in NAMES and record.map not in more:
            found.setdefault(record.map, []).append(record)
    return found


def said_otherwise(stated, wanted) -> Iterator[str]:
    """Fields of an engine's record that don't follow from the level's size and range."""
    for name, value in wanted.model_dump().items():
        told = getattr(stated, name)
        told = told.model_dump() if hasattr(told, "model_dump") else told
        same = near(told, value) if isinstance(value, float) and isinstance(told, float) else _same(told, value)
        if not same:
            yield f"{name} is said to be {told}; this level's is {value}"


def _same(told, value) -> bool:
    if isinstance(value, dict) and isinstance(told, dict):
        return told.keys() == value.keys() and all(_same(told[key], value[key]) for key in value)
    return near(told, value) if isinstance(value, float) and isinstance(told, float) else told == value


def check_heights(
    manifest: Manifest,
    records: list[FileRecord],
    whole: dict[str, Path],
    layout: Layout,
    words: Words,
    name_of: Callable[[Tile], str],
) -> Iterator[str]:
    """Height maps of 16 bits: named, sized and decoded as the engine reads them, and no farther off than said."""
    tiles = [*layout.tiles()]
    if manifest.tiles != Tiles(rows=layout.tile_rows, cols=layout.tile_cols):
        yield f"the tiles are said to be {manifest.tiles.cols} × {manifest.tiles.rows}"
    if [record.name for record in records] != [name_of(tile) for tile in tiles]:
        yield f"the height maps should be named {name_of(tiles[0])} to {name_of(tiles[-1])}"
        return
    for record in records:
        if record.decode.formula != words.formula or record.decode.numbers != words.numbers:
            yield f"{record.name} is to be decoded by other numbers than the terrain's"
        size = record.width, record.height, record.row_0
        wanted = len(tiles[0].cols_at), len(tiles[0].rows_at), "north" if layout.north_first else "south"
        if size != wanted:
            yield f"{record.name} is said to be {size[0]} × {size[1]}, {size[2]} first; it should be {wanted}"
            return
        yield from check_step(record, 100 * words.step_m)
    if any((record.resampling is not None) != layout.resampled for record in records):
        yield "what the resampling lost is not stated"
    yield from _surface(manifest, records, whole, layout, words)


def _surface(manifest: Manifest, records: list[FileRecord], whole, layout: Layout, words: Words) -> Iterator[str]:
    sea = manifest.world.sea_level_m
    opened: dict[tuple[int, int], np.ndarray] = {}
    for tile, record in zip(layout.tiles(), records, strict=True):
        if record.name not in whole:
            continue
        try:
            stored = maps.open_u16(whole[record.name], record.height, record.width)
        except ValueError as error:
            yield str(error)
            continue
        opened[tile.row, tile.col] = stored
        allowed_m = (record.max_error + SLACK_CM) / 100
        low, high = (float(words.decode(end)) + sea for end in (stored.min(), stored.max()))
        yield from check_range(manifest, record, low, high, allowed_m)
        yield from _tile_probes(manifest, record, layout, tile, lambda r, c, s=stored: words.decode(s[r, c]) + sea)
    yield from _edges(opened, records, layout)


def _tile_probes(manifest: Manifest, record: FileRecord, layout: Layout, tile: Tile, height_at) -> Iterator[str]:
    """Those of the manifest's probes that lie on this tile."""
    row, col = tile.row * (layout.side - 1), tile.col * (layout.side - 1)
    over = [p.model_copy(update={"row": p.row - row, "col": p.col - col}) for p in manifest.probes]
    rows, cols = len(layout.rows_at), len(layout.cols_at)
    if not over or any(not (0 <= p.row < rows and 0 <= p.col < cols) for p in manifest.probes):
        yield f"the manifest has no probes that lie on {record.name}"
        return
    inside = [p for p in over if 0 <= p.row < record.height and 0 <= p.col < record.width]
    if inside:
        yield from worst_probe(record, inside, height_at, (record.max_error + SLACK_CM) / 100)


def _edges(opened: dict[tuple[int, int], np.ndarray], records: list[FileRecord], layout: Layout) -> Iterator[str]:
    """Neighbours share their edge: the same words on both sides."""
    for (row, col), here in opened.items():
        for there, mine, theirs in (((row, col + 1), here[:, -1], np.s_[:, 0]), ((row + 1, col), here[-1], np.s_[0])):
            if there in opened and not np.array_equal(mine, opened[there][theirs]):
                names = (records[r * layout.tile_cols + c].name for r, c in ((row, col), there))
                yield " and ".join(names) + " differ along the edge they share"


def check_step(record: FileRecord, step_cm: float) -> Iterator[str]:
    """The stated step is the format's, and rounding can be off by half of it at most."""
    stated = record.step
    if stated is None or abs(stated - step_cm) > 1e-9 * max(step_cm, 1):
        yield f"{record.name} is said to have steps of {stated} cm; they are {step_cm} cm"
    if record.max_error > step_cm / 2 + SLACK_CM:
        yield f"{record.name} is said to be {record.max_error} cm off, more than half a step of {step_cm} cm"


def check_range(manifest: Manifest, record: FileRecord, low: float, high: float, allowed_m: float) -> Iterator[str]:
    world = manifest.world
    if not (low >= world.height_min_m - allowed_m and high <= world.height_max_m + allowed_m):
        yield (
            f"{record.name} decodes to {float(low):.4f} … {float(high):.4f} m, "
            f"the level has {world.height_min_m:.4f} … {world.height_max_m:.4f} m"
        )


def check_floats(manifest: Manifest, record: FileRecord, blocks: Iterable[maps.Block], sea_m: float) -> Iterator[str]:
    """Range and probes of a walk over all rows of a ground in metres over `sea_m`, north row first."""
    low, high, lines, asked = np.inf, -np.inf, {}, {probe.row for probe in manifest.probes}
    for rows, values in blocks:
        low, high = np.fmin(low, values.min()), np.fmax(high, values.max())
        lines |= {row: values[row - rows.start].copy() for row in asked if rows.start <= row < rows.stop}
    allowed_m = (record.max_error + SLACK_CM) / 100
    yield from check_range(manifest, record, float(low) + sea_m, float(high) + sea_m, allowed_m)
    yield from check_probes(manifest, record, lambda row, col: float(lines[row][col]) + sea_m, allowed_m)


def check_probes(manifest: Manifest, record: FileRecord, height_at: Callable, allowed_m: float) -> Iterator[str]:
    """The level's own ground, kept in the manifest, against what the file decodes to."""
    inside = [p for p in manifest.probes if 0 <= p.row < record.height and 0 <= p.col < record.width]
    if not inside or len(inside) != len(manifest.probes):
        yield f"the manifest has no probes that lie on {record.name}"
        return
    yield from worst_probe(record, inside, height_at, allowed_m)


def worst_probe(record: FileRecord, inside: list[Probe], height_at: Callable, allowed_m: float) -> Iterator[str]:
    """The place that is farthest off, when that is too far."""
    worst, probe = max(
        ((abs(float(height_at(p.row, p.col)) - p.height_m), p) for p in inside), key=lambda pair: pair[0]
    )
    if not worst <= allowed_m:
        yield (
            f"{record.name} is {100 * worst:.4f} cm off the level at column {probe.col}, row {probe.row}; "
            f"the manifest promises {record.max_error:.4f} cm"
        )
