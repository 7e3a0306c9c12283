"""Maps of MAPS as files: coded, written, read back and decoded, so that the record's error is that of the bytes.

Whole numbers go into PNG, north row first, without colour tags; where a target reads 16-bit PNG as 8 bits (Godot 4,
research, files 3) and for floats they go into EXR: float32, ZIP, channel Y or RGB, what three, Blender and Godot take.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from ...level.beat import beat
from .codes import CODES, decoded, encoded
from .earlier import Piece
from .job import Job
from .manifest import describe_file
from .map_makers import MapRow, Samples
from .map_rows import MAPS
from .maps import row_slices
from .mesh_places import PLACES, MeshPlace
from .records import Channel, Decode, FileRecord, MapProbe

PROBES = 5  # a side
WRITING = 0.7  # of the time that a file takes, the rest is for reading it back
DTYPES = {8: np.uint8, 16: np.uint16, 32: np.float32}  # by bits


@dataclass(frozen=True)
class MapStyle:
    """What a target's importer takes: 16-bit pictures or floats instead; whether its second axis goes south (Unreal),
    whether its normal maps have green down, and where meshes have to stand to lie on its terrain.
    """

    deep_png: bool = True
    south_positive: bool = False
    green_down: bool = False
    meshes: MeshPlace = PLACES["south-west"]


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


@dataclass(frozen=True)
class Coding:
    """How one map's samples become those of its file, `bits` 32 for floats; `low` and `high` by channel."""

    code: str
    bits: int
    low: np.ndarray
    high: np.ndarray
    signs: np.ndarray

    @property
    def how(self) -> tuple:
        return self.code, self.low, self.high, self.bits

    @property
    def whole(self) -> bool:
        return self.bits < 32


def write_map(job: Job, row: MapRow, samples: Samples, style: MapStyle) -> tuple[FileRecord, list[MapProbe]]:
    """One map as `NAME_map.png` or `.exr`; its record's numbers are the code's top, cell_m, row_0_y_m and its own."""
    coding = _coding(row, samples, style)
    bits = coding.bits
    path = job.folder / f"{job.name}_{row.name}.{'png' if coding.whole else 'exr'}"
    most = _write(path, samples, coding)
    off = _errors(path, samples, coding)
    rows, cols, _ = samples.values.shape
    numbers = {"cell_m": samples.cell_m, "row_0_y_m": (rows - 1) * samples.cell_m, **samples.numbers}
    channels = _channels(row, coding, off)
    alike = [i for i, c in enumerate(channels) if c.unit == channels[0].unit]  # whose errors can be compared
    steps = CODES[coding.code].step(coding.low, coding.high, 2**bits - 1)
    record = describe_file(
        path,
        map=row.name,
        doc=row.doc,
        width=cols,
        height=rows,
        bit_depth=bits,
        sample_type=np.dtype(DTYPES[bits]).name,
        row_0="north",
        channels=channels,
        decode=Decode(
            formula=CODES[coding.code].formula, numbers=numbers | ({"top": 2.0**bits - 1} if coding.whole else {})
        ),
        step=float(steps[alike].max()) if coding.whole else None,
        max_error=float(off[alike].max()),
        error_unit=channels[0].unit,
    )
    return record, _probes(path, samples, coding.signs, most)


def _coding(row: MapRow, samples: Samples, style: MapStyle) -> Coding:
    bits = row.bits if row.code != "float" and (row.bits == 8 or style.deep_png) else 32
    ends = (np.broadcast_to(np.asarray(end, np.float64), len(row.channels)) for end in (samples.low, samples.high))
    return Coding(row.code if bits < 32 else "float", bits, *ends, _signs(row, style))


