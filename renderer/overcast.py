"""How much cloud stands over a camera, for the light that comes from the whole sky (Z17)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..level import Level
from ..level.weather import weather_at

AROUND_M = 9000.0
SIDE = 12  # places a side that are asked
COVER_STEPS, DEPTH_STEPS = 64, 4  # a table of the sky is made for each step of the cover, for each part of an octave
DEPTHS = ((0.0, 0.5, 1.0), (14.0, 22.0, 60.0))  # gradient coordinate of the type, optical depth of its layer
RAIN_DEPTH = 30.0
SEEN = (0.22, 0.95)  # coverage in the weather map from which on sky is hidden, and at which all of it is


class Overcast(NamedTuple):
    """Share of the sky that clouds hide, 0 … 1, and how deep they are."""

    cover: float
    depth: float


def overcast(level: Level, time_s: float, camera: tuple[float, float], shown: bool = True) -> Overcast | None:
    """What hangs over a camera in clouds in volume; None where there are none, nothing where they aren't shown."""
    if not level.settings.clouds.on:
        return None
    if not shown:
        return Overcast(0.0, 1.0)
    axis = (np.arange(SIDE) + 0.5) / SIDE * 2 - 1
    x, y = np.meshgrid(axis * AROUND_M, axis * AROUND_M)
    near = np.exp(-2 * (x**2 + y**2) / AROUND_M**2)
    sky = weather_at(level, time_s, x + camera[0], y + camera[1], camera).astype(np.float64)
    hidden = sky_hidden(sky[..., 0])
    depth = np.interp(sky[..., 2], *DEPTHS) + RAIN_DEPTH * sky[..., 1]
    cover = float((hidden * near).sum() / near.sum())
    deep = float((depth * hidden * near).sum() / max((hidden * near).sum(), 1e-6)) or DEPTHS[1][1]
    return Overcast(round(cover * COVER_STEPS) / COVER_STEPS,
                    2.0 ** (round(math.log2(max(deep, 1.0)) * DEPTH_STEPS) / DEPTH_STEPS))  # fmt: skip


def sky_hidden(coverage):
    """Share of the sky that clouds of a coverage hide, seen from below."""
    t = np.clip((np.asarray(coverage, np.float64) - SEEN[0]) / (SEEN[1] - SEEN[0]), 0, 1)
    return t * t * (3 - 2 * t)
