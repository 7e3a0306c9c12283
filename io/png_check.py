"""PNG files checked before the decoder sees them: libpng prints its own complaints to stderr, past our one sentence.

Structure as in the PNG specification, third edition (W3C, 2025), sections 5 and 11.2.
"""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

from ..level import BadInput
from ..level.grid import MAX_SIDE

SIGNATURE = b"\x89PNG\r\n\x1a\n"
DEPTHS = {0: (1, 2, 4, 8, 16), 2: (8, 16), 3: (1, 2, 4, 8), 4: (8, 16), 6: (8, 16)}  # by colour type, table 11.1
SAMPLES = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}


def check_png(path: Path) -> None:
    """BadInput with the reason when a PNG is damaged, cut short or too large; only its zlib stream is decoded."""
    with path.open("rb") as file:
        if file.read(8) != SIGNATURE:
            raise _bad(path, "its signature is wrong")
        kind, body = _chunk(path, file)
        if kind != b"IHDR" or len(body) != 13:
            raise _bad(path, "it does not begin with a header")
        expected = _raw_bytes(path, body)
        inflate, length, ended = zlib.decompressobj(), 0, False
        while kind != b"IEND":
            kind, body = _chunk(path, file)
            if kind == b"IDAT" and not ended:
                try:
                    length += len(inflate.decompress(body, expected + 1 - length))
                except zlib.error:
                    raise _bad(path, "its compressed samples are broken") from None
                ended = inflate.eof or length > expected
        if length < expected:
            raise _bad(path, f"it holds {length} of {expected} bytes of samples")


def _chunk(path: Path, file) -> tuple[bytes, bytes]:
    head = file.read(8)
    if len(head) < 8:
        raise _bad(path, "it is cut short")
    size, kind = struct.unpack(">I4s", head)
    if size > 0x7FFFFFFF or not kind.isalpha():
        raise _bad(path, "a chunk of it makes no sense")
    body = file.read(size)
    crc = file.read(4)
    if len(body) < size or len(crc) < 4:
        raise _bad(path, "it is cut short")
    if zlib.crc32(kind + body) != struct.unpack(">I", crc)[0]:
        raise _bad(path, f"the checksum of its {kind.decode()} chunk is wrong")
    return kind, body


def _raw_bytes(path: Path, header: bytes) -> int:
    """Bytes of filtered samples that the header promises."""
    width, height, depth, colour, compression, filters, interlace = struct.unpack(">IIBBBBB", header)
    if depth not in DEPTHS.get(colour, ()) or compression or filters or interlace > 1 or not (width and height):
        raise _bad(path, f"its header is invalid: {width} × {height}, {depth} bits, colour type {colour}")
    if width > MAX_SIDE or height > MAX_SIDE:
        raise BadInput(f"{path} declares {width} × {height} samples; at most {MAX_SIDE} a side can be read")
    bits = depth * SAMPLES[colour]
    passes = [(0, 0, 1, 1)]
    if interlace:  # Adam7: x start, y start, x step, y step
        passes = [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)]
    total = 0
    for x0, y0, dx, dy in passes:
        columns, rows = -(-(width - x0) // dx), -(-(height - y0) // dy)
        if columns > 0 and rows > 0:
            total += rows * (1 + (columns * bits + 7) // 8)
    return total


def _bad(path: Path, reason: str) -> BadInput:
    return BadInput(f"{path} is not a usable PNG: {reason}")
