"""A cut through the shore at one moment: bed, surface and the masks along it, from the CPU twin (D03, D30)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .level import Level
from .pick import ground_at
from .shore import shore_map
from .waves import sea_at

STEEP_ENOUGH = 1e-4  # below that the bed has no direction of its own and the cut runs north


@dataclass(frozen=True)
class Section:
    """Arrays of one length; `along_m` is 0 at the picked point and grows towards land, heights in level metres."""

    along_m: np.ndarray
    ground_m: np.ndarray
    surface_m: np.ndarray
    a: np.ndarray
    b: np.ndarray


def section(level: Level, t: float, x: float, y: float, length_m: float = 160.0, samples: int = 240) -> Section:
    """The cut of `length_m` through a world point, across the depth contours there."""
    bed = shore_map(level).at([x], [y])["smoothed"]
    uphill = -np.array([float(bed.dx[0]), float(bed.dy[0])])
    steep = float(np.hypot(*uphill))
    east, north = uphill / steep if steep > STEEP_ENOUGH else (0.0, 1.0)
    along = np.linspace(-length_m / 2, length_m / 2, samples)
    at_x, at_y = x + along * east, y + along * north
    sea = sea_at(level, t, at_x, at_y)
    ground = np.asarray(ground_at(level, at_x, at_y), np.float64)
    return Section(along, ground, np.maximum(sea.height_m, ground), sea.shore.a, sea.shore.b)
