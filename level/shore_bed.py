"""The bed of the shore clock from depth alone: what a process works out for `shore.shore_map` (D03)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy import ndimage

from .bottleneck import Toll, bottleneck, falling
from .request import Request
from .settings import Settings
from .tide import band_m

ROCKS_M = 4.0  # sigma of the bed that the water's body knows: rocks smaller than that don't dent it


@dataclass(frozen=True)
class BedRequest(Request["Bed"]):
    """All that the map follows from."""

    depth_m: np.ndarray
    cell_m: float
    seeds: tuple
    settings: Settings

    def kept(self) -> BedRequest:
        return replace(self, depth_m=np.array(self.depth_m, np.float32))

    @property
    def answer_bytes(self) -> int:
        return 6 * 4 * self.depth_m.size + (1 << 12)

    def answered(self) -> Bed:
        depth = self.depth_m
        start = (depth > 0) & open_edge(depth.shape, self.seeds, self.cell_m)
        least, fallen = _from_the_deep(depth, start, self.settings, self.cell_m)
        return Bed(pack(self.settings, depth, least, fallen, self.cell_m), least, fallen)


@dataclass(frozen=True)
class Bed:
    """`packed`, `bottleneck` and `falling` of a map."""

    packed: np.ndarray
    bottleneck: np.ndarray
    falling: np.ndarray


def open_edge(shape: tuple[int, int], seeds: tuple, cell_m: float) -> np.ndarray:
    """Where the sea comes from if it is wet there: cells of the level's border, and seed points."""
    start = np.zeros(shape, bool)
    start[0], start[-1], start[:, 0], start[:, -1] = True, True, True, True
    for x, y in seeds:
        row, col = round(y / cell_m), round(x / cell_m)
        if 0 <= row < shape[0] and 0 <= col < shape[1]:
            start[row, col] = True
    return start


def toll_of(settings: Settings) -> Toll | None:
    """What flats cost, so that fronts of the depth's clock take their time there; None: nothing."""
    shore = settings.shore
    if not shore.monotone or shore.flat_slope <= 0 or settings.timing.share == 1.0:
        return None
    return Toll(shore.flat_slope, shore.range_m)


def _from_the_deep(depth: np.ndarray, start: np.ndarray, settings: Settings, cell_m: float):
    """Bottleneck depth from the deep part of the border, and less the toll: where the border cuts a beach, fronts come
    from the sea too."""
    nowhere, toll = np.full(depth.shape, -np.inf, np.float32), toll_of(settings)
    if not start.any():
        return nowhere, nowhere
    deep = start & (depth >= min(settings.shore.range_m, 0.95 * float(depth[start].max())))
    marker = np.where(deep, depth, nowhere)
    least = bottleneck(marker, depth)
    cut_off = start & ~(least > 0)  # water that only its own shallow border joins to the sea
    if cut_off.any():
        marker = np.where(cut_off, depth, marker)
        least = bottleneck(np.maximum(least, marker), depth)
    return least, least if toll is None else falling(marker, least, cell_m, toll)


def pack(settings: Settings, depth, least, fallen, cell_m: float) -> np.ndarray:
    """The four channels from depth and the bottleneck depth, without and with the toll on flats.

    The swash comes as far as the lowest way from the sea stays below the run-up: a tide pool behind a low rim is
    topped, a hollow inland stays still (D03).
    """
    limit = 1.1 * settings.shore.range_m * settings.shore.runup + 0.05
    packed = _packed(settings, depth, fallen, cell_m, limit)
    if settings.tide.on:
        sea = packed[..., 2] > 0
        high = _packed(settings, depth, fallen, cell_m, limit + band_m(settings)[1])
        packed = np.where(sea[..., None], packed, high)
        packed[..., 2] = _wakes(sea, depth, least, limit)
    return packed


def _packed(settings: Settings, depth, least, cell_m: float, limit: float) -> np.ndarray:
    shore = settings.shore
    reached = least > -limit
    clock = np.where(reached, least, depth) if shore.monotone else depth
    sigma = shore.smooth_m / cell_m
    if sigma > 0.05:
        smooth = ndimage.gaussian_filter(clock, sigma, mode="nearest", truncate=3)
        keep = np.clip(clock / 1.0, 0, 1)  # the true bed at the water line, so that lines and water meet there
        clock = clock + (smooth - clock) * keep * keep * (3 - 2 * keep)
    wide = ndimage.gaussian_filter(clock, max(ROCKS_M / cell_m, 0.3), mode="nearest", truncate=3)
    packed = np.zeros((*depth.shape, 4), np.float32)
    packed[..., 0], packed[..., 1], packed[..., 3] = clock, depth, wide
    packed[..., 2] = reached | _banks(reached, depth, limit)
    return packed


def _banks(reached, depth, limit_m: float) -> np.ndarray:
    """Land too high for the swash, right beside it: counted as sea, or a steep beach would wear the cells as teeth.

    Not where a hollow lies behind it that the sea doesn't reach.
    """
    high = depth <= -limit_m
    beside = ndimage.binary_dilation(reached, np.ones((3, 3), bool))
    return high & beside & ~ndimage.binary_dilation(~high & ~reached, np.ones((3, 3), bool))


def _wakes(sea, depth, least, limit_m: float) -> np.ndarray:
    """The tide over which each cell is sea: it is reached itself, or the bank of one that is; exact at tide 0.

    A bank that a hollow comes to lie behind at a higher tide stays one.
    """
    own = -np.float32(limit_m) - least
    bank = ndimage.minimum_filter(own, 3, mode="nearest")
    rows, cols = own.shape
    around_own, around_depth = (np.pad(values, 1, mode="edge") for values in (own, depth))
    hollow = np.zeros(own.shape, bool)
    for row, col in np.ndindex(3, 3):
        there = slice(row, row + rows), slice(col, col + cols)
        hollow |= (around_depth[there] > -limit_m - bank) & (around_own[there] > bank)
    wakes = np.where(hollow, own, bank)
    return np.where(sea, np.minimum(wakes, -1e-6), np.maximum(wakes, 0.0))
