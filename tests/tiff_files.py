"""Small GeoTIFFs for tests, written by hand: the image library leaves their tags out."""

import struct

import numpy as np

CODES = {"H": 3, "I": 4, "d": 12, "s": 2}


def geotiff(path, array, *, tags=(), order="<", big=False):
    """One strip, uncompressed; `tags` rows are (number, code, values or bytes). array: `(rows, cols)`, row 0 first."""
    kind = {"f": 3, "i": 2, "u": 1}[array.dtype.kind]
    data = array.astype(array.dtype.newbyteorder(order)).tobytes()
    first = 16 if big else 8
    rows = [
        (256, "I", (array.shape[1],)),
        (257, "I", (array.shape[0],)),
        (258, "H", (array.dtype.itemsize * 8,)),
        (259, "H", (1,)),
        (262, "H", (1,)),
        (273, "I", (first,)),
        (277, "H", (1,)),
        (278, "I", (array.shape[0],)),
        (279, "I", (len(data),)),
        (339, "H", (kind,)),
        *tags,
    ]
    rows.sort(key=lambda row: row[0])
    inline, entry, count = (8, "HHQ", "Q") if big else (4, "HHI", "H")
    at = first + len(data)
    table_bytes = struct.calcsize(count) + len(rows) * (struct.calcsize(order + entry) + inline) + inline
    extra_at, table, extra = at + table_bytes, struct.pack(order + count, len(rows)), b""
    for number, code, values in rows:
        body = values if code == "s" else struct.pack(f"{order}{len(values)}{code}", *values)
        table += struct.pack(order + entry, number, CODES[code], len(values))
        if len(body) > inline:
            table += struct.pack(order + ("Q" if big else "I"), extra_at + len(extra))
            extra += body
        else:
            table += body.ljust(inline, b"\0")
    mark = b"II" if order == "<" else b"MM"
    head = mark + (struct.pack(order + "HHHQ", 43, 8, 0, at) if big else struct.pack(order + "HI", 42, at))
    path.write_bytes(head + data + table + bytes(inline) + extra)
    return path


def placed(dx, dy, x0, y0, *, model=1, point=False, epsg=32604, unit=9001):
    """Tags of a raster whose first sample (its outer corner when not `point`) is at (x0, y0)."""
    code = 2048 if model == 2 else 3072
    keys = [(1024, model), (1025, 2 if point else 1), (code, epsg), *([(3076, unit)] if model == 1 else [])]
    flat = [1, 1, 0, len(keys)]
    for key, value in keys:
        flat += [key, 0, 1, value]
    if dy < 0:
        where = [(33550, "d", (dx, -dy, 0.0)), (33922, "d", (0.0, 0.0, 0.0, x0, y0, 0.0))]
    else:
        where = [(34264, "d", (dx, 0, 0, x0, 0, dy, 0, y0, 0, 0, 0, 0, 0, 0, 0, 1))]
    return [*where, (34735, "H", tuple(flat))]


def nodata(text):
    return (42113, "s", text.encode() + b"\0")


def ramp(rows=12, cols=9, dtype=np.float32):
    """Heights that name their row and column: 10·row + column − 30."""
    return (np.arange(rows)[:, None] * 10 + np.arange(cols)[None, :] - 30).astype(dtype)