def _write(path: Path, samples: Samples, coding: Coding) -> tuple[int, int]:
    """Write the picture; returns where its largest value is."""
    from ..image_rows import write_rows

    rows, cols, count = samples.values.shape
    dtype, most, at = DTYPES[coding.bits], -1.0, (0, 0)

    def coded() -> Iterator[np.ndarray]:
        nonlocal most, at
        for block, values in _blocks(samples, coding.signs):
            size = np.abs(values).max(-1)
            if size.max() > most:
                row, col = np.unravel_index(size.argmax(), size.shape)
                most, at = float(size.max()), (block.start + int(row), int(col))
            beat(WRITING * block.stop / rows)
            whole = encoded(values, *coding.how)
            if count == 2:  # two channels would be grey and alpha
                whole = np.concatenate([whole, np.zeros_like(whole[..., :1])], axis=-1)
            yield whole

    write_rows(path, (rows, cols, 3 if count == 2 else count), dtype, coded())
    return at


def _errors(path: Path, samples: Samples, coding: Coding) -> np.ndarray:
    """The largest error of each channel, measured on the file."""
    from ..image_rows import read_rows

    rows, cols, count = samples.values.shape
    back, off = read_rows(path, row_slices(rows, cols * count)), np.zeros(count)
    for (block, values), (_, stored) in zip(_blocks(samples, coding.signs), back, strict=True):
        beat(WRITING + (1 - WRITING) * block.stop / rows)
        found = decoded(stored[..., :count], *coding.how)
        off = np.maximum(off, np.abs(found - values).max(axis=(0, 1)))
    return off


def map_line(record: FileRecord) -> str:
    """How a shader reads it, in one line."""
    numbers = record.decode.numbers
    parts = ", ".join(
        f"{c.name} {c.meaning}" + ("" if c.low is None else f" ({c.low:.6g} to {c.high:.6g} {c.unit}".rstrip() + ")")
        for c in record.channels
    )
    more = {k: v for k, v in numbers.items() if k not in ("cell_m", "row_0_y_m")}
    span = "".join(f"; {name} {value:g}" for name, value in more.items())
    edge = "tiling" if record.map.startswith("weather_") else "clamped"
    return (
        f"{record.name}: {record.width} x {record.height}, a texel every {numbers['cell_m']:g} m, north row first, "
        f"{record.bit_depth} bits, linear (sRGB off), {edge}; {parts}; {record.decode.formula}{span}"
    )


def _signs(row: MapRow, style: MapStyle) -> np.ndarray:
    """−1 for the channel that a target turns round."""
    sign = np.ones(len(row.channels), np.float32)
    for channel, turn in ((row.north, style.south_positive), (row.green, style.green_down)):
        if channel is not None and turn:
            sign[channel] = -1
    return sign


def _blocks(samples: Samples, signs: np.ndarray) -> Iterator[tuple[slice, np.ndarray]]:
    """(rows of the picture, float32 values), north row first, the turned channels turned."""
    rows, cols, count = samples.values.shape
    for block in row_slices(rows, cols * count):
        yield block, samples.values[rows - block.stop : rows - block.start][::-1] * signs


def _channels(row: MapRow, coding: Coding, off: np.ndarray) -> list[Channel]:
    """The row's channels by the names that they have in the file, with their range and error."""
    letters = "Y" if len(row.channels) == 1 else "RGBA"
    found = []
    for index, channel in enumerate(row.channels):
        told = {"name": letters[index], "max_error": float(off[index])}
        if coding.signs[index] < 0:
            told["meaning"] = channel.meaning.replace("north", "south")
        if coding.whole:
            told |= {"low": float(coding.low[index]), "high": float(coding.high[index])}
        found.append(channel.model_copy(update=told))
    return found


def _probes(path: Path, samples: Samples, signs: np.ndarray, most: tuple[int, int]) -> list[MapProbe]:
    """What a 5 × 5 of the samples stand for, and `most`, the largest."""
    rows, cols, _ = samples.values.shape
    at = [np.linspace(0, n - 1, PROBES).round().astype(int).tolist() for n in (rows, cols)]
    places = dict.fromkeys([*((row, col) for row in at[0] for col in at[1]), most])
    lines = {row: samples.values[rows - 1 - row : rows - row][0] * signs for row, _ in places}
    return [
        MapProbe(file=path.name, row=row, col=col, values=tuple(float(v) for v in lines[row][col]))
        for row, col in places
    ]
