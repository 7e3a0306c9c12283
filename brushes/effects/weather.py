"""Weather: paints coverage, precipitation and type over the simulated sky, each with a weight of its own (T04, Z05).

What is shown is mix(simulation, value, weight). Painting a target t with opacity m is the over operator of pictures
with transparency (Porter and Duff, 1984): weight' = weight + m (1 − weight), value' = value + (t − value) m / weight',
after which the sky shows mix(what it showed, t, m) whatever the simulation says there.
"""

from __future__ import annotations

import numpy as np

from ...level.layers import LAYERS
from . import Effect, Piece
from .mean import cascade, mean_minus
from .smooth import MOST

CHANNELS = LAYERS["weather"].channels[:3]
DETAIL = 0.25  # of the radius, that smoothing takes away
FAINTEST = np.float32(2.0**-12)  # weight below which what a channel holds means nothing
LABELS = {"set": "Paint weather", "add": "More weather", "erase": "Erase weather", "smooth": "Smooth weather"}
OPPOSITE = {"set": "erase", "erase": "set", "add": "add", "smooth": "smooth"}


class Weather(Effect):
    """Channels 0 to 2 are values, 3 to 5 their weights; one that isn't painted keeps both to the bit."""

    layer = "weather"

    def __init__(self, params, invert: bool, footprint) -> None:
        super().__init__(params, invert, footprint)
        self.mode = OPPOSITE[params.mode] if invert else params.mode

    @classmethod
    def masked(cls, params, invert: bool) -> bool:
        return params.mode != "smooth"  # rubbing goes on working

    @classmethod
    def smoothing(cls, params):
        return params.model_copy(update={"mode": "smooth"})

    @classmethod
    def label(cls, params, invert: bool) -> str:
        if invert and params.mode == "add":
            return "Less weather"
        return LABELS[OPPOSITE[params.mode] if invert else params.mode]

    @classmethod
    def idle(cls, params) -> frozenset[str]:
        return frozenset([*(() if params.mode == "add" else ("step",)),
                          *(name for name in CHANNELS if not cls._aims(params, name))])  # fmt: skip

    @staticmethod
    def _aims(params, name: str) -> bool:
        """Whether a target is painted: by set, and by erase with Ctrl."""
        return params.mode in ("set", "erase") and getattr(params, f"paint_{name}")

    @classmethod
    def channels(cls, params, channels: tuple[int, ...]) -> tuple[int, ...]:
        painted = [n for n, name in enumerate(CHANNELS) if getattr(params, f"paint_{name}")]
        return tuple(n for value in painted for n in (value, value + 3) if n in channels)

    def begin(self, canvas, row: float, col: float) -> None:
        weather = canvas.level.settings.weather
        self.unpainted = [np.float32(getattr(weather, name)) for name in CHANNELS]
        self.targets = [np.float32(getattr(self.params, name)) for name in CHANNELS]

    def prepare(self, canvas, rect, link) -> None:
        if self.mode != "smooth":
            return
        steps = cascade(DETAIL * self.footprint.radius, min(canvas.data.grid.shape))
        border = sum(steps)
        radii = 2 * link.length / (2 * self.footprint.radius + link.length) if link.length else 1.0
        self.rect = rect
        self.rate = np.float32(1 - (1 - min(float(self.amount), MOST)) ** radii)
        inside = slice(border, -border), slice(border, -border)
        self.found = {}  # value and weight by channel, and what their neighbours' means are more, `(rows, cols)` each
        for channel in canvas.channels[::2]:
            value, weight = canvas.window(rect, border, channel), canvas.window(rect, border, channel + 3)
            here = value[inside].copy(), weight[inside].copy()
            value *= weight  # what counts of it: no value leaks from where nothing is painted
            self.found[channel] = (*here, mean_minus(value, steps), mean_minus(weight, steps))

    def write(self, piece: Piece) -> None:
        channel = piece.channel % 3
        if self.mode == "smooth":
            both = self._smoothed(channel, piece)
        else:
            value, weight = piece.bases[..., channel], piece.bases[..., channel + 3]
            share = np.multiply(piece.mask, self.amount, out=piece.spare)
            both = (
                self._erased(value, weight, share)
                if self.mode == "erase"
                else self._over(value, weight, share, self._target(channel, value, weight))
            )
        piece.live[...] = both[piece.channel // 3]

    def _target(self, channel: int, value: np.ndarray, weight: np.ndarray):
        """What is painted; added to it is what the sky shows, as far as that is known without the simulation."""
        if self.mode == "set":
            return self.targets[channel]
        step = np.float32(-self.params.step if self.invert else self.params.step)
        shown = self.unpainted[channel] + (value - self.unpainted[channel]) * weight
        return np.clip(shown + step, 0, 1)

    @staticmethod
    def _over(value: np.ndarray, weight: np.ndarray, share: np.ndarray, target) -> tuple[np.ndarray, np.ndarray]:
        """Value and weight with the target laid over; to the bit what they were where the share is 0."""
        after = weight + share * (1 - weight)
        part = np.divide(share, after, out=np.zeros_like(after), where=after > 0)
        return value + (target - value) * part, after

    @staticmethod
    def _erased(value: np.ndarray, weight: np.ndarray, share: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The simulation comes back; what is quite erased is as if it never was painted."""
        after = weight * (1 - share)
        return np.where(after > 0, value, 0), after

    def _smoothed(self, channel: int, piece: Piece) -> tuple[np.ndarray, np.ndarray]:
        """(value · weight) and weight, each nearer to its neighbours' mean; a value is the one over the other."""
        rows = slice(piece.rect.row0 - self.rect.row0, piece.rect.row1 - self.rect.row0)
        cols = slice(piece.rect.col0 - self.rect.col0, piece.rect.col1 - self.rect.col0)
        value, weight, counts_more, weighs_more = (part[rows, cols] for part in self.found[channel])
        share = np.multiply(piece.weight, self.rate, out=piece.spare)
        after = np.clip(weight + share * weighs_more, 0, 1)
        change = share * (counts_more - value * weighs_more)
        moved = np.divide(change, after, out=np.zeros_like(after), where=after > FAINTEST)
        kept = (after > FAINTEST) | (weight > 0)
        return np.where(kept, np.clip(value + moved, 0, 1), 0), np.where(kept, after, 0)
