"""`render`: a picture or numbered frames of a level, without a window and without its lock."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from ...level.errors import BadInput
from ...level.params import replace
from .common import LevelPath, assignment, finite, numbers, progress, put, put_notes, put_table, size, writable_parent

SUFFIXES = (".png", ".jpg", ".exr")


def render(
    level: LevelPath,
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="PNG: the display picture. EXR: linear radiance.")],
    camera: Annotated[str, Parameter(allow_leading_hyphen=True, help="A name, or X,Y,Z,YAW,PITCH.")] = "play",
    size_text: Annotated[str, Parameter(name="--size", help="WIDTHxHEIGHT in pixels.")] = "1280x720",
    time: Annotated[float, Parameter(allow_leading_hyphen=True, help="Seconds on the level's clock.")] = 0.0,
    view: Annotated[str, Parameter(help="A buffer or mask; `shorewright views` lists them.")] = "final",
    environment: Annotated[str | None, Parameter(help="Light and air by name; `shorewright environments`.")] = None,
    weather: Annotated[str | None, Parameter(help="Waves, wind and sky by name; `shorewright weathers`.")] = None,
    assignments: Annotated[
        list[str] | None, Parameter(name="--set", negative="", help="NAME=VALUE, may repeat.")
    ] = None,
    hide: Annotated[list[str] | None, Parameter(negative="", help="Show flags to switch off, by comma.")] = None,
    quality: Literal["low", "medium", "high"] = "medium",
    samples: Annotated[int, Parameter(help="Frames accumulated for each picture.")] = 1,
    against: Annotated[
        list[str] | None,
        Parameter(name="--compare", negative="", help="Right half with NAME=VALUE, view:NAME or hide:FLAG."),
    ] = None,
    frames: Annotated[int | None, Parameter(help="How many numbered pictures, NAME_0001.png and on.")] = None,
    fps: Annotated[float, Parameter(allow_leading_hyphen=True, help="Pictures a second of level time.")] = 30.0,
    inset: Annotated[
        list[str] | None, Parameter(negative="", help="VIEW:CORNER:SIZE:TURN:METRES, a view in a corner; may repeat.")
    ] = None,
    fronts: Annotated[
        str | None, Parameter(help="Laid over the water: crests, ghosts:COUNT:S, isochrones:S, speed:MPS, breakers.")
    ] = None,
    arrows: Annotated[bool, Parameter(negative="", help="The current as arrows on the water.")] = False,
    streamlines: Annotated[bool, Parameter(negative="", help="Streamlines of it, evenly spread.")] = False,
    memory: Annotated[bool, Parameter(negative="", help="Also list what it took of the GPU, by target.")] = False,
) -> int:
    """Draw a level into a PNG or EXR.

    The picture at a time is the same however it was reached. Prints its path.
    """
    if output.suffix.lower() not in SUFFIXES:
        raise BadInput(f"{output.name} is no picture that can be written: end it in {' or '.join(SUFFIXES)}")
    options = {"size": size(size_text), "view": view, "quality": quality}
    options["samples"] = int(finite(samples, "--samples", 1, 1024))
    times = _times(time, frames, fps)
    writable_parent(output)
    found = _level(level, environment, weather, assignments)
    options |= look(view, hide)
    if inset or fronts is not None or arrows or streamlines:
        options["overlays"] = _overlays(inset or [], fronts, arrows, found if streamlines else None)
    other = compared(found, against, hide) if against else None
    _draw(found, _camera(found, camera), output, times, frames is not None, options, other)
    if memory:
        _put_memory()
    return 0


def _times(start: float, frames: int | None, fps: float) -> list[float]:
    finite(start, "--time", 0, 1e9)
    finite(fps, "--fps", 0.001, 1000)
    return [start + n / fps for n in range(int(finite(1 if frames is None else frames, "--frames", 1, 100_000)))]


def _level(path: Path, environment: str | None, weather: str | None, assignments: list[str] | None):
    """A level under an environment and a weather, with single settings changed."""
    from ...io import read_level
    from ...level.environments import environment_settings
    from ...level.preset_cover import covered
    from ...level.weather_presets import SKY, weather_settings

    notes: list[str] = []
    level = read_level(path, notes)
    put_notes(notes)
    if environment:
        level.set_settings(environment_settings(level.settings, environment))
    if weather:
        level.set_settings(weather_settings(level.settings, weather))
    if environment or weather:
        put_notes(covered(level, SKY))
    for text in assignments or []:
        level.set(*assignment(text))
    return level


def _camera(level, text: str):
    """A camera by its name, or from five numbers."""
    from pydantic import ValidationError

    from ...level.framing import cameras
    from ...level.objects import Camera
    from ...level.params import sentence

    if "," in text:
        what = "a camera: give a name or X,Y,Z,YAW,PITCH, such as 40,60,25,45,-55"
        x, y, z, yaw, pitch = numbers(text, 5, "--camera", what)
        try:
            return Camera(id="given", x=x, y=y, z=z, yaw_deg=yaw, pitch_deg=pitch)
        except ValidationError as error:
            raise BadInput(sentence(error, "--camera")) from None
    if text == "play" and "play" not in level.objects:
        return cameras(level)[0]
    return level.camera(text)


def _overlays(insets: list[str], fronts: str | None, arrows: bool, traced=None):
    """`traced`: the level whose streamlines are drawn."""
    from ...renderer.show import FrontLines, Inset, Overlays
    from ..streamlines import streamlines

    lines = FrontLines.parse(fronts) if fronts is not None else None
    return Overlays(
        insets=tuple(Inset.parse(text) for text in insets), fronts=lines, arrows=arrows,
        streamlines=None if traced is None else streamlines(traced),
    )  # fmt: skip


def look(view: str, hide: list[str] | None) -> dict:
    """What is shown of the scene, as the renderer takes it; BadInput for a view or show flag that isn't there."""
    from ...renderer.show import Show
    from ...renderer.views import find_view

    find_view(view)
    return {"show": Show.hide(",".join(hide or []))}


