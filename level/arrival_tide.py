"""Maps of arrival under a tide (T06): solved at some levels of the sea, a straight line in between.

Where one of two neighbouring levels has land and the other sea, the lower map takes the times of the higher one,
shifted by what the two differ at the nearest water of both: the beach between is crossed as at high water, only later.
Heights there grow from none, and are at most `timing.breaker` · `timing.tide_step_m` / 4 off.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from scipy import ndimage

from .arrival_map import HEIGHTS, SWELLS, TIMES, ArrivalMap
from .settings import Settings
from .tide import band_m

if TYPE_CHECKING:
    from .arrival import Asked
    from .level import Level

SLOTS = 8  # maps that an editor has asked for at once: crests before and after stand in other levels of the sea
KEPT = 4  # pairs


def all_levels_m(settings: Settings) -> np.ndarray:
    """Tides at which maps are solved, rising: low water, whole steps from the mean level, high water."""
    low_m, high_m = band_m(settings)
    step_m = settings.timing.tide_step_m
    inner = step_m * np.arange(np.ceil(low_m / step_m), np.floor(high_m / step_m) + 1)
    return np.unique(np.round([low_m, *inner, high_m], 6))


def levels_m(settings: Settings, tide_m) -> tuple[float, ...]:
    """Those of them that enclose a tide (or all of an array): one where it stands on one."""
    levels = all_levels_m(settings)
    first = int(np.searchsorted(levels, np.min(tide_m) + 1e-6, side="right")) - 1
    last = int(np.searchsorted(levels, np.max(tide_m) - 1e-6, side="left"))
    first = max(first, 0)
    return tuple(float(v) for v in levels[first : max(min(last, len(levels) - 1), first) + 1])


class TideMaps:
    """What a level keeps of its maps of several sea levels."""

    def __init__(self) -> None:
        self._joined: dict[tuple, tuple] = {}  # by ids of what it was made of: (that, the map at its lowest level)
        self._tall: dict[int, ArrivalMap] = {}  # by slot: the last map that had heights
        self._last: tuple[ArrivalMap, tuple[float, ...]] | None = None

    def of(self, maps: list[ArrivalMap], rises_m: tuple[float, ...], tide_m) -> ArrivalMap:
        """The map of a tide (or one a point) between the levels that maps are of."""
        key = tuple(map(id, maps))
        if key not in self._joined:
            self._joined[key] = maps, joined(maps)
            for old in list(self._joined)[:-KEPT]:
                del self._joined[old]
        self._last = self._joined[key][1], rises_m
        return self._at(tide_m)

    def latest(self, tide_m) -> ArrivalMap | None:
        """The last good maps at a tide, as not settled."""
        return None if self._last is None else replace(self._at(tide_m), settled=False)

    def _at(self, tide_m) -> ArrivalMap:
        made, rises_m = self._last
        if len(rises_m) == 1:
            return made
        rise = np.interp(tide_m, rises_m, np.arange(len(rises_m)))
        return replace(made, rise=rise if np.ndim(tide_m) else float(rise))

    def lent(self, level: Level, tide_m, asked: Callable[[float], Asked]) -> ArrivalMap | None:
        """The same by an editor's solver: the last good maps till it has those of the two levels that count now.

        Of an array of tides nothing is asked for.
        """
        rises_m = levels_m(level.settings, tide_m)
        if len(rises_m) > 2:
            return self.latest(tide_m)
        order, found = all_levels_m(level.settings).tolist(), []
        for rise_m in rises_m:
            slot, request = order.index(rise_m) % SLOTS, asked(rise_m)
            made = level.solver.beside(f"arrivals {slot}", request.key, lambda request=request: request)
            if made is not None and made.block(HEIGHTS).any():
                self._tall[slot] = made
            elif made is not None and slot in self._tall:
                made = self._with_heights(made, slot)
            found.append(made)
        known = [made for made in found if made is not None]
        whole = len(known) == len(found) and len({made.shape for made in known}) == 1
        if not whole and (self._last is not None or not known):
            return self.latest(tide_m)
        made = self.of(known if whole else known[:1], rises_m if whole else (0.0,), tide_m)
        return made if whole and not level.live else replace(made, settled=False)

    def _with_heights(self, made: ArrivalMap, slot: int) -> ArrivalMap:
        """Times under the brush with the heights from before, one object for one pair."""
        tall, kept = self._tall[slot], self._joined
        key = (id(made), id(tall))
        if key not in kept:
            kept[key] = (made, tall), made.with_rest(tall.rest_at(made.shape))
        return kept[key][1]


def joined(maps: list[ArrivalMap]) -> ArrivalMap:
    """One map of several sea levels, the lowest first."""
    first, *above = [_with_beach(low, high) for low, high in pairwise(maps)] + maps[-1:]
    return replace(first, above=tuple(above))


def _with_beach(low: ArrivalMap, high: ArrivalMap) -> ArrivalMap:
    """The lower of two maps, with times where only the higher one has water."""
    rows, packed = low.shape[0], low.packed.copy()
    for i in range(SWELLS):
        both = low.reached[..., i] & high.reached[..., i]
        dry = ~low.reached[..., i]
        if not both.any() or not dry.any():
            continue
        later = low.block(TIMES)[..., i] - high.block(TIMES)[..., i]
        row, col = ndimage.distance_transform_edt(~both, return_distances=False, return_indices=True)
        shifted = high.block(TIMES)[..., i] + later[row, col]
        packed[:rows, :, i][dry] = shifted[dry]
    return replace(low, packed=packed)
