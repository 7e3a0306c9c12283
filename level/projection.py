"""Currents made coherent: as much water leaves each cell as comes (T02).

A cell's divergence is what flows through its four faces over its area; through a face goes the mean of the two cells
beside it, through one to land nothing, through the border of the array the cell's own. Of all currents without
divergence `divergence_free` finds the one nearest to what is there: u − Dᵀλ with D Dᵀ λ = D u, where D is that very
divergence (projection of Chorin, 1968, on the discrete operator itself, so that nothing is left over).
"""

from __future__ import annotations

import numpy as np

ROUNDS = 20_000  # of the solver
ROUGH = 0.2  # what is left of a change that goes up and down from cell to cell
LEFT = 1e-6  # of the divergence that is let stand


def divergence(wet: np.ndarray, u: np.ndarray, v: np.ndarray, cell_m: float) -> np.ndarray:
    """1/s, float64 `(rows, cols)`, of a current (east `u`, north `v`) over cells that are `wet`; 0 on land."""
    east, north = _faces(wet, u), _faces(wet.T, v.T).T
    return np.where(wet, np.diff(east, axis=1) + np.diff(north, axis=0), 0.0) / cell_m


def _faces(wet: np.ndarray, u: np.ndarray) -> np.ndarray:
    """What goes through the faces between columns, `(rows, cols + 1)`."""
    u = np.where(wet, u, 0.0).astype(np.float64)
    inner = 0.5 * (u[:, 1:] + u[:, :-1]) * (wet[:, 1:] & wet[:, :-1])
    return np.concatenate([u[:, :1], inner, u[:, -1:]], axis=1)


def divergence_free(
    wet: np.ndarray, u: np.ndarray, v: np.ndarray, cell_m: float, inside: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """(u, v) in which cells that are wet and `inside` (all, when None) have no divergence and land has no current.

    Outside nothing changes. Arrays `(rows, cols)`; the answer has the type of `u`.
    """
    from scipy import sparse

    free = np.ones(wet.shape, bool) if inside is None else inside
    out = [np.where(free & ~wet, 0, part).astype(np.float64) for part in (u, v)]
    free = free & wet
    if free.any():
        number = np.full(wet.shape, -1)
        number[free] = np.arange(int(free.sum()))
        even = (_even(wet, number) @ _even(wet.T, number.T)).T
        apart = sparse.hstack([_operator(wet, number) @ even, _operator(wet.T, number.T) @ even]).tocsr()
        asked = divergence(wet, *out, cell_m)[free] * cell_m
        change = apart.T @ _solved((apart @ apart.T).tocsr(), asked)
        half = len(change) // 2
        change = np.concatenate([even @ change[:half], even @ change[half:]])
        out[0][free] -= change[:half]
        out[1][free] -= change[half:]
    return out[0].astype(u.dtype), out[1].astype(v.dtype)


def _operator(wet: np.ndarray, number: np.ndarray):
    """Divergence times cell by the free cells' currents along the columns, as a sparse matrix."""
    from scipy import sparse

    free = number >= 0
    count = int(free.sum())
    joined = wet[:, 1:] & wet[:, :-1]
    edge = np.ones((wet.shape[0], 1), bool)
    own = np.zeros(wet.shape)  # of the cell's own current: what its east face takes less what its west face brings
    own += 0.5 * np.pad(joined, ((0, 0), (0, 1))) - 0.5 * np.pad(joined, ((0, 0), (1, 0)))
    own[:, -1:] += edge
    own[:, :1] -= edge
    rows, cols, parts = [number[free]], [number[free]], [own[free]]
    west, east = number[:, :-1], number[:, 1:]
    both = joined & (west >= 0) & (east >= 0)
    for here, there, part in ((west, east, 0.5), (east, west, -0.5)):
        rows.append(here[both])
        cols.append(there[both])
        parts.append(np.full(int(both.sum()), part))
    return sparse.csr_matrix((np.concatenate(parts), (np.concatenate(rows), np.concatenate(cols))), (count, count))


def _even(wet: np.ndarray, number: np.ndarray):
    """A mean over neighbours along the columns: a change that goes up and down from cell to cell is dear."""
    from scipy import sparse

    free = number >= 0
    joined = wet[:, 1:] & wet[:, :-1]
    near = np.pad(joined, ((0, 0), (0, 1))).astype(float) + np.pad(joined, ((0, 0), (1, 0)))
    count, weight = int(free.sum()), 0.25 * (1 - ROUGH)
    rows, cols, parts = [number[free]], [number[free]], [1 - weight * near[free]]
    west, east = number[:, :-1], number[:, 1:]
    both = joined & (west >= 0) & (east >= 0)
    for here, there in ((west, east), (east, west)):
        rows.append(here[both])
        cols.append(there[both])
        parts.append(np.full(int(both.sum()), weight))
    return sparse.csr_matrix((np.concatenate(parts), (np.concatenate(rows), np.concatenate(cols))), (count, count))


def _solved(matrix, asked: np.ndarray) -> np.ndarray:
    """The potential, by conjugate gradients: the matrix has no inverse (constants), but `asked` lies in its range."""
    from scipy.sparse import diags
    from scipy.sparse.linalg import cg

    diagonal = matrix.diagonal()
    scale = diags(np.divide(1, diagonal, out=np.ones_like(diagonal), where=diagonal > 0))
    return cg(matrix, asked, rtol=LEFT, maxiter=ROUNDS, M=scale)[0]
