"""Maps of MAPS as files: coded, written, read back and decoded, so that the record's error is that of the bytes.

Whole numbers go into PNG, north row first, without colour tags; where a target reads 16-bit PNG as 8 bits (Godot 4,
research, files 3) and for floats they go into EXR: float32, ZIP, channel Y or RGB, what three, Blender and Godot take.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from .codes import CODES, decoded, encoded
from .earlier import Piece
from .job import Job
from .manifest import describe_file
from .map_makers import MapRow, Samples
from .map_rows import MAPS
from .records import Channel, Decode, FileRecord, MapProbe

PROBES = 5  # a side


@dataclass(frozen=True)
class MapStyle:
    """What a target's importer takes: 16-bit pictures or floats instead; whether its second axis goes south (Unreal),
    and whether its normal maps have green down.
    """

    deep_png: bool = True
    south_positive: bool = False
    green_down: bool = False


def write_maps(job: Job, style: MapStyle, rows: Mapping[str, MapRow] = MAPS) -> Piece:
    """All chosen maps that the level has anything of, and places to check them by."""
    all_of = Piece()
    for row in rows.values():
        made = job.piece(row.name, partial(_piece, job, row, style), row.follows)
        all_of.files += made.files
        all_of.map_probes += made.map_probes
    return all_of


def _piece(job: Job, row: MapRow, style: MapStyle) -> Piece:
    samples = row.make(job.level)
    if samples is None:
        return Piece()
    record, probes = write_map(job, row, samples, style)
    return Piece([record], map_probes=probes)


def write_map(job: Job, row: MapRow, samples: Samples, style: MapStyle) -> tuple[FileRecord, list[MapProbe]]:
    """One map as `NAME_map.png` or `.exr`; its record's numbers are the code's top, cell_m, row_0_y_m and its own."""
    from ..images import read_image, write_image

    values = (samples.values * _signs(row, style))[::-1]
    bits = row.bits if row.code != "float" and (row.bits == 8 or style.deep_png) else 32
    code = row.code if bits < 32 else "float"
    low, high = (np.broadcast_to(np.asarray(end, np.float64), values.shape[-1:]) for end in (samples.low, samples.high))
    path = job.folder / f"{job.name}_{row.name}.{'exr' if bits == 32 else 'png'}"
    write_image(path, _padded(encoded(values, code, low, high, bits)), data=True)
    off = np.abs(decoded(read_image(path)[..., : values.shape[-1]], code, low, high, bits) - values).max(axis=(0, 1))
    rows, cols, _ = values.shape
    numbers = {"cell_m": samples.cell_m, "row_0_y_m": (rows - 1) * samples.cell_m, **samples.numbers}
    channels = _channels(row, style, None if bits == 32 else (low, high), off)
    alike = [c.max_error for c in channels if c.unit == channels[0].unit]
    record = describe_file(
        path,
        map=row.name,
        doc=row.doc,
        width=cols,
        height=rows,
        bit_depth=bits,
        sample_type={8: "uint8", 16: "uint16", 32: "float32"}[bits],
        row_0="north",
        channels=channels,
        decode=Decode(formula=CODES[code].formula, numbers=numbers | ({"top": 2.0**bits - 1} if bits < 32 else {})),
        step=float(CODES[code].step(low, high, 2**bits - 1)[0]) if bits < 32 else None,
        max_error=max(alike),
        error_unit=channels[0].unit,
    )
    return record, _probes(path, values)


def map_line(record: FileRecord) -> str:
    """How a shader reads it, in one line."""
    numbers = record.decode.numbers
    parts = ", ".join(
        f"{c.name} {c.meaning}" + ("" if c.low is None else f" ({c.low:.6g} to {c.high:.6g} {c.unit}".rstrip() + ")")
        for c in record.channels
    )
    more = {k: v for k, v in numbers.items() if k not in ("cell_m", "row_0_y_m")}
    span = "".join(f"; {name} {value:g}" for name, value in more.items())
    return (
        f"{record.name}: {record.width} x {record.height}, a texel every {numbers['cell_m']:g} m, north row first, "
        f"{record.bit_depth} bits, linear (sRGB off), clamped; {parts}; {record.decode.formula}{span}"
    )


def _signs(row: MapRow, style: MapStyle) -> np.ndarray:
    """−1 for the channel that a target turns round."""
    sign = np.ones(len(row.channels), np.float32)
    for channel, turn in ((row.north, style.south_positive), (row.green, style.green_down)):
        if channel is not None and turn:
            sign[channel] = -1
    return sign


def _padded(values: np.ndarray) -> np.ndarray:
    """Two channels would be grey and alpha: a third of zeros goes with them."""
    if values.shape[-1] != 2:
        return np.ascontiguousarray(values)
    return np.concatenate([values, np.zeros_like(values[..., :1])], axis=-1)


def _channels(row: MapRow, style: MapStyle, ends: tuple | None, off: np.ndarray) -> list[Channel]:
    """The row's channels by the names that they have in the file, with their range and error."""
    letters = "Y" if len(row.channels) == 1 else "RGBA"
    turned, found = _signs(row, style) < 0, []
    for index, channel in enumerate(row.channels):
        told = {"name": letters[index], "max_error": float(off[index])}
        if turned[index]:
            told["meaning"] = channel.meaning.replace("north", "south")
        if ends:
            told |= {"low": float(ends[0][index]), "high": float(ends[1][index])}
        found.append(channel.model_copy(update=told))
    return found


def _probes(path: Path, values: np.ndarray) -> list[MapProbe]:
    """What a 5 × 5 of the samples stand for, and the largest."""
    rows, cols = values.shape[:2]
    at = [np.linspace(0, n - 1, PROBES).round().astype(int).tolist() for n in (rows, cols)]
    places = [(row, col) for row in at[0] for col in at[1]]
    most = np.unravel_index(np.abs(values).max(-1).argmax(), (rows, cols))
    places.append((int(most[0]), int(most[1])))
    return [
        MapProbe(file=path.name, row=row, col=col, values=tuple(float(v) for v in values[row, col]))
        for row, col in dict.fromkeys(places)
    ]
