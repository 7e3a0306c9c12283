"""Height maps as text: plain grids of numbers, and ESRI's .asc which states its cell and rows."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..level import BadInput
from ..level.grid import MAX_SIDE
from .terrain_grid import NORTH, Found, check_side

HEADER = {"ncols", "nrows", "xllcorner", "yllcorner", "xllcenter", "yllcenter", "cellsize", "dx", "dy", "nodata_value"}
MAX_LINE = MAX_SIDE * 32


def read_text(path: Path, array: str | None = None, size=None) -> Found:
    """A grid of numbers, one row a line, parted by blanks, commas or semicolons; BadInput when it is none."""
    if array is not None or size is not None:
        raise BadInput(f"{path} is a text grid of one map that states its own size: leave out --array and --size")
    try:
        with path.open("rb") as file:
            start = file.read(64 << 10)
        if b"\0" in start:
            raise BadInput(f"{path} is not a text grid: it holds binary data")
        with path.open(encoding="utf-8-sig") as file:
            header, first = _header(path, file)
            return _esri(path, file, header, first) if header else _plain(path, file, first)
    except UnicodeDecodeError:
        raise BadInput(f"{path} is not a text grid: it is not UTF-8 text") from None
    except OSError as error:
        raise BadInput(f"{path} cannot be read: {error.strerror}") from None


def _header(path: Path, file) -> tuple[dict[str, float], str]:
    """(ESRI header, the first line of numbers)."""
    header: dict[str, float] = {}
    while line := file.readline(MAX_LINE):
        words = line.split()
        if not words or words[0].startswith("#"):
            continue
        if len(words) == 2 and words[0].lower() in HEADER:
            try:
                header[words[0].lower()] = float(words[1])
            except ValueError:
                raise BadInput(f"{path} says {words[0]} {words[1][:40]!r}, which is no number") from None
            continue
        return header, line
    raise BadInput(f"{path} holds no numbers")


def _parse(path: Path, file, first: str) -> np.ndarray:
    """The grid from its first line on, float32 where that is what it holds."""
    cols = len(_words(first))
    lines = path.stat().st_size // max(len(first), 1)
    if cols > MAX_SIDE or lines > 4 * MAX_SIDE:
        check_side(path, max(lines, 2), cols)
    delimiter = "," if "," in first else ";" if ";" in first else None
    strip = (line.strip().rstrip(",;") for line in _chain(first, file))
    try:
        return np.loadtxt(strip, dtype=np.float64, delimiter=delimiter, comments="#", ndmin=2)
    except ValueError as error:
        raise BadInput(f"{path} is not a grid of numbers: {_reason(str(error))}") from None


def _chain(first: str, file):
    yield first
    yield from file


def _words(line: str) -> list[str]:
    return line.replace(",", " ").replace(";", " ").split()


def _reason(text: str) -> str:
    text = " ".join(text.split())
    return text.split(";")[0][:160]


def _plain(path: Path, file, first: str) -> Found:
    values = _parse(path, file, first)
    rows, cols = values.shape
    if cols == 3 and rows > 64:
        raise BadInput(f"{path} looks like a list of {rows} points x y z, not a grid: grid it first (gdal_grid does)")
    check_side(path, rows, cols)
    return Found(values, notes=[f"{rows} rows of {cols} samples; columns run east"])


def _esri(path: Path, file, header: dict[str, float], first: str) -> Found:
    cell = header.get("dx", header.get("cellsize", 0.0)), header.get("dy", header.get("cellsize", 0.0))
    rows, cols = int(header.get("nrows", 0)), int(header.get("ncols", 0))
    if min(cell) <= 0 or rows < 1 or cols < 1:
        raise BadInput(f"{path} lacks ncols, nrows or cellsize in its header")
    check_side(path, rows, cols)
    values = _parse(path, file, first)
    if values.size != rows * cols:
        raise BadInput(f"{path} promises {cols} × {rows} samples and holds {values.size}")
    found = Found(values.reshape(rows, cols), rows=NORTH, rows_why="every .asc grid is")
    if "nodata_value" in header:
        hits = found.values == header["nodata_value"]
        if hits.any():
            found.notes.append(f"{int(hits.sum())} samples have the file's no-data value {header['nodata_value']:g}")
            found.values[hits] = np.nan
    x, y = (
        header.get(f"{axis}llcenter", header.get(f"{axis}llcorner", 0.0) + step / 2) for axis, step in zip("xy", cell)
    )
    if max(cell) < 0.2 and abs(x) <= 360 and abs(y) <= 90:
        found.cell_deg, found.latitude = cell, y + cell[1] * (rows - 1) / 2
        found.georeference = {"longitude": x, "latitude": y}
    else:
        found.cell_m, found.georeference = cell, {"easting": x, "northing": y}
    return found
