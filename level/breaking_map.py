"""How the leading swell breaks on its way, as a block of the arrival map (D34): smooth, for lips follow from it.

Time runs on through the break: it is counted back from there before, and on from there behind. Where broken water comes
to rest and the next bar is ahead the two don't meet; there breaking shows nothing, and the count may jump.
"""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from .before_breaking import AHEAD_S
from .wave_heights import WaveHeights

SMOOTH_M = 2.5  # sigma along a crest and across
UNSEEN_S, SEEN_S = 10.5, 7.0  # before it breaks a wave begins to show that, and does whole
AT_REST, AT_WORK = 0.1, 0.6  # of its water broken: it shows nothing of that any more, and all
CROSSING_M = 5.0  # to either side of a line where two fronts come together
LEAST_SHOWN = 1e-4


def breaking_block(
    heights: WaveHeights, reached: np.ndarray, cell_m: float, meets: np.ndarray | None = None
) -> np.ndarray:
    """`(rows, cols, 4)` float32: seconds since the break, how far it shows 0 … 1, surf similarity, run-up in metres.

    Where fronts come together (`meets` 0 … 1) no lip is thrown: two would go through each other.
    """
    broken = heights.broken > 0
    since_s = np.where(broken, heights.since_break_s, -heights.to_break_s)
    coming = 1.0 - _step(SEEN_S, UNSEEN_S, heights.to_break_s)
    shows = np.where(broken, _step(AT_REST, AT_WORK, heights.broken), coming) * reached
    if meets is not None:
        shows = shows * (1.0 - ndimage.maximum_filter(meets, 2 * round(CROSSING_M / cell_m) + 1))
    similarity = np.where(broken, heights.similarity, heights.next_similarity)
    # on land as at the water's edge near by: what is smoothed there must not know of nothing
    known = reached & (shows > LEAST_SHOWN)
    if not known.any():
        return _none(heights.runup_m)
    row, col = ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)
    sigma = max(SMOOTH_M / cell_m, 1.0)
    share = np.maximum(np.where(reached, shows, shows[row, col]), LEAST_SHOWN)
    weight = _smooth(share, sigma)
    since_s, similarity = (_smooth(part[row, col] * share, sigma) / weight for part in (since_s, similarity))
    return np.stack([since_s, weight, similarity, _smooth(heights.runup_m, sigma)], -1).astype(np.float32)


def _none(runup_m: np.ndarray) -> np.ndarray:
    block = np.zeros((*runup_m.shape, 4), np.float32)
    block[..., 0], block[..., 3] = -AHEAD_S, runup_m
    return block


def _smooth(values: np.ndarray, sigma: float) -> np.ndarray:
    return ndimage.gaussian_filter(values.astype(np.float64), sigma, mode="nearest", truncate=3)


def _step(low: float, high: float, x: np.ndarray) -> np.ndarray:
    part = np.clip((x - low) / (high - low), 0, 1)
    return part * part * (3 - 2 * part)
