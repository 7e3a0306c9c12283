"""Quadratic B-splines over the texels of a map: values whose gradient does not jump from texel to texel."""

from __future__ import annotations

import numpy as np

from .dual import Dual


def spline_weights(t: np.ndarray) -> tuple[tuple, tuple]:
    """The quadratic B-spline's three weights at −½ … ½ about a texel, and their slopes."""
    return (0.5 * (0.5 - t) ** 2, 0.75 - t * t, 0.5 * (0.5 + t) ** 2), (t - 0.5, -2.0 * t, t + 0.5)


def second_order(values: np.ndarray, cell_m: float, x, y) -> tuple[Dual, Dual]:
    """Gradient of a map `(rows, cols)` at world points by a quadratic B-spline: east and north with their gradients."""
    rows, cols = values.shape
    u, v = np.asarray(x) / cell_m, np.asarray(y) / cell_m
    ui, vi = np.clip(u, 0, cols - 1), np.clip(v, 0, rows - 1)
    col = np.clip(np.floor(ui + 0.5), 1, cols - 2).astype(np.int64)
    row = np.clip(np.floor(vi + 0.5), 1, rows - 2).astype(np.int64)
    (wx, sx), (wy, sy) = spline_weights(ui - col), spline_weights(vi - row)
    bend, (dx, dy, dxx, dxy, dyy) = (1.0, -2.0, 1.0), np.zeros((5, *np.shape(u)))
    for r in range(3):
        for c in range(3):
            here = values[row + r - 1, col + c - 1].astype(np.float64)
            dx, dy = dx + here * sx[c] * wy[r], dy + here * wx[c] * sy[r]
            dxx, dxy, dyy = dxx + here * bend[c] * wy[r], dxy + here * sx[c] * sy[r], dyy + here * wx[c] * bend[r]
    in_x, in_y, square = u == ui, v == vi, cell_m * cell_m
    dxy = dxy * in_x * in_y / square
    return Dual(dx * in_x / cell_m, dxx * in_x / square, dxy), Dual(dy * in_y / cell_m, dxy, dyy * in_y / square)
