"""The mean of a cell's neighbours as a cascade of [1 2 1] / 4 with halving steps, in rows and then in columns."""

from __future__ import annotations

import math

import numpy as np


def cascade(reach: float, side: int) -> list[int]:
    """Steps of the cascade for a reach in cells, each at most twice the next, the last 1; narrower on a small level."""
    step = max(1, min(round(reach), (side - 1) // 4))
    steps = [step]
    while step > 1:
        step = math.ceil(step / 2)
        steps.append(step)
    return steps


def mean_minus(window: np.ndarray, steps: list[int]) -> np.ndarray:
    """Weighted mean of the neighbours minus the sample; `window` has a border of sum(steps) more than the result.

    Samples are taken relative to the middle one: on high ground float32 would otherwise lose the small shapes.
    """
    border = sum(steps)
    window -= window[window.shape[0] // 2, window.shape[1] // 2]
    mean = window
    for step in steps:
        mean = _tap(mean[: -2 * step], mean[step:-step], mean[2 * step :])
        mean = _tap(mean[:, : -2 * step], mean[:, step:-step], mean[:, 2 * step :])
    mean -= window[border:-border, border:-border]
    return mean


def _tap(before: np.ndarray, here: np.ndarray, after: np.ndarray) -> np.ndarray:
    """(before + 2 here + after) / 4, exact where the three are equal."""
    out = before + after
    out *= np.float32(0.5)
    out += here
    out *= np.float32(0.5)
    return out
