"""The system behind river_flow.py: where water comes in, where it leaves, and the potential between (D13)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from .river_jet import Mouth
from .river_map import PAINTED

if TYPE_CHECKING:
    from .river_flow import RiverFlowRequest

SHALLOW_M = 0.1  # water counts as no shallower, or a film would rush
EVEN_CELLS = 1.0  # sigma over which its depth is evened: a current doesn't know single stones that it covers
LEAST_CELLS = 16  # less is a puddle
FASTEST_MPS = 15.0
FALLS_M = 0.1  # painted water whose level falls by less stands
RIM_SHARE = 0.04  # of that fall: cells so near to its highest and lowest level are where it comes in and leaves


def evened(depth_m: np.ndarray) -> np.ndarray:
    """Depths of the wet cells, float32, as the flow knows them; the rest is SHALLOW_M."""
    wet = (depth_m > 0).astype(np.float32)
    share = ndimage.gaussian_filter(wet, EVEN_CELLS)
    depth = ndimage.gaussian_filter(np.maximum(depth_m, 0), EVEN_CELLS) / np.maximum(share, 1e-3)
    return np.maximum(np.where(wet > 0, depth, 0), SHALLOW_M).astype(np.float32)


@dataclass(frozen=True)
class _Ends:
    """First and last cross-section of a river in a body of water, bool `(rows, cols)`.

    `fed`: it comes out of other water, `branches`: out of another river; `taken`: it runs into other water, `to_sea`:
    into the sea.
    """

    which: int
    first: np.ndarray
    last: np.ndarray
    discharge: float
    fed: bool
    branches: bool
    taken: bool
    to_sea: bool


class Solve:
    """One system for all water that flows; arrays over its cells."""

    def __init__(self, asked: RiverFlowRequest):
        self.asked, self.shape = asked, asked.depth_m.shape
        self.wet = asked.depth_m > 0
        self.parts, self.count = ndimage.label(self.wet)
        self.depth = evened(asked.depth_m).astype(np.float64)
        self.source, self.leaves = np.zeros(self.shape), np.zeros(self.shape)  # m³/s into a cell; to the sea, × φ
        self.cut = np.zeros(self.shape, bool)  # where water comes in or leaves: a face of those cells is missing
        self.paced: list[int] = []  # bodies of painted water alone
        self.areas = [self._sections(which) for which in range(len(asked.lines))]
        self.exits: dict[int, np.ndarray] = {}

    def _sections(self, which: int) -> np.ndarray:
        """Wet cross-section in m² at the points of a line, over as much of its length as a cell or two."""
        line, asked = self.asked.lines[which], self.asked
        own = self.wet & (asked.owner == which)
        points = len(line.along_m)
        volume = np.bincount(asked.nearest[own], self.depth[own], points)[:points] * asked.cell_m**2
        return _running(volume, line.along_m, asked.cell_m)

    def discharge(self, which: int) -> float:
        """m³/s."""
        line, area = self.asked.lines[which], self.areas[which]
        known = (area > 0) & (line.speed_mps > 0)
        known[line.mouth :] = False
        return float(np.exp(np.log(area[known] * line.speed_mps[known]).mean())) if known.any() else 0.0

    def done(self) -> tuple[np.ndarray, tuple[Mouth, ...]]:
        """Velocities float32 `(rows, cols, 2)` in m/s, and the mouths."""
        discharge = [self.discharge(which) for which in range(len(self.asked.lines))]
        flows = np.zeros(self.count + 1, bool)
        cells = np.bincount(self.parts.ravel(), minlength=self.count + 1)
        for part in range(1, self.count + 1):
            flows[part] = cells[part] >= LEAST_CELLS and self._open(part, discharge)
        if not flows.any():
            return np.zeros((*self.shape, 2), np.float32), ()
        there = flows[self.parts]
        head = self._solved(there)
        velocity = self._velocity(head, there)
        for part in self.paced:
            self._pace(velocity, self.parts == part)
        return velocity, tuple(self._mouth(which, head) for which in sorted(self.exits))

    def _open(self, part: int, discharge: list[float]) -> bool:
        """Where the water of one body comes in and where it leaves; False where it stands still."""
        body = self.parts == part
        ends = self._ends(body, discharge)
        if not ends:
            return self._falls(part, body)
        painted = body & (self.asked.owner == PAINTED)
        springs = [end for end in ends if not end.fed] or [end for end in ends if not end.branches]
        for end in springs or ends:
            self._into(end.first, end.discharge)
        mouths = [end for end in ends if not end.taken]
        if not mouths and painted.any():  # a lake without an outlet: it seeps away
            self.source[painted] -= self.source[body].sum() / np.count_nonzero(painted)
            self.leaves[tuple(np.argwhere(painted)[0])] = 1.0
        for end in mouths or ([] if painted.any() else ends):
            self.leaves[end.last] += self.depth[end.last]
            self.cut |= end.last
            if end.to_sea:
                self.exits[end.which] = end.last
        for end in ends:
            self.cut |= end.first
        return True

    def _falls(self, part: int, body: np.ndarray) -> bool:
        """Whether painted water runs by itself, for its level falls: in at its highest rim, out at its lowest."""
        asked = self.asked
        level_m = asked.level_m[body]
        fall_m = float(np.ptp(level_m))
        if asked.painted_mps <= 0 or fall_m < FALLS_M or (asked.owner[body] >= 0).any():
            return False
        first = body & (asked.level_m >= level_m.max() - RIM_SHARE * fall_m)
        last = body & (asked.level_m <= level_m.min() + RIM_SHARE * fall_m)
        self._into(first, 1.0)
        self.leaves[last] += self.depth[last]
        self.cut |= first | last
        self.paced.append(part)
        return True

    def _pace(self, velocity: np.ndarray, body: np.ndarray) -> None:
        """The body's mean speed is what was asked for: its flow is solved for 1 m³/s, and goes in proportion."""
        speed = np.hypot(velocity[body, 0], velocity[body, 1])
        mean = float(np.average(speed, weights=self.depth[body]))
        if mean > 0:
            faster = self.asked.painted_mps / mean
            velocity[body] *= np.minimum(faster, FASTEST_MPS / np.maximum(speed, 1e-9))[:, None]

    def _into(self, cells: np.ndarray, discharge: float) -> None:
        self.source[cells] += discharge * self.depth[cells] / self.depth[cells].sum()

    def _ends(self, body: np.ndarray, discharge: list[float]) -> list[_Ends]:
        """Of each river that runs through a body of water."""
        asked, found = self.asked, []
        for which in np.unique(asked.owner[body]):
            own = body & (asked.owner == which)
            if which < 0 or discharge[which] <= 0:
                continue
            line = asked.lines[which]
            along = line.along_m[np.where(own, asked.nearest, 0)]
            low, high = along[own].min(), along[own].max()
            if high - low < max(2 * line.half_m[asked.nearest[own].min()], 3 * asked.cell_m):
                continue  # a puddle beside it
            first, last = own & (along <= low + 1.5 * asked.cell_m), own & (along >= high - 1.5 * asked.cell_m)
            to_sea = line.mouth < len(line.along_m) and asked.nearest[own].max() >= line.mouth - 2
            others = asked.owner >= 0 if to_sea else True  # a lagoon by the sea takes nothing, another river does
            taken = _touches(last, body & ~own & others)
            fed, branches = (_touches(first, body & ~own & by) for by in (True, asked.owner >= 0))
            found.append(_Ends(int(which), first, last, discharge[which], fed, branches, taken, to_sea))
        return found

    def _solved(self, there: np.ndarray) -> np.ndarray:
        """−φ in m²/s `(rows, cols)`: conductances between cells are the depths between them, for cells are square."""
        from scipy.sparse import csc_matrix
        from scipy.sparse.linalg import splu

        cells = np.count_nonzero(there)
        number = np.full(self.shape, -1)
        number[there] = np.arange(cells)
        diagonal = self.leaves[there].copy()
        rows, cols, values = [np.arange(cells)], [np.arange(cells)], [diagonal]
        for axis in (0, 1):
            low, high, between = self._faces(axis, there)
            i, j, depth = number[low][between], number[high][between], self._between(axis)[between]
            diagonal += np.bincount(i, depth, cells) + np.bincount(j, depth, cells)
            rows, cols, values = [*rows, i, j], [*cols, j, i], [*values, -depth, -depth]
        matrix = csc_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(cols))), (cells, cells))
        solver = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        head = np.zeros(self.shape)
        head[there] = solver.solve(self.source[there])
        return head

    @staticmethod
    def _pair(axis: int) -> tuple:
        return (np.s_[:-1], np.s_[1:]) if axis == 0 else (np.s_[:, :-1], np.s_[:, 1:])

    def _faces(self, axis: int, there: np.ndarray) -> tuple:
        low, high = self._pair(axis)
        return low, high, there[low] & there[high]

    def _between(self, axis: int) -> np.ndarray:
        low, high = self._pair(axis)
        return 2 * self.depth[low] * self.depth[high] / (self.depth[low] + self.depth[high])  # one after the other

    def _velocity(self, head: np.ndarray, there: np.ndarray) -> np.ndarray:
        """Of cells: the mean discharge through two opposite faces over the depth, so that sections keep their flux."""
        velocity = np.zeros((*self.shape, 2))
        for axis, part in ((1, 0), (0, 1)):
            low, high, between = self._faces(axis, there)
            through = np.where(between, self._between(axis) * (head[low] - head[high]), 0.0)
            velocity[..., part][low] += 0.5 * through
            velocity[..., part][high] += 0.5 * through
        velocity /= (self.depth * self.asked.cell_m)[..., None]
        known = there & ~self.cut
        row, col = ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)
        velocity = np.where((there & self.cut)[..., None] & known.any(), velocity[row, col], velocity)
        speed = np.hypot(*np.moveaxis(velocity, -1, 0))
        return (velocity * np.minimum(1, FASTEST_MPS / np.maximum(speed, 1e-9))[..., None]).astype(np.float32)

    def _mouth(self, which: int, head: np.ndarray) -> Mouth:
        """How a river runs out through its last cross-section."""
        cells, line = self.exits[which], self.asked.lines[which]
        out = float((self.leaves * head)[cells].sum())
        at = line.mouth - 1
        area = self.areas[which][: line.mouth]
        area = area[area > 0][-max(int(line.half_m[at]), 1) :].mean()
        way = np.array([line.x[-1] - line.x[at], line.y[-1] - line.y[at]])
        way /= np.linalg.norm(way)
        depth_m, reach_m = float(self.depth[cells].max()), float(line.along_m[-1] - line.along_m[at])
        place, half_m = (float(line.x[at]), float(line.y[at])), float(line.half_m[at])
        return Mouth(*place, *map(float, way), float(out / area), half_m, depth_m, reach_m)


def _touches(section: np.ndarray, others: np.ndarray) -> bool:
    """Whether other water lies beside a river's first or last cross-section."""
    return bool((ndimage.binary_dilation(section, np.ones((3, 3), bool), 2) & others).any())


def _running(volume: np.ndarray, along_m: np.ndarray, cell_m: float) -> np.ndarray:
    """Volume by length over a few cells to either side of each point."""
    reach = 2.0 * cell_m
    total = np.concatenate([[0.0], np.cumsum(volume)])
    low, high = np.searchsorted(along_m, along_m - reach), np.searchsorted(along_m, along_m + reach, "right")
    edge = np.concatenate([[along_m[0]], 0.5 * (along_m[1:] + along_m[:-1]), [along_m[-1]]])
    return (total[high] - total[low]) / np.maximum(edge[high] - edge[low], 1e-6)
