"""u of the beach mesh evened out: no fan at a bend has one u throughout, in which a texture would be drawn to streaks.

Nearest points give u; at the outer side of a bend they are one point for a whole fan. So u is kept on the waterline and
elsewhere is the least-squares solution of ∇u = way along the shore, by linear elements: a Poisson equation.
"""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import spsolve

ON_LINE_M = 0.05


def evened(xy: np.ndarray, triangles: np.ndarray, u: np.ndarray, off_m: np.ndarray) -> np.ndarray:
    """u `(n,)` in m from that of nearest points; `off_m` `(n,)` metres to the waterline, seaward positive."""
    slopes, area = shape_slopes(xy, triangles)
    seaward = np.einsum("tk,tkd->td", off_m[triangles], slopes)
    way = np.stack([seaward[:, 1], -seaward[:, 0]], -1)  # the sea on its left
    count = len(xy)
    rows, cols = np.repeat(triangles, 3, 1).ravel(), np.tile(triangles, (1, 3)).ravel()
    stiff = np.einsum("t,tid,tjd->tij", area, slopes, slopes).ravel()
    matrix = sparse.csr_matrix((stiff, (rows, cols)), (count, count))
    load = np.bincount(triangles.ravel(), np.einsum("t,tid,td->ti", area, slopes, way).ravel(), count)
    free = _free(matrix, np.abs(off_m) <= ON_LINE_M)
    if not free.any():
        return u
    made = u.copy()
    known = load[free] - matrix[free][:, ~free] @ u[~free]
    made[free] = spsolve(matrix[free][:, free].tocsc(), known)
    return made


def shape_slopes(xy: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Gradients `(m, 3, 2)` of each corner's linear share, and areas `(m,)`, of anticlockwise triangles."""
    corner = xy[triangles]
    over = np.roll(corner, -2, 1) - np.roll(corner, -1, 1)  # the side opposite a corner
    twice = over[:, 0, 0] * over[:, 1, 1] - over[:, 0, 1] * over[:, 1, 0]
    return np.stack([-over[..., 1], over[..., 0]], -1) / twice[:, None, None], twice / 2


def _free(matrix: sparse.csr_matrix, fixed: np.ndarray) -> np.ndarray:
    """Vertices that hang together with a fixed one and are none."""
    _, part = connected_components(matrix, directed=False)
    return ~fixed & np.isin(part, part[fixed])
