"""Heights at the probes of a level over a stretch of time, worked out a few moments a frame (T06).

Moments stand on a grid of their own, so what was worked out stays while the clock goes on.
"""

from __future__ import annotations

import time

import numpy as np

from ..level import Level
from ..level.probes import heights_at, probes_of, shortest_period_s

BUDGET_S = 0.012  # a frame
AT_ONCE = 48  # moments
SAMPLES = 12  # of the shortest wave
MOST = 4000  # moments kept


class ProbeRecord:
    """`heights` by number of a moment, one a probe."""

    def __init__(self) -> None:
        self.key: tuple = ()
        self.names: list[str] = []
        self.step_s = 0.1
        self.heights: dict[int, np.ndarray] = {}
        self.complete = True  # nothing of what was asked last is missing

    def update(self, level: Level, first_s: float, last_s: float, budget_s: float = BUDGET_S) -> None:
        """Work out some of the moments from one to another that are missing, those in the middle first."""
        probes = probes_of(level)
        key = id(level), level.revision
        if key != self.key:
            self.key, self.names, self.heights = key, [probe.id for probe in probes], {}
            self.step_s = shortest_period_s(level) / SAMPLES
        numbers = np.arange(np.ceil(first_s / self.step_s), np.floor(last_s / self.step_s) + 1).astype(int)
        missing = [n for n in numbers.tolist() if n not in self.heights] if probes else []
        middle = 0.5 * (first_s + last_s) / self.step_s
        missing.sort(key=lambda n: abs(n - middle))
        x, y = (np.array([getattr(probe, axis) for probe in probes]) for axis in "xy")
        end, done = time.perf_counter() + budget_s, 0
        while done < len(missing) and (done == 0 or time.perf_counter() < end):
            part = missing[done : done + AT_ONCE]
            found = heights_at(level, np.array(part)[:, None] * self.step_s, x, y)
            self.heights.update(zip(part, found, strict=True))
            done += len(part)
        self.complete = done >= len(missing)
        for old in list(self.heights)[: max(len(self.heights) - MOST, 0)]:
            del self.heights[old]

    def lines(self, first_s: float, last_s: float) -> tuple[np.ndarray, np.ndarray]:
        """Seconds (n,) and metres (probes, n) of what is known between two moments; gaps are NaN."""
        numbers = np.arange(np.ceil(first_s / self.step_s), np.floor(last_s / self.step_s) + 1).astype(int)
        gap = np.full(len(self.names), np.nan)
        found = [self.heights.get(n, gap) for n in numbers.tolist()]
        return numbers * self.step_s, np.array(found, np.float64).reshape(len(numbers), len(self.names)).T.copy()
