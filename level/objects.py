"""Things placed in a level, each with an id; one line each in the file."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, Literal, Union

from pydantic import Field, TypeAdapter

from .loop import looped
from .params import param
from .placed import Placed as Placed
from .water_objects import (
    Disturbance,
    FlowPoint,
    Hit,
    Mover,
    Pin,
    River,
    SeaPatch,
    SwellRegion,
    ViewCircle,
    WaterTable,
    WaveObject,
)  # fmt: skip


class Camera(Placed):
    """A place to look from, and how."""

    kind: Literal["camera"] = "camera"
    z: float = param(20.0, -1e5, 1e5, "m", "Up, from height zero of the level.")
    yaw_deg: float = param(0.0, -360, 360, "°", "Where it looks, clockwise from north.")
    pitch_deg: float = param(-30.0, -90, 90, "°", "How far it looks up; negative looks down.")
    fov_deg: float = param(45.0, 5, 120, "°", "Vertical field of view.")


class SeaSeed(Placed):
    """A point whose water counts as sea, for lagoons that the open edge doesn't reach."""

    kind: Literal["sea_seed"] = "sea_seed"


class PointLight(Placed):
    """A lamp: inverse square up to a radius (D01). It may go round in a circle with the clock."""

    kind: Literal["light"] = "light"
    z: float = param(3.0, -1e5, 1e5, "m", "Up, from height zero of the level.")
    red: float = param(1.0, 0, 1, "", "Share of red light.")
    green: float = param(0.75, 0, 1, "", "Share of green light.")
    blue: float = param(0.45, 0, 1, "", "Share of blue light.")
    power_kcd: float = param(5.0, 0, 1000, "kcd", "Luminous intensity.", soft=(0, 100))
    radius_m: float = param(25.0, 0.5, 500, "m", "Where its light ends.", soft=(2, 100))
    orbit_m: float = param(0.0, 0, 500, "m", "Radius of the circle it goes round its place.", soft=(0, 20))
    period_s: float = param(8.0, 0.5, 1000, "s", "Time of one turn.", soft=(2, 60))

    def place(self, t: float, loop_s: float = 0.0) -> tuple[float, float, float]:
        """Where it is at time t, world metres; its turns divide a loop."""
        turn = 2 * math.pi * ((t / looped(self.period_s, loop_s)) % 1.0)
        return self.x + self.orbit_m * math.sin(turn), self.y + self.orbit_m * math.cos(turn), self.z


class Prop(Placed):
    """A mesh that stands in the level, or floats (D12). Its mesh lies in the level's folder."""

    kind: Literal["prop"] = "prop"
    mesh: str = Field("", pattern=r"^[A-Za-z0-9_]{0,80}$", description="Name of its mesh among those of the level.")
    z: float = param(0.0, -1e5, 1e5, "m", "Height of its origin; a floating thing finds its own.")
    yaw_deg: float = param(0.0, -360, 360, "°", "Turned about the vertical, clockwise from north.")
    pitch_deg: float = param(0.0, -90, 90, "°", "Bow up.")
    roll_deg: float = param(0.0, -180, 180, "°", "Heeled to the right.")
    scale: float = param(1.0, 0.001, 1000, "×", "Size.", soft=(0.1, 10))
    floats: bool = param(False, doc="It floats on the waves.")
    density: float = param(
        0.45, 0.02, 1.5, "", "Share of its height that lies under water; from 1 on it sinks.", soft=(0.1, 1)
    )
    dry: bool = param(True, doc="No sea is drawn inside its hull.")
    drifts: bool = param(False, doc="The current takes it along; else it stays at its mooring.")
    ripples: bool = param(True, doc="It draws rings on the water.")


class Shot(Placed):
    """A sky painted for one shot: from start to end it takes the simulation's place (Z20)."""

    placeless: ClassVar[bool] = True
    kind: Literal["shot"] = "shot"
    map: str = Field("", pattern=r"^[A-Za-z0-9_]{0,80}$", description="Name of its sky among those of the level.")
    camera: str = Field(
        "", pattern=r"^[A-Za-z0-9_.-]{0,64}$", description="The camera whose picture has it; empty for all of them."
    )
    start_s: float = param(0.0, 0, 1e7, "s", "When it begins to come up.", soft=(0, 600))
    end_s: float = param(20.0, 0, 1e7, "s", "When it is gone.", soft=(0, 600))
    fade_s: float = param(2.0, 0, 1e5, "s", "How long it takes to come and to go.", soft=(0, 60))
    drifts: bool = param(True, doc="Its sky goes with the wind from its start on; off, it stands.")
    painted: bool = param(True, doc="The painted sky lies over it; off, its sky is all of it.")
    whole: bool = param(False, doc="It reaches to the horizon; off, the horizon's own sky stands round it.")


class WeatherKey(Placed):
    """Weather that comes at a moment of the clock, faded from what was before (D36).

    With a radius it acts on the sky over its circle alone: coverage, type and precipitation. Waves, wind, temperature
    and storms are the whole level's.
    """

    kind: Literal["weather_key"] = "weather_key"
    time_s: float = param(0.0, 0, 1e7, "s", "When it begins to come.")
    fade_s: float = param(60.0, 1, 1e6, "s", "How long it takes to come.", soft=(10, 600))
    weather: Literal["calm", "breeze", "overcast", "drizzle", "gale", "storm", "snow"] = param(
        "breeze", doc="Which weather; `shorewright weathers` lists them."
    )
    radius_m: float = param(
        0.0, 0, 35_000, "m", "Its circle, where it changes the sky alone; 0: everywhere, waves and wind too.",
        soft=(0, 15_000),
    )  # fmt: skip


class Marker(Placed):
    """A named moment of the clock, to go back to (T05)."""

    placeless: ClassVar[bool] = True
    kind: Literal["marker"] = "marker"
    time_s: float = param(0.0, 0, 1e9, "s", "The moment.", soft=(0, 600))


class Probe(Placed):
    """A point whose water is watched: its height over time, and when crests come (T06)."""

    kind: Literal["probe"] = "probe"
    rise_m: float = param(
        0.1, 0, 20, "m", "How far a crest rises over the troughs beside it; smaller ones don't count.", soft=(0, 1)
    )


_KINDS = (
    Camera, SeaSeed, Disturbance, FlowPoint, ViewCircle, SeaPatch, WaveObject, SwellRegion, WaterTable, PointLight,
    Prop, Hit, Mover, WeatherKey, Shot, Marker, Probe, Pin,
    River,
)  # fmt: skip
OBJECT_KINDS = {row.model_fields["kind"].default: row for row in _KINDS}
Object = Annotated[Union[*OBJECT_KINDS.values()], Field(discriminator="kind")]
OBJECT = TypeAdapter(Object)
