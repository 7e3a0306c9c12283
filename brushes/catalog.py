"""BRUSHES: every brush, one row each: what happens × where × how samples become dabs × on which layer."""

from __future__ import annotations

from dataclasses import dataclass

from pydantic import ValidationError

from ..level.errors import BadInput
from ..level.layers import LAYERS
from ..level.params import Section, sentence
from .effects import Effect
from .effects.flatten import Flatten
from .effects.flow import FlowPaint
from .effects.lift import Lower, Raise
from .effects.maps import Maps
from .effects.paint import Paint
from .effects.ramp import Ramp
from .effects.smooth import Smooth
from .effects.water import Water
from .effects.weather import Weather
from .footprint import Footprint, Round, Strip
from .params import (
    FlattenParams,
    FlowParams,
    MapParams,
    PaintParams,
    RaiseParams,
    RampParams,
    SmoothParams,
    WaterParams,
    WeatherParams,
)
from .path import AlongPath, LinePath


@dataclass(frozen=True)
class Brush:
    """A row. `inverse` names what it does with Ctrl held; `channels` of the layer, all when empty."""

    name: str
    label: str
    key: str
    effect: type[Effect]
    footprint: type[Footprint]
    path: type[AlongPath] | type[LinePath]
    layer: str
    params: type[Section]
    doc: str
    inverse: str = ""
    channels: tuple[str, ...] = ()

    def with_params(self, values: dict | None = None) -> Section:
        """The parameters with some of them set; BadInput names the one that cannot be."""
        try:
            return self.params.model_validate(values or {})
        except ValidationError as error:
            raise BadInput(f"the brush {self.name}: {sentence(error, 'parameter')}") from None

    def target(self, params: Section, effect: type[Effect] | None = None) -> tuple[str, tuple[int, ...]]:
        """The layer that is painted and which of its channels, by the brush's own effect or that of another."""
        picked = self.effect.target(params)
        if picked:
            names = LAYERS[picked[0]].channels
            return picked[0], tuple(names.index(name) for name in picked[1] or names)
        return self.layer, (effect or self.effect).channels(params, self.channel_numbers)

    @property
    def channel_numbers(self) -> tuple[int, ...]:
        names = LAYERS[self.layer].channels
        return tuple(names.index(name) for name in self.channels or names)


BRUSHES: dict[str, Brush] = {
    row.name: row
    for row in (
        Brush(
            "raise",
            "Raise",
            "1",
            Raise,
            Round,
            AlongPath,
            "height",
            RaiseParams,
            "Lifts the ground; a stroke that crosses itself lifts no more. Ctrl lowers.",
            inverse="Lower",
        ),
        Brush(
            "lower",
            "Lower",
            "2",
            Lower,
            Round,
            AlongPath,
            "height",
            RaiseParams,
            "Digs the ground; a stroke that crosses itself digs no deeper. Ctrl raises.",
            inverse="Raise",
        ),
        Brush(
            "smooth",
            "Smooth",
            "3",
            Smooth,
            Round,
            AlongPath,
            "height",
            SmoothParams,
            "Takes small shapes away, the more the longer it is rubbed. Ctrl sharpens.",
            inverse="Sharpen",
        ),
        Brush(
            "flatten",
            "Flatten",
            "4",
            Flatten,
            Round,
            AlongPath,
            "height",
            FlattenParams,
            "Brings the ground to the height at which the stroke began. Ctrl drives it away from there.",
            inverse="Exaggerate",
        ),
        Brush(
            "ramp",
            "Ramp",
            "5",
            Ramp,
            Strip,
            LinePath,
            "height",
            RampParams,
            "A straight grade from press to release: steeper slows a wave, flatter lets it run. Ctrl only digs.",
            inverse="Cut ramp",
        ),
        Brush(
            "rocks",
            "Rocks",
            "6",
            Paint,
            Round,
            AlongPath,
            "scatter",
            PaintParams,
            "Boulders, stones and cobbles, more of them than the rules lay out. Ctrl clears them.",
            inverse="Clear rocks",
            channels=("rocks",),
        ),
        Brush(
            "driftwood",
            "Wood",
            "7",
            Paint,
            Round,
            AlongPath,
            "scatter",
            PaintParams,
            "Logs and branches washed ashore. Ctrl clears them.",
            inverse="Clear driftwood",
            channels=("driftwood",),
        ),
        Brush(
            "tufts",
            "Tufts",
            "8",
            Paint,
            Round,
            AlongPath,
            "scatter",
            PaintParams,
            "Dune grass and tussocks that the wind moves. Ctrl clears them.",
            inverse="Clear tufts",
            channels=("grass",),
        ),
        Brush(
            "weather",
            "Weather",
            "9",
            Weather,
            Round,
            AlongPath,
            "weather",
            WeatherParams,
            "Cloud, rain and type of the sky, on the sky itself or on the weather map. Ctrl erases or takes away;"
            " P+click takes the weather there as the target.",
            inverse="Erase weather",
        ),
        Brush(
            "paint",
            "Paint",
            "0",
            Maps,
            Round,
            AlongPath,
            "foam",
            MapParams,
            "Foam of the sea and of rivers, snow, ice, and where no puddle forms, no rain falls, effects are held down."
            " Ctrl does the contrary.",
            inverse="Remove paint",
        ),
        Brush(
            "flow",
            "Flow",
            "J",
            FlowPaint,
            Round,
            AlongPath,
            "flow",
            FlowParams,
            "The current runs the way of the stroke. Ctrl does the contrary.",
            inverse="Erase flow",
        ),
        Brush(
            "water",
            "Water",
            "U",
            Water,
            Round,
            AlongPath,
            "river_mask",
            WaterParams,
            "Lakes, ponds and streams at any height, wherever the ground lies lower. Ctrl takes water away.",
            inverse="Dry out",
        ),
    )
}
