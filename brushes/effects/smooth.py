"""Smooth: towards the mean of the neighbours; inverted, away from it once (T01).

The mean is a cascade of [1 2 1] / 4 with halving steps, in rows and then in columns: a wide tent for a few passes. Of
equal samples it is exactly that sample (doubling and halving lose nothing), so flat ground stays flat to the last bit.
Beyond the level's border the ground is continued by point reflection, which neither lifts nor bends a slope there.
"""

from __future__ import annotations

import numpy as np

from . import Piece
from .even_pace import Evens
from .mean import cascade, mean_minus

MOST = 0.98  # of the detail that a dab takes at strength 1
LEAST = 1e-6  # a fainter stroke leaves nothing to be undone


class Smooth(Evens):
    """Rubbing goes on working: dabs read what earlier dabs left. Opacity bounds how far a stroke goes."""

    @classmethod
    def masked(cls, params, invert: bool) -> bool:
        return invert  # sharpening what is already sharpened would run away, so it starts from the base

    def prepare(self, canvas, rect, link) -> None:
        super().prepare(canvas, rect, link)
        steps = cascade(self.params.detail * self.footprint.radius, min(canvas.data.grid.shape))
        self.rect = rect
        self.rate = np.float32(self.amount if self.invert else self.params.opacity * self._share(link))
        self.change = {}  # mean − sample by channel, `(rows, cols)` of rect
        for channel in canvas.channels:
            window = canvas.window(rect, sum(steps), channel, base=self.invert)
            if not self.invert and self.params.opacity < 1:
                self._undo_opacity(window, canvas.window(rect, sum(steps), channel, base=True))
            self.change[channel] = mean_minus(window, steps)

    def _share(self, link) -> float:
        """Of the detail that a dab takes: by the way it covers, so that spacing matters little."""
        radii = 2 * link.length / (2 * self.footprint.radius + link.length) if link.length else 1.0
        return 1 - (1 - min(self.params.strength, MOST)) ** radii

    def _undo_opacity(self, live: np.ndarray, base: np.ndarray) -> None:
        """The ground as it would be at full opacity: base + (live − base) / opacity, in place."""
        if self.params.opacity > LEAST:
            live -= base
            live *= np.float32(1 / self.params.opacity)
            live += base

    def write(self, piece: Piece) -> None:
        rows = slice(piece.rect.row0 - self.rect.row0, piece.rect.row1 - self.rect.row0)
        cols = slice(piece.rect.col0 - self.rect.col0, piece.rect.col1 - self.rect.col0)
        change = np.multiply(self.change[piece.channel][rows, cols], self.rate, out=piece.spare)
        if self.invert:
            np.multiply(change, piece.mask, out=change)
            np.subtract(piece.base, change, out=piece.live)
            if self.even:
                piece.live += self.even.total(piece, self.shape)
        else:
            np.multiply(change, piece.weight, out=change)
            np.add(piece.live, change, out=piece.live)
            if self.even:
                piece.live += self.even.change(piece)
