"""The map of the current, decoded by its formula: nothing drifts, nothing is farther off than was said (T02)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ...level import BadInput
from ...level.flow_bytes import MOST, decoded
from .records import FileRecord, Manifest

SLACK_MPS = 1e-6  # float32 currents against float64 arithmetic
NUMBERS = {"range_mps", "fastest_mps", "cell_m", "row_0_y_m"}


def check_flow(manifest: Manifest, record: FileRecord, whole: dict[str, Path], formula: str) -> list[str]:
    """Findings about the record of a current and, where its bytes are whole, about these."""
    found = [*_statements(manifest, record, formula)]
    return found if found or record.name not in whole else [*_bytes(manifest, record, whole[record.name])]


def _statements(manifest: Manifest, record: FileRecord, formula: str) -> Iterator[str]:
    numbers, source = record.decode.numbers, manifest.source
    if record.decode.formula != formula or set(numbers) != NUMBERS or not min(numbers.values()) > 0:
        yield f"{record.name} is to be decoded by another formula than the current's"
        return
    stride = max(round(numbers["cell_m"] / source.cell_m), 1)
    shape = math.ceil(source.rows / stride), math.ceil(source.cols / stride)
    cell_m = stride * source.cell_m
    near = abs(numbers["cell_m"] - cell_m) < 1e-9 * cell_m
    if (record.height, record.width) != shape or not near or record.row_0 != "north":
        yield f"{record.name} does not lie over the level: {record.width} × {record.height} at {numbers['cell_m']} m"
    if abs(numbers["row_0_y_m"] - (shape[0] - 1) * cell_m) > 1e-6 * cell_m:
        yield f"{record.name} is said to begin at y {numbers['row_0_y_m']} m"
    step_cm = 100 * numbers["range_mps"] / MOST
    if record.step is None or abs(record.step - step_cm) > 1e-9 * step_cm:
        yield f"{record.name} is said to have steps of {record.step} cm/s; they are {step_cm} cm/s"
    lost_cm = 100 * max(numbers["fastest_mps"] - numbers["range_mps"], 0)
    if record.max_error > max(step_cm / 2, lost_cm) + 100 * SLACK_MPS:
        yield f"{record.name} is said to be {record.max_error} cm/s off, more than half a step and what is clipped"


def _bytes(manifest: Manifest, record: FileRecord, path: Path) -> Iterator[str]:
    from ..images import read_image

    try:
        values = read_image(path)
    except BadInput as error:
        yield str(error)
        return
    if values.shape != (record.height, record.width, 3) or values.dtype != np.uint8:
        yield f"{record.name} holds {values.shape} samples of {values.dtype}, three channels of 8 bits were said"
        return
    if not values[..., :2].all():
        yield f"{record.name} holds a byte 0, which no current is coded by"
    probes = [p for p in manifest.flow_probes if 0 <= p.row < record.height and 0 <= p.col < record.width]
    if not probes or len(probes) != len(manifest.flow_probes):
        yield f"the manifest has no places in the water that lie on {record.name}"
        return
    at = [p.row for p in probes], [p.col for p in probes]
    truth = np.array([(p.east_mps, p.north_mps) for p in probes])
    flow = decoded(values[at], record.decode.numbers["range_mps"])
    off = np.abs(flow - truth).max(-1)
    worst = int(off.argmax())
    drifting = flow.any(-1) & ~truth.any(-1)
    if off[worst] > record.max_error / 100 + SLACK_MPS or drifting.any():
        at = probes[int(drifting.argmax()) if drifting.any() else worst]
        yield (
            f"{record.name} is {100 * off.max():.4f} cm/s off the current at column {at.col}, row {at.row}; "
            + ("still water drifts there" if drifting.any() else f"the manifest promises {record.max_error:.4f}")
        )
