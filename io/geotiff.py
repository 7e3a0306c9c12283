"""Where a GeoTIFF lies on the Earth, read from its tags: OpenImageIO leaves them out.

TIFF 6.0 and BigTIFF directories; tags and keys as in OGC GeoTIFF 1.1 (19-008r4), no-data as GDAL writes it (42113).
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from pathlib import Path

from ..level import BadInput

WANTED = {33550: "scale", 33922: "tiepoint", 34264: "matrix", 34735: "keys", 34737: "ascii", 42113: "nodata"}
SIZES = {1: "B", 2: "s", 3: "H", 4: "I", 6: "b", 8: "h", 9: "i", 11: "f", 12: "d", 13: "I", 16: "Q", 17: "q"}
FEET = {9001: 1.0, 9002: 0.3048, 9003: 1200 / 3937}  # linear units: metre, international foot, US survey foot
MAX_BYTES = 1 << 20


@dataclass(frozen=True)
class Place:
    """Affine map from (column, row) of samples to map coordinates: x = x0 + dx·column, y = y0 + dy·row."""

    x0: float
    y0: float
    dx: float
    dy: float
    degrees: bool
    unit_m: float
    crs: str


def read_place(path: Path) -> tuple[Place | None, float | None]:
    """(place or None, no-data value or None) of a TIFF; BadInput when the raster is rotated or the tags are damaged."""
    try:
        tags = _tags(path)
    except (struct.error, ValueError, OSError, KeyError, UnicodeDecodeError) as error:
        raise BadInput(f"{path} has damaged TIFF tags ({error})") from None
    nodata = None
    if "nodata" in tags:
        text = str(tags["nodata"]).strip("\0 ")
        try:
            nodata = float(text)
        except ValueError:
            raise BadInput(f"{path} names {text[:40]!r} as its no-data value, which is no number") from None
    affine = _affine(path, tags)
    if affine is None:
        return None, nodata
    keys = _keys(tags)
    x0, y0, dx, dy = affine
    model = keys.get(1024)
    degrees = model == 2 if model in (1, 2) else (abs(dx) < 0.2 and abs(x0) <= 360 and abs(y0) <= 90)
    if keys.get(1025, 1) == 1:  # pixel is area: the sample stands in its middle
        x0, y0 = x0 + dx / 2, y0 + dy / 2
    code = keys.get(2048 if degrees else 3072)
    named = isinstance(code, int) and code not in (0, 32767)
    crs = f"EPSG:{code}" if named else str(tags.get("ascii", "")).strip("\0| ")
    unit_m = 1.0 if degrees else FEET.get(keys.get(3076, 9001), 1.0)
    return Place(x0, y0, dx, dy, degrees, unit_m, crs), nodata


def _affine(path: Path, tags: dict) -> tuple[float, float, float, float] | None:
    if "matrix" in tags and len(tags["matrix"]) == 16:
        a, b, _, x0, d, e, _, y0 = tags["matrix"][:8]
        if abs(b) > 1e-9 * abs(a) or abs(d) > 1e-9 * abs(e):
            raise BadInput(f"{path} is a rotated raster: turn it to face north first (gdalwarp does)")
        return _checked(path, x0, y0, a, e)
    if "scale" in tags and "tiepoint" in tags and len(tags["tiepoint"]) >= 6 and len(tags["scale"]) >= 2:
        col, row, _, x, y = tags["tiepoint"][:5]
        dx, dy = tags["scale"][0], -tags["scale"][1]
        return _checked(path, x - col * dx, y - row * dy, dx, dy)
    return None


def _checked(path: Path, *affine: float) -> tuple[float, ...]:
    if not all(abs(value) < 1e12 for value in affine) or not affine[2] or not affine[3]:
        raise BadInput(f"{path} has a georeference that makes no sense: {', '.join(f'{v:g}' for v in affine)}")
    return affine


def _keys(tags: dict) -> dict[int, int]:
    """The GeoKeys held in the directory itself (those that point elsewhere aren't needed)."""
    raw = tags.get("keys", ())
    rows = [raw[i : i + 4] for i in range(4, len(raw) - 3, 4)]
    return {row[0]: row[3] for row in rows if row[1] == 0}


def _tags(path: Path) -> dict[str, object]:
    with path.open("rb") as file:
        head = file.read(16)
        order = {b"II": "<", b"MM": ">"}[head[:2]]
        big = struct.unpack(order + "H", head[2:4])[0] == 43
        entry, inline = (order + "HHQ", 8) if big else (order + "HHI", 4)
        file.seek(struct.unpack(order + ("Q" if big else "I"), head[8:16] if big else head[4:8])[0])
        count = struct.unpack(order + ("Q" if big else "H"), file.read(8 if big else 2))[0]
        size = struct.calcsize(entry) + inline
        if count > 4096:
            raise ValueError(f"{count} entries")
        table = file.read(count * size)
        found: dict[str, object] = {}
        for at in range(0, len(table), size):
            tag, kind, number = struct.unpack_from(entry, table, at)
            if tag in WANTED:
                found[WANTED[tag]] = _value(file, order, kind, number, table[at + size - inline : at + size])
        return found


def _value(file, order: str, kind: int, number: int, inline: bytes):
    code = SIZES[kind]
    length = number * struct.calcsize(code)
    if length > MAX_BYTES:
        raise ValueError(f"a value of {length} bytes")
    if length > len(inline):
        file.seek(struct.unpack(order + ("Q" if len(inline) == 8 else "I"), inline)[0])
        data = file.read(length)
    else:
        data = inline[:length]
    if kind == 2:
        return data.decode("latin-1")
    return struct.unpack(f"{order}{number}{code}", data)
