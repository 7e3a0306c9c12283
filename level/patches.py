"""Hectare patches of the sea: where its mesh is and what kind of sea each of them holds (Hitman talk, H01, H27).

Patches are 100 × 100 m, fixed to the world with a corner at (0, 0), cut on a grid of 10 m. By themselves kinds follow
from the shore and change nothing that is drawn; a `sea_patch` object overrides its hectare and does. The twin of
`patch_shore` and `beach_contact` is shaders/patches.glsl.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .dual import Dual, step
from .level import Level
from .objects import SeaPatch, ViewCircle
from .shore import shore_map
from .shore_field import shore_field
from .tide import band_m

PATCH_M, BASE_M = 100.0, 10.0
FADE_M = 20.0  # round an overridden patch, over which waves come back
MOST_RING = 100  # hectares
MOST_RECTS = 32  # rectangles of overridden patches that count; rows of one kind side by side are one
KINDS = ("open", "coastal", "beach", "removed")
OPEN, COASTAL, BEACH, REMOVED = range(4)


@dataclass(frozen=True)
class Circle:
    """World metres."""

    x: float
    y: float
    radius_m: float

    def holds(self, other: Circle, spare_m: float = 0.0) -> bool:
        return float(np.hypot(other.x - self.x, other.y - self.y)) + other.radius_m <= self.radius_m + spare_m


def smallest_circle(circles: list[Circle]) -> Circle:
    """The smallest circle round all of `circles` (one or more).

    It touches at most three. Those grow one at a time: of the old ones and the circle that sticks out farthest, the two
    or three that need the most room. It ends where rounding lets that room grow no more.
    """
    touching = [max(circles, key=lambda c: c.radius_m)]
    while True:
        round_them = _round(touching)
        out = [np.hypot(c.x - round_them.x, c.y - round_them.y) + c.radius_m for c in circles]
        worst = int(np.argmax(out))
        if out[worst] <= round_them.radius_m * (1 + 1e-9) + 1e-9 or circles[worst] in touching:
            return round_them
        more = _needed([*touching, circles[worst]])
        if _round(more).radius_m <= round_them.radius_m:
            return round_them
        touching = more


def _needed(circles: list[Circle]) -> list[Circle]:
    """Those of up to four circles whose smallest circle holds all of them."""
    spare = 1e-9 * (1 + sum(c.radius_m + abs(c.x) + abs(c.y) for c in circles))
    best, kept = None, circles
    for chosen in range(1, 1 << len(circles)):
        some = [c for i, c in enumerate(circles) if chosen >> i & 1]
        made = _round(some) if len(some) <= 3 else None
        if made and all(made.holds(c, spare) for c in circles) and (best is None or made.radius_m < best):
            best, kept = made.radius_m, some
    return kept


def _round(circles: list[Circle]) -> Circle | None:
    """The circle that touches one, two or three circles from outside; None where there is none."""
    if len(circles) == 1:
        return circles[0]
    a, b = circles[:2]
    if len(circles) == 2:
        away = float(np.hypot(b.x - a.x, b.y - a.y))
        if away + min(a.radius_m, b.radius_m) <= max(a.radius_m, b.radius_m):
            return max(circles, key=lambda c: c.radius_m)
        radius = (away + a.radius_m + b.radius_m) / 2
        part = (radius - a.radius_m) / away
        return Circle(a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part, radius)
    return _apollonius(*circles)


def _apollonius(a: Circle, b: Circle, c: Circle) -> Circle | None:
    """|centre − cᵢ| = R − rᵢ for three circles: two differences are linear in centre and R, the rest is quadratic."""
    rows = np.array([[other.x - a.x, other.y - a.y] for other in (b, c)])
    more = np.array([other.radius_m - a.radius_m for other in (b, c)])
    if abs(np.linalg.det(rows)) < 1e-9 * (1 + np.abs(rows).max() ** 2):
        return None
    # seen from a's centre, with S = R − a.radius: centre = start + way · S
    start = np.linalg.solve(rows, ((rows**2).sum(axis=1) - more**2) / 2)
    way = np.linalg.solve(rows, more)
    p, q, r = way @ way - 1, 2 * way @ start, start @ start
    if abs(p) < 1e-12:
        roots = [-r / q] if q else []
    else:
        inside = q * q - 4 * p * r
        roots = [] if inside < 0 else [(-q - np.sqrt(inside)) / (2 * p), (-q + np.sqrt(inside)) / (2 * p)]
    found = [s for s in roots if s >= 0 and all(s >= m - 1e-9 for m in more)]
    if not found:
        return None
    x, y = start + way * min(found)
    return Circle(a.x + float(x), a.y + float(y), a.radius_m + float(min(found)))


def extents(level: Level) -> Circle | None:
    """The smallest circle round all view circles of a level; None without any: then the mesh follows the camera."""
    things = sorted((o for o in level.objects.values() if isinstance(o, ViewCircle)), key=lambda o: o.id)
    circles = [Circle(o.x, o.y, o.radius_m) for o in things]
    key = tuple(circles)
    known, made = level.derived.get("extents", (None, None))
    if known != key:
        made = smallest_circle(circles) if circles else None
        level.derived["extents"] = key, made
    return made


def in_mesh(circle: Circle, col, row) -> np.ndarray:
    """Whether hectares (arrays of columns and rows) have a part in the circle."""
    west, south = np.asarray(col) * PATCH_M, np.asarray(row) * PATCH_M
    x, y = np.clip(circle.x, west, west + PATCH_M), np.clip(circle.y, south, south + PATCH_M)
    return np.hypot(x - circle.x, y - circle.y) < circle.radius_m


def overrides(level: Level) -> dict[tuple[int, int], int]:
    """Kinds by hectare (column, row) that `sea_patch` objects ask for; of two in one hectare the later id counts."""
    things = sorted((o for o in level.objects.values() if isinstance(o, SeaPatch)), key=lambda o: o.id)
    return {(int(o.x // PATCH_M), int(o.y // PATCH_M)): KINDS.index(o.sea) for o in things}


def patch_rects(level: Level) -> tuple[np.ndarray, tuple[int, int, int]]:
    """World rectangles float64 `(n, 4)` (west, south, east, north) overridden as open, coastal and removed, in this
    order, and where each kind ends."""
    asked, rects, ends = overrides(level), [], []
    for kind in (OPEN, COASTAL, REMOVED):
        for row, col in sorted((row, col) for (col, row), one in asked.items() if one == kind):
            west, south = col * PATCH_M, row * PATCH_M
            same_row = rects and len(rects) > (ends[-1] if ends else 0) and rects[-1][1] == south
            if same_row and rects[-1][2] == west:
                rects[-1][2] += PATCH_M
            elif len(rects) < MOST_RECTS:
                rects.append([west, south, west + PATCH_M, south + PATCH_M])
        ends.append(len(rects))
    return np.array(rects, np.float64).reshape(-1, 4), tuple(ends)


def _away(rects: np.ndarray, x, y) -> Dual:
    """Distance to the nearest of some rectangles, 0 within; with its gradient."""
    best = Dual(np.full(np.shape(x), 1e9), np.zeros(np.shape(x)), np.zeros(np.shape(x)))
    for west, south, east, north in rects:
        dx, dy = x - np.clip(x, west, east), y - np.clip(y, south, north)
        away = np.hypot(dx, dy)
        reach, nearer = np.maximum(away, 1e-6), away < best.v
        best = Dual(*(np.where(nearer, new, old) for new, old in (
            (away, best.v), (dx / reach, best.dx), (dy / reach, best.dy))))  # fmt: skip
    return best


def patch_shore(level: Level, x, y) -> Dual:
    """Share of the shore waves at world points: 0 where a patch is overridden as open, 1 from FADE_M beside it on."""
    rects, ends = patch_rects(level)
    return step(0.0, FADE_M, _away(rects[: ends[0]], x, y)) if ends[0] else Dual(1.0)


def beach_contact(level: Level, x, y) -> Dual:
    """Share of the sheet's contact with the beach (H10): 0 where a patch is overridden as open or coastal."""
    rects, ends = patch_rects(level)
    return step(0.0, FADE_M, _away(rects[: ends[1]], x, y)) if ends[1] else Dual(1.0)


