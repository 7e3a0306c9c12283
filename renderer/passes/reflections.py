"""The land mirrored in the still sea's plane, a quarter of the pixels, from what is lit and drawn already (H17)."""

from __future__ import annotations

from ..below import lowest_rows, water_rows
from ..frame import Frame
from .sea import water_shown


def in_use(frame: Frame) -> bool:
    """Whether the sea mirrors the land that is seen; without it, what stands in the mirror has one middling colour."""
    if not water_shown(frame) or frame.view.scene:
        return False
    if frame.view.name == "reflections":
        return True
    return frame.tier.reflections and "reflections" in frame.show and frame.level.settings.water.reflections > 0


def defines(frame: Frame) -> dict[str, str]:
    return {"REFLECTIONS": ""} if in_use(frame) else {}


def draw(frame: Frame) -> None:
    if not in_use(frame):
        return
    targets = frame.targets
    targets.mirrored.clear()
    with lowest_rows(targets.mirrored, water_rows(frame, targets.plate_size[1])):
        frame.shader("reflections.glsl").fullscreen()
    targets.textures["u_mirrored"].build_mipmaps(max_level=4)