def compared(level, words: list[str], hide: list[str] | None) -> tuple:
    """The other level and look of a split picture (D42): the same arrays, settings of its own."""
    import copy

    other, look_of = copy.copy(level), {}
    for word in words:
        kind, colon, name = word.partition(":")
        if colon and kind == "view":
            look_of |= {"view": name, **look(name, hide)}
        elif colon and kind == "hide":
            hide = [*(hide or []), name]
            look_of |= look("final", hide)
        else:
            other.settings = replace(other.settings, *assignment(word))
    return other, look_of


def _draw(level, camera, output: Path, times, numbered: bool, options: dict, other: tuple | None = None) -> None:
    from ...io.images import write_image
    from ...renderer.offscreen import compare
    from ...renderer.offscreen import render as picture

    linear = output.suffix.lower() == ".exr"
    with progress("Drawing") as tell:
        for number, time_s in enumerate(times, 1):
            moment = {"time_s": time_s, "linear": linear, **options}
            pixels = compare(level, other[0], camera, other[1], **moment) if other else picture(level, camera, **moment)
            path = output if not numbered else output.with_name(f"{output.stem}_{number:04d}{output.suffix}")
            write_image(path, pixels)
            tell(number, len(times))
            tell.put(str(path))


def _put_memory() -> None:
    """The textures behind the picture last drawn, and their sum."""
    from ...renderer.memory import gpu_memory
    from ...renderer.offscreen import own_renderer

    rows = gpu_memory(own_renderer())
    put_table([(row.kind, row.name, row.layout, f"{row.bytes / 1e6:.2f} MB") for row in rows])
    put(f"{sum(row.bytes for row in rows) / 1e6:.1f} MB in {len(rows)} textures")
