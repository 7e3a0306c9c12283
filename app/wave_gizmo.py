"""The gizmo of a wave object or region: rings, an arrow, curved fronts that move with the clock, handles (H08, H09).

Handles are points of the world that the pointer takes with the tool Select: *size* on the ring, *aim* at the arrow's
tip, *bend* on the front through the object's place. A region with an outline has its points instead of the ring, and
between two of them one that becomes a point; a point drawn onto the one beside it is gone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..level import Level
from ..level.objects import Camera, Placed, SwellRegion, WaveObject
from ..level.outline import points_of, whole_line, whole_m, with_point, without_point
from ..level.pick import ground_at
from ..level.water_objects import MOST_OUTLINE
from ..level.wave_objects import CENTRE, inner_m, object_fronts, phase_cycles
from .camera_control import to_screen
from .object_markers import on_surface

KINDS = (WaveObject, SwellRegion)
REACH_PX = 11.0
ARROW, BEND_AT = 0.5, -0.6  # of the radius: the arrow's length, where across the bend's handle is
MOST_FRONTS = 24
JOINED = 0.25  # of the way between the points beside it: so near to one of them a point becomes one with it
ACROSS = np.linspace(-1, 1, 49)


@dataclass(frozen=True)
class Line:
    """World points (n, 3) and how strongly they are drawn."""

    points: np.ndarray
    alpha: float
    width: float


def yaw_of(level: Level, thing: Placed) -> float:
    """Where the waves go to, radians clockwise from north."""
    turned = level.settings.sea.swell_heading_deg + getattr(thing, "turn_deg", 0.0)
    return float(np.radians(getattr(thing, "yaw_deg", turned)))


def axes(level: Level, thing: Placed) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors along the waves' way and across it, to the right."""
    yaw = yaw_of(level, thing)
    return np.array([np.sin(yaw), np.cos(yaw)]), np.array([np.cos(yaw), -np.sin(yaw)])


def bent(curvature: float, radius_m: float, q_m: float, across_m: np.ndarray) -> np.ndarray:
    """Where along the way a front at coordinate q_m is, by how far across (Newton); nan where it isn't."""
    centre_m = np.copysign(CENTRE * radius_m, curvature)
    straight, along = 1 - abs(curvature), np.full_like(across_m, q_m, dtype=float)
    for _ in range(12):
        r = np.maximum(np.hypot(along + centre_m, across_m), 1e-6)
        off = straight * along + curvature * (r - CENTRE * radius_m) - q_m
        slope = np.maximum(straight + curvature * (along + centre_m) / r, 0.05)
        along = np.clip(along - off / slope, -2 * radius_m, 2 * radius_m)
    return np.where(np.abs(off) < 1e-3 * radius_m, along, np.nan)


def lines(level: Level, thing: Placed, time_s: float) -> list[Line]:
    """What is drawn of a wave object or region besides its ring and marker."""
    if not isinstance(thing, KINDS):
        return []
    if isinstance(thing, SwellRegion) and thing.outline:
        inner = [Line(on_surface(level, line), 0.4, 1.1) for line in whole_line(thing)]
        return [*inner, *_arrow(level, thing)]
    turn = np.linspace(0, 2 * np.pi, 73)
    whole = whole_m(thing) if isinstance(thing, SwellRegion) else inner_m(thing)
    inner = np.column_stack([np.cos(turn), np.sin(turn)]) * whole + (thing.x, thing.y)
    fronts = _fronts(level, thing, time_s) if isinstance(thing, WaveObject) else []
    arrow = [] if getattr(thing, "ring", False) else _arrow(level, thing)
    return [Line(on_surface(level, inner), 0.4, 1.1), *arrow, *fronts]


def _arrow(level: Level, thing: Placed) -> list[Line]:
    along, across = axes(level, thing)
    foot, size_m = np.array([thing.x, thing.y]), _size_m(thing)
    tip, barb = foot + ARROW * size_m * along, 0.07 * size_m
    head = np.array([tip - barb * along - 0.6 * barb * across, tip, tip - barb * along + 0.6 * barb * across])
    shaft = foot + np.linspace(0, 1, 9)[:, None] * (tip - foot)
    return [Line(on_surface(level, shaft), 0.9, 2.0), Line(on_surface(level, head), 0.9, 2.0)]


def _size_m(thing: Placed) -> float:
    """Of its circle; with an outline of one about as large."""
    if not getattr(thing, "outline", ()):
        return thing.radius_m
    return float(np.hypot(*points_of(thing.outline).T).mean())


def _fronts(level: Level, thing: WaveObject, time_s: float) -> list[Line]:
    """The crests of the lead front within the circle at a moment, fainter towards its edge."""
    if thing.ring:
        return _rings(level, thing, time_s)
    along, across = axes(level, thing)
    phase = float(phase_cycles(object_fronts(thing, level.settings.level.seed), time_s)[0])
    count = 2 * thing.radius_m / thing.length_m
    every = max(int(np.ceil(count / MOST_FRONTS)), 1)
    found = []
    for n in range(-int(count) - 2, int(count) + 2):
        if n % every:
            continue
        q_m = thing.length_m * (n + 0.25 + phase)
        beside = ACROSS * thing.radius_m
        ahead = bent(thing.curvature, thing.radius_m, q_m, beside)
        places = (thing.x, thing.y) + ahead[:, None] * along + beside[:, None] * across
        wet = ground_at(level, *np.nan_to_num(places).T) < level.sea_level_m
        for run in _runs(wet & (np.hypot(ahead, beside) < thing.radius_m)):  # nan is not within
            at = places[run]
            nearest = float(np.hypot(ahead[run], beside[run]).min())
            share = np.clip((thing.radius_m - nearest) / max(thing.radius_m - inner_m(thing), 1e-6), 0, 1)
            found.append(Line(on_surface(level, at, 0.15), 0.15 + 0.6 * float(share), 1.4))
    return found


