"""When waves will break, where they haven't yet (D34): what is ahead of them on their way, carried back along the rays.

The march of `wave_heights` the other way round: what a cell hands on to its neighbours says how much of what they know
it takes over.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .swell_rays import Rays

AHEAD_S = 12.0  # longer before, nothing shows that a wave will break


@dataclass
class Ahead:
    """Of each cell of the padded grid, flat: seconds until a wave there breaks, AHEAD_S at most, and its surf
    similarity then, 0 where it doesn't."""

    seconds: np.ndarray
    similarity: np.ndarray


def ahead_of(rays: Rays, order: list[np.ndarray], starts, since_s, similarity) -> Ahead:
    """`order`: the generations from the sea; where `starts`, waves broke `since_s` before, with `similarity`."""
    ahead = Ahead(np.full(starts.size, AHEAD_S), np.zeros(starts.size))
    for cells in reversed(order):
        _carry_back(ahead, rays, cells, starts, since_s, similarity)
    return ahead


def _carry_back(ahead: Ahead, rays: Rays, cells: np.ndarray, starts, since_s, similarity) -> None:
    total, seconds, known, xi = np.zeros((4, cells.size))
    for d, step in enumerate(rays.steps):
        below = cells - step  # those that `cells` are the neighbours d of
        share, way_s = rays.share[d, below], rays.delay_s[d, below]
        breaks = starts[below]
        there = np.where(breaks, way_s - since_s[below], way_s + ahead.seconds[below])
        total += share
        seconds += share * np.clip(there, 0.0, AHEAD_S)
        its = np.where(breaks, similarity[below], ahead.similarity[below])
        knows = share * (its > 0)
        known += knows
        xi += knows * its
    goes = total > 0
    ahead.seconds[cells[goes]] = seconds[goes] / total[goes]
    ahead.similarity[cells] = xi / np.maximum(known, 1e-12)
