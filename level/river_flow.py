"""How fast rivers run, everywhere in them: the potential flow over their beds (D13, D06).

div(h grad φ) = 0 over the wet cells, h the depth of the water: it keeps its discharge, goes faster in narrows and over
shallows, round rocks and through painted lakes, and has no seam at the middle as flow from distance fields has.

A river's discharge is the geometric mean along it of its points' speed times the wet cross-section: the speed that the
water then has comes as near to what the points say as one discharge can. It comes in over the first cross-section,
leaves over the last one before the sea; where a river ends or begins in other water it passes on what flows there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy import ndimage

from .level import Level
from .river_line import Line
from .river_map import PAINTED, RiverMap, river_shape

SHALLOW_M = 0.05  # water counts as no shallower, or a film would rush
MOST_CELLS = 200_000  # more are solved in twice as large cells: 200,000 take 3 s
FASTEST_MPS = 15.0


@dataclass(frozen=True)
class RiverFlow:
    """`velocity` float32 `(rows, cols, 2)`, east and north in m/s on the map's samples from `corner` (row, col) on.

    By river: how fast it runs out at its mouth, and over what half width; 0 where it doesn't come to the sea.
    """

    velocity: np.ndarray
    depth_m: np.ndarray  # float32 `(rows, cols)`: that of the water for which it is known, else 0
    corner: tuple[int, int]
    cell_m: float
    mouth_mps: np.ndarray
    mouth_half_m: np.ndarray
    discharge: np.ndarray  # m³/s
    key: tuple = ()

    @property
    def wet(self) -> np.ndarray:
        """Where there is such water, bool `(rows, cols)`."""
        return self.depth_m > 0

    def on(self, shape: tuple[int, int], cell_m: float) -> np.ndarray:
        """East, north in m/s and share 0 … 1 of it on other samples, float32 `(rows, cols, 3)`.

        It goes on under the banks by as much as a sample is wide: coarse ones don't lose a narrow river.
        """
        out = np.zeros((*shape, 3), np.float32)
        ratio = cell_m / self.cell_m
        pad = int(np.ceil(ratio)) + 2
        wet = np.pad(self.wet, pad)
        if not wet.any():
            return out
        rows, cols = (np.rint(np.arange(n) * ratio).astype(int) - at + pad
                      for n, at in zip(shape, self.corner, strict=True))  # fmt: skip
        inside = [(v >= 0) & (v < n) for v, n in zip((rows, cols), wet.shape, strict=True)]
        away, (row, col) = ndimage.distance_transform_edt(~wet, return_indices=True)
        there = np.ix_(rows[inside[0]], cols[inside[1]])
        share = np.clip(ratio + 1 - away[there], 0, 1)
        velocity = self.velocity[row[there] - pad, col[there] - pad]
        out[np.ix_(*inside)] = np.concatenate([velocity * (share > 0)[..., None], share[..., None]], -1)
        return out


@dataclass(frozen=True)
class RiverFlowRequest:
    """All that it follows from, as a process can carry it: depths and lines on the window that has water."""

    depth_m: np.ndarray  # float32 `(rows, cols)`, 0 where it is dry or the sea
    owner: np.ndarray
    nearest: np.ndarray
    cell_m: float
    lines: tuple[Line, ...]
    corner: tuple[int, int]

    def kept(self) -> RiverFlowRequest:
        """With arrays of its own, which no later edit of the level reaches."""
        return replace(self, **{name: np.array(getattr(self, name)) for name in ("depth_m", "owner", "nearest")})

    @property
    def answer_bytes(self) -> int:
        """Bytes of the arrays of its answer."""
        return 12 * self.depth_m.size + (1 << 12) + 64 * len(self.lines)

    def answered(self) -> RiverFlow:
        """The flow, worked out now; its key is left to whoever asks."""
        wet = self.depth_m > 0
        count = len(self.lines)
        still = RiverFlow(np.zeros((*wet.shape, 2), np.float32), np.array(self.depth_m), self.corner, self.cell_m,
                          *np.zeros((3, count)))  # fmt: skip
        if not wet.any() or not count:
            return still
        if np.count_nonzero(wet) > MOST_CELLS:
            return self._coarsely()
        return _Solve(self).done(still)

    def _coarsely(self) -> RiverFlow:
        """Solved in cells of two by two, each velocity then at all four."""
        rows, cols = (n // 2 for n in self.depth_m.shape)
        quads = self.depth_m[: 2 * rows, : 2 * cols].reshape(rows, 2, cols, 2)
        wet = (quads > 0).sum((1, 3))
        depth = np.where(wet >= 2, quads.sum((1, 3)) / np.maximum(wet, 1), 0).astype(np.float32)
        firsts = (slice(0, 2 * rows, 2), slice(0, 2 * cols, 2))
        half = replace(self, depth_m=depth, owner=self.owner[firsts], nearest=self.nearest[firsts],
                       cell_m=2 * self.cell_m).answered()  # fmt: skip
        known = np.zeros(self.depth_m.shape, bool)
        known[: 2 * rows, : 2 * cols] = np.repeat(np.repeat(half.wet, 2, 0), 2, 1)
        row, col = ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)
        wide = half.velocity[np.minimum(row // 2, rows - 1), np.minimum(col // 2, cols - 1)]
        here = self.depth_m > 0
        velocity = np.where(here[..., None], wide, 0).astype(np.float32)
        return replace(half, velocity=velocity, depth_m=np.array(self.depth_m), cell_m=self.cell_m)


class _Solve:
    """One system for all water that flows; arrays over its cells."""

    def __init__(self, asked: RiverFlowRequest):
        self.asked, self.shape = asked, asked.depth_m.shape
        self.wet = asked.depth_m > 0
        self.parts, self.count = ndimage.label(self.wet)
        self.depth = np.maximum(asked.depth_m, SHALLOW_M).astype(np.float64)
        self.source, self.leaves = np.zeros(self.shape), np.zeros(self.shape)  # m³/s into a cell; to the sea, × φ
        self.ends = np.zeros(self.shape, bool)
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

    def done(self, still: RiverFlow) -> RiverFlow:
        discharge = np.array([self.discharge(which) for which in range(len(self.asked.lines))])
        flows = np.zeros(self.count + 1, bool)
        for part in range(1, self.count + 1):
            flows[part] = self._open(part, discharge)
        if not flows.any():
            return still
        there = flows[self.parts]
        head = self._solved(there)
        velocity = self._velocity(head, there)
        mouths = [self._mouth(which, head) for which in range(len(self.asked.lines))]
        return replace(still, velocity=velocity, mouth_mps=np.array([m[0] for m in mouths]),
                       mouth_half_m=np.array([m[1] for m in mouths]), discharge=discharge)  # fmt: skip

    def _open(self, part: int, discharge: np.ndarray) -> bool:
        """Where the water of one body comes in and where it leaves; False where it stands still."""
        asked, body = self.asked, self.parts == part
        begins, ends, into = [], [], []
        for which in np.unique(asked.owner[body]):
            if which < 0 or discharge[which] <= 0:
                continue
            own = body & (asked.owner == which)
            line = asked.lines[which]
            along = line.along_m[asked.nearest]
            low, high = along[own].min(), along[own].max()
            if high - low < max(2 * line.half_m[asked.nearest[own].min()], 3 * asked.cell_m):
                continue  # a puddle beside it
            first, last = (own & (along <= low + 1.5 * asked.cell_m)), (own & (along >= high - 1.5 * asked.cell_m))
            to_sea = line.mouth < len(line.along_m) and asked.nearest[own].max() >= line.mouth - 2
            begins.append((first, discharge[which], self._joined(first, body & ~own)))
            ends.append((last, which if to_sea else -1, not to_sea and self._joined(last, body & ~own)))
        if not begins:
            return False
        painted = body & (asked.owner == PAINTED)
        sources = [one for one in begins if not one[2]]
        drains = [one for one in ends if not one[2]]
        if not sources and painted.any():  # a spring lake
            sources = [(painted, max(one[1] for one in begins), True)]
        elif not sources:
            sources = begins
        for cells, amount, _ in sources:
            into.append(amount)
            self.source[cells] += amount * self.depth[cells] / self.depth[cells].sum()
        if not drains and painted.any():  # a lake without an outlet: it seeps away
            self.source[painted] -= sum(into) / np.count_nonzero(painted)
            self.leaves[tuple(np.argwhere(painted)[0])] = 1.0
        for cells, which, _ in drains or ([] if painted.any() else ends):
            self.leaves[cells] += self.depth[cells]
            self.ends |= cells
            if which >= 0:
                self.exits[which] = cells
        for cells, *_ in begins:
            self.ends |= cells
        return True

    def _joined(self, section: np.ndarray, others: np.ndarray) -> bool:
        """Whether other water touches a river's first or last cross-section."""
        return bool((ndimage.binary_dilation(section, np.ones((3, 3), bool), 2) & others).any())

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
        return 0.5 * (self.depth[low] + self.depth[high])

    def _velocity(self, head: np.ndarray, there: np.ndarray) -> np.ndarray:
        """Of cells: the mean discharge through two opposite faces over the depth, so that sections keep their flux."""
        velocity = np.zeros((*self.shape, 2))
        for axis, part in ((1, 0), (0, 1)):
            low, high, between = self._faces(axis, there)
            through = np.where(between, self._between(axis) * (head[low] - head[high]), 0.0)
            velocity[..., part][low] += 0.5 * through
            velocity[..., part][high] += 0.5 * through
        velocity /= (self.depth * self.asked.cell_m)[..., None]
        known = there & ~self.ends  # where water comes in or leaves a face of it is missing
        row, col = ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)
        velocity = np.where((there & self.ends)[..., None] & known.any(), velocity[row, col], velocity)
        speed = np.hypot(*np.moveaxis(velocity, -1, 0))
        return (velocity * np.minimum(1, FASTEST_MPS / np.maximum(speed, 1e-9))[..., None]).astype(np.float32)

    def _mouth(self, which: int, head: np.ndarray) -> tuple[float, float]:
        """Speed in m/s over the last cross-section and its half width in m."""
        cells = self.exits.get(which)
        if cells is None:
            return 0.0, 0.0
        line = self.asked.lines[which]
        out = float((self.leaves * head)[cells].sum())
        area = self.areas[which][: line.mouth]
        area = area[area > 0][-max(int(line.half_m[line.mouth - 1]), 1) :].mean()
        return out / area, float(line.half_m[line.mouth - 1])


