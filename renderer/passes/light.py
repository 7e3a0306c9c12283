"""Light on everything in the G-buffer, once (D01)."""

from __future__ import annotations

from ..frame import Frame


def draw(frame: Frame) -> None:
    frame.targets.hdr.use()
    frame.targets.hdr.clear()
    frame.shader("light.glsl", **({"WHITE": ""} if frame.view.scene == "white" else {})).fullscreen()