def removed(level: Level, x, y) -> np.ndarray:
    """Where hectares are overridden as removed, at world points: no sea is there."""
    rects, ends = patch_rects(level)
    found = np.zeros(np.shape(x), bool)
    for west, south, east, north in rects[ends[1] : ends[2]]:
        found |= (x >= west) & (x < east) & (y >= south) & (y < north)
    return found


def patch_uniforms(level: Level) -> dict:
    """What shaders/patches.glsl asks for."""
    rects, ends = patch_rects(level)
    padded = np.zeros((MOST_RECTS, 4), np.float32)
    padded[: len(rects)] = rects
    return {"u_patch_rects": padded, "u_patch_ends": ends}


@dataclass(frozen=True)
class PatchKinds:
    """`kinds` uint8 `(rows, cols)` of hectares from (`col0`, `row0`) on, south-west first; beyond them all is open."""

    col0: int
    row0: int
    kinds: np.ndarray


def patch_kinds(level: Level) -> PatchKinds:
    """Kinds of the hectares of a level and of a ring round it that holds every overridden one, up to MOST_RING.

    By the distance to the shore; open only where the clock's depth is out of reach of every shore wave, removed only
    where all ground stands over twice the highest wave.
    """
    from .waves import largest_height_m

    sea, shore, field = level.settings.sea, shore_map(level), shore_field(level, now=True)
    cols, rows = (int(np.ceil(side / PATCH_M)) for side in level.grid.extent_m)
    asked = overrides(level)
    ring = min(max((max(-col, -row, col - cols + 1, row - rows + 1) for col, row in asked), default=1), MOST_RING)
    ring = max(ring, 1)
    shape = rows + 2 * ring, cols + 2 * ring
    nearest = _by_hectare(np.abs(field.distance_m), field.cell_m, shape, ring, np.min)
    clock = _by_hectare(shore.packed[..., 0], shore.cell_m, shape, ring, np.min)
    lowest = _by_hectare(level.height, level.grid.cell_m, shape, ring, np.min)
    kinds = np.full(shape, OPEN, np.uint8)
    known_m = 0.999 * field.range_m  # the field knows no farther distance
    low_m, high_m = band_m(level.settings)
    kinds[(nearest < min(sea.coastal_m, known_m)) | (clock + low_m < shore_reach_m(level))] = COASTAL
    kinds[nearest < min(sea.beach_m, known_m)] = BEACH
    dry = lowest > level.mean_sea_m + high_m + 2 * largest_height_m(level)
    dry[: ring + 1], dry[-ring - 1 :], dry[:, : ring + 1], dry[:, -ring - 1 :] = False, False, False, False
    kinds[dry] = REMOVED
    far = np.ones(shape, bool)  # so far past the border no shore wave goes
    far[ring - 1 : ring + rows + 1, ring - 1 : ring + cols + 1] = False
    kinds[far] = OPEN
    for (col, row), kind in asked.items():
        if 0 <= row + ring < shape[0] and 0 <= col + ring < shape[1]:
            kinds[row + ring, col + ring] = kind
    return PatchKinds(-ring, -ring, kinds)


def shore_reach_m(level: Level) -> float:
    """Clock depth from which on every mask of the shore waves is nothing: the outermost front's trail ends there."""
    shore = level.settings.shore
    trail = max(shore.gap + 2 * shore.back, shore.gap + shore.width / 2, (shore.width + shore.fall) / 2)
    return shore.range_m * (1 + trail)


def _by_hectare(values: np.ndarray, cell_m: float, shape: tuple, ring: int, reduce) -> np.ndarray:
    """`reduce` over the samples of each hectare and BASE_M round it; beyond the level the border goes on."""
    spans = []
    for count, samples in zip(shape, values.shape, strict=True):
        first = (np.arange(count) - ring) * PATCH_M
        low = np.clip(np.floor((first - BASE_M) / cell_m), 0, samples - 1).astype(int)
        high = np.clip(np.ceil((first + PATCH_M + BASE_M) / cell_m), 0, samples - 1).astype(int) + 1
        spans.append(list(zip(low, high, strict=True)))
    lines = np.stack([reduce(values[a:b], axis=0) for a, b in spans[0]])
    return np.stack([reduce(lines[:, a:b], axis=1) for a, b in spans[1]], axis=1)
