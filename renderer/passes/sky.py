"""The sky where nothing was drawn."""

from __future__ import annotations

from ..frame import Frame


def draw(frame: Frame) -> None:
    frame.targets.hdr.use()
    frame.shader("sky.glsl").fullscreen()
