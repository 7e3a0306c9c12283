"""SCATTER: what lies and grows on the coast by itself, one row a kind, and the rules of where (L09).

A rule gives the share of places that are taken, 0 … 1, from the ground round a place. Rules use sums, products and
comparisons alone, so that a place answers the same whichever tile or batch it is asked in.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .noise import value_noise
from .settings import Settings

WIDER = 0.14  # of noise, by which clumps begin sooner where the amount doubles


@dataclass
class Place:
    """The ground round `n` places, float64 `(n,)` each; `cover` and `paint` are `(n, channels)` of those layers."""

    x: np.ndarray
    y: np.ndarray
    over: np.ndarray  # height over the still sea, m
    slope: np.ndarray  # rise over run
    foot: np.ndarray  # how much steeper than here the ground rises beside it: the foot of a cliff
    cover: np.ndarray
    paint: np.ndarray
    settings: Settings
    lattice: np.ndarray
    amount: float = 1.0  # the setting that counts the kind

    def clumps(self, bare: float, full: float, v: np.ndarray) -> np.ndarray:
        """Where noise `v` gathers things, 0 … 1: an amount over 1 widens clumps, and at 4 little is left bare."""
        wider = WIDER * math.log2(max(self.amount, 1.0))
        return smooth(bare - wider, full - wider, v)

    @property
    def top_m(self) -> float:
        """Height of the run-up limit over the still sea."""
        return self.settings.shore.range_m * self.settings.shore.runup

    def noise(self, cell_m: float, shift: int) -> np.ndarray:
        """Smooth noise 0 … 1, its hills about two cells apart."""
        return value_noise(self.lattice, self.x, self.y, cell_m, (shift, 3 * shift)).v


@dataclass(frozen=True)
class Kind:
    """A row. `size_m` is what the mesh's unit becomes: a rock's radius, a log's length, a tuft's height."""

    name: str
    label: str
    channel: str  # of the layer `scatter`, and the setting that counts it
    spacing_m: float
    size_m: tuple[float, float]
    skew: float  # how much rarer large ones are: size = low + (high − low) · u^skew
    rule: Callable[[Place], np.ndarray]
    allowed: Callable[[Place], np.ndarray]  # where paint may put it, 0 … 1
    full: float  # share of places where it is painted fully
    mesh: str  # family in scatter_meshes.MESHES
    align: float  # 0 stands upright … 1 stands on the slope
    sink: float  # how deep it may sink besides, in its size
    along_contour: bool  # lies along the shore
    wind: float  # how far the wind bends it
    contact_m: tuple[float, float]  # radius of the dark foot in its size, and how dark
    reach: float  # how far it is drawn, in `scatter.distance_m`
    colour: tuple[float, float, float]  # in the view of kinds

    @property
    def salt(self) -> int:
        """What keeps the places of kinds apart; of the name, so that rows may be added."""
        return zlib.crc32(self.name.encode())


def smooth(low: float, high: float, v: np.ndarray) -> np.ndarray:
    """0 up to `low`, 1 from `high` on, GLSL's smoothstep; falls where `high` is below `low`."""
    t = np.clip((v - low) / (high - low), 0.0, 1.0)
    return t * t * (3 - 2 * t)


def stony(p: Place) -> np.ndarray:
    """Share of bare rock, as the ground's material has it (L05)."""
    ground = p.settings.ground
    by_slope = smooth(0.85, 1.25, p.slope / _tan(ground.rock_slope_deg))
    return np.maximum(by_slope, p.cover[:, 1]) * (1 - np.maximum(p.cover[:, 0], p.cover[:, 2]))


def turf(p: Place) -> np.ndarray:
    """Share of grass."""
    ground = p.settings.ground
    ragged = p.noise(5.0, 11) - 0.5
    dry_land = smooth(-0.5, 1.0, (p.over - ground.sand_top_m) / 0.9 + ragged)
    steep = smooth(0.8, 1.15, p.slope / _tan(ground.grass_slope_deg))
    grown = np.maximum(dry_land * (1 - steep) * (1 - p.cover[:, 0]), p.cover[:, 2])
    return grown * (1 - p.cover[:, 1] * (1 - p.cover[:, 2]))


def _tan(degrees: float) -> float:
    return float(np.tan(np.radians(degrees)))


def boulders(p: Place) -> np.ndarray:
    """Fallen at the feet of cliffs, down into the shallows; a few on flat rock."""
    fallen = smooth(0.12, 0.55, p.foot) * smooth(1.1, 0.6, p.slope)
    clusters = p.clumps(0.30, 0.62, 0.6 * p.noise(13.0, 1) + 0.4 * p.noise(5.0, 2))
    strewn = 0.16 * stony(p) * smooth(0.7, 0.35, p.slope) * smooth(2.5, 1.2, p.over)
    return (2.3 * fallen + strewn) * clusters * _shallow(p, 2.6) * smooth(12.0, 5.0, p.over)


def stones(p: Place) -> np.ndarray:
    """Round the boulders, and in patches where the swash sorts them."""
    fallen = smooth(0.06, 0.40, p.foot) * smooth(1.0, 0.5, p.slope) * smooth(12.0, 5.0, p.over)
    clusters = p.clumps(0.38, 0.68, 0.55 * p.noise(13.0, 1) + 0.45 * p.noise(3.1, 4))
    patches = p.clumps(0.56, 0.80, 0.65 * p.noise(21.0, 5) + 0.35 * p.noise(4.3, 6))
    return (1.9 * fallen * clusters + 0.8 * _sorted(p) * patches + 0.010 * (1 - turf(p))) * _shallow(p, 1.6)


