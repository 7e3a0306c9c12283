"""Haze over distance, and the step from the lit scene to the picture in full floats (D38)."""

from __future__ import annotations

from ..frame import Frame


def draw(frame: Frame) -> None:
    frame.targets.picture.use()
    frame.shader("fog.glsl").fullscreen()
