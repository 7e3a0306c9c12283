"""Maps of when waves come and how deep one wades, as `map_makers.py` makes the others: they take the longest of all."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...level import Level
from ...level.beat import beat
from .map_makers import Rows, Samples, kept, spooled
from .maps import row_slices

NO_WAVE_S = -60_000.0  # a half float still holds it
WALK_SIDE = 257  # samples a side at which the sea is asked over a period
DEEP_M = 4.0  # wading depths that are told apart
ROW_NUMBERS = 16  # float64 numbers a sample that the clock of fronts works with
MAKING = 0.8  # of the time that such a map takes; the rest is for its file
SWELLS = 3  # as many as a picture has colours


@kept
def arrivals(level: Level) -> Samples | None:
    from ...level.timing import Clock, map_rows, period_s

    clock, shape, any_wave = Clock.of(level, 0.0), (*level.grid.shape, SWELLS), False

    def blocks() -> Iterator[np.ndarray]:
        nonlocal any_wave
        for rows in row_slices(shape[0], ROW_NUMBERS * shape[1]):
            beat(MAKING * rows.stop / shape[0])
            values = np.full((rows.stop - rows.start, *shape[1:]), NO_WAVE_S, np.float32)
            for index, swell in enumerate(_swells(map_rows(level, 0.0, rows, clock))):
                values[..., index] = np.nan_to_num(swell, copy=False, nan=NO_WAVE_S)
            any_wave = any_wave or bool((values != NO_WAVE_S).any())
            yield values

    samples = Samples(spooled(shape, blocks()), level.grid.cell_m, numbers={"period_s": float(period_s(level, 0.0))})
    return samples if any_wave else None


def _swells(maps: dict[str, np.ndarray]) -> list[np.ndarray]:
    return [values for name, values in maps.items() if name != "front_speed"][:SWELLS]


def front_phase(level: Level) -> Samples | None:
    made = arrivals(level)
    if made is None:
        return None
    period = made.numbers["period_s"]

    def read(start: int, stop: int) -> np.ndarray:
        first = made.values[start:stop][..., :1].astype(np.float64)
        return np.where(first == NO_WAVE_S, 1.0, np.mod(-first / period, 1.0)).astype(np.float32)

    return Samples(Rows((*level.grid.shape, 1), read), made.cell_m, numbers=made.numbers)


@kept
def walkable(level: Level) -> Samples | None:
    """Depths on a coarser grid, for every sample is a sea of its own; the tide on the level's samples there."""
    from ...level.walk import STEEP_M, highest_sea_m, wading_m

    stride = max(1, -(-(max(level.grid.shape) - 1) // (WALK_SIDE - 1)))
    ground = level.height[::stride, ::stride].astype(np.float64)
    cell_m = stride * level.grid.cell_m
    y, x = (np.arange(n) * cell_m for n in ground.shape)
    least, most = wading_m(level, ground, *np.meshgrid(x, y), DEEP_M)
    highest = highest_sea_m(level, level.grid.rect, stride)
    low = min(float(highest[highest > STEEP_M].min(initial=0.0)) - 1.0, -1.0)
    high = max(float(highest.max()), low + 1.0)
    values = np.stack([least, most, np.maximum(highest, low)], -1)
    return Samples(values.astype(np.float32), cell_m, (0.0, 0.0, low), (DEEP_M, DEEP_M, high))
