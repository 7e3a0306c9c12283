"""What can be set on a brush: one section a brush, each parameter declared once (range, unit, sentence)."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator

from ..level.params import Section, param
from . import alphas, masks


class BrushParams(Section):
    """What every brush has."""

    size_m: float = param(12.0, 0.01, 100_000, "m", "Radius.", soft=(1, 150))
    strength: float = param(0.5, 0, 1, "", "How much of the effect is put on.")
    falloff: float = param(0.7, 0, 1, "", "Part of the radius over which the brush fades: 0 a hard edge, 1 all of it.")
    spacing: float = param(0.1, 0.02, 1, "radii", "Way between two dabs.", soft=(0.05, 0.5))
    opacity: float = param(1.0, 0, 1, "", "What one stroke can do at most, however often it crosses itself.")

    @property
    def inner_m(self) -> float:
        """Radius of the part that has full strength, for the inner ring of the cursor."""
        return self.size_m * (1 - self.falloff)


class LimitedParams(BrushParams):
    """What brushes have that work on the level's own grid."""

    only_where: Annotated[str, AfterValidator(masks.checked)] = param(
        "", doc="Limits of the brush, such as `depth_m 0..2 ~0.5; flow_mps 1..`: source, range, fade.")  # fmt: skip


class AlphaParams(LimitedParams):
    """What brushes have whose dab may have the shape of a picture."""

    alpha: Annotated[str, AfterValidator(alphas.checked)] = param(
        "", doc="A picture, packed, that shapes the dab in place of the falloff.")  # fmt: skip
    alpha_turn: Literal["fixed", "along", "random"] = param(
        "fixed", doc="Its up stays north, goes the way of the stroke, or is another for each dab.")  # fmt: skip
    alpha_angle_deg: float = param(0.0, -180, 180, "°", "Turned clockwise by this.")
    alpha_seed: int = param(1, 0, 1_000_000, "", "Which of the random ways.", soft=(0, 100))


class Paced(Section):
    """What brushes have that sculpt the bed under a front."""

    even_pace: float = param(0.0, 0, 1, "", "How far the bed under the brush comes to run evenly along the way of the"
                             " waves, so that fronts keep their speed.")  # fmt: skip


class RaiseParams(AlphaParams, Paced):
    strength: float = param(1.0, 0, 1000, "m", "What a stroke adds at full pressure.", soft=(0.05, 10))


class SmoothParams(AlphaParams, Paced):
    strength: float = param(0.5, 0, 1, "", "Share of the detail that goes with a click, and with each radius of way.")
    detail: float = param(0.2, 0.01, 1, "radii", "Size of the detail that is smoothed away.", soft=(0.05, 0.5))


class FlattenParams(AlphaParams):
    strength: float = param(1.0, 0, 1, "", "How far the ground comes to the level at which the stroke began.")
    side: Literal["both", "cut", "fill"] = param("both", doc="Move ground both ways, only down, or only up.")


class RampParams(LimitedParams, Paced):
    size_m: float = param(15.0, 0.01, 100_000, "m", "Half the width.", soft=(2, 150))
    strength: float = param(1.0, 0, 1, "", "How far the ground comes to the grade.")
    falloff: float = param(0.5, 0, 1, "", "Part of the half width over which the shoulders meet the ground.")
    side: Literal["both", "cut", "fill"] = param("both", doc="Move ground both ways, only down, or only up.")


class PaintParams(AlphaParams):
    size_m: float = param(8.0, 0.01, 100_000, "m", "Radius.", soft=(1, 100))
    strength: float = param(0.8, 0, 2, "", "What a stroke changes at full pressure; the layer goes from −1 to 1.")
    mode: Literal["add", "remove", "reset"] = param("add", doc="Put more there, clear it, or leave it to the rules.")


