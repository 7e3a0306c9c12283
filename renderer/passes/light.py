"""Light on everything in the G-buffer, once (D01)."""

from __future__ import annotations

from ..frame import Frame
from .plate import in_use


def draw(frame: Frame) -> None:
    frame.targets.hdr.use()
    if in_use(frame):  # the land is lit already (H12)
        frame.shader("light.glsl", SEA_ALONE="").fullscreen()
        return
    frame.targets.hdr.clear()
    frame.shader("light.glsl", **({"WHITE": ""} if frame.view.scene == "white" else {})).fullscreen()
