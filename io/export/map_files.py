"""Maps of MAPS as files: coded, written, read back and decoded, so that the record's error is that of the bytes.

Whole numbers go into PNG, north row first, without colour tags; where a target reads 16-bit PNG as 8 bits (Godot 4,
research, files 3) and for floats they go into EXR: float32, ZIP, channel Y or RGB, what three, Blender and Godot take.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .codes import CODES, decoded, encoded
from .job import Job
from .manifest import describe_file
from .map_rows import MAPS, MapRow, Samples
from .records import Channel, Decode, FileRecord, MapProbe

PROBES = 5  # a side


@dataclass(frozen=True)
class MapStyle:
    """What a target's importer takes: 16-bit pictures or floats instead, and which way a map's north channel points."""

    deep_png: bool = True
    south_positive: bool = False


def write_maps(job: Job, style: MapStyle) -> tuple[list[FileRecord], list[MapProbe]]:
    """All chosen maps that the level has anything of, and places to check them by."""
    files, probes = [], []
    for name, row in MAPS.items():
        samples = row.make(job.level) if name in job.maps else None
        if samples is not None:
            record, some = write_map(job, row, samples, style)
            files.append(record)
            probes += some
    return files, probes


def write_map(job: Job, row: MapRow, samples: Samples, style: MapStyle) -> tuple[FileRecord, list[MapProbe]]:
    """One map as `NAME_map.png` or `.exr`; its record's numbers are low, high, top, cell_m and row_0_y_m."""
    from ..images import read_image, write_image

    values = _turned(row, samples.values, style)[::-1]
    bits = row.bits if row.code != "float" and (row.bits == 8 or style.deep_png) else 32
    code = row.code if bits < 32 else "float"
    path = job.folder / f"{job.name}_{row.name}.{'exr' if bits == 32 else 'png'}"
    wide = _padded(encoded(values, code, samples.low, samples.high, bits))
    write_image(path, wide, data=True)
    back = decoded(read_image(path)[..., : values.shape[-1]], code, samples.low, samples.high, bits)
    numbers = {"low": samples.low, "high": samples.high, "top": float(2**bits - 1)} if bits < 32 else {}
    rows = values.shape[0]
    numbers |= {"cell_m": samples.cell_m, "row_0_y_m": (rows - 1) * samples.cell_m}
    record = describe_file(
        path,
        map=row.name,
        doc=row.doc,
        width=values.shape[1],
        height=rows,
        bit_depth=bits,
        sample_type={8: "uint8", 16: "uint16", 32: "float32"}[bits],
        row_0="north",
        channels=_channels(row, wide.shape[-1], style),
        decode=Decode(formula=CODES[code].formula, numbers=numbers),
        step=CODES[code].step(samples.low, samples.high, 2**bits - 1) if bits < 32 else None,
        max_error=float(np.abs(back - values).max()),
        error_unit=row.channels[0].unit,
    )
    return record, _probes(path, values)


def map_line(record: FileRecord) -> str:
    """How a shader reads it, in one line."""
    numbers = record.decode.numbers
    parts = ", ".join(f"{c.name} {c.meaning}" for c in record.channels)
    span = f"; low {numbers['low']:g}, high {numbers['high']:g}, top {numbers['top']:g}" if "top" in numbers else ""
    return (
        f"{record.name}: {record.width} x {record.height}, a texel every {numbers['cell_m']:g} m, north row first, "
        f"{record.bit_depth} bits, linear (sRGB off), clamped; {parts}; {record.decode.formula}{span}"
    )


def _turned(row: MapRow, values: np.ndarray, style: MapStyle) -> np.ndarray:
    if row.north is None or not style.south_positive:
        return values
    sign = np.ones(values.shape[-1], np.float32)
    sign[row.north] = -1
    return values * sign


def _padded(values: np.ndarray) -> np.ndarray:
    """Two channels would be grey and alpha: a third of zeros goes with them."""
    if values.shape[-1] != 2:
        return np.ascontiguousarray(values)
    return np.concatenate([values, np.zeros_like(values[..., :1])], axis=-1)


def _channels(row: MapRow, wide: int, style: MapStyle) -> list[Channel]:
    letters = "Y" if wide == 1 else "RGBA"
    found = []
    for index, (letter, channel) in enumerate(zip(letters, row.channels, strict=False)):
        meaning = channel.meaning
        if index == row.north and style.south_positive:
            meaning = meaning.replace("north", "south")
        found.append(channel.model_copy(update={"name": letter, "meaning": meaning}))
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
