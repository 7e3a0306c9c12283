"""Shots (Z20): skies of their own for a camera and a stretch of time, cross-faded over the simulation.

A sky is an array of WEATHER_GRID, coverage, precipitation and type, in metres round the middle of the weather map at
the moment its shot starts; from there on it drifts with the wind. It never changes; its name ends in a hash of itself.
"""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass

import numpy as np

from .errors import BadInput
from .layers import WEATHER_GRID
from .objects import Shot

SHAPE = (*WEATHER_GRID.shape, 3)
MOST = 16  # that are seen at a time, each a layer of a texture; of more those of most weight


@dataclass(frozen=True)
class Seen:
    """A shot as it shows at a moment: how much of it, 0 … 1."""

    shot: Shot
    share: float


def sky_of(values) -> np.ndarray:
    """A sky, read-only half floats `(512, 512, 3)`; BadInput where that cannot be made of `values`."""
    values = np.asarray(values)
    if values.shape != SHAPE:
        raise BadInput(f"the sky of a shot is {' × '.join(map(str, SHAPE))} numbers, not {values.shape}")
    if not (np.isfinite(values).all() and values.min() >= -1e-3 and values.max() <= 1 + 1e-3):
        raise BadInput("the sky of a shot takes numbers from 0 to 1")
    sky = np.clip(values, 0, 1).astype(np.float16)
    sky.flags.writeable = False
    return sky


def sky_name(stem: str, sky: np.ndarray) -> str:
    """The name of a sky in a level: a plain word and eight digits of its hash."""
    plain = re.sub(r"[^A-Za-z0-9]+", "_", stem).strip("_")[:40] or "sky"
    return f"{plain}_{digest(sky)[:8]}"


def digest(sky: np.ndarray) -> str:
    """Hash of a sky, in hex."""
    return hashlib.sha256(np.ascontiguousarray(sky).tobytes()).hexdigest()


def skies_in_use(level) -> set[str]:
    """Names of skies that shots of a level ask for."""
    return {thing.map for thing in level.objects.values() if isinstance(thing, Shot) and thing.map}


def fade_in(shot: Shot, time_s: float) -> float:
    """How far a shot has come up, 0 … 1; a shot without a fade is there at once."""
    return _eased((time_s - shot.start_s) / shot.fade_s) if shot.fade_s > 0 else float(time_s >= shot.start_s)


def fade_out(shot: Shot, time_s: float) -> float:
    """How much of it is left, 1 … 0."""
    return _eased((shot.end_s - time_s) / shot.fade_s) if shot.fade_s > 0 else float(time_s < shot.end_s)


def _eased(t: float) -> float:
    t = min(max(t, 0.0), 1.0)
    return t * t * (3 - 2 * t)


def shots_at(level, time_s: float, camera: str = "") -> tuple[Seen, ...]:
    """What a camera sees of a level's shots, the lower first; of more than MOST those of most weight.

    Later ones lie over earlier ones, a camera's own over those of all. One that is covered wholly when it ends stays
    whole until then: two that overlap fade into each other, and the simulation does not shine through.
    """
    shots = [
        thing for thing in level.objects.values()
        if isinstance(thing, Shot) and thing.camera in ("", camera) and thing.map in level.skies
    ]  # fmt: skip
    shots.sort(key=lambda shot: (bool(shot.camera), shot.start_s, shot.id))
    seen, open_share = [], 1.0
    for at in reversed(range(len(shots))):
        shot = shots[at]
        if open_share <= 0 or not shot.start_s <= time_s < shot.end_s:
            continue
        share = fade_in(shot, time_s)
        if not any(_covers(upper, shot.end_s) for upper in shots[at + 1 :]):
            share *= fade_out(shot, time_s)
        if share > 0:
            seen.append((Seen(shot, share), share * open_share))
            open_share *= 1 - share
    most = sorted(range(len(seen)), key=lambda at: -seen[at][1])[:MOST]
    return tuple(seen[at][0] for at in sorted(most, reverse=True))


def _covers(upper: Shot, time_s: float) -> bool:
    """Whether a shot is all that is seen at a moment."""
    inside = upper.start_s + upper.fade_s <= time_s <= upper.end_s - upper.fade_s
    return inside and upper.start_s < time_s < upper.end_s
