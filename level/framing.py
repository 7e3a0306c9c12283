"""Where cameras should stand: a level without cameras gets `play`, `beach` and `survey` from its own shape (D40).

Pure geometry on a coarse copy of the ground. The best piece of shore is long, gently sloping and near the middle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .level import Level
from .objects import Camera
from .sun import light_angles

COARSE = 257  # samples a side that are looked at
ASPECT = 16 / 9
EYE_M = 1.7
GOOD_SLOPE = 0.06  # a beach face artists would pick


@dataclass(frozen=True)
class Shore:
    """A place on the water line: world x, y and the heading out to sea."""

    x: float
    y: float
    seaward_deg: float


def cameras(level: Level) -> list[Camera]:
    """`play`, `beach` and `survey` for a level: three-quarter from above, eye height at the swash, the whole bay."""
    shore = find_shore(level)
    if shore is None:
        east, north = level.grid.extent_m
        shore = Shore(east / 2, north / 2, 180.0)
    return [_play(level, shore), _beach(level, shore), _survey(level, shore)]


def find_shore(level: Level) -> Shore | None:
    """The piece of water line to look at; None when there is only land or only sea."""
    from scipy import ndimage

    stride = max(1, math.ceil(max(level.grid.shape) / COARSE))
    cell_m = level.grid.cell_m * stride
    height = level.height[::stride, ::stride].astype(np.float64) - level.sea_level_m
    sea = _sea(height < 0)
    line = sea & ndimage.binary_dilation(~sea)
    if not line.any():
        return None
    reach = max(min(35.0, min(level.grid.extent_m) / 8) / cell_m, 1.0)
    share = ndimage.gaussian_filter(sea.astype(np.float64), reach, mode="nearest")
    north, east = np.gradient(share)
    slope = np.hypot(*np.gradient(ndimage.gaussian_filter(height, max(reach / 3, 0.7), mode="nearest"), cell_m))
    score = (np.hypot(north, east) * reach) ** 4  # long and straight: 0.4 at a straight shore
    score *= np.exp(-((np.log(np.maximum(slope, 1e-4) / GOOD_SLOPE) / 1.2) ** 2))  # gently sloping
    rows, cols = (np.linspace(-1, 1, n) for n in height.shape)
    score *= np.exp(-0.8 * (rows[:, None] ** 2 + cols[None, :] ** 2))  # near the middle
    round_about = [ndimage.gaussian_filter(part, 1.5 * reach) for part in (np.where(line, score, 0.0), line * 1.0)]
    score = round_about[0] / np.maximum(round_about[1], 1e-9)  # and so for a long way
    row, col = np.unravel_index(np.argmax(np.where(line, score, -1)), line.shape)
    seaward = math.degrees(math.atan2(east[row, col], north[row, col])) % 360
    return Shore(float(col * cell_m), float(row * cell_m), seaward)


def _sea(wet: np.ndarray) -> np.ndarray:
    """Wet cells that reach the border; all of them when none does."""
    from scipy import ndimage

    pools, _ = ndimage.label(wet)
    rim = np.unique(np.concatenate([pools[0], pools[-1], pools[:, 0], pools[:, -1]]))
    sea = np.isin(pools, rim[rim > 0])
    return sea if sea.any() else wet


def _forward(yaw_deg: float) -> np.ndarray:
    return np.array([math.sin(math.radians(yaw_deg)), math.cos(math.radians(yaw_deg))])


def stand_at(level: Level, x: float, y: float) -> float:
    """What one stands on at a point: ground or still water, whichever is higher; outside, the nearest edge. Metres."""
    row, col = level.grid.to_cells(y_m=y, x_m=x)
    row, col = (min(max(round(v), 0), n - 1) for v, n in zip((row, col), level.grid.shape))
    return max(float(level.height[row, col]), level.sea_level_m)


def looking_at(
    level: Level, name: str, target, yaw_deg: float, pitch_deg: float, away_m: float, fov_deg=45.0
) -> Camera:
    """A camera `away_m` metres from a world point (x, y, z) that has it in the middle, never under the ground."""
    pitch = math.radians(pitch_deg)
    x, y = np.array(target[:2]) - _forward(yaw_deg) * away_m * math.cos(pitch)
    z = max(target[2] - away_m * math.sin(pitch), stand_at(level, x, y) + EYE_M)
    yaw_deg = round(yaw_deg % 360, 2) % 360
    place = {key: round(float(value), 3) for key, value in zip("xyz", (x, y, z))}
    return Camera(id=name, **place, yaw_deg=yaw_deg, pitch_deg=round(pitch_deg, 2), fov_deg=fov_deg)


def frame(level: Level, camera: Camera, target=None) -> Camera:
    """The same camera turned on nothing else but moved so that a point, or the whole level, fills its picture."""
    east, north = level.grid.extent_m
    if target is None:
        middle = (east / 2, north / 2)
        target, wide = (*middle, stand_at(level, *middle)), max(east, north)
    else:
        wide = min(max(min(east, north) * 0.12, 12.0), 60.0)
    away = wide / (2 * math.tan(math.radians(camera.fov_deg) / 2))
    pitch = min(camera.pitch_deg, -15.0)
    return looking_at(level, camera.id, target, camera.yaw_deg, pitch, away, camera.fov_deg)


def _play(level: Level, shore: Shore) -> Camera:
    """Three quarters from above: the shore runs diagonally, the sun stands beyond so that the water glints (D40)."""
    sun = light_angles(level.settings.light)[0]
    turns = [shore.seaward_deg + turn for turn in (-45, 45, 135, 225)]
    yaw = max(turns, key=lambda turn: math.cos(math.radians(turn - sun)))
    wide = min(max(0.2 * min(level.grid.extent_m), 12.0), 110.0)
    away = wide / (2 * math.tan(math.radians(22.5)) * ASPECT)
    aim = np.array([shore.x, shore.y]) + _forward(shore.seaward_deg) * wide * 0.06
    return looking_at(level, "play", (*aim, level.sea_level_m), yaw, -55.0, away)


def _beach(level: Level, shore: Shore) -> Camera:
    """Eye height at the swash, along the shore towards the higher land."""
    sides = [shore.seaward_deg + 68, shore.seaward_deg - 68]
    yaw = max(sides, key=lambda side: _rise_deg(level, shore, side + (22 if side > shore.seaward_deg else -22)))
    reach = level.settings.shore.range_m * level.settings.shore.runup
    stand = min(max(reach / GOOD_SLOPE * 0.5, 2.0), 12.0)
    x, y = np.array([shore.x, shore.y]) - _forward(shore.seaward_deg) * stand
    eye = (x, y, stand_at(level, x, y) + EYE_M)
    return looking_at(level, "beach", eye, yaw, -5.0, 0.0, 50.0)


def _rise_deg(level: Level, shore: Shore, heading_deg: float) -> float:
    """How high the land stands over the horizon along a heading, seen from the shore."""
    away = np.linspace(20, max(level.grid.extent_m), 60)
    x, y = shore.x + away * _forward(heading_deg)[0], shore.y + away * _forward(heading_deg)[1]
    east, north = level.grid.extent_m
    inside = (x >= 0) & (x <= east) & (y >= 0) & (y <= north)
    rise = [(stand_at(level, px, py) - level.sea_level_m) / d for px, py, d in zip(x[inside], y[inside], away[inside])]
    return math.degrees(math.atan(max(rise, default=0.0)))


def _survey(level: Level, shore: Shore) -> Camera:
    """High enough for the whole bay and the horizon: 300 m over a level of 600 m, scaled to others."""
    side = max(level.grid.extent_m)
    up = min(max(side * 0.5, 20.0), max(300.0, side * 0.25))
    east, north = level.grid.extent_m
    middle = (east / 2, north / 2)
    pitch = -24.0
    away = up / math.sin(math.radians(-pitch))
    yaw = shore.seaward_deg + 25
    return looking_at(level, "survey", (*middle, level.sea_level_m), yaw, pitch, away)
