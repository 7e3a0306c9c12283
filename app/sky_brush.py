"""The weather brush between world and map: strokes, the ring on the shell, and what the sky is at a place (T04).

Strokes are kept in metres of the weather map, whose air moves: played again they paint the same at any time.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..brushes import BRUSHES
from ..level import BadInput, Rect
from ..level.cloud_types import CLOUD_TYPES
from ..level.grid import NOWHERE
from ..level.layers import WEATHER_GRID
from ..level.pick_sky import on_shell
from ..level.weather import TILE_M, nearest_m, paint_place, weather_at
from .brush_ring import POINTS
from .session import Session
from .tools import BRUSH

NAME = "weather"
STILL_CELLS = 0.25  # a pointer that stands while the air moves under it paints on after so much of a cell
ELSEWHERE = "Point at the sky, or paint on the weather map"


class Held(NamedTuple):
    """What the modifier keys would make of a stroke."""

    invert: bool
    smooth: bool


def in_hand(session: Session) -> bool:
    """Whether the left button paints the weather map."""
    return session.tool == BRUSH and BRUSHES[session.brush].layer == NAME


def press(session: Session, x: float, y: float, invert: bool = False, smooth: bool = False) -> Rect:
    """Begin a stroke at a world place under which the map lies as the clock says."""
    east, north = map(float, paint_place(session.level, session.clock.time_s, x, y))
    session.sky_hand = x, y
    return session.stroke_begin(east, north, 1.0, invert, smooth)


def drag(session: Session, x: float, y: float) -> Rect:
    """Go on to a world place the way the hand went, past the map's border too, and as the air moved meanwhile."""
    if session.stroke is None or session.sky_hand is None or not session.stroke.samples:
        return NOWHERE
    last, hand = session.stroke.samples[-1], session.sky_hand
    at = paint_place(session.level, session.clock.time_s, x, y)
    ahead = last.x + x - hand[0], last.y + y - hand[1]  # had the air stood still
    east, north = (float(nearest_m(place, near)) for place, near in zip(at, ahead))
    if np.hypot(east - last.x, north - last.y) < STILL_CELLS * WEATHER_GRID.cell_m:
        return NOWHERE
    session.sky_hand = x, y
    return session.stroke_move(east, north)


def fill(session: Session, mode: str = "set") -> Rect:
    """The brush over the whole map in one stroke: its targets everywhere, or (mode erase) no paint at all."""
    half = TILE_M / 2
    values = {"mode": mode, "size_m": half, "falloff": 0.0, "spacing": 1.0, "strength": 1.0, "opacity": 1.0}
    values |= {"paint_coverage": True, "paint_precipitation": True, "paint_type": True} if mode == "erase" else {}
    return session.drag(NAME, (0.0, 0.0), (half, half), **values)


# What is there


@dataclass(frozen=True)
class Sky:
    """The weather map at a world place: what is drawn in the end, and how much of it is paint."""

    x: float
    y: float
    away_m: float
    coverage: float
    precipitation: float
    gradient: float
    weight: float


def sky_at(session: Session, x: float, y: float) -> Sky:
    camera = session.camera
    values = weather_at(session.level, session.clock.time_s, x, y, (camera.x, camera.y), seen_by=camera.id)
    return Sky(x, y, float(np.hypot(x - camera.x, y - camera.y)), *map(float, values))


def sentence(sky: Sky) -> str:
    """One line for the status bar."""
    kind = ("stratus", "stratus to cumulus", "cumulus", "cumulus to storm", "cumulonimbus")[round(sky.gradient * 4)]
    return (
        f"sky {sky.away_m / 1000:.1f} km away   coverage {sky.coverage:.2f}   precipitation {sky.precipitation:.2f}"
        f"   {kind} {sky.gradient:.2f}   {f'{sky.weight:.0%} painted' if sky.weight > 0.005 else 'simulated'}"
    )


# The brush's targets


def take(session: Session, x: float, y: float) -> dict[str, float]:
    """Make what is shown at a world place, before rain pulls at it, the targets of the brush."""
    camera = session.camera
    values = weather_at(session.level, session.clock.time_s, x, y, (camera.x, camera.y), "horizon", camera.id)
    targets = dict(zip(("coverage", "precipitation", "type"), (round(float(v), 3) for v in values)))
    _aim(session, targets)
    return targets


def choose(session: Session, name: str) -> None:
    """Take the weather brush with a sky of CLOUD_TYPES as its targets."""
    if name not in CLOUD_TYPES:
        raise BadInput(f"no sky is called {name!r}; there are: {', '.join(CLOUD_TYPES)}")
    session.pick_brush(NAME)
    session.set_param("mode", "set")
    _aim(session, CLOUD_TYPES[name].values)


def _aim(session: Session, targets: dict[str, float]) -> None:
    for name, value in targets.items():
        session.set_param(name, value, NAME)


def chosen(session: Session) -> str:
    """The sky of CLOUD_TYPES that the brush's targets are, "" for none of them."""
    params = session.params[NAME]
    for row in CLOUD_TYPES.values():
        if all(abs(getattr(params, name) - value) < 1e-6 for name, value in row.values.items()):
            return row.name
    return ""


# The ring


def shell_circle(session: Session, point, radius_m: float, points: int = POINTS) -> np.ndarray:
    """A closed circle on the shell as world points (points + 1, 3)."""
    level, camera = session.level, session.camera
    turn = np.linspace(0, 2 * np.pi, points + 1)
    eye = np.array([camera.x, camera.y, camera.z])
    x, y = point[0] + radius_m * np.cos(turn), point[1] + radius_m * np.sin(turn)
    return on_shell(level, eye, x, y, level.settings.clouds.base_m)
