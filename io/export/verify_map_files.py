"""Files of MAPS, decoded by their own record's code: as large as said, no farther off than said."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from ...level import BadInput
from .codes import CODES, decoded
from .map_makers import MapRow
from .map_rows import MAPS
from .maps import picked, row_slices
from .records import FileRecord, Manifest

SLACK = 1e-6
BITS = {"uint8": 8, "uint16": 16, "float32": 32}


def check_maps(manifest: Manifest, whole: dict[str, Path], rows: Mapping[str, MapRow] = MAPS) -> list[str]:
    """Findings about all files of a manifest that are maps of MAPS, or of a target's own table."""
    return [
        found
        for record in manifest.files
        if record.map in rows
        for found in _check(manifest, record, whole, rows[record.map])
    ]


def _check(manifest: Manifest, record: FileRecord, whole: dict[str, Path], row: MapRow) -> Iterator[str]:
    numbers = record.decode.numbers
    bits = BITS.get(record.sample_type, 0)
    code = "float" if bits == 32 else row.code
    wanted = {"cell_m", "row_0_y_m"} | ({"top"} if bits < 32 else set())
    if record.decode.formula != CODES[code].formula or wanted - set(numbers) or bits not in (row.bits, 32):
        yield f"{record.name} is to be decoded by another formula than that of {record.map}"
        return
    channels = record.channels
    if len(channels) != len(row.channels) or any(c.max_error is None for c in channels):
        yield f"{record.name} has other channels than {record.map}"
        return
    low, high = (np.array([getattr(c, end) or 0.0 for c in channels]) for end in ("low", "high"))
    if bits < 32 and (numbers["top"] != 2**bits - 1 or not (high > low).all()):
        yield f"{record.name} is said to reach from {low.min()} to {high.max()} in {numbers['top']} steps"
        return
    step, off = CODES[code].step(low, high, 2**bits - 1), np.array([c.max_error for c in channels])
    alike = [i for i, c in enumerate(channels) if c.unit == channels[0].unit]
    largest = float(step[alike].max())
    if bits < 32 and (record.step is None or abs(record.step - largest) > 1e-9 * largest):
        yield f"{record.name} is said to have steps of {record.step}; they are {largest}"
    if record.max_error != off[alike].max() or (off > step / 2 + SLACK * np.maximum(np.abs(high), 1)).any():
        yield f"{record.name} is said to be {record.max_error} off, which its channels and their steps don't bear out"
    if record.name in whole:
        yield from _bytes(manifest, record, whole[record.name], (code, low, high, bits))


def _bytes(manifest: Manifest, record: FileRecord, path: Path, how: tuple) -> Iterator[str]:
    from ..image_rows import open_rows

    probes = [p for p in manifest.map_probes if p.file == record.name]
    inside = [p for p in probes if 0 <= p.row < record.height and 0 <= p.col < record.width]
    try:
        with open_rows(path) as image:
            rows, cols, channels = image.shape
            if (rows, cols) != (record.height, record.width) or image.dtype.name != record.sample_type:
                yield f"{record.name} holds {cols} × {rows} samples of {image.dtype}; other were said"
                return
            if not inside or len(inside) != len(probes):
                yield f"the manifest has no probes that lie on {record.name}"
                return
            blocks = ((block, image.read(block)) for block in row_slices(rows, cols * channels))
            samples = picked(blocks, [p.row for p in inside], [p.col for p in inside])
    except BadInput as error:
        yield str(error)
        return
    truth = np.array([p.values for p in inside])
    found = decoded(samples[:, : truth.shape[1]], *how)
    allowed = np.array([c.max_error for c in record.channels]) + SLACK * np.maximum(np.abs(truth), 1)
    over = (np.abs(found - truth) - allowed).max(-1)
    worst = int(over.argmax())
    if over[worst] > 0:
        at = inside[worst]
        yield (
            f"{record.name} is {np.abs(found - truth)[worst].max():.5g} off at column {at.col}, row {at.row}; "
            "the manifest promises less"
        )
