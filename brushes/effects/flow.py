"""Flow: the way of the stroke becomes the way of the water (T02)."""

from __future__ import annotations

import math

import numpy as np

from ...level.grid import Rect
from . import Effect, Piece
from .rub import Rub
from .way import Way

OPPOSITE = {"replace": "erase", "erase": "replace", "add": "add", "smooth": "smooth", "rotate": "rotate",
            "comb": "comb", "coherent": "coherent"}  # fmt: skip
LABELS = {"replace": "Paint flow", "erase": "Erase flow", "add": "Add flow", "smooth": "Smooth flow",
          "rotate": "Turn flow", "comb": "Comb flow along the shore", "coherent": "Make flow coherent"}  # fmt: skip
DRAWN = ("replace", "add")  # modes that lay down the way of the stroke
SPEED_LEAST = 1e-3  # m/s; water that is slower runs no way


class FlowPaint(Effect):
    """Both channels at once: worked out with the first, kept for the second. Every cell has the way of the dabs that
    came over it, the late ones more, and the strength of the strongest.
    """

    layer = "flow"

    def __init__(self, params, invert: bool, footprint) -> None:
        super().__init__(params, invert, footprint)
        self.mode = OPPOSITE[params.mode] if invert else params.mode
        self.sign = np.float32(-1 if invert else 1)
        self.rub = Rub(float(self.amount), footprint.radius) if self.mode == "smooth" else None
        self.way = Way()

    @classmethod
    def masked(cls, params, invert: bool) -> bool:
        return params.mode != "smooth"

    @classmethod
    def smoothing(cls, params):
        return params.model_copy(update={"mode": "smooth"})

    @classmethod
    def label(cls, params, invert: bool) -> str:
        return LABELS[OPPOSITE[params.mode] if invert else params.mode]

    @classmethod
    def needs(cls, params) -> frozenset[str]:
        return frozenset(["shore"]) if params.mode == "comb" else frozenset()

    @classmethod
    def goes_along(cls, params) -> bool:
        return params.mode in DRAWN or params.mode == "erase"  # with Ctrl that draws

    @classmethod
    def takes_pressure(cls, params) -> bool:
        return params.pressure == "speed" and params.mode in DRAWN

    @classmethod
    def idle(cls, params) -> frozenset[str]:
        unused = [] if params.mode == "rotate" else ["angle_deg"]
        if params.mode not in DRAWN:
            unused += ["speed_mps", "pressure", "click", "heading_deg"]
        return frozenset([*unused, *(["heading_deg"] if params.click in ("away", "towards") else [])])

    def prepare(self, canvas, rect, link) -> None:
        self.canvas = canvas
        if self.rub:
            self.rub.prepare(canvas, rect, link)
        self.speed = np.float32(self.params.speed_mps * self.pressed)
        if link.length:
            north, east = link.heading
            self.heading = np.array([east, north], np.float32)
        elif self.mode in DRAWN:
            self.heading = self._clicked(canvas, link)

    def _clicked(self, canvas, link) -> np.ndarray | None:
        """Where a click without a way sends the water; None where that is another way for each cell."""
        if self.params.click in ("away", "towards"):
            return None
        if self.params.click == "as_water":
            from ..surroundings import settled_current

            x, y = canvas.data.grid.to_metres(link.row1, link.col1)
            east, north = (float(part) for part in settled_current(canvas.level).at(x, y))
            if math.hypot(east, north) > SPEED_LEAST:
                return np.array([east, north], np.float32) / np.float32(math.hypot(east, north))
        heading = math.radians(self.params.heading_deg)
        return np.array([math.sin(heading), math.cos(heading)], np.float32)

    def write(self, piece: Piece) -> None:
        if self.rub:
            np.add(piece.live, self.rub.change(piece), out=piece.live)
            return
        if self.mode == "coherent":
            return  # the mask says where, the release does it
        if piece.channel == 0:
            self.both = self._both(piece)
        np.clip(self.both[piece.channel], self.canvas.data.row.low, self.canvas.data.row.high, out=piece.live)

    def _both(self, piece: Piece) -> tuple[np.ndarray, np.ndarray]:
        """East and north after the dab."""
        east, north = piece.bases[..., 0], piece.bases[..., 1]
        share = np.multiply(piece.mask, self.amount, out=piece.spare)
        if self.mode == "erase":
            return east * (1 - share), north * (1 - share)
        if self.mode == "rotate":
            return _turned(east, north, share * np.float32(math.radians(self.params.angle_deg)) * self.sign)
        if self.mode == "comb":
            return self._combed(piece, east, north, share)
        to_east, to_north = self._drawn(piece)
        if self.mode == "add":
            share *= self.sign
            return east + share * to_east, north + share * to_north
        return east + share * (to_east - east), north + share * (to_north - north)

    def _drawn(self, piece: Piece) -> tuple[np.ndarray, np.ndarray]:
        """The water that the stroke asks for, m/s."""
        if self.heading is not None:
            return self.way.over(piece, self.heading, self.speed)
        rows = (np.arange(piece.rect.row0, piece.rect.row1) - piece.link.row1).astype(np.float32)[:, None]
        cols = (np.arange(piece.rect.col0, piece.rect.col1) - piece.link.col1).astype(np.float32)[None, :]
        speed = (-self.speed if self.params.click == "towards" else self.speed) / np.maximum(np.hypot(rows, cols), 1)
        return cols * speed, rows * speed

    def _combed(self, piece: Piece, east, north, share) -> tuple[np.ndarray, np.ndarray]:
        """Turned the shorter way towards the shoreline's own; with Ctrl the longer one, so that it runs back."""
        to_shore = self.canvas.surroundings.to_shore(piece.rect)
        along_east, along_north = -to_shore[..., 1], to_shore[..., 0]
        side = np.where(east * along_east + north * along_north < 0, np.float32(-1), np.float32(1)) * self.sign
        along_east, along_north = along_east * side, along_north * side
        angle = np.arctan2(east * along_north - north * along_east, east * along_east + north * along_north)
        known = (to_shore != 0).any(-1)
        return _turned(east, north, np.where(known, -angle, 0).astype(np.float32) * share)

    def finish(self, canvas) -> list[Rect]:
        return _made_coherent(canvas, float(self.amount)) if self.mode == "coherent" else []


def _turned(east, north, angle) -> tuple[np.ndarray, np.ndarray]:
    """Turned clockwise by radians."""
    cos, sin = np.cos(angle), np.sin(angle)
    return east * cos + north * sin, north * cos - east * sin


def _made_coherent(canvas, share: float) -> list[Rect]:
    """Take the divergence out of what the stroke went over, no flux into land."""
    from ...level.projection import divergence_free  # here, for it brings SciPy
    from ..masks import depth_m

    rect, grid = canvas.bounds, canvas.data.grid
    if rect.empty:
        return []
    inside = np.zeros(grid.clip(rect.pad(2)).shape, bool)
    window = grid.clip(rect.pad(2))
    for tile, mask in canvas.masks.items():
        whole = grid.tile_rect(tile)
        part = whole.intersect(window)
        if not part.empty:
            inside[part.shifted(window).slices] = mask[part.shifted(whole).slices] > 0
    wet = depth_m(canvas, window) > 0
    flow = canvas.data.array[window.slices]
    east, north = divergence_free(wet, flow[..., 0], flow[..., 1], grid.cell_m, inside)
    for number, part in enumerate((east, north)):
        flow[..., number][inside] += ((part - flow[..., number]) * share)[inside]
    return [rect]
