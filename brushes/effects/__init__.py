"""Effects: what a dab does to the cells under it, one file each.

Weights, masks, tiles, saving and marking are the stroke's business. An effect works on arrays, one channel at a time,
and never reads what its own dab has written: what needs neighbours is gathered in `prepare`, before the first write.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...level.grid import Rect

if TYPE_CHECKING:
    from ...level.params import Section
    from ..canvas import Canvas
    from ..footprint import Footprint, Link


@dataclass(slots=True)
class Piece:
    """The part of a dab in one tile, arrays float32 `(rows, cols)` of one channel.

    `base` is what the layer held when the stroke began, `mask` the greatest weight of any dab so far, `weight` that of
    this dab, `live` what is to be written. `spare` may be overwritten. `bases` is the base of all channels. On a grid
    that wraps `rect` counts on past the border.
    """

    rect: Rect
    channel: int
    link: Link
    base: np.ndarray
    mask: np.ndarray
    weight: np.ndarray
    live: np.ndarray
    spare: np.ndarray
    bases: np.ndarray


class Effect:
    """Begin, then `prepare` and `write` for each dab."""

    layer = ""  # the only one it can work on, where its channels belong together
    pressed = 1.0  # pressure at the end of the dab, for an effect that takes it

    def __init__(self, params: Section, invert: bool, footprint: Footprint) -> None:
        self.params = params
        self.invert = invert
        self.footprint = footprint
        self.amount = np.float32(params.strength * params.opacity)

    @classmethod
    def masked(cls, params: Section, invert: bool) -> bool:
        """Whether it reads `mask`; one that works on what earlier dabs left reads `weight` alone."""
        return True

    @classmethod
    def smoothing(cls, params: Section) -> Section | None:
        """Parameters with which it smooths by itself (Shift); None leaves that to the smooth brush."""
        return None

    @classmethod
    def label(cls, params: Section, invert: bool) -> str:
        """Its name in the history where the brush's own doesn't tell."""
        return ""

    @classmethod
    def target(cls, params: Section) -> tuple[str, tuple[str, ...]] | None:
        """Layer and channels that the parameters pick; None where the brush's row does."""
        return None

    @classmethod
    def needs(cls, params: Section) -> frozenset[str]:
        """What of the surroundings it reads: flow, shore."""
        return frozenset()

    @classmethod
    def goes_along(cls, params: Section) -> bool:
        """Whether a dab means nothing without a way: then the press waits for a move, or for the release."""
        return False

    @classmethod
    def takes_pressure(cls, params: Section) -> bool:
        """Whether pressure is something of its own to it (`pressed`) and no part of the weights."""
        return False

    @classmethod
    def channels(cls, params: Section, channels: tuple[int, ...]) -> tuple[int, ...]:
        """Which of the brush's channels it writes."""
        return channels

    @classmethod
    def idle(cls, params: Section) -> frozenset[str]:
        """Names of parameters that mean nothing as the others are set."""
        return frozenset()

    def begin(self, canvas: Canvas, row: float, col: float) -> None:
        """Freeze what the press decides."""

    def prepare(self, canvas: Canvas, rect: Rect, link: Link) -> None:
        """Gather what a dab needs to know about its surroundings, before it writes."""

    def write(self, piece: Piece) -> None:
        """Fill `piece.live`."""
        raise NotImplementedError

    def finish(self, canvas: Canvas) -> list[Rect]:
        """What is left for the release; returns the rectangles it changed."""
        return []

    def preview(self, canvas: Canvas) -> dict | None:
        """What is worth telling while the stroke goes on."""
        return None


def one_sided(change: np.ndarray, side: str) -> None:
    """Leave of a change only what digs (cut) or only what lifts (fill)."""
    if side == "cut":
        np.minimum(change, 0, out=change)
    elif side == "fill":
        np.maximum(change, 0, out=change)