def cobbles(p: Place) -> np.ndarray:
    """Pebbles by the hand in the upper swash, as many as the ground has shingle."""
    patches = p.clumps(0.48, 0.76, 0.6 * p.noise(21.0, 5) + 0.4 * p.noise(3.3, 7))
    fallen = smooth(0.05, 0.3, p.foot) * smooth(0.8, 0.4, p.slope) * smooth(8.0, 3.0, p.over)
    shingle = 0.3 + 2.0 * p.settings.ground.shingle
    return (1.6 * _sorted(p) * patches * shingle + 0.9 * fallen + 0.006 * (1 - turf(p))) * _shallow(p, 0.9)


def _shallow(p: Place, down_m: float) -> np.ndarray:
    """1 on land and in water of less than that depth."""
    return smooth(-1.6 * down_m, -0.8 * down_m, p.over)


def _sorted(p: Place) -> np.ndarray:
    """The band from the upper swash to where storms throw pebbles."""
    top = max(p.top_m, 0.1)
    return smooth(0.25 * top, 0.8 * top, p.over) * smooth(2.4 * top, 1.4 * top, p.over) * smooth(0.6, 0.3, p.slope)


def logs(p: Place) -> np.ndarray:
    """The strand line: where the highest waves leave what floats, in heaps."""
    return 2.2 * _strand(p, 0.9) * p.clumps(0.44, 0.70, 0.7 * p.noise(27.0, 8) + 0.3 * p.noise(7.0, 9))


def branches(p: Place) -> np.ndarray:
    heaps = p.clumps(0.45, 0.75, 0.6 * p.noise(27.0, 8) + 0.4 * p.noise(4.0, 10))
    return _strand(p, 0.55) * (0.10 + 1.4 * heaps)


def _strand(p: Place, high_m: float) -> np.ndarray:
    """A band over the run-up limit, on ground that is neither steep nor overgrown."""
    low = 1.04 * p.top_m + 0.04
    band = smooth(low, low + 0.12, p.over) * smooth(low + high_m, low + 0.45 * high_m, p.over)
    return band * smooth(0.42, 0.22, p.slope) * (1 - turf(p)) * (1 - 0.8 * stony(p))


def dune_grass(p: Place) -> np.ndarray:
    """Marram on the seaward edge of the dunes: from the bare sand into the turf."""
    least = 1.7 * p.top_m + 0.5
    edge = max(p.settings.ground.sand_top_m, least + 0.5)
    first = max(least, edge - 1.5)
    belt = smooth(first, edge, p.over) * smooth(edge + 4.5, edge + 1.2, p.over)
    clumps = p.clumps(0.36, 0.60, 0.5 * p.noise(8.0, 12) + 0.5 * p.noise(2.3, 13))
    return 1.7 * belt * clumps * smooth(0.85, 0.5, p.slope) * (1 - stony(p)) * (1 - 0.7 * p.cover[:, 0])


def meadow(p: Place) -> np.ndarray:
    """Tussocks in the turf."""
    clumps = p.clumps(0.42, 0.70, 0.5 * p.noise(14.0, 14) + 0.5 * p.noise(3.0, 15))
    return 1.6 * turf(p) * clumps * (1 - stony(p)) * smooth(0.9, 0.6, p.slope) * above_swash(p)


def anywhere(p: Place) -> np.ndarray:
    return np.ones(len(p.x))


def on_land(p: Place) -> np.ndarray:
    """Not in the water, not on walls."""
    return (p.over > 0.05) * (p.slope < 1.2)


def above_swash(p: Place) -> np.ndarray:
    """Grass drowns in the swash and finds no hold on cliffs."""
    return (p.over > 1.05 * p.top_m) * (p.slope < 1.2)


STONE, WOOD, GREEN = (0.62, 0.60, 0.58), (0.85, 0.55, 0.25), (0.25, 0.70, 0.25)
SCATTER: dict[str, Kind] = {
    row.name: row
    for row in (
        Kind("boulder", "Boulders", "rocks", 2.6, (0.32, 1.7), 2.4, boulders, anywhere, 0.55, "rock", 0.5, 0.25,
             False, 0.0, (1.75, 0.75), 3.2, STONE),
        Kind("stone", "Stones", "rocks", 1.25, (0.10, 0.42), 2.2, stones, anywhere, 0.60, "rock", 0.8, 0.25,
             False, 0.0, (1.7, 0.65), 0.95, (0.45, 0.50, 0.60)),
        Kind("cobble", "Cobbles", "rocks", 0.64, (0.035, 0.11), 1.6, cobbles, anywhere, 0.55, "pebble", 0.9, 0.15,
             False, 0.0, (1.6, 0.5), 0.28, (0.35, 0.38, 0.65)),
        Kind("log", "Logs", "driftwood", 4.0, (1.1, 4.6), 1.6, logs, on_land, 0.40, "log", 1.0, 0.004,
             True, 0.0, (0.16, 0.6), 1.6, WOOD),
        Kind("branch", "Branches", "driftwood", 1.45, (0.25, 1.1), 1.7, branches, on_land, 0.40, "branch", 1.0, 0.004,
             True, 0.0, (0.2, 0.4), 0.6, (0.95, 0.75, 0.35)),
        Kind("dune_grass", "Dune grass", "grass", 0.62, (0.42, 1.0), 1.3, dune_grass, above_swash, 0.85, "dune_grass",
             0.25, 0.05, False, 1.0, (0.75, 0.55), 1.0, (0.55, 0.75, 0.25)),
        Kind("meadow", "Tussocks", "grass", 0.74, (0.15, 0.40), 1.3, meadow, above_swash, 0.55, "tussock",
             0.4, 0.05, False, 0.7, (0.8, 0.5), 0.75, GREEN),
    )
}  # fmt: skip
