"""Lines of a level as a game takes them: rivers and outlines, control points and points of the curve alike."""

from __future__ import annotations

from typing import Any

import numpy as np
from pydantic import Field

from ...level import Level
from ...level.objects import River, SwellRegion
from .data_axes import Frame, clean
from .data_models import Place, Record, vector

CURVE = (
    "Control points and curve. Between points 1 and 2 of 0, 1, 2, 3 (the ends mirrored: p0 = 2 p1 - p2) x and y run "
    "along a centripetal Catmull-Rom spline: with d0, d1, d2 the square roots of the three distances, "
    "m1 = d1 ((p1 - p0) / d0 - (p2 - p0) / (d0 + d1) + (p2 - p1) / d1), "
    "m2 = d1 ((p2 - p1) / d1 - (p3 - p1) / (d1 + d2) + (p3 - p2) / d2), the cubic Hermite curve from p1 with slope m1 "
    "to p2 with slope m2. Width, level and speed run over the number of the point by a monotone cubic (Fritsch and "
    "Carlson 1980, as SciPy's PchipInterpolator). `line` is that curve, a point each metre or less: straight between "
    "them is what the level draws."
)


class Corner(Record):
    place: Place
    engine: Place


class RiverPoint(Corner):
    """`place.z` is the level of the water."""

    width_m: float
    speed_mps: float


class LinePoint(RiverPoint):
    """A point of the curve."""

    along_m: float = Field(description="Way from the first point.")
    at_sea: bool = Field(description="Beyond the last control point, out to sea: how far the river is felt there.")


def corner(frame: Frame, at) -> dict[str, Any]:
    at = clean(at)
    return {"place": vector(at), "engine": vector(frame.place(at))}


def river_points(level: Level, frame: Frame, river: River) -> list[dict[str, Any]]:
    return [
        corner(frame, (river.x + east, river.y + north, level_m)) | {"width_m": width_m, "speed_mps": speed_mps}
        for east, north, width_m, level_m, speed_mps in river.points
    ]


def river_line(level: Level, frame: Frame, river: River) -> list[dict[str, Any]]:
    from ...level.river_line import centre_line  # SciPy

    line = centre_line(river, level.mean_sea_m)
    numbers = clean(np.column_stack([2 * line.half_m, line.speed_mps, line.along_m])).tolist()
    places = np.column_stack([line.x, line.y, line.level_m])
    return [
        corner(frame, at) | {"width_m": w, "speed_mps": v, "along_m": s, "at_sea": n >= line.mouth}
        for n, (at, (w, v, s)) in enumerate(zip(places, numbers, strict=True))
    ]


def outline_corners(level: Level, frame: Frame, region: SwellRegion) -> list[dict[str, Any]]:
    points = np.array(region.outline, float).reshape(-1, 2)
    return [corner(frame, (region.x + east, region.y + north, level.mean_sea_m)) for east, north in points]
