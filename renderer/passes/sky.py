"""The sky where nothing was drawn."""

from __future__ import annotations

from ..frame import Frame
from ..high_layers import bind_high


def draw(frame: Frame) -> None:
    frame.targets.hdr.use()
    frame.shader("sky.glsl", **bind_high(frame)).fullscreen()
