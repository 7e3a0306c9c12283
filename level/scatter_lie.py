"""How things stand and lie where they are placed (L09).

Driftwood rests along the ground under its whole length, not on that at its middle alone. Its underside is straight;
the ground seldom is. A line is fitted to heights under both ends and between, so deep that no part of it floats; where
the ground bends too much for the thickness, a shorter piece lies there, or none.
"""

from __future__ import annotations

import numpy as np

from .level import Level
from .pick import ground_at
from .scatter_kinds import Kind
from .scatter_meshes import BEDDED

STATIONS = np.linspace(-0.5, 0.5, 9)  # along it, in its length
MOST_BEND = 0.017  # spread of the ground round the line, in its length: a third of the thinnest end of a log
MOST_BEND_M = 0.006  # and what nobody sees, m
SHORTER = 0.65  # by which a piece is cut where it doesn't fit, as often as it takes or the shortest is reached
CUTS = 4


def stand(level: Level, kind: Kind, found: np.ndarray, scale, gradient, sunk, turn) -> None:
    """Write height, size, yaw and tilt of things at their places; size 0 where one can't lie."""
    x, y, yaw = found["x"].astype(np.float64), found["y"].astype(np.float64), _yaw(kind, turn, gradient)
    deep = kind.sink * scale * sunk
    if kind.along_contour:
        least = kind.size_m[0] * min(level.settings.scatter.size, 1.0)
        scale, z, bend, rise, fits = lie(level, x, y, yaw, gradient, scale, least)
        yaw, gradient = tilted(yaw, gradient, rise)
        deep = np.maximum(kind.sink * scale * sunk, bend - BEDDED[kind.mesh] * scale)
        scale = scale * fits
    else:
        z = ground_at(level, x, y)
    lean = kind.align / np.sqrt(1 + (kind.align * gradient[0]) ** 2 + (kind.align * gradient[1]) ** 2)
    found["z"], found["scale"], found["yaw"] = z - deep, scale, yaw
    found["normal_x"], found["normal_y"] = -gradient[0] * lean, -gradient[1] * lean


def _yaw(kind: Kind, drawn: np.ndarray, gradient: np.ndarray) -> np.ndarray:
    if not kind.along_contour:
        return drawn * 2 * np.pi
    # waves roll logs until they lie along the shore; some stay askew
    askew = 2 * drawn - 1
    return np.arctan2(gradient[0], -gradient[1]) + 1.3 * askew * askew * askew


def lie(
    level: Level, x: np.ndarray, y: np.ndarray, yaw: np.ndarray, gradient: np.ndarray, scale: np.ndarray, least: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Lay things of length `scale` (n,) on the ground: scale, height of the line at the middle, how far the ground
    falls short of it at most (both m), its rise over run, and whether it fits."""
    way = np.stack([np.cos(yaw), np.sin(yaw)])
    flat = 1 / np.sqrt(1 + (gradient[0] * way[0] + gradient[1] * way[1]) ** 2)  # run of a piece of unit length
    scale = scale.copy()
    for cut in range(CUTS + 1):
        along = STATIONS[:, None] * (scale * flat)
        ground = ground_at(level, x + along * way[0], y + along * way[1])
        # least squares over stations that lie evenly round the middle; NumPy's own sum would hang on the batch's size
        rise = sum(at * z for at, z in zip(along, ground, strict=True)) / sum(at * at for at in along)
        rest = ground - rise * along
        low, high = rest.min(axis=0), rest.max(axis=0)
        fits = high - low <= MOST_BEND * scale + MOST_BEND_M
        if fits.all() or cut == CUTS:
            break
        scale = np.where(fits, scale, np.maximum(SHORTER * scale, np.minimum(least, scale)))
    return scale, (high + low) / 2, (high - low) / 2, rise, fits


def tilted(yaw: np.ndarray, gradient: np.ndarray, rise: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Yaw and gradient `(2, n)` of things that climb by `rise` along `yaw` and lean across as the ground does.

    A mesh's long axis is its yaw laid into the plane it stands on: a yaw turned by that plane's tilt gives it back.
    """
    way = np.stack([np.cos(yaw), np.sin(yaw)])
    across = gradient[1] * way[0] - gradient[0] * way[1]
    plane = rise * way + across * np.stack([-way[1], way[0]])
    turned = way + rise * plane
    return np.arctan2(turned[1], turned[0]), plane
