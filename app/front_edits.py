"""Fronts shaped by hand or by a script, each an undoable step (T07; part of the session)."""

from __future__ import annotations

from typing import Any

from ..level.grid import Rect
from ..level.params import Section, param, replace, row
from ..level.shaping import Shaped
from ..level.shaping_limits import SLOPE_DEG
from . import words
from .front_drag import FrontDrag, settled
from .shaping_lender import ShapingLender
from .shot_edits import Shots


class FrontParams(Section):
    """What the tool takes."""

    radius_m: float = param(40.0, 2, 400, "m", "Radius in which the bed may change.", soft=(10, 150))
    slope_deg: float = param(SLOPE_DEG, 1, 80, "°", "The bed becomes no steeper than this by shaping.", soft=(5, 60))


class FrontEdits(Shots):
    """`front` is how the tool is set."""

    front: FrontParams = FrontParams()

    def set_front(self, name: str, value: Any) -> None:
        """Change a parameter of the tool; BadInput out of range. No undo step: the level is untouched."""
        self.front = replace(self.front, name, value)

    def scale_param(self, name: str, factor: float) -> None:
        """The keys that make a brush larger make the circle larger while fronts are shaped."""
        if self.tool != "front":
            super().scale_param(name, factor)
        elif name == "size_m":
            self.set_front("radius_m", row(FrontParams, "radius_m").clamp(self.front.radius_m * factor))

    def shape_front(
        self, line, radius_m: float | None = None, *, t: float | None = None, at=None, wave: int | None = None,
        slope_deg: float | None = None,
    ) -> Shaped:  # fmt: skip
        """Bring a crest to a line of world points at a moment (now) as one step; BadInput says what cannot be."""
        front = self.front
        word = words.checked(
            words.ShapeFront, t=self.clock.time_s if t is None else t, line=[tuple(map(float, p)) for p in line],
            radius_m=front.radius_m if radius_m is None else radius_m, at=None if at is None else tuple(at), wave=wave,
            slope_deg=front.slope_deg if slope_deg is None else slope_deg,
        )  # fmt: skip
        self._end_stroke()
        with self._edit(word):
            return settled(self.level, self.journal, word)

    def front_begin(self, x: float, y: float, anew: bool = False, beside: ShapingLender | None = None) -> FrontDrag:
        """Take hold of the crest near a world point now; `stroke_move` and `stroke_end` go on.

        With a process beside, `front_take` once a frame and `front_release` instead of the end.
        """
        self._end_stroke()
        if self.recovery:
            self.recovery.settle()
        front = self.front
        self.stroke = FrontDrag(
            self.level, self.journal, self.clock.time_s, (x, y), front.radius_m, front.slope_deg, anew, beside
        )
        return self.stroke

    def front_release(self) -> None:
        """Let go without waiting: the step comes with a later `front_take`."""
        held = self.stroke
        if isinstance(held, FrontDrag) and not (held.beside and held.settle()):
            self.stroke_end()

    def front_take(self) -> FrontDrag | None:
        """Bring in what came for the crest in the hand; returns it when it has just become a step, or none."""
        held = self.stroke
        if not isinstance(held, FrontDrag) or not held.take():
            return None
        self.stroke_end()
        return held

    def stroke_end(self) -> Rect:
        """Release: the stroke becomes one step; waits for what is worked out beside."""
        if isinstance(self.stroke, FrontDrag):
            self.stroke.wait()  # only then is it known which line a script says
        return super().stroke_end()

    def _stroke_word(self, stroke) -> words.Action:
        return stroke.word if isinstance(stroke, FrontDrag) else super()._stroke_word(stroke)
