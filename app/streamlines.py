"""Streamlines of the whole current, evenly spread over the water (T02): traced by pyvista, which loads with them alone.

lines = streamlines(level)               # waits for them
shown = StreamlineView().lines(level)    # in a thread, those from before till then
"""

from __future__ import annotations

import threading

import numpy as np

from ..level import Level
from ..level.flow import Current, current
from ..level.flow_arrows import on_water, still_over_sea, with_heads
from ..renderer.show import Streamlines

LEAST_MPS = 0.01  # slower water is still
LONGEST = 40.0  # of a line, in their distance
LEAST_CELLS = 3
CLOSE = 0.8  # of their distance, that two may come to
POINTS = 6  # of a line along their distance
LEAST_POINTS = 10
HEAD = 0.35  # of their distance
BETWEEN_HEADS = 8  # of it


def streamlines(level: Level) -> Streamlines:
    """Those of a level as it is now."""
    return _over(level, traced(current(level), level.settings.flow.streamlines))


class StreamlineView:
    """Streamlines for a window: traced in a thread whenever the current is another one; nothing runs unless asked."""

    def __init__(self) -> None:
        self._of: tuple[Current, int] | None = None
        self._shown: Streamlines | None = None
        self._thread: threading.Thread | None = None
        self._made: list[np.ndarray] | None = None

    @property
    def busy(self) -> bool:
        """Whether lines are on their way."""
        return self._thread is not None and self._thread.is_alive()

    def lines(self, level: Level) -> Streamlines | None:
        """The newest that are done."""
        if self._thread is not None and not self._thread.is_alive():
            self._thread = None
            self._shown = None if self._made is None else _over(level, self._made)
        water, across = current(level), level.settings.flow.streamlines
        if not (self._of and self._of[0] is water and self._of[1] == across) and self._thread is None:
            self._of, self._made = (water, across), None
            self._thread = threading.Thread(target=self._trace, args=self._of, name="streamlines", daemon=True)
            self._thread.start()
        return self._shown

    def _trace(self, water: Current, across: int) -> None:
        self._made = traced(water, across)


def _over(level: Level, lines: list[np.ndarray]) -> Streamlines:
    if not lines:
        return Streamlines(())
    ends = np.cumsum([len(line) for line in lines])[:-1]
    points = np.concatenate(lines)
    over = still_over_sea(level, points[:, 0], points[:, 1])
    return Streamlines(tuple(np.split(np.insert(points, 2, over, axis=1), ends)))


def traced(water: Current, across: int) -> list[np.ndarray]:
    """Lines `(n, 3)` of x, y, m/s, the way the water runs, heads along it: from few seeds first, then into the gaps.

    `across` lie beside each other along the longer side, or as many as cells leave room for.
    """
    rows, cols = water.packed.shape[:2]
    apart_m = max(max(rows, cols) * water.cell_m / across, LEAST_CELLS * water.cell_m)
    taken: set[tuple[int, int]] = set()
    kept: list[np.ndarray] = []
    for every_m in (4 * apart_m, 2 * apart_m, apart_m):
        seeds = _seeds(water, every_m, taken, apart_m)
        if len(seeds):
            kept += _spread(_traced(water, seeds, LONGEST * apart_m), water, taken, apart_m)
    return [with_heads(line, water, HEAD * apart_m, BETWEEN_HEADS * POINTS) for line in kept]


def _traced(water: Current, seeds: np.ndarray, longest_m: float) -> list[np.ndarray]:
    """The line `(n, 2)` through each seed, the way the water runs."""
    import pyvista

    rows, cols = water.packed.shape[:2]
    image = pyvista.ImageData(dimensions=(cols, rows, 1), spacing=(water.cell_m, water.cell_m, 1.0))
    image.point_data["flow"] = np.pad(water.packed[..., :2], ((0, 0), (0, 0), (0, 1))).reshape(-1, 3)
    found = image.streamlines_from_source(
        pyvista.PolyData(np.pad(seeds, ((0, 0), (0, 1)))), vectors="flow", integration_direction="both",
        initial_step_length=1.0, terminal_speed=LEAST_MPS, max_length=longest_m, max_steps=2000,
        compute_vorticity=False,
    )  # fmt: skip
    points, halves = np.asarray(found.points)[:, :2].astype(np.float64), {}
    for cell, seed in zip(_cells(found.lines), found.cell_data["SeedIds"], strict=True):
        halves.setdefault(int(seed), []).append(_downstream(water, points[cell]))
    return [_joined(parts) for parts in halves.values()]