def _rings(level: Level, thing: WaveObject, time_s: float) -> list[Line]:
    """The rings of the lead front that are on their way out at a moment."""
    phase = float(phase_cycles(object_fronts(thing, level.settings.level.seed), time_s)[0])
    radii = thing.length_m * (np.arange(int(thing.radius_m / thing.length_m) + 2) + 0.25 + phase)
    turn = np.linspace(0, 2 * np.pi, 73)
    found = []
    for radius_m in radii[radii < thing.radius_m][:MOST_FRONTS]:
        share = float(np.clip((thing.radius_m - radius_m) / max(thing.radius_m - inner_m(thing), 1e-6), 0, 1))
        at = np.column_stack([np.cos(turn), np.sin(turn)]) * radius_m + (thing.x, thing.y)
        found.append(Line(on_surface(level, at, 0.15), 0.15 + 0.6 * share, 1.4))
    return found


def _runs(inside: np.ndarray) -> list[slice]:
    edges = np.flatnonzero(np.diff(inside.astype(np.int8), prepend=0, append=0))
    return [slice(a, b) for a, b in zip(edges[::2], edges[1::2], strict=True) if b - a > 1]


# Handles


def handles(level: Level, thing: Placed | None) -> dict[str, np.ndarray]:
    """World points (3,) by what dragging them changes; {} for what is no wave."""
    if not isinstance(thing, KINDS):
        return {}
    along, across = axes(level, thing)
    places = {"size": across * thing.radius_m, "aim": along * ARROW * _size_m(thing)}
    if getattr(thing, "outline", ()):
        del places["size"]
        points = points_of(thing.outline)
        places |= {f"point {i}": point for i, point in enumerate(points)}
        if len(points) < MOST_OUTLINE:
            between = 0.5 * (points + np.roll(points, -1, axis=0))
            places |= {f"between {i}": point for i, point in enumerate(between)}
    if getattr(thing, "ring", False):
        del places["aim"]
    elif isinstance(thing, WaveObject):
        beside = BEND_AT * thing.radius_m
        ahead = bent(thing.curvature, thing.radius_m, 0.0, np.array([beside]))[0]
        places["bend"] = beside * across + np.nan_to_num(ahead) * along
    at = on_surface(level, np.array([*places.values()]) + np.array([thing.x, thing.y]))
    return dict(zip(places, at, strict=True))


def handle_at(level: Level, camera: Camera, size: tuple[int, int], thing: Placed | None, where) -> str:
    """Which handle a pixel means, "" for none."""
    found = handles(level, thing)
    if not found:
        return ""
    pixels, ahead = to_screen(camera, size, np.array(list(found.values())))
    away = np.where(ahead, np.hypot(*(pixels - np.array(where)).T), np.inf)
    return list(found)[int(np.argmin(away))] if away.min() < REACH_PX else ""


def dragged(level: Level, thing: Placed, handle: str, x: float, y: float) -> dict:
    """What an object's fields become when a handle is drawn to world x, y."""
    off = np.array([x - thing.x, y - thing.y])
    away = float(np.hypot(*off))
    if handle.startswith(("point", "between")):
        kind, number = handle.split()
        return {"outline": _drawn(thing.outline, int(number), off, kind == "between")}
    if handle == "size":
        row = type(thing).model_fields["radius_m"].metadata
        low, high = (next(getattr(m, name) for m in row if hasattr(m, name)) for name in ("ge", "le"))
        return {"radius_m": round(min(max(away, low), high), 2)}
    if handle == "aim":
        if away < 1e-3:
            return {}
        yaw_deg = float(np.degrees(np.arctan2(off[0], off[1])))
        if isinstance(thing, WaveObject):
            return {"yaw_deg": round(yaw_deg, 1)}
        return {"turn_deg": round((yaw_deg - level.settings.sea.swell_heading_deg + 180) % 360 - 180, 1)}
    along, across = axes(level, thing)
    return {"curvature": round(curvature_through(thing.radius_m, float(off @ along), float(off @ across)), 3)}


def _drawn(outline: tuple[float, ...], number: int, to: np.ndarray, new: bool) -> tuple[float, ...]:
    """An outline with a point drawn elsewhere, or without it where that is on one beside it."""
    points = points_of(outline)
    beside = points[number], points[(number + 1) % len(points)]
    if not new:
        beside = points[number - 1], points[(number + 1) % len(points)]
    near = min(float(np.hypot(*(to - one))) for one in beside) < JOINED * float(np.hypot(*(beside[1] - beside[0])))
    if not near:
        return with_point(outline, number, (float(to[0]), float(to[1])), new)
    return outline if new or len(points) < 4 else without_point(outline, number)


def curvature_through(radius_m: float, along_m: float, across_m: float) -> float:
    """The curvature whose front through the object's place goes through a point too, −1 … 1."""
    beside_m = max(abs(across_m), 0.15 * radius_m)  # near the middle a hair would bend it wholly
    back_m = abs(along_m)  # how far the front has fallen behind there, or, concave, come ahead: one and the same
    if back_m < 1e-9:
        return 0.0
    ring_m = np.hypot(CENTRE * radius_m - back_m, beside_m) - CENTRE * radius_m
    share = back_m / (back_m + ring_m) if back_m + ring_m > back_m else 1.0
    return float(-np.copysign(share, along_m))
