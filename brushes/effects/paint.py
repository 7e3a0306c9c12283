"""Paint: adds to a layer, takes away or brings back to neutral, within the layer's range (L09)."""

from __future__ import annotations

import numpy as np

from ...level.layers import LAYERS
from . import Effect, Piece


class Paint(Effect):
    """Base plus strength times mask, so a crossing stroke adds no more; inverted it does the contrary."""

    def begin(self, canvas, row: float, col: float) -> None:
        layer = LAYERS[canvas.data.row.name]
        self.low, self.high = np.float32(layer.low), np.float32(layer.high)

    def write(self, piece: Piece) -> None:
        change = np.multiply(piece.mask, self.amount, out=piece.spare)
        mode = self.params.mode
        if mode == "reset":
            # no farther than to neutral, from either side
            np.clip(piece.base, -change, change, out=change)
            np.subtract(piece.base, change, out=piece.live)
            return
        down = (mode == "remove") != self.invert
        (np.subtract if down else np.add)(piece.base, change, out=piece.live)
        # what already lies outside the range is left there
        if down:
            np.maximum(piece.live, np.minimum(piece.base, self.low), out=piece.live)
        else:
            np.minimum(piece.live, np.maximum(piece.base, self.high), out=piece.live)
