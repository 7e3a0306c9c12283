"""The rows of a picture in which water can be: none above the horizon, where drawing would be for nothing."""

from __future__ import annotations

import math
from contextlib import contextmanager

from ..level.river_map import has_rivers
from ..level.waves import largest_height_m

HIGHEST_M = 3.0  # over the sea: what is lower may lie under water in one moment or another
MARGIN = 0.04  # of the rows: what pushes the water lifts it too


def low_m(frame) -> float:
    """Up to what height over the sea land counts as possibly under water; below a camera that is over the waves."""
    height = _above_waves(frame)
    return min(HIGHEST_M, height) if height > 0 else HIGHEST_M


def water_rows(frame, rows: int) -> int:
    """How many of so many rows, from the lowest up, can show water or land as low; all where waves top the camera."""
    rise = float(frame.matrices.ray_y[2])
    if _above_waves(frame) <= 0 or rise <= 1e-6 or has_rivers(frame.level):  # they may run above the camera
        return rows
    horizon = -float(frame.matrices.ray_centre[2]) / rise
    return min(max(math.ceil((horizon * 0.5 + 0.5 + MARGIN) * rows), 0), rows)


def _above_waves(frame) -> float:
    """Metres of the camera over the still sea, 0 where waves may stand as high."""
    height = float(frame.matrices.position[2]) - frame.level.sea_level_m
    return height - 0.05 if height > largest_height_m(frame.level) + 0.1 else 0.0


@contextmanager
def lowest_rows(framebuffer, rows: int):
    """Draw into the lowest rows of a framebuffer's viewport alone."""
    left, bottom, width, _ = framebuffer.viewport
    framebuffer.use()
    framebuffer.scissor = left, bottom, width, rows
    try:
        yield
    finally:
        framebuffer.scissor = None
