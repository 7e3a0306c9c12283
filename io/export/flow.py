"""The current as an 8-bit picture, `NAME_flow.png` (T02): the code is level/flow_bytes.py's, for every target the same.

Without colour tags and never compressed by blocks: a texture that an engine takes for sRGB moves still water.
"""

from __future__ import annotations

import numpy as np

from ...level.flow_bytes import NEUTRAL, FlowBytes, decoded, flow_bytes
from .earlier import Piece
from .job import Job
from .manifest import describe_file
from .records import Channel, Decode, FileRecord, FlowProbe

MAP = ("flow", "The whole current, 8 bits a channel: shore, points, rivers, jets, paint; only where water moves.")
FORMULA = (
    "east_mps = (R - 128) / 127 * range_mps, north_mps = (G - 128) / 127 * range_mps, both 0 where |R - 128| and "
    "|G - 128| are below 0.5; x_m = column * cell_m, y_m = row_0_y_m - row * cell_m"
)
UNITY_FORMULA = (
    "X_mps = (R - 128) / 127 * range_mps, Z_mps = (G - 128) / 127 * range_mps, both 0 where |R - 128| and "
    "|G - 128| are below 0.5; x_m = column * cell_m, y_m = row_0_y_m - row * cell_m"
)
GODOT_FORMULA = (
    "X_mps = (R - 128) / 127 * range_mps, Z_mps = -(G - 128) / 127 * range_mps, both 0 where |R - 128| and "
    "|G - 128| are below 0.5; x_m = column * cell_m, y_m = row_0_y_m - row * cell_m"
)
UNREAL_FORMULA = (
    "X_cmps = (R - 128) / 127 * range_mps * 100, Y_cmps = -(G - 128) / 127 * range_mps * 100, both 0 where |R - 128| "
    "and |G - 128| are below 0.5; x_m = column * cell_m, y_m = row_0_y_m - row * cell_m"
)


def write_flow(job: Job, formula: str) -> Piece:
    """The picture, north row first, and places to check it by; nothing where nothing moves."""
    from ...level.flow import current
    from ..images import read_image, write_image

    coded = flow_bytes(job.level)
    if coded.still:
        return Piece()
    path = job.folder / f"{job.name}_flow.png"
    write_image(path, np.ascontiguousarray(coded.bytes[::-1]), data=True)
    truth = current(job.level).packed[::-1, :, :2]
    off = np.abs(decoded(read_image(path), coded.range_mps) - truth)
    rows, cols = coded.bytes.shape[:2]
    record = describe_file(
        path,
        map=MAP[0],
        doc=MAP[1],
        width=cols,
        height=rows,
        bit_depth=8,
        sample_type="uint8",
        row_0="north",
        channels=_channels(),
        decode=Decode(formula=formula, numbers=_numbers(coded)),
        step=100 * coded.step_mps,
        max_error=100 * float(off.max()),
        error_unit="cm/s",
    )
    return Piece([record], flow_probes=_probes(truth, coded))


def _channels() -> list[Channel]:
    return [
        Channel(name="R", meaning="current to the east", unit="m/s", neutral=NEUTRAL),
        Channel(name="G", meaning="current to the north", unit="m/s", neutral=NEUTRAL),
        Channel(name="B", meaning="255 on water, 0 on land", unit=""),
    ]


def _numbers(coded: FlowBytes) -> dict[str, float]:
    return {
        "range_mps": coded.range_mps,
        "fastest_mps": coded.fastest_mps,
        "cell_m": coded.cell_m,
        "row_0_y_m": (coded.bytes.shape[0] - 1) * coded.cell_m,
    }


def _probes(truth: np.ndarray, coded: FlowBytes) -> list[FlowProbe]:
    """The current itself at a 5 × 5 of its samples, and where it is fastest."""
    rows, cols = truth.shape[:2]
    at = [np.linspace(0, n - 1, 5).round().astype(int).tolist() for n in (rows, cols)]
    places = [(row, col) for row in at[0] for col in at[1]]
    fastest = np.abs(truth).max(-1).argmax()
    places.append(tuple(int(n) for n in np.unravel_index(fastest, truth.shape[:2])))
    return [
        FlowProbe(
            col=col,
            row=row,
            x_m=col * coded.cell_m,
            y_m=(rows - 1 - row) * coded.cell_m,
            east_mps=float(truth[row, col, 0]),
            north_mps=float(truth[row, col, 1]),
        )
        for row, col in dict.fromkeys(places)
    ]


def recipe(record: FileRecord) -> list[str]:
    """How a shader reads it."""
    numbers = record.decode.numbers
    lines = [
        f"{record.name}: {record.width} x {record.height}, a texel every {numbers['cell_m']:g} m, north row first, "
        f"8 bits, linear (sRGB off), uncompressed, no mip maps, clamped: {record.decode.formula}; range_mps = "
        f"{numbers['range_mps']:g}; a sampler gives R / 255"
    ]
    if numbers["fastest_mps"] > numbers["range_mps"]:
        lines.append(
            f"{record.name} clips: the current reaches {numbers['fastest_mps']:.3g} m/s, the map holds "
            f"{numbers['range_mps']:g} (flow.export_mps)"
        )
    return lines
