"""The force field round the camera, worked out on the CPU, sent when it changed (D18)."""

from __future__ import annotations

import numpy as np

from ...level.force import SIDE, force_field
from ..frame import Frame

AHEAD = 0.5  # of the field's side: how far before the camera its middle lies at most, so that what is near is in it


def centre(frame: Frame) -> tuple[float, float]:
    """Where the picture's middle meets the still sea, or as far ahead as the field allows."""
    position, way = frame.matrices.position, -frame.matrices.view[2]
    fall = float(position[2] - frame.level.sea_level_m)
    flat = max(float(np.hypot(way[0], way[1])), 1e-6)
    along = AHEAD * SIDE * frame.level.settings.force.cell_m
    if fall > 0 and way[2] < 0:
        along = min(along, fall / -float(way[2]) * flat)
    return tuple(float(position[i] + way[i] / flat * along) for i in (0, 1))


def draw(frame: Frame) -> None:
    uploader = frame.renderer.uploader
    field = force_field(frame.level, frame.time_s, centre(frame))
    frame.textures["u_force"] = uploader.force(field.packed() if field else None)
    place = (*field.origin_m, field.settings.cell_m, 1.0) if field else (0.0, 0.0, 1.0, 0.0)
    frame.uniforms["u_force_place"] = place
