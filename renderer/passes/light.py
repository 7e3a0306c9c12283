"""Light on everything in the G-buffer, once (D01)."""

from __future__ import annotations

from ...level.river_map import has_rivers
from ..below import lowest_rows, water_rows
from ..frame import Frame
from . import reflections
from .plate import land_first
from .sea import bind_water, water_shown


def quiet_defines(frame: Frame) -> dict[str, str]:
    """Reads the painted quiet area where it holds down the water's highlight (D39)."""
    level = frame.level
    painted = level.settings.quiet.highlight > 0 and not level.layers["quiet"].neutral
    if not (painted and water_shown(frame)):
        return {}
    bind_water(frame)
    return {"QUIET": ""}


def draw(frame: Frame) -> None:
    frame.targets.hdr.use()
    quiet, rivers = quiet_defines(frame), {"RIVERS": ""} if has_rivers(frame.level) else {}
    if land_first(frame):  # it is lit already (H12)
        with lowest_rows(frame.targets.hdr, water_rows(frame, frame.size[1])):
            frame.shader("light.glsl", SEA_ALONE="", **reflections.defines(frame), **quiet, **rivers).fullscreen()
        return
    frame.targets.hdr.clear()
    white = {"WHITE": ""} if frame.view.scene == "white" else {}
    frame.shader("light.glsl", **white, **quiet).fullscreen()
