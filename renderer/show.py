"""SHOW_FLAGS: switches over what is drawn (T11), and what the editor lays over the picture.

Switching one off changes nothing else. A flag with `settings` draws as if that setting were off; the others skip a pass
or are read by shaders as `u_show_NAME`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..level import BadInput, Settings
from ..level.params import get, replace


@dataclass(frozen=True)
class Flag:
    name: str
    label: str
    doc: str
    settings: str = ""
    ids: str = "T11"


SHOW_FLAGS: dict[str, Flag] = {
    flag.name: flag
    for flag in (
        Flag("water", "Water", "The sea; off, its bed lies dry.", "water.on", "T11 D31"),
        Flag("vertex_animation", "Vertex animation", "Shore waves lift the surface.", "shore.vertex", "T11 D10"),
        Flag("shore_waves", "Shore waves", "Waves that run up the beach.", "shore.on", "T11 D03"),
        Flag("gerstner", "Offshore waves", "Gerstner waves on the open sea.", "sea.on", "T11 D11"),
        Flag("procedural_foam", "Procedural foam", "Foam that the waves make.", "", "T11 D04"),
        Flag("painted_foam", "Painted foam", "Foam of the foam layer.", "", "T11"),
        Flag("refraction", "Refraction", "The bed bent by the waves above it.", "", "T11 D02"),
        Flag("reflections", "Reflections", "The land that is seen, mirrored in the sea.", "", "T11 H17"),
        Flag("caustics", "Caustics", "Bright lines that waves draw on the bed.", "caustics.on", "T11 D08 H13"),
        Flag("flow", "Flow", "Foam moves with the current.", "flow.on", "T11 D05"),
        Flag("force", "Force", "Water pushed about by what moves in it.", "force.on", "T11 D18"),
        Flag("shadows", "Shadows", "Shadows of land and scattered things.", "light.shadows"),
        Flag("fog", "Fog", "Haze over distance.", "fog.on", "T11 D38"),
        Flag("air", "Air", "Light that clear air adds and takes over distance.", "", "T11 L02"),
        Flag("clouds", "Clouds", "High cirrus.", "", "T11"),
        Flag("sky", "Sky", "The sky behind everything; off, it is black."),
        Flag("antialias", "Smooth edges", "Edges of single frames smoothed."),
        Flag("things", "Props", "Meshes from files that stand in the level or float.", "things.on", "T11 D12"),
        Flag("scatter", "Scatter", "Rocks, driftwood and grass.", "scatter.on", "T11 L09"),
    )
}


@dataclass(frozen=True)
class Show:
    """Which flags are off."""

    hidden: frozenset[str] = frozenset()

    @classmethod
    def hide(cls, names: str | Iterable[str] = ()) -> Show:
        """From `"water,fog"` or names; BadInput when one is unknown."""
        names = names.split(",") if isinstance(names, str) else names
        hidden = frozenset(name.strip() for name in names if name.strip())
        for name in sorted(hidden - SHOW_FLAGS.keys()):
            raise BadInput(f"nothing to hide is called {name!r}; there are: {', '.join(SHOW_FLAGS)}")
        return cls(hidden)

    def toggled(self, name: str) -> Show:
        """The same with one flag switched."""
        return Show.hide(self.hidden ^ {name})

    def __contains__(self, name: str) -> bool:
        return name not in self.hidden

    def settings(self, settings: Settings) -> Settings:
        """Settings with those switched off that a hidden flag stands for."""
        for name in sorted(self.hidden):
            path = SHOW_FLAGS[name].settings
            if path and get(settings, path):
                settings = replace(settings, path, False)
        return settings

    def uniforms(self) -> dict[str, bool]:
        return {f"u_show_{name}": name in self for name in SHOW_FLAGS}


@dataclass(frozen=True)
class Ring:
    """The brush on the ground: centre and radius in metres, `falloff` 0 (soft from the middle) … 1 (hard edge)."""

    x: float
    y: float
    radius_m: float
    falloff: float = 0.5


CORNERS = ("upper-left", "upper-right", "lower-left", "lower-right")


@dataclass(frozen=True)
class Inset:
    """A view in a corner (T12): `size` of the picture's height; maps are turned clockwise, or so that ahead is up.

    A map shows the level, with `extent_m` so much about the camera; what is no map is shown as it is on the screen.
    """

    view: str = "force"
    corner: str = "upper-left"
    size: float = 0.25
    turn_deg: float = 0.0
    heading: bool = False
    extent_m: float = 0.0

    @classmethod
    def parse(cls, text: str) -> Inset:
        """From `VIEW[:CORNER[:SIZE[:TURN[:METRES]]]]`, TURN degrees or `heading`; BadInput says what is wrong."""
        from .sky_insets import find_inset

        view, corner, size, turn, extent = (*text.split(":"), *[""] * 5)[:5]
        if not find_inset(view).inset:
            raise BadInput(f"{view} is drawn for the whole picture alone, so it cannot be an inset")
        corner = corner or "upper-left"
        if corner not in CORNERS or text.count(":") > 4:
            raise BadInput(
                f"{text!r} is no inset: it is VIEW:CORNER:SIZE:TURN:METRES, CORNER one of {', '.join(CORNERS)}"
            )
        heading = turn == "heading"
        numbers = (size or "0.25", "0" if heading else turn or "0", extent or "0")
        try:
            size_part, turn_deg, extent_m = (float(number) for number in numbers)
        except ValueError:
            raise BadInput(f"{text!r} is no inset: size, turn and metres are numbers, turn may be heading") from None
        if not (0.05 <= size_part <= 1 and -360 <= turn_deg <= 360 and 0 <= extent_m <= 1e6):
            raise BadInput(f"{text!r} is no inset: size is 0.05 to 1, turn −360 to 360, metres 0 to 1,000,000")
        return cls(view, corner, size_part, turn_deg, heading, extent_m)


@dataclass(frozen=True, eq=False)
class Streamlines:
    """Lines on the water (T02), each `(n, 4)`: x, y, metres over the still sea, m/s."""

    lines: tuple


MOST_GHOSTS = 8  # of crests, to either side


@dataclass(frozen=True)
class FrontLines:
    """When fronts pass, drawn on the water (T06); `step_s` lies between two ghosts, `ghosts` of them to either side."""

    crests: bool = False
    ghosts: int = 0
    step_s: float = 1.0
    isochrones_s: float = 0.0  # 0: none
    speed: bool = False
    breakers: bool = False
    slowest_mps: float = 0.0  # of the colours of the speed
    fastest_mps: float = 10.0

    @classmethod
    def parse(cls, text: str) -> FrontLines:
        """From `crests,ghosts:3:0.5,isochrones:2,speed:12,breakers`; BadInput says what is wrong."""
        found: dict = {}
        for word in filter(None, (part.strip() for part in text.split(","))):
            name, *values = word.split(":")
            try:
                found |= _front_words(name, [float(value) for value in values])
            except (ValueError, IndexError):
                raise BadInput(
                    f"{word!r} is no overlay of fronts: crests, ghosts:COUNT:SECONDS, isochrones:SECONDS, speed:MPS and"
                    " breakers are"
                ) from None
        return cls(**found)


def _front_words(name: str, values: list[float]) -> dict:
    """What one word of FrontLines.parse sets; ValueError for what makes no sense."""
    most = {"crests": 0, "ghosts": 2, "isochrones": 1, "speed": 1, "breakers": 0}
    if name not in most or len(values) > most[name] or not all(0 < value <= 1e5 for value in values):
        raise ValueError(name)
    if name == "ghosts":
        count, step = values[0] if values else 2.0, values[1] if len(values) > 1 else 1.0
        if count != int(count) or count > MOST_GHOSTS:
            raise ValueError(name)
        return {"crests": True, "ghosts": int(count), "step_s": step}
    if name == "isochrones":
        return {"isochrones_s": values[0] if values else 2.0}
    if name == "speed":
        return {"speed": True, "fastest_mps": values[0] if values else 10.0}
    return {name: True}


@dataclass(frozen=True)
class Overlays:
    """What is laid over the finished picture."""

    ring: Ring | None = None
    walkable: bool = False  # D31: green to wading depth and slope, red beyond
    outline: bool = False  # the border of the level
    centre: bool = False  # D40: a cross at the centre of the screen
    lines: tuple[tuple[tuple[float, float, float], ...], ...] = ()  # world polylines, such as the ramp's preview
    arrows: bool = False  # T02: the current, drawn on the water
    streamlines: Streamlines | None = None  # T02
    insets: tuple[Inset, ...] = ()  # T12
    fronts: FrontLines | None = None  # T06
