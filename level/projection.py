"""Currents made coherent: as much water leaves each cell as comes (T02).

A cell's divergence is what flows through its four faces over its area; through a face goes the mean of the two cells
beside it, through one to land nothing, through the border of the array the cell's own. `divergence_free` takes away
B Bᵀ Dᵀ λ, where D B Bᵀ Dᵀ λ = D u (the projection of Chorin, 1968, on the discrete divergence D itself, so that
nothing is left over). Without B, a mean over neighbours, that D is blind to what goes up and down from cell to cell,
and the answer is full of it. Where there are many cells, λ solves the five-point Laplacian instead, a few times over:
quick and even, but the last cells beside shores and the rim keep some divergence.
"""

from __future__ import annotations

import numpy as np

EXACT = 32_000  # cells up to which nothing is left over: some seconds of a direct solver
ROUNDS = 3  # of the quick way; more would bring the ups and downs back
ROUGH = 0.1  # what B leaves of a change that goes up and down from cell to cell
SURE = 1e-9  # keeps the matrix from being singular; one round of refinement makes up for it


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
    free = np.ones(wet.shape, bool) if inside is None else inside
    out = [np.where(free & ~wet, 0, part).astype(np.float64) for part in (u, v)]
    free = free & wet
    if free.any():
        number = np.full(wet.shape, -1)
        number[free] = np.arange(int(free.sum()))
        asked = divergence(wet, *out, cell_m)[free] * cell_m
        change = (_exact if len(asked) <= EXACT else _quick)(wet, number, asked)
        for part, less in zip(out, np.split(change, 2), strict=True):
            part[free] -= less
    return out[0].astype(u.dtype), out[1].astype(v.dtype)


def _exact(wet: np.ndarray, number: np.ndarray, asked: np.ndarray) -> np.ndarray:
    """What is to be taken away, east and then north, so that nothing is left over."""
    from scipy import sparse

    even = (_mean(wet, number) @ _mean(wet.T, number.T)).T
    apart = sparse.hstack([_apart(wet, number) @ even, _apart(wet.T, number.T) @ even]).tocsr()
    matrix = apart @ apart.T
    solve = _factored(matrix + SURE * sparse.identity(len(asked)))
    potential = solve(asked)
    potential += solve(asked - matrix @ potential)
    return np.concatenate([even @ part for part in np.split(apart.T @ potential, 2)])


def _quick(wet: np.ndarray, number: np.ndarray, asked: np.ndarray) -> np.ndarray:
    from scipy import sparse
    from scipy.sparse.linalg import LinearOperator, cg

    apart = sparse.hstack([_apart(wet, number), _apart(wet.T, number.T)]).tocsr()
    laplacian = _second(wet, number) + _second(wet.T, number.T) + SURE * sparse.identity(len(asked))
    inverse = LinearOperator((len(asked),) * 2, _factored(laplacian))
    return apart.T @ cg(apart @ apart.T, asked, rtol=0, maxiter=ROUNDS, M=inverse)[0]


def _factored(matrix):
    from scipy.sparse.linalg import splu

    return splu(matrix.tocsc(), "MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}).solve


# Matrices over the free cells, along the columns: give them transposed arrays for the rows


def _apart(wet: np.ndarray, number: np.ndarray):
    """Divergence times cell."""
    own = 0.5 * _beside(wet)[0] - 0.5 * _beside(wet)[1]  # what leaves by its east face less what comes by its west one
    own[:, -1] += 1
    own[:, 0] -= 1
    return _banded(wet, number, own, 0.5, -0.5)


def _mean(wet: np.ndarray, number: np.ndarray):
    """B: a mean with the neighbours."""
    weight = 0.25 * (1 - ROUGH)
    return _banded(wet, number, 1 - weight * sum(_beside(wet)), weight, weight)


def _second(wet: np.ndarray, number: np.ndarray):
    """Second difference, with its sign turned; beyond the border of the array the potential is 0."""
    own = sum(_beside(wet))
    own[:, -1] += 1
    own[:, 0] += 1
    return _banded(wet, number, own, -1.0, -1.0)


def _beside(wet: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Whether there is water to the east and to the west of a cell of water, as 0 or 1."""
    joined = (wet[:, 1:] & wet[:, :-1]).astype(float)
    return np.pad(joined, ((0, 0), (0, 1))), np.pad(joined, ((0, 0), (1, 0)))


def _banded(wet: np.ndarray, number: np.ndarray, own: np.ndarray, east: float, west: float):
    """A sparse matrix with each free cell's own weight and those of its neighbours in the same water."""
    from scipy import sparse

    free, count = number >= 0, int((number >= 0).sum())
    left, right = number[:, :-1], number[:, 1:]
    both = wet[:, 1:] & wet[:, :-1] & (left >= 0) & (right >= 0)
    left, right = left[both], right[both]
    parts = np.concatenate([own[free], np.full(len(left), east), np.full(len(left), west)])
    rows, cols = np.concatenate([number[free], left, right]), np.concatenate([number[free], right, left])
    return sparse.csr_matrix((parts, (rows, cols)), (count, count))
