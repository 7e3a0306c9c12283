"""A picture of fewer pixels brought to its full size; overlays come after it and stay sharp."""

from __future__ import annotations

from ..frame import Frame


def draw(frame: Frame) -> None:
    if not frame.scaled:
        return
    targets = frame.targets
    targets.display.use()
    frame.textures["u_small"] = targets.textures["smoothed" if frame.smoothed else "shown"]
    frame.uniforms["u_full_size"] = tuple(float(side) for side in frame.full_size)
    frame.shader("upscale.glsl").fullscreen()
