"""Edges of the picture smoothed where it has one sample a pixel; views keep their numbers."""

from __future__ import annotations

from ..frame import Frame


def draw(frame: Frame) -> None:
    if frame.smoothed:
        (frame.targets.smoothed if frame.scaled else frame.targets.display).use()
        frame.shader("antialias.glsl").fullscreen()
