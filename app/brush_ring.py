"""The brush ring: circles that follow the ground, as world points and as pixels, with what the land hides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..level import Level
from ..level.objects import Camera
from ..level.pick import ground_at
from .camera_control import place, to_screen

POINTS = 72
RAY_SAMPLES = 24
LIFT_M = 0.04  # ring points float a little, so that they don't hide themselves


@dataclass(frozen=True)
class ScreenLine:
    """A line in pixels (n, 2) with, for each of its n - 1 pieces, whether it is drawn and whether land hides it."""

    points: np.ndarray
    drawn: np.ndarray
    hidden: np.ndarray


def circle(level: Level, x: float, y: float, radius_m: float, points: int = POINTS) -> np.ndarray:
    """A closed circle on the ground as world points (points + 1, 3)."""
    turn = np.linspace(0, 2 * np.pi, points + 1)
    px, py = x + radius_m * np.cos(turn), y + radius_m * np.sin(turn)
    return np.stack([px, py, ground_at(level, px, py) + LIFT_M], axis=1)


def along(level: Level, start, end, points: int = 48) -> np.ndarray:
    """A straight line on the ground between two world points, (points, 3)."""
    part = np.linspace(0, 1, points)
    px, py = start[0] + (end[0] - start[0]) * part, start[1] + (end[1] - start[1]) * part
    return np.stack([px, py, ground_at(level, px, py) + LIFT_M], axis=1)


def hidden_by_land(level: Level, camera: Camera, points: np.ndarray) -> np.ndarray:
    """Whether the ground stands between the camera and each world point (n, 3); a coarse march is enough for a ring."""
    eye = place(camera)
    part = np.linspace(0.02, 0.985, RAY_SAMPLES)[:, None]
    x, y, z = (eye[i] + (points[None, :, i] - eye[i]) * part for i in range(3))
    east, north = level.grid.extent_m
    inside = (x >= 0) & (x <= east) & (y >= 0) & (y <= north)
    return ((ground_at(level, x, y) > z) & inside).any(axis=0)


def on_screen(level: Level, camera: Camera, size: tuple[int, int], points: np.ndarray) -> ScreenLine:
    """World points (n, 3) as a line in a picture of `size`."""
    pixels, ahead = to_screen(camera, size, points)
    hidden = hidden_by_land(level, camera, points)
    return ScreenLine(pixels, ahead[1:] & ahead[:-1], hidden[1:] & hidden[:-1])
