"""The force simulation (Diablo IV talk, D18): water pushed about by what wades and bursts in it.

    field = force_field(level, t, (x, y))     # None while nothing stirs
    field.lift(x, y)                          # Dual, metres

128² cells round a centre that flow, spread and decay. It scrolls by whole cells: what is pushed stays in its place in
the world. A state at t is made by fixed steps from rest some time before, so that a picture depends on the level and t
alone; only the window goes on from the state that it has. The GPU gets the same array.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from scipy.ndimage import map_coordinates

from .dual import Dual
from .earth import GRAVITY
from .grid import Rect
from .level import Level
from .objects import Disturbance, Mover
from .settings import Force

SIDE = 128
STEP_S = 1 / 15
FOAM_LASTS, FOAM_SPREADS = 4.0, 0.2  # foam stays longer than what made it and hardly spreads (D19)
MEMORY = 6.0  # decay times after which nothing is left to see
LONGEST_GAP_S = 0.5  # a clock that moved on by no more goes on from the state there is
MOST_PUSH_MPS, BORDER = 8.0, 12  # cells over which the field dies out at its rim


@dataclass
class ForceField:
    """`state` float64 `(4, SIDE, SIDE)`: push east, north m/s, lift m, foam; `first` (col, row) its south-west cell."""

    settings: Force
    first: tuple[int, int]
    time_s: float
    key: tuple = ()
    state: np.ndarray = field(default_factory=lambda: np.zeros((4, SIDE, SIDE)))
    _free: np.ndarray | None = None  # what the quiet area leaves of it, `(SIDE, SIDE)`
    _free_key: tuple = ()
    _packed: np.ndarray | None = None

    @property
    def origin_m(self) -> tuple[float, float]:
        """World place of the first cell."""
        return self.first[0] * self.settings.cell_m, self.first[1] * self.settings.cell_m

    def packed(self) -> np.ndarray:
        """What is drawn and sampled, float32 `(rows, cols, 4)`: limited, with the strength, nothing at the rim."""
        if self._packed is None:
            self._packed = self._pack()
        return self._packed

    def _pack(self) -> np.ndarray:
        knobs, out = self.settings, self.state.copy()
        out[:3] *= knobs.strength
        out[2] = knobs.limit_m * np.tanh(out[2] / knobs.limit_m)
        out[3] = np.clip(out[3] * knobs.foam, 0, 1)
        out *= _rim() if self._free is None else _rim() * self._free
        return np.ascontiguousarray(np.moveaxis(out, 0, -1), np.float32)

    def hold_down(self, level: Level) -> None:
        """Let the layer `quiet` hold down what is drawn and sampled (D39); the state itself runs on."""
        held = level.settings.quiet.force if not level.layers["quiet"].neutral else 0.0
        key = held and (held, level.layer_revision("quiet"), self.first)
        if key == self._free_key:
            return
        self._free_key, self._packed = key, None
        self._free = 1 - held * _quiet_at(level, self.origin_m, self.settings.cell_m) if held else None

    def lift(self, x, y) -> Dual:
        """Height added at world points with its gradient, bilinear; the twin of `force_lift` in force.glsl."""
        lift, cell_m = self.packed()[..., 2].astype(np.float64), self.settings.cell_m
        u, v = ((np.asarray(p) - o) / cell_m for p, o in zip((x, y), self.origin_m, strict=True))
        inside = (u >= 0) & (v >= 0) & (u <= SIDE - 1) & (v <= SIDE - 1)
        col, row = (np.clip(np.floor(p).astype(int), 0, SIDE - 2) for p in (u, v))
        fu, fv = u - col, v - row
        v00, v10, v01, v11 = (lift[row + r, col + c] for r, c in ((0, 0), (0, 1), (1, 0), (1, 1)))
        south, north = v00 + (v10 - v00) * fu, v01 + (v11 - v01) * fu
        dx = ((v10 - v00) + ((v11 - v01) - (v10 - v00)) * fv) / cell_m
        return Dual(
            *(np.where(inside, part, 0.0) for part in (south + (north - south) * fv, dx, (north - south) / cell_m))
        )

    def scroll(self, first: tuple[int, int]) -> None:
        """Move the window over the world by whole cells; what comes in is at rest."""
        cols, rows = (new - old for new, old in zip(first, self.first, strict=True))
        if not (cols or rows):
            return
        self._packed = None
        if max(abs(cols), abs(rows)) >= SIDE:
            self.state[:] = 0
        else:
            self.state = np.roll(self.state, (-rows, -cols), (1, 2))
            self.state[:, SIDE - rows if rows > 0 else 0 : SIDE if rows > 0 else -rows] = 0
            self.state[:, :, SIDE - cols if cols > 0 else 0 : SIDE if cols > 0 else -cols] = 0
        self.first = first

    def step(self, movers, bursts) -> None:
        """One step of STEP_S: what stirs, then waves, spread and decay; bounded, and at rest in the end."""
        x, y = (np.arange(SIDE) * self.settings.cell_m + o for o in self.origin_m)
        for mover in movers:
            _stir(self.state, mover, self.time_s, x, y)
        for burst in bursts:
            if self.time_s <= burst.time_s < self.time_s + STEP_S:
                _burst(self.state, burst, x, y)
        _flow(self.state, self.settings)
        self._packed = None
        self.time_s += STEP_S


def _quiet_at(level: Level, origin_m: tuple[float, float], cell_m: float) -> np.ndarray:
    """The layer `quiet` at the cells of a field, bilinear, 0 beyond the level, `(SIDE, SIDE)`."""
    x, y = ((np.arange(SIDE) * cell_m + o) / level.grid.cell_m for o in origin_m)
    rows, cols = level.grid.shape
    # the part of the layer under the field, no more
    row, col = (int(np.clip(math.floor(v[0]) - 1, 0, n - 1)) for v, n in ((y, rows), (x, cols)))
    end_row, end_col = (int(np.clip(math.ceil(v[-1]) + 2, 1, n)) for v, n in ((y, rows), (x, cols)))
    if end_row <= row or end_col <= col:
        return np.zeros((SIDE, SIDE))
    under = level.layers["quiet"].read(Rect(row, col, end_row, end_col)).astype(np.float64)
    return map_coordinates(under, np.meshgrid(y - row, x - col, indexing="ij"), order=1)


def _rim() -> np.ndarray:
    inward = np.minimum(np.arange(SIDE), np.arange(SIDE)[::-1]) / BORDER
    edge = np.clip(inward, 0, 1) ** 2 * (3 - 2 * np.clip(inward, 0, 1))
    return edge[:, None] * edge


def mover_at(mover: Mover, t: float) -> tuple[float, float, float, float]:
    """World x, y and velocity east, north of a mover at time t."""
    if mover.circle_m <= 0:
        return mover.x, mover.y, 0.0, 0.0
    turn = (mover.speed_mps * t / mover.circle_m) % (2 * math.pi)
    sin, cos = math.sin(turn), math.cos(turn)
    return (mover.x + mover.circle_m * sin, mover.y + mover.circle_m * cos,
            mover.speed_mps * cos, -mover.speed_mps * sin)  # fmt: skip


def _stir(state: np.ndarray, mover: Mover, t: float, x: np.ndarray, y: np.ndarray) -> None:
    """The water takes on the mover's speed and piles up before it; many movers cannot add up to more than one does."""
    at_x, at_y, east, north = mover_at(mover, t)
    speed = math.hypot(east, north)
    if speed <= 0:
        return
    off_x, off_y = x[None, :] - at_x, y[:, None] - at_y
    near = np.exp(-(off_x**2 + off_y**2) / mover.radius_m**2)
    ahead = (off_x * east + off_y * north) / (speed * mover.radius_m)
    pile = min(speed**2 / (2 * GRAVITY), mover.radius_m) * np.clip(ahead, -1, 1)
    for channel, wanted in ((0, east), (1, north), (2, pile), (3, min(speed / 2, 1.0))):
        state[channel] += (wanted - state[channel]) * near * 0.5


