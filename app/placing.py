"""PLACEABLES: what can be placed in a level, one row each; where it comes, and with what it starts.

Menu and palette place in the middle of the picture, tools where one clicks (tools.py), the panel *Objects* through
both. Every placing is a step to undo and a word of the script.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..level import BadInput, Level
from ..level.framing import stand_at
from ..level.objects import OBJECT_KINDS
from ..level.pick import ground_at, pick_ray
from ..level.water_table import optics_table
from ..renderer.camera import pick
from .session import Session

FARTHEST_M = 50_000.0


@dataclass(frozen=True)
class Placeable:
    """A row: `start` begins its ids, `up_m` is how far over ground or sea it comes; `clicks` tools drop it."""

    name: str
    kind: str
    start: str
    title: str
    glyph: str
    doc: str
    up_m: float = 0.0
    clicks: bool = True


PLACEABLES: dict[str, Placeable] = {
    row.name: row
    for row in (
        Placeable("prop", "prop", "prop", "Prop", "cube", "A mesh of the level; over water it floats (D12)."),
        Placeable("mover", "mover", "mover", "Mover", "person_swimming", "Wades in a circle, stirs the water (D18)."),
        Placeable("burst", "disturbance", "burst", "Burst", "burst", "The water bursts here at this moment (D18)."),
        Placeable("pin", "pin", "pin", "Pin", "thumbtack", "A crest is here at this moment (T07)."),
        Placeable("hit", "hit", "hit", "Hit", "bullseye", "Something struck the water at this moment (H19)."),
        Placeable("lamp", "light", "lamp", "Lamp", "lightbulb", "A point light (D01).", 3.0),
        Placeable("flow_point", "flow_point", "flow", "Flow point", "arrows_to_dot", "The current runs to here (D06)."),
        Placeable("view_circle", "view_circle", "view", "View circle", "circle_dot",
                  "An extreme viewpoint: the sea's mesh covers all of these circles (H01)."),
        Placeable("sea_patch", "sea_patch", "patch", "Sea patch", "vector_square", "Kind of sea of a hectare (H27)."),
        Placeable("wave", "wave", "wave", "Wave object", "water",
                  "Waves of its own in a circle, straight or curved (H08 H09)."),
        Placeable("wave_region", "wave_region", "region", "Wave region", "bullseye",
                  "Where the sea's own waves are higher, longer or turned: a circle or outline (D32)."),
        Placeable("river", "river", "river", "River", "bridge_water",
                  "A river from here down to the sea; then its points are drawn about (D13)."),
        Placeable("sea_seed", "sea_seed", "seed", "Sea seed", "droplet", "Water here counts as sea."),
        Placeable("weather_key", "weather_key", "weather", "Weather", "cloud_sun",
                  "Weather that comes at this moment, everywhere or over its circle (D36).", clicks=False),
        Placeable("probe", "probe", "probe", "Probe", "wave_square",
                  "Watches the water here: its height over time, when crests come (T06)."),
        Placeable("marker", "marker", "marker", "Marker", "bookmark", "This moment, with a name (T05).", clicks=False),
        Placeable("camera", "camera", "camera", "Camera", "video", "This view, kept.", clicks=False),
        Placeable("shot", "shot", "shot", "Shot", "clapperboard",
                  "The sky as it is now, kept for 20 s of the clock (Z20).", clicks=False),
        Placeable("water_table", "water_table", "water", "Water table", "swatchbook",
                  "The water's colour as gradient stops, in use at once (H15).", clicks=False),
    )
}  # fmt: skip
BY_KIND: dict[str, Placeable] = {row.kind: row for row in PLACEABLES.values()}


def surface_m(level: Level, x: float, y: float) -> float:
    """Height of the ground, or of the still sea over it."""
    return max(float(ground_at(level, x, y)), level.sea_level_m)


def meets_surface(level: Level, origin, ray) -> tuple[float, float, float] | None:
    """Where a ray from a world point (3,) first meets ground or still sea; None where it meets neither nearby."""
    ground = pick_ray(level, origin, ray)
    if ground is not None and ground[2] >= level.sea_level_m:
        return ground
    fall = level.sea_level_m - origin[2]
    if abs(ray[2]) < 1e-4 or fall / ray[2] <= 0 or fall / ray[2] > FARTHEST_M:
        return ground
    way = fall / ray[2]
    return float(origin[0] + way * ray[0]), float(origin[1] + way * ray[1]), level.sea_level_m


def looked_at(session: Session) -> tuple[float, float, float]:
    """Ground or sea in the middle of the picture; where only sky is there, the middle of the level."""
    found = pick(session.level, session.camera, (16, 9), 8.0, 4.5)
    if found is not None:
        return tuple(float(v) for v in found)
    x, y = (side / 2 for side in session.level.grid.extent_m)
    return x, y, stand_at(session.level, x, y)


def free_name(session: Session, start: str) -> str:
    """`start-1`, or the next number that no object has."""
    taken, number = session.level.objects, 1
    while f"{start}-{number}" in taken:
        number += 1
    return f"{start}-{number}"


def put(session: Session, name: str, at: tuple[float, float, float] | None = None, merge: bool = False) -> str:
    """Place a row of PLACEABLES at a world point, or where one looks, and select it; returns its id, "" for none."""
    row = PLACEABLES[name]
    x, y, _ = at or looked_at(session)
    thing_id = free_name(session, row.start)
    if name == "water_table":
        session.place(optics_table(thing_id, session.level.settings.water), use=True)
    elif name == "shot":
        session.shot_add(thing_id)
    elif name == "camera":
        session.place(session.camera.model_copy(update={"id": thing_id}), merge)
    elif name == "river":
        session.river_begin(thing_id, x, y)
    elif name == "prop":
        thing_id = _put_prop(session, thing_id, x, y, merge)
    else:
        session.place(_started(session, row, thing_id, x, y), merge)
    session.selected = thing_id
    return thing_id


def _started(session: Session, row: Placeable, thing_id: str, x: float, y: float) -> dict:
    """A new object with its kind's defaults, over the surface, at the clock's time where it has one."""
    thing = {"kind": row.kind, "id": thing_id, "x": round(x, 2), "y": round(y, 2)}
    fields = OBJECT_KINDS[row.kind].model_fields
    if "z" in fields:
        thing["z"] = round(surface_m(session.level, x, y) + row.up_m, 2)
    if "time_s" in fields:
        thing["time_s"] = round(session.clock.time_s, 3)
    return thing


def _put_prop(session: Session, thing_id: str, x: float, y: float, merge: bool) -> str:
    """A prop with the mesh in hand, afloat where water is; without any mesh the window asks for a file."""
    from .prop_edits import prop_at

    meshes = session.level.meshes
    if not meshes:
        session.ask("prop")
        return ""
    mesh = session.mesh if session.mesh in meshes else next(reversed(meshes))
    fields = {"id": thing_id}
    if float(ground_at(session.level, x, y)) < session.level.sea_level_m:
        fields |= {"floats": True, "z": round(session.level.sea_level_m, 3)}
    session.place(prop_at(session.level, mesh, x, y, fields), merge)
    return thing_id


def duplicate(session: Session) -> None:
    """The selected object once more, beside it."""
    thing = session.object(session.selected)
    name = free_name(session, thing.id.rstrip("0123456789").rstrip("-") or thing.id)
    beside = {"id": name, "x": thing.x + 4.0, "y": thing.y - 4.0} if not thing.placeless else {"id": name}
    session.place(thing.model_copy(update=beside))
    session.selected = name


def delete(session: Session) -> None:
    """Remove the selected object, or the point of it that is in hand."""
    thing = session.level.objects.get(session.selected)
    if getattr(thing, "points", ()) and 0 <= session.river_point < len(thing.points):
        session.river_delete(thing.id, session.river_point)
        session.river_point = -1
        return
    session.remove(session.selected)
    session.selected = ""


def turn(session: Session, degrees: float) -> None:
    """Turn the selected object about the vertical, where its kind can be turned."""
    thing = session.object(session.selected)
    if not hasattr(thing, "yaw_deg"):
        raise BadInput(f"{thing.id} has no direction to turn to")
    session.alter(thing.id, {"yaw_deg": turned(thing.yaw_deg, degrees)})


def turned(yaw_deg: float, degrees: float) -> float:
    """An angle turned on, −180 … 180."""
    return (yaw_deg + degrees + 180.0) % 360.0 - 180.0
