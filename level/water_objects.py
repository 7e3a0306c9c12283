"""Objects of the water: what moves it, how its waves come, what colours it, where it runs."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field, field_validator

from .params import param
from .placed import Placed

MOST_OUTLINE = 16  # points


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
