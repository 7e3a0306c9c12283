"""The whole current as 8 bits a channel, for engines: written by exporters, shown by the view `flow_exported` (T02).

R east, G north, B 255 on water; rows from the south, as the current's own. One code, here and in lib/flow_bytes.glsl:

    v = (byte − 128) / 127 × range_mps      and 0 where both are less than STILL_STEPS of a step away from it

128 is exactly 0, 1 … 255 reach the range either way, 0 is never written. What a sampler makes of a byte, byte / 255,
is no neutral 0.5: reading it as such is how still water comes to drift (EsProgram/InkPainter 50).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from .flow import Current
    from .level import Level

NEUTRAL = 128
MOST = 127  # steps either way
STILL_STEPS = 0.5  # between texels and in a sampler's float a byte is no whole number: less than this is still
LEAST_RANGE_MPS = 0.125


@dataclass(frozen=True)
class FlowBytes:
    """`bytes` uint8 `(rows, cols, 3)` of samples `cell_m` apart; `fastest_mps` a component, clipped over the range."""

    bytes: np.ndarray
    range_mps: float
    fastest_mps: float
    cell_m: float

    @property
    def step_mps(self) -> float:
        return self.range_mps / MOST

    @property
    def still(self) -> bool:
        """Whether nothing moves anywhere."""
        return bool((self.bytes[..., :2] == NEUTRAL).all())


def flow_bytes(level: Level) -> FlowBytes:
    """What exporters write of the level's current, kept with it."""
    from .flow import current  # loads SciPy

    made = current(level)
    asked = level.settings.flow.export_mps
    of, range_mps, have = level.derived.get("flow_bytes", (None, 0.0, None))
    if of is not made or range_mps != asked:
        have = coded(made, asked)
        level.derived["flow_bytes"] = made, asked, have
    return have


def coded(made: Current, range_mps: float = 0.0) -> FlowBytes:
    """A current in bytes; range 0: the smallest power of two that holds it."""
    fastest = float(np.abs(made.packed[..., :2]).max())
    chosen = range_mps or fitting_range(fastest)
    both = encoded(made.packed[..., :2], chosen)
    water = np.where(made.packed[..., 3:] > 0, 255, 0).astype(np.uint8)
    return FlowBytes(np.concatenate([both, water], -1), chosen, fastest, made.cell_m)


def fitting_range(fastest_mps: float) -> float:
    """The smallest power of two in m/s that holds a speed."""
    return max(2.0 ** math.ceil(math.log2(fastest_mps)), LEAST_RANGE_MPS) if fastest_mps > 0 else LEAST_RANGE_MPS


def encoded(flow_mps: np.ndarray, range_mps: float) -> np.ndarray:
    """Bytes of m/s, uint8 of the same shape; what is over the range is clipped to it."""
    steps = np.rint(np.asarray(flow_mps, np.float64) * (MOST / range_mps))
    return (np.clip(steps, -MOST, MOST) + NEUTRAL).astype(np.uint8)


def decoded(values: np.ndarray, range_mps: float) -> np.ndarray:
    """m/s `(…, 2)` from bytes `(…, 2 or 3)`, which may be mixed ones between texels."""
    steps = np.asarray(values, np.float64)[..., :2] - NEUTRAL
    moves = np.abs(steps).max(-1, keepdims=True) >= STILL_STEPS
    return np.where(moves, steps * (range_mps / MOST), 0.0)
