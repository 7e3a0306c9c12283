"""Objects placed where the camera looks, as menu and palette do it: steps to undo, words of the script."""

from __future__ import annotations

from ..level.framing import stand_at
from ..level.water_table import optics_table
from ..renderer.camera import pick
from .session import Session

LAMP_UP_M = 3.0


def looked_at(session: Session) -> tuple[float, float, float]:
    """The ground in the middle of the picture; where only sky is there, the middle of the level."""
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


def flow_point(session: Session) -> None:
    """The current runs to here (D06)."""
    x, y, _ = looked_at(session)
    session.place({"kind": "flow_point", "id": free_name(session, "flow"), "x": round(x, 2), "y": round(y, 2)})


def lamp(session: Session) -> None:
    """A point light over here (D01)."""
    x, y, z = looked_at(session)
    up = max(z, session.level.sea_level_m) + LAMP_UP_M
    where = {"x": round(x, 2), "y": round(y, 2), "z": round(up, 2)}
    session.place({"kind": "light", "id": free_name(session, "lamp"), **where})


def mover(session: Session) -> None:
    """Something wades in a circle here and stirs the water (D18)."""
    x, y, _ = looked_at(session)
    session.place({"kind": "mover", "id": free_name(session, "mover"), "x": round(x, 2), "y": round(y, 2)})


def burst(session: Session) -> None:
    """The water bursts here at the clock's time (D18)."""
    x, y, _ = looked_at(session)
    name, time_s = free_name(session, "burst"), round(session.clock.time_s, 3)
    session.place({"kind": "disturbance", "id": name, "x": round(x, 2), "y": round(y, 2), "time_s": time_s})


def water_table(session: Session) -> None:
    """A table that looks like the water does now (one step), and its use from now on (another) (H15)."""
    name = free_name(session, "water")
    session.place(optics_table(name, session.level.settings.water))
    session.set("water.table", name)
