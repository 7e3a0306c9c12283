"""Streamlines of the whole current, evenly spread over the water (T02): traced by pyvista, which loads with them alone.

lines = streamlines(level)               # waits for them
shown = StreamlineView().lines(level)    # in a thread, those from before till then
"""

from __future__ import annotations

import threading

import numpy as np

from ..level import Level
from ..level.flow import Current, current
from ..level.flow_arrows import on_water, still_over_sea, with_head
from ..renderer.show import Streamlines

ACROSS = 56  # lines that lie beside each other along a level's longer side
LEAST_MPS = 0.01  # slower water is still
LONGEST = 40.0  # of a line, in their distance
POINTS = 6  # of a line along their distance
HEAD = 0.35  # of their distance


def streamlines(level: Level) -> Streamlines:
    """Those of a level as it is now."""
    return _over(level, traced(current(level)))


class StreamlineView:
    """Streamlines for a window: traced in a thread whenever the current is another one; nothing runs unless asked."""

    def __init__(self) -> None:
        self._of: Current | None = None
        self._shown: Streamlines | None = None
        self._thread: threading.Thread | None = None
        self._made: list[np.ndarray] | None = None

    @property
    def busy(self) -> bool:
        """Whether lines are on their way."""
        return self._thread is not None

    def lines(self, level: Level) -> Streamlines | None:
        """The newest that are done."""
        if self._thread is not None and not self._thread.is_alive():
            self._thread = None
            self._shown = None if self._made is None else _over(level, self._made)
        water = current(level)
        if self._of is not water and self._thread is None:
            self._of, self._made = water, None
            self._thread = threading.Thread(target=self._trace, args=(water,), name="streamlines", daemon=True)
            self._thread.start()
        return self._shown

    def _trace(self, water: Current) -> None:
        self._made = traced(water)


def _over(level: Level, lines: list[np.ndarray]) -> Streamlines:
    if not lines:
        return Streamlines(())
    ends = np.cumsum([len(line) for line in lines])[:-1]
    points = np.concatenate(lines)
    over = still_over_sea(level, points[:, 0], points[:, 1])
    return Streamlines(tuple(np.split(np.insert(points, 2, over, axis=1), ends)))


def traced(water: Current) -> list[np.ndarray]:
    """Lines `(n, 3)` of x, y, m/s, the way the water runs, then its head."""
    import pyvista

    rows, cols = water.packed.shape[:2]
    apart_m = max(max(rows, cols) * water.cell_m / ACROSS, 2 * water.cell_m)
    seeds = _seeds(water, apart_m)
    if not len(seeds):
        return []
    image = pyvista.ImageData(dimensions=(cols, rows, 1), spacing=(water.cell_m, water.cell_m, 1.0))
    image.point_data["flow"] = np.pad(water.packed[..., :2], ((0, 0), (0, 0), (0, 1))).reshape(-1, 3)
    found = image.streamlines_from_source(
        pyvista.PolyData(np.pad(seeds, ((0, 0), (0, 1)))), vectors="flow", integration_direction="both",
        initial_step_length=1.0, terminal_speed=LEAST_MPS, max_length=LONGEST * apart_m, max_steps=4000,
        compute_vorticity=False,
    )  # fmt: skip
    whole = [np.asarray(found.points)[line, :2] for line in _cells(found.lines)]
    return [with_head(part, water, HEAD * apart_m) for part in _spread(whole, water, apart_m)]


def _seeds(water: Current, apart_m: float) -> np.ndarray:
    """Places `(n, 2)` on a lattice where water moves."""
    high, wide = ((n - 1) * water.cell_m for n in water.packed.shape[:2])
    at = np.meshgrid(*(np.arange(0.5 * apart_m, side, 0.5 * apart_m) for side in (wide, high)))
    places = np.stack([part.ravel() for part in at], -1)
    return places[_moves(water, places)]


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


def _spread(lines: list[np.ndarray], water: Current, apart_m: float) -> list[np.ndarray]:
    """The longest first, of each its longest part that stays away from those before."""
    taken: set[tuple[int, int]] = set()
    kept = []
    for whole in sorted(lines, key=_length, reverse=True):
        line = _even(whole, apart_m / POINTS)
        cells = [tuple(cell) for cell in np.floor(line / (0.8 * apart_m)).astype(int).tolist()]
        free = _moves(water, line) & np.array([cell not in taken for cell in cells])
        start, stop = _longest_run(free)
        if (stop - start) < POINTS:
            continue
        kept.append(line[start:stop])
        taken.update(cells[start:stop])
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
