"""Numbers that carry their gradient, so that normals follow from the same lines as heights (H29).

`Dual(v, dx, dy)` is a value and its derivative along world x and y. GLSL writes the same thing as a vec3 (value, d/dx,
d/dy) with `d_mul` and `d_step` in `shaders/dual.glsl`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass
class Dual:
    """A value with its gradient; arrays of one shape, or scalars."""

    v: np.ndarray | float
    dx: np.ndarray | float = 0.0
    dy: np.ndarray | float = 0.0

    def __add__(self, other):
        if isinstance(other, Dual):
            return Dual(self.v + other.v, self.dx + other.dx, self.dy + other.dy)
        return Dual(self.v + other, self.dx, self.dy)

    def __sub__(self, other):
        return self + other * -1.0 if isinstance(other, Dual) else self + -other

    def __mul__(self, other):
        if isinstance(other, Dual):
            return Dual(self.v * other.v, self.v * other.dx + other.v * self.dx, self.v * other.dy + other.v * self.dy)
        return Dual(self.v * other, self.dx * other, self.dy * other)

    __radd__ = __add__
    __rmul__ = __mul__

    def __rsub__(self, other):
        return self * -1.0 + other


def step(low: float, high: float, x: Dual) -> Dual:
    """Smoothstep from `low` to `high` with its gradient."""
    u = np.clip((x.v - low) / (high - low), 0.0, 1.0)
    slope = 6.0 * u * (1.0 - u) / (high - low)
    return Dual(u * u * (3.0 - 2.0 * u), slope * x.dx, slope * x.dy)


def positive(x: Dual) -> Dual:
    """max(x, 0)."""
    keep = x.v > 0
    return Dual(np.where(keep, x.v, 0.0), np.where(keep, x.dx, 0.0), np.where(keep, x.dy, 0.0))


def at_most(most: float, x: Dual) -> Dual:
    """min(x, most)."""
    keep = x.v < most
    return Dual(np.where(keep, x.v, most), np.where(keep, x.dx, 0.0), np.where(keep, x.dy, 0.0))
