"""Maps of what the ground is like: the weights of its materials and where rain stays."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from ...level import Level
from ...level.beat import beat
from .map_makers import Rows, Samples, kept, spooled
from .maps import row_slices

MOST_SIDE = 2049  # samples a side: larger levels are read with a stride
ROW_NUMBERS = 8  # float64 numbers a sample that the rule works with
MAKING = 0.9  # of the time that such a map takes; the rest is for its file
TOP = 255


def stride_of(level: Level) -> int:
    """Of how many samples of the level these maps have one."""
    return max(1, -(-(max(level.grid.shape) - 1) // (MOST_SIDE - 1)))


def weights(first: int) -> Callable[[Level], Samples]:
    """A maker of four of the eight weights of the ground's materials, from that one on."""

    def make(level: Level) -> Samples:
        whole = ground_weights(level)
        rows, cols, _ = whole.values.shape
        return Samples(Rows((rows, cols, 4), lambda *at: whole.values.read(*at)[..., first : first + 4]), whole.cell_m)

    return make


@kept
def ground_weights(level: Level) -> Samples:
    """All eight weights of the ground's materials, in 255ths whose sum is 255."""
    from ...level.ground_cover import cover_weights

    stride = stride_of(level)
    rows, cols = (np.arange(0, n, stride) for n in level.grid.shape)
    cell_m = stride * level.grid.cell_m

    def blocks() -> Iterator[np.ndarray]:
        for block in row_slices(len(rows), ROW_NUMBERS * len(cols)):
            beat(MAKING * block.stop / len(rows))
            yield shared_out(cover_weights(level, rows[block], cols, cell_m))

    return Samples(spooled((len(rows), len(cols), 8), blocks(), TOP), cell_m)


def shared_out(shares: np.ndarray) -> np.ndarray:
    """Shares of 1 on the last axis as whole numbers with the sum TOP: the largest remainders are rounded up."""
    exact = shares * TOP
    whole = np.floor(exact)
    missing = TOP - whole.sum(-1, keepdims=True)
    rank = np.argsort(np.argsort(-(exact - whole), -1, kind="stable"), -1, kind="stable")
    return (whole + (rank < missing)).astype(np.uint8)


def puddles(level: Level) -> Samples | None:
    from ...level.puddles import puddles_m

    stride = stride_of(level)
    depth = puddles_m(level, stride)
    if not depth.any():
        return None
    return Samples(depth[..., None], stride * level.grid.cell_m, 0.0, float(depth.max()))
