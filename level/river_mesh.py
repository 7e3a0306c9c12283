"""Ribbons along rivers (H32): u across from the right bank, v along, in metres; the level of the river's own line."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .level import Level
from .objects import River
from .river_join import line_of, rivers

ACROSS = 5  # vertices
MOST_STEP_M, LEVEL_OFF_M = 8.0, 0.03  # a longer piece of line is cut; a level or bank so far off it too
FULL_MPS = 10.0  # speed that vertex colour calls 1


@dataclass(frozen=True)
class Ribbon:
    """A river's surface, world metres: `xyz` `(n, 3)`, `uv` `(n, 2)`, `triangles` `(m, 3)` anticlockwise from above,
    `left` `(n, 2)` to its left bank, `colours` `(n, 4)`: speed / 10 m/s, foam, share of the way to the middle, 1.

    `off_m`: the largest distance of its level from the line's.
    """

    name: str
    xyz: np.ndarray
    uv: np.ndarray
    left: np.ndarray
    colours: np.ndarray
    triangles: np.ndarray
    off_m: float


def ribbons(level: Level) -> list[Ribbon]:
    """One of each river that is drawn, falls included; none where rivers are off."""
    return [_ribbon(level, river) for river in rivers(level)] if level.settings.river.on else []


def _ribbon(level: Level, river: River) -> Ribbon:
    line = line_of(level, river)
    kept = _kept(line)
    off_m = float(np.abs(np.interp(line.along_m, line.along_m[kept], line.level_m[kept]) - line.level_m).max())
    way = np.stack([np.gradient(line.x, line.along_m), np.gradient(line.y, line.along_m)], -1)[kept]
    way /= np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-9)
    left = np.stack([-way[:, 1], way[:, 0]], -1)
    across = np.linspace(-1, 1, ACROSS)
    half, middle = line.half_m[kept], np.stack([line.x, line.y], -1)[kept]
    xy = middle[:, None] + left[:, None] * (half[:, None] * across)[..., None]
    z = np.broadcast_to(line.level_m[kept][:, None], xy.shape[:2])
    u = half[:, None] * (across + 1)
    v = np.broadcast_to(line.along_m[kept][:, None], u.shape)
    speed = np.clip(line.speed_mps[kept] / FULL_MPS, 0, 1)[:, None] + 0 * u
    inner = np.broadcast_to(1 - np.abs(across), u.shape)
    colours = np.stack([speed, _foam(level, line)[kept][:, None] + 0 * u, inner, np.ones_like(u)], -1)
    return Ribbon(
        river.id,
        np.concatenate([xy, z[..., None]], -1).reshape(-1, 3),
        np.stack([u, v], -1).reshape(-1, 2),
        np.repeat(left, ACROSS, axis=0),
        colours.reshape(-1, 4),
        _faces(len(kept)),
        off_m,
    )


def _foam(level: Level, line) -> np.ndarray:
    """Foam by speed and by the lean of the surface, as the level's settings have it."""
    look = level.settings.river
    lean = np.degrees(np.arctan(np.abs(np.gradient(line.level_m, line.along_m))))

    def share(values, low: float, high: float) -> np.ndarray:
        return np.clip((values - low) / max(high - low, 1e-6), 0, 1)

    fast = look.speed_foam * share(line.speed_mps, look.speed_low_mps, look.speed_high_mps)
    return np.clip(np.maximum(fast, look.fall_foam * share(lean, look.fall_low_deg, look.fall_high_deg)), 0, 1)


def _kept(line) -> np.ndarray:
    """Points of the dense line that a straight piece between its neighbours would miss, and one every MOST_STEP_M."""
    values = np.stack([line.x, line.y, line.level_m, line.half_m], -1)
    kept, first, last = [0], 0, len(line.x) - 1
    while first < last:
        end = first + 1
        while end < last and line.along_m[end + 1] - line.along_m[first] <= MOST_STEP_M:
            part = (line.along_m[first : end + 2] - line.along_m[first]) / (line.along_m[end + 1] - line.along_m[first])
            straight = values[first] + part[:, None] * (values[end + 1] - values[first])
            if np.abs(straight - values[first : end + 2]).max() > LEVEL_OFF_M:
                break
            end += 1
        kept.append(end)
        first = end
    return np.array(kept)


def _faces(count: int) -> np.ndarray:
    """Two triangles a piece, the left bank being the higher number: anticlockwise from above."""
    right = (np.arange(count - 1)[:, None] * ACROSS + np.arange(ACROSS - 1)).ravel()
    left, on = right + 1, ACROSS
    return np.stack([right, right + on, left + on, right, left + on, left], -1).reshape(-1, 3)
