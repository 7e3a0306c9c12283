"""Light on everything in the G-buffer, once (D01)."""

from __future__ import annotations

from ..frame import Frame
from . import reflections
from .plate import land_first


def draw(frame: Frame) -> None:
    frame.targets.hdr.use()
    if land_first(frame):  # it is lit already (H12)
        frame.shader("light.glsl", SEA_ALONE="", **reflections.defines(frame)).fullscreen()
        return
    frame.targets.hdr.clear()
    frame.shader("light.glsl", **({"WHITE": ""} if frame.view.scene == "white" else {})).fullscreen()
