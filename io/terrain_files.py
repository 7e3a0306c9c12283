"""Import of height maps that others made: one table of formats, one way through for all of them.

The file's own statements come first, flags fill what it leaves open and may not contradict it, documented defaults
(1 m cells, row 0 = north) fill the rest and are put into `notes` for the user to read.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..level import BadInput
from .terrain_arrays import read_npz, read_r16
from .terrain_grid import Found, fill_holes, mark_voids, metres, settle_cell, settle_rows, square_cells
from .terrain_raster import read_raster
from .terrain_text import read_text

FORMATS: dict[str, Callable[..., Found]] = {
    ".png": read_raster,
    ".exr": read_raster,
    ".tif": read_raster,
    ".tiff": read_raster,
    ".npz": read_npz,
    ".npy": read_npz,
    ".r16": read_r16,
    ".raw": read_r16,
    ".txt": read_text,
    ".csv": read_text,
    ".dat": read_text,
    ".asc": read_text,
}


@dataclass
class Heightmap:
    """Ground ready to be a level's base: float32 `(rows, cols)` metres, row 0 south, square cells of `cell_m`."""

    height: np.ndarray
    cell_m: float
    georeference: dict = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


def import_height(
    path: Path | str,
    *,
    cell_m: float | tuple[float, float] | str | None = None,
    rows: str | None = None,
    depth_down: bool = False,
    array: str | None = None,
    height_range: tuple[float, float] | None = None,
    size: int | tuple[int, int] | None = None,
    fill_m: float | None = None,
) -> Heightmap:
    """Read a height map; its `notes` are to be shown to the user.

    cell_m: metres, or (east, north), or text such as "2x1"; rows: "north-first" or "south-first"; depth_down: the file
    counts depths downward; array: name of an .npz array or image channel; height_range: metres that 0 and 1 (or the
    largest integer) of a normalised map mean; size: (columns, rows) of a headerless file; fill_m: height of missing
    samples, which are else filled from their neighbours.
    BadInput in one sentence for files that cannot be used and for flags that contradict them.
    """
    path = Path(path)
    reader = _reader(path)
    cell = parse_cell(cell_m)
    if fill_m is not None and not (math.isfinite(fill_m) and abs(fill_m) <= 1e5):
        raise BadInput(f"--fill {fill_m} is no height in metres")
    found = reader(path, array=array, size=size)
    mark_voids(found, path)
    values = metres(found, path, height_range)
    values = -values if depth_down else values
    north = settle_rows(found, path, rows)
    cell = settle_cell(found, path, cell)
    values = fill_holes(values[::-1] if north else values, fill_m, found.notes)
    values, side = square_cells(values, cell, found.notes, path)
    height = np.ascontiguousarray(values, np.float32)
    _remark(height, found.notes)
    return Heightmap(height, side, found.georeference, found.notes)


def parse_cell(cell_m: float | tuple[float, float] | str | None) -> tuple[float, float] | None:
    """(east, north) metres from a number, a pair or text such as "2x1"; BadInput when it is none."""
    if cell_m is None:
        return None
    if isinstance(cell_m, str):
        parts = re.split(r"[x×,]", cell_m)
        try:
            pair = tuple(float(part) for part in parts)
        except ValueError:
            raise BadInput(f"--cell-m {cell_m} is no size: give metres, or EASTxNORTH such as 2x1") from None
    else:
        pair = tuple(cell_m) if isinstance(cell_m, tuple | list) else (float(cell_m),)
    pair = pair * 2 if len(pair) == 1 else pair
    if len(pair) != 2 or not all(math.isfinite(side) and 0.001 <= side <= 100_000 for side in pair):
        raise BadInput(f"--cell-m {cell_m} is no size: give 0.001 to 100000 metres, or EASTxNORTH such as 2x1")
    return float(pair[0]), float(pair[1])


def _reader(path: Path) -> Callable[..., Found]:
    try:
        if not path.exists():
            raise BadInput(f"{path} does not exist")
        if not path.is_file():
            raise BadInput(f"{path} is not a file, so there is no height map to import")
        if path.stat().st_size == 0:
            raise BadInput(f"{path} is empty")
        with path.open("rb"):
            pass
    except OSError as error:
        raise BadInput(f"{path} cannot be read: {error.strerror}") from None
    reader = FORMATS.get(path.suffix.lower())
    if reader is None:
        raise BadInput(f"{path} is of no kind that can be imported: use one of {', '.join(FORMATS)}")
    return reader


def _remark(height: np.ndarray, notes: list[str]) -> None:
    low, high = float(height.min()), float(height.max())
    notes.append(f"heights from {low:.6g} to {high:.6g} m, {100 * float((height < 0).mean()):.3g} % below 0")
    if low == high:
        notes.append("the ground is perfectly flat")
    elif low >= 0:
        notes.append("nothing lies below 0: give a --sea-level, or --depth-down if the file counts depths downward")
    elif high <= 0:
        notes.append("nothing rises above 0: give a --sea-level, or --depth-down if the file counts depths downward")
