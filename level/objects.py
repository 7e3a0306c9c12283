"""Things placed in a level, each with an id; one line each in the file."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, Literal, Self, Union

from pydantic import Field, TypeAdapter, field_validator

from .loop import looped
from .params import Section, param

MOST_OUTLINE = 16  # points


class Placed(Section):
    """What every object has: an id of its own, and a place in world metres."""

    id: str = Field(pattern=r"^[A-Za-z0-9_.-]{1,64}$", description="Name, unique in the level.")
    placeless: ClassVar[bool] = False  # it stands nowhere: x and y mean nothing
    x: float = param(0.0, -1e6, 1e6, "m", "East.")
    y: float = param(0.0, -1e6, 1e6, "m", "North.")

    def moved(self, east_m: float, north_m: float) -> Self:
        """The same thing elsewhere, as a crop needs when the origin of its level moves."""
        return self if self.placeless else self.model_copy(update={"x": self.x + east_m, "y": self.y + north_m})


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


class FlowPoint(Placed):
    """A place that the current runs to (D06)."""

    kind: Literal["flow_point"] = "flow_point"
    speed_mps: float = param(0.6, -10, 10, "m/s", "Speed towards it; negative runs away from it.", soft=(-2, 2))
    radius_m: float = param(80.0, 1, 20_000, "m", "How far it reaches.", soft=(10, 500))


class ViewCircle(Placed):
    """How far the sea is seen from an extreme viewpoint: the mesh covers all of these circles (H01)."""

    kind: Literal["view_circle"] = "view_circle"
    radius_m: float = param(400.0, 10, 20_000, "m", "View distance from there.", soft=(50, 1000))


class SeaPatch(Placed):
    """What the hectare of sea round a point is, whatever the distance to the shore says (H01, H27).

    Open: no shore waves. Coastal: the sheet doesn't slide on the beach. Beach: drawn with all, as it comes by itself.
    Removed: nothing is drawn.
    """

    kind: Literal["sea_patch"] = "sea_patch"
    sea: Literal["open", "coastal", "beach", "removed"] = param(
        "removed", doc="Kind of sea there; removed: none is drawn."
    )


class WaveObject(Placed):
    """Waves of an artist's own in a circle, placed like a light: three fronts, straight or curved (H08, H09)."""

    kind: Literal["wave"] = "wave"
    yaw_deg: float = param(0.0, -360, 360, "°", "Where its fronts go to, clockwise from north.")
    radius_m: float = param(90.0, 5, 2000, "m", "Where its waves end.", soft=(20, 300))
    falloff: float = param(0.6, 0, 1, "", "Share of the radius over which they fade.")
    amplitude_m: float = param(0.8, 0, 8, "m", "Their height over the still sea.", soft=(0, 2))
    lateral: float = param(0.8, 0, 1, "", "How sharply crests are drawn together.")
    ring: bool = param(False, doc="Rings that run out from its middle, as under a waterfall or over a spring.")
    inverted: bool = param(False, doc="Upside down: round tops and sharp hollows, as of water that bubbles up.")
    length_m: float = param(28.0, 1, 600, "m", "Their wavelength.", soft=(4, 120))
    speed: float = param(1.0, 0, 4, "×", "Their speed against deep-water dispersion.", soft=(0.25, 2))
    curvature: float = param(
        0.6, -1, 1, "", "How fronts bend: 1 like rings from a point behind, 0 straight, −1 closing in on one ahead."
    )
    seed: int = param(0, 0, 999, "", "Another number, another small difference between its three fronts.", soft=(0, 9))


