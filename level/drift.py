"""Where the current takes things that drift (D12): one path a prop, from time zero, the same whatever is asked first.

A thing's speed comes to that of the water by `things.drag`; within a step the water's counts as constant, which has an
exact solution. It stops where the still water is too shallow for it, at the level's border, and after MOST_S. While a
stroke is open a path stays, as the current does.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from .flow import Current, current
from .level import Level
from .objects import Prop
from .pick import ground_at
from .river_map import river_map
from .river_water import still_water_m
from .weather_keys import points_change, whole_keys

STEP_S = 0.5
MOST_S = 900.0  # a path is followed so far


@dataclass
class Path:
    """States at whole steps: east, north, speed east and north; `key` says what it was made for."""

    key: tuple
    states: list[tuple[float, float, float, float]] = field(default_factory=list)


def drifted(level: Level, prop: Prop, t: float, draft_m: float) -> tuple[float, float]:
    """World x, y of a drifting prop at time t; `draft_m` is how deep it reaches under the still sea."""
    drag, water = level.settings.things.drag, current(level)
    key = (prop.x, prop.y, drag, draft_m, water.key, level.layer_revision("height"), level.mean_sea_m)
    key += ((whole_keys(level) if water.to_points is not None else ()),)
    key += () if (rivers := river_map(level)) is None else (rivers.key,)
    paths = level.derived.setdefault("drift", {})
    path = paths.get(prop.id)
    if path is None or (path.key != key and not (level.live and path.key[:3] == key[:3])):
        path = paths[prop.id] = Path(key, [(prop.x, prop.y, 0.0, 0.0)])
    t = min(max(t, 0.0), MOST_S)
    steps = math.floor(t / STEP_S + 1e-9)
    while len(path.states) <= steps:
        begun = (len(path.states) - 1) * STEP_S
        path.states.append(_moved(level, water, path.states[-1], begun, STEP_S, drag, draft_m))
    return _moved(level, water, path.states[steps], steps * STEP_S, t - steps * STEP_S, drag, draft_m)[:2]


def _moved(level: Level, water: Current, state: tuple, begun_s: float, dt: float, drag: float, draft_m: float) -> tuple:
    """A state at `begun_s`, `dt` seconds later: du/dt = drag · (current − u), solved for a constant current."""
    x, y, *speed = state
    if dt <= 0 or drag <= 0:
        return state
    left = math.exp(-drag * dt)
    ways = []
    for i, flow in enumerate(water.at(x, y, points_change(level, begun_s))):
        over = speed[i] - float(flow)
        ways.append(float(flow) * dt + over * (1 - left) / drag)
        speed[i] = float(flow) + over * left
    east, north = x + ways[0], y + ways[1]
    inside = 0 <= east <= level.grid.extent_m[0] and 0 <= north <= level.grid.extent_m[1]
    place = np.array(east), np.array(north)
    if not inside or float(ground_at(level, *place)) + draft_m > float(still_water_m(level, *place)):
        return x, y, 0.0, 0.0  # aground
    return east, north, *speed
