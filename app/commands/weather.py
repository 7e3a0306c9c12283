"""`weather import` and `weather export`: weather maps from and to images."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import cyclopts
from cyclopts import Parameter

from ...level.errors import BadInput
from .common import LevelPath, finite, numbers, put, put_notes, writable_parent

app = cyclopts.App(name="weather", help="Weather maps: import one over the painted sky, export the sky.")
SWIZZLE = "Coverage, precipitation, type and weights from r, g, b, a, 1-r …, numbers or - (leave), such as r,0,0.6."


@app.command(name="import")
def import_map(
    level: LevelPath,
    image: Annotated[Path, Parameter(help="PNG, BMP, TGA, TIFF, EXR, HDR or JPEG; north on top, 0 to 1, linear.")],
    *,
    layout: Annotated[str, Parameter(help="ours, weighted, hdrp, takram or clayjohn.")] = "ours",
    swizzle: Annotated[str, Parameter(allow_leading_hyphen=True, help=SWIZZLE)] = "",
    weights: Annotated[Path | None, Parameter(help="Second image: how much each channel counts.")] = None,
    opacity: Annotated[float, Parameter(help="How much it covers what was painted, 0 to 1.")] = 1.0,
    wrap_blend: Annotated[float, Parameter(help="Metres at each edge cross-faded so that it tiles.")] = 0.0,
    extent_m: Annotated[float, Parameter(help="Metres it covers a side.")] = 70_000.0,
    at: Annotated[str | None, Parameter(allow_leading_hyphen=True, help="X,Y of its middle at time 0, metres.")] = None,
    feather: Annotated[float, Parameter(help="Metres over which a smaller map fades out at its border.")] = 0.0,
) -> int:
    """Lay a weather map over a level's painted sky.

    What the image leaves open is told; nothing is changed when it cannot be used.
    """
    from ..session import Session

    place = tuple(numbers(at, 2, "--at", "a place: give X,Y in metres")) if at is not None else None
    with Session.open(level) as session:
        session.weather_import(
            image, layout=layout, swizzle=swizzle, weights=str(weights or ""), opacity=opacity, at=place,
            wrap_blend_m=wrap_blend, feather_m=feather, extent_m=extent_m,
        )  # fmt: skip
        session.save()
        put_notes(session.notes)
        data = session.level.layers["weather"].read(session.level.layers["weather"].grid.rect)
    put(f"{100 * float((data[..., 3:].max(axis=-1) > 0).mean()):.0f} % of the sky is painted")
    return 0


@app.command(name="export")
def export_map(
    level: LevelPath,
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="PNG, TIFF or EXR; north on top.")],
    layout: Annotated[str, Parameter(help="ours, weighted, weights or hdrp.")] = "ours",
    bits: Annotated[int, Parameter(help="8 or 16; EXR 16 or 32.")] = 8,
    side: Annotated[int, Parameter(name="--size", help="Samples a side.")] = 512,
    time: Annotated[float, Parameter(allow_leading_hyphen=True, help="Seconds on the level's clock.")] = 0.0,
    stage: Annotated[
        Literal["paint", "simulated", "painted", "final"] | None,
        Parameter(help="The paint alone, or the sky before it, with it, as drawn."),
    ] = None,
) -> int:
    """Write a level's sky as a weather map of 70 km round its middle.

    Prints its path.
    """
    from ...io import read_level
    from ...io.weather_maps import layout_values, write_weather_map

    if bits not in (8, 16, 32):
        raise BadInput(f"--bits {bits} is not 8, 16 or 32")
    writable_parent(output)
    notes: list[str] = []
    found = read_level(level, notes)
    sky, told = layout_values(found, layout, stage or "", finite(time, "--time", 0, 1e9))
    write_weather_map(output, sky, bits=bits, side=side)
    put_notes([*notes, *told])
    put(str(output))
    return 0
