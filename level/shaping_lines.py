"""Crests as lines: which one is near a place at a moment, where it runs, and what a hand makes of it (T07).

A crest is where `phase_at` is a whole number, the number of its wave; it grows with time and falls on the way in.
"""

from __future__ import annotations

from functools import reduce

import numpy as np
from scipy import ndimage

from .arrival import arrival, shore_at, swell
from .beach_map import beach_map
from .dual import Dual, step
from .gerstner import phase_noise
from .level import Level
from .noise import lattice
from .pins import later
from .shore import shore_map
from .shore_waves import Travel, lead_arrival, s_cycles, shore_early
from .weather_keys import level_at

SIDE = 121  # samples a side in which crests are looked for
COARSE = 4  # every so many samples a side are read first: only where a crest passes, all


def phase_at(level: Level, t: float, x, y, pinned: bool = True) -> tuple[Dual, np.ndarray]:
    """(cycles since wave 0 passed, a dual; whether shore waves come there) at world points at time t.

    `pinned` off: as if the level had no pins.
    """
    then = level_at(level, t)
    shore, x, y = shore_at(then, t), np.asarray(x, np.float64), np.asarray(y, np.float64)
    bed, sway = shore_map(then).at(x, y, then.tide_m), beach_map(then).at(x, y)[1]
    early = shore_early(shore, x, y, sway, lattice(then.settings.level.seed))
    here = (bed["sea"].v > 0.5) & (bed["depth"].v > 0) & shore.on
    late = later(then, t, x, y) if pinned else Dual(0.0)
    by_depth = late * (1 - then.settings.timing.share)
    made = arrival(then, t)
    s = 1.0 - bed["smoothed"] * (1 / shore.range_m)
    if made is None:
        return t / shore.interval_s + early - by_depth - s * s_cycles(shore), here & (s.v > 0) & (s.v < 1)
    bend = phase_noise(then.settings.sea, swell(then, t), 0, x, y) + late
    way = Travel.of(made.at(x, y, heights=False), bend, then.settings.timing.share)
    return t / shore.interval_s - lead_arrival(shore, s, early * step(0.0, 1.0, s) - by_depth, way), here & (s.v < 1)


def crest_near(level: Level, t: float, at: tuple[float, float], radius_m: float) -> tuple[int, np.ndarray] | None:
    """(wave, line (n, 2) of world points) of the crest nearest to a place, as it runs within `radius_m`; or None."""
    x, y = (np.linspace(-radius_m, radius_m, SIDE) + centre for centre in at)
    values = np.full((SIDE, SIDE), np.nan)
    far = np.hypot(x[None] - at[0], y[:, None] - at[1])
    east, north = level.grid.extent_m
    inside = (far <= radius_m) & ((x >= 0) & (x <= east))[None] & ((y >= 0) & (y <= north))[:, None]

    def read(where: np.ndarray) -> None:
        row, col = np.nonzero(where & inside)
        phase, here = phase_at(level, t, x[col], y[row])
        values[row, col] = np.where(here, phase.v, np.nan)

    coarse = np.zeros(values.shape, bool)
    coarse[::COARSE, ::COARSE] = True
    read(coarse)
    if not np.isfinite(values).any():
        return None
    middle = np.unravel_index(np.nanargmin(np.where(np.isfinite(values), far, np.nan)), far.shape)
    waves = {int(np.floor(values[middle])), int(np.ceil(values[middle]))}
    read(_passed(values[::COARSE, ::COARSE], waves) & ~coarse)
    best = None
    for wave in waves:
        for line in contours(values, x, y, wave):
            away = float(np.hypot(*(line - at).T).min())
            if best is None or away < best[0]:
                best = away, wave, line
    return None if best is None or len(best[2]) < 2 else best[1:]


def _passed(values: np.ndarray, waves: set[int]) -> np.ndarray:
    """Samples (SIDE, SIDE) of coarse cells in which one of the crests may run, and of those round them.

    A cell at the edge of where there are waves counts as one.
    """
    known = np.isfinite(values)
    low, high = (
        reduce(least, (part[:-1, :-1], part[:-1, 1:], part[1:, :-1], part[1:, 1:]))
        for part, least in (
            (np.where(known, values, np.inf), np.minimum),
            (np.where(known, values, -np.inf), np.maximum),
        )
    )
    count = known.astype(np.int8)
    count = count[:-1] + count[1:]
    count = count[:, :-1] + count[:, 1:]
    crossed = (count > 0) & (count < 4)
    for wave in waves:
        crossed |= (low <= wave) & (high >= wave)
    cells = ndimage.binary_dilation(crossed, np.ones((3, 3), bool))
    fine = np.zeros((SIDE, SIDE), bool)
    fine[:-1, :-1] = np.kron(cells, np.ones((COARSE, COARSE), bool))
    fine[1:] |= fine[:-1]
    fine[:, 1:] |= fine[:, :-1]
    return fine


