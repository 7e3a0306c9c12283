"""The bottleneck depth: over all ways from the sea to a cell, the largest least depth; and one that falls on flats.

A front passes a bar once because behind it this never grows again: the grey-scale reconstruction of the depth from
cells where the sea begins, by sweeps in four directions (L. Vincent 1993, sequential reconstruction). Where it is flat
a front would be everywhere at once: `falling` is the same with a toll for every metre of way (as in image processing
the reconstruction by a sloped structuring function), so that the front crosses flats at a speed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .beat import beat

ROUNDS = 60  # of four sweeps; two or three are enough for coasts, a maze of walls is cut short here
KEPT = 0.25  # share of the bottleneck depth that no toll takes: waves break near the beach still
SPREAD_M = 50.0  # way over which the rest is used up
FULL_S = 0.5  # where along the range the toll is whole; at the outer edge it is 0
SETTLED_M = 1e-4
NOWHERE_M = -1e9  # finite, for differences


@dataclass(frozen=True)
class Toll:
    """How much depth a metre of way costs at most, in water shallower than `range_m`."""

    slope: float
    range_m: float

    def taken(self, came: np.ndarray, kept: np.ndarray, way_m: float) -> np.ndarray:
        """What is left of the depth `came` after so much way; never below `kept`, where it was above it."""
        fall = np.minimum((came - kept) * (1 / SPREAD_M), self.slope)
        np.minimum(fall, (self.range_m - came) * (self.slope / (FULL_S * self.range_m)), out=fall)
        np.maximum(fall, 0.0, out=fall)
        fall *= -way_m
        fall += came
        return fall


def bottleneck(marker: np.ndarray, depth: np.ndarray, rounds: int = ROUNDS) -> np.ndarray:
    """Reconstruction of `depth` from `marker`, float32 `(rows, cols)`; -inf where no way leads."""
    least, floor = _framed(np.minimum(marker, depth)), _framed(depth)
    floor_turned = np.ascontiguousarray(floor.T)
    for _ in range(rounds):
        _sweep(least, floor)
        turned = np.ascontiguousarray(least.T)  # rows that lie together in memory sweep three times as fast
        _sweep(turned, floor_turned)
        least[:] = turned.T
        if not _rises(least, floor):
            break
    return least[1:-1, 1:-1].copy()


def falling(marker: np.ndarray, least: np.ndarray, cell_m: float, toll: Toll) -> np.ndarray:
    """The bottleneck depth `least` less the toll on the way from `marker`; the same on land, above 0 in all water."""
    here, floor = (np.maximum(_framed(values), np.float32(NOWHERE_M)) for values in (np.minimum(marker, least), least))
    floor_turned = np.ascontiguousarray(floor.T)
    for _ in range(ROUNDS):
        before = here.copy()
        _sweep_tolled(here, floor, cell_m, toll)
        turned = np.ascontiguousarray(here.T)
        _sweep_tolled(turned, floor_turned, cell_m, toll)
        here[:] = turned.T
        if (here - before).max() < SETTLED_M:
            break
    return np.where(least > 0, here[1:-1, 1:-1], least)


def _framed(values: np.ndarray) -> np.ndarray:
    """The values with a border of one cell that leads nowhere."""
    framed = np.full((values.shape[0] + 2, values.shape[1] + 2), -np.inf, np.float32)
    framed[1:-1, 1:-1] = values
    return framed


def _sweep(least: np.ndarray, floor: np.ndarray) -> None:
    """Carry depths from row to row, down and up again, in place."""
    west, here, east = list(least[:, :-2]), list(least[:, 1:-1]), list(least[:, 2:])
    floor = list(floor[:, 1:-1])
    came = np.zeros_like(here[0])
    maximum, minimum, last = np.maximum, np.minimum, len(here) - 1
    for rows in (range(1, last), range(last - 1, 0, -1)):
        beat()
        before = rows.start - rows.step
        for row in rows:
            maximum(west[before], east[before], out=came)
            maximum(came, here[before], out=came)
            maximum(came, here[row], out=came)
            minimum(came, floor[row], out=here[row])
            before = row


def _sweep_tolled(here: np.ndarray, floor: np.ndarray, cell_m: float, toll: Toll) -> None:
    kept, across_m = floor * np.float32(KEPT), cell_m * 2**0.5
    for rows in (range(1, len(here) - 1), range(len(here) - 2, 0, -1)):
        before = rows.start - rows.step
        for row in rows:
            came, stays = here[before], kept[row, 1:-1]
            straight = toll.taken(came[1:-1], stays, cell_m)
            across = toll.taken(np.maximum(came[:-2], came[2:]), stays, across_m)
            np.maximum(straight, across, out=straight)
            np.maximum(straight, here[row, 1:-1], out=straight)
            np.minimum(straight, floor[row, 1:-1], out=here[row, 1:-1])
            before = row


def _rises(least: np.ndarray, floor: np.ndarray) -> bool:
    """Whether some cell could still be reached by a deeper way."""
    came = np.maximum(np.maximum(least[:-2], least[2:]), least[1:-1])
    came = np.maximum(np.maximum(came[:, :-2], came[:, 2:]), came[:, 1:-1])
    return bool((np.minimum(came, floor[1:-1, 1:-1]) > least[1:-1, 1:-1]).any())