class SwellRegion(Placed):
    """A circle or outline in which the sea's own waves are higher, longer, faster or turned (D32)."""

    kind: Literal["wave_region"] = "wave_region"
    radius_m: float = param(120.0, 5, 20_000, "m", "Where the sea is its own again.", soft=(20, 500))
    outline: tuple[float, ...] = param(
        (), doc="Points of an outline in place of the circle, by turns metres east and north of its place; 3 to 16."
    )
    falloff: float = param(
        0.6, 0, 1, "", "Share of the radius, or of the way to an outline's middle, over which it fades."
    )
    outside: float = param(0.0, 0, 1, "", "Share of that which lies outside the circle or outline.")
    amplitude: float = param(2.0, 0, 8, "×", "Height of waves within; 0: none.", soft=(0, 3))
    length: float = param(1.0, 0.25, 4, "×", "Their wavelength.", soft=(0.5, 2))
    speed: float = param(1.0, 0, 4, "×", "Their speed, besides what the wavelength makes of it.", soft=(0.25, 2))
    turn_deg: float = param(0.0, -180, 180, "°", "How far they are turned, clockwise.")

    @field_validator("outline")
    @classmethod
    def _is_outline(cls, outline: tuple[float, ...]) -> tuple[float, ...]:
        """Nothing, or three to sixteen points whose sides don't cross."""
        if not outline:
            return outline
        if len(outline) % 2 or not 6 <= len(outline) <= 2 * MOST_OUTLINE:
            raise ValueError(f"an outline has 3 to {MOST_OUTLINE} points, two numbers each")
        if not all(abs(value) <= 20_000 for value in outline):
            raise ValueError("a point of an outline lies within 20000 m of its place")
        from shapely import Polygon

        shape = Polygon([outline[i : i + 2] for i in range(0, len(outline), 2)])
        if not shape.is_valid or shape.area < 1.0:
            raise ValueError("the sides of an outline don't cross, and it holds a square metre or more")
        return outline


class WaterTable(Placed):
    """What metres of water do to light, as gradient stops (H15); `water.table` names the one in use."""

    placeless: ClassVar[bool] = True
    kind: Literal["water_table"] = "water_table"
    stops: tuple[tuple[float, float, float, float, float, float, float], ...] = Field(
        ((0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0), (200.0, 0.0, 0.0, 0.0, 0.0, 0.03, 0.06)),
        description="Metres of water, what is left of red, green, blue, and light it adds of each as an albedo.",
    )

    @field_validator("stops")
    @classmethod
    def _in_order(cls, stops):
        """Sorted by metres; a stop outside its range is refused."""
        if len(stops) < 2:
            raise ValueError("a water table needs two stops or more")
        if not all(0 <= stop[0] <= 1000 and all(0 <= v <= 1 for v in stop[1:]) for stop in stops):
            raise ValueError("a stop is metres from 0 to 1000 and six numbers from 0 to 1")
        return tuple(sorted(stops))


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


class Hit(Placed):
    """Something small that struck the water at one moment and drew a ring (H19)."""

    kind: Literal["hit"] = "hit"
    time_s: float = param(0.0, 0, 1e7, "s", "When it struck.")
    size: float = param(1.0, 0.01, 20, "×", "How hard.", soft=(0.1, 4))


class Pin(Placed):
    """A crest is here at this moment (T07): one pin shifts all waves in time, several bend them."""

    kind: Literal["pin"] = "pin"
    time_s: float = param(0.0, 0, 1e7, "s", "When a crest is here.")


class Mover(Placed):
    """Something that wades in a circle and stirs the water (D18)."""

    kind: Literal["mover"] = "mover"
    circle_m: float = param(4.0, 0, 200, "m", "Radius of its circle.", soft=(0.5, 30))
    speed_mps: float = param(2.0, -20, 20, "m/s", "Its speed along it.", soft=(-6, 6))
    radius_m: float = param(0.6, 0.1, 20, "m", "How broad it is.", soft=(0.2, 4))


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


class River(Placed):
    """A river: a line of points that it runs along, from its spring to its mouth (D13)."""

    kind: Literal["river"] = "river"
    points: tuple[tuple[float, float, float, float, float], ...] = Field(
        ((0.0, 0.0, 8.0, 1.0, 1.0), (60.0, 0.0, 8.0, 0.5, 1.0)),
        description="Metres east and north of its place, width in m, level of the water in m, speed in m/s.",
    )
    depth_m: float = param(1.2, 0.1, 30, "m", "How deep its bed is carved in the middle.", soft=(0.3, 5))
    reach_m: float = param(60.0, 0, 2000, "m", "How far out to sea it is felt.", soft=(0, 200))

    @field_validator("points")
    @classmethod
    def _runs(cls, points):
        """Two points or more, each of some width, downhill, never across themselves."""
        from .river_line import wrong_with

        if wrong := wrong_with(points):
            raise ValueError(wrong)
        return points


_KINDS = (
    Camera, SeaSeed, Disturbance, FlowPoint, ViewCircle, SeaPatch, WaveObject, SwellRegion, WaterTable, PointLight,
    Prop, Hit, Mover, WeatherKey, Shot, Marker, Probe, Pin,
    River,
)  # fmt: skip
OBJECT_KINDS = {row.model_fields["kind"].default: row for row in _KINDS}
Object = Annotated[Union[*OBJECT_KINDS.values()], Field(discriminator="kind")]
OBJECT = TypeAdapter(Object)
