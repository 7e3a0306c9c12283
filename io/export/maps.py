"""Sampling, resampling and quantising of maps, in blocks of rows so that an 8129² map never lies in memory twice.

Quantise once, with `round()`: exporters that truncate lose up to a whole step and clip the peak.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np

BLOCK = 1 << 18  # samples that are worked on together: what stays in a processor's cache
TOP = 65535  # the largest 16-bit value
Block = tuple[slice, np.ndarray]


def bilinear(samples: np.ndarray, rows_at: np.ndarray, cols_at: np.ndarray) -> Iterator[Block]:
    """Blocks `(slice of rows, float64 (rows, cols))` of `samples` read at fractional rows × columns.

    Between samples the ground is the bilinear surface the editor draws; positions outside are held at the edge.
    """
    if _whole(rows_at) and _whole(cols_at):
        yield from _picked(samples, rows_at, cols_at)
        return
    row, row_part = _split(rows_at, samples.shape[0])
    col, col_part = _split(cols_at, samples.shape[1])
    for block in row_slices(len(row), len(col)):
        lower = np.asarray(samples[row[block]], np.float64)
        upper = np.asarray(samples[row[block] + 1], np.float64)
        along = lower + (upper - lower) * row_part[block, None]
        left = along[:, col]
        yield block, left + (along[:, col + 1] - left) * col_part


def _whole(positions: np.ndarray) -> bool:
    return bool((positions == np.rint(positions)).all())


def _picked(samples: np.ndarray, rows_at: np.ndarray, cols_at: np.ndarray) -> Iterator[Block]:
    """Samples themselves, several times faster than as a mean: what lies beyond the last column repeats it."""
    row, col = (np.clip(at, 0, n - 1).astype(np.intp) for at, n in zip((rows_at, cols_at), samples.shape, strict=True))
    inside = int(np.searchsorted(col, col[-1]))
    straight = bool((np.diff(col[: inside + 1]) == 1).all())
    for block in row_slices(len(row), len(col)):
        lines = samples[row[block]]
        if not straight:
            yield block, lines[:, col].astype(np.float64)
            continue
        values = np.empty((len(lines), len(col)), np.float64)
        values[:, : inside + 1] = lines[:, col[0] : col[0] + inside + 1]
        values[:, inside + 1 :] = lines[:, [col[-1]]]
        yield block, values


def row_slices(rows: int, width: int) -> Iterator[slice]:
    """Blocks of whole rows, `width` numbers each, that hold about BLOCK of them; 16 rows are a chunk of an EXR."""
    deep = max(BLOCK // max(width, 1) // 16 * 16, 16)
    for start in range(0, rows, deep):
        yield slice(start, min(start + deep, rows))


def _split(positions: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Whole index (so that index + 1 exists) and remainder of fractional positions."""
    held = np.clip(np.asarray(positions, np.float64), 0, count - 1)
    whole = np.minimum(held.astype(np.intp), count - 2)
    return whole, held - whole


def quantise(values: np.ndarray, low: float, step: float) -> np.ndarray:
    """`round((values - low) / step)` as little-endian uint16; ValueError where it leaves 0 … 65535."""
    levels = np.rint((values - low) / step)
    if levels.min() < 0 or levels.max() > TOP:
        raise ValueError(
            f"values {values.min()} to {values.max()} leave the 16-bit range from {low} in steps of {step}"
        )
    return levels.astype("<u2")


def write_u16(path: Path, blocks: Iterable[Block], low: float, step: float) -> None:
    """Headerless little-endian uint16, row-major, in the order the blocks come."""
    with path.open("xb") as file:
        for _, values in blocks:
            file.write(quantise(values, low, step).tobytes())


def open_u16(path: Path, rows: int, cols: int) -> np.ndarray:
    """The words of a headerless file, mapped, `(rows, cols)` uint16; ValueError when its size is another."""
    size = path.stat().st_size
    if size != rows * cols * 2:
        raise ValueError(f"{path.name} holds {size} bytes, {cols} × {rows} samples of 16 bits are {rows * cols * 2}")
    return np.memmap(path, "<u2", "r", shape=(rows, cols))


def read_u16(path: Path, rows: int, cols: int) -> Iterator[Block]:
    """The words of a headerless file as blocks of rows, never more than one of them in memory."""
    with path.open("rb") as file:
        for block in row_slices(rows, cols):
            count = (block.stop - block.start) * cols
            yield block, np.frombuffer(file.read(2 * count), "<u2", count).reshape(-1, cols)


def differences(blocks: Iterable[Block], truth: Iterable[Block], decode: Callable = np.asarray) -> tuple[float, float]:
    """The largest and the root mean square of decode(block) − truth over two walks of the same shape."""
    worst, squares, count = 0.0, 0.0, 0
    for (_, values), (_, wanted) in zip(blocks, truth, strict=True):
        off = decode(values) - wanted
        worst = max(worst, float(np.abs(off).max()))
        squares += float(np.square(off).sum())
        count += off.size
    return worst, (squares / count) ** 0.5


def largest_difference(blocks: Iterable[Block], truth: Iterable[Block], decode: Callable = np.asarray) -> float:
    """The largest |decode(block) − truth| over two walks of the same shape."""
    return differences(blocks, truth, decode)[0]


def row_blocks(samples: np.ndarray) -> Iterator[Block]:
    """The samples themselves, as float64 blocks of rows."""
    for block in row_slices(*samples.shape):
        yield block, np.asarray(samples[block], np.float64)


def picked(blocks: Iterable[Block], rows: Sequence[int], cols: Sequence[int]) -> np.ndarray:
    """The samples at some places, `(places, …)`, of a walk over all rows; ValueError when it hasn't all of them."""
    row, col = np.asarray(rows), np.asarray(cols)
    order, found = np.argsort(row, kind="stable"), None
    in_order, taken = row[order], 0
    for block, values in blocks:
        here = order[slice(*np.searchsorted(in_order, (block.start, block.stop)))]
        if found is None:
            found = np.empty((len(row), *values.shape[2:]), values.dtype)
        found[here] = values[row[here] - block.start, col[here]]
        taken += len(here)
    if taken != len(row):
        raise ValueError("some of the places lie on no row")
    return found
