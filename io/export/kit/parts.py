"""Parts of the runtime kit: sea and sky, one row each; what its files hold and how its GLSL begins."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ....level import Level
from .data import KitData, Made, kit_data
from .parse import parse
from .reach import pruned
from .sea_data import sea_defines, sea_made, sea_probes
from .sky_data import has_sky, sky_made, sky_probes
from .source import one_text
from .tree import Unit


@dataclass(frozen=True)
class Part:
    """`wanted`: the functions that a game calls, in `shaders/NAME.glsl`; `doc` says what they are."""

    name: str
    doc: str
    wanted: tuple[str, ...]
    has: Callable[[Level], bool]
    defines: Callable[[Level], list[str]]
    made: Callable[[Level], Made]
    probes: Callable[[KitData], list[dict]]


PARTS = {
    "sea": Part(
        "sea",
        "sea_surface(before): the surface that an undeformed point is\n"
        "// carried to; sea_at(world): that over a place; foam_on(sea): foam on it. Metres, x east, y north.",
        ("sea_at", "flow_at", "flow_places", "foam_on"),
        lambda level: True,
        sea_defines,
        sea_made,
        sea_probes,
    ),
    "sky": Part(
        "sky",
        "weather_at(xy): coverage, precipitation and type over a place;\n"
        "// cloud_density(position): extinction in 1/m there. Metres, x east, y north, z over the still sea.",
        ("weather_at", "cloud_density"),
        has_sky,
        lambda level: [],
        sky_made,
        sky_probes,
    ),
}  # fmt: skip


def part_of(level: Level, name: str) -> tuple[str, Unit, KitData]:
    """The GLSL of a part as the level has it, its tree with what is needed, its numbers."""
    part = PARTS[name]
    text = one_text(part.defines(level), name)
    unit = pruned(parse(text), part.wanted)
    return text, unit, kit_data(level, unit, part.made(level))
