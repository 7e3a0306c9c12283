"""A smooth change over a disc: the thin plate, clamped at the rim, that meets what is asked of it (T07).

The unknowns are the coefficients of a cubic B-spline on a coarse grid, so what they say is C2 and exactly 0 beyond the
rim. Of all that meet the demands it takes the one with the least bending, ∫ (Δu)²: the biharmonic equation in between.
"""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

GIVE = 3e-4  # how far demands give way to the plate, against how soft it is: neighbours may ask for the impossible


class Plate:
    """`nodes` a side over the disc about `centre` (world m); factors are made once, for all demands of a drag.

    Coefficients are 0 near the rim, and within two nodes of the border of a level of `extent_m`.
    """

    def __init__(self, centre: tuple[float, float], radius_m: float, nodes: int, extent_m: tuple[float, float]) -> None:
        self.nodes, self.step_m = nodes, 2 * radius_m / (nodes - 5)
        half = (nodes - 1) / 2
        self.west_m, self.south_m = centre[0] - half * self.step_m, centre[1] - half * self.step_m
        along = (np.arange(nodes) - half) * self.step_m
        inside = np.hypot(along[None], along[:, None]) <= radius_m - 2.9 * self.step_m
        for axis, (at, side) in enumerate(zip(centre, extent_m, strict=True)):
            held = (along + at < 2.1 * self.step_m) | (along + at > side - 2.1 * self.step_m)
            inside &= ~(held[None] if axis == 0 else held[:, None])
        self.free = np.flatnonzero(inside)
        second = sparse.diags_array([1.0, -2.0, 1.0], offsets=[-1, 0, 1], shape=(nodes, nodes))
        one = sparse.eye_array(nodes)
        bend = (sparse.kron(one, second) + sparse.kron(second, one)).tocsc()[:, self.free]
        stiff = (bend.T @ bend) * (radius_m / self.step_m) ** 2
        self._factors = splu(stiff.tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})

    def rows(self, x: np.ndarray, y: np.ndarray) -> sparse.csr_array:
        """What the change at world points (n,) is of the free coefficients, `(n, free)`."""
        (at_x, by_x), (at_y, by_y) = self._weights(x, self.west_m), self._weights(y, self.south_m)
        node = at_y[:, :, None] * self.nodes + at_x[:, None, :]
        weight = by_y[:, :, None] * by_x[:, None, :]
        point = np.repeat(np.arange(len(x)), 16)
        shape = len(x), self.nodes**2
        return sparse.csr_array((weight.ravel(), (point, node.ravel())), shape=shape)[:, self.free]

    def meet(self, rows: sparse.csr_array, wanted: np.ndarray) -> np.ndarray:
        """Coefficients `(nodes, nodes)` of the least bent change with `rows @ free ≈ wanted`."""
        # a column at a time: many at once go through threaded BLAS, whose threads wait for each other ten times as long
        soft = np.stack([self._factors.solve(row) for row in rows.toarray()], axis=1)
        answers = rows @ soft
        give = GIVE * max(float(np.diag(answers).max(initial=0)), 1e-30)
        force = np.linalg.solve(answers + give * np.eye(len(wanted)), wanted)
        out = np.zeros(self.nodes**2)
        out[self.free] = np.einsum("ij,j->i", soft, force)
        return out.reshape(self.nodes, self.nodes)

    def raised(self, coefficients: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """The change on a grid of world columns `x` and rows `y`, `(len(y), len(x))`."""
        (at_x, by_x), (at_y, by_y) = self._weights(x, self.west_m), self._weights(y, self.south_m)
        lines = sum(by_y[:, n, None] * coefficients[at_y[:, n]] for n in range(4))
        return sum(by_x[:, n] * lines[:, at_x[:, n]] for n in range(4))

    def _weights(self, at: np.ndarray, first_m: float) -> tuple[np.ndarray, np.ndarray]:
        """The four nodes about each place and the weights of the cubic B-spline there; 0 off the grid."""
        u = (np.asarray(at, np.float64) - first_m) / self.step_m
        node = np.floor(u).astype(np.int64)
        f = u - node
        weight = np.stack(
            [(1 - f) ** 3, 3 * f**3 - 6 * f**2 + 4, -3 * f**3 + 3 * f**2 + 3 * f + 1, f**3], axis=-1
        ) / 6.0  # fmt: skip
        at_node = node[:, None] + np.arange(-1, 3)
        known = (at_node >= 0) & (at_node < self.nodes)
        return np.clip(at_node, 0, self.nodes - 1), np.where(known, weight, 0.0)