def _burst(state: np.ndarray, burst: Disturbance, x: np.ndarray, y: np.ndarray) -> None:
    """A push outwards, a hollow in its middle, foam all over it: an explosion (its `strength`)."""
    off_x, off_y = x[None, :] - burst.x, y[:, None] - burst.y
    away = np.hypot(off_x, off_y) / burst.radius_m
    reach = np.exp(-(away**2))
    state[0] += burst.strength * off_x / burst.radius_m * reach
    state[1] += burst.strength * off_y / burst.radius_m * reach
    state[2] -= 0.3 * burst.strength * (1 - away**2) * reach
    state[3] += min(abs(burst.strength), 1.0) * reach


def _flow(state: np.ndarray, knobs: Force) -> None:
    """Shallow waves as fast as the cells allow, spread, decay, a bound on everything."""
    cell_m = knobs.cell_m
    speed = min(2.5, 0.5 * cell_m / STEP_S)
    north, east = np.gradient(state[2], cell_m)
    state[0] -= STEP_S * GRAVITY * east
    state[1] -= STEP_S * GRAVITY * north
    divergence = np.gradient(state[0], cell_m, axis=1) + np.gradient(state[1], cell_m, axis=0)
    state[2] -= STEP_S * speed**2 / GRAVITY * divergence
    around = np.pad(state, ((0, 0), (1, 1), (1, 1)), mode="edge")
    mean = (around[:, :-2, 1:-1] + around[:, 2:, 1:-1] + around[:, 1:-1, :-2] + around[:, 1:-1, 2:]) / 4
    mixed, left = 0.1 + 0.6 * knobs.spread, math.exp(-STEP_S / knobs.decay_s)
    state[:3] = left * (state[:3] + mixed * (mean[:3] - state[:3]))
    state[3] = left ** (1 / FOAM_LASTS) * (state[3] + FOAM_SPREADS * mixed * (mean[3] - state[3]))
    np.clip(state[:2], -MOST_PUSH_MPS, MOST_PUSH_MPS, out=state[:2])
    np.clip(state[2], -4 * knobs.limit_m, 4 * knobs.limit_m, out=state[2])
    np.clip(state[3], 0, 1, out=state[3])
    state[np.abs(state) < 1e-5] = 0


def force_field(level: Level, t: float, centre: tuple[float, float]) -> ForceField | None:
    """The field at time t round a world point, None while nothing stirs; kept in `level.derived`."""
    knobs = level.settings.force
    movers = tuple(o for o in level.objects.values() if isinstance(o, Mover))
    memory_s = min(MEMORY * FOAM_LASTS * knobs.decay_s, level.settings.time.warm_up_s)
    bursts = tuple(o for o in level.objects.values() if isinstance(o, Disturbance) and t - memory_s <= o.time_s < t)
    if not knobs.on or not (movers or bursts):
        level.derived.pop("force", None)
        return None
    first = tuple(math.floor(v / knobs.cell_m) - SIDE // 2 for v in centre)
    until = math.floor(t / STEP_S + 1e-6) * STEP_S
    have, key = level.derived.get("force"), (knobs, movers)
    if have is None or have.key != key or not -1e-9 <= until - have.time_s <= LONGEST_GAP_S:
        start = math.floor((t - memory_s) / STEP_S) * STEP_S
        have = level.derived["force"] = ForceField(knobs, first, start, key)
    have.scroll(first)
    while have.time_s < until - 0.5 * STEP_S:
        have.step(movers, bursts)
    have.hold_down(level)
    return have
