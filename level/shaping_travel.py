"""How times of arrival follow from the bed on their way: rays, and what a change of depth does along them (T07)."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
from scipy import ndimage, sparse

from .arrival import MOST_SIDE, Asked, arrival_map, asked_of
from .arrival_map import SWELLS, ArrivalMap, Passing
from .dispersion import wavenumber
from .level import Level
from .shaping_plate import Plate
from .swell_request import solve_request


def lead_map(asked: Asked) -> ArrivalMap:
    """The map of the leading swell alone, three times; heights are left out."""
    lead = dataclasses.replace(asked.request.swells[0], height_m=0.0)
    found = solve_request(dataclasses.replace(asked.request, swells=(lead,)))
    thrice = dataclasses.replace(asked.request, swells=(lead,) * SWELLS)
    return arrival_map(dataclasses.replace(asked, request=thrice), found * SWELLS)


def delay_by_depth(depth_m: np.ndarray, period_s: float, least_m: float) -> np.ndarray:
    """How the time a swell takes over a metre, s/m, changes with the logarithm of the depth.

    From ω² = g k tanh kh (Airy): dk/d ln h = −k · kh sech² kh / (tanh kh + kh sech² kh).
    """
    depth = np.maximum(depth_m, least_m)
    k = wavenumber(period_s, depth)
    tanh = np.tanh(k * depth)
    bent = k * depth * (1 - tanh**2)
    return np.where(depth_m > least_m, -k * period_s / (2 * np.pi) * bent / (tanh + bent), 0.0)


def ray_rows(
    plate: Plate, made: ArrivalMap, depth_m: np.ndarray, points: np.ndarray, radius_m: float, centre, least_m: float
) -> sparse.csr_array:
    """How the times at `points` (n, 2) follow from the plate's coefficients, s: along rays back to the disc's rim.

    `depth_m` lies on the texels of the map. Rays are those of the bed as it is.
    """
    seconds = made.block(0)[..., 0].astype(np.float64)
    north, east = np.gradient(seconds, made.cell_m)
    delay = delay_by_depth(depth_m.astype(np.float64), made.period_s[0], least_m)
    length = min(plate.step_m, made.cell_m) if radius_m / plate.step_m < 60 else plate.step_m
    place, total = points.astype(np.float64).copy(), None
    live = np.ones(len(points), bool)
    for _ in range(int(2.5 * radius_m / length)):
        at = place[:, 1] / made.cell_m, place[:, 0] / made.cell_m
        way = np.stack([ndimage.map_coordinates(part, at, order=1, mode="nearest") for part in (east, north)], axis=1)
        steep = np.hypot(*way.T)
        live &= (steep > 1e-6) & (np.hypot(*(place - centre).T) < radius_m)
        if not live.any():
            break
        here = ndimage.map_coordinates(delay, at, order=1, mode="nearest") * live * length
        row = sparse.diags_array(here) @ plate.rows(*place.T)
        total = row if total is None else total + row
        place -= way / np.maximum(steep, 1e-6)[:, None] * (length * live)[:, None]
    return sparse.csr_array((len(points), len(plate.free))) if total is None else total.tocsr()


class Times:
    """Times of the leading swell over a bed that is bent, in a coarse map or in the one that is drawn with."""

    def __init__(self, level: Level, t: float, coarse_side: int) -> None:
        self._ask = {False: lambda: asked_of(level, t, coarse_side), True: lambda: asked_of(level, t, MOST_SIDE)}
        self._known: dict[bool, tuple[Asked, ArrivalMap]] = {}
        self._fine = False
        self.now: ArrivalMap | None = None
        self.depth_m = np.zeros((0, 0))

    def _plain(self, fine: bool) -> tuple[Asked, ArrivalMap]:
        """What was asked and answered before anything is bent."""
        if fine not in self._known:
            asked = self._ask[fine]()
            self._known[fine] = asked, lead_map(asked)
        return self._known[fine]

    def solve(self, field: Callable[[Asked], np.ndarray], fine: bool) -> None:
        """Times over depth · e^field; `field` gives it on the texels of what is asked."""
        asked, plain = self._plain(fine)
        bend, self._fine = field(asked), fine
        self.depth_m = asked.request.depth_m * np.exp(bend)
        request = dataclasses.replace(asked.request, depth_m=self.depth_m.astype(np.float32))
        bent = dataclasses.replace(asked, request=request)
        self.now = lead_map(bent) if bend.any() else plain

    def at(self, points: np.ndarray) -> Passing:
        """What passes points (n, 2): known times, plus what the same coarse solver says has changed."""
        passing = self.now.at(*points.T, heights=False)
        if not self._fine:
            known, was = (self._plain(which)[1].at(*points.T, heights=False) for which in (True, False))
            for mine, fine, coarse in ((passing.swells[0], known.swells[0], was.swells[0]),
                                       (passing.shore, known.shore, was.shore)):  # fmt: skip
                mine.v = mine.v + fine.v - coarse.v
        return passing

    def rows(self, plate: Plate, points: np.ndarray, radius_m: float, centre: np.ndarray) -> sparse.csr_array:
        """`ray_rows` over the bed as it is bent."""
        least_m = self._plain(self._fine)[0].request.least_depth_m
        return ray_rows(plate, self.now, self.depth_m, points, radius_m, centre, least_m)
