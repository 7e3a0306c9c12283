"""What breaking does to all the waves about some points together (D34): where it carries them, how white they are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .breaking import ASHORE_S, Breaker, Gradient, Swell, breaker_at, carried, feels_from, progress, white_water
from .dual import Dual, step
from .settings import Shore


@dataclass
class BreakingWaves:
    """Gathered wave by wave; `cycles` of the clock that a front takes for the range."""

    shore: Shore
    cycles: float
    breaker: Breaker
    ashore: Dual  # 0 where nothing is carried
    feels: np.ndarray
    ahead_m: Dual
    progress: np.ndarray  # of the nearest wave
    white: np.ndarray

    @classmethod
    def begun(cls, shore: Shore, cycles: float, s_body: Dual, bed: Gradient, swell: Swell | None) -> BreakingWaves:
        """Before the first wave; arguments as those of `breaker_at`."""
        breaker = breaker_at(shore, cycles, s_body, bed, swell)
        nothing = np.zeros(np.shape(s_body.v))
        feels = breaker.here.v > feels_from(shore, cycles)
        ashore = (1.0 - step(*ASHORE_S, s_body)) * feels
        return cls(shore, cycles, breaker, ashore, feels, Dual(nothing), nothing - 9.0, nothing)

    def broken(self, u: Dual, body: Dual, high: Dual, sooner: Dual, foam: list, closer: np.ndarray) -> Dual:
        """The body of one wave as it breaks, `sooner` than others; notes how far it is carried, and its foam."""
        q = progress(self.shore, self.cycles, self.breaker, u) + sooner
        moved = carried(self.shore, u, q, self.breaker, high, sooner)
        self.ahead_m = self.ahead_m + moved.ahead_m
        self.progress = np.where(closer, q.v, self.progress)
        self.white = np.maximum(self.white, white_water(q.v, self.breaker) * np.maximum.reduce(foam) * self.feels)
        # on land and far out it stands as it is
        stands = moved.stands + (1.0 - moved.stands) * (1.0 - self.ashore)
        return body * stands + moved.splash * self.ashore

    def shift(self, weight: Dual) -> tuple[Dual, Dual]:
        """Metres east and north that points are carried."""
        ahead = self.ahead_m * self.ashore * weight
        return self.breaker.east * ahead, self.breaker.north * ahead
