"""Height maps in image files: PNG, EXR, TIFF and GeoTIFF."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ..level import BadInput
from .geotiff import Place, read_place
from .images import Header, load_image, read_header
from .terrain_grid import NORTH, SOUTH, Found, check_side

SAME = 2e-3  # channels of a grey picture may differ by so much of their range (half-float exporters round each apart)


def read_raster(path: Path, array: str | None = None, size=None) -> Found:
    """Samples of an image, one channel of it; BadInput for pictures whose channels are not one height."""
    if size is not None:
        raise BadInput(f"{path} states its own size: leave out --size")
    header = read_header(path)
    check_side(path, header.rows, header.cols)
    place, nodata = read_place(path) if path.suffix.lower() in (".tif", ".tiff") else (None, None)
    header, image = load_image(path)
    found = Found(np.empty(0))
    found.values = _channel(path, header, image, array, found.notes)
    if found.values.dtype.kind == "u":
        found.full_scale = float(np.iinfo(found.values.dtype).max)
    elif found.values.dtype.kind == "f":
        found.maybe_normalised = place is None
    if nodata is not None:
        _apply_nodata(found, nodata)
    if place is not None:
        _apply_place(found, place)
    return found


def _channel(path: Path, header: Header, image: np.ndarray, name: str | None, notes: list[str]) -> np.ndarray:
    names = header.channels
    if name is not None:
        match = [i for i, channel in enumerate(names) if channel.lower() == name.lower()]
        if not match:
            raise BadInput(f"{path} has no channel {name!r}; it has: {', '.join(names)}")
        return np.ascontiguousarray(image[..., match[0]])
    solid = [i for i, channel in enumerate(names) if channel.split(".")[-1].lower() not in ("a", "alpha")] or [0]
    first = np.ascontiguousarray(image[..., solid[0]])
    if len(solid) > 1:
        span = float(np.nanmax(first)) - float(np.nanmin(first)) if np.isfinite(first).any() else 0.0
        gap = max(float(np.nanmax(np.abs(image[..., i].astype(np.float64) - first), initial=0)) for i in solid[1:])
        if gap > SAME * span:
            raise BadInput(
                f"{path} is a colour picture, its channels {', '.join(names)} differ, so it is no height map; "
                f"name the one that holds heights with --array"
            )
        if gap:
            notes.append(f"channels {', '.join(names)} differ by up to {gap:.2g}; {names[solid[0]]} is used")
    return first


def _apply_nodata(found: Found, nodata: float) -> None:
    if math.isnan(nodata):
        return
    hits = found.values == found.values.dtype.type(nodata) if found.values.dtype.kind == "f" else found.values == nodata
    if hits.any():
        found.notes.append(f"{int(hits.sum())} samples have the file's no-data value {nodata:g}")
        if found.full_scale is not None:
            found.values = found.values.astype(np.float64)
        found.values = np.where(hits, np.nan, found.values)


def _apply_place(found: Found, place: Place) -> None:
    rows, cols = found.values.shape
    found.rows, found.rows_why = (NORTH if place.dy < 0 else SOUTH), "its georeference"
    if place.dx < 0:
        found.values = found.values[:, ::-1]
    west = place.x0 if place.dx > 0 else place.x0 + place.dx * (cols - 1)
    south = place.y0 if place.dy > 0 else place.y0 + place.dy * (rows - 1)
    cell = abs(place.dx) * place.unit_m, abs(place.dy) * place.unit_m
    found.georeference = {"crs": place.crs} if place.crs else {}
    if place.degrees:
        found.cell_deg, found.latitude = cell, south + abs(place.dy) * (rows - 1) / 2
        found.georeference |= {"longitude": west, "latitude": south}
    else:
        found.cell_m = cell
        found.georeference |= {"easting": west * place.unit_m, "northing": south * place.unit_m, "grid_north": 0.0}
