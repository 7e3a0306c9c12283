"""Where placed objects show in the viewport: a marker each, rings for what they reach, and which one a pixel means."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..level import Level
from ..level.objects import Camera, Placed
from ..level.outline import outline_line
from ..level.patches import PATCH_M
from ..level.pick import ground_at
from .camera_control import place, to_screen
from .placing import BY_KIND

REACH_PX = 15.0  # a click this near a marker means it
TOO_NEAR_M = 2.0  # a marker that sits in the eye, such as that of the camera one looks through
RINGS = ("radius_m", "circle_m", "orbit_m")  # fields that say how far an object reaches


@dataclass(frozen=True)
class Marker:
    """One object: its marker stands at `place`, its foot on ground or sea under it, world metres."""

    id: str
    glyph: str
    place: tuple[float, float, float]
    foot: tuple[float, float, float]


def markers(level: Level) -> list[Marker]:
    """A marker for everything that has a place."""
    things = [thing for thing in level.objects.values() if not thing.placeless]
    if not things:
        return []
    x, y = (np.array([getattr(thing, axis) for thing in things]) for axis in "xy")
    foot = np.maximum(ground_at(level, x, y), level.sea_level_m)
    return [
        Marker(thing.id, _glyph(thing), (thing.x, thing.y, _height(thing, float(z))), (thing.x, thing.y, float(z)))
        for thing, z in zip(things, foot, strict=True)
    ]


def _glyph(thing: Placed) -> str:
    return "sailboat" if getattr(thing, "floats", False) else BY_KIND[thing.kind].glyph


def _height(thing: Placed, surface_m: float) -> float:
    """Its own height where that counts; what floats is where the sea is."""
    return surface_m if getattr(thing, "floats", False) else float(getattr(thing, "z", surface_m))


def shown(level: Level, camera: Camera, size: tuple[int, int]) -> list[tuple[Marker, np.ndarray]]:
    """Markers inside a picture of `size` with their pixels (2,), the farthest first."""
    found = markers(level)
    if not found:
        return []
    places = np.array([marker.place for marker in found])
    pixels, ahead = to_screen(camera, size, places)
    away = np.linalg.norm(places - place(camera), axis=1)
    seen = ahead & (away > TOO_NEAR_M) & (pixels >= 0).all(axis=1) & (pixels <= np.array(size)).all(axis=1)
    return [(found[i], pixels[i]) for i in np.argsort(-away) if seen[i]]


def at_pixel(level: Level, camera: Camera, size: tuple[int, int], where: tuple[float, float]) -> str:
    """The id of the object whose marker is nearest to a pixel, "" where none is near."""
    near = [(float(np.hypot(*(pixel - where))), marker.id) for marker, pixel in shown(level, camera, size)]
    away, name = min(near, default=(REACH_PX, ""))
    return name if away < REACH_PX else ""


def on_surface(level: Level, xy: np.ndarray, lift_m: float = 0.05) -> np.ndarray:
    """World points (n, 3) on ground or still sea over places (n, 2)."""
    z = np.maximum(ground_at(level, xy[:, 0], xy[:, 1]), level.sea_level_m) + lift_m
    return np.column_stack([xy, z])


def outlines(level: Level, thing: Placed) -> list[np.ndarray]:
    """Closed lines (n, 3) on the surface: how far an object reaches, or the hectare it stands for."""
    lines = []
    turn = np.linspace(0, 2 * np.pi, 73)
    for field in RINGS:
        radius_m = 0.0 if getattr(thing, "outline", ()) else getattr(thing, field, 0.0)
        if radius_m > 0:
            ring = np.column_stack([np.cos(turn), np.sin(turn)]) * radius_m + (thing.x, thing.y)
            lines.append(on_surface(level, ring))
    if getattr(thing, "outline", ()):
        lines.append(on_surface(level, outline_line(thing)))
    if thing.kind == "sea_patch":
        corner = np.floor(np.array([thing.x, thing.y]) / PATCH_M) * PATCH_M
        part = np.linspace(0, 1, 11)[:-1]
        edge = np.column_stack([part, np.zeros(10)])
        square = np.concatenate([edge, [(1.0, 0.0)] + edge[:, ::-1], (1.0, 1.0) - edge, (0.0, 1.0) - edge[:, ::-1]])
        lines.append(on_surface(level, corner + PATCH_M * np.vstack([square, square[:1]])))
    return lines


def heading(level: Level, thing: Placed, length_m: float) -> np.ndarray | None:
    """A line (2, 3) from an object the way it looks; None where its kind has no direction."""
    if not hasattr(thing, "yaw_deg"):
        return None
    foot = on_surface(level, np.array([[thing.x, thing.y]]))[0]
    start = np.array([thing.x, thing.y, _height(thing, float(foot[2]))])
    yaw = np.radians(thing.yaw_deg)
    return np.array([start, start + length_m * np.array([np.sin(yaw), np.cos(yaw), 0.0])])