class SkyParams(Section):
    """What is painted on the weather map: targets are its numbers (Z04), each channel can be left as it is."""

    mode: Literal["set", "add", "erase", "smooth"] = param(
        "set",
        doc="Bring the sky to the targets (Ctrl erases), add to what is there (Ctrl takes away), erase the paint: the"
        " simulation comes back (Ctrl sets), or smooth the paint.",
    )
    paint_coverage: bool = param(True, doc="Paint how much cloud there is.")
    coverage: float = param(0.7, 0, 1, "", "Target: 0 a clear sky, 1 all of it covered.")
    paint_precipitation: bool = param(True, doc="Paint where it rains.")
    precipitation: float = param(0.0, 0, 1, "", "Target: 0 dry; 1 rains, and whatever is there becomes a thundercloud.")
    paint_type: bool = param(True, doc="Paint which clouds there are.")
    type: float = param(0.8, 0, 1, "", "Target: 0 flat stratus, 1 heaped cumulus.")
    step: float = param(0.25, 0.01, 1, "", "What the mode add adds in a stroke, or takes away.")


class WeatherParams(BrushParams, SkyParams):  # in this order panels show what is painted first
    size_m: float = param(4000.0, 0.01, 40_000, "m", "Radius.", soft=(100, 40_000))
    strength: float = param(1.0, 0, 1, "", "How far the sky comes to what is painted at full pressure.")


class MapChoice(Section):
    """What is painted on foam, masks and covers (T03)."""

    onto: Literal[
        "foam.transient", "foam.constant", "foam", "river_foam.stagnant", "river_foam.turbulent", "river_foam",
        "puddle_keepout", "shelter", "snow", "ice", "corruption", "yielding", "quiet", "mouth",
    ] = param("foam.constant", doc="The layer, or one channel of it, that is painted.")  # fmt: skip
    mode: Literal["add", "remove", "set", "smooth", "reset"] = param(
        "add", doc="Put more there or take away (Ctrl does the other), bring it to the target (Ctrl to nothing), smooth"
        " it, or bring it back to nothing.")  # fmt: skip
    target: float = param(1.0, -1, 1, "", "What the mode set brings it to; below nothing only waves in rivers go.")


class MapParams(AlphaParams, MapChoice):
    size_m: float = param(8.0, 0.01, 100_000, "m", "Radius.", soft=(1, 100))
    strength: float = param(0.5, 0, 1, "", "What a stroke adds at full pressure, or its share of the way there.")
    build_up: bool = param(False, doc="Each dab does its share, so that rubbing goes on; opacity is the most it does.")


class WaterParams(LimitedParams):
    size_m: float = param(6.0, 0.01, 100_000, "m", "Radius.", soft=(1, 60))
    falloff: float = param(0.2, 0, 1, "", "Part of the radius over which the brush fades; water has a hard edge in it.")
    mode: Literal["level", "follow"] = param(
        "level", doc="Level, as high as where the stroke began, or going down with the ground.")  # fmt: skip
    depth_m: float = param(0.6, 0.03, 100, "m", "How deep it is where it is painted on dry ground.", soft=(0.1, 3))


class FlowChoice(Section):
    """What the flow brush does (T02)."""

    mode: Literal["replace", "add", "erase", "smooth", "rotate", "comb", "coherent"] = param(
        "replace", doc="Lay the way of the stroke down in place of the current or add it (Ctrl takes away), erase,"
        " smooth, turn by the angle, comb it along the shore, or on release make it coherent: as much water leaves each"
        " place as comes.")  # fmt: skip
    speed_mps: float = param(1.0, 0, 20, "m/s", "Speed that is painted.", soft=(0, 5))
    pressure: Literal["speed", "amount"] = param("speed", doc="What the pen's pressure sets.")
    click: Literal["as_water", "heading", "away", "towards"] = param(
        "as_water", doc="What a click without a way paints: the way the water already runs, the heading, away from the"
        " place or towards it.")  # fmt: skip
    heading_deg: float = param(0.0, 0, 360, "°", "Where a click sends still water, clockwise from north.")
    angle_deg: float = param(45.0, -180, 180, "°", "What rotate turns by, clockwise; Ctrl turns the other way.")


class FlowParams(AlphaParams, FlowChoice):
    size_m: float = param(12.0, 0.01, 100_000, "m", "Radius.", soft=(1, 100))
    strength: float = param(1.0, 0, 1, "", "How far the current comes to what is painted.")
