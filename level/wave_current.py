"""The current that waves travel through: rivers, their jets, painted flow (D35).

What carries foam to the shore and to flow points is no stream of water and moves no waves.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass

import numpy as np

from .level import Level
from .river_flow import RiverFlow, river_flow
from .river_jet import smooth
from .weather_keys import base_settings

LEAST_MPS = 0.01  # slower, it is still water
BORDER_M = 30.0  # over which it dies out before the level's border: waves come in through still water
KEPT = 6  # of as many strides, and levels of the sea


@dataclass(frozen=True)
class WaveCurrent:
    """`mps` float32 `(rows, cols, 2)`, east and north; `name` is the same for the same bytes."""

    mps: np.ndarray
    name: str


def wave_current(level: Level, depth_m: np.ndarray, cell_m: float, of_depth: tuple) -> WaveCurrent | None:
    """That in the sea on samples so far apart, as many as `depth_m` has; None where nothing moves any of it.

    `of_depth` names those depths: frames ask again and again. While a stroke is open the last current stays.
    """
    rivers = river_flow(level)
    if rivers is None and level.layers["flow"].neutral:
        return None
    mps = _everywhere(level, rivers, depth_m.shape, cell_m)
    kept: dict = level.derived.setdefault("wave_current_at_sea", {})
    key = (depth_m.shape, *of_depth)
    if key not in kept or kept[key][0] is not mps:
        kept[key] = mps, _at_sea(mps, depth_m > 0)
        for gone in list(kept)[:-KEPT]:
            del kept[gone]
    return kept[key][1]


def _at_sea(mps: np.ndarray, sea: np.ndarray) -> WaveCurrent | None:
    felt = sea & (np.hypot(mps[..., 0], mps[..., 1]) > LEAST_MPS)
    if not felt.any():
        return None
    mps = np.where(felt[..., None], mps, np.float32(0))
    return WaveCurrent(mps, hashlib.blake2b(mps.tobytes(), digest_size=16).hexdigest())


def _everywhere(level: Level, rivers: RiverFlow | None, shape: tuple[int, int], cell_m: float) -> np.ndarray:
    """The same on land too, kept until something changes."""
    settings = base_settings(level)
    flow, share = settings.flow, settings.timing.current * settings.flow.on
    key = (None if rivers is None else rivers.key, level.layer_revision("flow"), flow.rivers, flow.painted, share)
    kept: dict = level.derived.setdefault("wave_current", {})
    had = kept.get(shape)
    if had is not None and (level.live or had[0] == key):
        return had[1]
    stride = round(cell_m / level.grid.cell_m)
    painted = level.layers["flow"].read(level.grid.rect)[::stride, ::stride]
    mps = flow.rivers * _of_rivers(rivers, shape, cell_m) + flow.painted * painted
    away = [np.minimum(np.arange(n), np.arange(n)[::-1]) * cell_m for n in shape]
    inside = smooth(0.0, BORDER_M, np.minimum.outer(*away))
    kept[shape] = key, (share * inside[..., None] * mps).astype(np.float32)
    for gone in list(kept)[:-KEPT]:
        del kept[gone]
    return kept[shape][1]


def _of_rivers(rivers: RiverFlow | None, shape: tuple[int, int], cell_m: float) -> np.ndarray:
    """East and north in m/s, `(rows, cols, 2)`: in a river its own, out at sea the sum of the jets."""
    total = np.zeros((*shape, 2))
    if rivers is None:
        return total
    for mouth in rivers.mouths:
        box = tuple(slice(int(np.clip(low, 0, n)), int(np.clip(high, 0, n)))
                    for (low, high), n in zip(mouth.box(cell_m), shape, strict=True))  # fmt: skip
        y, x = np.mgrid[box] * cell_m
        total[box] += mouth.speed(x, y, cell_m)[..., None] * (mouth.east, mouth.north)
    river = rivers.on(shape, cell_m)
    own = river[..., 2:]
    return total * (1 - own) + own * river[..., :2]