def _downstream(water: Current, line: np.ndarray) -> np.ndarray:
    """A line turned so that it runs with the water: VTK traces the way back from the seed."""
    mid, way = 0.5 * (line[1:] + line[:-1]), np.diff(line, axis=0)
    east, north = water.at(mid[:, 0], mid[:, 1])
    return line if (way[:, 0] * east + way[:, 1] * north).sum() >= 0 else line[::-1]


def _joined(parts: list[np.ndarray]) -> np.ndarray:
    """The way to a seed and the way from it, as one."""
    if len(parts) == 1:
        return parts[0]
    a, b = parts
    a, b = (a, b) if np.hypot(*(a[-1] - b[0])) <= np.hypot(*(b[-1] - a[0])) else (b, a)
    return np.concatenate([a, b[1:]])


def _seeds(water: Current, every_m: float, taken: set, apart_m: float) -> np.ndarray:
    """Places `(n, 2)` on a lattice where water moves and no line runs yet."""
    high, wide = ((n - 1) * water.cell_m for n in water.packed.shape[:2])
    at = np.meshgrid(*(np.arange(0.5 * every_m, side, every_m) for side in (wide, high)))
    places = np.stack([part.ravel() for part in at], -1)
    free = np.array([cell not in taken for cell in _squares(places, apart_m)], bool)
    return places[free & _moves(water, places)]


def _squares(places: np.ndarray, apart_m: float) -> list[tuple[int, int]]:
    """In which square of a line's own each place lies."""
    return [tuple(square) for square in np.floor(places / (CLOSE * apart_m)).astype(int).tolist()]


def _moves(water: Current, places: np.ndarray) -> np.ndarray:
    """Whether places lie on water that moves."""
    x, y = places.T
    return (np.hypot(*water.at(x, y)) > LEAST_MPS) & on_water(water, x, y)


def _cells(lines: np.ndarray) -> list[np.ndarray]:
    """Point numbers of each line, from VTK's list of counts and numbers."""
    found, at = [], 0
    while at < len(lines):
        count = int(lines[at])
        found.append(lines[at + 1 : at + 1 + count])
        at += 1 + count
    return found


def _spread(lines: list[np.ndarray], water: Current, taken: set, apart_m: float) -> list[np.ndarray]:
    """The longest first, of each its longest part that stays out of squares that are taken; takes its own."""
    kept = []
    for whole in sorted(lines, key=_length, reverse=True):
        line = _even(whole, apart_m / POINTS)
        squares = _squares(line, apart_m)
        free = _moves(water, line) & np.array([square not in taken for square in squares])
        start, stop = _longest_run(free)
        if stop - start >= LEAST_POINTS:
            kept.append(line[start:stop])
            taken.update(squares[start:stop])
    return kept


def _length(line: np.ndarray) -> float:
    return float(np.hypot(*np.diff(line, axis=0).T).sum())


def _even(line: np.ndarray, step_m: float) -> np.ndarray:
    """A line's points a step apart."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    at = np.arange(0.0, along[-1] + 1e-9, step_m)
    return np.stack([np.interp(at, along, line[:, axis]) for axis in (0, 1)], -1)


def _longest_run(free: np.ndarray) -> tuple[int, int]:
    """Start and stop of the longest run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], free.astype(np.int8), [0]])))
    runs = edges.reshape(-1, 2)
    return tuple(runs[np.argmax(runs[:, 1] - runs[:, 0])].tolist()) if len(runs) else (0, 0)
