"""Raise and lower: base plus strength times mask, so a crossing stroke adds no more (T01)."""

from __future__ import annotations

import numpy as np

from . import Piece
from .even_pace import Evens


class Raise(Evens):
    """Adds; inverted it takes away."""

    sign = 1.0

    def write(self, piece: Piece) -> None:
        amount = self.amount * np.float32(-self.sign if self.invert else self.sign)
        np.multiply(piece.mask, amount, out=piece.spare)
        np.add(piece.base, piece.spare, out=piece.live)
        if self.even:
            piece.live += self.even.total(piece, self.shape)


class Lower(Raise):
    """Takes away; inverted it adds."""

    sign = -1.0
