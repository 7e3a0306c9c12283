"""Height maps as bare numbers: NumPy's .npz and .npy, and headerless 16-bit .r16 and .raw."""

from __future__ import annotations

import contextlib
import math
import zipfile
from pathlib import Path

import numpy as np
from numpy.lib import format as npy

from ..level import BadInput
from .terrain_grid import NORTH, SOUTH, Found, check_side

NORTHINGS, EASTINGS = ("latitude", "lat", "northing", "y"), ("longitude", "lon", "easting", "x")


def read_npz(path: Path, array: str | None = None, size=None) -> Found:
    """Array `height` of an .npz, else its only 2-D one, else the one that `array` names; BadInput otherwise."""
    if size is not None:
        raise BadInput(f"{path} states its own size: leave out --size")
    try:
        if path.suffix.lower() == ".npy":
            with path.open("rb") as file:
                shape, dtype = _peek(file)
                _check(path, "it", shape, dtype)
                file.seek(0)
                return Found(npy.read_array(file, allow_pickle=False))
        with zipfile.ZipFile(path) as box:
            shapes = {}
            for member in box.namelist():
                with contextlib.suppress(ValueError), box.open(member) as file:
                    shapes[member.removesuffix(".npy")] = _peek(file)
            name = _choose(path, shapes, array)
            _check(path, f"array {name!r}", *shapes[name])
            found = Found(_load(box, name))
            _coordinates(found, box, shapes)
            return found
    except BadInput:
        raise
    except Exception as error:  # a damaged zip raises whatever its member's compression does
        reason = " ".join(str(error).split())[:160] or type(error).__name__
        raise BadInput(f"{path} cannot be read as NumPy arrays: {reason}") from None


def _peek(file) -> tuple[tuple[int, ...], np.dtype]:
    """Shape and type of an array from its header, before memory is taken for it."""
    version = npy.read_magic(file)
    read = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
    shape, _, dtype = read(file)
    return shape, dtype


def _load(box: zipfile.ZipFile, name: str) -> np.ndarray:
    with box.open(name + ".npy") as file:
        return npy.read_array(file, allow_pickle=False)


def _choose(path: Path, shapes: dict, array: str | None) -> str:
    known = ", ".join(shapes) or "none"
    if array is not None:
        if array not in shapes:
            raise BadInput(f"{path} has no array {array!r}; it has: {known}")
        return array
    if "height" in shapes:
        return "height"
    flat = [name for name, (shape, _) in shapes.items() if len(shape) == 2]
    if len(flat) != 1:
        raise BadInput(f"{path} has {len(flat)} two-dimensional arrays: name one with --array (it has: {known})")
    return flat[0]


def _check(path: Path, what: str, shape: tuple[int, ...], dtype: np.dtype) -> None:
    if len(shape) != 2:
        raise BadInput(f"{path}: {what} has {len(shape)} dimensions, a height map has two")
    if dtype.kind not in "fiu":
        raise BadInput(f"{path}: {what} holds {dtype}, not numbers of metres")
    check_side(path, *shape)


def _coordinates(found: Found, box: zipfile.ZipFile, shapes: dict) -> None:
    """Rows and cells from arrays of coordinates beside the map, where the file carries any that fit."""
    rows, cols = found.values.shape
    for names, length, way in ((NORTHINGS, rows, "north"), (EASTINGS, cols, "east")):
        name = next((name for name in names if shapes.get(name, ((),))[0] == (length,)), None)
        if name is None or shapes[name][1].kind not in "fiu":
            continue
        values = _load(box, name).astype(np.float64)
        steps = np.diff(values)
        if not (np.isfinite(steps).all() and (steps > 0).all() | (steps < 0).all()):
            continue
        degrees = name.startswith(("lat", "lon"))
        if way == "north":
            found.rows, found.rows_why = (SOUTH if steps[0] > 0 else NORTH), f"its array {name!r}"
            found.latitude = float(values.mean()) if degrees else 0.0
        elif steps[0] < 0:
            found.values = found.values[:, ::-1]
        if degrees:
            found.fallback_cell = True
            found.georeference["latitude" if way == "north" else "longitude"] = float(values.min())
            step = float(np.abs(steps).mean())
            found.cell_deg = (step, step) if not found.cell_deg else (step, found.cell_deg[1])


def read_r16(path: Path, array: str | None = None, size: int | tuple[int, int] | None = None) -> Found:
    """Headerless little-endian 16-bit samples, square unless `size` (columns, rows) says otherwise."""
    if array is not None:
        raise BadInput(f"{path} holds one map and no names: leave out --array")
    try:
        length = path.stat().st_size
        count = length // 2
        side = math.isqrt(count)
        cols, rows = (size, size) if isinstance(size, int) else size or (side, side)
        if size is None and (length % 2 or side * side != count):
            told = f"{path} holds {length} bytes, which is no square of 16-bit samples"
            raise BadInput(f"{told}: give its size with --size COLSxROWS")
        check_side(path, rows, cols)
        if length != 2 * rows * cols:
            raise BadInput(
                f"{path} holds {length} bytes where {cols} × {rows} samples of 16 bits take {2 * rows * cols}"
            )
        values = np.fromfile(path, "<u2").reshape(rows, cols)
    except OSError as error:
        raise BadInput(f"{path} cannot be read: {error.strerror}") from None
    return Found(values, full_scale=65535.0, notes=[f"{cols} × {rows} samples of 16 bits, low byte first"])
