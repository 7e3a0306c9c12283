"""What the editor shows of the timing (T06): which overlays, what stands under the pointer, labels, hot spots.

No imgui here. What costs more than a moment is worked out when the level has stood still for a while.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..level.crests import Line, isochrones
from ..level.hot_spots import HotSpot, hot_spots
from ..level.next_crest import NextCrest, next_crest
from ..level.tide import tide_m
from ..level.timing import front_speed_mps, period_s
from ..renderer.show import FrontLines
from .session import Session

UNITS = ("seconds", "period / 10", "periods")
LAYERS = ("crests", "isochrones", "speed", "breakers")
QUIET_S = 0.5  # the level stands still for so long before lists and labels are made anew
TIDE_M = 0.25  # so far the sea rises or falls before they are made anew
READ_S = 0.15  # between two readings under the pointer


@dataclass(frozen=True)
class Reading:
    """What the pointer reads on the water: world place, what comes next, speed of the front there."""

    x: float
    y: float
    next: NextCrest
    speed_mps: float

    @property
    def lines(self) -> list[str]:
        words = self.next.sentence
        kind = f", {self.next.type}" if self.next.type else ""
        return [words[:1].upper() + words[1:], f"front {self.speed_mps:.1f} m/s{kind}"]


class FrontView:
    """State of the overlays; `session` is asked anew each time, for the editor changes it."""

    def __init__(self) -> None:
        self.on: dict[str, bool] = dict.fromkeys(LAYERS, False)
        self.ghosts, self.step, self.unit = 2, 1.0, UNITS[1]
        self.every_s, self.fastest_mps = 2.0, 10.0
        self.updating = False  # travel times are on their way
        self._seen: tuple[Any, float] = ((), 0.0)
        self._read: tuple[Any, float, Reading | None] = ((), -1e9, None)
        self._kept: dict[str, tuple[Any, list]] = {}

    def toggle(self, name: str) -> None:
        self.on[name] = not self.on[name]

    @property
    def shown(self) -> bool:
        return any(self.on.values())

    def step_s(self, session: Session) -> float:
        """Seconds between two ghosts."""
        if self.unit == UNITS[0]:
            return self.step
        period = period_s(session.level, session.clock.time_s)
        return self.step * period / (10.0 if self.unit == UNITS[1] else 1.0)

    def lines(self, session: Session) -> FrontLines | None:
        """What the renderer draws."""
        if not self.shown:
            return None
        found = FrontLines(self.on["crests"], self.ghosts if self.on["crests"] else 0, speed=self.on["speed"],
                           breakers=self.on["breakers"], fastest_mps=self.fastest_mps)  # fmt: skip
        if found.ghosts:
            found = replace(found, step_s=self.step_s(session))
        return replace(found, isochrones_s=self.every_s) if self.on["isochrones"] else found

    def reading(self, session: Session) -> Reading | None:
        """What passes under the pointer; not while a stroke is open, whose own text stands there."""
        if not self.shown or session.cursor is None or session.stroke is not None:
            return None
        place = on_water(session)
        key = (place, id(session.level), session.level.revision, session.clock.time_s)
        now = time.monotonic()
        if self._read[0] != key and now - self._read[1] > READ_S:
            self._read = key, now, place and _read(session, *place)
        return self._read[2]

    def isochrones(self, session: Session) -> list[Line]:
        """Lines to put seconds on."""
        if not self.on["isochrones"]:
            return []
        return self._when_quiet("isochrones", session, self.every_s, lambda: isochrones(*_now(session), self.every_s))

    def hot_spots(self, session: Session) -> list[HotSpot]:
        return self._when_quiet("hot_spots", session, None, lambda: hot_spots(*_now(session)))

    def _when_quiet(self, name: str, session: Session, more: Any, work) -> list:
        """A list made anew when the level changed and then stood still, or with the tide; till then the one before."""
        state = (id(session.level), session.level.revision, self.updating)
        now = time.monotonic()
        if self._seen[0] != state:
            self._seen = state, now
        key = (*state, more, round(tide_m(session.level.settings, session.clock.time_s) / TIDE_M))
        known = self._kept.get(name)
        quiet = session.stroke is None and now - self._seen[1] > QUIET_S
        if (known is None or known[0] != key) and (quiet or known is None) and session.stroke is None:
            self._kept[name] = known = key, work()
        return known[1] if known else []


def on_water(session: Session) -> tuple[float, float] | None:
    """Where the pointer's ray meets the still sea on its way to the bed; None over land."""
    point, sea_m, camera = session.cursor, session.level.sea_level_m, session.camera
    if point is None or point[2] >= sea_m or camera.z <= sea_m:
        return None
    part = (camera.z - sea_m) / (camera.z - point[2])
    return camera.x + (point[0] - camera.x) * part, camera.y + (point[1] - camera.y) * part


def _now(session: Session) -> tuple:
    return session.level, session.clock.time_s


def _read(session: Session, x: float, y: float) -> Reading | None:
    level, t = _now(session)
    found = next_crest(level, t, x, y)
    if found is None:
        return None
    speed_mps = found.speed_mps
    if speed_mps is None:
        speed_mps = float(front_speed_mps(level, t, np.float64(x), np.float64(y)))
    return Reading(x, y, found, speed_mps)
