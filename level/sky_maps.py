"""Weather maps as arrays: onto the torus, seams, one sky over another (Z04, T04). Row 0 is south, as everywhere.

A map of 512² lands on WEATHER_GRID sample for sample; others cover the same ground, averaged where they are finer and
interpolated where they are coarser.
"""

from __future__ import annotations

import math

import numpy as np

from .layers import WEATHER_GRID
from .level import Level
from .weather import RAINY, middle_m, weather_at

SIDE, TILE_M, CELL_M = WEATHER_GRID.rows, WEATHER_GRID.extent_m[0], WEATHER_GRID.cell_m
BLOCK_ROWS = 256
SEAM = 1.3  # steps across the edge against those inside, from which on a map is said not to tile
STAGES = ("paint", "simulated", "painted", "final")


def resampled(values: np.ndarray, side: int = SIDE) -> np.ndarray:
    """`(rows, cols, channels)` of a torus as float32 `(side, side, channels)` of the same torus."""
    lefts = [np.arange(side) * (count / side) for count in values.shape[:2]]
    return _covered(values, lefts, [count / side for count in values.shape[:2]], True)


def placed(
    values: np.ndarray, extent_m: float = TILE_M, about_m: tuple[float, float] = (0.0, 0.0), feather_m: float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    """(float32 `(512, 512, channels)`, its weight `(512, 512)`) of a map that covers `extent_m` a side.

    `about_m` is its middle on the painted map, −35 000 … 35 000 east and north. The weight is 1 inside, 0 outside, and
    rises over `feather_m` from the border of a map smaller than the torus.
    """
    whole = extent_m >= TILE_M
    axis = np.arange(SIDE) * CELL_M - TILE_M / 2
    lefts, shares = [], []
    for count, middle in zip(values.shape[:2], about_m[::-1]):
        away = (axis - middle + TILE_M / 2) % TILE_M - TILE_M / 2  # where it is nearest to the middle
        # a whole map's sample is the cell's own, a smaller one is read about the place where the sample stands
        lefts.append((away + extent_m / 2 - (0.0 if whole else CELL_M / 2)) / extent_m * count)
        inside_m = extent_m / 2 - np.abs(away)
        t = np.clip(inside_m / feather_m, 0, 1) if feather_m > 0 else (inside_m >= 0).astype(float)
        shares.append(np.ones(SIDE) if whole else t * t * (3 - 2 * t))
    widths = [CELL_M / extent_m * count for count in values.shape[:2]]
    weight = (shares[0][:, None] * shares[1][None, :]).astype(np.float32)
    return _covered(values, lefts, widths, whole), weight


def _covered(values: np.ndarray, lefts: list[np.ndarray], widths: list[float], wraps: bool) -> np.ndarray:
    """Means of `values` over the cells that begin at `lefts` (rows, columns) and are `widths` samples wide."""
    rows, cols, channels = values.shape
    down, across = (_shares(left, width, count, wraps) for left, width, count in zip(lefts, widths, (rows, cols)))
    narrow = np.empty((rows, len(lefts[1]), channels), np.float32)
    for start in range(0, rows, BLOCK_ROWS):  # a large map never lies in memory as float64
        block = values[start : start + BLOCK_ROWS].swapaxes(0, 1)
        made = across @ block.reshape(cols, -1)
        narrow[start : start + BLOCK_ROWS] = made.reshape(-1, block.shape[1], channels).swapaxes(0, 1)
    return (down @ narrow.reshape(rows, -1)).reshape(-1, narrow.shape[1], channels).astype(np.float32)


def _shares(left: np.ndarray, width: float, count: int, wraps: bool):
    """Sparse `(cells, count)`: share of each sample in each cell, interpolated where cells are no wider."""
    from scipy import sparse

    if width > 1:
        index = np.floor(left).astype(np.int64)[:, None] + np.arange(math.ceil(width) + 1)
        low, high = left[:, None], left[:, None] + width
        share = np.maximum(np.minimum(index + 1, high) - np.maximum(index, low), 0) / width
    else:
        at = left + (width - 1) / 2
        index = np.floor(at).astype(np.int64)[:, None] + np.arange(2)
        share = 1 - np.abs(index - at[:, None])
    index = index % count if wraps else np.clip(index, 0, count - 1)
    rows = np.repeat(np.arange(len(left)), index.shape[1])
    return sparse.csr_array((share.ravel(), (rows, index.ravel())), shape=(len(left), count))


# Seams


def seam_ratio(values: np.ndarray) -> float:
    """How much larger steps across the edge are than those inside, the worse of both ways: about 1 where it tiles."""
    return max(_seam(values), _seam(values.swapaxes(0, 1)))


def _seam(values: np.ndarray) -> float:
    edge = float(np.abs(values[0].astype(np.float64) - values[-1]).mean())
    inside = float(np.abs(np.diff(values, axis=0)).mean(dtype=np.float64))
    return edge / inside if inside > 0 else float("inf") if edge > 0 else 1.0


def wrap_blended(values: np.ndarray, rows: int, cols: int) -> np.ndarray:
    """The map made to tile: within so many samples of an edge it is cross-faded with the opposite side, mirrored.

    At the edge both sides are their mean; what lies further in stays bit for bit.
    """
    values = values.copy()
    _fade(values, min(rows, values.shape[0] // 2))
    _fade(values.swapaxes(0, 1), min(cols, values.shape[1] // 2))
    return values


def _fade(values: np.ndarray, band: int) -> None:
    """In place along the first axis."""
    if band < 1:
        return
    share = (0.25 * (1 + np.cos(np.pi * np.arange(band) / band)))[:, None, None]
    low, high = values[:band].astype(np.float64), values[: -band - 1 : -1].astype(np.float64)
    values[:band] = low + (high - low) * share
    values[: -band - 1 : -1] = high + (low - high) * share


# Skies


def sky_map(level: Level, stage: str, time_s: float = 0.0) -> np.ndarray:
    """float32 `(512, 512, channels)` of a level's sky round the middle of its map, sample on sample with the paint.

    `paint` is the layer itself with its three weights, else what `weather_at` gives at world places, with its weight.
    """
    if stage == "paint":
        return np.array(level.layers["weather"].read(WEATHER_GRID.rect))
    axis = np.arange(SIDE) * CELL_M - TILE_M / 2
    east, north = middle_m(level.settings)
    x, y = np.meshgrid(axis + east, axis + north)
    return weather_at(level, time_s, x, y, None, stage)


def unpulled(sky: np.ndarray) -> np.ndarray:
    """Coverage, precipitation, type of what `weather.pulled` makes of them; where it only rains, type is cumulus."""
    coverage, rain, g = (np.asarray(part, np.float64) for part in np.moveaxis(sky, -1, 0))
    dry = np.maximum(1 - rain, 1e-6)
    before = np.where(coverage < RAINY, np.clip((coverage - RAINY * rain) / dry, 0, 1), coverage)
    kind = np.where(rain < 1, np.clip(2 * (g - rain) / dry, 0, 1), 1.0)
    return np.stack([before, rain, kind], -1).astype(np.float32)


def laid_over(under: np.ndarray, sky: np.ndarray, opacity: float = 1.0) -> np.ndarray:
    """A painted sky over another, float32 `(…, 6)` each: three channels, then the weight of each.

    Values are mixed by weight, so that an unpainted one lends nothing; where `sky` has no weight, `under` stays.
    """
    share = np.asarray(sky[..., 3:], np.float64) * opacity
    rest = under[..., 3:] * (1 - share)
    weight = share + rest
    mixed = (share * sky[..., :3] + rest * under[..., :3]) / np.where(weight > 0, weight, 1)
    keep = share == 0
    parts = np.where(keep, under[..., :3], mixed), np.where(keep, under[..., 3:], weight)
    return np.concatenate(parts, -1).astype(np.float32)
