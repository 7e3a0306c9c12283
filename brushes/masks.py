"""Masks: where a brush may work (T01, T03), by slope, height, depth, current, way to the shore, and painted layers.

    depth_m 0..2 ~0.5; flow_mps 1..; foam.constant ..0.4

A limit is a source, a range with open ends where a number is left out, and how much of the range fades at either end;
a brush works where all of them let it. What they read is that of the moment at which the stroke began.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from ..level.grid import Rect
from ..level.layers import LAYERS
from .surroundings import Surroundings

if TYPE_CHECKING:
    from ..level import Level
    from .canvas import Canvas

MOST = 12  # limits of one brush
NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
LIMIT = re.compile(rf"([a-z_]+(?:\.[a-z_]+)?)\s+({NUMBER})?\.\.({NUMBER})?(?:\s*~\s*({NUMBER}))?")


@dataclass(frozen=True)
class Source:
    """What a limit looks at: values of a rectangle as the stroke found it, float32; `needs` of the surroundings."""

    name: str
    unit: str
    doc: str
    values: Callable[[Canvas, Rect], np.ndarray]
    usual: tuple[float, float, float] = (0.0, 1.0, 0.1)  # a limit that is new in the panel
    needs: str = ""


@dataclass(frozen=True)
class Limit:
    """A range of a source; None leaves that end open."""

    source: str
    low: float | None
    high: float | None
    soft: float = 0.0

    def text(self) -> str:
        low, high = ("" if end is None else f"{end:g}" for end in (self.low, self.high))
        return f"{self.source} {low}..{high}" + (f" ~{self.soft:g}" if self.soft else "")

    def share(self, values: np.ndarray) -> np.ndarray:
        """1 within the range and 0 outside, fading inside it towards either end."""
        share = np.ones(values.shape, np.float32)
        for inside in (values - self.low if self.low is not None else None,
                       self.high - values if self.high is not None else None):  # fmt: skip
            if inside is None:
                continue
            if self.soft:
                t = np.clip(inside / np.float32(self.soft), 0, 1)
                share *= t * t * (3 - 2 * t)
            else:
                share *= inside >= 0
        return share


def _slope(canvas: Canvas, rect: Rect) -> np.ndarray:
    height = canvas.found("height", rect, 1)
    east, north = height[1:-1, 2:] - height[1:-1, :-2], height[2:, 1:-1] - height[:-2, 1:-1]
    return np.degrees(np.arctan(np.hypot(east, north) / np.float32(2 * canvas.level.grid.cell_m)))


def depth_m(canvas: Canvas, rect: Rect) -> np.ndarray:
    """Water over the ground at mean tide, the sea's or a river's; below 0 on dry land."""
    ground = canvas.found("height", rect)
    depth = np.float32(canvas.level.mean_sea_m) - ground
    if canvas.level.layers["river_mask"].neutral:
        return depth
    river = canvas.found("river_surface", rect) - ground
    return np.where(canvas.found("river_mask", rect) >= 0.5, np.maximum(depth, river), depth)


def _painted(layer: str, channel: int) -> Callable[[Canvas, Rect], np.ndarray]:
    return lambda canvas, rect: canvas.found(layer, rect, 0, channel)


def _layer_sources() -> list[Source]:
    rows = []
    for row in LAYERS.values():
        if row.grid != "level" or row.name in ("height", "flow", "river_surface"):
            continue
        for number, channel in enumerate(row.channels):
            name = row.name if len(row.channels) == 1 else f"{row.name}.{channel}"
            rows.append(Source(name, "", row.doc, _painted(row.name, number)))
    return rows


SOURCES: dict[str, Source] = {
    row.name: row
    for row in (
        Source("depth_m", "m", "Depth of the water, below 0 on land.", depth_m, (0.0, 2.0, 0.5)),
        Source("height_m", "m", "Height of the ground.", lambda c, r: c.found("height", r), (0.0, 10.0, 1.0)),
        Source("slope_deg", "°", "Steepness of the ground.", _slope, (0.0, 30.0, 5.0)),
        Source("flow_mps", "m/s", "Speed of the current.",
               lambda c, r: c.surroundings.speed_mps(r), (0.5, 20.0, 0.2), "flow"),
        Source("shore_m", "m", "Way to the shoreline, below 0 on land.",
               lambda c, r: c.surroundings.shore_m(r), (0.0, 10.0, 2.0), "shore"),
        *_layer_sources(),
    )
}  # fmt: skip


@lru_cache(64)
def limits_of(text: str) -> tuple[Limit, ...]:
    """The limits a text names; ValueError says what is wrong with it."""
    parts = [part.strip() for part in text.split(";") if part.strip()]
    if len(parts) > MOST:
        raise ValueError(f"a brush takes {MOST} limits, not {len(parts)}")
    return tuple(_limit(part) for part in parts)


def _limit(text: str) -> Limit:
    found = LIMIT.fullmatch(text)
    if not found:
        raise ValueError(f"{text!r} is no limit: write a source and its range, such as depth_m 0..2 ~0.5")
    source, low, high, soft = found.groups()
    if source not in SOURCES:
        raise ValueError(f"no limit is called {source!r}; there are: {', '.join(SOURCES)}")
    low, high = (None if end is None else float(end) for end in (low, high))
    if None not in (low, high) and low > high:
        raise ValueError(f"{text!r} holds nothing: its range ends before it begins")
    if float(soft or 0) < 0:
        raise ValueError(f"{text!r} cannot fade over less than nothing")
    return Limit(source, low, high, float(soft or 0))


def checked(text: str) -> str:
    """The text as limits write themselves."""
    return text_of(limits_of(text))


def text_of(limits) -> str:
    return "; ".join(limit.text() for limit in limits)


class Mask:
    """The limits of one stroke, worked out tile by tile where it comes and kept: they are those of its beginning."""

    def __init__(self, limits: tuple[Limit, ...]) -> None:
        self.limits = limits
        self.tiles: dict[tuple[int, int], np.ndarray] = {}

    def hold(self, canvas: Canvas, rect: Rect, weight: np.ndarray) -> None:
        """Take from the weights of `rect` what the limits don't let through."""
        grid = canvas.data.grid
        for tile in grid.tiles(rect):
            whole = grid.tile_rect(tile)
            if tile not in self.tiles:
                self.tiles[tile] = self._share(canvas, whole)
            part = whole.intersect(rect)
            weight[part.shifted(rect).slices] *= self.tiles[tile][part.shifted(whole).slices]

    def _share(self, canvas: Canvas, rect: Rect) -> np.ndarray:
        share = np.ones(rect.shape, np.float32)
        for limit in self.limits:
            share *= limit.share(SOURCES[limit.source].values(canvas, rect))
        return share


def settled(level: Level, text: str, needs: frozenset[str] = frozenset()) -> tuple[Mask | None, Surroundings]:
    """The mask of a stroke that begins now, and the surroundings that it and the effect read."""
    limits = limits_of(text)
    needs |= {SOURCES[limit.source].needs for limit in limits}
    return (Mask(limits) if limits else None), Surroundings(level, needs - {""})