def contours(values: np.ndarray, x: np.ndarray, y: np.ndarray, level: float) -> list[np.ndarray]:
    """Lines where a sampled map crosses a value; cells with NaN have none. Two triangles a cell: never ambiguous."""
    off = values - level
    off = np.where(off == 0, 1e-12, off)
    pieces: dict[tuple, list] = {}
    rows, cols = off.shape
    for corners in (((0, 0), (0, 1), (1, 1)), ((0, 0), (1, 1), (1, 0))):
        at = [off[r : rows - 1 + r, c : cols - 1 + c] for r, c in corners]
        up = [part > 0 for part in at]
        mixed = np.isfinite(sum(at)) & ~((up[0] == up[1]) & (up[1] == up[2]))
        for row, col in np.argwhere(mixed):
            ends = []
            for i, j in ((0, 1), (1, 2), (0, 2)):
                if up[i][row, col] != up[j][row, col]:
                    ends.append(tuple(sorted((row + r, col + c) for r, c in (corners[i], corners[j]))))
            for one, other in (ends, ends[::-1]):
                pieces.setdefault(one, []).append(other)
    return [_placed(chain, off, x, y) for chain in _chains(pieces)]


def _chains(pieces: dict) -> list[list]:
    left, chains = dict(pieces), []
    while left:
        start = next((edge for edge, others in left.items() if len(others) == 1), next(iter(left)))
        chain, edge = [start], start
        seen = {start}
        while True:
            onward = next((other for other in left[edge] if other not in seen), None)
            if onward is None:
                break
            chain.append(onward)
            seen.add(onward)
            edge = onward
        for edge in chain:
            del left[edge]
        chains.append(chain)
    return chains


def _placed(chain: list, off: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """World points of edges of the grid where its values change sign."""
    (r0, c0), (r1, c1) = np.array(chain).transpose(1, 2, 0)
    part = off[r0, c0] / (off[r0, c0] - off[r1, c1])
    return np.stack([x[c0] + (x[c1] - x[c0]) * part, y[r0] + (y[r1] - y[r0]) * part], axis=1)


def dragged(line: np.ndarray, at: tuple[float, float], by: tuple[float, float], radius_m: float) -> np.ndarray:
    """The line with its part about `at` moved `by` (m), less and less along it, not at all from 0.7 radii on.

    The farther it goes, the more it is smoothed: teeth that a reef gives a crest would cross each other on the way.
    """
    spacing_m = max(_lengths(line)[-1] / max(len(line) - 1, 1), 1e-6)
    line = resampled(line, spacing_m)
    length = _lengths(line)
    along = np.abs(length - length[np.hypot(*(line - at).T).argmin()])
    held = (np.clip(1 - (along / (0.7 * radius_m)) ** 2, 0, 1) ** 2)[:, None]
    sigma = min(0.4 * float(np.hypot(*by)), 0.15 * radius_m) / spacing_m
    smooth = ndimage.gaussian_filter1d(line, sigma, axis=0, mode="nearest") if sigma > 0.3 else line
    moved = line + np.minimum(4 * held, 1) * (smooth - line) + held * np.asarray(by, np.float64)
    return moved[_run(along <= 0.75 * radius_m)]


def _run(wanted: np.ndarray) -> slice:
    found = np.flatnonzero(wanted)
    return slice(found[0], found[-1] + 1)


def resampled(line: np.ndarray, spacing_m: float, most: int = 10_000) -> np.ndarray:
    """Points at even lengths along a line, both ends among them."""
    length = _lengths(line)
    count = int(np.clip(np.ceil(length[-1] / spacing_m), 2, most)) + 1
    at = np.linspace(0, length[-1], count)
    return np.stack([np.interp(at, length, line[:, i]) for i in (0, 1)], axis=1)


def middle(line: np.ndarray) -> tuple[float, float]:
    """The point halfway along a line."""
    x, y = resampled(line, 1.0, 2)[1]
    return float(x), float(y)


def crosses_itself(line: np.ndarray) -> bool:
    """Whether two pieces of a line that are no neighbours meet."""
    a, b = line[:-1], line[1:]
    way = b - a

    def side(p: np.ndarray) -> np.ndarray:
        off = p[None] - a[:, None]
        return way[:, None, 0] * off[..., 1] - way[:, None, 1] * off[..., 0]

    parts = side(a) * side(b) < 0
    apart = np.abs(np.subtract.outer(np.arange(len(a)), np.arange(len(a)))) > 1
    return bool((parts & parts.T & apart).any())


def _lengths(line: np.ndarray) -> np.ndarray:
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
