"""A level under one swell of a given period and heading in place of its own (T06)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from .arrival import KEPT, Asked
from .arrival_map import ArrivalMap
from .earth import GRAVITY
from .errors import BadInput
from .level import Level
from .objects import WeatherKey
from .params import replace as changed

PERIODS_S = (1.7, 60.0)
LONGEST_M = 600.0  # that sea.swell_length_m takes


class OneSwell:
    """Lent to a level as its solver: all fronts of the low group come from one heading."""

    def __init__(self, heading_deg: float) -> None:
        self.heading_deg = heading_deg
        self.kept: dict[tuple, ArrivalMap] = {}

    def answer(self, asked: Asked) -> ArrivalMap:
        if asked.key not in self.kept:
            # headings of a level keep off its axes (H05); a swell that is asked for does not
            swells = tuple(replace(one, heading_deg=self.heading_deg) for one in asked.request.swells)
            self.kept[asked.key] = replace(asked, request=replace(asked.request, swells=swells)).answered()
            for key in list(self.kept)[:-KEPT]:
                del self.kept[key]
        return self.kept[asked.key]

    def latest(self) -> None:
        """Nothing is waited for."""

    def beside(self, _name: str, _key: tuple, request: Callable[[], Any]) -> Any:
        """The answer at once."""
        asked = request()
        return self.answer(asked) if isinstance(asked, Asked) else asked.answered()


def take_swell(level: Level, period_s: float, heading_deg: float) -> None:
    """Change a level to one swell of straight crests; weather that changes the sea is taken out."""
    if not PERIODS_S[0] <= period_s <= PERIODS_S[1]:
        raise BadInput(f"a swell of {period_s:g} s is outside {PERIODS_S[0]:g} to {PERIODS_S[1]:g} s")
    if not 0 <= heading_deg <= 360:
        raise BadInput(f"a heading of {heading_deg:g}° is outside 0 to 360")
    for name in [key for key, thing in level.objects.items() if isinstance(thing, WeatherKey)]:
        level.put_object(name, None)
    deep_m = GRAVITY * period_s**2 / (2 * math.pi)
    length_m = min(deep_m, LONGEST_M)
    values = {"swell_length_m": length_m, "swell_speed": math.sqrt(length_m / deep_m), "variance": 0.0,
              "phase_noise": 0.0, "swell_heading_deg": heading_deg}  # fmt: skip
    settings = level.settings
    for name, value in values.items():
        settings = changed(settings, f"sea.{name}", value)
    level.set_settings(settings)
    level.solver = OneSwell(heading_deg)
