"""Files of MAPS, decoded by their own record's code: as large as said, no farther off than said."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ...level import BadInput
from .codes import CODES, decoded
from .map_rows import MAPS
from .records import FileRecord, Manifest

SLACK = 1e-6
BITS = {"uint8": 8, "uint16": 16, "float32": 32}


def check_maps(manifest: Manifest, whole: dict[str, Path]) -> list[str]:
    """Findings about all files of a manifest that are maps of MAPS."""
    return [found for record in manifest.files if record.map in MAPS for found in _check(manifest, record, whole)]


def _check(manifest: Manifest, record: FileRecord, whole: dict[str, Path]) -> Iterator[str]:
    row, numbers = MAPS[record.map], record.decode.numbers
    bits = BITS.get(record.sample_type, 0)
    code = "float" if bits == 32 else row.code
    wanted = {"cell_m", "row_0_y_m"} | ({"low", "high", "top"} if bits < 32 else set())
    if record.decode.formula != CODES[code].formula or set(numbers) != wanted or bits not in (row.bits, 32):
        yield f"{record.name} is to be decoded by another formula than that of {record.map}"
        return
    low, high, top = (numbers.get(name, 0.0) for name in ("low", "high", "top"))
    if bits < 32 and (top != 2**bits - 1 or not high > low):
        yield f"{record.name} is said to reach from {low} to {high} in {top} steps"
        return
    step = CODES[code].step(low, high, 2**bits - 1)
    if bits < 32 and (record.step is None or abs(record.step - step) > 1e-9 * step):
        yield f"{record.name} is said to have steps of {record.step}; they are {step}"
    if record.max_error > step / 2 + SLACK * max(abs(high), 1.0):
        yield f"{record.name} is said to be {record.max_error} off, more than half a step of {step}"
    if record.name in whole:
        yield from _bytes(manifest, record, whole[record.name], (code, low, high, bits))


def _bytes(manifest: Manifest, record: FileRecord, path: Path, how: tuple) -> Iterator[str]:
    from ..images import read_image

    try:
        samples = read_image(path)
    except BadInput as error:
        yield str(error)
        return
    if samples.shape[:2] != (record.height, record.width) or samples.dtype.name != record.sample_type:
        yield f"{record.name} holds {samples.shape[1]} × {samples.shape[0]} samples of {samples.dtype}; other were said"
        return
    probes = [p for p in manifest.map_probes if p.file == record.name]
    inside = [p for p in probes if 0 <= p.row < record.height and 0 <= p.col < record.width]
    if not inside or len(inside) != len(probes):
        yield f"the manifest has no probes that lie on {record.name}"
        return
    truth = np.array([p.values for p in inside])
    found = decoded(samples[[p.row for p in inside], [p.col for p in inside]], *how)[:, : truth.shape[1]]
    off = np.abs(found - truth).max(-1)
    worst = int(off.argmax())
    if not off[worst] <= record.max_error + SLACK * max(float(np.abs(truth).max()), 1.0):
        yield (
            f"{record.name} is {off[worst]:.5g} {record.error_unit} off at column {inside[worst].col}, "
            f"row {inside[worst].row}; the manifest promises {record.max_error:.5g}".replace("  ", " ")
        )
