"""When waves arrive and how high they are on their way (T06): a section of `param` rows."""

from __future__ import annotations

from typing import Literal

from .params import Section, param


class Timing(Section):
    """Which clock the waves keep: that of the depth, or the time that a swell takes over this bed."""

    source: Literal["depth", "travel_time", "blend"] = param(
        "depth", doc="Fronts stand on depth contours; or they refract, shoal and bunch over the bed as a swell does."
    )
    blend: float = param(0.5, 0, 1, "", "With source blend: 0 times by depth, 1 times by travel.")
    least_depth_m: float = param(
        0.3, 0.05, 5, "m", "Water shallower than this slows a swell no further.", soft=(0.1, 1)
    )
    current: float = param(
        1.0, 0, 1, "", "How far rivers, their jets and painted flow slow, bend and shorten waves that keep times of "
        "travel.",
    )  # fmt: skip
    breaker: float = param(0.78, 0.3, 1.5, "", "Height against depth at which a wave breaks.", soft=(0.5, 1.2))
    tide_step_m: float = param(
        0.25, 0.05, 10, "m", "Under a tide times of travel are solved at every so many metres of it, with a straight "
        "line in between.", soft=(0.1, 2),
    )  # fmt: skip
    fast_mps: float = param(9.0, 0.5, 60, "m/s", "Fronts that run in faster than this count as too fast.", soft=(3, 20))
    slow_mps: float = param(0.7, 0.02, 10, "m/s", "Fronts slower than this stall.", soft=(0.2, 2))
    stall_s: float = param(3.0, 0.1, 60, "s", "For so long before that is a hot spot.", soft=(1, 10))
    far_m: float = param(60.0, 2, 2000, "m", "Waves that break farther from the shore than this break off the beach.",
                         soft=(20, 200))  # fmt: skip
    bar_m: float = param(0.3, 0.02, 20, "m", "Troughs behind a bar that are deeper than this count.", soft=(0.1, 2))

    @property
    def travels(self) -> bool:
        """Whether travel times count at all."""
        return self.source != "depth"

    @property
    def share(self) -> float:
        """Share of travel time in the moment of arrival."""
        return {"depth": 0.0, "travel_time": 1.0, "blend": self.blend}[self.source]
