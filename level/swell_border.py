"""Where a swell comes into a level: on which border, in what depth, and when at each of its cells.

A plane wave is put on the border's own cells instead of on a front far out: no padding, no corner diffraction
(research on fast marching of oblique swell: fronts that enter through an unseeded border come in 5 to 10 degrees off).
All in a frame turned so that the swell comes from the south and not from the east (`Turn`): a mirrored level then gives
a mirrored answer to the bit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .dispersion import wavenumber

DEEP = 0.9  # of the reference's phase speed: there the bed doesn't turn the swell yet, and it is the plane wave
SHALLOW = 0.7  # of it: what has run over that is late, and in deep water behind it the swell comes from elsewhere
SOURCE_DEPTH = 0.25  # of the deepest border: a side with less than that is a river's mouth, not the sea
TYPICAL = 90.0  # percentile of a border's wet depths: one hole in it must not set the swell's speed
ALONG = 1e-9  # component of a direction below which the swell goes along a border, not through it


@dataclass(frozen=True)
class Turn:
    """A mirroring of rows, of columns, and a swap of both: into the frame where the swell comes from the south west."""

    flip_rows: bool
    flip_cols: bool
    swap: bool

    def into(self, field: np.ndarray) -> np.ndarray:
        """A map (rows, cols) in the turned frame, a view."""
        field = field[:: -1 if self.flip_rows else 1, :: -1 if self.flip_cols else 1]
        return field.T if self.swap else field

    def back(self, field: np.ndarray) -> np.ndarray:
        """A map of the turned frame as the level has it, a view."""
        field = field.T if self.swap else field
        return field[:: -1 if self.flip_rows else 1, :: -1 if self.flip_cols else 1]


@dataclass(frozen=True)
class Border:
    """The swell as it stands at the level: `across`, `along` are its direction's parts in the turned frame, both >= 0.

    `across` goes through the main side (turned: from south to north), `along` along it (from west to east).
    """

    turn: Turn
    across: float
    along: float
    depth_m: float  # reference: what the plane wave outside runs over
    k: float  # its wavenumber there, 1/m


def direction(heading_deg: float) -> tuple[float, float]:
    """Unit vector (east, north) of a heading clockwise from north; exact on the four main headings."""
    quarter, rest = divmod(heading_deg % 360.0, 90.0)
    sin, cos = float(np.sin(np.radians(rest))), float(np.cos(np.radians(rest)))
    for _ in range(int(quarter)):
        sin, cos = cos, -sin
    return sin, cos


def find_border(depth_m: np.ndarray, period_s: float, heading_deg: float) -> Border | None:
    """The side that most of the swell comes through; None where it would come from land.

    Deep water counts by its square: along a coast the seaward side then wins over the one that runs up on the beach,
    and on the seaward side the plane wave is right.
    """
    east, north = direction(heading_deg)
    deepest = max(float(side.max()) for side in (depth_m[0], depth_m[-1], depth_m[:, 0], depth_m[:, -1]))
    if deepest <= 0:
        return None
    best, main = 0.0, None
    for swap, part, side in (
        (False, north, depth_m[0] if north > 0 else depth_m[-1]),
        (True, east, depth_m[:, 0] if east > 0 else depth_m[:, -1]),
    ):
        score = abs(part) * float(np.mean(np.clip(side / deepest, 0, 1) ** 2))
        if abs(part) > ALONG and side.max() >= SOURCE_DEPTH * deepest and score > best:
            best, main = score, (swap, side)
    if main is None:
        return None
    swap, side = main
    depth = float(np.percentile(side[side > 0], TYPICAL))
    across, along = (abs(east), abs(north)) if swap else (abs(north), abs(east))
    turn = Turn(flip_rows=north < 0, flip_cols=east < 0, swap=swap)
    return Border(turn, across, along, depth, float(wavenumber(period_s, depth)))


def side_phase(k: np.ndarray, ratio: np.ndarray, wet: np.ndarray, border: Border, cell_m: float) -> np.ndarray:
    """Phase (rad) along the side that the swell runs along, from the main side up; NaN where none comes in.

    Outside, the bed goes on as it is on the side (straight contours), so the part of the wavenumber along the main side
    is kept (Snell) and the other follows: phase = ∫ sqrt(k² - k_along²). Deep water after land or after a shoal starts
    anew with the plane wave, which is what is drawn beyond the level there. `k` may hold a painted speed, `ratio` is
    the phase speed by the reference's.
    """
    count = np.arange(len(k))
    across = np.sqrt(np.maximum(k**2 - (border.k * border.along) ** 2, 0.0))
    run = np.concatenate(([0.0], np.cumsum(0.5 * (across[1:] + across[:-1])))) * cell_m
    plane = count * cell_m * border.k * border.across
    deep, shallow = wet & (ratio >= DEEP), ~wet | (ratio < SHALLOW)
    last_deep = np.concatenate(([-1], np.maximum.accumulate(np.where(deep, count, -1))[:-1]))
    starts = deep & (np.maximum.accumulate(np.where(shallow, count, -1)) > last_deep)
    starts[0] = wet[0]
    anchor = np.maximum.accumulate(np.where(starts, count, -1))
    land = np.maximum.accumulate(np.where(wet, -1, count))
    return np.where(wet & (anchor > land), plane[anchor] + run - run[anchor], np.nan)
