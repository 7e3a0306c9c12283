"""How high a swell is on its way to the beach, where and how it breaks, and how far up it runs (D34, T06).

Energy goes along rays (`swell_rays`): shoaling from the group speed, refraction and shelter from rays that close up or
spread. Where a wave is too high for its depth it breaks and loses energy as Dally, Dean & Dalrymple (1985) say, until
it is low enough to form again behind a bar. Linear theory: it says less than the height just before breaking.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy import ndimage

from .before_breaking import AHEAD_S, Ahead, ahead_of
from .dispersion import deep_water_length, group_ratio, group_speed
from .runup import RUNUP, breaker_type, surf_similarity
from .swell_rays import Rays, rays_of
from .travel_time import TravelTime, over_land

BREAKS_AT = 0.78  # height by depth (McCowan 1891)
STABLE_AT = 0.4  # height by depth that a broken wave falls to (Dally, Dean & Dalrymple 1985)
DECAY = 0.15  # theirs: part of the excess energy flux lost on a way as long as the water is deep
FORMS_AGAIN, STAYS_BROKEN = 0.98, 1.08  # of the stable height, which a broken wave on an even bed only ever comes near
CALMS_OVER = 5.0  # depths of way that it takes to form again
LEAST_BROKEN = 0.02
SPREADS_OVER = 0.12  # of the swell's length (sigma): rays know no diffraction
HEAPED_FROM, HEAPS_SPREAD = 1.5, 3.0  # times the energy from which on it is spread so many times wider
MOST_GATHERED = 4.0  # times the energy, in the end: at a caustic rays of linear theory know no bound
MOST_ON_A_LINE = 1.0  # of the energy over a front as wide as the swell is long: all that one line of cells may heap up
NARROWEST = 0.2  # of the width a ray had one cell before
BED_OVER = 0.05  # of the swell's length: the bed's slope is that of a bed smoothed so wide
LEAST_SLOPE = 1e-3


@dataclass(frozen=True)
class WaveHeights:
    """Maps `(rows, cols)` float32, row 0 south; on land they go on for a few cells, then are 0."""

    height_m: np.ndarray  # crest to trough
    gathered: np.ndarray  # height by that of a swell straight in: refraction and shelter, before breaking
    broken: np.ndarray  # 0 … 1: broken, falling over a few depths where it forms again
    since_break_s: np.ndarray  # seconds since it broke, 0 where it hasn't
    break_height_m: np.ndarray  # height with which it broke, 0 where it hasn't
    similarity: np.ndarray  # surf similarity at the point where it broke
    breaker: np.ndarray  # int8: 0 unbroken, 1 spilling, 2 plunging, 3 surging
    break_point: np.ndarray  # bool: cells where it begins to break
    runup_m: np.ndarray  # above still water, at the nearest water's edge
    to_break_s: np.ndarray  # seconds until it breaks, before_breaking.AHEAD_S at most
    next_similarity: np.ndarray  # surf similarity where it will break, 0 where it won't


def wave_heights(
    depth_m: np.ndarray,
    found: TravelTime,
    height_m: float,
    breaks_at: float = BREAKS_AT,
    decay: float = DECAY,
    stable_at: float = STABLE_AT,
    least_depth_m: float = 0.1,
    runup: str = "hunt",
) -> WaveHeights:
    """Heights of a swell that is `height_m` high beyond the level, over depth (rows, cols) as `found` was solved on."""
    if found.border is None or height_m <= 0 or not found.reached.any():
        return _none(found.seconds.shape)
    surf = _Surf(np.asarray(depth_m, np.float64), found, height_m, least_depth_m)
    surf.breaks_at, surf.decay, surf.stable_at = breaks_at, decay, stable_at
    order = list(surf.rays.generations())
    for cells in order:
        surf.gather(cells)
    surf.spread()
    for cells in order:
        surf.step(cells)
    ahead = ahead_of(surf.rays, order, surf.starts, surf.since, surf.similarity)
    return surf.maps(depth_m, runup, ahead)


@dataclass
class _Surf:
    """The march: state of each cell of the padded, turned grid, filled in generation by generation."""

    depth_m: np.ndarray
    found: TravelTime
    offshore_m: float
    least_depth_m: float
    breaks_at: float = BREAKS_AT
    decay: float = DECAY
    stable_at: float = STABLE_AT
    rays: Rays = field(init=False)

    def __post_init__(self):
        self.rays = rays_of(self.found)
        self.h = np.maximum(self._flat(self.depth_m), self.least_depth_m)
        k = np.maximum(self._flat(self.found.wavenumber), 1e-6)
        period_s = self.found.period_s
        self.group = 2 * np.pi / period_s / k * group_ratio(k, self.h)
        self.group_ref = float(group_speed(period_s, self.found.depth_ref_m))
        self.slope = self._slope_along()
        self.most = self.group_ref * max(MOST_GATHERED, MOST_ON_A_LINE * self._length() / self.found.cell_m)
        cells = self.h.size
        self.unbroken = self.rays.entry * self.group_ref  # energy flux: group speed times (H / offshore H)²
        self.left = np.ones(cells)  # part of it that breaking left
        self.broken, self.starts = np.zeros(cells), np.zeros(cells, bool)
        self.since, self.break_height, self.similarity = np.zeros(cells), np.zeros(cells), np.zeros(cells)
        self.fullness = np.zeros(cells)  # height by the height that breaks, before breaking takes from it

    def gather(self, cells: np.ndarray) -> None:
        """One generation of the unbroken swell: what flows in goes on through the faces it leaves by."""
        share, from_ = self._upwave(cells)
        out = np.maximum(self.rays.leaves[cells], np.maximum(NARROWEST * share.sum(axis=0), 1e-9))
        flux = (share * self.unbroken[from_]).sum(axis=0) / out
        self.unbroken[cells] = np.minimum(flux, self.most)

    def spread(self) -> None:
        """Diffraction in its simplest form: energy is no sharper than a part of the wave's length.

        What first arrivals heap up on one line is that of beams which cross there: it is spread wider.
        """
        shape, sigma = self.rays.shape, self._length() * SPREADS_OVER / self.found.cell_m
        water = (self.rays.water | (self.rays.entry > 0)).reshape(shape).astype(np.float64)
        flux = self.unbroken.reshape(shape) * water
        single = np.minimum(flux, HEAPED_FROM * self.group_ref)
        wide = _spread(single, water, sigma) + _spread(flux - single, water, sigma * HEAPS_SPREAD)
        wide = np.minimum(wide.ravel(), MOST_GATHERED * self.group_ref)
        self.unbroken = np.where(self.rays.water, wide, self.unbroken)

    def _upwave(self, cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Of each cell's four neighbours: the share that comes from it (4, n), its index (4, n)."""
        return self.rays.share[:, cells], cells + np.array(self.rays.steps)[:, None]

    def step(self, cells: np.ndarray) -> None:
        """One generation of breaking: what of the energy that flows in is broken, and what it loses here."""
        share, from_ = self._upwave(cells)
        share = share * np.maximum(self.unbroken[from_], 1e-9)
        share /= np.maximum(share.sum(axis=0), 1e-12)
        delay = (share * self.rays.delay_s[:, cells]).sum(axis=0)
        way, h, group = delay / self.rays.slowness[cells], self.h[cells], self.group[cells]
        flux = self.unbroken[cells] * (share * self.left[from_]).sum(axis=0)
        height = self.offshore_m * np.sqrt(flux / group)
        full, before = height / (self.breaks_at * h), (share * self.fullness[from_]).sum(axis=0)
        hurt = share * self.broken[from_]
        was = hurt.sum(axis=0)
        starts = (full > 1) & (was < 0.5)
        part = np.clip((full - 1) / np.maximum(full - before, 1e-6), 0, 1)  # of the way here that it has been broken
        whole = np.clip((height / (self.stable_at * h) - FORMS_AGAIN) / (STAYS_BROKEN - FORMS_AGAIN), 0, 1)
        calmed = (1 - whole) * -np.expm1(-way / (CALMS_OVER * h))
        broken = np.where(full > 1, 1.0, was * (1 - calmed))
        broken[broken < LEAST_BROKEN] = 0.0
        new = part * delay, height, surf_similarity(self.slope[cells], height, self.found.period_s)
        for state, begun, grows in zip(
            (self.since, self.break_height, self.similarity), new, (delay, 0, 0), strict=True
        ):
            carried = (hurt * state[from_]).sum(axis=0) / np.maximum(was, 1e-12) + grows
            state[cells] = np.where(starts, begun, carried) * (broken > 0)
        stable, limit = (group * (ratio * h / self.offshore_m) ** 2 for ratio in (self.stable_at, self.breaks_at))
        ran = np.where(starts, part, broken) * way
        lost = np.maximum(flux - stable, 0.0) * -np.expm1(-self.decay * ran / h)
        self.left[cells] = np.minimum(flux - lost, limit) / np.maximum(self.unbroken[cells], 1e-12)
        self.fullness[cells], self.broken[cells], self.starts[cells] = full, broken, starts

    def maps(self, depth_m: np.ndarray, runup: str, ahead: Ahead) -> WaveHeights:
        """The state as maps of the level."""
        water = self.found.reached
        height = self._level(self.offshore_m * np.sqrt(self.unbroken * self.left / self.group))
        gathered = self._level(np.sqrt(self.unbroken / self.group_ref))
        since, similarity = self._level(self.since), self._level(self.similarity)
        broken, break_height = self._level(self.broken), self._level(self.break_height)
        spread = [over_land(f, water, 0.0) for f in (height, gathered, broken, since, break_height, similarity)]
        height, gathered, broken, since, break_height, similarity = (f.astype(np.float32) for f in spread)
        breaker = np.where(broken > 0.5, breaker_type(similarity), 0).astype(np.int8)
        starts = self._level(self.starts).copy()
        up = self._runup(np.asarray(depth_m, np.float64), gathered, runup)
        to_break = self._level(ahead.seconds).astype(np.float32)
        next_xi = self._level(ahead.similarity).astype(np.float32)
        return WaveHeights(
            height, gathered, broken, since, break_height, similarity, breaker, starts, up, to_break, next_xi
        )

    def _runup(self, depth_m, gathered, runup: str) -> np.ndarray:
        """Run-up at cells of the water's edge by the slope of the beach there, spread to the nearest cells."""
        water = self.found.reached
        edge = water & ndimage.binary_dilation(depth_m <= 0)
        if not edge.any():
            return np.zeros(water.shape, np.float32)
        north, east = np.gradient(self._smooth(depth_m), self.found.cell_m)
        period_s = self.found.period_s
        deep_group = deep_water_length(period_s) / period_s / 2
        deep_m = self.offshore_m * gathered[edge] * np.sqrt(self.group_ref / deep_group)
        up = np.zeros(water.shape, np.float32)
        up[edge] = RUNUP[runup](np.hypot(north, east)[edge], deep_m, period_s)
        row, col = ndimage.distance_transform_edt(~edge, return_distances=False, return_indices=True)
        return up[row, col]

    def _slope_along(self) -> np.ndarray:
        """tan(beta) of the bed the way the wave goes, flat; a bed that falls away counts as the least slope."""
        turned = self.found.border.turn.into(self._smooth(self.depth_m))
        north, east = np.gradient(turned, self.found.cell_m)
        toward_east, toward_north = self.rays.direction
        along = -(np.pad(east, 1).ravel() * toward_east + np.pad(north, 1).ravel() * toward_north)
        return np.maximum(along, LEAST_SLOPE)

    def _smooth(self, depth_m: np.ndarray) -> np.ndarray:
        sigma = max(1.0, BED_OVER * self._length() / self.found.cell_m)
        return ndimage.gaussian_filter(depth_m, sigma, mode="nearest")

    def _length(self) -> float:
        """Metres from crest to crest beyond the level."""
        return self.found.speed_ref * self.found.period_s

    def _flat(self, field_: np.ndarray) -> np.ndarray:
        """A map of the level as the march has it: turned, padded, flat float64."""
        return np.pad(self.found.border.turn.into(field_).astype(np.float64), 1, mode="edge").ravel()

    def _level(self, flat: np.ndarray) -> np.ndarray:
        return self.found.border.turn.back(flat.reshape(self.rays.shape)[1:-1, 1:-1])


def _none(shape: tuple[int, int]) -> WaveHeights:
    """No wave anywhere."""
    none = np.zeros(shape, np.float32)
    unbroken = np.zeros(shape, np.int8), np.zeros(shape, bool)
    return WaveHeights(*(none,) * 6, *unbroken, none, np.full(shape, AHEAD_S, np.float32), none)


def _spread(flux: np.ndarray, water: np.ndarray, sigma: float) -> np.ndarray:
    """A map smoothed over water only: land takes none."""
    wide = ndimage.gaussian_filter(flux, sigma, mode="nearest")
    return wide / np.maximum(ndimage.gaussian_filter(water, sigma, mode="nearest"), 1e-6)
