"""Fitting a wave object to the shoreline near it: fronts that come in along a whole bay (H09).

A front that fits the shore has one and the same coordinate all along it: yaw and curvature are those for which the
coordinate differs least over the shoreline's points within the circle (least squares, soft on what doesn't fit, such as
rocks and headlands). Of the two ways that fit alike, seaward and landward, it is the one with the shore ahead.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import least_squares

from .dual import Dual
from .errors import BadInput
from .level import Level
from .objects import WaveObject
from .shore_field import shore_field
from .wave_objects import front_coordinate

FEWEST, MOST = 8, 800  # points of the shoreline that are enough; that are looked at
SOFT = 0.06  # of the radius: a misfit from which on a point counts less and less
SHORE_AHEAD = 0.55  # of the radius: where the shore lies before an object that is moved to it
YAWS_DEG, BENDS = np.arange(0, 360, 10.0), np.linspace(-1, 1, 9)


def shoreline(level: Level, x: float, y: float, radius_m: float) -> np.ndarray:
    """World points (n, 2) of the sea's shoreline within a circle, where the distance to it changes sign."""
    field = shore_field(level, now=True)
    rows, cols = field.distance_m.shape
    first = [max(int((v - radius_m) / field.cell_m) - 1, 0) for v in (x, y)]
    last = [min(int((v + radius_m) / field.cell_m) + 2, side) for v, side in ((x, cols), (y, rows))]
    if last[0] - first[0] < 2 or last[1] - first[1] < 2:
        return np.zeros((0, 2))
    part = field.distance_m[first[1] : last[1], first[0] : last[0]]
    found = []
    for axis in range(2):
        a, b = (part[:-1], part[1:]) if axis == 0 else (part[:, :-1], part[:, 1:])
        row, col = np.nonzero((a > 0) != (b > 0))
        share = a[row, col] / (a[row, col] - b[row, col])
        found.append(np.stack([col + (share if axis else 0), row + (0 if axis else share)], -1))
    points = (np.concatenate(found) + first) * field.cell_m
    points = points[np.hypot(points[:, 0] - x, points[:, 1] - y) < radius_m]
    return points[:: max(len(points) // MOST, 1)]


def _misfit(thing: WaveObject, points: np.ndarray, weight: np.ndarray, yaw_deg: float, bend: float):
    """How far each point is off the front that fits best on the whole, metres; and where that front is."""
    tried = thing.model_copy(update={"curvature": float(bend)})
    yaw = np.radians(yaw_deg)
    q, way_x, way_y = front_coordinate(
        tried, np.sin(yaw), np.cos(yaw), Dual(points[:, 0], 1.0, 0.0), Dual(points[:, 1], 0.0, 1.0)
    )
    middle = np.sum(weight * q.v) / np.sum(weight)
    # a blend of straight and ring is shorter than a metre a metre: metres of the ground count
    return (q.v - middle) / np.maximum(np.hypot(way_x.v, way_y.v), 0.3), float(middle)


def fit_to_shore(level: Level, thing: WaveObject, place: bool = False) -> dict[str, float]:
    """Yaw and curvature (with `place` x and y too) for fronts along the shore near an object; BadInput without one."""
    points = shoreline(level, thing.x, thing.y, thing.radius_m)
    if len(points) < FEWEST:
        raise BadInput(
            f"{thing.id} has no shore within its radius of {thing.radius_m:g} m: move it nearer or make it larger"
        )
    away = np.hypot(points[:, 0] - thing.x, points[:, 1] - thing.y) / thing.radius_m
    weight = np.maximum(1 - away**2, 0.05)  # what lies where its waves stand counts
    soft_m = SOFT * thing.radius_m

    def cost(yaw_deg: float, bend: float) -> float:
        off, middle = _misfit(thing, points, weight, yaw_deg, bend)
        return float(np.sum(weight * np.log1p((off / soft_m) ** 2))) if middle > 0 else np.inf

    start = min(((yaw, bend) for yaw in YAWS_DEG for bend in BENDS), key=lambda pair: cost(*pair))
    found = least_squares(
        lambda v: np.sqrt(weight) * _misfit(thing, points, weight, v[0] * 30, v[1])[0],
        (start[0] / 30, start[1] * 0.98), bounds=((-np.inf, -1.0), (np.inf, 1.0)), loss="cauchy", f_scale=soft_m,
    )  # fmt: skip
    yaw_deg, bend = float(found.x[0] * 30), float(found.x[1])
    values = {"yaw_deg": round((yaw_deg + 180) % 360 - 180, 1) + 0.0, "curvature": round(bend, 3) + 0.0}
    if place:
        ahead = _misfit(thing, points, weight, yaw_deg, bend)[1] - SHORE_AHEAD * thing.radius_m
        values["x"] = round(thing.x + ahead * float(np.sin(np.radians(yaw_deg))), 2)
        values["y"] = round(thing.y + ahead * float(np.cos(np.radians(yaw_deg))), 2)
    return values
