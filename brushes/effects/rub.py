"""Rubbing: what of a layer's detail a dab takes away, for effects that smooth beside what else they do."""

from __future__ import annotations

import numpy as np

from . import Piece
from .mean import cascade, mean_minus

DETAIL = 0.25  # of the radius, that smoothing takes away
MOST = 0.98  # of the detail that a dab takes at strength 1


class Rub:
    """`prepare` before a dab writes, then `change` for each piece of it; it goes on from what earlier dabs left."""

    def __init__(self, share: float, radius: float) -> None:
        self.share, self.radius = min(share, MOST), radius

    def prepare(self, canvas, rect, link) -> None:
        radii = 2 * link.length / (2 * self.radius + link.length) if link.length else 1.0
        self.rate = np.float32(1 - (1 - self.share) ** radii)
        steps = cascade(DETAIL * self.radius, min(canvas.data.grid.shape))
        self.rect = rect
        self.more = {c: mean_minus(canvas.window(rect, sum(steps), c), steps) for c in canvas.channels}

    def change(self, piece: Piece) -> np.ndarray:
        """What is to be added under a piece, in its `spare`."""
        there = self.more[piece.channel][piece.rect.shifted(self.rect).slices]
        np.multiply(there, piece.weight, out=piece.spare)
        return np.multiply(piece.spare, self.rate, out=piece.spare)
