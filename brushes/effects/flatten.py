"""Flatten: to the height at which the stroke began; inverted, away from it (T01)."""

from __future__ import annotations

import numpy as np

from . import Effect, Piece, one_sided


class Flatten(Effect):
    """Brings cells to what the layer held under the press."""

    def begin(self, canvas, row: float, col: float) -> None:
        self.level = canvas.sample(row, col)

    def write(self, piece: Piece) -> None:
        change = np.subtract(self.level[piece.channel], piece.base, out=piece.spare)
        one_sided(change, self.params.side)
        np.multiply(change, piece.mask, out=change)
        np.multiply(change, -self.amount if self.invert else self.amount, out=change)
        np.add(piece.base, change, out=piece.live)
