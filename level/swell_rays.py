"""The ways a swell's energy takes over a grid, from its travel time: who hands how much to whom, and in what order.

Through the face between two cells goes energy flux times `n`, the part of the wave's direction through that face, from
the earlier cell to the later: div(F n) = 0, upwind, without a matrix. Cells are taken in generations: each has all that
flows into it done before.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .travel_time import TravelTime


@dataclass(frozen=True)
class Rays:
    """All maps flat, of the turned frame and a cell more all round; `share[d]`: what comes from cell + `steps[d]`."""

    shape: tuple[int, int]  # of the padded grid
    steps: tuple[int, int, int, int]
    share: np.ndarray  # float64 (4, cells): n of the face towards that neighbour, 0 where nothing comes from it
    delay_s: np.ndarray  # float64 (4, cells): how much later than that neighbour
    leaves: np.ndarray  # float64: sum of n over the faces that energy leaves by
    slowness: np.ndarray  # float64: |grad T|, s/m
    direction: tuple[np.ndarray, np.ndarray]  # unit vector in the turned frame: along columns, along rows
    water: np.ndarray  # bool: cells that the swell reaches
    entry: np.ndarray  # float64: energy flux by the reference's on the cells outside that it comes from, else 0

    def generations(self) -> Iterator[np.ndarray]:
        """Indices of cells, each cell once, after all that flows into it."""
        waits = ((self.share > 0) & self._inner()).sum(axis=0).astype(np.int8)
        stamp = np.zeros(self.water.size, np.int64)
        now = np.flatnonzero(self.water & (waits == 0))
        while now.size:
            yield now
            after = []
            for d, step in enumerate(self.steps):
                below = now - step  # those that `now` is the neighbour d of
                below = below[self.share[d, below] > 0]
                waits[below] -= 1
                after.append(below)
            now = np.concatenate(after)
            now = now[waits[now] == 0]
            stamp[now] = np.arange(now.size)
            now = now[stamp[now] == np.arange(now.size)]

    def _inner(self) -> np.ndarray:
        """Bool (4, cells): the neighbour is a cell of the level, not one outside."""
        return np.stack([np.roll(self.water, -step) for step in self.steps])


def rays_of(found: TravelTime) -> Rays:
    """Rays of a solved swell that does come in (`found.border` is not None)."""
    border, cell_m = found.border, found.cell_m
    omega = 2 * np.pi / found.period_s
    water = np.pad(border.turn.into(found.reached), 1)
    seconds = np.pad(border.turn.into(found.seconds).astype(np.float64), 1)
    k = border.turn.into(found.wavenumber).astype(np.float64)
    entry = _entry(seconds, water, k, border, cell_m, omega)
    known = water | (entry > 0)
    steps = (-1, 1, -seconds.shape[1], seconds.shape[1])
    time, flat_known, flat_water = seconds.ravel(), known.ravel(), water.ravel()
    later = np.stack([time - np.roll(time, -step) for step in steps])
    from_known = np.stack([np.roll(flat_known, -step) for step in steps]) & flat_water
    later = np.where(from_known, later, 0.0)
    comes = np.maximum(later, 0.0) / cell_m
    west, east, south, north = comes
    slope_x, slope_y = np.where(west >= east, west, -east), np.where(south >= north, south, -north)
    slowness = np.hypot(slope_x, slope_y)
    slowness[slowness == 0] = 1.0
    share = comes / slowness
    return Rays(
        seconds.shape,
        steps,
        share,
        later,
        _leaving(share, steps, flat_water, _edge(seconds.shape)),
        slowness,
        (slope_x / slowness, slope_y / slowness),
        flat_water,
        entry.ravel(),
    )


def _entry(seconds, water, k, border, cell_m: float, omega: float) -> np.ndarray:
    """Sets T on the cells outside that the swell comes from; returns its energy flux there, by the reference's."""
    entry = np.zeros(seconds.shape)
    along = border.k * border.along
    across = np.sqrt(np.maximum(k[0] ** 2 - along**2, (0.1 * k[0]) ** 2))
    seconds[0, 1:-1] = seconds[1, 1:-1] - across * cell_m / omega
    entry[0, 1:-1] = water[1, 1:-1]
    if along > 0:
        # Straight contours outside: the flux through each of them is the same (Snell), whatever its direction.
        inward = water[1:-1, 1] & (~water[1:-1, 2] | (seconds[1:-1, 2] > seconds[1:-1, 1]))
        seconds[1:-1, 0] = seconds[1:-1, 1] - along * cell_m / omega
        cosine = np.sqrt(np.maximum(1 - (along / k[:, 0]) ** 2, 0.01))
        entry[1:-1, 0] = np.where(inward, border.across / cosine, 0.0)
    return entry


def _leaving(share, steps, water, edge) -> np.ndarray:
    """Sum of n of the faces that energy leaves by; it goes straight on through the level's edge and onto the beach."""
    leaves = np.zeros(water.shape)
    for d, step in enumerate(steps):
        against = d ^ 1
        there = np.roll(water, -step)
        through = np.roll(share[against], -step)  # what the neighbour takes from here
        on = share[against]  # what comes in by the opposite face
        leaves += np.where(there, through, on)
        # From outside the level along its edge nothing is known: as much as leaves opposite, so it stays as bright.
        opposite = np.roll(share[d], step)
        leaves -= np.where(np.roll(edge, -step) & (share[d] == 0) & np.roll(water, step), opposite, 0.0)
    return np.where(water, leaves, 1.0)


def _edge(shape: tuple[int, int]) -> np.ndarray:
    """Bool, flat: the cells outside the level."""
    edge = np.zeros(shape, bool)
    edge[0], edge[-1], edge[:, 0], edge[:, -1] = True, True, True, True
    return edge.ravel()
