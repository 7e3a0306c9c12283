"""Holds the asked frame rate by drawing fewer pixels while things move (design: the governor).

Only the window uses it. What `shorewright render` and a settled viewport show never does.
"""

from __future__ import annotations

SCALES = (1.0, 0.84, 0.7, 0.59, 0.5, 0.42, 0.35, 0.3, 0.25)
MARGIN = 0.72  # a larger picture is tried only when it should leave this much of the frame free
PATIENCE = 6  # good frames in a row before a larger picture is tried


class Governor:
    """Chooses one of SCALES for the sides of the picture from how long the last frames took."""

    def __init__(self, target_fps: float = 30.0, start: float = 1.0) -> None:
        """`start` is the scale to begin with: small where drawing is known to be slow."""
        self.target_fps = target_fps
        self.index = min(range(len(SCALES)), key=lambda i: abs(SCALES[i] - start))
        self._cost_s = 0.0  # smoothed cost of a frame at the current scale
        self._good = 0

    @property
    def scale(self) -> float:
        return SCALES[self.index]

    @property
    def frame_s(self) -> float:
        """What drawing one moving frame costs now, smoothed; 0 before the first."""
        return self._cost_s

    def note(self, seconds: float) -> None:
        """Take in what a moving frame at the current scale cost, and choose the scale of the next."""
        if not seconds > 0:
            return
        self._cost_s = seconds if self._cost_s == 0 else self._cost_s * 0.6 + seconds * 0.4
        budget = 1 / self.target_fps
        if self._cost_s > budget and self.index < len(SCALES) - 1:
            self._go(self._fitting(budget))
        elif self.index > 0 and self._predicted(self.index - 1) < budget * MARGIN:
            self._good += 1
            if self._good >= PATIENCE:
                self._go(self.index - 1)
        else:
            self._good = 0

    def _predicted(self, index: int) -> float:
        """Cost at another scale, taking it to follow the number of pixels."""
        return self._cost_s * (SCALES[index] / self.scale) ** 2

    def _fitting(self, budget: float) -> int:
        """The largest smaller picture that should fit; the smallest when none does."""
        fits = (i for i in range(self.index + 1, len(SCALES)) if self._predicted(i) <= budget)
        return next(fits, len(SCALES) - 1)

    def _go(self, index: int) -> None:
        self._cost_s = self._predicted(index)
        self.index = index
        self._good = 0
