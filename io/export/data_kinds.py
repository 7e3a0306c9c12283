"""What is told of each kind of object beside its own parameters: one row a fact, by the level's own functions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from pydantic import Field

from ...level import Level
from ...level.loop import looped
from ...level.objects import OBJECT_KINDS
from . import data_lines as lines
from .data_axes import Frame, clean
from .data_models import Record, Vector, vector

IN_TIME = ("weather_key", "shot", "marker")  # kinds that NAME_keys.json holds


class Front(Record):
    """One of an object's three fronts, q metres along its way from the object's place.

    Height amplitude_m sin a, to the side along the way lateral_m cos a, a = 2 pi (q / length_m - start - rate_hz t).
    """

    east: float = Field(description="Where it goes, unit length.")
    north: float
    length_m: float
    rate_hz: float
    start: float
    amplitude_m: float
    lateral_m: float


class Stop(Record):
    """What light has become after so many metres of water."""

    depth_m: float
    red: float = Field(description="What is left of red light.")
    green: float
    blue: float
    added_red: float = Field(description="Light that the water adds of it, as an albedo.")
    added_green: float
    added_blue: float


class HullPoint(Record):
    """A point of a hull's footprint in the mesh's own axes, x starboard, y ahead."""

    x: float
    y: float


@dataclass(frozen=True)
class Fact:
    """A field: its type, a sentence, and how it follows from a level and a thing."""

    kind: str
    name: str
    type: Any
    doc: str
    make: Callable[[Level, Frame, Any], Any]


def _fronts(level: Level, frame: Frame, thing) -> list[dict[str, float]]:
    from ...level.wave_objects import object_fronts

    fronts = object_fronts(thing, level.settings.level.seed)
    columns = np.column_stack([
        fronts.east, fronts.north, fronts.length_m, fronts.omega / (2 * np.pi), fronts.begin, fronts.amplitude_m,
        fronts.lateral_m,
    ])  # fmt: skip
    return [dict(zip(Front.model_fields, row, strict=True)) for row in clean(columns, 9).tolist()]


def _full_depth(level: Level, frame: Frame, thing) -> float:
    from ...level.wave_objects import full_depth_m

    return float(clean(full_depth_m(level.settings.sea, thing)))


def _inner(level: Level, frame: Frame, thing) -> float:
    from ...level.wave_objects import inner_m

    return float(clean(inner_m(thing)))


def _hull(level: Level, frame: Frame, prop) -> list[dict[str, float]]:
    from ...level.buoyancy import hull_points

    return [{"x": x, "y": y} for x, y in clean(hull_points(level, prop)).tolist()] if prop.floats else []


def _lid(level: Level, frame: Frame, prop) -> list[dict[str, float]]:
    from ...level.buoyancy import draft_of
    from ...level.hull_lid import lid
    from ...level.meshes import mesh_of

    if not (prop.floats and prop.dry):
        return []
    mesh = mesh_of(level, prop)
    found = lid(mesh, round(float(mesh.box[0, 2]) + draft_of(level, prop) / prop.scale, 6))
    return [vector(corner) for corner in clean(prop.scale * found.vertices)] if found else []


def _draft(level: Level, frame: Frame, prop) -> float:
    from ...level.buoyancy import draft_of

    return float(clean(draft_of(level, prop))) if prop.floats else 0.0


def _box(corner: int):
    def made(level: Level, frame: Frame, prop) -> dict[str, float]:
        from ...level.meshes import mesh_of

        return vector(clean(prop.scale * mesh_of(level, prop).box[corner]))

    return made


def _turn(level: Level, frame: Frame, light) -> float:
    return looped(light.period_s, level.settings.time.loop_s)


def _turns(level: Level, frame: Frame, mover) -> float:
    return float(clean(mover.speed_mps / (2 * np.pi * mover.circle_m), 9)) if mover.circle_m else 0.0


def _stops(level: Level, frame: Frame, table) -> list[dict[str, float]]:
    return [dict(zip(Stop.model_fields, stop, strict=True)) for stop in table.stops]


def _hectare(end: int):
    def made(level: Level, frame: Frame, patch) -> dict[str, Any]:
        from ...level.patches import PATCH_M

        at = ((value // PATCH_M + end) * PATCH_M for value in (patch.x, patch.y))
        return lines.corner(frame, (*at, level.mean_sea_m))

    return made


FACTS: tuple[Fact, ...] = (
    Fact("wave", "inner_m", float, "Up to here from its place its waves stand whole; they end at radius_m.", _inner),
    Fact("wave", "full_depth_m", float, "Depth of water from which on its waves stand whole.", _full_depth),
    Fact("wave", "fronts", list[Front], "Its three fronts, the leading one first.", _fronts),
    Fact("wave_region", "corners", list[lines.Corner], "Its outline, closed from last to first; none: a circle.",
         lines.outline_corners),
    Fact("river", "points", list[lines.RiverPoint], lines.CURVE, lines.river_points),
    Fact("river", "line", list[lines.LinePoint], "Its curve, out to sea included.", lines.river_line),
    Fact("water_table", "stops", list[Stop], "By depth; between two of them linear.", _stops),
    Fact("sea_patch", "south_west", lines.Corner, "Corner of its hectare, at the mean sea.", _hectare(0)),
    Fact("sea_patch", "north_east", lines.Corner, "The opposite corner.", _hectare(1)),
    Fact("light", "turn_s", float, "Time of a turn, with the loop of the clock counted in: at t it stands at "
         "x + orbit_m sin a, y + orbit_m cos a, a = 2 pi t / turn_s.", _turn),
    Fact("mover", "turn_hz", float, "Turns a second, clockwise: at t it stands at x + circle_m sin a, y + circle_m cos "
         "a, a = 2 pi turn_hz t; 0: it stands.", _turns),
    Fact("prop", "draft_m", float, "How much of its height lies under water; 0: it doesn't float.", _draft),
    Fact("prop", "low", Vector, "Lowest corner of its mesh's box, metres in the mesh's axes, scale counted in.",
         _box(0)),
    Fact("prop", "high", Vector, "Highest corner.", _box(1)),
    Fact("prop", "hull", list[HullPoint], "Points under it: it lies on the plane of least squares through the water's "
         "height less draft_m at these, its underside (low.z) on that plane; no point gets under the ground.", _hull),
    Fact("prop", "lid", list[Vector], "Corners of a flat lid inside it, over its water line, in the mesh's axes: "
         "through it one sees the hull's inside: draw no sea there. None: it is no open hull, or not dry.", _lid),
)  # fmt: skip


def kinds(in_time: bool) -> dict[str, type]:
    """The kinds of objects that a file of what lies in space, or in time, holds."""
    return {kind: model for kind, model in OBJECT_KINDS.items() if (kind in IN_TIME) == in_time}
