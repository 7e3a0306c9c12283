"""The picture, or a view's numbers, to display colours."""

from __future__ import annotations

from ..frame import Frame
from ..view_row import RAMPS


def draw(frame: Frame) -> None:
    view = frame.view
    (frame.targets.shown if frame.smoothed or frame.scaled else frame.targets.display).use()
    shader = frame.shader("display.glsl")
    shader.program["u_ramp"].value = RAMPS.index(view.ramp if view.value else "light")
    shader.program["u_range"].value = view.low, view.high
    shader.fullscreen()
