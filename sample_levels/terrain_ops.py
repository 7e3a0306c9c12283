"""What shapes land after noise: curves to build along, streams that cut valleys, rock that crumbles to scree."""

from __future__ import annotations

import numpy as np
from scipy import ndimage
from scipy.interpolate import CubicSpline
from scipy.spatial import cKDTree

NEIGHBOURS = [(0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1)]


def points(text: str) -> np.ndarray:
    """Rows of numbers written `a,b a,b …`, float64 `(rows, columns)`."""
    return np.array([[float(part) for part in row.split(",")] for row in text.split()])


class Curve:
    """A smooth line through points (x, y metres); a closed one returns to its first point."""

    def __init__(self, through: np.ndarray, closed: bool = False, spacing_m: float = 0.5) -> None:
        knots = np.concatenate([through, through[:1]]) if closed else through
        chord = np.sqrt(np.square(np.diff(knots, axis=0)).sum(axis=1))
        along = np.concatenate([[0.0], np.cumsum(np.sqrt(chord))])  # centripetal: no loops at tight corners
        spline = CubicSpline(along, knots, bc_type="periodic" if closed else "natural")
        fine = spline(np.linspace(0, along[-1], int(chord.sum() / spacing_m) * 2))
        length = np.concatenate([[0.0], np.cumsum(np.sqrt(np.square(np.diff(fine, axis=0)).sum(axis=1)))])
        self.arc = np.linspace(0, length[-1], int(length[-1] / spacing_m) + 1)
        self.points = np.stack([np.interp(self.arc, length, fine[:, i]) for i in (0, 1)], axis=-1)
        step = np.gradient(self.points, axis=0)
        self.tangent = step / np.sqrt(np.square(step).sum(axis=1, keepdims=True))
        self._tree = cKDTree(self.points)

    def nearest(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(signed distance m, positive on the left of the way along; metres along) of every point."""
        distance, index = self._tree.query(np.stack([x, y], axis=-1).reshape(-1, 2), workers=-1)
        distance, index = distance.reshape(x.shape), index.reshape(x.shape)
        tangent, origin = self.tangent[index], self.points[index]
        left = tangent[..., 0] * (y - origin[..., 1]) - tangent[..., 1] * (x - origin[..., 0])
        return np.where(left >= 0, distance, -distance), self.arc[index]

    def heading(self, along_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(east, north) of the way along, unit length."""
        return tuple(np.interp(along_m, self.arc, self.tangent[:, i]) for i in (0, 1))

    def at(self, along_m: float) -> tuple[float, float]:
        return tuple(float(np.interp(along_m, self.arc, self.points[:, i])) for i in (0, 1))


def shifted(z: np.ndarray, dy: int, dx: int) -> np.ndarray:
    """`z` at the neighbour (row + dy, column + dx); the border repeats itself."""
    rows = np.clip(np.arange(z.shape[0]) + dy, 0, z.shape[0] - 1)
    cols = np.clip(np.arange(z.shape[1]) + dx, 0, z.shape[1] - 1)
    return z[rows][:, cols]


def cut_valleys(z, fixed, cell_m: float, steps: int, strength: float, creep: float) -> np.ndarray:
    """Streams cut down by root of drained area × slope, slopes creep (stream power law, Whipple & Tucker 1999).

    The drained area is carried from step to step and relaxed once in each, which settles as the valleys do.
    `fixed` cells (bool `(rows, cols)`) are the base level: sea, plain, river.
    """
    z = z.copy()
    area = np.full(z.shape, cell_m * cell_m)
    reach = [cell_m * np.sqrt(float(dy * dy + dx * dx)) for dy, dx in NEIGHBOURS]
    for _ in range(steps):
        steepest, total, weights, lowest = np.zeros(z.shape), np.full(z.shape, 1e-9), [], np.full(z.shape, np.inf)
        for (dy, dx), length in zip(NEIGHBOURS, reach, strict=True):
            other = shifted(z, dy, dx)
            slope = np.maximum(z - other, 0) / length
            steepest, lowest = np.maximum(steepest, slope), np.minimum(lowest, other)
            weight = slope * slope
            weights.append(weight)
            total += weight
        share = area / total
        area = np.full(z.shape, cell_m * cell_m)
        for (dy, dx), weight in zip(NEIGHBOURS, weights, strict=True):
            area += shifted(share * weight, -dy, -dx)
        cut = np.minimum(strength * np.sqrt(area) * steepest, 0.4 * np.maximum(z - lowest, 0))
        settled = np.maximum(z - cut + creep * ndimage.laplace(z, mode="nearest"), lowest + 1e-3)  # pits fill
        z = np.where(fixed, z, settled)
    return z


def crumble(rock, loose, rock_slope, loose_slope: float, cell_m: float, steps: int) -> tuple[np.ndarray, np.ndarray]:
    """Rock steeper than `rock_slope` breaks off and rolls until it lies at `loose_slope`: (rock, scree) heights."""
    rock, loose = rock.copy(), loose.copy()
    for _ in range(steps):
        ground = rock + loose
        moved = np.zeros(rock.shape)
        for dy, dx in NEIGHBOURS:
            length = cell_m * (1.41421356 if dy and dx else 1.0)
            drop = ground - shifted(ground, dy, dx)
            broken = np.clip(drop - rock_slope * length, 0, 1.0) * 0.06
            rolled = np.minimum(np.clip(drop - loose_slope * length, 0, 2.0) * 0.09, loose / 8)
            out = broken * (loose < 0.3) + rolled
            rock -= broken * (loose < 0.3)
            loose -= rolled
            moved += shifted(out, -dy, -dx)
        loose += moved
    return rock, loose


def upsample(coarse: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """A half-size grid (samples at every second vertex) raised to `shape` by a cubic spline."""
    rows, cols = (np.arange(n) / 2.0 for n in shape)
    return ndimage.map_coordinates(coarse, np.meshgrid(rows, cols, indexing="ij"), order=3, mode="nearest")
