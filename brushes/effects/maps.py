"""Maps: paints foam, masks and covers between nothing and all (T03)."""

from __future__ import annotations

import numpy as np

from ...level.layers import LAYERS
from . import Effect, Piece
from .rub import Rub

OPPOSITE = {"add": "remove", "remove": "add", "set": "reset", "reset": "set", "smooth": "smooth"}
LABELS = {"add": "Paint {}", "remove": "Remove {}", "set": "Set {}", "smooth": "Smooth {}", "reset": "Reset {}"}


class Maps(Effect):
    """By the greatest mask of the stroke, so a crossing stroke does no more; with `build_up` dab by dab, in float32."""

    layer = "foam"  # when nothing else is picked

    def __init__(self, params, invert: bool, footprint) -> None:
        super().__init__(params, invert, footprint)
        self.mode = OPPOSITE[params.mode] if invert else params.mode
        self.rub = Rub(float(self.amount), footprint.radius) if self.mode == "smooth" else None

    @classmethod
    def target(cls, params):
        layer, _, channel = params.onto.partition(".")
        return layer, (channel,) if channel else ()

    @classmethod
    def masked(cls, params, invert: bool) -> bool:
        return params.mode != "smooth" and not params.build_up

    @classmethod
    def smoothing(cls, params):
        return params.model_copy(update={"mode": "smooth"})

    @classmethod
    def label(cls, params, invert: bool) -> str:
        mode = OPPOSITE[params.mode] if invert else params.mode
        return LABELS[mode].format(LAYERS[cls.target(params)[0]].label.lower())

    @classmethod
    def idle(cls, params) -> frozenset[str]:
        unused = [] if params.mode in ("set", "reset") else ["target"]
        return frozenset([*unused, "build_up"] if params.mode == "smooth" else unused)

    def begin(self, canvas, row: float, col: float) -> None:
        layer = canvas.data.row
        self.low, self.high = np.float32(layer.low), np.float32(layer.high)
        self.goal = np.clip(np.float32(self.params.target if self.mode == "set" else 0), self.low, self.high)
        self.most = np.float32(self.params.opacity) * (self.high - self.low)

    def prepare(self, canvas, rect, link) -> None:
        if self.rub:
            self.rub.prepare(canvas, rect, link)

    def write(self, piece: Piece) -> None:
        if self.rub:
            np.add(piece.live, self.rub.change(piece), out=piece.live)
            np.clip(piece.live, self.low, self.high, out=piece.live)
        elif self.mode in ("set", "reset"):
            self._approach(piece)
        else:
            self._add(piece)

    def _add(self, piece: Piece) -> None:
        """More or less, within the layer's range; what already lies outside it is left there."""
        down = self.mode == "remove"
        rate = np.float32(self.params.strength) if self.params.build_up else self.amount
        change = np.multiply(piece.mask, -rate if down else rate, out=piece.spare)
        if self.params.build_up:
            change += piece.live
            change -= piece.base
            np.clip(change, -self.most, self.most, out=change)
        np.add(piece.base, change, out=piece.live)
        if down:
            np.maximum(piece.live, np.minimum(piece.base, self.low), out=piece.live)
        else:
            np.minimum(piece.live, np.maximum(piece.base, self.high), out=piece.live)

    def _approach(self, piece: Piece) -> None:
        """To the goal by a share of the way."""
        if not self.params.build_up:
            change = np.subtract(self.goal, piece.base, out=piece.spare)
            change *= piece.mask
            change *= self.amount
            np.add(piece.base, change, out=piece.live)
            return
        change = np.subtract(self.goal, piece.live, out=piece.spare)
        change *= piece.mask
        change *= np.float32(self.params.strength)
        change += piece.live
        farthest = piece.base + (self.goal - piece.base) * np.float32(self.params.opacity)
        np.clip(change, np.minimum(piece.base, farthest), np.maximum(piece.base, farthest), out=piece.live)
