"""Faults of a painted flow (T02): still water that drifts, flow into land, speeds an 8-bit map clips, divergence; and
of the whole current as it is exported: what is clipped of it, what drifts.

Each with its worst place in metres and its number, largest first, so that somebody can go there and paint it right.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .flow import current
from .flow_bytes import NEUTRAL, coded, flow_bytes
from .level import Level
from .projection import divergence
from .river_map import river_shape

MOST = 12  # places of a kind
RANGE_MPS = 2.0  # what an 8-bit map holds either way that paint may come from, unless told otherwise
STEPS = 255  # of such a map; no step of it is zero, so 0.5 decodes to ± range / 255
DRIFT_SHARE = 0.2  # of the painted cells that hold one value of about a step: nobody painted that
DRIFT_STEPS = 2.2
ONE_VALUE = 0.1  # of a step, that a current which is one value throughout varies by
ASHORE_MPS = 0.05  # into the land, slower than which nothing shows
AHEAD = 1.5  # cells ahead at which land is looked for
APART = 0.15  # of the fastest painted speed, that a cell may give or swallow
LEAST_CELLS = 3


@dataclass(frozen=True)
class FlowFault:
    """`kind` drift, ashore, clipped or divergence; `value` in `unit` at the worst place, `cells` that share it."""

    kind: str
    x: float
    y: float
    value: float
    unit: str
    cells: int
    sentence: str


def flow_faults(level: Level, range_mps: float | None = None) -> list[FlowFault]:
    """All faults of the level's painted flow and of its current in bytes, by kind.

    `range_mps`: what an 8-bit map holds; without it, what the level's export does.
    """
    painted = level.layers["flow"]
    if painted.neutral:
        return [*_exported(level, range_mps)]
    flow = np.ascontiguousarray(painted.array)
    wet = wet_cells(level)
    drift = _drift(level, flow, range_mps or RANGE_MPS)
    if drift:  # of it the other kinds would find faults everywhere
        return drift
    return [*_ashore(level, flow, wet), *_exported(level, range_mps), *_apart(level, flow, wet)]


def _exported(level: Level, range_mps: float | None) -> Iterator[FlowFault]:
    """The whole current as exporters write it: where it is clipped, and one value about a step beside still."""
    made = current(level)
    both = coded(made, range_mps) if range_mps else flow_bytes(level)
    flow, stride = made.packed[..., :2], round(made.cell_m / level.grid.cell_m)
    most = np.abs(flow).max(-1)
    for row, col, cells in _patches(most, most > both.range_mps):
        told = f"{most[row, col]:.2f} m/s is over the {both.range_mps:g} m/s that the 8-bit map holds"
        yield _fault(level, "clipped", row * stride, col * stride, most[row, col], "m/s", cells, told)
    moving = both.bytes[..., :2].reshape(-1, 2)
    moving = moving[(moving != NEUTRAL).any(-1)].astype(int)
    if not len(moving):
        return
    values, counts = np.unique(moving, axis=0, return_counts=True)
    common, count = values[counts.argmax()], int(counts.max())
    if np.abs(common - NEUTRAL).max() > DRIFT_STEPS or count < DRIFT_SHARE * len(moving):
        return
    there = (both.bytes[..., :2] == common).all(-1)
    if np.ptp(np.percentile(flow[there], (10, 90), axis=0), axis=0).max() > ONE_VALUE * both.step_mps:
        return  # a slow current of its own, coarsely coded
    row, col = np.argwhere(there)[0]
    told = f"{count} samples of the 8-bit map hold {common[0]}, {common[1]}, beside its neutral {NEUTRAL}: water drifts"
    yield _fault(level, "drift", row * stride, col * stride, float(np.hypot(*flow[row, col])), "m/s", count, told)


def wet_cells(level: Level) -> np.ndarray:
    """Where water stands at mean sea level, in the sea, rivers or lakes: bool `(rows, cols)`."""
    wet = level.height < level.mean_sea_m
    shape = river_shape(level)
    if shape is None:
        return wet
    stride = round(shape.cell_m / level.grid.cell_m)
    rows, cols = (np.minimum(np.arange(n) // stride, m - 1) for n, m in zip(wet.shape, shape.wet.shape, strict=True))
    near = np.ix_(rows, cols)
    return wet | (shape.wet[near] & (level.mean_sea_m + shape.packed[..., 0][near] > level.height))


def _drift(level: Level, flow: np.ndarray, range_mps: float) -> list[FlowFault]:
    """The commonest value, where it is about a step of an 8-bit map beside zero."""
    cells = flow.round(6)
    cells = cells[cells.any(-1)]
    if not len(cells):
        return []
    values, counts = np.unique(cells, axis=0, return_counts=True)
    most = int(counts.argmax())
    step, count = float(np.abs(values[most]).max()), int(counts[most])
    if step > DRIFT_STEPS * range_mps / STEPS or count < DRIFT_SHARE * len(cells):
        return []
    row, col = np.argwhere((flow.round(6) == values[most]).all(-1))[0]
    east, north = values[most]
    told = (f"{count} cells hold {east:+.4f}, {north:+.4f} m/s, about a step of an 8-bit map: its neutral 0.5 was"
            " taken for flow, and still water drifts")  # fmt: skip
    return [_fault(level, "drift", row, col, float(np.hypot(east, north)), "m/s", count, told)]


def _ashore(level: Level, flow: np.ndarray, wet: np.ndarray) -> Iterator[FlowFault]:
    """Painted water whose way meets land within a cell or two."""
    speed = np.hypot(flow[..., 0], flow[..., 1])
    rows, cols = np.nonzero(wet & (speed > ASHORE_MPS))
    way = flow[rows, cols] / speed[rows, cols, None]
    ahead = [np.clip(np.rint(at + AHEAD * part).astype(int), 0, side - 1)
             for at, part, side in ((rows, way[:, 1], wet.shape[0]), (cols, way[:, 0], wet.shape[1]))]  # fmt: skip
    hits = np.zeros(wet.shape, np.float32)
    dry = ~wet[ahead[0], ahead[1]]
    hits[rows[dry], cols[dry]] = speed[rows, cols][dry]
    for row, col, cells in _patches(hits, hits > 0):
        told = f"water runs into land at {hits[row, col]:.2f} m/s"
        yield _fault(level, "ashore", row, col, hits[row, col], "m/s", cells, told)


def _apart(level: Level, flow: np.ndarray, wet: np.ndarray) -> Iterator[FlowFault]:
    """Where a cell gives or swallows much more than it passes on; the mode coherent mends it."""
    fastest = float(np.hypot(flow[..., 0], flow[..., 1]).max())
    if not fastest:
        return
    found = divergence(wet, flow[..., 0], flow[..., 1], level.grid.cell_m)
    size = np.abs(found)
    for row, col, cells in _patches(size, size * level.grid.cell_m > APART * fastest):
        told = f"water {'comes from nowhere' if found[row, col] > 0 else 'vanishes'}: {found[row, col]:+.3f} 1/s"
        yield _fault(level, "divergence", row, col, found[row, col], "1/s", cells, told)


def _patches(size: np.ndarray, where: np.ndarray) -> list[tuple[int, int, int]]:
    """(row, col) of the worst cell and the number of cells of each patch, the worst first."""
    from scipy import ndimage

    labels, count = ndimage.label(where, np.ones((3, 3)))
    if not count:
        return []
    numbers = np.arange(1, count + 1)
    cells = np.bincount(labels.ravel(), minlength=count + 1)[1:]
    places = ndimage.maximum_position(size, labels, numbers)
    found = [(*place, int(n)) for place, n in zip(places, cells, strict=True) if n >= LEAST_CELLS]
    return sorted(found, key=lambda at: -size[at[0], at[1]])[:MOST]


def _fault(level: Level, kind: str, row: int, col: int, value: float, unit: str, cells: int, told: str) -> FlowFault:
    x, y = level.grid.to_metres(int(row), int(col))
    return FlowFault(kind, float(x), float(y), round(float(value), 6), unit, int(cells), told)
