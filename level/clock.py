"""One clock for the whole world: run, pause, step, rate, scrub, loop (T05).

Wave functions are stateless in t; simulations advance in whole steps and only while the clock runs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

LATEST_S = 1e9  # thirty years; beyond it a float64 no longer tells single frames apart


@dataclass
class Clock:
    """Time in seconds; `loop` is (start, end) or None."""

    time_s: float = 0.0
    rate: float = 1.0
    paused: bool = False
    step_s: float = 1 / 30
    loop: tuple[float, float] | None = None

    def advance(self, wall_s: float) -> int:
        """Let wall time pass; returns how many whole simulation steps fell due (0 while paused)."""
        if self.paused or not math.isfinite(wall_s) or wall_s <= 0:
            return 0
        before = math.floor(self.time_s / self.step_s)
        self._go(self.time_s + wall_s * self.rate)
        return max(math.floor(self.time_s / self.step_s) - before, 0)

    def step(self, steps: int = 1) -> None:
        """Go to the next (or, negative, an earlier) whole step and stay paused there."""
        self.paused = True
        at = self.time_s / self.step_s
        self._go(((math.floor(at + 1e-6) if steps > 0 else math.ceil(at - 1e-6)) + steps) * self.step_s)

    def scrub(self, time_s: float) -> None:
        """Go to a moment; outside the loop is allowed, the loop takes hold again when time runs."""
        self.time_s = min(max(float(time_s), 0.0), LATEST_S) if math.isfinite(time_s) else self.time_s

    def _go(self, time_s: float) -> None:
        if self.loop and self.loop[1] > self.loop[0]:
            start, end = self.loop
            if time_s >= end or time_s < start:
                time_s = start + (time_s - start) % (end - start)
        self.time_s = min(max(time_s, 0.0), LATEST_S)
