"""Things placed in a level, each with an id; one line each in the file."""

from __future__ import annotations

from typing import Annotated, Literal, Self, Union

from pydantic import Field, TypeAdapter

from .params import Section, param


class Placed(Section):
    """What every object has: an id that never changes, and a place in world metres."""

    id: str = Field(pattern=r"^[A-Za-z0-9_.-]{1,64}$", description="Name, unique in the level.")
    x: float = param(0.0, -1e6, 1e6, "m", "East.")
    y: float = param(0.0, -1e6, 1e6, "m", "North.")

    def moved(self, east_m: float, north_m: float) -> Self:
        """The same thing elsewhere, as a crop needs when the origin of its level moves."""
        return self.model_copy(update={"x": self.x + east_m, "y": self.y + north_m})


class Camera(Placed):
    kind: Literal["camera"] = "camera"
    z: float = param(20.0, -1e5, 1e5, "m", "Up, from height zero of the level.")
    yaw_deg: float = param(0.0, -360, 360, "°", "Where it looks, clockwise from north.")
    pitch_deg: float = param(-30.0, -90, 90, "°", "How far it looks up; negative looks down.")
    fov_deg: float = param(45.0, 5, 120, "°", "Vertical field of view.")


class SeaSeed(Placed):
    """A point whose water counts as sea, for lagoons that the open edge doesn't reach."""

    kind: Literal["sea_seed"] = "sea_seed"


class Disturbance(Placed):
    """A recorded push on the water at one moment; simulations replay it when they settle."""

    kind: Literal["disturbance"] = "disturbance"
    time_s: float = param(0.0, 0, 1e7, "s", "When it happens.")
    radius_m: float = param(3.0, 0.1, 200, "m", "How far it reaches.")
    strength: float = param(1.0, -20, 20, "m/s", "Speed it gives the water.")


OBJECT_KINDS = {row.model_fields["kind"].default: row for row in (Camera, SeaSeed, Disturbance)}
Object = Annotated[Union[*OBJECT_KINDS.values()], Field(discriminator="kind")]
OBJECT = TypeAdapter(Object)