def _running(volume: np.ndarray, along_m: np.ndarray, cell_m: float) -> np.ndarray:
    """Volume by length over a few cells to either side of each point."""
    reach = 2.0 * cell_m
    total = np.concatenate([[0.0], np.cumsum(volume)])
    low, high = np.searchsorted(along_m, along_m - reach), np.searchsorted(along_m, along_m + reach, "right")
    edge = np.concatenate([[along_m[0]], 0.5 * (along_m[1:] + along_m[:-1]), [along_m[-1]]])
    return (total[high] - total[low]) / np.maximum(edge[high] - edge[low], 1e-6)


def river_flow(level: Level) -> RiverFlow | None:
    """How fast the level's rivers run, kept until something that it follows from changes; None without any.

    While a stroke is open the last one stays.
    """
    made = river_shape(level)
    if made is None:
        return None
    have = level.derived.get("river_flow")
    if have is not None and level.live:
        return have
    key = (made.key, level.layer_revision("height"))
    if have is not None and have.key == key:
        return have
    if have is None or level.solver is None:
        found = _request(level, made).answered()
    else:
        found = level.solver.beside("river_flow", key, lambda: _request(level, made))
        if found is None:
            return have  # till the new one has come
    have = level.derived["river_flow"] = replace(found, key=key)
    return have


def _request(level: Level, made: RiverMap) -> RiverFlowRequest:
    stride = round(made.cell_m / level.grid.cell_m)
    depth = made.packed[..., 0] + np.float32(level.mean_sea_m) - level.height[::stride, ::stride]
    wet = made.wet & (depth > 0)
    for which, line in enumerate(made.lines):
        wet &= (made.owner != which) | (made.nearest < line.mouth)  # the tail is the sea's
    rows, cols = np.flatnonzero(wet.any(1)), np.flatnonzero(wet.any(0))
    row, col = (max(int(v[0]) - 2, 0) if len(v) else 0 for v in (rows, cols))
    window = (slice(row, int(rows[-1]) + 3), slice(col, int(cols[-1]) + 3)) if len(rows) else np.s_[:1, :1]
    depth = np.where(wet, depth, 0).astype(np.float32)
    return RiverFlowRequest(
        depth[window], made.owner[window], made.nearest[window], made.cell_m, made.lines, (row, col)
    )
