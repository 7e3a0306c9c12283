"""`sheet`: named cameras by environments on one picture, to judge a change of light or ground at a glance (L08)."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from ...level.errors import BadInput
from .common import assignment, finite, progress, put_notes, size, words, writable_parent
from .pictures import look

SUFFIXES = (".png", ".jpg")
MOST_PIXELS = 40_000_000
FIRST = ("play", "beach", "survey")  # the cameras every level has come in this order


def sheet(
    levels: Annotated[list[Path], Parameter(help="Folders of levels, NAME.shore.")],
    /,
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="PNG or JPEG.")],
    cameras: Annotated[list[str] | None, Parameter(negative="", help="Names by comma; all without it.")] = None,
    environments: Annotated[list[str] | None, Parameter(negative="", help="Names by comma; all without it.")] = None,
    size_text: Annotated[str, Parameter(name="--size", help="WIDTHxHEIGHT of one picture.")] = "320x180",
    time: Annotated[float, Parameter(allow_leading_hyphen=True, help="Seconds on the level's clock.")] = 0.0,
    view: Annotated[str, Parameter(help="A buffer or mask; `shorewright views` lists them.")] = "final",
    assignments: Annotated[
        list[str] | None, Parameter(name="--set", negative="", help="NAME=VALUE on every picture, may repeat.")
    ] = None,
    hide: Annotated[list[str] | None, Parameter(negative="", help="Show flags to switch off, by comma.")] = None,
    quality: Literal["low", "medium", "high"] = "medium",
    samples: Annotated[int, Parameter(help="Frames accumulated for each picture.")] = 1,
) -> int:
    """Draw a contact sheet: a row for each camera, a column for each environment.

    Prints its path.
    """
    from ...level.environments import ENVIRONMENTS
    from ..contact_sheet import compose, sheet_size

    if output.suffix.lower() not in SUFFIXES:
        raise BadInput(f"{output.name} is no picture that a sheet can be: end it in {' or '.join(SUFFIXES)}")
    cell, time_s = size(size_text), finite(time, "--time", 0, 1e9)
    options = {"size": cell, "time_s": time_s, "view": view, "quality": quality, **look(view, hide)}
    options["samples"] = int(finite(samples, "--samples", 1, 1024))
    writable_parent(output)
    skies = _environments(words(environments))
    shots = [shot for path in dict.fromkeys(levels) for shot in _shots(path, words(cameras), assignments)]
    names, labels = [name for name, _, _ in shots], [ENVIRONMENTS[sky].label for sky in skies]
    _check_size(sheet_size(cell, names, labels))
    cells = _draw(shots, skies, assignments, options)
    return _write(output, compose(cells, names, labels))


def _environments(names: list[str] | None) -> list[str]:
    from ...level import Settings
    from ...level.environments import ENVIRONMENTS, environment_settings

    for name in names or []:
        environment_settings(Settings(), name)
    return list(dict.fromkeys(names or ENVIRONMENTS))


def _shots(path: Path, names: list[str] | None, assignments: list[str] | None) -> list[tuple]:
    """(name of the row, level, camera) for every camera that is asked for."""
    from ...io import read_level
    from ...level.framing import cameras
    from ...level.objects import Camera
    from ...level.preset_cover import covered
    from ...level.weather_presets import SKY

    notes: list[str] = []
    level = read_level(path, notes)
    put_notes(notes)
    for text in assignments or []:  # refused before anything is drawn
        level.set(*assignment(text))
    put_notes(covered(level, SKY))
    own = {name: thing for name, thing in level.objects.items() if isinstance(thing, Camera)}
    made = {camera.id: camera for camera in cameras(level)}
    known = own if names is None and own else made | own
    order = names or sorted(known, key=lambda name: (FIRST.index(name) if name in FIRST else len(FIRST), name))
    found = [(name, known.get(name) or level.camera(name)) for name in dict.fromkeys(order)]
    return [(f"{path.name.removesuffix('.shore')}\n{name}", level, camera) for name, camera in found]


def _check_size(pixels: tuple[int, int]) -> None:
    if pixels[0] * pixels[1] > MOST_PIXELS:
        raise BadInput(
            f"a sheet of {pixels[0]} × {pixels[1]} pixels is more than {MOST_PIXELS // 10**6} million: "
            "give a smaller --size, fewer --cameras or --environments"
        )


def _draw(shots: list[tuple], skies: list[str], assignments: list[str] | None, options: dict) -> list[list]:
    """Pictures by row and column. One sky after another: making it costs more than moving the camera."""
    from ...level.environments import environment_settings
    from ...renderer import render

    cells: list[list] = [[None] * len(skies) for _ in shots]
    with progress("Drawing") as tell:
        done = 0
        for level in dict.fromkeys(level for _, level, _ in shots):
            own = level.settings
            for column, sky in enumerate(skies):
                level.set_settings(environment_settings(own, sky))
                for text in assignments or []:
                    level.set(*assignment(text))
                for row, (_, of, camera) in enumerate(shots):
                    if of is level:
                        cells[row][column] = render(level, camera, **options)
                        done += 1
                        tell(done, len(shots) * len(skies))
    return cells


def _write(output: Path, pixels) -> int:
    from ...io.images import write_image
    from .common import put

    put(str(write_image(output, pixels)))
    return 0
